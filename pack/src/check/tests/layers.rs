//! Faults of the layers of clouds.

use super::{assert_only, change_level, check_pack, each_texel, errors};
use crate::image::Image;
use crate::layer_kind::LayerKind;
use crate::pack::Pack;
use crate::role::Role;
use crate::test_pack::{Stream, layer, layers, waves, with_images, with_mean, with_texture};

fn with_layer(index: usize, change: impl FnOnce(&mut Image)) -> Pack {
    with_images(Role::Layers, |images| change(&mut images[index]))
}

#[test]
fn a_normal_that_is_too_long_is_an_error() {
    let long = with_layer(1, |image| {
        image.texel_mut(5, 5)[..2].copy_from_slice(&[0.95, 0.05]);
    });
    // No density has such a slope, either.
    assert_eq!(errors(&check_pack(&long)), ["normal-unit", "normal-slope"]);
}

#[test]
fn a_normal_of_a_level_that_is_not_the_unit_vector_of_its_mean_is_an_error() {
    for level in [1, 3, 6] {
        for channel in [0, 1] {
            let bent = with_texture(Role::Layers, |t| {
                change_level(t, level, |i, texel| {
                    texel[channel] += if i == 0 { 4 } else { 0 }
                });
            });
            assert_only("normal-unit", &bent);
        }
    }
}

#[test]
fn normals_that_were_averaged_and_not_made_unit_vectors_are_an_error() {
    let short = with_texture(Role::Layers, |t| {
        for level in 1..t.levels.len() {
            let bytes = t.level_bytes(level) / 3;
            for layer in 0..3 {
                let mean = crate::mip::fold::halve(&t.image(level - 1, layer));
                for (i, texel) in mean.texels.chunks_exact(4).enumerate() {
                    let at = bytes * layer as usize + 4 * i;
                    for (to, from) in t.levels[level][at..at + 2].iter_mut().zip(texel) {
                        *to = crate::texture::unorm8(*from);
                    }
                }
            }
        }
    });
    assert_only("normal-unit", &short);
}

#[test]
fn a_level_that_is_not_the_mean_is_an_error() {
    for (level, channel) in [(1, 2), (2, 3), (4, 2)] {
        // One up, one down: the mean of the level stays.
        let changed = with_texture(Role::Layers, |t| {
            change_level(t, level, |i, texel| match i {
                0 => texel[channel] += 2,
                1 => texel[channel] -= 2,
                _ => {}
            });
        });
        assert_only("level-mean", &changed);
    }
}

#[test]
fn normals_of_another_surface_are_errors() {
    for index in 0..3 {
        let swapped = with_layer(index, |image| each_texel(image, |_, _, t| t.swap(0, 1)));
        assert_only("normal-slope", &swapped);
        let mirrored = with_layer(index, |image| {
            each_texel(image, |_, _, t| t[1] = 1.0 - t[1]);
        });
        assert_only("normal-slope", &mirrored);
    }
    let from_below = with_layer(0, |image| {
        each_texel(image, |_, _, t| {
            t[..2].iter_mut().for_each(|n| *n = 1.0 - *n)
        });
    });
    assert_only("normal-slope", &from_below);
    let other = with_images(Role::Layers, |images| {
        let first = images[0].clone();
        each_texel(&mut images[1], |x, y, t| {
            t[..2].copy_from_slice(&first.texel(x, y)[..2])
        });
    });
    assert_only("normal-slope", &other);
}

#[test]
fn normals_that_do_not_tile_are_errors() {
    // The last column has the slope of the one before, as if there were nothing beyond it.
    let clamped = with_layer(2, |image| {
        for y in 0..64 {
            let before = image.texel(62, y)[0];
            image.texel_mut(63, y)[0] = before;
        }
    });
    assert_only("normal-slope", &clamped);
}

#[test]
fn flat_normals_are_an_error_though_they_fit_a_low_surface() {
    let flat = with_layer(0, |image| {
        each_texel(image, |_, _, t| t[..2].fill(0.5));
    });
    assert_only("normal-slope", &flat);
}

#[test]
fn a_rank_that_is_more_often_than_others_is_an_error() {
    // The densest texel of a rank takes the next one: the order is kept.
    let uneven = with_layer(1, |image| {
        let rank = 100.0 / 255.0;
        let texels = image.texels.chunks_exact_mut(4).filter(|t| t[3] == rank);
        let densest = texels.max_by(|a, b| a[2].total_cmp(&b[2])).unwrap();
        densest[3] = 101.0 / 255.0;
    });
    assert_only("rank-flat", &uneven);
}

#[test]
fn ranks_that_fall_are_an_error() {
    let swapped = with_layer(2, |image| {
        let place = |rank: f32| {
            let mut texels = image.texels.chunks_exact(4);
            4 * texels.position(|t| t[3] == rank).unwrap() + 3
        };
        let places = [100.0 / 255.0, 110.0 / 255.0].map(place);
        image.texels.swap(places[0], places[1]);
    });
    assert_only("rank-order", &swapped);
}

#[test]
fn a_flat_density_has_no_spread() {
    let flat = with_layer(0, |image| {
        let density: Vec<f32> = image.channel(2).map(|d| 0.5 + 0.1 * (d - 0.5)).collect();
        *image = layer(&density);
    });
    assert_only("cloud-spread", &flat);
}

#[test]
fn texel_noise_in_any_layer_is_not_smooth() {
    for index in 0..3 {
        let rough = with_layer(index, |image| {
            let mut stream = Stream::new(5);
            let density: Vec<f32> = image
                .channel(2)
                .map(|d| 0.25 + 0.5 * d + 0.25 * stream.unit())
                .collect();
            let mean = LayerKind::ALL[index].mean_density();
            *image = layer(&with_mean(density, 0.0, mean));
        });
        assert_only("smooth", &rough);
    }
}

#[test]
fn a_seam_in_any_layer_is_an_error() {
    for index in 0..3 {
        let ramp = with_layer(index, |image| {
            let density: Vec<f32> = (0..)
                .zip(waves(64, 40))
                .map(|(i, d)| 0.8 * d + 0.2 * (i / 64) as f32 / 64.0)
                .collect();
            let mean = LayerKind::ALL[index].mean_density();
            *image = layer(&with_mean(density, 0.0, mean));
        });
        assert_only("seam", &ramp);
    }
}

#[test]
fn sound_layers_of_many_kinds_pass() {
    for seed in 50..70 {
        let sound = with_images(Role::Layers, |images| {
            assert_eq!(images, &layers());
            for (image, kind) in images.iter_mut().zip(LayerKind::ALL) {
                *image = layer(&with_mean(waves(64, seed), 0.0, kind.mean_density()));
            }
        });
        let report = check_pack(&sound);
        let lines: Vec<String> = report.problems().map(ToString::to_string).collect();
        assert!(lines.is_empty(), "seed {seed}: {lines:#?}");
    }
}
