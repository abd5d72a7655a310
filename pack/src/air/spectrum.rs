//! The wavelengths that light is computed at, what the atmosphere does to each, and their colour.
//!
//! Three wavelengths taken as red, green and blue make twilight purple: ozone's broad yellow band and the
//! steep law of Rayleigh need more (E. Bruneton, "A Qualitative and Quantitative Evaluation of 8 Clear Sky
//! Models", IEEE TVCG 23, 2017). Eight are enough for spectra this smooth.

/// How many wavelengths.
pub const COUNT: usize = 8;

/// One value a wavelength.
pub type Spectrum = [f32; COUNT];

/// Wavelengths, nm.
pub const WAVELENGTHS_NM: Spectrum = [400.0, 440.0, 480.0, 520.0, 560.0, 600.0, 640.0, 680.0];

/// Rayleigh scattering of air at the ground for a wavelength of one micrometre, 1/km; it goes with the
/// inverse fourth power (C. Penndorf, "Tables of the Refractive Index for Standard Air and the Rayleigh
/// Scattering Coefficient", J. Opt. Soc. Am. 47, 1957; figure as used by Bruneton 2017).
const AIR_AT_MICROMETRE: f32 = 1.240_62e-3;

/// Absorption cross-sections of ozone at 233 K at the wavelengths above, in 1e-25 m2 (V. Gorshelev et al.,
/// "High spectral resolution ozone absorption cross-sections - Part 1", Atmos. Meas. Tech. 7, 2014).
const OZONE_CROSS_SECTIONS: Spectrum = [0.0153, 0.158, 0.775, 2.14, 4.27, 5.02, 2.66, 1.21];

/// Molecules of ozone in the densest part of its layer, in 1e25 a cubic metre, times metres a kilometre:
/// 300 Dobson units in a tent of [`super::layers::OZONE_KM`].
const OZONE_PER_KM: f32 = 5.37e-4;

/// Irradiance of the sun above the air at the wavelengths above, in W/(m2 nm): means over 40 nm of ASTM E490-00, "Standard Solar Constant
/// and Zero Air Mass Solar Spectral Irradiance Tables".
pub const SUN: Spectrum = [1.46, 1.854, 1.970, 1.872, 1.837, 1.746, 1.602, 1.480];

/// Exponent of the wavelength in the aerosol's extinction (A. Angstrom, "On the Atmospheric Transmission of Sun Radiation and on Dust
/// in the Air", Geografiska Annaler 11, 1929): see [`super`].
pub const AEROSOL_EXPONENT: f32 = -1.26;

/// Rayleigh scattering at the ground, 1/km.
pub fn rayleigh() -> Spectrum {
    WAVELENGTHS_NM.map(|nm| {
        let um2 = (nm * 1e-3) * (nm * 1e-3);
        AIR_AT_MICROMETRE / (um2 * um2)
    })
}

/// Absorption of the densest ozone, 1/km.
pub fn ozone() -> Spectrum {
    OZONE_CROSS_SECTIONS.map(|c| c * OZONE_PER_KM)
}

/// Optical depth of aerosol to the zenith, from that at 550 nm.
pub fn aerosol(depth: f32) -> Spectrum {
    WAVELENGTHS_NM.map(|nm| depth * libm::powf(nm / 550.0, AEROSOL_EXPONENT))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_are_those_of_the_three_wavelength_models() {
        // S. Hillaire 2020, table 1: ozone 0.085e-3 and air 33.1e-3 at 440 nm, 0.65e-3 at 680 nm; they are
        // the same measurements, rounded.
        assert!(
            (rayleigh()[1] - 33.1e-3).abs() < 0.2e-3,
            "{}",
            rayleigh()[1]
        );
        assert!((ozone()[1] - 0.085e-3).abs() < 0.002e-3, "{}", ozone()[1]);
        assert!((ozone()[7] - 0.650e-3).abs() < 0.002e-3, "{}", ozone()[7]);
    }
}
