# The front door. Needs Rust (rustup or Debian's rustc of the version in Cargo.toml), a C compiler and, for
# pictures and tests, a Vulkan driver, a GL one and Node.js: `make tools` installs what is missing where it may.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
CARGO ?= cargo
WELKIN := target/release/welkin
VIEW := target/release/welkin-view
PACK := packs/default
SKYBOX_PACK := packs/skybox
FRAME := --size 1280x720
# The window is a feature, for pictures need none of what it needs.
WINDOW := --features welkin-viewer/window

# Every test is compiled with the same features, so that what one command has compiled is there for the next.
TEST := $(CARGO) test --workspace $(WINDOW) --locked
# What wants nothing but cargo, save the unit tests of the viewer that open an adapter.
PLAIN := $(TEST) --lib --bins --test it --
ADAPTER := gpu::tests headless::tests pass_times::tests timing::tests bench::mukhina::tests

# What `make recipes` bakes.
RECIPES := 20000
SEEDS := 10000

# The skies that every method draws: at sunset towards the sun and away from it.
METHODS := packed octaves fbm lit sprites
NOON := --time 0.45 --azimuth 100 --elevation 21
SUNSET := --time 0.752 --cover 0.55 --height 0.6 --azimuth 270 --elevation 19
AWAY := --time 0.752 --cover 0.55 --height 0.6 --azimuth 90 --elevation 19
STORM := --time 0.42 --cover 0.95 --density 0.8 --azimuth 40 --elevation 20

# Mesa's device selection complains of a desktop session that is not there; without it, nothing is lost.
export NODEVICE_SELECT := 1

# Everything that reads a file of somebody else's: targets in fuzz/fuzz_targets/.
FUZZ := pack ktx manifest field recipe picture model catalogue
SECONDS := 60
FUZZ_FLAGS := -max_len=131072 -rss_limit_mb=2048 -timeout=20

# The other processor that bakes are compared on, under qemu.
AARCH64 := aarch64-unknown-linux-gnu

.PHONY: help sky view gallery web check test test-docs test-packages test-recipes test-node test-gpu test-window test-web bevy-test recipes bench fuzz fuzz-build aarch64 aarch64-tools tools gpu-tools window-tools desktop-tools node-tools web-tools browser clean

help: ## Say what can be made
	@grep -hE '^[a-z0-9-]+:.*## ' $(MAKEFILE_LIST) | sed 's/:.*## /\t/' | expand -t 14

sky: gpu-tools ## Bake the default pack, check it, and draw pictures of every method into out/
	$(CARGO) build --release --locked -p welkin-baker -p welkin-viewer
	$(WELKIN) bake -o $(PACK) --force
	$(WELKIN) check $(PACK)
	mkdir -p out
	$(WELKIN) preview $(PACK) -o out/preview.png
	for method in $(METHODS); do \
	  $(VIEW) render $(PACK) -o out/$$method-noon.png $(FRAME) --method $$method $(NOON); \
	  $(VIEW) render $(PACK) -o out/$$method-sunset.png $(FRAME) --method $$method $(SUNSET); \
	  $(VIEW) render $(PACK) -o out/$$method-away.png $(FRAME) --method $$method $(AWAY); \
	done
	$(VIEW) render $(PACK) -o out/packed-storm.png $(FRAME) --method packed $(STORM)
	$(VIEW) render $(PACK) -o out/octaves-storm.png $(FRAME) --method octaves $(STORM)
	$(VIEW) render $(PACK) -o out/fbm-storm.png $(FRAME) --method fbm --palette stormy $(STORM)
	$(VIEW) render $(PACK) -o out/lit-storm.png $(FRAME) --method lit $(STORM)
	$(VIEW) render $(PACK) -o out/sprites-storm.png $(FRAME) --method sprites $(STORM)
	$(VIEW) render $(PACK) -o out/moonlight.png $(FRAME) --method lit --time 0.03 --cover 0.5 --azimuth 200 --elevation 34
	$(VIEW) render $(PACK) -o out/rays.png $(FRAME) --method fbm --time 0.72 --cover 0.7 --azimuth 252 --elevation 12 --at 60 --rays 1
	$(VIEW) render $(PACK) -o out/rain.png $(FRAME) --method lit --time 0.42 --cover 1 --density 0.6 --azimuth 40 --elevation 15 --rain 0.8
	$(VIEW) render $(PACK) -o out/rainbow.png $(FRAME) --method packed --time 0.715 --cover 0.65 --density 0.7 --azimuth 80 --elevation 16 --fov 70 --rain 0.6
	$(VIEW) render $(PACK) -o out/sprites-among.png $(FRAME) --method sprites --time 0.6 --cover 0.5 --azimuth 300 --elevation 5 --up 1300
	$(VIEW) render $(PACK) -o out/sprites-above.png $(FRAME) --method sprites --time 0.45 --cover 0.5 --azimuth 100 --elevation -12 --fov 75 --up 3400
	$(VIEW) render $(PACK) -o out/lightning.png $(FRAME) --method lit --time 0.8 --cover 1 --density 0.8 --azimuth 40 --elevation 22 --at 10.02 --lightning 2,-2.5,10
	$(VIEW) render $(PACK) -o out/panorama.png --equirect 1024 --method lit --time 0.742 --sunset 1 --cover 0.62
	$(VIEW) render $(PACK) -o out/figure2.png $(FRAME) --cover 0.69 --height 1.0 --density 0 --sunset 0.72 --speed 0.1 --time 0.35 --azimuth 130 --elevation 28 --flare 0 --shading paper
	$(VIEW) render $(PACK) -o out/figure4.png $(FRAME) --cover 0.57 --height 0.52 --density 0.84 --sunset 0.43 --speed 0 --time 0.72 --azimuth 250 --elevation 26 --flare 0 --shading paper
	$(VIEW) render $(PACK) -o out/night.png $(FRAME) --moon 0 --time 0 --cover 0.35 --azimuth 72 --elevation 42 --fov 75
	$(VIEW) render $(PACK) -o out/overcast.png $(FRAME) --time 0.45 --cover 1 --density 0.6 --azimuth 30 --elevation 26
	$(VIEW) render $(PACK) -o out/flare.png $(FRAME) --flare 1 --time 0.64 --cover 0.55 --azimuth 208 --elevation 26
	$(VIEW) render $(PACK) -o out/parallax-here.png $(FRAME) --method octaves --cover 0.5 $(NOON)
	$(VIEW) render $(PACK) -o out/parallax-there.png $(FRAME) --method octaves --cover 0.5 $(NOON) --north 400
	$(WELKIN) bake assets-src/recipes/skybox.toml -o $(SKYBOX_PACK) --force
	$(WELKIN) check $(SKYBOX_PACK)
	$(VIEW) render $(SKYBOX_PACK) -o out/skybox.png $(FRAME) --method fbm --cover 0.4 --time 0.4 --azimuth 50 --elevation 22
	@echo "pictures are in out/, the packs are in packs/"

view: gpu-tools window-tools ## Open a window with sliders on the default pack
	$(CARGO) build --release --locked -p welkin-baker -p welkin-viewer $(WINDOW)
	[ -f $(PACK)/pack.json ] || $(WELKIN) bake -o $(PACK)
	$(VIEW) $(PACK)

# Clouds of the lit method: how many, of how many layers, of which kind, in which light.
LIT := --size 480x270 --method lit --elevation 24 --fov 60 --flare 0
LIT_LOW_SUN := --time 0.725 --azimuth 254

# Clouds in space. Each kind: its cover, a height among its clouds and one above them, in metres.
SPRITES := --size 480x270 --method sprites --flare 0
KINDS := cumulus:0.45:1250:3800 congestus:0.5:1800:5500 cumulonimbus:0.45:2500:9000 stratus:0.85:450:900 \
  stratocumulus:0.8:1350:3800 altocumulus:0.6:3300:5200 cirrus:0.7:7600:9500
DAY := dawn:0.262:92 noon:0.48:120 dusk:0.735:262 night:0.03:200
# A flight straight through a cloud, by metres to the north.
FLIGHT := 1000 1250 1500 1650 1750 1850 2000 2250

gallery: sky ## Draw the pictures of docs/lit.md and docs/sprites.md into out/lit/ and out/sprites/, and a page of every method into out/look/
	mkdir -p out/lit
	for oktas in 0 2 4 6 8; do \
	  for layers in "one --layers stratocumulus" "three"; do \
	    set -- $$layers; name=$$1; shift; \
	    $(VIEW) render $(PACK) -o out/lit/$$name-noon-$$oktas.png $(LIT) $$@ --oktas $$oktas --time 0.48 --azimuth 120; \
	    $(VIEW) render $(PACK) -o out/lit/$$name-low-sun-$$oktas.png $(LIT) $$@ --oktas $$oktas $(LIT_LOW_SUN); \
	    $(VIEW) render $(PACK) -o out/lit/$$name-night-$$oktas.png $(LIT) $$@ --oktas $$oktas --time 0.03 --azimuth 200; \
	  done; \
	done
	for kind in stratocumulus cumulus cirrus; do \
	  $(VIEW) render $(PACK) -o out/lit/$$kind-noon.png $(LIT) --layers $$kind --oktas 4 --time 0.48 --azimuth 120; \
	  $(VIEW) render $(PACK) -o out/lit/$$kind-low-sun.png $(LIT) --layers $$kind --oktas 4 $(LIT_LOW_SUN); \
	done
	mkdir -p out/sprites
	for kind in $(KINDS); do \
	  IFS=: read -r name cover among above <<< $$kind; pack=packs/fields/$$name; \
	  $(WELKIN) bake assets-src/recipes/fields/$$name.toml -o $$pack --force; \
	  set -- $(SPRITES) --cover $$cover --time 0.42 --azimuth 30 --fov 70 --ring 12000; \
	  $(VIEW) render $$pack -o out/sprites/$$name-ground.png "$$@" --elevation 24 --up 2; \
	  $(VIEW) render $$pack -o out/sprites/$$name-among.png "$$@" --elevation 8 --up $$among; \
	  $(VIEW) render $$pack -o out/sprites/$$name-above.png "$$@" --elevation -12 --up $$above; \
	done
	for hour in $(DAY); do \
	  IFS=: read -r name time azimuth <<< $$hour; \
	  $(VIEW) render $(PACK) -o out/sprites/$$name.png $(SPRITES) --cover 0.3 --time $$time --azimuth $$azimuth --elevation 14; \
	done
	for formed in 0.17 0.33 0.5 0.67 0.83 1; do \
	  $(VIEW) render $(PACK) -o out/sprites/formed-$$formed.png $(SPRITES) --cover 0.3 $(NOON) --formation $$formed; \
	done
	for ring in 0 12000; do \
	  $(VIEW) render $(PACK) -o out/sprites/ring-$$ring.png $(SPRITES) --cover 0.5 --time 0.45 --azimuth 100 --elevation 12 --ring $$ring; \
	  $(VIEW) render $(PACK) -o out/sprites/ring-wide-$$ring.png $(SPRITES) --cover 0.5 --time 0.45 --azimuth 100 --elevation -12 --fov 75 --up 3400 --ring $$ring; \
	done
	for north in $(FLIGHT); do \
	  $(VIEW) render $(PACK) -o out/sprites/flight-$$north.png $(SPRITES) --cover 0.3 --time 0.4 --azimuth 0 --elevation 2 --up 1300 --north $$north; \
	done
	$(VIEW) render $(PACK) -o out/sprites/far.png $(SPRITES) --cover 0.6 --time 0.45 --azimuth 100 --elevation -14 --up 9000 --sight 60000
	@# Numbers beyond the bounds are told; the page is there all the same.
	-$(VIEW) look $(PACK) -o out/look

web: web-tools ## Build the page with the sky in WebAssembly into out/web/, for any web server
	$(CARGO) build --release --locked -p welkin-baker
	scripts/web-build
	@echo "the page is in out/web/: python3 -m http.server -d out/web, then http://localhost:8000"

# A test program is named after what it wants: `it` nothing but cargo, `recipes` time, `node`, `gpu` and `window` their tools.
check: ## Formatting, lints, and the tests that want nothing but cargo: two minutes
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets $(WINDOW) --locked -- -D warnings
	if $(CARGO) tree --locked -e normal,build -p welkin-baker | grep -q ' wgpu '; then echo "the baker must not need wgpu"; exit 1; fi
	$(PLAIN) $(addprefix --skip ,$(ADAPTER))

# One after the other, also with `make -j`: they compile in one folder, and those with a clock want the machine for themselves.
.NOTPARALLEL:

test: tools check test-docs test-packages test-recipes test-node test-gpu test-window test-web ## Run every test, and formatting, lints and docs without a warning

test-docs: ## Compile the documentation without a warning, and run its examples
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --workspace --no-deps $(WINDOW) --locked
	$(TEST) --doc

test-packages: ## Package what is published, and compile it outside the repository
	scripts/test-packages

# With debug assertions, and many times as many with the program that users have.
test-recipes: ## Bake recipes at random and packs by the dozen, and the default pack with the release build: the same bytes
	$(CARGO) build --release --locked -p welkin-baker
	WELKIN_RELEASE=$(CURDIR)/$(WELKIN) $(TEST) --test recipes -- --include-ignored
	$(CARGO) test --release --locked -p welkin-baker --test recipes

test-node: node-tools ## Read packs and fields with readers of others
	$(TEST) --test node -- --include-ignored

test-gpu: gpu-tools node-tools ## Test what is drawn, on any Vulkan and GL driver, software ones will do
	$(PLAIN) $(ADAPTER)
	$(CARGO) build --workspace $(WINDOW) --locked --examples
	$(TEST) --test gpu -- --include-ignored
	$(CARGO) test --locked -p welkin-runtime --no-default-features --lib --test gpu

test-window: gpu-tools window-tools desktop-tools ## Test the window on a display without a screen
	$(CARGO) build --workspace $(WINDOW) --locked --examples
	$(TEST) --test window -- --include-ignored

# The test of the window is what has the viewer compiled as the other tests have it.
test-web: web gpu-tools browser ## Test the page: its bakes, and its pictures in headless Chromium
	$(TEST) --no-run --test window
	cd web && WELKIN_VIEW=$(CURDIR)/target/debug/welkin-view node --test --test-concurrency=1 test/*.test.mjs

# Bevy from nothing takes a quarter of an hour, so it is no part of `make test`. Its stated least compiler is newer than the one that it needs.
bevy-test: gpu-tools ## Test the plugin for Bevy, on any Vulkan driver: 3 minutes, and 15 to compile Bevy
	$(CARGO) fmt --manifest-path bevy_welkin/Cargo.toml --check
	cd bevy_welkin && $(CARGO) test --locked --ignore-rust-version --examples --tests
	cd bevy_welkin && $(CARGO) test --locked --ignore-rust-version --doc

recipes: ## Bake RECIPES random recipes and the default one with SEEDS seeds, and check them all
	WELKIN_RECIPES=$(RECIPES) WELKIN_SEEDS=$(SEEDS) $(CARGO) test --release --locked -p welkin-baker --test recipes -- legal:: --nocapture

bench: gpu-tools ## Measure the bake, and the GPU milliseconds of a frame of each method
	$(CARGO) build --release --locked -p welkin-baker -p welkin-viewer
	$(WELKIN) bake -o $(PACK) --force
	$(VIEW) bench $(PACK) --method all

# Without sanitizers, which want a nightly compiler: the crates have no unsafe code, so what is looked for are panics, hangs and
# too much memory. libFuzzer's coverage works with the stable one.
fuzz-build: ## Compile the fuzz targets and write what they start from
	@command -v cargo-fuzz >/dev/null || $(CARGO) install cargo-fuzz --locked
	$(CARGO) run --release --manifest-path fuzz/Cargo.toml -p welkin-fuzz-seeds -- fuzz/corpus
	$(CARGO) fuzz build --sanitizer none

fuzz: fuzz-build ## Feed every reader with damaged files, SECONDS each: `make fuzz SECONDS=600`
	for target in $(FUZZ); do \
	  $(CARGO) fuzz run --sanitizer none $$target -- -max_total_time=$(SECONDS) $(FUZZ_FLAGS); \
	done

aarch64: aarch64-tools ## Bake the default pack as a 64-bit ARM processor does, and compare it byte by byte
	$(CARGO) build --release --locked -p welkin-baker
	CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc CC_aarch64_unknown_linux_gnu=aarch64-linux-gnu-gcc \
	  CARGO_TARGET_DIR=target/aarch64 scripts/cross-cargo $(AARCH64) build --release --locked -p welkin-baker
	mkdir -p out
	$(WELKIN) bake -o out/pack-here --force
	qemu-aarch64 -L /usr/aarch64-linux-gnu target/aarch64/$(AARCH64)/release/welkin bake -o out/pack-aarch64 --force
	sha256sum out/pack-here/* out/pack-aarch64/*
	diff -r out/pack-here out/pack-aarch64

aarch64-tools:
	@command -v aarch64-linux-gnu-gcc >/dev/null && command -v qemu-aarch64 >/dev/null && [ -d /usr/aarch64-linux-gnu/include ] \
	  || scripts/apt-install gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user

tools: gpu-tools window-tools desktop-tools node-tools web-tools browser ## Install what pictures, window, page and tests need, with apt, where it is missing

# A Vulkan driver and a GL one: any GPU's, or Mesa's software ones. `ls` finds the driver files that the loaders read.
gpu-tools:
	@ls /usr/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json 2>/dev/null | grep -q . && ldconfig -p | grep -q libvulkan.so.1 \
	  || [ "$$(uname -s)" != Linux ] \
	  || scripts/apt-install mesa-vulkan-drivers libvulkan1
	@ls /usr/share/glvnd/egl_vendor.d/*.json /etc/glvnd/egl_vendor.d/*.json 2>/dev/null | grep -q . && ldconfig -p | grep -q libEGL.so.1 \
	  || [ "$$(uname -s)" != Linux ] \
	  || scripts/apt-install libegl1 libegl-mesa0 libgl1-mesa-dri

# What the window's libraries open when it starts, on X11.
window-tools:
	@[ "$$(uname -s)" != Linux ] || { ldconfig -p | grep -q libX11-xcb.so.1 && ldconfig -p | grep -q libXcursor.so.1 \
	  && ldconfig -p | grep -q libXi.so.6 && ldconfig -p | grep -q libxkbcommon-x11.so.0; } \
	  || scripts/apt-install libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0

# A display without a screen, and hands for it: they drive the window in tests.
desktop-tools:
	@[ "$$(uname -s)" != Linux ] || { command -v Xvfb && command -v xdotool && command -v xclip; } >/dev/null \
	  || scripts/apt-install xvfb xdotool xclip

# Node.js runs independent readers of KTX2 and glTF.
node-tools:
	@command -v node >/dev/null && command -v npm >/dev/null || scripts/apt-install nodejs npm
	@[ -d tests/node/node_modules/ktx-parse ] && [ -d tests/node/node_modules/gltf-validator ] \
	  || npm --prefix tests/node ci --no-audit --no-fund --silent

# wasm-opt, the driver of the browser, the compiler of types, three.js and a bundler come from npm; scripts/wasm-build looks for the compiler.
web-tools: node-tools
	@[ -d web/node_modules/binaryen ] && [ -d web/node_modules/playwright-core ] && [ -d web/node_modules/typescript ] && [ -d web/node_modules/three ] && [ -d web/node_modules/vite ] || npm --prefix web ci --no-audit --no-fund --silent

browser:
	@command -v $(or $(CHROMIUM),/usr/bin/chromium) >/dev/null || scripts/apt-install chromium

clean: ## Remove what was made
	$(CARGO) clean
	rm -rf out packs tests/node/node_modules web/node_modules
