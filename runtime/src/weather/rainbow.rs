//! The rainbow: what rain sends back of the light of sun or moon.
//!
//! # Theory
//! Rays that meet a drop off its middle are refracted, reflected inside and refracted again; after one reflection most leave 42 degrees from the antisolar
//! point, after two 51 degrees, and none between: Alexander's dark band. R. Descartes, "Les Météores", 1637; as sums over the impact parameter with Fresnel's
//! coefficients in H. C. van de Hulst, "Light Scattering by Small Particles", 1957, sections 12.2 and 13.2. Water's index is that of X. Quan, E. S. Fry,
//! "Empirical equation for the index of refraction of seawater", Applied Optics 34, 1995, eq. 3, fresh and at 20 degrees Celsius; colours are sums over the
//! spectrum by the functions of C. Wyman, P.-P. Sloan, P. Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", Journal of
//! Computer Graphics Techniques 2 (2), 2013. The sun's disc, half a degree wide, takes the edge off; waves, which add bows of small drops, are left out.
//!
//! # Practice
//! Two tables of [`TEXELS`] colours, made once when it first rains. What drops scatter evenly is the rain's haze; here is what there
//! is beyond the darkest of the band. One product and two reads of uniforms a pixel where it rains.

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use glam::{DVec3, Vec3};

use crate::clouds::shared::{CloudUniforms, overcast_weight};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::SkyParams;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("RAINBOW_LAST", Value::U32(TEXELS as u32 - 1)),
        ("RAINBOW_ENDS", Value::F32(ENDS)),
        ("RAINBOW_GROUND", Value::F32(GROUND)),
    ],
    structs: &[RainbowColour::WGSL, RainbowUniforms::WGSL],
    wgsl: include_str!("rainbow.wgsl"),
};

uniforms! {
    /// A colour of a bow.
    RainbowColour {
        /// The phase function of drops against all sides alike, less that of the dark band.
        colour: Vec3,
        /// Nothing.
        _pad: f32,
    }

    /// The rainbow, all 0 without.
    RainbowUniforms {
        /// Unit vector away from sun or moon.
        antisolar: Vec3,
        /// Cosine of the angle to it at which the first colour of the primary bow is.
        primary_from: f32,
        /// Radiance of what is scattered to all sides alike.
        light: Vec3,
        /// Colours of the primary bow, by the cosine.
        primary_per_cosine: f32,
        /// As of the primary one.
        secondary_from: f32,
        /// As of the primary one.
        secondary_per_cosine: f32,
        /// Cosine in the middle of the dark band.
        band: f32,
        /// Nothing.
        _pad: f32,
        /// From the inside.
        primary: [RainbowColour; TEXELS],
        /// From the inside.
        secondary: [RainbowColour; TEXELS],
    }
}

/// Colours of a bow.
pub const TEXELS: usize = 32;

/// Angles from the antisolar point between which the colours of a bow lie, in degrees. Inside of the first one and outside of the second it goes on as it ends.
pub const PRIMARY_DEG: [f64; 2] = [39.0, 43.4];
pub const SECONDARY_DEG: [f64; 2] = [49.2, 56.0];
/// The middle of Alexander's band, in degrees.
const BAND_DEG: f64 = 46.3;
/// How fast the rest fades outside of the secondary bow, by the cosine: it is gone 80 degrees from the antisolar point.
pub const ENDS: f32 = 2.6;
/// Share of the light that rain over the ground before it sends, by the sine of the depth below the horizon at which nothing is left.
pub const GROUND: f32 = 0.3;

/// Share of the sunlight that the rain in sight scatters where rain is 1. Chosen by eye.
const SCATTERED: f32 = 0.45;

/// Wavelengths in nanometres: from, to, and from one to the next.
const SPECTRUM_NM: [f64; 3] = [390.0, 730.0, 10.0];
/// Rays between the middle and the rim of a drop.
const RAYS: u32 = 3000;
/// Degrees that are told apart, from the antisolar point on.
const BIN_DEG: f64 = 0.05;
const BINS: usize = 1400;
/// Radius of sun and moon, in degrees.
const DISC_DEG: f64 = 0.267;

/// Both bows, from the inside.
static BOWS: LazyLock<[[Vec3; TEXELS]; 2]> = LazyLock::new(bows);

/// The rainbow's share of the uniforms. `params` are in range; `sun` is the unit direction towards sun or moon. Through an overcast no sunlight comes.
pub fn uniforms(params: &SkyParams, sun: Vec3, clouds: &CloudUniforms) -> RainbowUniforms {
    let amount = SCATTERED * params.weather.rain * (1.0 - overcast_weight(params.cover));
    if amount == 0.0 {
        return RainbowUniforms::default();
    }
    let cosines = |[from, to]: [f64; 2]| {
        let [from, to] = [from, to].map(|degrees| degrees.to_radians().cos());
        [from as f32, ((TEXELS - 1) as f64 / (from - to)) as f32]
    };
    let [primary, secondary] = BOWS.map(|bow| {
        bow.map(|colour| RainbowColour {
            colour,
            ..Default::default()
        })
    });
    let ([primary_from, primary_per_cosine], [secondary_from, secondary_per_cosine]) =
        (cosines(PRIMARY_DEG), cosines(SECONDARY_DEG));
    RainbowUniforms {
        antisolar: -sun,
        primary_from,
        // The clouds' sunlight is what a white surface sends back, E / pi; all around it would be E / 4 pi.
        light: 0.25 * amount * clouds.sunlight,
        primary_per_cosine,
        secondary_from,
        secondary_per_cosine,
        band: BAND_DEG.to_radians().cos() as f32,
        primary,
        secondary,
        ..Default::default()
    }
}

/// Colours of both bows, less the darkest of the band.
fn bows() -> [[Vec3; TEXELS]; 2] {
    let phase = phase_function();
    let at = |degrees: f64| under_the_disc(&phase, degrees);
    let dark = at(BAND_DEG);
    [PRIMARY_DEG, SECONDARY_DEG].map(|ends| {
        let [from, to] = ends.map(|degrees| degrees.to_radians().cos());
        std::array::from_fn(|i| {
            let share = i as f64 / (TEXELS - 1) as f64;
            let degrees = (from + (to - from) * share).acos().to_degrees();
            (at(degrees) - dark).max(DVec3::ZERO).as_vec3()
        })
    })
}

/// The phase function against all sides alike, in linear BT.709 under white light, by the angle to the antisolar point.
fn phase_function() -> Vec<DVec3> {
    let [from, to, step] = SPECTRUM_NM;
    let wavelengths = (0..=((to - from) / step) as u32).map(|i| from + step * f64::from(i));
    let mut sums = vec![DVec3::ZERO; BINS];
    let mut white = DVec3::ZERO;
    for wavelength_nm in wavelengths {
        let colour = bt709(wavelength_nm);
        white += colour;
        for (sum, phase) in sums.iter_mut().zip(monochrome(water(wavelength_nm))) {
            *sum += phase * colour;
        }
    }
    sums.into_iter().map(|sum| sum / white).collect()
}

/// Of a drop of this index, rays with one and two reflections inside and those that it reflects outside.
fn monochrome(index: f64) -> Vec<f64> {
    let mut energy = vec![0.0; BINS];
    for reflections in [0, 1, 2] {
        let mut before = antisolar_deg(index, 0.0, reflections);
        for ray in 1..=RAYS {
            let [near, far] = [ray - 1, ray].map(|i| f64::from(i) / f64::from(RAYS));
            let after = antisolar_deg(index, far, reflections);
            let share = (far * far - near * near) * passed(index, 0.5 * (near + far), reflections);
            spread(&mut energy, [before.min(after), before.max(after)], share);
            before = after;
        }
    }
    let edge = |i: usize| (BIN_DEG * i as f64).to_radians().cos();
    let bins = energy.iter().enumerate();
    // Against a sphere's 4 pi.
    bins.map(|(i, energy)| 4.0 * PI * energy / (TAU * (edge(i) - edge(i + 1))))
        .collect()
}

/// Adds a share evenly between two angles.
fn spread(bins: &mut [f64], [from, to]: [f64; 2], share: f64) {
    let [from, to] = [from / BIN_DEG, (to / BIN_DEG).max(from / BIN_DEG + 1e-9)];
    for bin in from as usize..=(to as usize).min(bins.len().saturating_sub(1)) {
        let inside = to.min((bin + 1) as f64) - from.max(bin as f64);
        if let Some(bin) = bins.get_mut(bin) {
            *bin += share * inside / (to - from);
        }
    }
}

/// The angle between where a ray leaves to and the antisolar point, by its distance from the drop's axis in radii. Without a reflection inside it is one
/// that never went in.
fn antisolar_deg(index: f64, impact: f64, reflections: u32) -> f64 {
    let (outside, inside) = (impact.asin(), (impact / index).asin());
    let turned = match reflections {
        0 => PI - 2.0 * outside,
        k => 2.0 * (outside - inside) + f64::from(k) * (PI - 2.0 * inside),
    };
    // Folded to 0 for straight back.
    (turned.rem_euclid(TAU) - PI).abs().to_degrees()
}

/// The share of unpolarised light that goes this way: A. Fresnel, 1823, as in van de Hulst, section 12.21.
fn passed(index: f64, impact: f64, reflections: u32) -> f64 {
    let (outside, inside) = (impact.asin(), (impact / index).asin());
    let (cos_out, cos_in) = (outside.cos(), inside.cos());
    let across = (cos_out - index * cos_in) / (cos_out + index * cos_in);
    let along = (index * cos_out - cos_in) / (index * cos_out + cos_in);
    let way = |amplitude: f64| {
        let reflected = amplitude * amplitude;
        match reflections {
            0 => reflected,
            k => (1.0 - reflected).powi(2) * reflected.powi(k as i32),
        }
    };
    0.5 * (way(across) + way(along))
}

/// The mean over a disc of even brightness, crossed by circles about the antisolar point that are nearly straight.
fn under_the_disc(phase: &[DVec3], degrees: f64) -> DVec3 {
    let reach = (DISC_DEG / BIN_DEG) as i64;
    let middle = (degrees / BIN_DEG) as i64;
    let mut sum = DVec3::ZERO;
    let mut weights = 0.0;
    for away in -reach..=reach {
        let share = away as f64 * BIN_DEG / DISC_DEG;
        let weight = (1.0 - share * share).max(0.0).sqrt();
        let bin = (middle + away).clamp(0, phase.len() as i64 - 1);
        sum += weight * phase[bin as usize];
        weights += weight;
    }
    sum / weights
}

/// Index of refraction of fresh water at 20 degrees Celsius: Quan and Fry, eq. 3.
fn water(wavelength_nm: f64) -> f64 {
    const CELSIUS: f64 = 20.0;
    let l = wavelength_nm;
    1.31405 - 2.02e-6 * CELSIUS * CELSIUS + (15.868 - 0.00423 * CELSIUS) / l - 4382.0 / (l * l)
        + 1.1455e6 / (l * l * l)
}

/// A wavelength of even power in linear BT.709, outside of its gamut as it is: Wyman, Sloan and Shirley, listing 2; ITU-R BT.709-6, item 1.3.
fn bt709(wavelength_nm: f64) -> DVec3 {
    let lobe = |middle: f64, below: f64, above: f64| {
        let away = wavelength_nm - middle;
        let width = if away < 0.0 { below } else { above };
        (-0.5 * (away / width).powi(2)).exp()
    };
    let x = 1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7)
        - 0.065 * lobe(501.1, 20.4, 26.2);
    let y = 0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1);
    let z = 1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8);
    DVec3::new(
        3.2406 * x - 1.5372 * y - 0.4986 * z,
        -0.9689 * x + 1.8758 * y + 0.0415 * z,
        0.0557 * x - 0.2040 * y + 1.0570 * z,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Descartes: where the angle turns back, `cos i = sqrt((n^2 - 1) / (k (k + 2)))`.
    fn descartes_deg(index: f64, reflections: u32) -> f64 {
        let k = f64::from(reflections);
        let outside = ((index * index - 1.0) / (k * (k + 2.0))).sqrt().acos();
        antisolar_deg(index, outside.sin(), reflections)
    }

    #[test]
    fn water_has_its_index_and_bows_their_angles() {
        // Sodium's D line at 20 degrees Celsius, 1.3330: International Association for the Properties of Water and Steam, R9-97.
        assert!((water(589.3) - 1.3330).abs() < 1e-4);
        // From D. K. Lynch, W. Livingston, "Color and Light in Nature", 1995: 42 and 51 degrees, red outside in the first and inside in the second.
        let [red, violet] = [700.0, 400.0].map(water);
        assert!((descartes_deg(red, 1) - 42.4).abs() < 0.2);
        assert!((descartes_deg(violet, 1) - 40.6).abs() < 0.2);
        assert!((descartes_deg(red, 2) - 50.4).abs() < 0.3);
        assert!((descartes_deg(violet, 2) - 53.6).abs() < 0.3);
    }

    #[test]
    fn no_light_is_lost_in_a_drop() {
        for impact in [0.1, 0.5, 0.861, 0.95, 0.999] {
            let sum: f64 = (0..200).map(|k| passed(1.333, impact, k)).sum();
            // What goes through without a reflection is not asked for anywhere else.
            let (outside, inside) = (f64::asin(impact), f64::asin(impact / 1.333));
            let across = (outside - inside).sin() / (outside + inside).sin();
            let along = (outside - inside).tan() / (outside + inside).tan();
            let through = 0.5 * ((1.0 - across * across).powi(2) + (1.0 - along * along).powi(2));
            assert!(
                (sum + through - 1.0).abs() < 1e-9,
                "{impact}: {sum} {through}"
            );
        }
    }

    #[test]
    fn energy_is_where_rays_go() {
        let index = water(550.0);
        let phase = monochrome(index);
        let edge = |i: usize| (BIN_DEG * i as f64).to_radians().cos();
        let found: f64 = phase
            .iter()
            .enumerate()
            .map(|(i, p)| 0.5 * p * (edge(i) - edge(i + 1)))
            .sum();
        let rays = (0..100_000).map(|i| (f64::from(i) + 0.5) / 1e5);
        let expected: f64 = rays
            .flat_map(|impact| [0, 1, 2].map(|k| (impact, k)))
            .filter(|&(impact, k)| antisolar_deg(index, impact, k) < BIN_DEG * BINS as f64)
            .map(|(impact, k)| 2e-5 * impact * passed(index, impact, k))
            .sum();
        assert!(
            (found - expected).abs() < 0.01 * expected,
            "{found} {expected}"
        );
    }

    #[test]
    fn red_is_outside_of_the_first_bow_and_inside_of_the_second_with_the_band_between() {
        let phase = phase_function();
        let at = |degrees: f64| under_the_disc(&phase, degrees);
        let brightest = |channel: usize, [from, to]: [f64; 2]| {
            let places = (0..400).map(|i| from + (to - from) * f64::from(i) / 400.0);
            places
                .max_by(|&a, &b| at(a)[channel].total_cmp(&at(b)[channel]))
                .unwrap()
        };
        let [red, green, blue] = [0, 1, 2].map(|c| brightest(c, [38.0, 44.0]));
        assert!(blue < green && green < red, "{red} {green} {blue}");
        // Half the sun's width inside of where Descartes has the longest waves that count.
        assert!((red - descartes_deg(water(620.0), 1)).abs() < 0.35, "{red}");
        let [red, green, blue] = [0, 1, 2].map(|c| brightest(c, [49.0, 57.0]));
        assert!(red < green && green < blue, "{red} {green} {blue}");
        for channel in 0..3 {
            let [inside, band, outside] = [36.0, BAND_DEG, 58.0].map(|d| at(d)[channel]);
            assert!(band < inside && band < outside, "{inside} {band} {outside}");
        }
        // Rays of the second bow have less light, and spread over more of the sky: `F b sqrt(1 / h) / sin`, van de Hulst, section 13.2.
        let strength = |k: u32| {
            let (n2, p) = (water(550.0).powi(2), f64::from(k) + 1.0);
            let impact = 1.0 - (n2 - 1.0) / (p * p - 1.0);
            let impact = impact.sqrt();
            let h = (p * p - 1.0).powi(2) / (p * p) * ((p * p - n2) / (n2 - 1.0).powi(3)).sqrt();
            let angle = antisolar_deg(n2.sqrt(), impact, k).to_radians();
            passed(n2.sqrt(), impact, k) * impact / h.sqrt() / angle.sin()
        };
        let peak = |range: [f64; 2]| at(brightest(1, range)).y - at(BAND_DEG).y;
        let found = peak([49.0, 57.0]) / peak([38.0, 44.0]);
        // Colours of the second one lie farther apart, which takes a fifth of its peak.
        let expected = strength(2) / strength(1);
        assert!(
            (0.7..1.0).contains(&(found / expected)),
            "{found} {expected}"
        );
    }

    #[test]
    fn colours_of_an_even_spectrum_are_white() {
        let sum = |i: u32| bt709(390.0 + f64::from(i));
        let white: DVec3 = (0..=340).map(sum).fold(DVec3::ZERO, |a, b| a + b);
        // CIE illuminant E in BT.709.
        let found = white / white.y * 0.9484;
        assert!(
            (found - DVec3::new(1.2048, 0.9484, 0.9087))
                .abs()
                .max_element()
                < 0.02,
            "{found}"
        );
    }
}
