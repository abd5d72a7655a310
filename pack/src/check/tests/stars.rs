//! Faults of the star texture.

use super::{assert_errors, assert_only, change_level, check_pack, errors};
use crate::image::Image;
use crate::pack::Pack;
use crate::role::Role;
use crate::test_pack::{Stream, stars, with, with_texture};

fn with_stars(change: impl FnOnce(&mut Image)) -> Pack {
    with(Role::Stars, change)
}

fn each_star(image: &mut Image, mut change: impl FnMut(&mut [f32])) {
    image
        .texels
        .chunks_exact_mut(4)
        .filter(|t| t[0] > 0.0)
        .for_each(&mut change);
}

#[test]
fn a_sky_full_of_stars_is_an_error() {
    assert_only("star-share", &with_stars(|image| *image = stars(128, 2000)));
}

#[test]
fn a_sky_without_stars_is_an_error() {
    let none = with_stars(|image| image.texels.fill(0.0));
    assert_only("star-share", &none);
}

#[test]
fn a_lone_star_is_a_sky() {
    for count in [1, 5, 20, 40] {
        let pack = with_stars(|image| *image = stars(128, count));
        let report = check_pack(&pack);
        assert!(
            report.is_sound(),
            "{:#?}",
            report.problems().collect::<Vec<_>>()
        );
    }
}

#[test]
fn data_where_there_is_no_star_is_an_error() {
    let stray = with_texture(Role::Stars, |t| {
        let dark = t.levels[0].chunks_exact(4).position(|t| t[0] == 0).unwrap();
        t.levels[0][dark * 4 + 3] = 9;
    });
    assert_only("star-empty", &stray);
}

#[test]
fn a_star_that_clips_is_an_error_on_any_level() {
    for level in [0, 1, 3] {
        let clipped = with_texture(Role::Stars, |t| {
            let star = t.levels[level]
                .chunks_exact(4)
                .position(|t| t[0] > 0)
                .unwrap();
            t.levels[level][star * 4 + 2] = t.levels[level][star * 4] + 1;
        });
        assert_only("star-clip", &clipped);
    }
}

#[test]
fn a_level_that_loses_light_is_an_error() {
    let darker = with_texture(Role::Stars, |t| {
        change_level(t, 1, |_, t| {
            t[0] = if t[0] == 0 {
                0
            } else {
                ((u16::from(t[0]) * 3 / 4) as u8).max(1)
            };
            t[2] = (u16::from(t[2]) * 3 / 4) as u8;
        });
    });
    let rules = errors(&check_pack(&darker));
    assert!(rules.contains(&"star-light"), "{rules:?}");
    let moved = with_texture(Role::Stars, |t| t.levels[2].rotate_left(4));
    assert_errors(&["star-light", "star-record"], &moved);
}

#[test]
fn stars_in_step_are_an_error() {
    assert_only(
        "star-phase",
        &with_stars(|image| each_star(image, |t| t[3] *= 0.7)),
    );
}

#[test]
fn stars_on_a_lattice_are_an_error() {
    let lattice = with_stars(|image| {
        let mut stream = Stream::new(5);
        let mut stars: Vec<[f32; 4]> = Vec::new();
        each_star(image, |t| stars.push([t[0], t[1], t[2], t[3]]));
        image.texels.fill(0.0);
        for star in stars {
            // One place in four of a lattice of five texels, so that counts still scatter.
            let (x, y) = (stream.below(25) * 5, stream.below(25) * 5);
            image.texel_mut(x, y).copy_from_slice(&star);
        }
    });
    assert_only("star-lattice", &lattice);
}

#[test]
fn stars_in_clusters_are_an_error() {
    let clusters = with_stars(|image| {
        let mut stream = Stream::new(6);
        let mut stars: Vec<[f32; 4]> = Vec::new();
        each_star(image, |t| stars.push([t[0], t[1], t[2], t[3]]));
        image.texels.fill(0.0);
        // Many small clusters all over: their structure factor is raised at every wave vector, but little.
        let centres: Vec<[u32; 2]> = (0..160)
            .map(|_| [stream.below(128), stream.below(128)])
            .collect();
        for (index, star) in stars.iter().enumerate() {
            let [x, y] = centres[index % centres.len()];
            let (x, y) = ((x + stream.below(9)) % 128, (y + stream.below(9)) % 128);
            image.texel_mut(x, y).copy_from_slice(star);
        }
    });
    assert_only("star-cluster", &clusters);
}
