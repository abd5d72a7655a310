//! Where the files lie that are compiled in: in a package in its own folder, in the repository beside the crate's. There a link stands for
//! them too, which not every checkout on Windows follows.

use std::env;
use std::path::Path;

fn main() {
    let folder = env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    let own = Path::new(&folder).join("assets-src");
    let assets = match own.is_dir() {
        true => own,
        false => Path::new(&folder).join("../assets-src"),
    };
    println!("cargo::rustc-env=WELKIN_ASSETS={}", assets.display());
    println!("cargo::rerun-if-changed=build.rs");
    println!(
        "cargo::rerun-if-changed={}",
        assets.join("SOURCES.md").display()
    );
}
