//! The light that a sky gives to a scene.
//!
//! # Theory
//! Sun and moon are lights from one direction; all else, the sky with its clouds and the ground, is ambient light, whose irradiance nine
//! spherical harmonics hold ([`crate::geometry::harmonics`]). Radiance is summed over the texels of the clear sky's table and over a grid
//! of the ground. Of the aureole the narrow lobe is smaller than a texel, and is light from the sun's direction.
//!
//! # Practice
//! 40 to 60 microseconds of one core, some 10 fewer at the moment of the frame that was prepared last, and 80 to 110 over a sea; no device is
//! asked. Clouds count by their mean opacity and colour, not by where they are at the moment: light does not flicker as they pass the sun.
//! Weather, flashes, a skybox, stars and the Milky Way are left out. See docs/light.md.
//!
//! [`WGSL`] is a struct of 240 bytes and three functions for the shaders of a scene; [`SkyLight::uniform`] is its bytes.

use glam::{Vec2, Vec3, Vec3Swizzles};
use welkin_pack::air::AUREOLE_LOBES;

use crate::clear_sky::ground;
use crate::clear_sky::light::LitSky;
use crate::clear_sky::table::aureole_lobe;
use crate::frame::Uniforms;
use crate::geometry::camera::Camera;
use crate::geometry::harmonics::{CLAMPED_COSINE, COUNT, FACTORS, basis};
use crate::geometry::math::luminance;
use crate::pack_data::PackData;
use crate::params::SkyParams;
use crate::sky::air::Air;
use crate::sky::mean_clouds::MeanClouds;

/// WGSL of `sky_light_ambient(light, normal)`, `sky_light_direct` and `sky_light_clear`, for the application's shaders.
pub const WGSL: &str = include_str!("light_on.wgsl");

/// Light from one direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Luminary {
    /// Unit direction towards it, east, up and south.
    pub direction: Vec3,
    /// Irradiance of a plane that faces it, linear BT.709, in units of radiance times steradian; 0 where it is not up.
    pub irradiance: Vec3,
    /// The same without clouds, for a scene that has the shadow of each of them ([`Sky::shadow`](crate::Sky::shadow)).
    pub clear_irradiance: Vec3,
}

/// The light that a sky gives to a scene, linear BT.709. A white surface under an irradiance of `E` has a radiance of `E / pi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyLight {
    /// The sun's light at the ground, after the clouds.
    pub sun: Luminary,
    /// The moon's.
    pub moon: Luminary,
    /// Irradiance by all else, as coefficients of [`BASIS`](crate::geometry::harmonics::basis): see [`SkyLight::ambient_irradiance`].
    pub ambient: [Vec3; COUNT],
    /// Mean radiance of the horizon: a colour for fog.
    pub horizon: Vec3,
    /// Mean radiance about the zenith.
    pub zenith: Vec3,
    /// The air that a scene is seen through.
    pub air: Air,
    /// The factor on radiance that a camera would choose, as [`SkyParams::exposure`].
    pub exposure: f32,
    /// What a radiance of 1 stands for, in cd/m2.
    pub unit_cd_m2: f32,
}

impl SkyLight {
    /// The struct `SkyLight` of [`WGSL`].
    pub fn uniform(&self) -> [f32; 60] {
        let [sun, moon] = [self.sun, self.moon];
        let ambient = self.ambient.iter().zip(FACTORS);
        let rows = [sun, moon]
            .into_iter()
            .flat_map(|from| [from.direction, from.irradiance, from.clear_irradiance])
            .chain(ambient.map(|(coefficient, factor)| *coefficient * factor as f32));
        let mut uniform = [0.0; 60];
        for (row, vector) in uniform.chunks_exact_mut(4).zip(rows) {
            row[..3].copy_from_slice(&vector.to_array());
        }
        uniform
    }

    /// The irradiance that a plane of this unit normal has from sky, clouds and ground: sun and moon are to be added.
    pub fn ambient_irradiance(&self, normal: Vec3) -> Vec3 {
        let terms = basis(normal.as_dvec3().to_array());
        let pairs = self.ambient.iter().zip(terms);
        let sum = pairs.map(|(coefficient, term)| *coefficient * term as f32);
        sum.sum::<Vec3>().max(Vec3::ZERO)
    }

    /// That of everything.
    pub fn irradiance(&self, normal: Vec3) -> Vec3 {
        let lights = [self.sun, self.moon].map(|l| l.irradiance * l.direction.dot(normal).max(0.0));
        self.ambient_irradiance(normal) + lights[0] + lights[1]
    }
}

/// What the mean radiance of all directions is exposed to: that of a fair noon under the default exposure.
const EXPOSED: f32 = 0.5;
/// Exposures that a camera has: twelve stops.
const EXPOSURES: [f32; 2] = [1.0 / 64.0, 64.0];

/// Rows of the ground, from the horizon down.
const GROUND_ROWS: u32 = 12;

/// Moments of light that is the same on both sides of the sun: of radiance times solid angle, and of that times products of a direction's
/// components up and towards the sun's azimuth. Nine harmonics follow from them.
#[derive(Default)]
struct Moments {
    whole: Vec3,
    up: Vec3,
    along: Vec3,
    up_up: Vec3,
    up_along: Vec3,
    along_along: Vec3,
}

impl Moments {
    /// Adds radiance times solid angle.
    fn add(&mut self, light: Vec3, up: f32, along: f32) {
        self.whole += light;
        self.up += light * up;
        self.along += light * along;
        self.up_up += light * (up * up);
        self.up_along += light * (up * along);
        self.along_along += light * (along * along);
    }

    /// Coefficients of irradiance, with the sun's azimuth along this unit vector (east, south).
    fn harmonics(&self, azimuth: Vec2) -> [Vec3; COUNT] {
        let Vec2 { x, y: z } = azimuth;
        let across = self.whole - self.up_up - self.along_along;
        let east_east = self.along_along * (x * x) + across * (z * z);
        let south_south = self.along_along * (z * z) + across * (x * x);
        // In the order of the basis functions.
        let moments = [
            self.whole,
            self.up,
            self.along * z,
            self.along * x,
            self.up_along * x,
            self.up_along * z,
            3.0 * south_south - self.whole,
            (self.along_along - across) * (x * z),
            east_east - self.up_up,
        ];
        let mut coefficients = [Vec3::ZERO; COUNT];
        for (i, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient = moments[i] * (FACTORS[i] * CLAMPED_COSINE[i]) as f32;
        }
        coefficients
    }
}

impl PackData {
    /// Parameters with the exposure that they ask for, in the light of their moment; `clamped` are in range.
    pub(crate) fn exposed(&self, lit: &LitSky, clamped: SkyParams, seconds: f64) -> SkyParams {
        match clamped.auto_exposure {
            true => SkyParams {
                exposure: self.light_under(lit, &clamped, seconds).exposure,
                auto_exposure: false,
                ..clamped
            },
            false => clamped,
        }
    }

    /// See [`crate::Sky::light`].
    pub fn light(&self, params: &SkyParams, seconds: f64) -> SkyLight {
        let clamped = params.clamped();
        self.light_under(&self.lit_sky(&clamped, seconds), &clamped, seconds)
    }

    /// The same in the light of the moment. `params` are in range.
    pub(crate) fn light_under(&self, lit: &LitSky, params: &SkyParams, seconds: f64) -> SkyLight {
        let camera = Camera::looking(0.0, 0.0, 1.0, [1, 1]);
        let uniforms = &self.uniforms_under(lit, params, &camera, seconds, 0.0);
        let (light, sun) = (lit.light, lit.light.sun_direction);
        let clouds = MeanClouds::new(self, params, uniforms);
        let azimuth = uniforms.sky.azimuth;
        // A direction by its sine of elevation and the cosine of its azimuth from the sun's.
        let towards = |sine: f32, azimuth_cos: f32| {
            let flat = (1.0 - sine * sine).max(0.0).sqrt();
            let azimuth_sin = (1.0 - azimuth_cos * azimuth_cos).max(0.0).sqrt();
            let place = azimuth * azimuth_cos + azimuth.perp() * azimuth_sin;
            Vec3::new(flat * place.x, sine, flat * place.y)
        };
        let mut sum = Moments::default();
        let azimuths = self.sky.azimuths();
        let mut horizon = Vec::with_capacity(azimuths);
        // All of it, for a sea to mirror.
        let mut above = Vec::new();
        let mut sines = Vec::new();
        let (mut zenith, mut nearest) = (Vec3::ZERO, (-1.0, Vec3::ZERO));
        for at in self.sky.samples(&lit.view) {
            let direction = towards(at.sine, at.azimuth_cos);
            let cosine = direction.dot(sun);
            let wide = at.radiance + at.aureole * aureole_lobe(1, cosine);
            let behind = uniforms.sky_behind(wide, direction);
            let radiance = clouds.over(behind, uniforms, direction);
            let along = direction.xz().dot(azimuth);
            sum.add(radiance * at.solid_angle, at.sine, along);
            if params.sea {
                if above.len() % azimuths == 0 {
                    sines.push(at.sine);
                }
                above.push(radiance);
            }
            if at.sine == 0.0 {
                horizon.push((at.azimuth_cos, at.solid_angle, radiance));
            }
            // The last row is the zenith's.
            zenith = radiance;
            if cosine > nearest.0 {
                nearest = (cosine, at.aureole);
            }
        }
        let open = 1.0 - clouds.opacity(uniforms, sun.y);
        let shows = open * (1.0 - uniforms.sky.overcast_weight);
        if sun.y > 0.0 {
            let narrow = nearest.1 * (AUREOLE_LOBES[0][0] * shows);
            sum.add(narrow, sun.y, sun.xz().dot(azimuth));
        }
        // From below the sun to opposite.
        let end = |at: Option<&(f32, f32, Vec3)>| at.map_or(Vec3::ZERO, |(.., radiance)| *radiance);
        let ends = [end(horizon.first()), end(horizon.last())];
        let around: f32 = horizon.iter().map(|(_, weight, _)| weight).sum();
        let mut mean_horizon = Vec3::ZERO;
        for (column, (azimuth_cos, weight, radiance)) in horizon.into_iter().enumerate() {
            let mirrored = |sine: f32| {
                let row = sines
                    .partition_point(|s| *s < sine)
                    .clamp(1, sines.len() - 1);
                let [low, high] = [row - 1, row].map(|row| above[row * azimuths + column]);
                low.lerp(
                    high,
                    (sine - sines[row - 1]) / (sines[row] - sines[row - 1]),
                )
            };
            let share = weight / around;
            mean_horizon += radiance * share;
            for row in 0..GROUND_ROWS {
                // Rows lie closer near the horizon.
                let step = 1.0 / GROUND_ROWS as f32;
                let root = (row as f32 + 0.5) * step;
                let sine = -root * root;
                let solid_angle = 2.0 * root * step * std::f32::consts::TAU * share;
                let direction = towards(sine, azimuth_cos);
                let seen = match params.sea {
                    true => {
                        let ground = &uniforms.ground;
                        uniforms.sea.seen(ground, radiance, direction, mirrored)
                    }
                    false => uniforms.ground.seen(radiance, direction, sun),
                };
                sum.add(seen * solid_angle, sine, direction.xz().dot(azimuth));
            }
        }
        if params.sea && sun.y > 0.0 {
            for (light, from) in uniforms.sea.glitter(&uniforms.ground, sun) {
                sum.add(light * open, from.y, from.xz().dot(azimuth));
            }
        }
        let clear_irradiance = light.ground_sunlight * std::f32::consts::PI;
        let direct = Luminary {
            direction: sun,
            irradiance: clear_irradiance * open,
            clear_irradiance,
        };
        let dark = Luminary {
            direction: if light.is_moon { light.sun } else { light.moon },
            ..Luminary::default()
        };
        let [sun, moon] = match light.is_moon {
            true => [dark, direct],
            false => [direct, dark],
        };
        let [molecules, aerosol] = ground::extinctions_per_km(
            self.sky.aerosol_depth(params.haze),
            uniforms.sky.overcast_weight,
        );
        let air = Air {
            horizon: ends,
            sun_azimuth: azimuth,
            molecules_per_m: molecules * 1e-3,
            aerosol_per_m: aerosol * 1e-3,
        };
        let mean = luminance(sum.whole) / (2.0 * std::f32::consts::TAU);
        SkyLight {
            sun,
            moon,
            ambient: sum.harmonics(azimuth),
            horizon: mean_horizon,
            zenith,
            air,
            exposure: (EXPOSED / mean.max(1e-6)).clamp(EXPOSURES[0], EXPOSURES[1]),
            unit_cd_m2: light.unit_cd_m2,
        }
    }
}

impl Uniforms {
    /// The clear sky or what shuts it along a direction above the horizon, by the same lines as the shader's `sky_radiance`.
    fn sky_behind(&self, table: Vec3, direction: Vec3) -> Vec3 {
        #[cfg(feature = "perez")]
        let clear = self.perez.radiance(direction, table);
        #[cfg(not(feature = "perez"))]
        let clear = table;
        let low = 1.0 - direction.y.clamp(0.0, 1.0);
        let slit = 1.0 + self.sky.slit * low.powi(6);
        clear.lerp(self.sky.overcast * slit, self.sky.overcast_weight)
    }
}
