//! Shadows of sprites on the ground.
//!
//! # Theory
//! A sprite that faces the sun is laid on the ground along the sun's light, and multiplies what it leaves of that: what a viewer there sees of
//! the sun. The article has no shadows on the ground.
//!
//! # Practice
//! A draw for each block whose light falls on the square, into the texture of [`crate::clouds::shadow`], over the shadows of the dome
//! behind. Blocks farther from the viewer than sight throw none, and so does a sun lower than [`LEAST_SINE`].

use glam::{DVec2, DVec3, Vec3, Vec4};
use welkin_pack::field::SECTION_SIDE_M;

use super::frame::{Frame, cell_texels};
use super::grid::BlockId;
use super::station::SpriteView;
use super::wind::{in_field, lift_m};
use crate::clouds::shadow::Area;

/// The lowest sun that throws shadows, as the sine of its elevation: clouds 1 km high throw theirs 29 km far.
const LEAST_SINE: f32 = 0.035;

/// The square that shadows fall on, and the light that throws them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cast {
    area: Area,
    /// What a metre of height moves a shadow by: east and south, m.
    slope: DVec2,
    /// The middle of the square in the field: east and south, m.
    centre_m: DVec2,
    /// How high the field is lifted, m.
    lift_m: f64,
}

impl Cast {
    /// That of a frame, if it has shadows.
    pub fn of(frame: &Frame<'_>) -> Option<Cast> {
        let sun = frame.look.light_direction;
        let area = Area::of(frame.params, frame.camera.position_m().as_dvec3())?;
        let centre_m = DVec3::new(area.centre_m.x, 0.0, area.centre_m.y);
        let centre_m = in_field(frame.params, centre_m, frame.seconds);
        (sun.y >= LEAST_SINE).then(|| Cast {
            area,
            slope: -DVec2::new(sun.x.into(), sun.z.into()) / f64::from(sun.y),
            centre_m: DVec2::new(centre_m.x, centre_m.z),
            lift_m: lift_m(frame.params),
        })
    }

    /// Whether clouds of a block between two heights of the field, in metres, may throw shadows on the square. They reach so far over its sides.
    pub fn meets(&self, block: BlockId, heights_m: [f64; 2], overhang_m: f64) -> bool {
        let [low, high] = heights_m.map(|height_m| (height_m + self.lift_m) * self.slope);
        let from = block.corner_m() + low.min(high) - overhang_m;
        let to = block.corner_m() + low.max(high) + f64::from(SECTION_SIDE_M) + overhang_m;
        let half = 0.5 * self.area.extent_m;
        from.cmplt(self.centre_m + half).all() && to.cmpgt(self.centre_m - half).all()
    }

    /// The view that lays what stands about the viewer on the ground.
    pub fn view(&self, frame: &Frame<'_>, sheet: &wgpu::Texture) -> SpriteView {
        let viewer_m = frame.camera.position_m().as_dvec3();
        let from_viewer = self.area.centre_m - DVec2::new(viewer_m.x, viewer_m.z);
        let start = viewer_m.y * self.slope - from_viewer;
        // Columns go from west to east, rows from north to south.
        let scale = 2.0 / self.area.extent_m;
        let row = |axis: Vec3, slope: f64, start: f64| -> Vec4 {
            let along = axis.as_dvec3() + slope * DVec3::Y;
            (scale * along.extend(start)).as_vec4()
        };
        SpriteView {
            clip_x: row(Vec3::X, self.slope.x, start.x),
            clip_y: -row(Vec3::Z, self.slope.y, start.y),
            height_m: viewer_m.y as f32,
            texel_m: self.area.texel_m() as f32,
            cell_texels: cell_texels(sheet),
            ..Default::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cast(slope: DVec2) -> Cast {
        Cast {
            area: Area::about(DVec2::ZERO, 2000.0),
            slope,
            centre_m: DVec2::ZERO,
            lift_m: 0.0,
        }
    }

    /// The blocks that meet the square, of those from -3 to 3.
    fn met(cast: &Cast, heights_m: [f64; 2]) -> Vec<[i64; 2]> {
        let blocks = (-3..4).flat_map(|south| (-3..4).map(move |east| BlockId { east, south }));
        let met = blocks.filter(|block| cast.meets(*block, heights_m, 0.0));
        met.map(|block| [block.east, block.south]).collect()
    }

    #[test]
    fn blocks_throw_their_shadows_away_from_the_sun() {
        let above = met(&cast(DVec2::ZERO), [1000.0, 2000.0]);
        assert_eq!(above, [[-1, -1], [0, -1], [-1, 0], [0, 0]]);
        // The sun in the west, at 45 degrees: shadows lie 4 to 5 km to the east of their clouds.
        let west = met(&cast(DVec2::new(1.0, 0.0)), [4000.0, 5000.0]);
        assert_eq!(west, [[-2, -1], [-1, -1], [-2, 0], [-1, 0]]);
    }
}
