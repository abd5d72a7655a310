//! The map of the packed method: its photo here and at three places towards the sun.
//!
//! # Theory
//! I. Quilez, "Dynamic Clouds", 2005, has four channels hold a cloud's height here and at three places towards the sun, so that one read
//! tells what the light has passed. Here the places lie farther and farther apart, and the farther, the wider the share of the photo that is
//! read, by its level: a cone of light, not a ray.
//!
//! # Practice
//! Three trilinear reads and one bilinear a texel of the photo's, and its levels; drawn anew when the sun has moved by a cell
//! ([`crate::clouds::march`]) or the clouds' height has changed. Channels: RGB the photo at the places, A here.

use glam::{DVec2, Vec2, Vec3};

use crate::clouds::march::SunCell;
use crate::device::context::{Context, Shader};
use crate::device::map::{FORMAT, LEAST_SIDE, Map};
use crate::geometry::part::{Part, Value};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[("PACKED_PLACES", Value::Vec3(PLACES))],
    structs: &[],
    wgsl: include_str!("map.wgsl"),
};

/// Most texels a side: a photo of 4096 is halved.
pub const MOST_SIDE: u32 = 2048;

/// Where the places lie, against the first.
pub const PLACES: Vec3 = Vec3::new(1.0, 2.5, 5.5);

/// The first one with the sun at 45 degrees, in heights of the layer: so high the ray has risen there.
pub const RISE: f64 = 0.04;

/// The least tangent of the sun's elevation: a lower sun throws no longer shadows.
const LEAST_TANGENT: f64 = 0.25;

/// Share of the way to the place before it that a place stands for.
const WIDTH: f64 = 0.5;

/// The way to the first place in heights of the layer (east, south).
pub(crate) fn step(sun: Vec3) -> DVec2 {
    let cell = SunCell::of(sun);
    cell.towards * (RISE / cell.elevation_rad.tan().max(LEAST_TANGENT))
}

/// Levels of the photo at the places; `step_texels` is the length of the way to the first.
pub(crate) fn levels(step_texels: f64) -> Vec3 {
    let ways = [PLACES.x, PLACES.y - PLACES.x, PLACES.z - PLACES.y];
    let level = |way: f32| (step_texels * WIDTH * f64::from(way)).max(1.0).log2();
    Vec3::from(ways.map(|way| level(way) as f32))
}

/// The pass on a device.
#[derive(Debug)]
pub(crate) struct Pass {
    map: Map,
    pipeline: wgpu::RenderPipeline,
    /// Group 1 of the dome.
    pub group: wgpu::BindGroup,
    /// The step that it holds now.
    drawn_for: Option<Vec2>,
}

impl Pass {
    /// For a photo of this many texels a side.
    pub fn new(context: &Context, shader: &Shader, texels: u32) -> Pass {
        let (device, layouts) = (&context.device, &context.layouts);
        let side = texels.clamp(LEAST_SIDE, MOST_SIDE);
        let averaging = context.off_screen(shader, "fs_level", &layouts.texture, FORMAT);
        let map = Map::new(device, layouts, vec![averaging], [side, 1]);
        let view = map.texture.create_view(&Default::default());
        Pass {
            pipeline: context.off_screen(shader, "fs_packed_map", None, FORMAT),
            group: layouts.texture_group(device, &view),
            map,
            drawn_for: None,
        }
    }

    /// Records the pass, if the map holds another step.
    pub fn draw(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        step: Vec2,
    ) {
        if self.drawn_for != Some(step) {
            self.map.record(encoder, shared, (0, &self.pipeline), None);
            self.drawn_for = Some(step);
        }
    }

    /// The map itself.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.map.texture
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clouds::march::sun;

    #[test]
    fn places_lie_towards_the_sun_and_come_nearer_as_it_rises() {
        let mut last = f64::INFINITY;
        for elevation in [-20.0, 0.0, 15.0, 45.0, 60.0, 85.0] {
            let DVec2 { x, y } = step(sun(90.0, elevation));
            // A cell is a sixteenth of a degree.
            assert!(x > 0.0 && y.abs() < 0.002 * x, "east at {elevation}");
            assert!(x <= last, "{elevation}");
            last = x;
        }
        let half_way = step(sun(180.0, 45.0)).length();
        assert!((half_way / RISE - 1.0).abs() < 3e-3, "{half_way}");
    }

    #[test]
    fn what_is_farther_is_read_wider() {
        let levels = levels(8.0);
        // Half of 8, 12 and 24 texels.
        let expected = Vec3::new(2.0, 6.0_f32.log2(), 12.0_f32.log2());
        assert!((levels - expected).abs().max_element() < 1e-5, "{levels}");
        assert_eq!(super::levels(0.1), Vec3::ZERO);
    }
}
