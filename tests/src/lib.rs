//! CPU twins of the runtime's shader passes, and what tests need to compare them with a GPU.
//!
//! A twin is the same computation in plain Rust, written from the same formulas: file for file, name for
//! name. It reads the pack's own levels and the uniforms that the runtime computed, so that a difference
//! means that shader and formulas disagree. A method's `map.wgsl` and `pack.wgsl` are `METHOD_map.rs` and
//! `METHOD_pack.rs` here; `clouds.rs` is `clouds/shared.wgsl`, `sky.rs` is `gradient.wgsl`, `renderer.rs` is `sky/sky.wgsl`.

pub mod camera;
pub mod catalogue;
pub mod clouds;
pub mod compare;
pub mod dome;
pub mod drivers;
pub mod fbm;
pub mod fbm_map;
pub mod fbm_pack;
pub mod film;
pub mod flares;
pub mod galaxy;
pub mod gpu;
pub mod lightning;
pub mod lit;
pub mod lit_map;
pub mod lit_paper;
pub mod map;
pub mod methods;
pub mod moon;
pub mod octaves;
pub mod octaves_map;
pub mod pack;
pub mod packed;
pub mod packed_map;
pub mod packed_paper;
pub mod perez;
pub mod photo;
pub mod planets;
pub mod rain;
pub mod rays;
pub mod renderer;
pub mod ring;
pub mod sea;
pub mod shadow;
pub mod sky;
pub mod skybox;
pub mod sprites;
pub mod stars;
pub mod sun;
pub mod texture;
pub mod tonemap;
