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
//! camera and seconds, but for what [`Sky::forget`] forgets.
//!
//! ```no_run
//! # fn f(device: &wgpu::Device, queue: &wgpu::Queue, mut encoder: wgpu::CommandEncoder, descriptor: &wgpu::RenderPassDescriptor<'_>) -> Result<(), Box<dyn std::error::Error>> {
//! use welkin_runtime::{Camera, Sky, SkyConfig, SkyParams};
//! let pack = welkin_pack::Pack::open("packs/default")?;
//! let config = SkyConfig { target_format: wgpu::TextureFormat::Bgra8UnormSrgb, depth: None, sample_count: 1 };
//! let mut sky = Sky::new(device, queue, config, &pack)?;
//! // Each frame, before the pass is begun and then inside it, after the opaque scene:
//! sky.prepare(queue, &mut encoder, &SkyParams::default(), &Camera::looking(3.1, 0.4, 1.0, [1280, 720]), 12.5);
//! let mut pass = encoder.begin_render_pass(descriptor);
//! sky.draw(&mut pass);
//! # Ok(()) }
//! ```

pub mod camera;
pub mod cie;
pub mod clouds;
pub mod dome;
pub mod error;
pub mod fbm;
pub mod fbm_map;
pub mod fbm_pack;
pub mod flares;
pub mod frame;
pub mod galaxy;
mod histogram;
mod layouts;
pub mod light;
pub mod lightning;
pub mod lit;
pub mod lit_map;
pub mod map;
pub mod octaves;
pub mod octaves_map;
pub mod oktas;
pub mod packed;
pub mod params;
pub mod perez;
mod pipeline;
mod program;
pub mod rain;
pub mod rays;
pub mod renderer;
pub mod shader;
pub mod shadow;
pub mod sky;
pub mod skybox;
pub mod sprites;
pub mod stars;
pub mod sun;
pub mod tonemap;
pub mod uniforms;
mod upload;

pub use camera::Camera;
pub use error::SkyError;
pub use oktas::Oktas;
pub use params::{
    FbmParams, Lightning, LitLayer, LitParams, Method, OctaveParams, ParamError, SkyModel,
    SkyParams, SpriteParams, WeatherParams,
};
pub use perez::{PerezParams, PerezShape};
pub use renderer::{DepthConfig, Sky, SkyConfig};
pub use shadow::Shadow;
