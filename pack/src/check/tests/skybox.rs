//! Faults of the skybox.

use super::{assert_only, check_pack, each_texel};
use crate::role::Role;
use crate::test_pack::{with, with_texture};

#[test]
fn a_skybox_out_of_range_is_an_error() {
    for (channel, value) in [(1, -0.1), (3, 1.01), (3, -0.01)] {
        let wrong = with(Role::Skybox, |image| image.texel_mut(3, 3)[channel] = value);
        assert_only("skybox-range", &wrong);
    }
    let infinite = with_texture(Role::Skybox, |t| {
        let bytes = half::f16::INFINITY.to_le_bytes();
        t.levels[1][..2].copy_from_slice(&bytes);
    });
    assert_only("finite", &infinite);
}

#[test]
fn a_skybox_with_a_face_mirrored_or_turned_is_warned_of() {
    for mirror in [true, false] {
        let pack = with(Role::Skybox, |image| {
            let (sound, last) = (image.clone(), image.width - 1);
            each_texel(image, |x, y, t| {
                let (x, y) = if mirror { (last - x, y) } else { (y, x) };
                t.copy_from_slice(sound.texel(x, y));
            });
        });
        let report = check_pack(&pack);
        let mut warned: Vec<_> = report.problems().map(|f| f.rule).collect();
        warned.dedup();
        assert!(report.is_sound());
        assert_eq!(warned, ["skybox-seam"]);
    }
}

#[test]
fn a_skybox_whose_sun_was_cut_is_warned_of() {
    for (value, told) in [(65_472.0, false), (65_504.0, true)] {
        let sun = with(Role::Skybox, |image| image.texel_mut(7, 7)[1] = value);
        let report = check_pack(&sun);
        let mut warned: Vec<_> = report.problems().map(|f| f.rule).collect();
        warned.dedup();
        assert!(report.is_sound(), "{value}: {warned:?}");
        if told {
            assert_eq!(warned, ["skybox-clip"]);
        } else {
            assert!(warned.is_empty(), "{value}: {warned:?}");
        }
    }
}

/// A texel in the dark whose averages are less than the least half float.
#[test]
fn a_nearly_black_face_is_no_error() {
    let dark = with(Role::Skybox, |image| {
        each_texel(image, |x, y, t| {
            t.fill(if (x, y) == (3, 9) { 3e-7 } else { 0.0 })
        });
    });
    let report = check_pack(&dark);
    assert!(
        report.is_sound(),
        "{:#?}",
        report.problems().collect::<Vec<_>>()
    );
}
