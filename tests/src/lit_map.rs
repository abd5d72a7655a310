//! Twin of clouds/lit/map.wgsl: each layer of the map, and what texture units may make of it.

use glam::Vec2;
use welkin_pack::{Image, LayerKind, Pack, Role};
use welkin_runtime::internals::clouds::lit::map::{
    APART, BENDS, EVENED_RELIEF, FIBRE_LEVEL, LEAST_UP, OWN, RELIEF, RELIEF_FULL, RISES,
    ROLL_LEVELS, ROLLS, SHARES, STEPS, WEIGHTS,
};
use welkin_runtime::internals::clouds::lit::{LitLayerUniforms, LitUniforms};
use welkin_runtime::internals::clouds::shared::MULTIPLE;
use welkin_runtime::params::{MAX_LAYERS, Shading};

use crate::clouds::wave;
use crate::photo::{Photo, even_blend, normal_share, over_even};
use crate::texture::{Texture, mix, smoothstep};

/// Level 0 of each layer in use, not rounded. By the paper's shading: light that falls on the cloud, amount, opacity, shade; by the other: what
/// is left of light that was scattered many times, amount, opacity, height. `kinds` are the pack's layers.
pub fn render(
    lit: &LitUniforms,
    kinds: &[Texture],
    photo: &Photo<'_>,
    shading: Shading,
) -> Vec<Image> {
    map(lit, kinds, photo, shading, |layer, _, places| {
        shaded(lit, layer, places, shading)
    })
}

/// What each texel of level 0 may be off by, in bytes.
///
/// A texture unit may filter 8-bit texels in 8 bits, so each read is off by up to a byte, and the weights of both reads add
/// up to 1; towards the sun it mixes levels, too. Exponentials of a GPU are off by 2^-11 of at most 1; the target rounds by half a byte.
pub fn bounds(
    lit: &LitUniforms,
    kinds: &[Texture],
    photo: &Photo<'_>,
    shading: Shading,
) -> Vec<Image> {
    let byte = match shading {
        Shading::Scattered => 1.5 / 255.0,
        Shading::Paper => 1.0 / 255.0,
    };
    // The density of a normal distribution is at most 0.4.
    let photo_off = byte * 0.4 * photo.uniforms.per_spread;
    let off = [byte; MAX_LAYERS];
    let mut images = changes(lit, kinds, photo, shading, &off, photo_off);
    for bound in images.iter_mut().flat_map(|image| &mut image.texels) {
        *bound = 255.0 * (*bound + libm::exp2f(-11.0)) + 0.5;
    }
    images
}

/// By how much each texel of level 0 changes if every read of a layer is off by up to as much as the layer's place in `off`
/// says, and the photo's amount by `photo_off`.
///
/// Amount, opacity and height only rise with the rank, and light and shade only fall with ranks and densities, so they are farthest off
/// where every read is off the same way. What follows from a normal is taken with it moved all ways.
fn changes(
    lit: &LitUniforms,
    kinds: &[Texture],
    photo: &Photo<'_>,
    shading: Shading,
    off: &[f32],
    photo_off: f32,
) -> Vec<Image> {
    const WAYS: [f32; 3] = [-1.0, 0.0, 1.0];
    map(lit, kinds, photo, shading, |layer, index, places| {
        let here = shaded(lit, layer, places, shading);
        let mut most = [0.0_f32; 4];
        let moved = |x: f32, y: f32, all: f32| {
            let by = all * off[index];
            let mut moved: Vec<Place> = places
                .iter()
                .map(|place| place.off_by(by, all * photo_off))
                .collect();
            for (part, way) in moved[0].read.iter_mut().zip([x, y]) {
                *part += way * off[index] - by;
            }
            shaded(lit, layer, &moved, shading)
        };
        for way in WAYS {
            for (x, y) in WAYS.iter().flat_map(|x| WAYS.map(|y| (*x, y))) {
                let there = moved(x, y, way);
                for (most, (there, here)) in most.iter_mut().zip(there.iter().zip(here)) {
                    *most = most.max((there - here).abs());
                }
            }
        }
        most
    })
}

/// By how much channels of each layer change at most from one moment to another beside their motion: the second read
/// moves, passes no more than the steepest slope between two texels on its way, and may be off by a byte one way before and
/// the other way after.
pub fn most_change(
    from: &LitUniforms,
    to: &LitUniforms,
    kinds: &[Texture],
    photo: &Photo<'_>,
    shading: Shading,
) -> Vec<[f32; 4]> {
    let layers = from.layers.iter().zip(&to.layers);
    let kind = &kinds[LayerKind::Cumulus as usize];
    let off: Vec<f32> = layers
        .map(|(from, to)| {
            let turn = to.second_offset - from.second_offset;
            let turn = (turn - turn.round()).abs();
            let texels = kind.levels()[0].width as f32 * (turn.x + turn.y);
            WEIGHTS[1] * (texels * steepest(&kind.levels()[0]) + 2.0 / 255.0)
        })
        .collect();
    let images = changes(from, kinds, photo, shading, &off, 0.0).into_iter();
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
pub fn allowance(
    lit: &LitUniforms,
    kinds: &[Texture],
    photo: &Photo<'_>,
    shading: Shading,
) -> Vec<([f32; 4], [f32; 4])> {
    let of_layer = |bounds: Image| {
        let texels = bounds.texels.len() as f32 / 4.0;
        let channel = |i: usize| bounds.texels.iter().skip(i).step_by(4);
        let mean = std::array::from_fn(|i| channel(i).sum::<f32>() / texels / 4.0);
        (largest(&bounds), mean)
    };
    bounds(lit, kinds, photo, shading)
        .into_iter()
        .map(of_layer)
        .collect()
}

/// The share of places where both reads, weighed and added, are less than this.
pub fn even(blend: f32) -> f32 {
    even_blend(blend, WEIGHTS[1])
}

/// What a layer is computed from in a place.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Both reads of the pack's texture: normal, density, rank.
    read: [f32; 4],
    /// Lumps and bands of an overcast, between 0 and 1.
    rolls: f32,
    /// The photo's share of the amount, and its own there.
    photo: [f32; 2],
    /// How many times as much as a read the rank is off.
    rank_gain: f32,
}

impl Place {
    /// At a level of the pack's texture.
    fn of(
        layer: &LitLayerUniforms,
        kinds: &[Texture],
        photo: &Photo<'_>,
        uv: Vec2,
        level: f32,
    ) -> Place {
        let [lumps, fibres] =
            [LayerKind::Cumulus, LayerKind::Cirrus].map(|kind| &kinds[kind as usize]);
        let kind = layer.kind as usize;
        let here = match kind == LayerKind::Cirrus as usize {
            true => fibres.splined(2.0 * bent(uv), level + FIBRE_LEVEL),
            false => kinds[kind].sample(uv.to_array(), level),
        };
        let away = (uv + layer.second_offset).to_array();
        let other = lumps.sample(away, level + layer.second_level);
        let [coarse, coarser] = ROLL_LEVELS;
        let [_, _, lump, _] = lumps.sample(away, level + coarse);
        let [_, _, band, _] = fibres.sample(bent(uv).to_array(), level + coarser);
        let ([mut here, mut other], mut rank_gain) = ([here, other], 1.0);
        if kind == LayerKind::Cirrus as usize {
            for (read, spread) in [(&mut here, layer.spreads.x), (&mut other, layer.spreads.y)] {
                read[3] = normal_share((read[3] - 0.5) / spread);
            }
            // The density of a normal distribution is at most 0.4.
            rank_gain = 0.4 / layer.spreads.min_element();
        }
        Place {
            read: mix(here, other, WEIGHTS[1]),
            rolls: 0.5 * (lump + band),
            photo: photo.share(uv),
            rank_gain,
        }
    }

    /// How much cloud there is.
    fn amount(&self) -> f32 {
        over_even(even(self.read[3]), self.photo)
    }

    /// With every read off, and the photo's amount.
    fn off_by(&self, off: f32, photo_off: f32) -> Place {
        Place {
            read: std::array::from_fn(|i| {
                self.read[i] + if i == 3 { self.rank_gain * off } else { off }
            }),
            rolls: self.rolls + off,
            photo: [self.photo[0], self.photo[1] + photo_off],
            ..*self
        }
    }
}

/// Where the fibres of a place of cirrus are.
fn bent(uv: Vec2) -> Vec2 {
    let [long, short, along, short_along] = BENDS;
    let v = uv.y + long * wave(uv.x) + short * wave(2.0 * uv.x + 0.16);
    Vec2::new(
        uv.x + along * wave(v + 0.32) + short_along * wave(3.0 * v),
        v,
    )
}

/// An image a layer of what follows from its places: its own and, but for the paper's shading, those towards the sun.
fn map(
    lit: &LitUniforms,
    kinds: &[Texture],
    photo: &Photo<'_>,
    shading: Shading,
    texel: impl Fn(&LitLayerUniforms, usize, &[Place]) -> [f32; 4],
) -> Vec<Image> {
    let side = lit.resolution;
    let layers = lit.layers.iter().take(lit.count as usize).enumerate();
    let draw = |(index, layer): (usize, &LitLayerUniforms)| {
        let step_texels = layer.sun_step.length() * kinds[0].levels()[0].width as f32;
        let towards: Vec<(f32, f32)> = match shading {
            Shading::Scattered => (STEPS.iter().zip(APART))
                .map(|(steps, apart)| (*steps, libm::log2f(0.5 * step_texels * apart).max(0.0)))
                .collect(),
            Shading::Paper => Vec::new(),
        };
        let mut image = Image::new(side as u32, side as u32, 4);
        for (i, out) in image.texels.chunks_exact_mut(4).enumerate() {
            let [x, y] = [i % side as usize, i / side as usize].map(|i| (i as f32 + 0.5) / side);
            let at = |(steps, level): (f32, f32)| {
                Place::of(
                    layer,
                    kinds,
                    photo,
                    Vec2::new(x, y) + layer.sun_step * steps,
                    level,
                )
            };
            let places: Vec<Place> = [(0.0, 0.0)]
                .into_iter()
                .chain(towards.iter().copied())
                .map(at)
                .collect();
            out.copy_from_slice(&texel(layer, index, &places));
        }
        image
    };
    layers.map(draw).collect()
}

fn shaded(
    lit: &LitUniforms,
    layer: &LitLayerUniforms,
    places: &[Place],
    shading: Shading,
) -> [f32; 4] {
    match shading {
        Shading::Scattered => scattered(lit, layer, places),
        Shading::Paper => texel(lit, layer, places[0].read, places[0].amount()),
    }
}

/// Height of a layer's cloud, with the rolls of an overcast.
pub(crate) fn height(lit: &LitUniforms, layer: &LitLayerUniforms, amount: f32, rolls: f32) -> f32 {
    let alone = layer.height_rate * (amount - layer.threshold.max(0.0)).max(0.0);
    let [least, rising, own, round] = ROLLS;
    let rolls = least + rising * (rolls - 0.5) + own * (amount - 0.5);
    let shut = 0.5 * (rolls + libm::sqrtf(rolls * rolls + round));
    alone * (1.0 - lit.overcast) + shut * lit.overcast
}

/// What sunlight passes of its own height and of those towards the sun, where the surface does not lean.
pub(crate) fn passed(own: f32, towards: [f32; 3]) -> f32 {
    let over = towards
        .iter()
        .zip(RISES)
        .map(|(height, rise)| (height - rise).max(0.0));
    OWN * own
        + over
            .zip(SHARES)
            .map(|(over, share)| over * share)
            .sum::<f32>()
}

fn scattered(lit: &LitUniforms, layer: &LitLayerUniforms, places: &[Place]) -> [f32; 4] {
    let [x, y, ..] = places[0].read;
    let heights: Vec<f32> = places
        .iter()
        .map(|place| height(lit, layer, place.amount(), place.rolls))
        .collect();
    let lean = [x, y].map(|part| layer.relief * (2.0 * part - 1.0));
    let towards_sun = Vec2::from(lean).dot(layer.sun_uv);
    let kept = 1.0 - EVENED_RELIEF * lit.overcast;
    let relief = RELIEF * kept * towards_sun * (RELIEF_FULL * heights[0]).min(1.0);
    let passed = passed(heights[0], [heights[1], heights[2], heights[3]]) - relief;
    let amount = places[0].amount();
    [
        libm::exp2f(-MULTIPLE[1] * layer.extinction * passed.max(0.0)),
        amount,
        smoothstep(0.0, 1.0, layer.steepness * (amount - layer.threshold)),
        heights[0].min(1.0),
    ]
}

/// What the blended read of a place makes of a texel by the paper's shading.
pub(crate) fn texel(
    lit: &LitUniforms,
    layer: &LitLayerUniforms,
    [x, y, density, _]: [f32; 4],
    amount: f32,
) -> [f32; 4] {
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
        let [falls, amount, opacity, shade] = texel(&lit, &layer, [0.8, 0.5, 0.25, 0.5], even(0.5));
        // A normal of (0.6, 0, 0.8).
        assert!((falls - (0.36 + 0.8 * 0.5)).abs() < 1e-6);
        assert!((amount - 0.5).abs() < 1e-6);
        // Three quarters of the way to being opaque: 27/16 - 27/32.
        assert!((opacity - 27.0 / 32.0).abs() < 1e-5);
        // 0.3 of thickness times 0.75 of density times 0.8, twice.
        assert!((shade - libm::exp2f(-2.0 * 0.8 * 0.3 * 0.75)).abs() < 1e-5);
        let [_, _, clear, bright] = texel(&lit, &layer, [0.0, 0.5, 0.25, 0.1], even(0.1));
        assert_eq!([clear, bright], [0.0, 1.0], "no cloud, no shade");
    }
}
