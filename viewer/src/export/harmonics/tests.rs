use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::super::cubemap::tests::{at_centres, directions, rough_sky, texels};
use super::*;

const SIDE: u32 = 64;

/// What nine terms of a clamped cosine differ by from it, of a light alone: the least and the most. The terms are
/// `1/4 + c/2 + (5/16) (3 c² - 1) / 2`, at c of -8/15 (below 0 by 0.04), 8/15 (too low by 0.04) and 0 (too high by 3/32).
const TRUNCATED: [f64; 2] = [-0.0396, 0.0938];

fn of(sky: impl Fn(Vec3) -> [f32; 3]) -> Harmonics {
    Harmonics::of(&at_centres(SIDE, sky))
}

#[test]
fn the_basis_is_orthonormal() {
    let map = rough_sky(SIDE, 0.0);
    for i in 0..COUNT {
        for j in 0..COUNT {
            let products = texels(&map).map(|(direction, solid_angle, _)| {
                let terms = basis(direction.to_array());
                solid_angle * terms[i] * terms[j]
            });
            let wanted = if i == j { 1.0 } else { 0.0 };
            // Texels are up to 2/64 wide; a product is of the fourth degree, l (l + 1) = 20, and a mean over the width h off by 20 h² / 24.
            assert!((products.sum::<f64>() - wanted).abs() < 1e-3, "{i} {j}");
        }
    }
}

#[test]
fn a_constant_sky_shines_pi_times_its_radiance_on_every_plane() {
    let harmonics = of(|_| [1.0, 2.0, 0.25]);
    for normal in directions(50) {
        let found = harmonics.irradiance(normal.to_array());
        for (found, radiance) in found.iter().zip([1.0, 2.0, 0.25]) {
            // Solid angles are exact, and degrees 1 and 2 vanish by the symmetry of the cube; directions are rounded to 2^-24.
            assert!((found / (radiance * PI) - 1.0).abs() < 1e-6, "{found}");
        }
    }
}

#[test]
fn a_lobe_of_a_cosine_along_any_axis_has_its_closed_form() {
    let axes = [
        Vec3::X,
        Vec3::Y,
        Vec3::Z,
        -Vec3::X,
        -Vec3::Y,
        -Vec3::Z,
        Vec3::new(0.6, 0.48, -0.64),
    ];
    for axis in axes {
        let harmonics = of(|d| [d.dot(axis).max(0.0); 3]);
        let terms = basis(axis.as_dvec3().to_array());
        for i in 0..COUNT {
            // Twice convolved: its own coefficients are those of the clamped cosine too.
            let wanted = CLAMPED_COSINE[i] * CLAMPED_COSINE[i] * terms[i];
            // As above, of degree 3 at most beside a kink; times π.
            assert!((harmonics.coefficients[i][1] - wanted).abs() < 3e-3);
        }
        for normal in directions(50) {
            let cosine = normal.dot(axis.as_dvec3());
            let wanted =
                2.0 / 3.0 * ((1.0 - cosine * cosine).sqrt() + (PI - cosine.acos()) * cosine);
            let found = harmonics.irradiance(normal.to_array())[2];
            // What is left out begins with degree 4, (π / 24)² 9 / 4π = 0.012.
            assert!((found - wanted).abs() < 0.015 + 3e-3, "{found} {wanted}");
        }
    }
}

#[test]
fn a_small_disc_is_a_cosine_but_for_what_nine_terms_leave_out() {
    // Two degrees, of which some dozen texels are lit.
    let axis = Vec3::new(0.3, 0.8, 0.52).normalize();
    let map = at_centres(SIDE, |d| {
        let is_lit = d.dot(axis) > 2.0_f32.to_radians().cos();
        [if is_lit { 40_000.0 } else { 0.0 }; 3]
    });
    let light = texels(&map).map(|(_, solid_angle, radiance)| solid_angle * radiance.x);
    let light: f64 = light.sum();
    assert!(light > 0.0);
    let harmonics = Harmonics::of(&map);
    for normal in directions(200) {
        let wanted = normal.dot(axis.as_dvec3()).max(0.0);
        let off = harmonics.irradiance(normal.to_array())[0] / light - wanted;
        // The centre of the lit texels is within half of one, 1/64, of the disc's.
        assert!(
            off > TRUNCATED[0] - 0.016 && off < TRUNCATED[1] + 0.016,
            "{off}"
        );
    }
}

#[test]
fn irradiance_is_the_sum_over_all_texels_but_for_what_nine_terms_leave_out() {
    for sun in [0.0, 100_000.0] {
        let map = rough_sky(SIDE, sun);
        let harmonics = Harmonics::of(&map);
        let light = texels(&map).map(|(_, solid_angle, radiance)| solid_angle * radiance);
        let light: DVec3 = light.sum();
        let mut squares = DVec3::ZERO;
        let count = 100;
        for normal in directions(count) {
            let exact = texels(&map)
                .map(|(d, solid_angle, radiance)| solid_angle * normal.dot(d).max(0.0) * radiance);
            let found = DVec3::from(harmonics.irradiance(normal.to_array()));
            let off = (found - exact.sum::<DVec3>()) / light;
            // Every texel is a light alone; radiance is not negative, so their sum is within the same bounds.
            assert!(off.min_element() > TRUNCATED[0] - 1e-6, "{off}");
            assert!(off.max_element() < TRUNCATED[1] + 1e-6, "{off}");
            squares += off * off;
        }
        // Over all directions the root mean square of what a light alone lacks is 3.2 %, by Parseval's theorem: degree 4 has
        // (π / 24)² 9 / (4π)² = 0.00098, degree 6 a twelfth of it. A tenth more for so few directions.
        let root = (squares / f64::from(count)).max_element().sqrt();
        assert!(root < 0.035, "{root}");
    }
}

#[test]
fn no_plane_is_lit_less_than_not_at_all() {
    let map = at_centres(16, |d| if d.y > 0.98 { [100.0; 3] } else { [0.0; 3] });
    let harmonics = Harmonics::of(&map);
    // Where the sum is below 0.
    let normal = DVec3::new((1.0_f64 - 64.0 / 225.0).sqrt(), -8.0 / 15.0, 0.0);
    let sum = basis(normal.to_array())
        .into_iter()
        .zip(harmonics.coefficients);
    assert!(sum.map(|(term, c)| term * c[0]).sum::<f64>() < 0.0);
    assert_eq!(harmonics.irradiance(normal.to_array()), [0.0; 3]);
}

/// The value of a formula of numbers, names, `+`, `-`, `*` and brackets.
fn value(formula: &str, name: &dyn Fn(&str) -> f64) -> f64 {
    let mut rest = formula;
    let value = sum(&mut rest, name);
    assert!(rest.trim().is_empty(), "{rest}");
    value
}

fn sum(rest: &mut &str, name: &dyn Fn(&str) -> f64) -> f64 {
    let mut value = product(rest, name);
    loop {
        *rest = rest.trim_start();
        if let Some(after) = rest.strip_prefix('+') {
            *rest = after;
            value += product(rest, name);
        } else if let Some(after) = rest.strip_prefix('-') {
            *rest = after;
            value -= product(rest, name);
        } else {
            return value;
        }
    }
}

fn product(rest: &mut &str, name: &dyn Fn(&str) -> f64) -> f64 {
    let mut value = factor(rest, name);
    loop {
        *rest = rest.trim_start();
        let Some(after) = rest.strip_prefix('*') else {
            return value;
        };
        *rest = after;
        value *= factor(rest, name);
    }
}

fn factor(rest: &mut &str, name: &dyn Fn(&str) -> f64) -> f64 {
    *rest = rest.trim_start();
    if let Some(after) = rest.strip_prefix('(') {
        *rest = after;
        let value = sum(rest, name);
        *rest = rest.trim_start().strip_prefix(')').unwrap();
        return value;
    }
    let end = rest.find(|c: char| !c.is_alphanumeric() && !".[]".contains(c));
    let (word, after) = rest.split_at(end.unwrap_or(rest.len()));
    *rest = after;
    word.parse().unwrap_or_else(|_| name(word))
}

#[test]
fn the_formulas_for_readers_are_those_that_were_written() {
    let coefficients: [f64; COUNT] = std::array::from_fn(|i| 1.0 + (i * i) as f64);
    let docs = include_str!("../../../docs/environment-maps.md");
    let (_, wgsl) = docs.split_once("```wgsl\n").unwrap();
    let (wgsl, _) = wgsl.split_once("```").unwrap();
    let module = naga::front::wgsl::parse_str(wgsl).unwrap();
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), Default::default());
    validator.validate(&module).unwrap();
    let (_, formula) = wgsl.split_once("let e =").unwrap();
    let (formula, _) = formula.split_once(';').unwrap();
    for normal in directions(30) {
        let axis = |word: &str| match word.trim_start_matches("n.") {
            "x" => normal.x,
            "y" => normal.y,
            "z" => normal.z,
            word => panic!("{word}"),
        };
        let terms = basis(normal.to_array());
        for (text, term) in BASIS.iter().zip(terms) {
            // Six digits behind the point, and terms of up to 2.
            assert!((value(text, &axis) - term).abs() < 2e-6, "{text}");
        }
        let found = value(formula, &|word| {
            let index = word.strip_prefix("c[").and_then(|w| w.strip_suffix(']'));
            index.map_or_else(|| axis(word), |i| coefficients[i.parse::<usize>().unwrap()])
        });
        let wanted: f64 = terms.iter().zip(coefficients).map(|(t, c)| t * c).sum();
        // The same, with coefficients of 204 in all.
        assert!((found - wanted).abs() < 5e-4, "{found} {wanted}");
    }
}
