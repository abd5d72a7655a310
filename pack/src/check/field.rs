//! The field of clouds: sprites in their boxes, apart from each other, and as many as a cloud should have.

use super::report::{Bound, Report};
use super::rule::{
    FIELD_BOXES, FIELD_COUNTS, FIELD_CULL, FIELD_EXPOSURE, FIELD_HOURS, FIELD_INDEX, FIELD_LIGHT,
    FIELD_RANGE, FIELD_RANK, FIELD_SIZE, FIELD_SPREAD,
};
use crate::field::{Cloud, Field, Hour, Sprite};
use crate::manifest::FieldEntry;

/// What reports call it.
pub(super) const SUBJECT: &str = "field";

/// The article: "we model each cloud as five to 400 sprites".
const SPRITES_A_CLOUD: std::ops::RangeInclusive<usize> = 5..=400;

/// The article: "the number of sprites per box can vary between 1 to 100".
const SPRITES_A_BOX: std::ops::RangeInclusive<usize> = 1..=100;

/// The article: "there are generally 20 to 200 boxes for each 16-square-kilometer section of clouds".
const BOXES_A_SECTION: Bound = Bound::Within(20.0, 200.0);

pub(super) fn check(report: &mut Report, field: &Field) {
    let file = FieldEntry::FILE;
    let ranges = report.verify(FIELD_RANGE, SUBJECT, field.verify_ranges(file));
    match ranges {
        Some(()) => report.at_most(FIELD_EXPOSURE, SUBJECT, off_the_exposure(field), 1.0),
        None => report.skip(FIELD_EXPOSURE, SUBJECT, "a number is out of its range"),
    }
    report.verify(FIELD_RANK, SUBJECT, field.verify_ranks(file));
    report.verify(FIELD_HOURS, SUBJECT, field.verify_hours(file));
    check_light(report, field);
    check_sizes(report, field);
    let indices = field.verify_indices(file);
    if report.verify(FIELD_INDEX, SUBJECT, indices).is_none() {
        for rule in [FIELD_BOXES, FIELD_CULL, FIELD_COUNTS] {
            report.skip(rule, SUBJECT, "an index is out of its list");
        }
        return;
    }
    let sum = |count: fn(&Cloud) -> usize| field.clouds.iter().map(count).sum::<usize>() as f64;
    let none = Bound::AtMost(0.0);
    report.measure(FIELD_BOXES, SUBJECT, sum(outside), none);
    report.measure(FIELD_CULL, SUBJECT, sum(too_near), none);
    check_counts(report, field);
}

/// A sprite may be larger than the box that its centre is in, but not than several of its clouds.
const MOST_RADII: f64 = 4.0;

fn check_sizes(report: &mut Report, field: &Field) {
    let largest = field.clouds.iter().map(|cloud| {
        let sides = cloud.sprites.iter().flat_map(|sprite| sprite.size_m);
        f64::from(sides.fold(0.0, f32::max)) / f64::from(cloud.radius_m())
    });
    let largest = largest.fold(0.0, f64::max);
    report.at_most(FIELD_SIZE, SUBJECT, largest, MOST_RADII);
    // Ranks are shares of ground, and few clouds cover none that is free.
    let ranks = field.clouds.iter().map(|cloud| cloud.rank);
    let [least, most] = [ranks.clone().fold(1.0, f32::min), ranks.fold(0.0, f32::max)];
    let is_many = field.clouds.len() >= MANY_CLOUDS;
    let bound = Bound::AtLeast(if is_many {
        f64::from(f32::EPSILON)
    } else {
        0.0
    });
    report.measure(FIELD_SPREAD, SUBJECT, f64::from(most - least), bound);
}

/// As many clouds do not all come at one cover.
const MANY_CLOUDS: usize = 20;

/// The least light of the brightest hour: what is darker is a night.
const LEAST_LIGHT: f64 = Hour::LEAST_LIGHT as f64;

fn check_light(report: &mut Report, field: &Field) {
    let light = field.hours.iter().map(Hour::light);
    let brightest = f64::from(light.fold(0.0, f32::max));
    report.at_least(FIELD_LIGHT, SUBJECT, brightest, LEAST_LIGHT);
}

fn check_counts(report: &mut Report, field: &Field) {
    let none = Bound::AtMost(0.0);
    let clouds = field.clouds.iter();
    let odd_clouds = clouds.filter(|cloud| !SPRITES_A_CLOUD.contains(&cloud.sprites.len()));
    report.measure(
        FIELD_COUNTS,
        "field.clouds",
        odd_clouds.count() as f64,
        none,
    );
    let odd_boxes = field.clouds.iter().map(|cloud| {
        let mut counts = vec![0; cloud.boxes.len()];
        for sprite in &cloud.sprites {
            counts[usize::from(sprite.cloud_box)] += 1;
        }
        let odd = counts.iter().filter(|count| !SPRITES_A_BOX.contains(count));
        odd.count()
    });
    report.measure(
        FIELD_COUNTS,
        "field.boxes",
        odd_boxes.sum::<usize>() as f64,
        none,
    );
    let a_section = field.box_count() as f64 / f64::from(field.sections * field.sections);
    report.measure(FIELD_COUNTS, "field.sections", a_section, BOXES_A_SECTION);
}

/// The largest difference of a sprite's exposure from what the field makes of it, in steps of a byte.
fn off_the_exposure(field: &Field) -> f64 {
    let mut exposed = field.clone();
    exposed.expose();
    let sprites = |field: &Field| {
        let all = field.clouds.iter().flat_map(|cloud| &cloud.sprites);
        all.map(|sprite| sprite.exposure.bytes())
            .collect::<Vec<_>>()
    };
    let (found, expected) = (sprites(field), sprites(&exposed));
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    f64::from(pairs.map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0))
}

/// Sprites of a cloud whose centre is outside their box.
fn outside(cloud: &Cloud) -> usize {
    let is_outside = |sprite: &&Sprite| {
        let of_cloud = &cloud.boxes[usize::from(sprite.cloud_box)];
        (0..3).any(|axis| {
            let distance = f64::from(sprite.centre_m[axis]) - f64::from(of_cloud.centre_m[axis]);
            distance.abs() > 0.5 * f64::from(of_cloud.size_m[axis])
        })
    };
    cloud.sprites.iter().filter(is_outside).count()
}

/// Pairs of sprites of a cloud that are nearer than the smaller cull distance of their boxes.
///
/// In the order of x, so that only those are looked at whose x is within the largest distance.
fn too_near(cloud: &Cloud) -> usize {
    let cull = |sprite: &Sprite| f64::from(cloud.boxes[usize::from(sprite.cloud_box)].cull_m);
    let largest = cloud.sprites.iter().map(cull).fold(0.0, f64::max);
    let mut sprites: Vec<&Sprite> = cloud.sprites.iter().collect();
    sprites.sort_by(|a, b| a.centre_m[0].total_cmp(&b.centre_m[0]));
    let apart = |a: &Sprite, b: &Sprite, axis: usize| {
        f64::from(b.centre_m[axis]) - f64::from(a.centre_m[axis])
    };
    let mut count = 0;
    for (index, a) in sprites.iter().enumerate() {
        let after = sprites[index + 1..].iter();
        let near = after.take_while(|b| apart(a, b, 0) < largest);
        count += near
            .filter(|b| {
                let least = cull(a).min(cull(b));
                let squares = (0..3).map(|axis| apart(a, b, axis) * apart(a, b, axis));
                squares.sum::<f64>() < least * least
            })
            .count();
    }
    count
}
