//! Looks at Welkin skies without a window: frames drawn off screen, saved as pictures or as
//! environment maps, and passes timed on the GPU. The program `welkin-view` is built on it.

pub mod adapters;
pub mod constellations;
pub mod export;
pub mod frame;
pub mod gpu;
mod gpu_error;
pub mod headless;
pub mod labels;
pub mod motion;
pub mod pass_times;
mod read_back;
pub mod reference;
pub mod save;
pub mod spread;
pub mod structure;
mod timestamps;
pub mod timing;
pub mod wanted;
