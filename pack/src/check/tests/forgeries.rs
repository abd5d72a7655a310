//! Textures that are well formed and not what they claim to be: each is refused by the rule that is meant for it.

use super::{assert_errors, assert_only, change_level, check_pack, each_texel, errors};
use crate::build::PackInfo;
use crate::image::Image;
use crate::pack::Pack;
use crate::role::Role;
use crate::test_field::field;
use crate::test_pack::{half_float_pack, pack, waves, with, with_images, with_mean, with_texture};
use crate::texture::Texture;

fn with_clouds(change: impl Fn(&mut [f32])) -> Pack {
    with(Role::Clouds, |image| each_texel(image, |_, _, t| change(t)))
}

/// A pack whose cloud channel is another field, brought to what the channel asks.
fn with_channel(channel: usize, field: Vec<f32>, [clear, mean]: [f32; 2]) -> Pack {
    with(Role::Clouds, |image| {
        let texels = image.texels.chunks_exact_mut(4);
        for (texel, value) in texels.zip(with_mean(field, clear, mean)) {
            texel[channel] = value;
        }
    })
}

const NOISE: [f32; 2] = [0.004, 0.26];

#[test]
fn channels_in_each_others_places_are_errors() {
    assert_errors(
        &["cloud-clear", "cloud-mean"],
        &with_clouds(|t| t.swap(0, 1)),
    );
    let report = check_pack(&with_clouds(|t| t.swap(1, 2)));
    assert!(errors(&report).contains(&"cloud-mean"));
    let report = check_pack(&with_clouds(|t| t.swap(0, 2)));
    assert!(errors(&report).contains(&"cloud-clear"));
}

#[test]
fn an_inverse_and_a_shift_end_nowhere_at_clear_sky() {
    let inverse = with_clouds(|t| t[2] = 1.0 - t[2]);
    assert!(errors(&check_pack(&inverse)).contains(&"cloud-clear"));
    let shifted = with_clouds(|t| t[2] = (t[2] + 50.0 / 255.0).min(1.0));
    assert!(errors(&check_pack(&shifted)).contains(&"cloud-clear"));
    let faint = with_clouds(|t| t[0] *= 0.9);
    assert_only("cloud-clear", &faint);
}

#[test]
fn stripes_are_no_noise() {
    let turn = |i: usize| std::f32::consts::TAU * 3.0 * (i % 64) as f32 / 64.0;
    let stripes: Vec<f32> = (0..4096).map(|i| 0.5 + 0.5 * libm::sinf(turn(i))).collect();
    for (channel, aim) in [(0, [0.06, 0.16]), (1, NOISE), (2, [0.004, 0.5])] {
        let report = check_pack(&with_channel(channel, stripes.clone(), aim));
        assert!(errors(&report).contains(&"cloud-waves"), "{channel}");
    }
    assert_only(
        "cloud-waves",
        &with_channel(0, crate::test_pack::few_waves(64), [0.06, 0.16]),
    );
}

#[test]
fn noise_of_other_octaves_is_an_error() {
    let coarse: Vec<f32> = {
        let half = waves(32, 9);
        let at = |i: usize| half[(i / 64 / 2) * 32 + i % 64 / 2];
        let smooth = |i: usize| {
            0.25 * (at(i) + at((i + 1) % 4096) + at((i + 64) % 4096) + at((i + 65) % 4096))
        };
        (0..4096).map(smooth).collect()
    };
    // The same waves, but the manifest says that they are twice as fine.
    assert!(check_pack(&with_channel(1, coarse.clone(), NOISE)).is_sound());
    let finer = with_info(|info| info.noise.cells = 28, |_| {});
    assert_only("cloud-band", &finer);
}

/// A pack whose recipe was another.
fn with_info(change: impl FnOnce(&mut PackInfo), textures: impl Fn(&mut Texture)) -> Pack {
    let mut info = crate::test_pack::info();
    change(&mut info);
    let pack = pack();
    let all = Role::ALL.into_iter().filter_map(|role| {
        let mut texture = pack.texture(role)?.clone();
        textures(&mut texture);
        Some((role, texture))
    });
    let pack = Pack::from_textures(info, all.collect()).unwrap();
    pack.with_field(field()).unwrap()
}

#[test]
fn a_mean_that_is_not_the_recipes_is_an_error() {
    assert_only(
        "cloud-mean",
        &with_info(|info| info.detail.mean = 0.52, |_| {}),
    );
}

#[test]
fn copies_are_errors_by_whatever_curve() {
    let photo = |t: &mut [f32]| libm::powf(t[0], 0.6);
    let report = check_pack(&with_clouds(|t| t[1] = photo(t)));
    assert!(errors(&report).contains(&"cloud-apart"));
    assert_only("cloud-apart", &with_channel(1, waves(64, 0), NOISE));
    assert_only("cloud-apart", &with_channel(2, waves(64, 1), [0.004, 0.5]));
}

#[test]
fn levels_that_are_constant_or_shuffled_are_errors() {
    for pack in [pack(), half_float_pack()] {
        let constant = forged(&pack, Role::Clouds, |t| {
            let size = t.format.bytes_per_texel();
            for level in 1..t.levels.len() {
                let middle = t.levels[6.min(t.levels.len() - 1)][..size].to_vec();
                change_level(t, level, |_, texel| {
                    texel[..size * 3 / 4].copy_from_slice(&middle[..size * 3 / 4])
                });
            }
        });
        assert_only("level-mean", &constant);
        let shuffled = forged(&pack, Role::Clouds, |t| {
            let size = t.format.bytes_per_texel();
            let row = size * 32;
            // Rows by a stride that is odd, so each comes once; the gradient stays.
            let level = t.levels[1].clone();
            for (y, to) in t.levels[1].chunks_exact_mut(row).enumerate() {
                let from = &level[(y * 13 % 32) * row..][..row];
                for (to, from) in to.chunks_exact_mut(size).zip(from.chunks_exact(size)) {
                    to[..size * 3 / 4].copy_from_slice(&from[..size * 3 / 4]);
                }
            }
        });
        assert!(errors(&check_pack(&shuffled)).contains(&"level-mean"));
    }
}

/// A pack with one texture changed as it is stored.
fn forged(pack: &Pack, role: Role, change: impl Fn(&mut Texture)) -> Pack {
    let textures = Role::ALL.into_iter().filter_map(|r| {
        let mut texture = pack.texture(r)?.clone();
        if r == role {
            change(&mut texture);
        }
        Some((r, texture))
    });
    let forged = Pack::from_textures(crate::test_pack::info(), textures.collect()).unwrap();
    forged.with_field(field()).unwrap()
}

#[test]
fn what_is_not_a_number_is_an_error_on_every_level() {
    // On level 0 it would make a mean that JSON cannot hold.
    let nan = half::f16::NAN.to_le_bytes();
    for (role, level) in [(Role::Clouds, 1), (Role::Clouds, 6), (Role::Skybox, 2)] {
        let wrong = forged(&half_float_pack(), role, |t| {
            t.levels[level..].iter_mut().for_each(|level| {
                level
                    .chunks_exact_mut(2)
                    .for_each(|half| half.copy_from_slice(&nan));
            });
        });
        assert_only("finite", &wrong);
    }
}

#[test]
fn a_level_whose_rounding_adds_up_is_an_error() {
    // Every texel is rounded upwards: never by a step, but always to the same side.
    const DETAIL: usize = 2;
    let drifting = with_texture(Role::Clouds, |t| {
        for level in 1..t.levels.len() {
            let above = t.image(level - 1, 0);
            let (width, _) = t.level_size(level);
            for (i, texel) in t.levels[level].chunks_exact_mut(4).enumerate() {
                let (x, y) = (i as u32 % width * 2, i as u32 / width * 2);
                let four = [(0, 0), (1, 0), (0, 1), (1, 1)];
                let values = four.map(|(i, j)| above.texel(x + i, y + j)[DETAIL]);
                let mean = values.iter().sum::<f32>() * 255.0 / 4.0;
                texel[DETAIL] = libm::ceilf(mean - 1e-3) as u8;
            }
        }
    });
    assert_only("mip-mean", &drifting);
}

fn with_stars(change: impl FnMut(&mut [f32])) -> Pack {
    with(Role::Stars, |image| {
        let stars = image.texels.chunks_exact_mut(4).filter(|t| t[0] > 0.0);
        stars.for_each(change);
    })
}

#[test]
fn stars_that_stand_still_or_beat_alike_are_errors() {
    assert_only("star-flicker", &with_stars(|t| t[2] = 0.0));
    let still = with_texture(Role::Stars, |t| change_level(t, 1, |_, t| t[2] = 0));
    assert_only("star-flicker", &still);
    assert_only("star-rate", &with_stars(|t| t[1] = 0.5));
    let swapped = check_pack(&with_stars(|t| t.swap(1, 3)));
    assert!(errors(&swapped).contains(&"star-rate"));
    assert_only(
        "star-brightest",
        &with_stars(|t| {
            t[0] *= 0.5;
            t[2] *= 0.5;
        }),
    );
}

#[test]
fn a_level_with_the_beat_of_no_star_is_an_error() {
    for channel in [1, 3] {
        let strange = with_texture(Role::Stars, |t| {
            let star = t.levels[1].chunks_exact(4).position(|t| t[0] > 0).unwrap();
            t.levels[1][4 * star + channel] ^= 0x55;
        });
        assert_only("star-record", &strange);
    }
}

#[test]
fn light_that_is_no_band_is_no_galaxy() {
    let even = with(Role::Galaxy, |image| image.texels.fill(0.4));
    assert_only("galaxy-band", &even);
    let noise = with(Role::Galaxy, |image| {
        let mut stream = crate::test_pack::Stream::new(8);
        image
            .texels
            .iter_mut()
            .for_each(|v| *v = 0.9 * stream.unit());
    });
    assert_only("galaxy-band", &noise);
}

#[test]
fn a_sun_that_is_not_round_is_an_error() {
    let squeezed = with(Role::Sun, |image| {
        let sound = image.clone();
        each_texel(image, |x, y, t| {
            t[1] = sound.texel(x, (y / 2 + 8).min(31))[1] * sound.texel(x, y)[1]
        });
    });
    assert_only("sun-round", &squeezed);
}

#[test]
fn noise_of_less_contrast_is_an_error() {
    let faint = with_images(Role::Fbm, |images| {
        let halve = |image: &mut Image| image.texels.iter_mut().for_each(|v| *v = 0.25 + 0.5 * *v);
        images.iter_mut().for_each(halve);
    });
    assert_only("octave-even", &faint);
}

#[test]
fn flares_in_each_others_cells_are_errors() {
    for (dx, dy) in [(32, 0), (0, 32), (32, 32)] {
        let moved = with(Role::Flares, |image| {
            let sound = image.clone();
            each_texel(image, |x, y, t| {
                t[0] = sound.texel((x + dx) % 64, (y + dy) % 64)[0]
            });
        });
        assert_only("flare-shape", &moved);
    }
}

#[test]
fn layers_in_each_others_places_are_errors() {
    for (a, b) in [(0, 1), (1, 2), (0, 2)] {
        assert_only(
            "layer-mean",
            &with_images(Role::Layers, |images| images.swap(a, b)),
        );
    }
}
