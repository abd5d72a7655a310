//! The sky in a browser: what `web/js/welkin.js` asks of WebAssembly. Elsewhere this library is empty.
#![cfg(target_arch = "wasm32")]

mod canvas;
mod check;
mod engine;
mod settings;
mod trouble;

pub use engine::Engine;
