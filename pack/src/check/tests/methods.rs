//! Faults of the textures that the other methods draw from.

use super::{assert_errors, assert_only, check_pack, each_texel, errors};
use crate::image::Image;
use crate::mapping::FlareCell;
use crate::pack::Pack;
use crate::role::Role;
use crate::test_pack::{Stream, displaced, fbm, noise, with, with_images, with_texture};

#[test]
fn a_value_that_is_more_often_than_others_is_an_error() {
    // The same wherever it is: the spectrum hardly sees one byte.
    let uneven = with(Role::Octaves, |image| image.texel_mut(9, 9)[2] = 0.5);
    assert_only("noise-flat", &uneven);
}

/// Sorts a channel by a key and lets its values follow: as many of each, but not where they were.
fn order_by(image: &mut Image, channel: usize, key: impl Fn(u32, u32, f32) -> f32) {
    let mut places: Vec<(f32, usize)> = (0..32 * 32)
        .map(|i| {
            (
                key(i % 32, i / 32, image.texel(i % 32, i / 32)[channel]),
                i as usize,
            )
        })
        .collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (rank, (_, place)) in places.into_iter().enumerate() {
        image.texels[place * 4 + channel] = (rank / 4) as f32 / 255.0;
    }
}

#[test]
fn noise_with_a_wave_or_a_colour_is_an_error() {
    let wave = with(Role::Octaves, |image| {
        order_by(image, 1, |x, y, value| {
            let turn = (5 * x + 3 * y) as f32 / 32.0;
            value + 0.15 * libm::cosf(std::f32::consts::TAU * turn)
        });
    });
    assert_only("noise-white", &wave);
    // Neighbours somewhat alike: no wave stands out, but long ones have more energy than short ones.
    let red = with(Role::Octaves, |image| {
        let white: Vec<f32> = image.channel(3).collect();
        let at = |x: u32, y: u32| white[(y % 32 * 32 + x % 32) as usize];
        order_by(image, 3, |x, y, value| {
            value + 0.7 * (at(x + 1, y) + at(x, y + 1))
        });
    });
    assert_only("noise-white", &red);
}

fn with_noise(layer: usize, change: impl FnOnce(&mut Image)) -> Pack {
    with_images(Role::Fbm, |images| {
        let mut noise = noise(64, 8 << layer);
        change(&mut noise);
        images[layer] = displaced(&noise);
    })
}

#[test]
fn an_octave_in_the_band_of_another_is_an_error() {
    for (layer, cells) in [(0, 4), (0, 16), (1, 8), (1, 32)] {
        // The lattice values of another octave are not where those of this one are.
        let wrong = with_noise(layer, |image| *image = noise(64, cells));
        let rules = errors(&check_pack(&wrong));
        assert!(rules.contains(&"octave-band"), "{rules:?}");
    }
    let swapped = with_images(Role::Fbm, |i| i.swap(0, 1));
    assert!(errors(&check_pack(&swapped)).contains(&"octave-band"));
}

#[test]
fn a_rough_or_flat_octave_is_an_error() {
    let rough = with_noise(0, |image| {
        let mut stream = Stream::new(4);
        let grain = |v: &mut f32| *v = (*v + 0.04 * (stream.unit() - 0.5)).clamp(0.0, 1.0);
        image.texels.iter_mut().for_each(grain);
    });
    // So rough that the first layer is taken for a finer one, and the second for one that is finer still.
    let rules = errors(&check_pack(&rough));
    assert!(rules.contains(&"octave-band"), "{rules:?}");
    let flat = with_noise(1, |image| image.texels.fill(0.5));
    assert_errors(&["octave-band", "octave-even"], &flat);
}

#[test]
fn channels_that_are_not_the_noise_displaced_are_errors() {
    // As far, the other way.
    let backwards = with_images(Role::Fbm, |images| {
        let there = fbm()[1].clone();
        each_texel(&mut images[1], |x, y, t| {
            t[2] = there.texel((x + 63) % 64, y)[3]
        });
    });
    assert_only("displaced", &backwards);
    let swapped = with_images(Role::Fbm, |images| {
        each_texel(&mut images[0], |_, _, t| t.swap(0, 1));
    });
    assert_only("displaced", &swapped);
    let other_layer = with_images(Role::Fbm, |images| {
        let first = images[0].clone();
        each_texel(&mut images[1], |x, y, t| {
            t[..3].copy_from_slice(&first.texel(x, y)[..3])
        });
    });
    assert_only("displaced", &other_layer);
}

#[test]
fn a_seam_in_any_layer_is_an_error() {
    for layer in 0..2 {
        let ramp = with_noise(layer, |image| {
            each_texel(image, |_, y, t| t[0] = 0.3 * t[0] + y as f32 / 64.0 * 0.7);
        });
        assert!(
            errors(&check_pack(&ramp)).contains(&"seam"),
            "layer {layer}"
        );
    }
}

#[test]
fn a_dark_cell_or_a_lit_border_of_the_flares_is_an_error() {
    for cell in FlareCell::ALL {
        let [column, row] = cell.place();
        let dim = with(Role::Flares, |image| {
            each_texel(image, |x, y, t| {
                if [x / 32, y / 32] == [column, row] {
                    t[0] *= 0.4;
                }
            });
        });
        let rules = errors(&check_pack(&dim));
        assert!(rules.contains(&"flare-cells"), "{rules:?}");
    }
    // One texel beside the line between two cells: filtering would take it across.
    let lit = with_texture(Role::Flares, |t| t.levels[0][64 * 10 + 33] = 1);
    assert_only("flare-cells", &lit);
}
