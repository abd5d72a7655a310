//! Whole-path tests on a GPU, software Vulkan will do: pictures, their twins, and what is always true of them.
//!
//! A program beside `it`, which runs where there is no Vulkan driver.

mod air;
mod application;
mod backends;
mod catalogue;
mod cover;
mod daylight;
mod depth;
mod dome;
mod eclipse;
mod examples;
mod flares;
mod formation;
mod gradient;
mod horizon;
mod lit;
mod maps;
mod motion;
mod oktas;
mod opacity;
mod over;
mod parallax;
mod pictures;
mod placed_stars;
mod purity;
mod robust;
mod scene_light;
mod sea;
mod shadows;
mod sky_light;
mod skybox;
mod sprites;
mod stars;
mod sun;
mod tonemap;
mod twins;
mod views;
mod weather;
