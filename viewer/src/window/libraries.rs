//! The system's libraries that a window opens when it starts, and which packages have them.

use anyhow::anyhow;

/// Files, and Debian's packages for them.
const PACKAGES: [(&str, &str); 8] = [
    ("libX11.so", "libx11-6"),
    ("libX11-xcb.so", "libx11-xcb1"),
    ("libXcursor.so", "libxcursor1"),
    ("libXi.so", "libxi6"),
    ("libXrandr.so", "libxrandr2"),
    ("libxkbcommon.so", "libxkbcommon0"),
    ("libxkbcommon-x11.so", "libxkbcommon-x11-0"),
    ("libwayland-client.so", "libwayland-client0"),
];

/// What keeps a window from opening where the keyboard's libraries are not there: winit would panic.
#[cfg(target_os = "linux")]
pub fn missing() -> Option<anyhow::Error> {
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    // As winit chooses.
    let is_wayland = is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET");
    if xkbcommon_dl::xkbcommon_option().is_none() {
        return Some(install("libxkbcommon.so", "libxkbcommon0"));
    }
    if !is_wayland && is_set("DISPLAY") && xkbcommon_dl::x11::xkbcommon_x11_option().is_none() {
        return Some(install("libxkbcommon-x11.so", "libxkbcommon-x11-0"));
    }
    None
}

/// The other systems have theirs built in.
#[cfg(not(target_os = "linux"))]
pub fn missing() -> Option<anyhow::Error> {
    None
}

/// The same of a library that an error of winit's names.
pub fn named(error: &str) -> Option<anyhow::Error> {
    let found = PACKAGES.iter().find(|(library, _)| error.contains(library));
    found.map(|(library, package)| install(library, package))
}

fn install(library: &str, package: &str) -> anyhow::Error {
    anyhow!(
        "no window opens without {library}, which is missing or damaged; install it (on Debian and Ubuntu: apt-get install {package}), or draw \
         without a window: `welkin-view render PACK -o FRAME.png`"
    )
}
