//! The day gradient and the sun: what anybody can see in a clear sky.

use welkin_pack::{Image, Role};

use crate::common;

fn bake(text: &str, role: Role) -> Image {
    let (_, all) = common::bake_for(&[role], text, None);
    common::image(&all, role).clone()
}

fn luminance(texel: &[f32]) -> f32 {
    0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2]
}

#[test]
fn morning_mirrors_evening() {
    let sky = bake("", Role::Sky);
    for x in 1..sky.width {
        for y in 0..sky.height {
            assert_eq!(sky.texel(x, y), sky.texel(sky.width - x, y));
        }
    }
}

#[test]
fn noon_is_blue_above_and_pale_below() {
    for noon in [15, 60, 90] {
        let sky = bake(&format!("[sun]\nnoon_elevation_deg = {noon}\n"), Role::Sky);
        let (horizon, zenith) = (sky.texel(64, 0), sky.texel(64, sky.height - 1));
        assert!(
            zenith[2] > 1.8 * zenith[1] && zenith[1] > 1.2 * zenith[0],
            "{zenith:?}"
        );
        assert!(
            luminance(horizon) > 2.0 * luminance(zenith),
            "{horizon:?} {zenith:?}"
        );
        let (blue_low, blue_high) = (horizon[2] / horizon[0], zenith[2] / zenith[0]);
        assert!(blue_low < 0.6 * blue_high, "{horizon:?} {zenith:?}");
        assert_eq!(zenith[3], 0.0);
    }
}

#[test]
fn sunset_is_warm_below_and_blue_above() {
    let sky = bake("", Role::Sky);
    for column in [95, 96] {
        let (low, zenith) = (
            sky.texel(column, sky.height / 6),
            sky.texel(column, sky.height - 1),
        );
        assert!(low[0] > 1.5 * low[2], "{low:?}");
        assert!(
            zenith[2] > 1.5 * zenith[0] && zenith[1] > zenith[0],
            "{zenith:?}"
        );
    }
    // The blue hour: the sun 5 degrees down.
    let zenith = sky.texel(98, sky.height - 1);
    assert!(
        zenith[2] > 2.0 * zenith[1] && zenith[1] > zenith[0],
        "{zenith:?}"
    );
}

#[test]
fn night_is_dark_blue_and_full_of_stars() {
    let sky = bake("", Role::Sky);
    for y in 0..sky.height {
        let texel = sky.texel(0, y);
        assert_eq!(texel[3], 1.0);
        assert!(
            texel[2] > texel[1] && texel[1] > texel[0] && texel[0] > 0.0,
            "{texel:?}"
        );
        assert!(luminance(texel) < 0.02, "{texel:?}");
    }
    assert!(luminance(sky.texel(0, 0)) > luminance(sky.texel(0, sky.height - 1)));
}

#[test]
fn it_grows_lighter_from_midnight_to_noon_without_steps() {
    // Twice as many columns as by default: what is smooth stays smooth when sampled finer.
    let sky = bake("[sky]\nwidth = 256\n", Role::Sky);
    assert!(sky.texels.iter().all(|v| v.is_finite() && *v >= 0.0));
    for y in [0, sky.height / 3, sky.height - 1] {
        let light: Vec<f32> = (0..=128).map(|x| luminance(sky.texel(x, y))).collect();
        for pair in light.windows(2) {
            // Rounding of 32-bit sums aside, a higher sun never darkens the sky that it lights.
            assert!(pair[1] >= pair[0] * 0.999, "row {y}: {pair:?}");
        }
        // A column is 1.2 degrees of sun. A rise that one column held would be a jump between two looks of the
        // sky; a quarter of the day's range at most means that dawn takes more than four of them.
        let range = light[128] - light[0];
        let steepest = light.windows(2).map(|w| w[1] - w[0]).fold(0.0, f32::max);
        assert!(steepest < 0.25 * range, "row {y}: {steepest} of {range}");
        let night: Vec<f32> = (0..=128).map(|x| sky.texel(x, y)[3]).collect();
        assert!(
            night.windows(2).all(|w| w[1] <= w[0] && w[0] - w[1] < 0.25),
            "{night:?}"
        );
    }
}

#[test]
fn rows_are_smooth() {
    let sky = bake("", Role::Sky);
    for x in 0..sky.width {
        let column: Vec<&[f32]> = (0..sky.height).map(|y| sky.texel(x, y)).collect();
        let most = column.iter().map(|t| luminance(t)).fold(0.0, f32::max);
        for three in column.windows(3) {
            for (a, (b, c)) in three[0].iter().zip(three[1].iter().zip(three[2])) {
                let bend = a - 2.0 * b + c;
                // A kink of 3 % of the brightest place would show as a line along the horizon.
                assert!(
                    bend.abs() < 0.03 * most.max(0.05),
                    "column {x}: {bend} of {most}"
                );
            }
        }
    }
}

#[test]
fn the_sun_is_a_soft_disc_in_a_glow() {
    for size in [64, 128] {
        let sun = bake(&format!("[sun]\nsize = {size}\n"), Role::Sun);
        let middle = size / 2;
        let right: Vec<&[f32]> = (middle..size).map(|x| sun.texel(x, middle)).collect();
        for pair in right.windows(2) {
            assert!(
                pair[1][0] <= pair[0][0] && pair[1][1] <= pair[0][1],
                "{pair:?}"
            );
        }
        // The middle lies half a texel off the centre.
        assert!(right[0][0] > 0.99 && right[0][1] > 0.97, "{:?}", right[0]);
        let edge = &right[right.len() / 2 - 3];
        assert!(edge[0] > 0.4 && edge[0] < 0.75, "darkened limb: {edge:?}");
        assert_eq!(
            right[right.len() / 2 + 2][0],
            0.0,
            "nothing beyond the limb"
        );
        let last = right[right.len() - 1];
        assert!(last[1] < 1.0 / 255.0, "{last:?}");
        for x in 0..size {
            for y in 0..size {
                assert_eq!(sun.texel(x, y), sun.texel(y, x));
                assert_eq!(sun.texel(x, y), sun.texel(size - 1 - x, y));
            }
        }
        assert_eq!(sun.texel(0, 0), &[0.0, 0.0]);
    }
}
