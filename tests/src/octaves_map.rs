//! Twin of clouds/octaves/map.wgsl: the filter as sixteen weighted texels, the spline by its definition.

use std::ops::Range;

use glam::Vec2;
use welkin_pack::Image;
use welkin_runtime::internals::clouds::octaves::OctaveUniforms;
use welkin_runtime::internals::clouds::octaves::map::{NOISE_SIDE, RELIEF_COUNT};
use welkin_runtime::internals::clouds::octaves::{EDGE, THIN};
use welkin_runtime::internals::geometry::math::NORMAL_SLOPE;
use welkin_runtime::params::Shading;

use crate::gpu;
use crate::octaves::alpha;
use crate::photo::{Photo, normal_share};

/// The uniform cubic B-spline of width 4 about 0: I. J. Schoenberg, "Contributions to the Problem of Approximation
/// of Equidistant Data by Analytic Functions", Quarterly of Applied Mathematics 4, 1946.
pub fn spline(t: f32) -> f32 {
    let t = t.abs();
    let (inner, outer) = ((1.0 - t).max(0.0), (2.0 - t).max(0.0));
    (outer * outer * outer - 4.0 * inner * inner * inner) / 6.0
}

/// Level 0 of the map, not rounded: amount, opacity of the low and of the middle dome, sunlight that the low dome leaves or its
/// grey.
/// `states` are those of [`welkin_runtime::internals::clouds::octaves::map::states`].
pub fn render(
    octaves: &OctaveUniforms,
    photo: &Photo<'_>,
    shading: Shading,
    states: &[f32],
) -> Image {
    let OctaveUniforms {
        count,
        exponent,
        darkening,
        relief,
        edge_grey,
        ..
    } = *octaves;
    let side = octaves.resolution;
    let large = RELIEF_COUNT.min(count as i32) as usize;
    let here = sums(octaves, states, 0..count as usize, Vec2::ZERO);
    // Towards the sun only the large octaves have another value.
    let large_here = sums(octaves, states, 0..large, Vec2::ZERO);
    let large_away = sums(octaves, states, 0..large, octaves.sun_step);
    let mut map = Image::new(side as u32, side as u32, 4);
    for (index, texel) in map.texels.chunks_exact_mut(4).enumerate() {
        let place = [index % side as usize, index / side as usize];
        let uv = Vec2::from(place.map(|i| (i as f32 + 0.5) / side));
        let amount = normal_share(photo.over(here[index], uv));
        let away = here[index] + large_away[index] - large_here[index];
        let towards_sun = normal_share(photo.over(away, uv + octaves.sun_step));
        let thickness = amount - octaves.low.threshold;
        let above = (amount - octaves.low.threshold.max(0.0)).max(0.0);
        let relief = relief * (amount - towards_sun);
        let light = match shading {
            Shading::Scattered => libm::exp2f(-(octaves.extinction * (above - relief)).max(0.0)),
            Shading::Paper => edge_grey + relief - darkening * above,
        };
        texel.copy_from_slice(&[
            amount,
            alpha(thickness, exponent),
            alpha(amount - octaves.middle.threshold, THIN * exponent),
            light,
        ]);
    }
    map
}

/// The weighted sum of some octaves at every texel, read `away` from it.
fn sums(octaves: &OctaveUniforms, states: &[f32], which: Range<usize>, away: Vec2) -> Vec<f32> {
    let side = octaves.resolution as usize;
    let copies = octaves.copies.map(|four| four.to_array()).concat();
    let cells = (NOISE_SIDE * NOISE_SIDE) as usize;
    let mut sums = vec![0.0; side * side];
    for k in which {
        add_octave(
            &mut sums,
            &states[k * cells..(k + 1) * cells],
            copies[k],
            away,
        );
    }
    sums
}

/// What a texel of level 0 may be off by: the four channels at most, and on average, in bytes.
///
/// A target of 8 bits rounds: half a byte, a quarter on average. States are stored as half floats, off by 2^-11 of
/// themselves. Mesa's software places reads between texels of floats exactly; other texture units do with fractions of 8
/// bits (Vulkan 1.3, `subTexelPrecisionBits`; it would allow 4, desktop drivers have 8), off by 2^-9 of the
/// difference of two texels along each axis. On average, over octaves and axes, independent errors add as their squares
/// do, and evenly distributed ones have the deviation of their largest over sqrt 3. The normal distribution's
/// density, at most 0.4, turns all that into an amount; [`slopes`] turn that into the other channels.
pub fn allowance(
    octaves: &OctaveUniforms,
    photo: &Photo<'_>,
    shading: Shading,
    states: &[f32],
) -> ([f32; 4], [f32; 4]) {
    let half = libm::exp2f(-11.0);
    let fraction = if gpu::gpu().is_llvmpipe {
        0.0
    } else {
        libm::exp2f(-9.0)
    };
    let (mut most, mut square) = (0.0, 0.0);
    for noise in states.chunks_exact((NOISE_SIDE * NOISE_SIDE) as usize) {
        let extreme = noise.iter().fold(0.0_f32, |most, v| most.max(v.abs()));
        // Two texels differ by twice the largest, on two axes.
        most += extreme * (half + 4.0 * fraction);
        let variance = noise.iter().map(|v| v * v).sum::<f32>() / noise.len() as f32;
        // The difference of two texels has twice the variance, on two axes.
        square += variance * (half * half + 4.0 * fraction * fraction) / 3.0;
    }
    // What is left of the octaves, and the photo's own reads.
    most = photo.rest() * most + photo.off();
    square = photo.rest() * photo.rest() * square + photo.off() * photo.off() / 3.0;
    let slopes = slopes(octaves, shading);
    let bytes = NORMAL_SLOPE / 2.0 * 255.0;
    (
        slopes.map(|slope| 0.5 + slope * most * bytes),
        slopes.map(|slope| 0.25 + slope * libm::sqrtf(square) * bytes),
    )
}

/// By how much each channel changes at most where the amount changes by one.
///
/// The paper's exponential is steepest at its foot; its softening `a^2 (1 + e) / (a + e)` at 1, with (1 + 2 e) / (1 + e).
/// The light has the amount here, the amount towards the sun, and the thickness.
pub fn slopes(octaves: &OctaveUniforms, shading: Shading) -> [f32; 4] {
    let opacity =
        octaves.exponent.abs() * std::f32::consts::LN_2 * (1.0 + 2.0 * EDGE) / (1.0 + EDGE);
    [
        1.0,
        opacity,
        THIN * opacity,
        match shading {
            // An exponential is steepest where nothing is halved yet.
            Shading::Scattered => {
                octaves.extinction * std::f32::consts::LN_2 * (1.0 + 2.0 * octaves.relief.abs())
            }
            Shading::Paper => 2.0 * octaves.relief.abs() + octaves.darkening.abs(),
        },
    ]
}

/// How much the state of each octave may change over a share of its interval.
///
/// A state is `s (u a + v b)` with noises a and b of at most 1/2, and (u, v) a unit vector that turns by a quarter
/// of a circle over an interval, at most twice as fast as its place in the interval: so by at most `2 s |(a, b)|` an
/// interval. s is the deviation of the states over that of the noise, 1 / sqrt 12; the deviation of 1024 values is
/// known to within 11 % (five of its own deviations, 1 / sqrt 2048).
pub fn most_change(states: &[f32], share: f32) -> Vec<f32> {
    let most = |states: &[f32]| {
        let square = states.iter().map(|s| s * s).sum::<f32>() / states.len() as f32;
        let scale = 1.11 * libm::sqrtf(12.0 * square);
        2.0 * scale * std::f32::consts::FRAC_1_SQRT_2 * share
    };
    let noises = states.chunks_exact((NOISE_SIDE * NOISE_SIDE) as usize);
    noises.map(most).collect()
}

/// The same for the amount in the map. Weights of the filter add up to 1, so a sum changes by no more than its octaves
/// together; the density of the normal distribution is at most 0.4.
pub fn most_change_of_amount(states: &[f32], share: f32) -> f32 {
    most_change(states, share).iter().sum::<f32>() * NORMAL_SLOPE / 2.0
}

/// Adds the filtered noise, repeated `copies` times across the map.
fn add_octave(sums: &mut [f32], noise: &[f32], copies: f32, away: Vec2) {
    let side = (sums.len() as f64).sqrt() as usize;
    let cells = copies * NOISE_SIDE as f32;
    let [along_u, along_v] = away.to_array().map(|away| reads(side, cells, away));
    let mut sums = sums.iter_mut();
    for (rows, down) in &along_v {
        for (columns, along) in &along_u {
            let mut value = 0.0;
            for (row, down) in rows.iter().zip(down) {
                for (column, along) in columns.iter().zip(along) {
                    value += down * along * noise[row * NOISE_SIDE as usize + column];
                }
            }
            if let Some(sum) = sums.next() {
                *sum += value;
            }
        }
    }
}

/// For each of `side` texels along a row of `cells` cells: the four nearest cells of the noise and their weights.
fn reads(side: usize, cells: f32, away: f32) -> Vec<([usize; 4], [f32; 4])> {
    let read = |i: usize| {
        // Cell n has its middle at n + 1/2.
        let place = ((i as f32 + 0.5) / side as f32 + away) * cells - 0.5;
        let first = place.floor() as i32 - 1;
        let near = [0, 1, 2, 3].map(|k| first + k);
        (
            near.map(|cell| cell.rem_euclid(NOISE_SIDE as i32) as usize),
            near.map(|cell| spline(place - cell as f32)),
        )
    };
    (0..side).map(read).collect()
}

#[cfg(test)]
mod tests {
    use glam::Vec4;

    use welkin_pack::role::Wrap;

    use super::*;
    use crate::texture::Texture;

    #[test]
    fn the_spline_is_a_box_folded_three_times_with_itself() {
        // Its values at whole and half numbers, and that copies of it add up to 1.
        for (t, value) in [
            (0.0, 2.0 / 3.0),
            (1.0, 1.0 / 6.0),
            (0.5, 23.0 / 48.0),
            (1.5, 1.0 / 48.0),
            (2.0, 0.0),
        ] {
            assert!((spline(t) - value).abs() < 1e-6 && (spline(-t) - value).abs() < 1e-6);
        }
        for i in 0..10 {
            let t = i as f32 * 0.1;
            let sum = spline(t + 1.0) + spline(t) + spline(t - 1.0) + spline(t - 2.0);
            assert!((sum - 1.0).abs() < 1e-6, "{t}");
        }
    }

    #[test]
    fn the_share_is_the_normal_distributions() {
        for i in -400..=400 {
            let z = i as f32 * 0.01;
            let exact = 0.5 * libm::erfc(-f64::from(z) / std::f64::consts::SQRT_2);
            // Page's own bound is 0.00018.
            assert!((f64::from(normal_share(z)) - exact).abs() < 2e-4, "{z}");
        }
    }

    #[test]
    fn equal_noise_makes_an_even_map() {
        let octaves = OctaveUniforms {
            count: 2.0,
            resolution: 64.0,
            edge_grey: 0.75,
            copies: [Vec4::new(1.0, 0.5, 0.0, 0.0), Vec4::ZERO],
            exponent: -2.0,
            darkening: 0.5,
            relief: 1.0,
            sun_step: Vec2::new(0.1, 0.2),
            extinction: 3.0,
            ..Default::default()
        };
        let amount = normal_share(0.5);
        let clouds = Texture::from_levels(vec![Image::new(2, 2, 4)], Wrap::Repeat);
        let lights = [
            (Shading::Scattered, libm::exp2f(-3.0 * amount)),
            (Shading::Paper, 0.75 - 0.5 * amount),
        ];
        for (shading, light) in lights {
            let expected = [
                amount,
                alpha(amount, -2.0),
                alpha(amount, -2.0 * THIN),
                light,
            ];
            let photo = Photo {
                clouds: &clouds,
                uniforms: Default::default(),
            };
            let map = render(&octaves, &photo, shading, &[0.25; 2048]);
            for texel in map.texels.chunks_exact(4) {
                assert!((0..4).all(|c| (texel[c] - expected[c]).abs() < 1e-5));
            }
        }
    }
}
