//! The program `welkin-view`, run as its users run it, on whatever adapter there is (software Vulkan will do).

mod archive;
mod bench;
#[path = "../common/mod.rs"]
mod common;
mod environment;
mod export;
mod jobs;
mod labels;
mod light;
mod look;
mod loops;
mod methods;
mod program;
mod sample;
