use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::super::cubemap::tests::{at_centres, directions, rough_sky, texels};
use super::super::harmonics::Harmonics;
use super::*;

const SIDE: u32 = 64;

/// What the mean of a part of the sky is off by at most, as `tree.rs` says, above and below the line of a fraction.
const OFF: f64 = 0.03;

/// The weight of a direction, by its cosine to the normal, with its own formula: the distribution of the half vector, times the cosine.
fn weight(roughness: f64, cosine: f64) -> f64 {
    let square = roughness.powi(4);
    // The half vector's cosine squared, as normal and view are one.
    let half = 0.5 * (1.0 + cosine);
    let distribution = square / (PI * (half * (square - 1.0) + 1.0).powi(2));
    distribution * cosine.max(0.0)
}

/// The integral of the weight over the sphere, in closed form: with `s = (1 - α²) / 2` and `p = (1 + α²) / 2`, that of `μ / (p - s μ)²`
/// over 0..1 is `(p / α² - 1 + ln(α² / p)) / s²`.
fn whole(roughness: f64) -> f64 {
    let square = roughness.powi(4);
    let (s, p) = (0.5 * (1.0 - square), 0.5 * (1.0 + square));
    let integral = if s < 1e-6 {
        0.5
    } else {
        (p / square - 1.0 + (square / p).ln()) / (s * s)
    };
    2.0 * square * integral
}

fn brute_force(map: &Cubemap, roughness: f64, normal: DVec3) -> DVec3 {
    let (mut light, mut sum) = (DVec3::ZERO, 0.0);
    for (direction, solid_angle, radiance) in texels(map) {
        let weight = solid_angle * weight(roughness, normal.dot(direction));
        light += weight * radiance;
        sum += weight;
    }
    light / sum
}

#[test]
fn levels_end_at_eight_texels_and_are_as_rough_as_they_should_be() {
    assert_eq!(roughness(16), [0.0, 1.0]);
    assert_eq!(roughness(128), [0.0, 0.25, 0.5, 0.75, 1.0]);
    assert_eq!(roughness(2048).len(), 9);
    let map = rough_sky(SIDE, 0.0);
    let made = levels(map.clone());
    let sides: Vec<u32> = made.iter().map(|level| level.side).collect();
    assert_eq!(sides, [64, 32, 16, 8]);
    assert!(made[0] == map);
    for level in made {
        let texels = (level.side * level.side * 3) as usize;
        assert!(level.faces.iter().all(|face| face.texels.len() == texels));
    }
}

#[test]
fn the_weight_has_the_integral_that_it_should() {
    for roughness in [0.125, 0.5, 0.75, 1.0] {
        let steps = 1_000_000;
        let sum: f64 = (0..steps)
            .map(|i| weight(roughness, (f64::from(i) + 0.5) / f64::from(steps)))
            .sum();
        let found = 2.0 * PI * sum / f64::from(steps);
        assert!((found / whole(roughness) - 1.0).abs() < 1e-5, "{roughness}");
    }
}

#[test]
fn a_constant_sky_stays_as_it_is() {
    let colour = [0.5, 1.0, 3.0];
    for level in levels(at_centres(SIDE, |_| colour)) {
        for texel in level.faces.iter().flat_map(|f| f.texels.chunks_exact(3)) {
            for (found, wanted) in texel.iter().zip(colour) {
                // A cosine is rounded by 2^-24, and the weight at the least roughness of a third changes 40 times as fast.
                assert!((found / wanted - 1.0).abs() < 1e-5, "{found} {wanted}");
            }
        }
    }
}

#[test]
fn every_level_is_the_integral_over_all_texels() {
    for sun in [0.0, 100_000.0] {
        let map = rough_sky(SIDE, sun);
        let tree = Tree::of(&map);
        let mut most = 0.0_f64;
        for roughness in [1.0 / 3.0, 2.0 / 3.0, 1.0] {
            let lobe = Lobe::new(roughness as f32);
            for normal in directions(60) {
                let wanted = brute_force(&map, roughness, normal);
                let found = tree.mean(normal.as_vec3(), &lobe).as_dvec3();
                let off = (found / wanted - 1.0).abs().max_element();
                most = most.max(off);
                assert!(off < OFF, "{roughness} {normal}: {found} {wanted}");
            }
        }
        println!("sun {sun}: {most}");
    }
}

#[test]
fn texels_are_those_means() {
    let map = rough_sky(SIDE, 5000.0);
    let made = levels(map.clone());
    for (level, roughness) in made.iter().zip(roughness(SIDE)).skip(1) {
        for (face, at) in [(0, [0, 0]), (1, [7, 3]), (3, [4, 7]), (4, [2, 5])] {
            let normal = texel_direction(face, at, level.side).as_dvec3();
            let wanted = brute_force(&map, roughness.into(), normal);
            let found = Vec3::from_slice(level.faces[face].texel(at[0], at[1])).as_dvec3();
            assert!((found / wanted - 1.0).abs().max_element() < OFF);
        }
    }
}

#[test]
fn a_sun_of_one_texel_is_the_lobe_itself_in_every_texel_and_keeps_its_light() {
    let mut map = at_centres(SIDE, |_| [0.0; 3]);
    let at = [40, 11];
    map.faces[2].texel_mut(at[0], at[1]).fill(1e6);
    let sun = texel_direction(2, at, SIDE).as_dvec3();
    let light = 1e6 * super::super::cube::texel_solid_angle(at, SIDE);
    for (level, roughness) in levels(map).iter().zip(roughness(SIDE)).skip(1) {
        let mut sum = 0.0;
        for (direction, solid_angle, radiance) in texels(level) {
            let share = weight(roughness.into(), direction.dot(sun)) / whole(roughness.into());
            let wanted = light * share;
            // Where it sets, the cosine of a direction that is rounded is all that there is.
            let rounded = light * 1e-6;
            assert!(
                (radiance - wanted).abs().max_element() < OFF * wanted + rounded,
                "{roughness} {direction}: {radiance} {wanted}"
            );
            sum += solid_angle * radiance.x;
        }
        // Of 8 texels a side, each 0.25 wide, the kink where the sun sets is met by chance: within 0.25² / 8.
        assert!(
            (sum / light - 1.0).abs() < OFF + 0.008,
            "{roughness}: {}",
            sum / light
        );
    }
}

#[test]
fn the_roughest_level_is_irradiance_over_pi() {
    let map = rough_sky(SIDE, 3000.0);
    let harmonics = Harmonics::of(&map);
    let light: DVec3 = texels(&map)
        .map(|(_, angle, radiance)| angle * radiance)
        .sum();
    let made = levels(map.clone());
    for (direction, _, radiance) in texels(made.last().unwrap()) {
        let exact = texels(&map).map(|(d, angle, l)| angle * direction.dot(d).max(0.0) * l);
        let exact = exact.sum::<DVec3>() / PI;
        assert!((radiance / exact - 1.0).abs().max_element() < OFF);
        // Nine terms of a light alone are off by -4 % to 9.4 %: see `harmonics/tests.rs`.
        let off =
            (DVec3::from(harmonics.irradiance(direction.to_array())) / PI - exact) * PI / light;
        assert!(
            off.min_element() > -0.04 && off.max_element() < 0.094,
            "{off}"
        );
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| {
            let map = rough_sky(SIDE, 5000.0);
            (Harmonics::of(&map), levels(map))
        })
    };
    assert!(with(1) == with(3));
}
