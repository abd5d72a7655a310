//! Where a direction and a sun lie in the role `sky`: the table of the clear sky.
//!
//! # Theory
//! A layer is the sky for one elevation of the sun. Its rows are elevations of view, its columns azimuths from the sun, of which half a
//! turn is enough. Where the sky changes fast, texels lie close: rows with the square of the elevation at the horizon, evenly in
//! the zenith angle at the zenith, by two roots and no angle; columns evenly in the sine of half the azimuth; suns by an inverse
//! hyperbolic sine about the horizon. What changes fastest of all, the aureole, is not in the table: it holds the light that its
//! phase function is multiplied by, which is smooth (as E. Bruneton, F. Neyret, "Precomputed Atmospheric Scattering", EGSR 2008, section 4).

/// Lowest elevation of the sun in the table, in radians: -18 degrees, the end of astronomical twilight.
pub const LOWEST_SUN_RAD: f32 = -std::f32::consts::PI / 10.0;

/// Images for each sun: radiance without the aureole, and the light that [`crate::air::aureole_phase`] is multiplied by.
pub const SKY_PARTS: u32 = 2;

/// Depths of aerosol in the table: as it is without haze, and with all of it.
pub const SKY_HAZES: u32 = 2;

/// Elevation about which the suns lie closest, in radians: 5 degrees.
const SUN_SCALE_RAD: f32 = std::f32::consts::PI / 36.0;

/// Which layer of the role `sky` holds what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SkyLayer {
    /// Which of the depths of aerosol.
    pub haze: u32,
    /// Which elevation of the sun, from the lowest.
    pub sun: u32,
    /// 0 for radiance, 1 for the light of the aureole.
    pub part: u32,
}

impl SkyLayer {
    /// Its place among the layers, for so many suns.
    pub fn index(self, suns: u32) -> u32 {
        (self.haze * suns + self.sun) * SKY_PARTS + self.part
    }
}

/// Sine of the elevation and cosine of the azimuth from the sun to texel coordinates (0 is the centre of the first texel).
///
/// Row 0 is the horizon, the last the zenith; column 0 is the sun's azimuth, the last the opposite one. From below the horizon row 0.
pub fn sky_to_texel(sin_elevation: f32, cos_azimuth: f32, [width, height]: [u32; 2]) -> [f32; 2] {
    let from_zenith = libm::sqrtf((1.0 - sin_elevation).clamp(0.0, 1.0));
    let half_sine = libm::sqrtf((0.5 - 0.5 * cos_azimuth).clamp(0.0, 1.0));
    [
        half_sine * (width - 1) as f32,
        libm::sqrtf(1.0 - from_zenith) * (height - 1) as f32,
    ]
}

/// The inverse of [`sky_to_texel`].
pub fn texel_to_sky(texel: [f32; 2], [width, height]: [u32; 2]) -> (f32, f32) {
    let half_sine = texel[0] / (width - 1) as f32;
    let v = texel[1] / (height - 1) as f32;
    let from_zenith = 1.0 - v * v;
    (
        1.0 - from_zenith * from_zenith,
        1.0 - 2.0 * half_sine * half_sine,
    )
}

/// Elevation of the sun to its place among so many of them, 0 for the lowest; from lower ones 0.
pub fn sun_to_layer(elevation_rad: f32, suns: u32) -> f32 {
    let [lowest, span] = scaled_suns();
    let place = (libm::asinhf(elevation_rad / SUN_SCALE_RAD) - lowest) / span;
    place.clamp(0.0, 1.0) * (suns - 1) as f32
}

/// The inverse of [`sun_to_layer`].
pub fn layer_to_sun(layer: f32, suns: u32) -> f32 {
    let [lowest, span] = scaled_suns();
    SUN_SCALE_RAD * libm::sinhf(lowest + span * layer / (suns - 1) as f32)
}

/// The lowest sun, and how far the highest is from it, on the scale on which they are even.
fn scaled_suns() -> [f32; 2] {
    let lowest = libm::asinhf(LOWEST_SUN_RAD / SUN_SCALE_RAD);
    let highest = libm::asinhf(std::f32::consts::FRAC_PI_2 / SUN_SCALE_RAD);
    [lowest, highest - lowest]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SIZE: [u32; 2] = [16, 32];

    proptest! {
        #[test]
        fn sky_and_back(sin_elevation in 0.0_f32..=1.0, cos_azimuth in -1.0_f32..=1.0) {
            let (sine, cosine) = texel_to_sky(sky_to_texel(sin_elevation, cos_azimuth, SIZE), SIZE);
            prop_assert!((sine - sin_elevation).abs() < 1e-5 && (cosine - cos_azimuth).abs() < 1e-5);
        }

        #[test]
        fn sun_and_back(elevation_rad in LOWEST_SUN_RAD..1.57) {
            let place = sun_to_layer(elevation_rad, 40);
            prop_assert!((0.0..=39.0).contains(&place));
            prop_assert!((layer_to_sun(place, 40) - elevation_rad).abs() < 2e-5);
        }
    }

    #[test]
    fn corners_are_horizon_and_zenith_sun_and_opposite() {
        assert_eq!(sky_to_texel(0.0, 1.0, SIZE), [0.0, 0.0]);
        assert_eq!(sky_to_texel(1.0, -1.0, SIZE), [15.0, 31.0]);
        assert_eq!(sky_to_texel(-0.5, 1.0, SIZE), [0.0, 0.0]);
        assert_eq!([sun_to_layer(-1.0, 40), sun_to_layer(2.0, 40)], [0.0, 39.0]);
    }

    #[test]
    fn every_layer_has_a_place_of_its_own() {
        let mut seen = Vec::new();
        for (haze, sun) in (0..2).flat_map(|haze| (0..5).map(move |sun| (haze, sun))) {
            seen.extend((0..SKY_PARTS).map(|part| SkyLayer { haze, sun, part }.index(5)));
        }
        assert!(seen.into_iter().eq(0..2 * 5 * SKY_PARTS));
    }
}
