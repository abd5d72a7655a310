//! Typed texels: what the four numbers of a texel mean, and their bytes.
//!
//! Every field is the value a shader reads from a unorm texture, 0..1. The ranges that turn them into
//! physical units are in [`crate::role`] and in every manifest.

mod catalogue;
mod layers;

pub use catalogue::CatalogueStar;
pub use layers::LayerTexel;

use crate::format::Format;
use crate::texture::{Texture, encode, unorm8};

/// A texel of the role `clouds`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CloudTexel {
    /// Cloud amount from a photograph, 0 clear to 1 thick.
    pub photo: f32,
    /// Cloud amount from fractal noise, 0 clear to 1 thick.
    pub noise: f32,
    /// Finer fractal noise that roughens thin clouds.
    pub detail: f32,
    /// Sunset tint: 0 away from the sun to 1 on the horizon below it.
    pub gradient: f32,
}

/// A texel of the role `stars`: `I(t) = intensity + variance * sin(2 pi (rate t + phase))`.
///
/// Zero intensity means that there is no star, and then all four are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StarTexel {
    /// Mean intensity, 0 (no star) to 1 (the brightest).
    pub intensity: f32,
    /// Flicker rate; times [`StarTexel::MAX_RATE_HZ`] it is in hertz.
    pub rate: f32,
    /// Amplitude of the flicker, in the unit of `intensity`.
    pub variance: f32,
    /// Where in its cycle the star is at time 0, in turns.
    pub phase: f32,
}

impl StarTexel {
    /// The rate that the byte 255 stands for, in hertz: a byte counts 64ths of a hertz, so the whole
    /// field repeats after exactly 64 s and any time can be drawn without loss of precision.
    pub const MAX_RATE_HZ: f32 = 255.0 / 64.0;

    /// After this time every star is in the same state again, in seconds.
    pub const PERIOD_S: f64 = 64.0;

    /// What intensity 1 stands for on each level of the role `stars`, in intensities of level 0: a texel of a level
    /// has the light of all stars under it, divided by this. Without light it is 1.
    pub fn level_units(stars: &Texture) -> Vec<f32> {
        let light = |level: &Vec<u8>| -> u64 {
            let intensities = level.iter().step_by(4);
            intensities.map(|&byte| u64::from(byte)).sum()
        };
        let base = stars.levels.first().map_or(0, light);
        let unit = |level| match light(level) {
            0 => 1.0,
            light => (base as f64 / light as f64) as f32,
        };
        stars.levels.iter().map(unit).collect()
    }

    /// Intensity at `seconds`.
    pub fn intensity_at(self, seconds: f64) -> f32 {
        // Whole 64ths of a hertz: a rounded rate would lose its place after long times.
        let rate_hz = libm::round(f64::from(self.rate) * 255.0) / Self::PERIOD_S;
        let turns = rate_hz * seconds + f64::from(self.phase);
        let angle = std::f64::consts::TAU * (turns - libm::floor(turns));
        self.intensity + self.variance * libm::sin(angle) as f32
    }
}

/// A texel of the role `galaxy`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GalaxyTexel {
    /// Brightness, 0 dark to 1 the brightest.
    pub brightness: f32,
}

/// A texel of the role `sky`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SkyTexel {
    /// Radiance of the clear sky, or the light of its aureole, linear BT.709, in the unit of the sun's elevation.
    pub light: [f32; 3],
    /// Nothing: 0.
    pub padding: f32,
}

impl SkyTexel {
    /// The nearest RGBA16F texel, little-endian.
    pub fn encode(self) -> [u8; 8] {
        let [r, g, b] = self.light;
        halves([r, g, b, self.padding])
    }

    /// Reads an RGBA16F texel.
    pub fn decode(bytes: [u8; 8]) -> SkyTexel {
        let [r, g, b, padding] = from_halves(bytes);
        SkyTexel {
            light: [r, g, b],
            padding,
        }
    }
}

/// A texel of the role `sun`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SunTexel {
    /// The disc, 0 outside to 1 in its middle.
    pub disc: f32,
    /// The glow, 0 at the sides to 1 in the middle.
    pub glow: f32,
}

/// A texel of the role `octaves`: white noise, every value of a channel equally often.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OctaveTexel {
    /// Noise of the octaves 1 to 4, 0..1 each.
    pub noise: [f32; 4],
}

impl OctaveTexel {
    /// The nearest RGBA8 texel.
    pub fn encode(self) -> [u8; 4] {
        self.noise.map(unorm8)
    }

    /// Reads an RGBA8 texel.
    pub fn decode(bytes: [u8; 4]) -> OctaveTexel {
        OctaveTexel {
            noise: bytes.map(|b| f32::from(b) / 255.0),
        }
    }
}

/// A texel of the role `fbm`, in memory order: the noise at four points of a ray towards the sun.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FbmTexel {
    /// The noise three steps away.
    pub steps3: f32,
    /// The noise two steps away.
    pub steps2: f32,
    /// The noise one step away.
    pub steps1: f32,
    /// The noise here, 0..1.
    pub noise: f32,
}

/// A texel of the role `flares`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlareTexel {
    /// Light, 0 none to 1 the brightest.
    pub light: f32,
}

/// A texel of the role `sprites`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpriteTexel {
    /// Shade of the cloud, 0..1; 0.5 is the mean over a sprite, so twice this is a factor on its light.
    pub grey: f32,
    /// Opacity, 0..1.
    pub alpha: f32,
}

/// A texel of the role `skybox`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SkyboxTexel {
    /// Radiance of the picture times its cover, linear BT.709; 1 is the white of a sunlit cloud at noon.
    pub radiance: [f32; 3],
    /// Share of the picture, 0 (the computed sky) to 1 (the picture alone).
    pub cover: f32,
}

impl SkyboxTexel {
    /// The nearest RGBA16F texel, little-endian.
    pub fn encode(self) -> [u8; 8] {
        let [r, g, b] = self.radiance;
        halves([r, g, b, self.cover])
    }

    /// Reads an RGBA16F texel.
    pub fn decode(bytes: [u8; 8]) -> SkyboxTexel {
        let [r, g, b, cover] = from_halves(bytes);
        SkyboxTexel {
            radiance: [r, g, b],
            cover,
        }
    }
}

/// The bytes of a texel each of whose channels is a field.
macro_rules! bytes {
    ($texel:ident, $format:literal, $size:literal, $($channel:ident),+) => {
        impl $texel {
            #[doc = concat!("The nearest ", $format, " texel.")]
            pub fn encode(self) -> [u8; $size] {
                [$(self.$channel),+].map(unorm8)
            }

            #[doc = concat!("Reads an ", $format, " texel.")]
            pub fn decode(bytes: [u8; $size]) -> $texel {
                let [$($channel),+] = bytes.map(|b| f32::from(b) / 255.0);
                $texel { $($channel),+ }
            }
        }
    };
}

bytes!(CloudTexel, "RGBA8", 4, photo, noise, detail, gradient);
bytes!(StarTexel, "RGBA8", 4, intensity, rate, variance, phase);
bytes!(GalaxyTexel, "R8", 1, brightness);
bytes!(SunTexel, "RG8", 2, disc, glow);
bytes!(FbmTexel, "RGBA8", 4, steps3, steps2, steps1, noise);
bytes!(FlareTexel, "R8", 1, light);
bytes!(SpriteTexel, "RG8", 2, grey, alpha);

fn halves(values: [f32; 4]) -> [u8; 8] {
    let mut bytes = [0; 8];
    bytes.copy_from_slice(&encode(Format::Rgba16Float, &values));
    bytes
}

fn from_halves(bytes: [u8; 8]) -> [f32; 4] {
    [0, 2, 4, 6].map(|i| half::f16::from_le_bytes([bytes[i], bytes[i + 1]]).to_f32())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::texture::decode;

    proptest! {
        #[test]
        fn bytes_survive(bytes in any::<[u8; 4]>()) {
            prop_assert_eq!(CloudTexel::decode(bytes).encode(), bytes);
            prop_assert_eq!(StarTexel::decode(bytes).encode(), bytes);
            let [a, b, ..] = bytes;
            prop_assert_eq!(GalaxyTexel::decode([a]).encode(), [a]);
            prop_assert_eq!(SunTexel::decode([a, b]).encode(), [a, b]);
            prop_assert_eq!(OctaveTexel::decode(bytes).encode(), bytes);
            prop_assert_eq!(FbmTexel::decode(bytes).encode(), bytes);
            prop_assert_eq!(FlareTexel::decode([a]).encode(), [a]);
            prop_assert_eq!(LayerTexel::decode(bytes).encode(), bytes);
            prop_assert_eq!(SpriteTexel::decode([a, b]).encode(), [a, b]);
        }

        #[test]
        fn halves_survive(bits in any::<[u16; 4]>()) {
            // Infinities and what is not a number are not stored.
            let bits = bits.map(|b| if b & 0x7C00 == 0x7C00 { b & 0x83FF } else { b });
            let mut bytes = [0; 8];
            for (to, from) in bytes.chunks_exact_mut(2).zip(bits) {
                to.copy_from_slice(&from.to_le_bytes());
            }
            prop_assert_eq!(SkyTexel::decode(bytes).encode(), bytes);
            prop_assert_eq!(SkyboxTexel::decode(bytes).encode(), bytes);
        }

        #[test]
        fn values_move_by_half_a_step_at_most(photo in 0.0_f32..=1.0, phase in 0.0_f32..=1.0) {
            // The slack is the rounding of `byte / 255` itself.
            let half_step = 0.5 / 255.0 + 1e-6;
            let cloud = CloudTexel { photo, ..CloudTexel::default() };
            prop_assert!((CloudTexel::decode(cloud.encode()).photo - photo).abs() <= half_step);
            let star = StarTexel { phase, ..StarTexel::default() };
            prop_assert!((StarTexel::decode(star.encode()).phase - phase).abs() <= half_step);
        }

        #[test]
        fn every_format_keeps_its_promise(value in 0.0_f32..=1.0) {
            for format in Format::ALL {
                let back = decode(format, &encode(format, &[value]))[0];
                prop_assert!((back - value).abs() <= format.quantisation_error(value) + 1e-6, "{:?}", format);
            }
        }

        #[test]
        fn half_floats_keep_what_they_hold(bits in 0_u16..0x7C00) {
            let value = half::f16::from_bits(bits).to_f32();
            prop_assert_eq!(decode(Format::Rgba16Float, &encode(Format::Rgba16Float, &[value, -value])), [value, -value]);
        }
    }

    #[test]
    fn what_does_not_fit_is_clamped() {
        assert_eq!(
            encode(Format::R8Unorm, &[-1.0, 2.0, f32::NAN, f32::INFINITY]),
            [0, 255, 0, 255]
        );
        let halves = decode(
            Format::Rgba16Float,
            &encode(Format::Rgba16Float, &[1e9, -1e9, f32::NAN]),
        );
        assert_eq!(halves, [65504.0, -65504.0, 0.0]);
    }

    #[test]
    fn a_star_shines_as_its_numbers_say() {
        let star = StarTexel::decode([100, 128, 50, 64]);
        let (mean, swing) = (100.0 / 255.0, 50.0 / 255.0);
        let expected = |seconds: f64| {
            let turns = 2.0 * seconds + 64.0 / 255.0;
            mean + swing * libm::sin(std::f64::consts::TAU * turns)
        };
        for seconds in [0.0, 0.1, 1.37, 63.9] {
            assert!((f64::from(star.intensity_at(seconds)) - expected(seconds)).abs() < 1e-6);
        }
    }

    #[test]
    fn the_whole_field_repeats_after_its_period() {
        for rate in [1, 77, 255] {
            let star = StarTexel::decode([100, rate, 50, 64]);
            for periods in [1.0, 1e3, 1e6] {
                let later = star.intensity_at(5.25 + periods * StarTexel::PERIOD_S);
                assert_eq!(star.intensity_at(5.25), later, "{rate} after {periods}");
            }
        }
    }
}
