//! The clouds of each method on a dome.

pub mod fbm;
pub mod fbm_map;
pub mod fbm_pack;
pub mod lit;
pub mod lit_map;
pub mod octaves;
pub mod octaves_map;
pub mod packed;
pub mod shadow;
pub mod shared;
