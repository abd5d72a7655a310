//! What the runtime asks of a method.

use std::fmt::Debug;

use glam::Vec3;
use welkin_pack::Role;

use crate::clear_sky::light::Light;
use crate::clouds::coverage::Distributions;
use crate::clouds::shadow::Layers;
use crate::clouds::shared::{self, CloudView, MeanCloud};
use crate::device::context::{Context, Shader};
use crate::device::layouts::Layouts;
use crate::frame::Uniforms;
use crate::geometry::part::Part;
use crate::pack_data::PackData;
use crate::params::{Shading, SkyParams};

/// A method, as the rest of the runtime sees it.
pub(crate) trait CloudMethod: Sync {
    /// The pack's texture that this method alone reads.
    fn role(&self) -> Role;

    /// Whether its texture is uploaded for it alone. The packed texture is in the group that all share, and the octaves' noise stays on
    /// the CPU.
    fn uploads(&self) -> bool {
        false
    }

    /// Its parts of the shader.
    fn parts(&self) -> &'static [Part];

    /// Whether its clouds are often opaque, so that to ask first pays.
    fn is_often_opaque(&self) -> bool {
        true
    }

    /// The layout of group 1 of its dome, if it has one.
    fn own_layout<'a>(&self, _layouts: &'a Layouts) -> Option<&'a wgpu::BindGroupLayout> {
        None
    }

    /// Its off-screen pass, if it has one.
    fn map(
        &self,
        _context: &Context,
        _shader: &Shader,
        _params: &SkyParams,
    ) -> Option<Box<dyn MapPass>> {
        None
    }

    /// Writes its share of the uniforms. What all clouds share is there already.
    fn write(&self, uniforms: &mut Uniforms, frame: &MethodFrame<'_>);

    /// The layers that its shader asks for the shadows of. Its uniforms are written.
    fn shadow_layers(&self, frame: &MethodFrame<'_>, uniforms: &Uniforms) -> Layers;

    /// Share of the direct light that the overcast behind its clouds keeps from the ground. Domes shut the sky by their clouds.
    fn shut(&self, _params: &SkyParams) -> f32 {
        0.0
    }

    /// How overcast the sky behind is, 0..1.
    fn overcast_weight(&self, params: &SkyParams, _viewer_m: f32, _pack: &PackData) -> f32 {
        shared::overcast_weight(params.cover)
    }

    /// Radiance of an overcast far away, where single clouds cannot be told apart.
    fn overcast(&self, params: &SkyParams, uniforms: &Uniforms, pack: &PackData) -> Vec3;

    /// Share of the sunlight of [`CloudMethod::mean`] that its clouds send along a unit direction.
    fn facing(
        &self,
        params: &SkyParams,
        uniforms: &Uniforms,
        direction: Vec3,
        _opacity: f32,
    ) -> f32 {
        let cosine = direction.dot(uniforms.sky.sun_direction);
        match params.shading {
            Shading::Scattered => shared::scattered_facing(&uniforms.clouds, cosine),
            Shading::Paper => 1.0,
        }
    }

    /// Its clouds on average, where [`CloudMethod::facing`] is 1.
    fn mean(&self, params: &SkyParams, uniforms: &Uniforms, pack: &PackData) -> MeanCloud;

    /// The fraction of the sky in which its clouds have more than this opacity.
    fn covered(&self, shown: &Shown<'_>, opacity: f32) -> f32;
}

/// The off-screen pass of a method.
pub(crate) trait MapPass: Debug + wgpu::WasmNotSendSync {
    /// Makes its textures anew if the parameters want others.
    fn ensure(&mut self, _context: &Context, _params: &SkyParams) {}

    /// Records the passes of a frame.
    fn record(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        frame: &MapFrame<'_>,
    );

    /// Group 1 of the dome.
    fn group(&self) -> &wgpu::BindGroup;

    /// The map itself.
    fn texture(&self) -> &wgpu::Texture;

    /// Bytes of all its textures.
    fn bytes(&self) -> u64;
}

/// What a method's uniforms are computed from.
pub(crate) struct MethodFrame<'a> {
    /// In range. Those of the dome: see [`SkyParams::dome`].
    pub params: &'a SkyParams,
    /// In range, as the user set them.
    pub clamped: &'a SkyParams,
    pub view: CloudView,
    pub light: Light,
    /// Light of a flash of lightning; only what is drawn over the dome may read it.
    pub flash: Vec3,
    pub pack: &'a PackData,
}

/// What the fraction of the sky that clouds cover follows from.
pub(crate) struct Shown<'a> {
    /// In range.
    pub params: &'a SkyParams,
    pub uniforms: &'a Uniforms,
    pub texels: &'a Distributions,
}

/// What a method's map is drawn from.
pub(crate) struct MapFrame<'a> {
    /// In range.
    pub params: &'a SkyParams,
    pub seconds: f64,
    pub uniforms: &'a Uniforms,
    pub pack: &'a PackData,
}
