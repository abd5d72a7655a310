//! The colour of spectra.

use std::sync::LazyLock;

use super::layers::{CLEAR_AEROSOL_DEPTH, WHITE_ELEVATION_RAD, sun_transmittance};
use super::spectrum::{COUNT, SUN, Spectrum, WAVELENGTHS_NM};

/// XYZ (CIE 1931) to linear BT.709 (ITU-R BT.709-6, items 1.3 and 1.4).
const XYZ_TO_RGB: [[f32; 3]; 3] = [
    [3.2406, -1.5372, -0.4986],
    [-0.9689, 1.8758, 0.0415],
    [0.0557, -0.2040, 1.0570],
];

/// Luminance of linear BT.709 (ITU-R BT.709-6, item 3.2).
const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Turns spectra into linear BT.709 as a camera with its white balance set to daylight does.
///
/// A spectrum is given as a share of the sun's above the air. White is direct sunlight on a clear day with the sun at
/// [`WHITE_ELEVATION_RAD`]; the channels are scaled to it (J. von Kries, "Chromatic adaptation", 1902), its luminance is kept.
#[derive(Clone, Copy, Debug)]
pub struct Colour {
    weights: [Spectrum; 3],
}

impl Default for Colour {
    fn default() -> Colour {
        Colour::new()
    }
}

impl Colour {
    /// As above. The sun's light above the air has a luminance of 1.
    pub fn new() -> Colour {
        let plain = Colour::of_the_sun();
        let white = plain.rgb(&sun_transmittance(WHITE_ELEVATION_RAD, CLEAR_AEROSOL_DEPTH));
        let level = luminance(white);
        plain.scaled(white.map(|channel| level / channel))
    }

    /// The same, made once: for what asks every frame.
    pub fn daylight() -> &'static Colour {
        static DAYLIGHT: LazyLock<Colour> = LazyLock::new(Colour::new);
        &DAYLIGHT
    }

    /// Without any white balance: of sunlight as it is above the air, which has a luminance of 1.
    pub fn of_the_sun() -> Colour {
        let matching = WAVELENGTHS_NM.map(colour_matching);
        let weights = XYZ_TO_RGB.map(|row| -> Spectrum {
            std::array::from_fn(|i| {
                let [x, y, z] = matching[i];
                SUN[i] * (row[0] * x + row[1] * y + row[2] * z)
            })
        });
        Colour { weights }.scaled([1.0; 3])
    }

    /// With channels scaled by gains, and all of them so that sunlight has a luminance of 1.
    fn scaled(mut self, gains: [f32; 3]) -> Colour {
        let sun = self.rgb(&[1.0; COUNT]);
        let whole = luminance([0, 1, 2].map(|c| sun[c] * gains[c]));
        for (weights, gain) in self.weights.iter_mut().zip(gains) {
            *weights = weights.map(|w| w * gain / whole);
        }
        self
    }

    /// Colours outside BT.709 are cut to its border.
    pub fn rgb(&self, spectrum: &Spectrum) -> [f32; 3] {
        self.weights.map(|weights| {
            let sum: f32 = weights.iter().zip(spectrum).map(|(w, s)| w * s).sum();
            sum.max(0.0)
        })
    }
}

fn luminance(rgb: [f32; 3]) -> f32 {
    LUMINANCE.iter().zip(rgb).map(|(l, c)| l * c).sum()
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
    fn sunlight_is_white_and_single_wavelengths_have_their_hue() {
        let colour = Colour::new();
        let white = colour.rgb(&sun_transmittance(WHITE_ELEVATION_RAD, CLEAR_AEROSOL_DEPTH));
        // Weights are normalised by their own sum; only rounding is left.
        assert!(
            white.iter().all(|c| (c - white[0]).abs() < 1e-5),
            "{white:?}"
        );
        assert!((luminance(colour.rgb(&[1.0; COUNT])) - 1.0).abs() < 1e-5);
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
    fn the_solar_spectrum_carries_the_known_light() {
        // 683 lm/W times the integral with the luminous efficiency: 133 klx (Darula and others 2005), within the 2 % of eight steps.
        let lux: f32 = (0..COUNT)
            .map(|i| 683.0 * SUN[i] * 40.0 * colour_matching(WAVELENGTHS_NM[i])[1])
            .sum();
        assert!(
            (lux / crate::air::layers::SUN_ILLUMINANCE_LX - 1.0).abs() < 0.03,
            "{lux}"
        );
    }
}
