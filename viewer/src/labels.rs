//! The truth beside a picture: how opaque its clouds are, pixel by pixel, how much of the sky they cover, where sun and moon stand, and the light.
//!
//! # Practice
//! Opacity is drawn by the same shaders as the picture ([`welkin_runtime::Sky::of_opacity`]), so it is that of the picture's own clouds. Rain, its haze, rays and flashes are no
//! clouds. Where it is 0 the picture shows what is behind the clouds, where it is 1 nothing of it; of the sun's own light clouds leave the cube of what they leave of the rest.

use std::f32::consts::FRAC_PI_2;

use half::f16;
use serde::Serialize;
use welkin_pack::mapping::angles_from_direction;
use welkin_runtime::glam::{Vec2, Vec3};
use welkin_runtime::internals::clouds::shared::OPAQUE;
use welkin_runtime::internals::geometry::camera;
use welkin_runtime::internals::oktas::LEAST_SINE;
use welkin_runtime::{Camera, Luminary, SkyLight, SkyParams};

use crate::export::equirect::direction_to_equirect;
use crate::frame::{Frame, Pixels};

/// Opacity of every pixel of a picture, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Opacity {
    size: [u32; 2],
    values: Vec<f16>,
}

impl Opacity {
    /// What a sky of opacity has drawn.
    pub fn of(frame: &Frame) -> Opacity {
        let values = match &frame.pixels {
            Pixels::Linear(pixels) => pixels.iter().map(|pixel| pixel[0]).collect(),
            Pixels::Srgb8(_) | Pixels::Share8(_) => Vec::new(),
        };
        Opacity {
            size: [frame.width, frame.height],
            values,
        }
    }

    /// As a picture: byte 0 only where there is no cloud at all, 255 only where nothing shows through; else the nearest of 1 to 254.
    pub fn picture(&self) -> Frame {
        self.bytes(|opacity| match opacity {
            ..=0.0 => 0,
            1.0.. => 255,
            _ => (255.0 * opacity).round().clamp(1.0, 254.0) as u8,
        })
    }

    /// What counts as cloud, as oktas count it (docs/cover.md): byte 255 where opacity is above 0.1, and else 0.
    pub fn mask(&self) -> Frame {
        self.bytes(|opacity| if opacity > OPAQUE { 255 } else { 0 })
    }

    fn bytes(&self, byte: impl Fn(f32) -> u8) -> Frame {
        let bytes = self.values.iter().map(|opacity| byte(opacity.to_f32()));
        Frame {
            width: self.size[0],
            height: self.size[1],
            pixels: Pixels::Share8(bytes.collect()),
        }
    }

    /// At a place in pixels from the upper left corner, if it is in the picture.
    pub fn at(&self, [x, y]: [f32; 2]) -> Option<f32> {
        let [width, height] = self.size.map(|side| side as f32);
        let is_inside = (0.0..width).contains(&x) && (0.0..height).contains(&y);
        let index = y as usize * self.size[0] as usize + x as usize;
        let value = self.values.get(index).filter(|_| is_inside)?;
        Some(value.to_f32())
    }
}

/// Where a picture has a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// A frame of a camera.
    Frame(Camera),
    /// A panorama of so many columns, with this azimuth in its middle.
    Equirect(u32, f32),
}

impl Projection {
    /// A place in pixels from the upper left corner; none of what is below the horizon, or not in the picture.
    pub fn pixel_of(&self, direction: Vec3) -> Option<[f32; 2]> {
        if direction.y <= 0.0 {
            return None;
        }
        let (place, size) = match self {
            Projection::Frame(view) => {
                let place = camera::uniforms(view).pixel_of(direction)?;
                (place, view.viewport_px)
            }
            Projection::Equirect(width, azimuth_rad) => {
                let size = [*width, width / 2];
                let uv = direction_to_equirect(direction.to_array(), *azimuth_rad);
                (Vec2::from(uv) * Vec2::from(size.map(|s| s as f32)), size)
            }
        };
        let [width, height] = size.map(|side| side as f32);
        let is_inside = (0.0..width).contains(&place.x) && (0.0..height).contains(&place.y);
        is_inside.then_some(place.to_array())
    }
}

/// The sun or the moon in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Seen {
    /// Unit direction towards it: east, up, south.
    pub direction: [f32; 3],
    /// From north towards east.
    pub azimuth_deg: f32,
    /// Of what is seen through the air.
    pub elevation_deg: f32,
    /// Where its middle is, in pixels from the upper left corner, if that is in the picture and above the horizon.
    pub pixel: Option<[f32; 2]>,
    /// Opacity of the clouds there.
    pub opacity: Option<f32>,
    /// Whether its disc is drawn, its middle in the picture above the horizon, and no cloud before it that counts as one.
    pub visible: bool,
}

impl Seen {
    fn of(from: &Luminary, has_disc: bool, projection: &Projection, opacity: &Opacity) -> Seen {
        let (azimuth, elevation) = angles_from_direction(from.direction.to_array());
        let pixel = projection.pixel_of(from.direction);
        let opacity = pixel.and_then(|pixel| opacity.at(pixel));
        Seen {
            direction: from.direction.to_array(),
            azimuth_deg: azimuth.to_degrees(),
            elevation_deg: elevation.to_degrees(),
            pixel,
            opacity,
            visible: has_disc && opacity.is_some_and(|opacity| opacity <= OPAQUE),
        }
    }
}

/// Sun and moon in a picture. The moon has a disc by a date alone.
pub fn sun_and_moon(
    params: &SkyParams,
    light: &SkyLight,
    projection: &Projection,
    opacity: &Opacity,
) -> [Seen; 2] {
    let has_moon = params.date.is_some() && params.moon > 0.0;
    [
        Seen::of(&light.sun, params.sun, projection, opacity),
        Seen::of(&light.moon, has_moon, projection, opacity),
    ]
}

/// The light on a scene: docs/light.md. Irradiance and radiance are red, green and blue, linear BT.709.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LightTold {
    /// Irradiance of a plane that faces the sun, after the clouds.
    pub sun_irradiance: [f32; 3],
    /// The same without clouds.
    pub sun_clear_irradiance: [f32; 3],
    /// The moon's.
    pub moon_irradiance: [f32; 3],
    /// The same without clouds.
    pub moon_clear_irradiance: [f32; 3],
    /// Irradiance by all else: nine spherical harmonics in the basis of docs/json.md.
    pub ambient: [[f32; 3]; 9],
    /// Mean radiance there.
    pub horizon: [f32; 3],
    /// Mean radiance there.
    pub zenith: [f32; 3],
    /// The factor that a camera would choose.
    pub exposure: f32,
    /// What a radiance of 1 stands for.
    pub unit_cd_m2: f32,
}

impl From<&SkyLight> for LightTold {
    fn from(light: &SkyLight) -> LightTold {
        let [sun, moon] = [light.sun, light.moon];
        LightTold {
            sun_irradiance: sun.irradiance.to_array(),
            sun_clear_irradiance: sun.clear_irradiance.to_array(),
            moon_irradiance: moon.irradiance.to_array(),
            moon_clear_irradiance: moon.clear_irradiance.to_array(),
            ambient: light.ambient.map(|term| term.to_array()),
            horizon: light.horizon.to_array(),
            zenith: light.zenith.to_array(),
            exposure: light.exposure,
            unit_cd_m2: light.unit_cd_m2,
        }
    }
}

/// Pixels a side of the square overhead that oktas are counted in: 0.7 degrees a pixel in its middle, 0.35 at its corners.
const SIDE: u32 = 128;

/// The upper half of a cube around the viewer, whose opacity [`oktas`] counts: a square overhead and four half squares on the horizon.
pub fn dome(viewer: &Camera) -> [Camera; 5] {
    [0, 1, 2, 3, 4].map(|face| {
        let looking = match face {
            4 => Camera::looking(0.0, FRAC_PI_2, FRAC_PI_2, [SIDE, SIDE]),
            _ => Camera {
                lens_shift: Vec2::Y,
                ..Camera::looking(
                    face as f32 * FRAC_PI_2,
                    0.0,
                    2.0 * 0.5_f32.atan(),
                    [SIDE, SIDE / 2],
                )
            },
        };
        Camera {
            position_m: viewer.position_m,
            ..looking
        }
    })
}

/// Eighths of the sky that clouds cover, 0 to 8: of all that stands higher than 10 degrees, by solid angle (docs/cover.md). The opacities are those
/// of the [`dome`]'s cameras.
pub fn oktas(dome: &[(Camera, Opacity)]) -> f32 {
    let (mut covered, mut whole) = (0.0_f64, 0.0_f64);
    for (camera, opacity) in dome {
        for (value, (sine, angle)) in opacity.values.iter().zip(pixels(camera)) {
            if sine > LEAST_SINE {
                whole += f64::from(angle);
                if value.to_f32() > OPAQUE {
                    covered += f64::from(angle);
                }
            }
        }
    }
    (8.0 * covered / whole.max(f64::MIN_POSITIVE)) as f32
}

/// Sine of the elevation of each pixel, row by row, and its solid angle.
fn pixels(camera: &Camera) -> impl Iterator<Item = (f32, f32)> {
    let (rays, [width, height]) = (camera.rays(), camera.viewport_px);
    let area = 4.0 * rays.right.length() * rays.up.length() / (width * height) as f32;
    (0..width * height).map(move |i| {
        let x = ((i % width) as f32 + 0.5) / width as f32 * 2.0 - 1.0;
        let y = 1.0 - ((i / width) as f32 + 0.5) / height as f32 * 2.0;
        let ray = rays.forward + rays.right * x + rays.up * y;
        (ray.y / ray.length(), area / ray.length().powi(3))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The solid angle of the sky that is counted.
    const COUNTED: f32 = std::f32::consts::TAU * (1.0 - LEAST_SINE);

    fn frame(size: [u32; 2], opacity: impl Fn(u32) -> f32) -> Frame {
        let pixel = |i| [f16::from_f32(opacity(i)); 4];
        Frame {
            width: size[0],
            height: size[1],
            pixels: Pixels::Linear((0..size[0] * size[1]).map(pixel).collect()),
        }
    }

    fn bytes(frame: Frame) -> Vec<u8> {
        match frame.pixels {
            Pixels::Share8(bytes) => bytes,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn only_no_cloud_is_0_and_only_a_shut_sky_255() {
        let values = [0.0, 1e-4, 0.1, 0.11, 0.5, 0.9995, 1.0];
        let opacity = Opacity::of(&frame([7, 1], |i| values[i as usize]));
        assert_eq!(bytes(opacity.picture()), [0, 1, 25, 28, 128, 254, 255]);
        // 0.1 itself, as a half float has it, is a little below.
        assert_eq!(bytes(opacity.mask()), [0, 0, 0, 255, 255, 255, 255]);
        for i in 0..=1000 {
            let value = i as f32 / 1000.0;
            let byte = bytes(Opacity::of(&frame([1, 1], |_| value)).picture())[0];
            // Half a byte or, beside the ends, one; and what half floats round.
            assert!((f32::from(byte) / 255.0 - value).abs() < 1.0 / 255.0 + 1.0 / 2048.0);
        }
    }

    #[test]
    fn oktas_are_eighths_of_the_sky_that_is_counted() {
        let viewer = Camera::looking(1.0, 0.5, 1.0, [9, 9]);
        let cameras = dome(&viewer);
        let counted = |is_cloud: &dyn Fn(Vec3) -> bool| {
            let faces = cameras.map(|camera| {
                let (rays, [width, height]) = (camera.rays(), camera.viewport_px);
                let value = |i: u32| {
                    let x = ((i % width) as f32 + 0.5) / width as f32 * 2.0 - 1.0;
                    let y = 1.0 - ((i / width) as f32 + 0.5) / height as f32 * 2.0;
                    let ray = rays.forward + rays.right * x + rays.up * y;
                    f32::from(u8::from(is_cloud(ray.normalize())))
                };
                (camera, Opacity::of(&frame([width, height], value)))
            });
            oktas(&faces)
        };
        assert_eq!(counted(&|_| false), 0.0);
        assert_eq!(counted(&|_| true), 8.0);
        // A side, and a cap about the zenith of a known share; rows of pixels are 0.7 degrees.
        assert!((counted(&|d| d.x > 0.0) - 4.0).abs() < 0.02);
        let cap = 8.0 * (1.0 - 0.6) / (1.0 - LEAST_SINE);
        assert!((counted(&|d| d.y > 0.6) - cap).abs() < 0.06);
        let all: f32 = cameras
            .iter()
            .flat_map(pixels)
            .filter(|(sine, _)| *sine > LEAST_SINE)
            .map(|(_, angle)| angle)
            .sum();
        assert!((all / COUNTED - 1.0).abs() < 0.006, "{all} of {COUNTED}");
    }

    #[test]
    fn a_direction_is_where_the_picture_has_it() {
        let camera = Camera::looking(0.3, 0.4, 1.0, [200, 100]);
        let ahead = camera.rays().forward;
        let frame = Projection::Frame(camera);
        let [x, y] = frame.pixel_of(ahead).unwrap();
        assert!((x - 100.0).abs() < 1e-3 && (y - 50.0).abs() < 1e-3);
        assert_eq!(frame.pixel_of(-ahead), None);
        assert_eq!(frame.pixel_of(Vec3::NEG_Z.with_y(-0.1)), None);
        // Beside the picture.
        assert_eq!(frame.pixel_of(Vec3::new(1.0, 0.1, 0.0).normalize()), None);
        let map = Projection::Equirect(64, 0.0);
        let [x, y] = map.pixel_of(Vec3::new(1.0, 1.0, 0.0).normalize()).unwrap();
        assert!((x - 48.0).abs() < 1e-3 && (y - 8.0).abs() < 1e-3, "{x} {y}");
        assert_eq!(map.pixel_of(Vec3::NEG_Y), None);
    }

    #[test]
    fn what_is_beside_the_picture_has_no_opacity() {
        let opacity = Opacity::of(&super::tests::frame([4, 2], |i| i as f32 / 8.0));
        assert_eq!(opacity.at([3.9, 1.9]), Some(7.0 / 8.0));
        assert_eq!(opacity.at([0.0, 0.0]), Some(0.0));
        for place in [[4.0, 0.0], [-0.1, 0.0], [0.0, 2.0], [f32::NAN, 0.0]] {
            assert_eq!(opacity.at(place), None, "{place:?}");
        }
    }
}
