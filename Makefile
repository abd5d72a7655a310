# The front door. Needs Rust (rustup or Debian's rustc of the version in Cargo.toml), a C compiler and, for
# pictures and tests, a Vulkan driver and Node.js: `make tools` installs what is missing where it may.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
CARGO ?= cargo
WELKIN := target/release/welkin
VIEW := target/release/welkin-view
PACK := packs/default
FRAME := --size 1280x720

# Mesa's device selection complains of a desktop session that is not there; without it, nothing is lost.
export NODEVICE_SELECT := 1

.PHONY: help sky test check bench tools gpu-tools node-tools clean

help: ## Say what can be made
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed 's/:.*## /\t/' | expand -t 14

sky: gpu-tools ## Bake the default pack, check it, and draw pictures of it into out/
	$(CARGO) build --release --locked -p welkin-baker -p welkin-viewer
	$(WELKIN) bake -o $(PACK) --force
	$(WELKIN) check $(PACK)
	mkdir -p out
	$(WELKIN) preview $(PACK) -o out/preview.png
	$(VIEW) render $(PACK) -o out/noon.png $(FRAME) --time 0.5 --azimuth 90 --elevation 28
	$(VIEW) render $(PACK) -o out/figure2.png $(FRAME) --cover 0.69 --height 1.0 --density 0 --sunset 0.72 --speed 0.1 --time 0.35 --azimuth 130 --elevation 28
	$(VIEW) render $(PACK) -o out/figure4.png $(FRAME) --cover 0.57 --height 0.52 --density 0.84 --sunset 0.43 --speed 0 --time 0.72 --azimuth 250 --elevation 26
	$(VIEW) render $(PACK) -o out/sunset.png $(FRAME) --time 0.742 --sunset 1 --cover 0.62 --height 0.6 --azimuth 270 --elevation 20
	$(VIEW) render $(PACK) -o out/night.png $(FRAME) --time 0 --cover 0.35 --azimuth 72 --elevation 42 --fov 75
	$(VIEW) render $(PACK) -o out/overcast.png $(FRAME) --time 0.45 --cover 1 --density 0.6 --azimuth 30 --elevation 26
	@echo "pictures are in out/, the pack is in $(PACK)"

test: gpu-tools node-tools ## Run every test, and formatting, lints and docs without a warning
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --locked -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --workspace --no-deps --locked
	$(CARGO) build --release --locked -p welkin-baker
	WELKIN_RELEASE=$(CURDIR)/$(WELKIN) $(CARGO) test --workspace --locked -- --include-ignored
	if $(CARGO) tree --locked -e normal,build -p welkin-baker | grep -q ' wgpu '; then echo "the baker must not need wgpu"; exit 1; fi

check: ## Compile and lint, without running anything
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --locked -- -D warnings

bench: gpu-tools ## Measure the bake, and the GPU milliseconds of a frame
	$(CARGO) build --release --locked -p welkin-baker -p welkin-viewer
	$(WELKIN) bake -o $(PACK) --force
	$(VIEW) bench $(PACK)

tools: gpu-tools node-tools ## Install what pictures and tests need, with apt, where it is missing

# A Vulkan driver: any GPU's, or Mesa's software one. `ls` finds the driver files that the loader reads.
gpu-tools:
	@ls /usr/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json 2>/dev/null | grep -q . && ldconfig -p | grep -q libvulkan.so.1 \
	  || [ "$$(uname -s)" != Linux ] \
	  || scripts/apt-install mesa-vulkan-drivers libvulkan1

# Node.js runs an independent KTX2 reader.
node-tools:
	@command -v node >/dev/null && command -v npm >/dev/null || scripts/apt-install nodejs npm
	@[ -d tests/node/node_modules/ktx-parse ] || npm --prefix tests/node ci --no-audit --no-fund --silent

clean: ## Remove what was made
	$(CARGO) clean
	rm -rf out packs tests/node/node_modules
