//! The wavelengths that light is computed at, what the atmosphere does to each, and their colour.
//!
//! Three wavelengths taken as red, green and blue make twilight purple: ozone's broad yellow band and the
//! steep law of Rayleigh need more (E. Bruneton, "A Qualitative and Quantitative Evaluation of 8 Clear Sky
//! Models", IEEE TVCG 23, 2017). Eight are enough for spectra this smooth.

/// How many wavelengths.
pub(super) const COUNT: usize = 8;

/// One value a wavelength.
pub(super) type Spectrum = [f32; COUNT];

/// Wavelengths, nm.
const WAVELENGTHS_NM: Spectrum = [400.0, 440.0, 480.0, 520.0, 560.0, 600.0, 640.0, 680.0];

/// Rayleigh scattering of air at the ground for a wavelength of one micrometre, 1/km; it goes with the
/// inverse fourth power (C. Penndorf, "Tables of the Refractive Index for Standard Air and the Rayleigh
/// Scattering Coefficient", J. Opt. Soc. Am. 47, 1957; figure as used by Bruneton 2017).
const AIR_AT_MICROMETRE: f32 = 1.240_62e-3;

/// Absorption cross-sections of ozone at 233 K at the wavelengths above, in 1e-25 m2 (V. Gorshelev et al.,
/// "High spectral resolution ozone absorption cross-sections - Part 1", Atmos. Meas. Tech. 7, 2014).
const OZONE_CROSS_SECTIONS: Spectrum = [0.0153, 0.158, 0.775, 2.14, 4.27, 5.02, 2.66, 1.21];

/// Molecules of ozone in the densest part of its layer, in 1e25 a cubic metre, times metres a kilometre:
/// 300 Dobson units in a layer of the shape that `atmosphere.rs` gives it.
const OZONE_PER_KM: f32 = 5.37e-4;

/// Rayleigh scattering at the ground, 1/km.
pub(super) fn air() -> Spectrum {
    WAVELENGTHS_NM.map(|nm| {
        let um2 = (nm * 1e-3) * (nm * 1e-3);
        AIR_AT_MICROMETRE / (um2 * um2)
    })
}

/// Absorption of the densest ozone, 1/km.
pub(super) fn ozone() -> Spectrum {
    OZONE_CROSS_SECTIONS.map(|c| c * OZONE_PER_KM)
}

/// XYZ (CIE 1931) to linear BT.709 (ITU-R BT.709-6, items 1.3 and 1.4).
const XYZ_TO_RGB: [[f32; 3]; 3] = [
    [3.2406, -1.5372, -0.4986],
    [-0.9689, 1.8758, 0.0415],
    [0.0557, -0.2040, 1.0570],
];

/// Turns spectra of reflectance or radiance into linear BT.709.
pub(super) struct Colour {
    weights: [Spectrum; 3],
}

impl Colour {
    /// A spectrum of ones becomes white, (1, 1, 1): the sun's own colour is white. (Its spectrum falls by
    /// less than a fifth to either side of its middle over these wavelengths and is taken as flat.)
    pub(super) fn new() -> Colour {
        let matching = WAVELENGTHS_NM.map(colour_matching);
        let weights = XYZ_TO_RGB.map(|row| {
            let weight = matching.map(|xyz| row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2]);
            let sum: f32 = weight.iter().sum();
            weight.map(|w| w / sum)
        });
        Colour { weights }
    }

    /// Colours outside BT.709 are cut to its border.
    pub(super) fn rgb(&self, spectrum: &Spectrum) -> [f32; 3] {
        self.weights.map(|weights| {
            let sum: f32 = weights.iter().zip(spectrum).map(|(w, s)| w * s).sum();
            sum.max(0.0)
        })
    }
}

/// CIE 1931 colour matching functions, fitted by sums of lobes.
///
/// C. Wyman, P.-P. Sloan, P. Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching
/// Functions", JCGT 2(2), 2013, eq. 4.
fn colour_matching(nm: f32) -> [f32; 3] {
    let lobe = |height: f32, middle: f32, below: f32, above: f32| {
        let t = (nm - middle) / if nm < middle { below } else { above };
        height * libm::expf(-0.5 * t * t)
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7)
            - lobe(0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_spectrum_is_white_and_single_wavelengths_have_their_hue() {
        let colour = Colour::new();
        // Weights are normalised by their own sum; only rounding is left.
        assert!(
            colour
                .rgb(&[1.0; COUNT])
                .iter()
                .all(|c| (c - 1.0).abs() < 1e-5)
        );
        let alone =
            |at: usize| colour.rgb(&std::array::from_fn(|i| if i == at { 1.0 } else { 0.0 }));
        let [r, g, b] = alone(1);
        assert!(b > r && b > g, "440 nm is blue");
        let [r, g, b] = alone(3);
        assert!(g > r && g > b, "520 nm is green");
        let [r, g, b] = alone(6);
        assert!(r > g && r > b, "640 nm is red");
    }

    #[test]
    fn coefficients_are_those_of_the_three_wavelength_models() {
        // S. Hillaire 2020, table 1: ozone 0.085e-3 and air 33.1e-3 at 440 nm, 0.65e-3 at 680 nm; they are
        // the same measurements, rounded.
        assert!((air()[1] - 33.1e-3).abs() < 0.2e-3, "{}", air()[1]);
        assert!((ozone()[1] - 0.085e-3).abs() < 0.002e-3, "{}", ozone()[1]);
        assert!((ozone()[7] - 0.650e-3).abs() < 0.002e-3, "{}", ozone()[7]);
    }
}
