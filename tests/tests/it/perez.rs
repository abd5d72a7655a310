//! The sky of Perez and others keeps the closed forms of its equations.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::Vec3;
use welkin_runtime::SkyParams;
use welkin_runtime::internals::clear_sky::cie;
use welkin_runtime::internals::clear_sky::perez;
use welkin_runtime::internals::clear_sky::perez::{Distribution, LEAST_COSINE};
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::params::{CUSTOM, TURBIDITY};
use welkin_runtime::params::{PerezParams, PerezShape};
use welkin_tests::pack;
use welkin_tests::perez::{colour, direction, hemisphere, linear, overhead, time_of, uniforms};

fn shapes() -> Vec<PerezShape> {
    let standard = (1..=cie::SKIES.len() as u8).map(PerezShape::Cie);
    standard.chain([PerezShape::Preetham]).collect()
}

/// Equation 1 in 64 bits, as it is printed.
fn published([a, b, c, d, e]: [f64; 5], zenith_rad: f64, gamma_rad: f64, is_cie: bool) -> f64 {
    let less = if is_cie {
        c * libm::exp(d * std::f64::consts::FRAC_PI_2)
    } else {
        0.0
    };
    let cosine = libm::cos(gamma_rad);
    let gradation = 1.0 + a * libm::exp(b / libm::cos(zenith_rad));
    gradation * (1.0 + c * libm::exp(d * gamma_rad) - less + e * cosine * cosine)
}

#[test]
fn the_zenith_has_the_zeniths_values() {
    let facts = PackData::new(&overhead()).unwrap();
    for elevation_deg in [0.0, 1.0, 20.0, 60.0, 90.0_f32] {
        for turbidity in [TURBIDITY[0], 2.5, 6.0, TURBIDITY[1]] {
            let time = time_of(elevation_deg);
            let frame = uniforms(&facts, PerezShape::Preetham, turbidity, time);
            let zenith = colour(&frame.perez, Vec3::Y);
            let expected =
                perez::zenith_chromaticity(turbidity, FRAC_PI_2 - elevation_deg.to_radians());
            // f(0, Z) / f(0, Z) is 1: what is left is the arc cosine, 7e-5 of an angle in a cubic of slopes below 0.3,
            // and rounding.
            assert!(
                (zenith.y - expected[0]).abs() < 3e-5 && (zenith.z - expected[1]).abs() < 3e-5,
                "{elevation_deg}, {turbidity}: {zenith}, expected {expected:?}"
            );
        }
    }
}

/// Figures worked by hand from the printed matrices.
#[test]
fn zenith_chromaticity_is_that_of_the_printed_matrices() {
    // Sun in the zenith, T = 2: only the last column, 2 * 0.00394 + 0.25886 and 2 * 0.00516 + 0.26688.
    let [x, y] = perez::zenith_chromaticity(2.0, 0.0);
    assert!((x - 0.26674).abs() < 1e-6 && (y - 0.27720).abs() < 1e-6);
    // One radian, T = 1: the sums of the rows, 0 + 0.00666 + 0.22435 and -0.00018 + 0.01119 + 0.21948.
    let [x, y] = perez::zenith_chromaticity(1.0, 1.0);
    assert!((x - 0.23101).abs() < 1e-6 && (y - 0.23049).abs() < 1e-6);
}

#[test]
fn luminance_is_the_printed_equation() {
    let facts = PackData::new(&overhead()).unwrap();
    for (index, standard) in cie::SKIES.iter().enumerate() {
        for elevation_deg in [0.0_f32, 15.0, 50.0, 90.0] {
            let shape = PerezShape::Cie(index as u8 + 1);
            let frame = uniforms(&facts, shape, 2.5, time_of(elevation_deg));
            let sun = frame.perez.sun_direction;
            let zenith = colour(&frame.perez, Vec3::Y).x;
            let numbers = standard.numbers.map(f64::from);
            let sun_zenith = f64::from(sun.angle_between(Vec3::Y));
            let at_zenith = published(numbers, 0.0, sun_zenith, true);
            for towards in hemisphere(24, 24) {
                let gamma = f64::from(towards.angle_between(sun));
                let xi = f64::from(towards.angle_between(Vec3::Y));
                let expected = published(numbers, xi, gamma, true) / at_zenith;
                let actual = f64::from(colour(&frame.perez, towards).x / zenith);
                // The arc cosine is off by 7e-5, the angle between two vectors of 32 bits by 5e-4 where they are near;
                // luminance changes by up to 3 a radian. Both ends of the ratio are.
                assert!(
                    (actual / expected - 1.0).abs() < 4e-3,
                    "{} {towards}: {actual}, expected {expected}",
                    standard.name
                );
            }
        }
    }
}

#[test]
fn the_skies_on_both_sides_of_the_suns_meridian_are_mirror_images() {
    let facts = PackData::new(pack::default_pack()).unwrap();
    for shape in shapes() {
        for time in [0.3, 0.45, 0.6, 0.74] {
            let perez = uniforms(&facts, shape, 3.0, time).perez;
            let sun = perez.sun_direction;
            let across = Vec3::new(sun.z, 0.0, -sun.x).normalize();
            for towards in hemisphere(16, 16) {
                let mirrored = towards - 2.0 * towards.dot(across) * across;
                let pair = [towards, mirrored].map(|d| linear(colour(&perez, d)));
                let apart = (pair[0] - pair[1]).abs().max_element();
                // Rounding of a cosine, 1e-7, is 4e-4 of an angle next to the sun.
                assert!(apart <= 2e-3 * pair[0].max_element(), "{shape:?}: {pair:?}");
            }
        }
    }
}

/// Types 11 to 15 are the standard's clear skies. Of the last two, which are turbid, the horizon under a sun that is 15
/// to 35 degrees high is brighter than its aureole by the standard's own numbers.
#[test]
fn clear_skies_are_brightest_near_the_sun() {
    let facts = PackData::new(&overhead()).unwrap();
    for number in 11..=15 {
        for elevation_deg in [1.0, 5.0, 15.0, 25.0, 45.0, 70.0, 90.0] {
            if number > 13 && (10.0..40.0).contains(&elevation_deg) {
                continue;
            }
            let shape = PerezShape::Cie(number);
            let perez = uniforms(&facts, shape, 2.5, time_of(elevation_deg)).perez;
            let bright = |d: &Vec3| colour(&perez, *d).x;
            let brightest = hemisphere(180, 360)
                .max_by(|a, b| bright(a).total_cmp(&bright(b)))
                .unwrap();
            let apart = brightest.angle_between(perez.sun_direction).to_degrees();
            // The uppermost ring stands 4.3 degrees from the zenith; types 14 and 15 peak 2.4 degrees under a low sun.
            assert!(
                apart < 5.0,
                "type {number}, {elevation_deg}: {apart} degrees"
            );
        }
    }
}

/// Whatever the gradation does, of all elements of one elevation the one under or over the sun is the brightest.
#[test]
fn every_sky_with_an_aureole_is_brightest_on_the_suns_side() {
    let facts = PackData::new(pack::default_pack()).unwrap();
    for shape in shapes() {
        if matches!(shape, PerezShape::Cie(1 | 3 | 5)) {
            continue;
        }
        for time in [0.3, 0.45, 0.7] {
            let perez = uniforms(&facts, shape, 2.5, time).perez;
            let sun = perez.sun_direction;
            let azimuth = sun.x.atan2(-sun.z);
            for sin_elevation in [0.0, 0.2, 0.5, 0.9] {
                let of = |turn: f32| colour(&perez, direction(azimuth + turn, sin_elevation)).x;
                let towards = of(0.0);
                let others = (1..36).map(|i| of(i as f32 * TAU / 36.0));
                assert!(others.into_iter().all(|other| other < towards), "{shape:?}");
            }
        }
    }
}

#[test]
fn overcast_skies_of_the_first_kind_are_the_same_all_round() {
    let facts = PackData::new(pack::default_pack()).unwrap();
    for number in [1, 3, 5] {
        for time in [0.3, 0.5, 0.7] {
            let perez = uniforms(&facts, PerezShape::Cie(number), 2.5, time).perez;
            for sin_elevation in [0.0, 0.1, 0.5, 0.99] {
                let [first, others @ ..] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
                    .map(|azimuth| linear(colour(&perez, direction(azimuth, sin_elevation))));
                for other in others {
                    // Cosines of the same elevation are rounded.
                    assert!(
                        (first - other).abs().max_element() < 1e-5 * first.x,
                        "{number}"
                    );
                }
                // And white, as BT.709's white has it (to the digits of its primaries).
                assert!((first.max_element() / first.min_element() - 1.0).abs() < 3e-3);
            }
        }
    }
}

/// P. Moon, D. E. Spencer, "Illumination from a Non-uniform Sky", 1942: an overcast zenith is three times as bright as
/// the horizon. Type 1 has 1 + 4 exp(-0.7) = 2.986.
#[test]
fn the_overcast_zenith_is_three_times_as_bright_as_the_horizon() {
    let facts = PackData::new(pack::default_pack()).unwrap();
    let perez = uniforms(&facts, PerezShape::Cie(1), 2.5, 0.4).perez;
    let ratio = colour(&perez, Vec3::Y).x / colour(&perez, Vec3::X).x;
    assert!((ratio - 2.986_34).abs() < 1e-4, "{ratio}");
    // Half way up both forms agree too: (1 + 2 sin) / 3 within the standard's rounding of its numbers, 2 %.
    let middle = colour(&perez, direction(1.0, 0.5)).x / colour(&perez, Vec3::Y).x;
    assert!((middle / (2.0 / 3.0) - 1.0).abs() < 0.02, "{middle}");
}

#[test]
fn the_hemisphere_is_as_bright_as_the_table() {
    let pack = overhead();
    let facts = PackData::new(&pack).unwrap();
    for shape in shapes() {
        for elevation_deg in [0.0, 10.0, 45.0, 90.0] {
            let time = time_of(elevation_deg);
            let perez = uniforms(&facts, shape, 2.5, time).perez;
            let (mut sum, mut count) = (0.0, 0.0);
            for towards in hemisphere(100, 200) {
                sum += luminance(linear(colour(&perez, towards)));
                count += 1.0;
            }
            let params = SkyParams {
                time,
                ..SkyParams::default()
            };
            let light = facts.lit_sky(&params, 0.0).light;
            let ratio = sum / count / luminance(light.skylight);
            // The mean of the frame is taken over 32 rings: see the next test.
            assert!(
                (ratio - 1.0).abs() < 0.007,
                "{shape:?} {elevation_deg}: {ratio}"
            );
        }
    }
}

#[test]
fn the_mean_of_32_rings_is_near_that_of_400() {
    let corner =
        |steep: bool| PerezShape::Custom(CUSTOM.map(|[low, high]| if steep { low } else { high }));
    let mut all = shapes();
    let wild = PerezShape::Custom([-1.0, -0.05, 30.0, -5.0, 2.0]);
    all.extend([corner(false), corner(true), wild]);
    for shape in all {
        let params = PerezParams {
            shape,
            ..PerezParams::default()
        };
        let f = perez::luminance_distribution(&params);
        for sin_sun in [0.0, 0.03, 0.3, 0.7, 1.0_f32] {
            let sun = direction(0.0, sin_sun);
            let fine = hemisphere(400, 800).map(|d| f64::from(f.at(d.y, d.dot(sun))));
            let fine = fine.sum::<f64>() / (400.0 * 800.0);
            let apart = (f64::from(f.mean(sin_sun)) / fine - 1.0).abs();
            // Half a percent of brightness is a step of eight bits; the steepest aureole may have four.
            let bound = if matches!(shape, PerezShape::Custom(_)) {
                0.025
            } else {
                0.006
            };
            assert!(apart < bound, "{shape:?} {sin_sun}: {apart}");
        }
    }
}

#[test]
fn no_number_in_range_makes_equation_1_dark_or_endless() {
    let mut all: Vec<Distribution> = Vec::new();
    for corner in 0..32 {
        let numbers = std::array::from_fn(|i| CUSTOM[i][(corner >> i) & 1]);
        all.push(Distribution::new(numbers));
    }
    all.extend(cie::SKIES.iter().map(|sky| Distribution::cie(sky.numbers)));
    for step in 0..=83 {
        let turbidity = TURBIDITY[0] + step as f32 * 0.1;
        let params = PerezParams {
            shape: PerezShape::Preetham,
            turbidity: turbidity.min(TURBIDITY[1]),
        };
        all.push(perez::luminance_distribution(&params));
        all.extend(perez::chromaticity_distributions(params.turbidity));
    }
    for f in all {
        for cos_zenith in [-1.0, 0.0, LEAST_COSINE, 0.1, 0.5, 1.0] {
            for cos_sun in [-1.1, -1.0, -0.5, 0.0, 0.5, 1.0, 1.1] {
                let value = f.at(cos_zenith, cos_sun);
                assert!(value.is_finite() && value > 0.0, "{f:?}: {value}");
            }
        }
    }
}

/// Chromaticities of light of one wavelength, from 380 to 700 nm. CIE 1931 standard observer, CIE 15:2004, table T.4.
const LOCUS: [[f32; 2]; 13] = [
    [0.1741, 0.0050],
    [0.1440, 0.0297],
    [0.0913, 0.1327],
    [0.0454, 0.2950],
    [0.0082, 0.5384],
    [0.0139, 0.7502],
    [0.0743, 0.8338],
    [0.2296, 0.7543],
    [0.3731, 0.6245],
    [0.5125, 0.4866],
    [0.6270, 0.3725],
    [0.6915, 0.3083],
    [0.7347, 0.2653],
];

fn is_a_colour([x, y]: [f32; 2]) -> bool {
    // The locus runs clockwise.
    (0..LOCUS.len()).all(|i| {
        let ([x0, y0], [x1, y1]) = (LOCUS[i], LOCUS[(i + 1) % LOCUS.len()]);
        (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) < 0.0
    })
}

#[test]
fn every_colour_is_a_colour_and_can_be_shown() {
    assert!(is_a_colour(perez::WHITE) && !is_a_colour([0.7, 0.5]) && !is_a_colour([0.0, 0.3]));
    let facts = PackData::new(&overhead()).unwrap();
    for step in 0..=10 {
        let turbidity = TURBIDITY[0] + (TURBIDITY[1] - TURBIDITY[0]) * step as f32 / 10.0;
        for elevation_deg in (0..=90).step_by(3) {
            let time = time_of(elevation_deg as f32);
            let perez = uniforms(&facts, PerezShape::Preetham, turbidity, time).perez;
            for towards in hemisphere(12, 24) {
                let sky = colour(&perez, towards);
                assert!(
                    is_a_colour([sky.y, sky.z]),
                    "{turbidity} {elevation_deg}: {sky}"
                );
                // Nothing is cut off: every colour is inside BT.709.
                let rgb = linear(sky);
                assert!(
                    rgb.min_element() > 0.0,
                    "{turbidity} {elevation_deg}: {rgb}"
                );
            }
        }
    }
}

#[test]
fn the_polynomial_is_an_arc_cosine() {
    for step in -100_000..=100_000 {
        let cosine = step as f32 / 1e5;
        let exact = libm::acos(f64::from(cosine));
        // Abramowitz and Stegun give 5e-5 for the polynomial with more digits of its own: with these, 6.8e-5.
        assert!(
            (f64::from(perez::acos(cosine)) - exact).abs() < 7e-5,
            "{cosine}"
        );
    }
    assert_eq!([perez::acos(1.0), perez::acos(-1.0)], [0.0, PI]);
}
