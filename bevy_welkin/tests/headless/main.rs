//! The plugin in an application without a window, on any Vulkan driver: a software one will do.

#[path = "../../examples/scene/mod.rs"]
mod scene;
mod stage;

mod light;
mod packs;
mod pictures;
mod views;
