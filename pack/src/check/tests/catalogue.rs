//! Faults of the catalogue of stars.

use super::{assert_errors, assert_only};
use crate::pack::Pack;
use crate::role::Role;
use crate::test_pack::with_texture;

/// Texels a layer of the test's catalogue.
const TEXELS: usize = 64;

/// Changes the texel of a star in a layer.
fn with_texel(layer: usize, star: usize, change: impl FnOnce(&mut [u8])) -> Pack {
    with_texture(Role::Catalogue, |t| {
        change(&mut t.levels[0][4 * (layer * TEXELS + star)..][..4]);
    })
}

#[test]
fn what_follows_the_stars_is_empty_and_a_gap_ends_them() {
    for layer in 0..3 {
        assert_only(
            "catalogue-record",
            &with_texel(layer, TEXELS - 1, |t| t[1] = 3),
        );
    }
    assert_only("catalogue-record", &with_texel(1, 3, |t| t[3] = 0));
    let none = with_texture(Role::Catalogue, |t| t.levels[0].fill(0));
    assert_only("catalogue-record", &none);
}

#[test]
fn a_star_brighter_than_the_one_before_it_is_an_error() {
    assert_only("catalogue-order", &with_texel(1, 7, |t| t[..2].fill(0)));
    // The first may be as bright as it likes.
    assert_errors(&[], &with_texel(1, 0, |t| t[..2].fill(0)));
}

#[test]
fn a_star_that_does_not_flicker_or_does_so_too_fast_is_an_error() {
    for (byte, value) in [(0, 0), (0, 253), (1, 0), (3, 1)] {
        assert_only("catalogue-flicker", &with_texel(2, 5, |t| t[byte] = value));
    }
}
