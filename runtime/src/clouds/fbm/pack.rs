//! Re-packs the octaves of the fbm method when the sun has moved.
//!
//! # Theory
//! I. Quilez, "Dynamic Clouds", 2005: the red, green and blue channels of an octave hold its noise displaced by three, two
//! and one steps of the ray towards the sun, "projected into the dome". The ray rises by 0.3 of the height of the clouds a
//! step, so a step is `0.3 h / tan(elevation)` long on the ground.
//!
//! # Changes versus the article
//! There the sun stands still and the channels are baked. Here a pass fills them anew whenever the sun has moved into
//! another cell of [`CELL_RAD`](crate::clouds::march::CELL_RAD), a sixteenth of a degree of azimuth and of elevation, for the middle of that cell. The third step
//! then moves by `3 STEP_TILES CELL_RAD / sin^2(elevation)` at most, 0.07 of a texel of 256 where steps are longest. What a picture
//! changes by is hardly more than the rounding of eight bits ([`SHADE_BYTES`]).
//!
//! # Practice
//! Four bilinear reads a texel and layer, every ten seconds or so when a day takes a day. What is packed follows from the sun's
//! direction alone, never from where it was before.

use glam::{DVec2, Vec2, Vec3};

use crate::clouds::march::SunCell;
use crate::device::context::{Context, Shader};
use crate::device::map;
use crate::geometry::part::Part;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[],
    structs: &[],
    wgsl: include_str!("pack.wgsl"),
};

/// The most, in steps of a byte, that the shade in the map changes when octaves are packed anew, at the default sharpness.
///
/// Each of three channels is rounded anew, by a step at most; `m` and the absorption of the march make 6.7 of it, the step's own
/// movement adds one. Hardly a texel comes near: ninety-nine in a hundred change by two at most.
pub const SHADE_BYTES: f32 = 8.0;

/// A step with the sun at 45 degrees, in tiles: that of the pack's own channels.
pub const STEP_TILES: f64 = 1.0 / welkin_pack::mapping::FBM_STEPS_A_TILE as f64;

/// The longest step, with a low sun, in tiles: more, and single steps would show.
const LONGEST_STEP_TILES: f64 = 1.0 / 26.0;

/// A step towards the sun in tiles of the map, which is turned by `turn_rad`.
pub fn step(sun: Vec3, turn_rad: f64) -> Vec2 {
    let cell = SunCell::of(sun);
    let length = (STEP_TILES / cell.elevation_rad.max(0.01).tan()).clamp(0.0, LONGEST_STEP_TILES);
    (DVec2::from_angle(turn_rad).rotate(cell.towards) * length).as_vec2()
}

/// The pass on a device.
#[derive(Debug)]
pub(crate) struct Pass {
    texture: wgpu::Texture,
    /// Its layers as targets.
    layers: Vec<wgpu::TextureView>,
    /// The pack's texture. GL reads arrays whole, never a layer alone.
    source: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
    /// The step that the channels hold now.
    packed_for: Option<Vec2>,
}

impl Pass {
    /// `octaves` is the pack's texture.
    pub fn new(context: &Context, shader: &Shader, octaves: &wgpu::Texture) -> Pass {
        let (device, layouts) = (&context.device, &context.layouts);
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let count = octaves.depth_or_array_layers();
        let size = [octaves.width(), octaves.height(), count];
        let texture = map::target(device, "fbm octaves", format, size, 1);
        let layer = |layer: u32| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: layer,
                array_layer_count: Some(1),
                ..Default::default()
            })
        };
        Pass {
            layers: (0..count).map(layer).collect(),
            source: layouts.layers_group(device, octaves),
            pipeline: context.off_screen(shader, "fs_fbm_pack", &layouts.layers, format),
            packed_for: None,
            texture,
        }
    }

    /// The octaves, packed.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.texture
    }

    /// Records the pass, if the channels hold another step.
    pub fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        step: Vec2,
    ) {
        if self.packed_for == Some(step) {
            return;
        }
        for target in self.layers.iter().zip(0..) {
            map::draw_layer(encoder, target, &self.pipeline, [shared, &self.source]);
        }
        self.packed_for = Some(step);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clouds::march::{CELL_RAD, sun};

    #[test]
    fn the_packs_own_channels_are_for_a_sun_in_the_east_at_45_degrees() {
        let [x, y] = step(sun(90.0, 45.1), 0.0).as_dvec2().to_array();
        // Half a cell is 0.25 degrees: a turn by it, and the cotangent's change.
        assert!(
            (x - STEP_TILES).abs() < 0.01 * STEP_TILES && y.abs() < 0.01 * STEP_TILES,
            "{x} {y}"
        );
    }

    #[test]
    fn steps_point_to_the_sun_and_shrink_as_it_rises() {
        let mut last = f32::INFINITY;
        for elevation in [-20.0, 0.0, 15.0, 30.0, 60.0, 85.0] {
            let Vec2 { x, y } = step(sun(180.0, elevation), 0.0);
            assert!(y > 0.0 && x.abs() < 0.01 * y, "south at {elevation}");
            assert!(y <= last, "{elevation}");
            last = y;
        }
    }

    #[test]
    fn a_sun_that_moves_less_than_a_cell_changes_nothing_and_one_that_moves_more_does() {
        let at = |azimuth: f32| step(sun(azimuth, 30.1), 0.5);
        assert_eq!(at(120.01), at(120.05));
        assert_ne!(at(120.01), at(120.07));
        // A turn by one cell moves the third step by 3 cells of angle times its length.
        let [a, b] = [at(120.01), at(120.07)].map(|step| step.as_dvec2());
        assert!((a - b).length() < 1.01 * CELL_RAD * a.length());
    }
}
