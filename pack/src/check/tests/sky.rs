//! Faults of the table of the clear sky.

use super::{assert_errors, assert_only, check_pack, errors};
use crate::image::Image;
use crate::mapping::{SKY_HAZES, SKY_PARTS, SkyLayer};
use crate::pack::Pack;
use crate::role::Role;
use crate::test_pack::with_images;

/// Elevations of the sun in the test pack.
const SUNS: u32 = 16;

fn with_sky(change: impl FnOnce(&mut Vec<Image>)) -> Pack {
    with_images(Role::Sky, change)
}

fn each_texel(images: &mut [Image], mut change: impl FnMut(&mut [f32])) {
    let texels = images.iter_mut().flat_map(|i| i.texels.chunks_exact_mut(4));
    texels.for_each(&mut change);
}

/// The same image of another sun, row and column.
fn turned(place: impl Fn(u32, u32, u32) -> [u32; 3]) -> Pack {
    with_sky(|images| {
        let sound = images.clone();
        for haze in 0..SKY_HAZES {
            for (sun, part) in (0..SUNS).flat_map(|s| (0..SKY_PARTS).map(move |p| (s, p))) {
                let at = |sun| SkyLayer { haze, sun, part }.index(SUNS) as usize;
                let image = &mut images[at(sun)];
                let (width, height) = (image.width, image.height);
                for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
                    let [sun, from_x, from_y] = place(sun, x, y);
                    image
                        .texel_mut(x, y)
                        .copy_from_slice(sound[at(sun)].texel(from_x, from_y));
                }
            }
        }
    })
}

#[test]
fn light_that_is_none_is_an_error() {
    assert_only("sky-range", &with_sky(|i| i[3].texel_mut(3, 3)[1] = -0.1));
    assert_only("sky-range", &with_sky(|i| i[7].texel_mut(0, 9)[3] = 0.5));
}

#[test]
fn a_zenith_of_several_looks_is_an_error() {
    let spot = with_sky(|images| {
        let row = images[20].height - 1;
        images[20].texel_mut(2, row)[..3]
            .iter_mut()
            .for_each(|v| *v *= 1.02);
    });
    assert_only("sky-zenith", &spot);
}

#[test]
fn a_texel_that_stands_out_is_an_error() {
    let spot = with_sky(|images| {
        images[40].texel_mut(3, 6)[..3]
            .iter_mut()
            .for_each(|v| *v *= 1.8)
    });
    assert_only("sky-smooth", &spot);
}

#[test]
fn skies_of_another_hour_or_strength_are_errors() {
    let times = |factor: f32| {
        with_sky(|images| each_texel(images, |t| t.iter_mut().for_each(|v| *v *= factor)))
    };
    assert_only("sky-light", &times(0.1));
    assert_only("sky-light", &times(10.0));
    assert!(errors(&check_pack(&times(0.0))).contains(&"sky-light"));
    // Some hours early or late.
    for by in [4, 12] {
        let late = turned(|sun, x, y| [(sun + by) % SUNS, x, y]);
        assert!(errors(&check_pack(&late)).contains(&"sky-light"), "{by}");
    }
    assert!(
        errors(&check_pack(&turned(|sun, x, y| [SUNS - 1 - sun, x, y]))).contains(&"sky-light")
    );
}

#[test]
fn skies_turned_about_are_errors() {
    let upside_down = turned(|sun, x, y| [sun, x, 15 - y]);
    assert!(errors(&check_pack(&upside_down)).contains(&"sky-dusk"));
    assert_errors(
        &["sky-sun", "sky-dusk"],
        &turned(|sun, x, y| [sun, 7 - x, y]),
    );
}

#[test]
fn skies_of_another_colour_are_errors() {
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        assert_only(
            "sky-colour",
            &with_sky(|images| each_texel(images, |t| t.swap(a, b))),
        );
    }
    let grey = with_sky(|images| {
        each_texel(images, |t| {
            let grey = 0.2126 * t[0] + 0.7152 * t[1] + 0.0722 * t[2];
            t[..3].fill(grey);
        });
    });
    assert_only("sky-colour", &grey);
}

#[test]
fn hazes_in_each_others_places_are_an_error() {
    let swapped = with_sky(|images| images.rotate_left((SUNS * SKY_PARTS) as usize));
    assert_only("sky-haze", &swapped);
    let one_for_both = with_sky(|images| {
        let (clear, hazy) = images.split_at_mut((SUNS * SKY_PARTS) as usize);
        hazy.clone_from_slice(clear);
    });
    assert_only("sky-haze", &one_for_both);
}
