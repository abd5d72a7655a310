//! What the layers of the air leave of the sun's light.

use std::f32::consts::PI;

use super::spectrum::{Spectrum, aerosol, ozone, rayleigh};

/// Illuminance of the sun's light above the air, at its mean distance, in lux. S. Darula, R. Kittler, C. A. Gueymard, "Reference
/// luminous solar constant and solar luminance for illuminance calculations", Solar Energy 79, 2005.
pub const SUN_ILLUMINANCE_LX: f32 = 133_334.0;

/// Scale height of molecules, km (S. Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020, table 1).
pub const MOLECULE_SCALE_KM: f32 = 8.0;
/// Scale height of aerosol, km (Hillaire 2020, table 1).
pub const AEROSOL_SCALE_KM: f32 = 1.2;
/// Middle and half width of the layer of ozone, a tent, in km (Hillaire 2020, table 1).
pub const OZONE_KM: [f32; 2] = [25.0, 15.0];

/// Optical depth of the aerosol of a clear continental day, to the zenith at 550 nm. It makes Linke's turbidity 2.6 with 1.5 cm of
/// water (F. Kasten, "The Linke turbidity factor based on improved values of the integral Rayleigh optical thickness", Solar Energy
/// 56, 1996): a very clear day.
pub const CLEAR_AEROSOL_DEPTH: f32 = 0.04;

/// Elevation of the sun whose light is white, in radians: 60 degrees.
pub const WHITE_ELEVATION_RAD: f32 = PI / 3.0;

/// Share of the sun's light that reaches the ground at an apparent elevation, at every wavelength. `aerosol_depth` is that to the
/// zenith at 550 nm. From below the horizon it is that of the horizon.
pub fn sun_transmittance(elevation_rad: f32, aerosol_depth: f32) -> Spectrum {
    let degrees = (elevation_rad * (180.0 / PI)).max(0.0);
    let [air, haze, layer] = air_masses(degrees);
    let (molecules, ozone, aerosol) = (rayleigh(), ozone(), aerosol(aerosol_depth));
    std::array::from_fn(|i| {
        let depth = molecules[i] * MOLECULE_SCALE_KM * air
            + aerosol[i] * haze
            + ozone[i] * OZONE_KM[1] * layer;
        libm::expf(-depth)
    })
}

/// Relative air masses of molecules, aerosol and ozone at an elevation in degrees.
///
/// Molecules: F. Kasten, A. T. Young, "Revised optical air mass tables and approximation formula", Applied Optics 28, 1989, eq. 3.
/// Aerosol: C. A. Gueymard, "Parameterized transmittance model for direct beam and circumsolar spectral irradiance", Solar Energy 71,
/// 2001, table A.1. Ozone: a thin shell, N. Robinson, "Solar Radiation", 1966, p. 54.
fn air_masses(degrees: f32) -> [f32; 3] {
    let zenith = 90.0 - degrees;
    let sin = libm::sinf(degrees * (PI / 180.0));
    let air = 1.0 / (sin + 0.50572 * libm::powf(degrees + 6.07995, -1.6364));
    let haze = 1.0
        / (sin
            + 0.16851
                * libm::powf(zenith.max(1e-3), 0.18198)
                * libm::powf(95.318 - zenith, -1.9542));
    let shell = 1.0 + OZONE_KM[0] / 6360.0;
    let layer = shell / libm::sqrtf((sin * sin + shell * shell - 1.0).max(1e-6));
    [air, haze, layer]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::spectrum::COUNT;

    #[test]
    fn air_masses_are_those_of_the_tables() {
        // Kasten and Young 1989, table II.
        for (degrees, mass) in [(90.0, 1.0), (30.0, 1.9939), (10.0, 5.5841), (0.0, 37.92)] {
            let [air, haze, layer] = air_masses(degrees);
            assert!((air / mass - 1.0).abs() < 2e-3, "{degrees}: {air}");
            // Aerosol lies lower than air and ozone higher, so the one is farther to cross at the horizon, the other less far.
            assert!(
                haze > air * 0.999 && layer < air * 1.001,
                "{degrees}: {haze} {layer}"
            );
        }
    }

    #[test]
    fn a_lower_sun_is_dimmer_and_redder() {
        let at = |degrees: f32| sun_transmittance(degrees.to_radians(), CLEAR_AEROSOL_DEPTH);
        let mut last = at(90.0);
        for degrees in (0..90).rev() {
            let now = at(degrees as f32);
            assert!(now.iter().zip(&last).all(|(n, l)| n < l), "{degrees}");
            assert!(
                now[COUNT - 1] / now[0] > last[COUNT - 1] / last[0],
                "{degrees}"
            );
            last = now;
        }
        assert_eq!(at(-5.0), at(0.0));
    }
}
