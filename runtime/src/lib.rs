//! Draws a moving sky from a Welkin pack with wgpu.
//!
//! # Theory
//! T. Roden, I. Parberry, "Clouds and Stars: Efficient Real-Time Procedural Sky Rendering Using 3D
//! Hardware", ACE 2005. Each pass has its own module and its own WGSL file of the same name, whose
//! documentation names the equations and what was changed.
//!
//! # Practice
//! One triangle over the screen, one fragment shader, five to ten texture reads a pixel, inside
//! `Limits::downlevel_webgl2_defaults()`. All work a frame is done in [`Sky::prepare`], which writes one
//! uniform buffer and draws off screen what needs that: the small cloud maps of [`Method::Octaves`], [`Method::Fbm`] and [`Method::Lit`],
//! the impostors of [`Method::Sprites`], and cloud shadows and rays while they are on. A frame is a pure function of pack, parameters,
//! camera and seconds, but for what [`Sky::reset_history`] forgets.
//!
//! ```no_run
//! # fn f(device: &wgpu::Device, queue: &wgpu::Queue, mut encoder: wgpu::CommandEncoder, descriptor: &wgpu::RenderPassDescriptor<'_>) -> Result<(), Box<dyn std::error::Error>> {
//! use welkin_runtime::{Camera, DepthConfig, Sky, SkyConfig, SkyParams};
//! let pack = welkin_pack::Pack::open("packs/default")?;
//! // As the pass in which the sky is drawn: its depth lets the scene stand before the sky.
//! let depth = DepthConfig { format: wgpu::TextureFormat::Depth32Float, reversed: true };
//! let config = SkyConfig { target_format: wgpu::TextureFormat::Bgra8UnormSrgb, depth: Some(depth), sample_count: 1 };
//! let mut sky = Sky::new(device, queue, config, &pack)?;
//! // Each frame, before the pass is begun and then inside it, after the opaque scene:
//! sky.prepare(queue, &mut encoder, &SkyParams::default(), &Camera::looking(3.1, 0.4, 1.0, [1280, 720]), 12.5);
//! let mut pass = encoder.begin_render_pass(descriptor);
//! sky.draw(&mut pass);
//! # Ok(()) }
//! ```

// Not every choice of features uses all that methods share.
#![cfg_attr(
    not(all(
        feature = "fbm",
        feature = "lit",
        feature = "octaves",
        feature = "sprites",
        feature = "weather"
    )),
    allow(dead_code)
)]

/// What the crate is made of, floor by floor, for its own tests: no part of what it promises.
#[doc(hidden)]
#[path = ""]
pub mod internals {
    pub mod almanac;
    pub mod clear_sky;
    pub mod clouds;
    pub mod device;
    pub mod error;
    pub mod frame;
    pub mod geometry;
    pub(crate) mod methods;
    pub mod oktas;
    pub mod pack_data;
    pub mod params;
    pub mod parts;
    pub mod sky;
    #[cfg(feature = "sprites")]
    pub mod sprites;
    pub mod tonemap;
    #[cfg(feature = "weather")]
    pub mod weather;
}

pub use glam;
pub use wgpu;

pub use internals::almanac;
pub use internals::clouds::shadow;
pub use internals::device::config::{DepthConfig, SkyConfig};
pub use internals::error::SkyError;
pub use internals::geometry::axes::Axes;
pub use internals::geometry::camera::Camera;
pub use internals::oktas::Oktas;
pub use internals::params::{self, Method, SkyParams};
pub use internals::sky::{Luminary, PackLight, Sky, SkyLight, View};
pub use internals::sky::{air, light};

#[cfg(feature = "sprites")]
pub(crate) use internals::sprites;
#[cfg(feature = "weather")]
pub(crate) use internals::weather;
pub(crate) use internals::{
    clear_sky, clouds, device, error, frame, geometry, methods, pack_data, parts, sky, tonemap,
};
