//! Twin of clouds/lit/map.wgsl: each layer of the map, and what texture units may make of it.

use welkin_pack::{Image, LayerKind, Pack, Role};
use welkin_runtime::internals::clouds::lit::map::{LEAST_UP, WEIGHTS};
use welkin_runtime::internals::clouds::lit::{LitLayerUniforms, LitUniforms};
use welkin_runtime::params::MAX_LAYERS;

use crate::texture::{Texture, mix, smoothstep};

/// Level 0 of each layer in use, not rounded: light that falls on the cloud, amount, opacity, shade. `kinds` are the pack's layers.
pub fn render(lit: &LitUniforms, kinds: &[Texture]) -> Vec<Image> {
    map(lit, kinds, |layer, _, read| texel(lit, layer, read))
}

/// What each texel of level 0 may be off by, in bytes.
///
/// A texture unit may filter 8-bit texels in 8 bits, so each read is off by up to a byte; the weights of both reads add
/// up to 1. Exponentials of a GPU are off by 2^-11 of at most 1; the target rounds by half a byte.
pub fn bounds(lit: &LitUniforms, kinds: &[Texture]) -> Vec<Image> {
    let mut images = changes(lit, kinds, &[1.0 / 255.0; MAX_LAYERS]);
    for bound in images.iter_mut().flat_map(|image| &mut image.texels) {
        *bound = 255.0 * (*bound + libm::exp2f(-11.0)) + 0.5;
    }
    images
}

/// By how much each texel of level 0 changes if every read of a layer is off by up to as much as the layer's place in `off`
/// says.
///
/// Amount and opacity only rise with the rank, and shade only falls with ranks and densities, so they are farthest off
/// where every read is off the same way. For the light that falls on a cloud its normal is moved all ways.
fn changes(lit: &LitUniforms, kinds: &[Texture], off: &[f32]) -> Vec<Image> {
    const WAYS: [f32; 3] = [-1.0, 0.0, 1.0];
    map(lit, kinds, |layer, index, read| {
        let here = texel(lit, layer, read);
        let mut most = [0.0_f32; 4];
        let mut farthest = |channel: usize, there: f32| {
            most[channel] = most[channel].max((there - here[channel]).abs());
        };
        for way in WAYS {
            let by = way * off[index];
            let [_, amount, opacity, shade] = texel(lit, layer, read.map(|c| c + by));
            farthest(1, amount);
            farthest(2, opacity);
            farthest(3, shade);
            for other in WAYS {
                let [x, y, ..] = read;
                farthest(0, falls(lit, layer, [x + by, y + other * off[index]]));
            }
        }
        most
    })
}

/// By how much channels of each layer change at most from one moment to another beside their motion: the second read
/// moves, passes no more than the steepest slope between two texels on its way, and may be off by a byte one way before and
/// the other way after.
pub fn most_change(from: &LitUniforms, to: &LitUniforms, kinds: &[Texture]) -> Vec<[f32; 4]> {
    let layers = from.layers.iter().zip(&to.layers);
    let off: Vec<f32> = layers
        .map(|(from, to)| {
            let kind = &kinds[from.kind as usize];
            let turn = to.second_offset - from.second_offset;
            let turn = (turn - turn.round()).abs();
            let texels = kind.levels()[0].width as f32 * (turn.x + turn.y);
            WEIGHTS[1] * (texels * steepest(&kind.levels()[0]) + 2.0 / 255.0)
        })
        .collect();
    let images = changes(from, kinds, &off).into_iter();
    images.map(|image| largest(&image)).collect()
}

/// The largest difference of neighbouring texels in any channel, over the edges too.
fn steepest(image: &Image) -> f32 {
    let texel = |x: u32, y: u32| image.texel(x % image.width, y % image.height);
    let apart = |a: &[f32], b: &[f32]| {
        let pairs = a.iter().zip(b);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    };
    (0..image.height)
        .flat_map(|y| (0..image.width).map(move |x| (x, y)))
        .map(|(x, y)| {
            let here = texel(x, y);
            apart(here, texel(x + 1, y)).max(apart(here, texel(x, y + 1)))
        })
        .fold(0.0, f32::max)
}

/// The largest number in each of four channels.
fn largest(image: &Image) -> [f32; 4] {
    std::array::from_fn(|i| {
        let channel = image.texels.iter().skip(i).step_by(4);
        channel.fold(0.0, |most, value| value.max(most))
    })
}

/// The pack's layers, at the place of their kind.
///
/// # Panics
/// If the pack has none.
pub fn kinds(pack: &Pack) -> Vec<Texture> {
    LayerKind::ALL
        .map(|kind| Texture::layer(pack, Role::Layers, kind as u32))
        .into()
}

/// The same of a layer's four channels at most, and on average: rounding is off by a quarter of its step.
pub fn allowance(lit: &LitUniforms, kinds: &[Texture]) -> Vec<([f32; 4], [f32; 4])> {
    let of_layer = |bounds: Image| {
        let texels = bounds.texels.len() as f32 / 4.0;
        let channel = |i: usize| bounds.texels.iter().skip(i).step_by(4);
        let mean = std::array::from_fn(|i| channel(i).sum::<f32>() / texels / 4.0);
        (largest(&bounds), mean)
    };
    bounds(lit, kinds).into_iter().map(of_layer).collect()
}

/// The share of places where two even numbers, weighed and added, are less than this: the area below a slanted line in the unit
/// square, as areas of triangles.
pub fn even(blend: f32) -> f32 {
    let [larger, smaller] = WEIGHTS;
    let triangle = |side: f32| 0.5 * side.max(0.0) * side.max(0.0);
    let outside = triangle(blend - larger) + triangle(blend - smaller);
    (triangle(blend) - outside + triangle(blend - larger - smaller)) / (larger * smaller)
}

/// An image a layer of what follows from the blended read of the pack's texture.
fn map(
    lit: &LitUniforms,
    kinds: &[Texture],
    texel: impl Fn(&LitLayerUniforms, usize, [f32; 4]) -> [f32; 4],
) -> Vec<Image> {
    let side = lit.resolution;
    let layers = lit.layers.iter().take(lit.count as usize).enumerate();
    let draw = |(index, layer): (usize, &LitLayerUniforms)| {
        let kind = &kinds[layer.kind as usize];
        let mut image = Image::new(side as u32, side as u32, 4);
        for (i, out) in image.texels.chunks_exact_mut(4).enumerate() {
            let place = |i: usize| (i as f32 + 0.5) / side;
            let [x, y] = [i % side as usize, i / side as usize].map(place);
            out.copy_from_slice(&texel(layer, index, blend(layer, kind, [x, y])));
        }
        image
    };
    layers.map(draw).collect()
}

/// Both reads of the pack's texture: normal, density, rank.
fn blend(layer: &LitLayerUniforms, kind: &Texture, [u, v]: [f32; 2]) -> [f32; 4] {
    let away = layer.second_offset;
    let [here, other] = [[u, v], [u + away.x, v + away.y]].map(|uv| kind.sample(uv, 0.0));
    mix(here, other, WEIGHTS[1])
}

/// What the blended read of a place makes of a texel.
pub(crate) fn texel(lit: &LitUniforms, layer: &LitLayerUniforms, read: [f32; 4]) -> [f32; 4] {
    let [x, y, density, rank] = read;
    let amount = even(rank);
    // Equation 5. Under an overcast the cut is below 0, and what lies under 0 does not shade.
    let thick = (amount - layer.threshold.max(0.0)).max(0.0) * (0.5 + density);
    // What a thickness leaves of the light, so often as the exponent says.
    let left = libm::exp2f(-layer.shade_rate * thick);
    [
        falls(lit, layer, [x, y]),
        amount,
        smoothstep(0.0, 1.0, layer.steepness * (amount - layer.threshold)),
        libm::powf(left, lit.m),
    ]
}

/// Equation 3 over L: the normal, as flat as the layer's relief, on the direction to the sun.
fn falls(lit: &LitUniforms, layer: &LitLayerUniforms, stored: [f32; 2]) -> f32 {
    let [x, y] = stored.map(|part| layer.relief * (2.0 * part - 1.0));
    let up = libm::sqrtf((1.0 - x * x - y * y).max(LEAST_UP));
    (x * layer.sun_uv.x + y * layer.sun_uv.y + up * lit.light_direction.y).max(0.0)
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};

    use super::*;

    #[test]
    fn the_blend_of_two_even_numbers_is_made_even() {
        // Counted over a grid: cells that the slanted line crosses are in or out, two a column.
        let count = 400;
        for i in 0..=20 {
            let blend = i as f32 / 20.0;
            let place = |i: i32| (i as f32 + 0.5) / count as f32;
            let below = |x: i32, y: i32| WEIGHTS[0] * place(x) + WEIGHTS[1] * place(y) < blend;
            let pairs = (0..count).flat_map(|y| (0..count).map(move |x| (x, y)));
            let share = pairs.filter(|&(x, y)| below(x, y)).count() as f32 / (count * count) as f32;
            assert!((even(blend) - share).abs() < 2.0 / count as f32, "{blend}");
        }
        assert_eq!([even(0.0), even(1.0)], [0.0, 1.0]);
        assert_eq!([even(-0.1)], [0.0]);
    }

    /// One texel worked by hand: rank 1/2 everywhere is amount 1/2, 0.3 above the cut.
    #[test]
    fn equations_give_what_they_give_by_hand() {
        let lit = LitUniforms {
            light_direction: Vec3::new(0.0, 0.5, 0.0),
            m: 2.0,
            ..Default::default()
        };
        let layer = LitLayerUniforms {
            threshold: 0.2,
            steepness: 2.5,
            opacity: 1.0,
            shade_rate: 0.8,
            sun_uv: Vec2::new(0.6, 0.25),
            relief: 1.0,
            ..Default::default()
        };
        let [falls, amount, opacity, shade] = texel(&lit, &layer, [0.8, 0.5, 0.25, 0.5]);
        // A normal of (0.6, 0, 0.8).
        assert!((falls - (0.36 + 0.8 * 0.5)).abs() < 1e-6);
        assert!((amount - 0.5).abs() < 1e-6);
        // Three quarters of the way to being opaque: 27/16 - 27/32.
        assert!((opacity - 27.0 / 32.0).abs() < 1e-5);
        // 0.3 of thickness times 0.75 of density times 0.8, twice.
        assert!((shade - libm::exp2f(-2.0 * 0.8 * 0.3 * 0.75)).abs() < 1e-5);
        let [_, _, clear, bright] = texel(&lit, &layer, [0.0, 0.5, 0.25, 0.1]);
        assert_eq!([clear, bright], [0.0, 1.0], "no cloud, no shade");
    }
}
