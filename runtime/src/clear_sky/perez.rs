//! The clear sky of Perez and others: equations 1 and 2 of Mukhina and Bezgodov.
//!
//! # Theory
//! The luminance of a sky element at the zenith angle xi, an angle gamma from the sun, over that of the zenith:
//!
//! ```text
//! f(xi, gamma) = [1 + a exp(b / cos xi)] [1 + c exp(d gamma) + e cos^2 gamma]     (1)
//! L = L_z f(xi, gamma) / f(0, Z)                                                  (2)
//! ```
//!
//! with Z the zenith angle of the sun. K. Mukhina, A. Bezgodov, "The Method for Real-time Cloud Rendering", Procedia
//! Computer Science 66, 2015, after R. Perez, R. Seals, J. Michalsky, "All-weather model for sky luminance
//! distribution", Solar Energy 50(3), 1993. The numbers a to e come from
//! - A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999, appendix A.2, as
//!   functions of the turbidity, which gives both chromaticities x and y by the same equations;
//! - CIE S 011/E:2003 (ISO 15469:2004), "Spatial distribution of daylight, CIE standard general sky", table 1: see [`crate::clear_sky::cie`];
//! - the user.
//!
//! # Changes versus the papers
//! - The absolute level comes from the pack's table, not from the published zenith luminance: the mean
//!   luminance of the hemisphere is the table's at that time, so exposure, dusk and night are the same with both
//!   models.
//! - A sun below the horizon counts as one on it. From there to 6 degrees below, the end of civil twilight, all goes
//!   over to the table: Perez's data know no night.
//! - The CIE's indicatrix is `1 + c [exp(d gamma) - exp(d pi / 2)] + e cos^2 gamma`. The paper's and Preetham's have no
//!   second exponential. Each source is followed for its own numbers; the user's are the paper's.
//! - The standard tells luminance only. Its overcast skies (types 1 to 5) are white, D65; all others have Preetham's
//!   chromaticities, for the turbidity of the parameters.
//! - The published chromaticities stray from those of daylight, by up to 0.08 in y: acid yellow around a low sun, green
//!   in the zenith above it, mauve on the horizon of noon. Two thirds of the way from them to the daylight locus are
//!   gone, at the same x: `y = -3 x^2 + 2.87 x - 0.275`, D. B. Judd, D. L. MacAdam, G. Wyszecki, "Spectral
//!   Distribution of Typical Daylight as a Function of Correlated Color Temperature", JOSA 54(8), 1964.
//! - What lies outside BT.709 would be cut off at 0; after the step above nothing does.
//! - The aureole stands for the table's.
//!
//! # Practice
//! Six exponentials (two steps of three), a division, an arc cosine by polynomial a pixel; the table is read only in
//! twilight. A thousand exponentials a frame for the mean luminance, some ten microseconds. On an H200 at 1920x1080 it
//! takes 0.07 ms more than the table.

use std::f32::consts::{FRAC_PI_2, LOG2_E, PI};

use glam::{Vec3, Vec4};

use crate::clear_sky::cie;
use crate::clear_sky::light::Light;
use crate::geometry::math::{luminance, smoothstep};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::{PerezParams, PerezShape, SkyModel};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("PEREZ_LEAST_COSINE", Value::F32(LEAST_COSINE)),
        ("PEREZ_TO_DAYLIGHT", Value::F32(TO_DAYLIGHT)),
        ("PEREZ_ACOS", Value::Vec4(ACOS)),
        ("PEREZ_DAYLIGHT", Value::Vec3(Vec3::from_array(DAYLIGHT))),
        ("PEREZ_RGB_X", Value::Vec3(RGB_OF_XYZ[0])),
        ("PEREZ_RGB_Y", Value::Vec3(RGB_OF_XYZ[1])),
        ("PEREZ_RGB_Z", Value::Vec3(RGB_OF_XYZ[2])),
    ],
    structs: &[PerezUniforms::WGSL],
    wgsl: include_str!("perez.wgsl"),
};

uniforms! {
    /// The clear sky of Perez and others. Each of a to e, base and zenith holds luminance, chromaticity x and chromaticity y, and nothing in w.
    PerezUniforms {
        /// Unit direction towards the sun, or to the horizon above it.
        sun_direction: Vec3,
        /// Weight of this model, 0 where the table draws alone.
        weight: f32,
        /// How the horizon darkens (above 0) or brightens.
        a: Vec4,
        /// How fast, times log2 of e.
        b: Vec4,
        /// Strength of the aureole.
        c: Vec4,
        /// How fast it falls, times log2 of e.
        d: Vec4,
        /// Light scattered back.
        e: Vec4,
        /// What aureole and backscatter are added to.
        base: Vec4,
        /// The value at the zenith, over f(0, Z).
        zenith: Vec4,
    }
}

/// Sine of the depression of the sun at which nothing of this model is left: 6 degrees, the end of civil twilight.
pub const TWILIGHT_END: f32 = 0.104_528_46;

/// Sky elements are never nearer to the horizon than this sine (0.6 degrees): there `b / cos xi` ends.
pub const LEAST_COSINE: f32 = 0.01;

/// Coefficients of the arc cosine. M. Abramowitz, I. A. Stegun, "Handbook of Mathematical Functions", 1964, eq. 4.4.45.
pub const ACOS: [f32; 4] = [1.570_728_8, -0.212_114_4, 0.074_261, -0.018_729_3];

/// Columns of the matrix from CIE XYZ to linear BT.709. ITU-R BT.709-6, 2015, primaries and white (D65) of item 1.4, 1.5.
pub const RGB_OF_XYZ: [Vec3; 3] = [
    Vec3::new(3.240_97, -0.969_244, 0.055_63),
    Vec3::new(-1.537_383, 1.875_968, -0.203_977),
    Vec3::new(-0.498_611, 0.041_555, 1.056_972),
];

/// The chromaticity y of daylight over x: the constant, the factors of x and of its square. Judd and others, 1964.
pub const DAYLIGHT: [f32; 3] = [-0.275, 2.87, -3.0];
/// Share of the way to it that the published y goes.
pub const TO_DAYLIGHT: f32 = 0.667;

/// Chromaticity of D65. ITU-R BT.709-6, 2015, item 1.5.
pub const WHITE: [f32; 2] = [0.3127, 0.3290];

/// Rings and sectors (of half the hemisphere) over which the mean is taken.
const MEAN_SIDE: u32 = 32;

/// Equation 1 with its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distribution {
    /// Darkening (above 0) or brightening of the horizon.
    pub a: f32,
    /// How fast the gradation goes, below 0.
    pub b: f32,
    /// Strength of the aureole.
    pub c: f32,
    /// How fast it falls with the angle to the sun, in 1 / rad, below 0.
    pub d: f32,
    /// Light scattered back.
    pub e: f32,
    /// What aureole and backscatter are added to: 1, less in the standard's indicatrix.
    pub base: f32,
}

impl Distribution {
    /// The paper's and Preetham's equation 1.
    pub const fn new([a, b, c, d, e]: [f32; 5]) -> Distribution {
        Distribution {
            a,
            b,
            c,
            d,
            e,
            base: 1.0,
        }
    }

    /// The standard's, which is 1 at a right angle to the sun.
    pub fn cie(numbers: [f32; 5]) -> Distribution {
        let defaults = Distribution::new(numbers);
        Distribution {
            base: 1.0 - defaults.c * (defaults.d * FRAC_PI_2).exp(),
            ..defaults
        }
    }

    /// The same value everywhere.
    const UNIFORM: Distribution = Distribution::new([0.0, -1.0, 0.0, -1.0, 0.0]);

    /// f, from the cosines of the zenith angle and of the angle to the sun.
    pub fn at(&self, cos_zenith: f32, cos_sun: f32) -> f32 {
        let gradation = 1.0 + self.a * (self.b / cos_zenith.max(LEAST_COSINE)).exp();
        gradation * self.indicatrix(cos_sun)
    }

    fn indicatrix(&self, cos_sun: f32) -> f32 {
        let cosine = cos_sun.clamp(-1.0, 1.0);
        self.base + self.c * (self.d * acos(cosine)).exp() + self.e * cosine * cosine
    }

    /// Mean over the hemisphere, by solid angle, with a sun at that sine of elevation (0..1).
    ///
    /// Rings of equal solid angle, sectors on one side of the sun's meridian: the other is its mirror image.
    pub fn mean(&self, sin_sun: f32) -> f32 {
        let cos_sun = (1.0 - sin_sun * sin_sun).max(0.0).sqrt();
        let middle = |index: u32| (index as f32 + 0.5) / MEAN_SIDE as f32;
        let sectors: [f32; MEAN_SIDE as usize] =
            std::array::from_fn(|i| (PI * middle(i as u32)).cos());
        let mut sum = 0.0;
        for ring in (0..MEAN_SIDE).map(middle) {
            let across = (1.0 - ring * ring).sqrt() * cos_sun;
            let indicatrices = sectors.map(|s| self.indicatrix(ring * sin_sun + across * s));
            let gradation = 1.0 + self.a * (self.b / ring.max(LEAST_COSINE)).exp();
            sum += gradation * indicatrices.iter().sum::<f32>();
        }
        sum / (MEAN_SIDE * MEAN_SIDE) as f32
    }
}

/// The distribution of luminance.
pub fn luminance_distribution(params: &PerezParams) -> Distribution {
    let t = params.turbidity;
    match params.shape {
        PerezShape::Preetham => Distribution::new([
            0.1787 * t - 1.4630,
            -0.3554 * t + 0.4275,
            -0.0227 * t + 5.3251,
            0.1206 * t - 2.5771,
            -0.0670 * t + 0.3703,
        ]),
        PerezShape::Cie(number) => {
            let index = usize::from(number).clamp(1, cie::SKIES.len()) - 1;
            Distribution::cie(cie::SKIES[index].numbers)
        }
        PerezShape::Custom(numbers) => Distribution::new(numbers),
    }
}

/// The distributions of the chromaticities x and y. Preetham and others, appendix A.2.
pub fn chromaticity_distributions(turbidity: f32) -> [Distribution; 2] {
    let t = turbidity;
    [
        Distribution::new([
            -0.0193 * t - 0.2592,
            -0.0665 * t + 0.0008,
            -0.0004 * t + 0.2125,
            -0.0641 * t - 0.8989,
            -0.0033 * t + 0.0452,
        ]),
        Distribution::new([
            -0.0167 * t - 0.2608,
            -0.0950 * t + 0.0092,
            -0.0079 * t + 0.2102,
            -0.0441 * t - 1.6537,
            -0.0109 * t + 0.0529,
        ]),
    ]
}

/// Chromaticities x and y of the zenith. Preetham and others, appendix A.2.
pub fn zenith_chromaticity(turbidity: f32, sun_zenith_rad: f32) -> [f32; 2] {
    // Rows: squared turbidity, turbidity, 1. Columns: from the cube of the angle down.
    const X: [[f32; 4]; 3] = [
        [0.00166, -0.00375, 0.00209, 0.0],
        [-0.02903, 0.06377, -0.03202, 0.00394],
        [0.11693, -0.21196, 0.06052, 0.25886],
    ];
    const Y: [[f32; 4]; 3] = [
        [0.00275, -0.00610, 0.00317, 0.0],
        [-0.04214, 0.08970, -0.04153, 0.00516],
        [0.15346, -0.26756, 0.06670, 0.26688],
    ];
    let cubic = |row: &[f32; 4]| row.iter().fold(0.0, |sum, k| sum * sun_zenith_rad + k);
    [X, Y].map(|rows| {
        rows.iter()
            .fold(0.0, |sum, row| sum * turbidity + cubic(row))
    })
}

/// Arc cosine of -1..1, as the shader has it: off by 7e-5 at most.
pub fn acos(cosine: f32) -> f32 {
    let x = cosine.abs();
    let [p, q, r, s] = ACOS;
    let angle = (1.0 - x).sqrt() * (p + x * (q + x * (r + x * s)));
    if cosine < 0.0 { PI - angle } else { angle }
}

impl PerezUniforms {
    /// Radiance along a unit direction, by the same lines as the shader's; `table` is that of the table.
    pub fn radiance(&self, direction: Vec3, table: Vec3) -> Vec3 {
        if self.weight == 0.0 {
            return table;
        }
        let cosine = direction.dot(self.sun_direction).clamp(-1.0, 1.0);
        let exp2 = |v: Vec3| v.map(f32::exp2);
        let [a, b, c, d, e] = [self.a, self.b, self.c, self.d, self.e].map(Vec4::truncate);
        let gradation = 1.0 + a * exp2(b / direction.y.max(LEAST_COSINE));
        let aureole = c * exp2(d * acos(cosine));
        let indicatrix = self.base.truncate() + aureole + e * (cosine * cosine);
        let Vec3 {
            x: level,
            y: x,
            z: y,
        } = self.zenith.truncate() * gradation * indicatrix;
        let [constant, factor, of_square] = DAYLIGHT;
        let y = y + TO_DAYLIGHT * (constant + factor * x + of_square * x * x - y);
        let [of_x, of_y, of_z] = RGB_OF_XYZ;
        let linear = (of_x * x + of_y * y + of_z * (1.0 - x - y)) * (level / y);
        table.lerp(linear.max(Vec3::ZERO), self.weight)
    }
}

/// This model's share of the sky, over the sine of the sun's elevation.
pub fn share(sin_elevation: f32) -> f32 {
    smoothstep(-TWILIGHT_END, 0.0, sin_elevation)
}

/// The direction of the sun, or of the horizon above it.
fn above_horizon(sun: Vec3) -> Vec3 {
    // Through the nadir no azimuth is better than another, and the share is 0.
    Vec3::new(sun.x, sun.y.max(0.0), sun.z).normalize_or(Vec3::NEG_Z)
}

/// The clear sky's share of the uniforms. `params` are in range. All is 0 where the table draws alone.
pub fn uniforms(params: &PerezParams, model: SkyModel, light: &Light) -> PerezUniforms {
    let share = if light.is_moon {
        0.0
    } else {
        share(light.sun_direction.y)
    };
    if model == SkyModel::Table || share == 0.0 {
        return PerezUniforms::default();
    }
    let sun = above_horizon(light.sun_direction);
    let lum = luminance_distribution(params);
    let level = luminance(light.skylight) / lum.mean(sun.y);
    let white = matches!(params.shape, PerezShape::Cie(1..=cie::LAST_OVERCAST));
    let ([x, y], zenith) = if white {
        ([Distribution::UNIFORM; 2], WHITE)
    } else {
        let zenith = zenith_chromaticity(params.turbidity, acos(sun.y));
        let chromaticities = chromaticity_distributions(params.turbidity);
        // Equation 2.
        let over = |i: usize| zenith[i] / chromaticities[i].at(1.0, sun.y);
        (chromaticities, [over(0), over(1)])
    };
    let each =
        |number: fn(&Distribution) -> f32| Vec4::new(number(&lum), number(&x), number(&y), 0.0);
    PerezUniforms {
        sun_direction: sun,
        weight: share,
        a: each(|f| f.a),
        b: each(|f| f.b * LOG2_E),
        c: each(|f| f.c),
        d: each(|f| f.d * LOG2_E),
        e: each(|f| f.e),
        base: each(|f| f.base),
        zenith: Vec4::new(level, zenith[0], zenith[1], 0.0),
    }
}
