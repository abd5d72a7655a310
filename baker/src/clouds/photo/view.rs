//! What of a photograph is looked at, and how it becomes a square seen from below.

use welkin_pack::Image;

use super::projection::{self, Camera, Square};
use super::{horizon, part};
use crate::error::{BakeError, unfit};
use crate::filter;
use crate::settings::{PhotoProjection, PhotoSettings};

/// The smallest side of the part of a picture that shows the square, in texels: less holds no cloud.
const LEAST_SIDE: u32 = 64;

/// Points a side of the outline.
const OUTLINE: u32 = 512;

/// How the square of a photograph is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum View {
    /// Texel by texel: left, top, width and height of a square.
    Flat([u32; 4]),
    /// By the camera that saw it.
    Projected {
        camera: Camera,
        square: Square,
        bounds: [u32; 4],
    },
}

impl View {
    pub fn of(picture: &Image, file: &str, settings: &PhotoSettings) -> Result<View, BakeError> {
        let size = [picture.width, picture.height];
        let camera = match settings.projection {
            PhotoProjection::Plan => {
                return part::square(&settings.region, picture, file).map(View::Flat);
            }
            PhotoProjection::Perspective { fov_rad, horizon } => {
                let horizon = match horizon {
                    Some(share) => f64::from(share),
                    None => horizon::find(picture).ok_or_else(|| no_horizon(file))?,
                };
                Camera::pinhole(size, fov_rad.into(), horizon)
            }
            PhotoProjection::Equirect { horizon } => {
                let horizon = horizon.map(f64::from).or_else(|| usual_horizon(size));
                Camera::equirect(size, horizon.ok_or_else(|| no_panorama(file, size))?)
            }
        };
        let region = part::whole(&settings.region, picture, file)?;
        let square = projection::largest_square(&camera, region);
        let bounds = square.map(|square| (square, square.bounds(&camera, region)));
        match bounds {
            Some((square, bounds)) if bounds[2].min(bounds[3]) >= LEAST_SIDE => {
                Ok(View::Projected {
                    camera,
                    square,
                    bounds,
                })
            }
            _ => {
                let found = bounds.map_or_else(
                    || "none".to_string(),
                    |(_, [_, _, width, height])| format!("{width}x{height} texels"),
                );
                let expected = format!(
                    "{LEAST_SIDE} texels a side or more that are 15 degrees above the horizon; correct `horizon` and `fov_deg`, or choose a picture of more sky"
                );
                Err(unfit(file, "sky", found, expected))
            }
        }
    }

    /// One channel of a picture, `size` texels a side.
    pub fn taken(&self, image: &Image, channel: usize, size: u32) -> Image {
        match self {
            View::Flat(region) => filter::resample(&part::cut(image, *region, channel), size, size),
            View::Projected { camera, square, .. } => {
                projection::unprojected(image, channel, camera, square, size)
            }
        }
    }

    /// Points of the picture on the outline of the square.
    pub fn outline(&self) -> Vec<[f32; 2]> {
        let share = (0..OUTLINE).map(|i| (f64::from(i) + 0.5) / f64::from(OUTLINE));
        let edges = share.flat_map(|t| [[t, 0.0], [t, 1.0], [0.0, t], [1.0, t]]);
        let place = |uv: [f64; 2]| match self {
            View::Flat([left, top, width, height]) => Some([
                f64::from(*left) + f64::from(*width) * uv[0],
                f64::from(*top) + f64::from(*height) * uv[1],
            ]),
            View::Projected { camera, square, .. } => camera.seen(square.at(uv)),
        };
        let seen = edges.filter_map(place);
        seen.map(|place| place.map(|v| v as f32)).collect()
    }

    /// The part of the picture that is used: left, top, width, height.
    pub fn bounds(&self) -> [u32; 4] {
        match self {
            View::Flat(bounds) | View::Projected { bounds, .. } => *bounds,
        }
    }
}

/// A whole sphere is twice as wide as high, its upper half four times.
fn usual_horizon([width, height]: [u32; 2]) -> Option<f64> {
    match width {
        _ if width == 2 * height => Some(0.5),
        _ if width == 4 * height => Some(1.0),
        _ => None,
    }
}

fn no_horizon(file: &str) -> BakeError {
    let expected = "a row at which sky meets ground; give `clouds.photo.horizon`, its share of the height from above, which is more than 1 where the horizon is below the picture";
    unfit(file, "horizon", "not found", expected)
}

fn no_panorama(file: &str, [width, height]: [u32; 2]) -> BakeError {
    let expected = "a panorama twice as wide as high, or four times if it ends at the horizon; give `clouds.photo.horizon` for another";
    unfit(file, "size", format!("{width}x{height}"), expected)
}
