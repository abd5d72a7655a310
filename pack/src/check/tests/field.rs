//! Faults of the field of clouds.

use super::*;
use crate::field::{Exposure, Field, bounds};
use crate::test_field::field;

/// A pack whose field was changed, with true hashes.
fn with_field(change: impl FnOnce(&mut Field)) -> Pack {
    with_lit(|field| {
        change(field);
        field.expose();
    })
}

/// The same, with light that need not be that of its clouds.
fn with_lit(change: impl FnOnce(&mut Field)) -> Pack {
    let mut field = field();
    change(&mut field);
    for cloud in &mut field.clouds {
        (cloud.centre_m, cloud.size_m) = bounds(&cloud.boxes);
    }
    pack().with_any_field(field).unwrap()
}

#[test]
fn a_pack_without_a_field_is_sound() {
    let report = check_with_manifest(true, |m| m.field = None);
    assert!(report.is_sound());
    assert!(!report.findings.iter().any(|f| f.rule.starts_with("field")));
}

#[test]
fn a_field_that_is_not_the_manifests_is_told() {
    let report = check_with_manifest(true, |m| m.field.as_mut().unwrap().sprites += 1);
    assert_eq!(errors(&report), ["field-file"]);
    let report = check_with_manifest(true, |m| m.field.as_mut().unwrap().sprites = 70_000);
    assert_eq!(errors(&report), ["manifest"]);
    let report = check_with_manifest(true, |m| m.field.as_mut().unwrap().file_bytes += 1);
    assert_eq!(errors(&report), ["file-hash"]);
}

#[test]
fn indices_out_of_their_lists_are_told() {
    let cell = with_field(|f| f.clouds[3].sprites[2].cell = 16);
    assert_only("field-index", &cell);
    // The file has the group of the box twice, so the reader sees this one.
    let group = with_field(|f| f.clouds[3].boxes[1].group = 2);
    assert_only("field-index", &group);
    let of_box = with_field(|f| f.clouds[3].sprites[2].cloud_box = 2);
    assert_only("field-index", &of_box);
}

#[test]
fn numbers_out_of_range_are_told() {
    let upside_down = with_field(|f| f.clouds[0].levels.reverse());
    assert_only("field-range", &upside_down);
    let dark = with_field(|f| f.clouds[7].levels[2].rgba[1] = -0.1);
    assert_only("field-range", &dark);
    let thin = with_field(|f| f.clouds[7].sprites[1].size_m[1] = 0.0);
    assert_only("field-range", &thin);
}

#[test]
fn ranks_and_hours_out_of_order_are_told() {
    assert_only("field-rank", &with_field(|f| f.clouds.swap(2, 3)));
    assert_only("field-rank", &with_field(|f| f.clouds[19].rank = 1.01));
    assert_only("field-hours", &with_field(|f| f.hours.swap(1, 2)));
    assert_only("field-hours", &with_field(|f| f.hours[2].least = 1.5));
    let dark = with_field(|f| f.hours.clear());
    assert_errors(&["field-hours", "field-light"], &dark);
}

#[test]
fn a_sprite_beside_its_box_is_told() {
    // The box is 600 m long and its middle sprite in the middle; 0.1 m beyond its side of 100 m.
    let beside = with_field(|f| f.clouds[5].sprites[2].centre_m[2] += 50.1);
    assert_only("field-boxes", &beside);
    let within = with_field(|f| f.clouds[5].sprites[2].centre_m[2] += 50.0);
    assert!(check_pack(&within).is_sound());
}

#[test]
fn sprites_nearer_than_the_cull_distance_are_told() {
    // 100 m from sprite to sprite; 90 m is the cull distance.
    let near = with_field(|f| f.clouds[5].sprites[2].centre_m[0] += 10.5);
    assert_only("field-cull", &near);
    let apart = with_field(|f| f.clouds[5].sprites[2].centre_m[0] += 10.0);
    assert!(check_pack(&apart).is_sound());
    // Of two boxes the smaller distance counts: 200 m from box to box.
    let boxes = with_field(|f| f.clouds[5].boxes[0].cull_m = 80.0);
    assert!(check_pack(&boxes).is_sound());
}

#[test]
fn unusual_counts_are_warnings() {
    let report = check_pack(&with_field(|f| f.clouds[4].sprites.truncate(4)));
    assert!(report.is_sound());
    let warned: Vec<_> = report
        .problems()
        .map(|f| (f.rule, f.subject.as_str()))
        .collect();
    // Its second box is empty then.
    assert_eq!(
        warned,
        [
            ("field-counts", "field.clouds"),
            ("field-counts", "field.boxes")
        ]
    );
    let report = check_pack(&with_field(|f| f.sections = 2));
    let warned: Vec<_> = report.problems().map(|f| f.rule).collect();
    assert_eq!(warned, ["field-counts"]);
}

#[test]
fn clouds_that_come_all_at_once_are_told() {
    let alike = with_field(|f| f.clouds.iter_mut().for_each(|cloud| cloud.rank = 0.5));
    assert_only("field-spread", &alike);
}

#[test]
fn sprites_far_larger_than_their_cloud_are_told() {
    let vast = with_field(|f| f.clouds[3].sprites[1].size_m = [10_000.0; 2]);
    assert_only("field-size", &vast);
}

#[test]
fn clouds_without_light_are_told() {
    let dark = with_field(|f| {
        for hour in &mut f.hours {
            (hour.ambient, hour.colour) = (0.0, [0.0; 3]);
        }
    });
    assert_only("field-light", &dark);
}

#[test]
fn light_that_is_not_what_the_clouds_leave_is_an_error() {
    for change in [
        |own: &mut Exposure| own.above = own.above.wrapping_add(40),
        |own: &mut Exposure| own.sky = own.sky.wrapping_add(40),
        |own: &mut Exposure| own.sides[2] = own.sides[2].wrapping_add(40),
        |own: &mut Exposure| own.halvings = own.halvings.wrapping_add(40),
    ] {
        let forged = with_lit(|f| change(&mut f.clouds[3].sprites[2].exposure));
        assert_only("field-exposure", &forged);
    }
}
