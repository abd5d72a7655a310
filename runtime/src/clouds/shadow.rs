//! Shadows that clouds throw on the ground, for the application's own shaders.
//!
//! # Theory
//! Light from sun or moon comes to a place as far as a viewer who stands there sees them through the clouds: the product of what the layers leave
//! open, `1 - C_i`, in that one direction. No paper has the shadows of clouds on the ground; Mukhina and Bezgodov (see [`crate::clouds::lit`])
//! shade clouds by clouds with the same coverages (eq. 5).
//!
//! Each method says what its layers hide of a direction (`NAME_hidden` in its WGSL) from where the viewer stands: a place so many metres away
//! sees a layer so many of its heights moved. Sprites are drawn from the sun onto the ground, each multiplying what it leaves of the light
//! (`crate::sprites::cast`).
//!
//! # What is left out
//! - The viewer's dome goes with the viewer. So the shadow of a cloud lies where a viewer has that cloud before the sun, and
//!   on a plane ground, height 0, all shadows of a layer are as far from their clouds.
//! - Sides of clouds of `lit` shade as a viewer sees them before the sun.
//! - Clouds of domes fade into the haze of the horizon, and their shadows with them: light from below the horizon meets no cloud. Sprites throw shadows
//!   as far as the viewer sees them.
//! - The sun is a point, its penumbra left out: of clouds 1 km high it is 9 m wide.
//!
//! # Practice
//! A texture of 256x256 R8 texels, drawn off screen with the reads of a pixel a texel. Rows go from north to south, columns from west to
//! east; the middle of texel (i, j) is at `centre + extent ((i + 0.5) / 256 - 0.5)`, and so on for j. The centre is the viewer's place,
//! moved to whole texels: as the viewer walks, shadows stay where they are. A level of detail is chosen for the texels.
//!
//! ```no_run
//! # fn f(device: &wgpu::Device, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, sky: &mut welkin_runtime::Sky, uniforms: &wgpu::Buffer, layout: &wgpu::BindGroupLayout, sampler: &wgpu::Sampler) {
//! use welkin_runtime::shadow;
//! use welkin_runtime::{Camera, SkyParams};
//! // Once: the function joins the shader of the ground, which multiplies its direct light by
//! // cloud_shadow(shadow_map, linear_clamp_sampler, ground.shadow_area, position.xz)
//! let ground = format!("{}\n{}", shadow::WGSL, "/* the application's shader */");
//! # drop(ground);
//! // Each frame:
//! let params = SkyParams { shadow_extent_m: 8000.0, ..SkyParams::default() };
//! sky.prepare(queue, encoder, &params, &Camera::looking(0.0, 0.1, 1.0, [1280, 720]), 12.5);
//! if let Some(shadow) = sky.shadow() {
//!     queue.write_buffer(uniforms, 0, bytemuck::bytes_of(&shadow.area()));
//!     // The texture stays the same from frame to frame, so this group may be kept.
//!     let view = shadow.texture.create_view(&wgpu::TextureViewDescriptor::default());
//!     device.create_bind_group(&wgpu::BindGroupDescriptor {
//!         label: Some("ground"),
//!         layout,
//!         entries: &[
//!             wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) },
//!             wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(sampler) },
//!         ],
//!     });
//! }
//! # }
//! ```

use glam::{DVec2, DVec3, Vec2, Vec3, Vec3Swizzles};

use crate::clouds::shared::CloudView;
use crate::device::map::target;
use crate::geometry::dome;
use crate::geometry::part::Part;
use crate::geometry::uniforms::uniforms;
use crate::params::{MAX_LAYERS, SkyParams};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[],
    structs: &[ShadowLayer::WGSL, ShadowUniforms::WGSL],
    wgsl: include_str!("shadow.wgsl"),
};

uniforms! {
    /// What a viewer at a place of the ground sees of a layer towards sun or moon.
    ShadowLayer {
        /// Where in the corner of the texture, on the dome's plane.
        corner: Vec2,
        /// What a texel adds.
        texel: f32,
        /// Level of detail.
        lod: f32,
    }

    /// Shadows of the clouds of the method that is shown.
    ShadowUniforms {
        /// Of each layer.
        layers: [ShadowLayer; MAX_LAYERS],
        /// Nothing.
        _pad: Vec3,
        /// Share of the light that an overcast behind them hides.
        shut: f32,
    }
}

/// Texels a side.
pub const SIDE: u32 = 256;

/// WGSL of `cloud_shadow(map, map_sampler, area, position_m)`, for the application's shaders: the share of direct light that
/// the clouds leave at a place on the ground, in metres to the east and to the south of the world's origin.
pub const WGSL: &str = include_str!("cloud_shadow.wgsl");

/// Width of the square's edge, in which shadows fade, as a share of its side.
const EDGE: f32 = 0.05;

/// A prepared frame's shadows: see [`crate::Sky::shadow`].
#[derive(Clone, Copy, Debug)]
pub struct Shadow<'a> {
    /// [`SIDE`]x[`SIDE`] texels, `R8Unorm`: 1 where all of the direct light comes through, 0 where none does. It may be
    /// read by shaders and copied from, and is the same texture in every frame of a view, whatever the method.
    pub texture: &'a wgpu::Texture,
    /// Middle of the square that it covers: metres to the east and to the south of the world's origin.
    pub centre_m: [f32; 2],
    /// Side of the square in metres.
    pub extent_m: f32,
}

impl Shadow<'_> {
    /// What `cloud_shadow` of [`WGSL`] wants to know: the middle, the side, and the width of the edge, all in metres.
    pub fn area(&self) -> [f32; 4] {
        let [east, south] = self.centre_m;
        [east, south, self.extent_m, EDGE * self.extent_m]
    }
}

/// The square that a frame's shadows cover.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Area {
    /// Its middle: metres to the east and to the south.
    pub centre_m: DVec2,
    /// Its side in metres.
    pub extent_m: f64,
}

impl Area {
    /// The square of a frame, if it has one. `params` are in range, the viewer's place is in metres.
    pub fn of(params: &SkyParams, place_m: DVec3) -> Option<Area> {
        let place_m = DVec2::new(place_m.x, place_m.z);
        (params.shadow_extent_m > 0.0).then(|| Area::about(place_m, params.shadow_extent_m))
    }

    /// The square about a place: its middle lies on whole texels.
    pub fn about(place_m: DVec2, extent_m: f32) -> Area {
        let extent_m = f64::from(extent_m);
        let texel_m = extent_m / f64::from(SIDE);
        Area {
            centre_m: (place_m / texel_m).round() * texel_m,
            extent_m,
        }
    }

    /// Side of a texel in metres.
    pub fn texel_m(&self) -> f64 {
        self.extent_m / f64::from(SIDE)
    }
}

/// The layers of a method, as its shader asks for their shadows.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Layers {
    /// Where sun or moon is seen on the dome's plane, in its heights: east and south.
    pub light: DVec2,
    /// Heights over the ground in metres; 0 for those that there are not.
    pub heights_m: [f64; MAX_LAYERS],
}

impl Layers {
    /// Layers of these heights on the dome of [`crate::geometry::dome`].
    pub fn of_dome(sun: Vec3, heights_m: impl IntoIterator<Item = f64>) -> Layers {
        Layers::new(dome::intersect(sun).position.xz(), heights_m)
    }

    /// Layers of these heights, at most [`MAX_LAYERS`].
    pub fn new(light: Vec2, heights_m: impl IntoIterator<Item = f64>) -> Layers {
        let mut layers = Layers {
            light: light.as_dvec2(),
            ..Layers::default()
        };
        for (slot, height_m) in layers.heights_m.iter_mut().zip(heights_m) {
            *slot = height_m;
        }
        layers
    }
}

/// The shadows' share of the uniforms, all 0 without any. `params` are in range; see [`ShadowUniforms`] for `shut`.
pub(crate) fn uniforms(
    params: &SkyParams,
    view: &CloudView,
    layers: &Layers,
    shut: f32,
) -> ShadowUniforms {
    let Some(area) = Area::of(params, view.place_m) else {
        return ShadowUniforms::default();
    };
    let mut shadow = ShadowUniforms {
        shut,
        ..ShadowUniforms::default()
    };
    let viewer_m = DVec2::new(view.place_m.x, view.place_m.z);
    let corner_m = area.centre_m - viewer_m - 0.5 * area.extent_m;
    let heights_m = layers.heights_m.iter().filter(|height_m| **height_m > 0.0);
    for (seen, &height_m) in shadow.layers.iter_mut().zip(heights_m) {
        // The layer's axes are for a viewer who is so near to it; the ground is at height 0.
        let near = view.distance(height_m);
        let texel = area.texel_m() / (height_m * near);
        *seen = ShadowLayer {
            corner: ((layers.light + corner_m / height_m) / near).as_vec2(),
            texel: texel as f32,
            // What a layer adds to levels is for a pixel.
            lod: (texel / f64::from(view.pixel_rad)).log2() as f32,
        };
    }
    shadow
}

/// The format of the shadows.
pub(crate) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

/// What the shadows are drawn into.
#[derive(Debug)]
pub(crate) struct Target {
    pub texture: wgpu::Texture,
    pub view: wgpu::TextureView,
}

impl Target {
    pub fn new(device: &wgpu::Device) -> Target {
        let texture = target(device, "cloud shadows", FORMAT, [SIDE, SIDE, 1], 1);
        Target {
            view: texture.create_view(&wgpu::TextureViewDescriptor::default()),
            texture,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_square_goes_with_the_viewer_by_whole_texels() {
        let texel_m = 8000.0 / f64::from(SIDE);
        let mut last = Area::about(DVec2::ZERO, 8000.0).centre_m;
        for step in 0..1000 {
            let place = DVec2::new(f64::from(step) * 7.3, -1e5 + f64::from(step) * 3.1);
            let centre = Area::about(place, 8000.0).centre_m;
            assert!((centre - place).abs().max_element() <= 0.5 * texel_m + 1e-9);
            let moved = (centre - last) / texel_m;
            assert!((moved - moved.round()).abs().max_element() < 1e-6, "{step}");
            last = centre;
        }
    }

    #[test]
    fn the_applications_function_is_valid() {
        let use_of_it = "
            @group(0) @binding(0) var map: texture_2d<f32>;
            @group(0) @binding(1) var map_sampler: sampler;
            @group(0) @binding(2) var<uniform> area: vec4f;
            @fragment fn fs(@location(0) place: vec2f) -> @location(0) vec4f {
                return vec4f(cloud_shadow(map, map_sampler, area, place));
            }";
        let text = format!("{WGSL}{use_of_it}");
        let module = naga::front::wgsl::parse_str(&text)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
        naga::valid::Validator::new(
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::empty(),
        )
        .validate(&module)
        .expect("valid without any extension");
    }
}
