//! What the modules for a browser share. Elsewhere this library is empty.
#![cfg(target_arch = "wasm32")]

mod files;
mod panics;

pub use files::from_map;
