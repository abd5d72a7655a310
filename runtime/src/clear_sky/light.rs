//! Sun, moon and sky as light sources, by the time of day: computed once a frame.
//!
//! # Theory
//! Sunlight is what the air leaves of it ([`welkin_pack::air::sun_transmittance`]). It is stored as the radiance of a white surface
//! that faces it, `E / pi`, in the unit of the hour ([`unit_luminance_cd_m2`]), so that sun and sky belong together. Clouds stand
//! above most of the aerosol and a fifth of the air, and see the sun a little longer. The light of the sky is the mean of the pack's table.
//!
//! # Changes versus the paper
//! The paper's `amount_sunlight` is one number (line 28). Here it is two colours, sunlight and skylight.
//! With a plain time the full moon stands opposite the sun, with a date where it is, and gives what its phase leaves ([`crate::almanac::moon`]). A full moon's light is 400,000 times weaker; what eyes that have got used to the night see of it is a
//! constant here (`MOONLIGHT`), and the sky around it is the sun's, dimmed as much.
//!
//! # Practice
//! Some 30 microseconds a frame, most of it for the table.

use glam::Vec3;
use welkin_pack::air::{Colour, SUN_ILLUMINANCE_LX, sun_transmittance, unit_luminance_cd_m2};
use welkin_pack::mapping;

use crate::clear_sky::eclipse::DUSK_SINE;
pub use crate::clear_sky::eclipse::SUN_RADIUS_RAD;
use crate::clear_sky::moment::{Hour, Moment};
use crate::clear_sky::table::{SkyTable, SkyView};
use crate::geometry::math::{LUMINANCE, luminance, smoothstep};
use crate::geometry::part::{Part, Value};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[("LUMINANCE", Value::Vec3(LUMINANCE))],
    structs: &[],
    wgsl: "",
};

/// How far below the horizon the sun still lights clouds 2 km high, in radians: `acos(R / (R + h))`.
const CLOUD_DIP_RAD: f32 = 0.025;
/// Share of the aerosol that is above them, with a scale height of 1.2 km.
const AEROSOL_ABOVE_CLOUDS: f32 = 0.19;

/// Light at one moment. Colours are linear BT.709, in the unit of the hour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Light {
    /// Unit direction towards the sun, or by night the moon.
    pub sun_direction: Vec3,
    /// That towards the sun, whichever of them shines.
    pub sun: Vec3,
    /// That towards the moon.
    pub moon: Vec3,
    /// Strength of the moon's light over that of a full moon, by its setting, its phase and whether it has risen.
    pub moonlight: f32,
    /// The one whose azimuth the picture of the sky has at its side.
    pub sky_direction: Vec3,
    /// Times of day for what knows no other sun than the pack's.
    pub hours: [Hour; 2],
    /// What it gives to clouds: the radiance of a white surface that faces it.
    pub sunlight: Vec3,
    /// The same at the ground.
    pub ground_sunlight: Vec3,
    /// The same if all of the disc were above the horizon.
    pub disc: Vec3,
    /// Mean radiance of the clear sky.
    pub skylight: Vec3,
    /// Irradiance of a horizontal plane by the clear sky, over pi.
    pub sky_on_ground: Vec3,
    /// The share of the sun's light that the moon covers.
    pub eclipsed: f32,
    /// Share of the night sky that shows, 0 by day.
    pub night: f32,
    /// Share of stars and Milky Way that moonlight leaves to be seen.
    pub dark: f32,
    /// What a radiance of 1 stands for, in cd/m2.
    pub unit_cd_m2: f32,
    /// Whether it is the moon that shines.
    pub is_moon: bool,
}

/// The light at a moment, and the clear sky that goes with it.
#[derive(Clone, Debug, PartialEq)]
pub struct LitSky {
    /// What lights clouds and ground.
    pub light: Light,
    /// The sky.
    pub view: SkyView,
    /// The moon of a date.
    pub moon: Option<MoonLight>,
}

/// The moon of a date, to be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoonLight {
    /// Unit direction towards it.
    pub direction: Vec3,
    /// Unit direction towards the sun from it.
    pub sunwards: Vec3,
    /// Half of its angular size.
    pub radius_rad: f32,
    /// The angle between sun and viewer as it sees them.
    pub phase_rad: f32,
    /// Its light over that of the full moon.
    pub light: f32,
    /// The radiance of a white surface that faces it, if it were full.
    pub full: Vec3,
    /// Its radiance by the light of the full earth.
    pub earthlit: Vec3,
}

impl LitSky {
    /// At a moment under the table of a pack, with a haze of 0..1 and a moon of a strength of 0..1.
    pub fn new(table: &SkyTable, moment: &Moment, haze: f32, moon: f32) -> LitSky {
        let sun = moment.sun;
        let elevation_rad = sun.y.clamp(-1.0, 1.0).asin();
        let eclipse = Eclipse::new(moment);
        let unit_cd_m2 = eclipse.unit_cd_m2;
        let left = 1.0 - eclipse.covered;
        let depth = table.aerosol_depth(haze);
        let night = mapping::night_share(sun.y).max(eclipse.night);
        let mut view = eclipse.view(table, elevation_rad, haze);
        let strength = moon * moment.moonlight;
        let risen = smoothstep(MOON_RISES[0], MOON_RISES[1], moment.moon.y);
        let mut light = Light {
            sun_direction: sun,
            sun,
            moon: moment.moon,
            moonlight: strength * risen,
            sky_direction: sun,
            hours: moment.hours,
            sunlight: cloud_sunlight(elevation_rad, depth, unit_cd_m2) * left,
            ground_sunlight: ground_sunlight(elevation_rad, depth, unit_cd_m2) * left,
            disc: sunlight(elevation_rad, depth, unit_cd_m2),
            skylight: Vec3::ZERO,
            sky_on_ground: Vec3::ZERO,
            eclipsed: eclipse.covered,
            night,
            dark: 1.0,
            unit_cd_m2,
            is_moon: false,
        };
        let mut luminary_rad = elevation_rad;
        if sun.y <= MOONRISE[0] {
            let up = strength * (1.0 - smoothstep(MOONRISE[1], MOONRISE[0], sun.y));
            luminary_rad = moment.moon.y.clamp(-1.0, 1.0).asin();
            // The sun's own light at that elevation, and what of it the moon's stands for.
            let unit = unit_luminance_cd_m2(luminary_rad);
            let sunlit = ground_sunlight(luminary_rad, depth, unit);
            let dimmed = MOONLIGHT * up / luminance(white_sunlight(unit));
            let mut moonlit = table
                .view(luminary_rad, haze)
                .scaled(dimmed)
                .faded(NIGHT_GREY);
            light.sun_direction = moment.moon;
            if moment.moon == -sun {
                moonlit.add_opposite(&view);
                light.sky_direction = moment.moon;
            } else if sun.y > MOONRISE[1] {
                // The picture has its side where the dusk is; moonlight is spread around.
                moonlit.level(1.0);
                view.level(1.0 - smoothstep(MOONRISE[1], DUSK_LEVELS, sun.y));
                moonlit.add(&view);
            } else {
                moonlit.level(smoothstep(MOON_LEVELS, MOONRISE[1], sun.y));
                view.level(1.0);
                moonlit.add(&view);
                light.sky_direction = moment.moon;
            }
            view = moonlit;
            light.sunlight = cloud_sunlight(luminary_rad, depth, unit) * dimmed;
            light.ground_sunlight = sunlit * dimmed;
            light.disc = sunlit * dimmed;
            light.is_moon = true;
            light.dark = 1.0 - MOON_HIDES * (up * risen).min(1.0);
        }
        if night > 0.0 {
            view.add_airglow(AIRGLOW * night);
        }
        let [mean, on_ground] = table.means(&view, luminary_rad);
        light.skylight = mean;
        light.sky_on_ground = on_ground;
        let disc = moment.disc.map(|disc| MoonLight {
            direction: moment.moon,
            sunwards: disc.sunwards,
            radius_rad: disc.radius_rad,
            phase_rad: disc.phase_rad,
            light: moment.moonlight,
            full: full_moonlight(moment, depth, light.unit_cd_m2) * moon,
            earthlit: night_transmittance(moment, depth) * (EARTHLIGHT * night * moon),
        });
        LitSky {
            light,
            view,
            moon: disc,
        }
    }
}

/// What an eclipse leaves of daylight. Eyes get used to what there is of it, as they do to that of an hour ([`unit_luminance_cd_m2`]): in the end to that of the dusk
/// which totality is.
struct Eclipse {
    /// The share of the sun's light that is covered; 0 where there is no eclipse.
    covered: f32,
    /// What a radiance of 1 stands for.
    unit_cd_m2: f32,
    /// Share of the night sky that shows.
    night: f32,
}

impl Eclipse {
    fn new(moment: &Moment) -> Eclipse {
        let unit = unit_luminance_cd_m2(moment.sun.y.clamp(-1.0, 1.0).asin());
        let covered = match moment.sun.y > DUSK_SINE {
            true => moment.eclipsed,
            false => 0.0,
        };
        if covered <= 0.0 {
            return Eclipse {
                covered: 0.0,
                unit_cd_m2: unit,
                night: 0.0,
            };
        }
        // A unit is the light to 2/3.
        let totality = (unit_luminance_cd_m2(DUSK_SINE.asin()) / unit).powf(1.5);
        let light = 1.0 - covered + covered * totality;
        let share_of_dusk = covered * totality / light;
        Eclipse {
            covered,
            unit_cd_m2: unit * light.powf(2.0 / 3.0),
            // Nothing before the last light goes.
            night: mapping::night_share(DUSK_SINE) * smoothstep(0.02, 1.0, share_of_dusk),
        }
    }

    /// The clear sky: what is left of the hour's, and the dusk of totality, which is around the horizon.
    fn view(&self, table: &SkyTable, elevation_rad: f32, haze: f32) -> SkyView {
        let view = table.view(elevation_rad, haze);
        if self.covered <= 0.0 {
            return view;
        }
        let dusk_rad = DUSK_SINE.asin();
        let share = |covered: f32, elevation_rad: f32| {
            Vec3::splat(covered * unit_luminance_cd_m2(elevation_rad) / self.unit_cd_m2)
        };
        let mut dusk = table
            .view(dusk_rad, haze)
            .scaled(share(self.covered, dusk_rad));
        dusk.level(1.0);
        let mut seen = view.scaled(share(1.0 - self.covered, elevation_rad));
        seen.add(&dusk);
        seen
    }
}

/// The radiance of a white surface that faces the sun through the clearest air, with the sun at 60 degrees.
fn white_sunlight(unit_cd_m2: f32) -> Vec3 {
    sunlight(
        welkin_pack::air::WHITE_ELEVATION_RAD,
        welkin_pack::air::CLEAR_AEROSOL_DEPTH,
        unit_cd_m2,
    )
}

fn sunlight(elevation_rad: f32, aerosol_depth: f32, unit_cd_m2: f32) -> Vec3 {
    let rgb = Colour::daylight().rgb(&sun_transmittance(elevation_rad, aerosol_depth));
    Vec3::from(rgb) * (SUN_ILLUMINANCE_LX / std::f32::consts::PI / unit_cd_m2)
}

/// The full moon's light on a white surface that faces it, for its disc: by day in the unit of the hour, by night as eyes see it.
fn full_moonlight(moment: &Moment, aerosol_depth: f32, unit_cd_m2: f32) -> Vec3 {
    let elevation_rad = moment.moon.y.clamp(-1.0, 1.0).asin();
    let by_day =
        sunlight(elevation_rad, aerosol_depth, unit_cd_m2) * (FULL_MOON_LX / SUN_ILLUMINANCE_LX);
    let up = 1.0 - smoothstep(MOONRISE[1], MOONRISE[0], moment.sun.y);
    by_day.max(night_transmittance(moment, aerosol_depth) * MOONLIGHT * up)
}

/// What the air leaves of the moon's light, over that at 60 degrees.
fn night_transmittance(moment: &Moment, aerosol_depth: f32) -> Vec3 {
    let elevation_rad = moment.moon.y.clamp(-1.0, 1.0).asin();
    let unit = unit_luminance_cd_m2(elevation_rad);
    sunlight(elevation_rad, aerosol_depth, unit) / luminance(white_sunlight(unit))
}

/// The sun's light at the ground, for the part of its disc that has risen.
fn ground_sunlight(elevation_rad: f32, aerosol_depth: f32, unit_cd_m2: f32) -> Vec3 {
    let risen = smoothstep(-SUN_RADIUS_RAD, SUN_RADIUS_RAD, elevation_rad);
    sunlight(elevation_rad, aerosol_depth, unit_cd_m2) * risen
}

/// The sun's light on clouds.
fn cloud_sunlight(elevation_rad: f32, aerosol_depth: f32, unit_cd_m2: f32) -> Vec3 {
    // The sun sets later there, over some degrees as the clouds are not all of one height.
    let risen = smoothstep(-3.0 * CLOUD_DIP_RAD, CLOUD_DIP_RAD, elevation_rad);
    let seen_rad = (elevation_rad + CLOUD_DIP_RAD).max(0.5 * CLOUD_DIP_RAD);
    sunlight(seen_rad, aerosol_depth * AEROSOL_ABOVE_CLOUDS, unit_cd_m2) * risen
}

/// The full moon's light on a white surface as the eye, adapted to the night, sees it: grey with a breath of blue.
pub(crate) const MOONLIGHT: Vec3 = Vec3::new(0.062, 0.066, 0.074);

/// Airglow and faint stars overhead in a moonless night: a dark sky has 21.6 magnitudes a square arcsecond, that of a full moon some 18, 27 times as
/// much (F. E. Roach, J. L. Gordon, "The Light of the Night Sky", 1973); of that the cube root is kept, as of all light ([`unit_luminance_cd_m2`]).
const AIRGLOW: Vec3 = Vec3::new(0.0024, 0.0026, 0.0028);

/// Radiance of the new moon by the light of the full earth. That gives it `p (R / d)^2 = 0.434 (6371 / 384400)^2 = 1.2e-4` of the sun's light (its geometric albedo by A. Mallama, B. Krobusek,
/// H. Pavlov, "Comprehensive wide-band magnitudes and albedos for the planets", Icarus 282, 2017), so 0.5 cd/m2 where the full moon has 4,000, which is 2,800 times the darkest sky; as of all light of the
/// night, the cube root is kept of that, 14 times [`AIRGLOW`].
const EARTHLIGHT: f32 = 0.036;

/// Illuminance of the full moon outside the air. C. W. Allen, "Astrophysical Quantities", third edition, 1973, section 66.
const FULL_MOON_LX: f32 = 0.32;

/// What eyes lose of colour by moonlight, which they see half by their rods; how much is chosen.
pub(crate) const NIGHT_GREY: f32 = 0.45;

/// How much of stars and Milky Way a full moon hides: nearly all of them to an eye, and what a picture of both shows is chosen.
const MOON_HIDES: f32 = 0.85;

/// Sines of the sun's elevation between which the moon takes over: the sun's last light on clouds is gone at -0.09.
const MOONRISE: [f32; 2] = [-0.10, -0.24];

/// A sky has one side. Where the moon is not opposite the sun, it goes from the dusk's to the moon's where the light of neither has one: dusk is evened
/// out around the horizon from this sine of the sun's elevation to the end of [`MOONRISE`], moonlight takes its side by the other. Chosen.
const DUSK_LEVELS: f32 = -0.18;
/// See [`DUSK_LEVELS`].
const MOON_LEVELS: f32 = -0.30;

/// Sines of the moon's elevation between which it comes to hide stars. With a plain time it stands higher than these when stars come out.
const MOON_RISES: [f32; 2] = [-0.05, 0.09];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sunlight_reddens_towards_the_horizon_and_noon_is_white() {
        let at = |degrees: f32| ground_sunlight(degrees.to_radians(), 0.04, 32_000.0);
        let noon = at(60.0);
        assert!((noon / noon.y - 1.0).abs().max_element() < 1e-4, "{noon}");
        let mut last = at(89.0);
        for degrees in (1..89).rev() {
            let now = at(degrees as f32);
            assert!(now.cmple(last).all(), "brighter at {degrees}");
            assert!(now.x / now.z >= last.x / last.z, "less red at {degrees}");
            last = now;
        }
        assert_eq!(at(-0.3), Vec3::ZERO);
    }

    #[test]
    fn clouds_are_lit_longer_than_the_ground() {
        for degrees in [-1.0_f32, 0.0, 1.0, 5.0, 30.0] {
            let [cloud, ground] =
                [cloud_sunlight, ground_sunlight].map(|f| f(degrees.to_radians(), 0.04, 1e4));
            assert!(
                luminance(cloud) > luminance(ground),
                "{degrees}: {cloud} {ground}"
            );
        }
        assert_eq!(cloud_sunlight(-0.08, 0.04, 1e4), Vec3::ZERO);
    }

    /// A table that is the same everywhere, for two hazes of 16 suns.
    fn table() -> SkyTable {
        let texture = welkin_pack::Texture {
            format: welkin_pack::Format::Rgba16Float,
            shape: welkin_pack::Shape::Array,
            width: 8,
            height: 16,
            layers: 64,
            levels: vec![[0x00, 0x34].repeat(4 * 8 * 16 * 64)],
        };
        SkyTable::new(&texture, [0.04, 0.24])
    }

    #[test]
    fn the_moon_takes_over_where_the_sun_gives_nothing() {
        let table = table();
        // A sun that culminates in the zenith: the time of an evening at which its sine is so much.
        let at = |sine: f32| {
            let time = 0.5 + sine.acos() / std::f32::consts::TAU;
            let moment = Moment::of_time(time, std::f32::consts::FRAC_PI_2);
            LitSky::new(&table, &moment, 0.0, 1.0).light
        };
        let dusk = at(-0.05);
        assert!(!dusk.is_moon && dusk.sun_direction.y < 0.0 && dusk.sunlight.x > 0.0);
        // At the change both are dark: no step.
        assert!(!at(-0.0999).is_moon && at(-0.0999).sunlight.max_element() < 1e-6);
        assert!(at(-0.1001).is_moon && at(-0.1001).sunlight.max_element() < 1e-3);
        let night = at(-0.8);
        assert!((night.sun_direction.y - 0.8).abs() < 1e-3);
        // A high moon's light on clouds, which have some of the air below them.
        let ratio = night.sunlight / MOONLIGHT;
        assert!(
            ratio.min_element() > 0.95 && ratio.max_element() < 1.35,
            "{ratio}"
        );
        assert!(luminance(night.ground_sunlight) < luminance(night.sunlight));
    }

    fn direction(elevation: f32, azimuth: f32) -> Vec3 {
        Vec3::from(mapping::direction_from_angles(azimuth, elevation))
    }

    fn moment(sun_sine: f32, moon: Vec3, moonlight: f32) -> Moment {
        Moment {
            sun: direction(sun_sine.asin(), 0.4),
            moon,
            moonlight,
            ..Moment::default()
        }
    }

    #[test]
    fn moonlight_follows_the_moon_s_phase_and_comes_from_where_it_is() {
        let table = table();
        let at = |moonlight: f32, elevation: f32| {
            let moon = direction(elevation, 2.0);
            let moment = moment(-0.6, moon, moonlight);
            let light = LitSky::new(&table, &moment, 0.0, 1.0).light;
            assert!(light.is_moon && light.sun_direction == moon);
            light
        };
        let (full, half) = (at(1.0, 0.7), at(0.1, 0.7));
        for (bright, dim) in [
            (full.sunlight, half.sunlight),
            (full.ground_sunlight, half.ground_sunlight),
        ] {
            assert!((dim / bright - 0.1).abs().max_element() < 1e-4);
        }
        assert!(half.dark > full.dark, "a half moon hides fewer stars");
        // A moon that is down gives nothing and hides nothing.
        let down = at(1.0, -0.3);
        assert_eq!((down.ground_sunlight, down.dark), (Vec3::ZERO, 1.0));
        assert!(luminance(down.skylight) < luminance(full.skylight));
    }

    /// A table whose light is all below the sun: the side of a sky shows.
    fn sided() -> SkyTable {
        let mut texture = welkin_pack::Texture {
            format: welkin_pack::Format::Rgba16Float,
            shape: welkin_pack::Shape::Array,
            width: 8,
            height: 16,
            layers: 64,
            levels: vec![Vec::new()],
        };
        for texel in 0..8 * 16 * 64 {
            let bright = texel % 8 == 0;
            let half: [u8; 2] = if bright { [0x00, 0x34] } else { [0x00, 0x24] };
            texture.levels[0].extend(half.repeat(4));
        }
        SkyTable::new(&texture, [0.04, 0.24])
    }

    #[test]
    fn a_sky_changes_sides_without_a_step() {
        let table = sided();
        let moon = direction(0.5, 2.5);
        // Rows of the picture, turned to the world: what is seen at an azimuth, from the side's own.
        let seen = |sine: f32| {
            let lit = LitSky::new(&table, &moment(sine, moon, 0.8), 0.0, 1.0);
            let image = lit.view.image();
            let side = lit.light.sky_direction;
            let places = crate::clear_sky::picture::Places::new([8, 16]);
            let [start, span] = places.start_and_span();
            (0..12)
                .map(|i| {
                    let towards = direction(0.0, i as f32 * 0.52);
                    let flat = Vec3::new(side.x, 0.0, side.z).normalize();
                    let u = start[0] + span[0] * towards.dot(flat);
                    let x = (u * image.width as f32) as u32;
                    image.texel(x.min(image.width - 2), 0)[1]
                })
                .collect::<Vec<f32>>()
        };
        let mut last = seen(-0.10);
        let brightest = last.iter().copied().fold(0.0, f32::max);
        for step in 1..=1200 {
            let now = seen(-0.10 - step as f32 * 2e-4);
            for (a, b) in last.iter().zip(&now) {
                assert!((a - b).abs() < 0.05 * brightest, "{step}: {a} {b}");
            }
            last = now;
        }
    }

    #[test]
    fn the_disc_fits_half_floats_at_every_hour() {
        for step in 0..=900 {
            let elevation_rad = (step as f32 * 0.1).to_radians();
            let unit = unit_luminance_cd_m2(elevation_rad);
            // The clearest air that a recipe can have.
            let disc = sunlight(elevation_rad, 0.0, unit) / (SUN_RADIUS_RAD * SUN_RADIUS_RAD * 0.8);
            assert!(disc.max_element() < 65_504.0 * 1.35, "{step}: {disc}");
        }
    }
}
