//! The day gradient.

use super::report::Report;
use super::rule::{SKY_COLOUR, SKY_DAY, SKY_HOURS, SKY_NIGHT, SKY_RANGE, SKY_STEP};
use crate::mapping::{night_share, sun_direction};
use crate::role::Role;
use crate::texture::Texture;
use crate::view::View;

const NAME: &str = Role::Sky.name();

/// How far the sun is below the horizon at most in civil twilight, when one reads without a lamp: a midnight in it is no
/// night, and only a good deal darker than noon.
const CIVIL_DEG: f32 = 6.0;

/// `noon_elevation_rad` is what the manifest says, if there is one.
pub(super) fn check(report: &mut Report, texture: &Texture, noon_elevation_rad: Option<f32>) {
    let image = texture.view(0, 0);
    let colours = image
        .texels()
        .flat_map(|[red, green, blue, _]| [red, green, blue]);
    let wrong = colours.filter(|v| !v.is_finite() || *v < 0.0).count();
    report.at_most(SKY_RANGE, NAME, wrong as f64, 0.0);
    if wrong > 0 {
        for rule in [SKY_NIGHT, SKY_HOURS, SKY_COLOUR, SKY_DAY, SKY_STEP] {
            report.skip(rule, NAME, "the radiance is not sound");
        }
        return;
    }
    check_night(report, image, noon_elevation_rad);
    check_hours(report, image, noon_elevation_rad);
    check_colour(report, image);
    let (noon, midnight) = (image.width / 2, 0);
    let mean = |x: u32| {
        (0..image.height)
            .map(|y| luminance(image, x, y))
            .sum::<f64>()
            / f64::from(image.height)
    };
    // A clear sky by day is some ten million times brighter than by night; adapted eyes see far less.
    let is_night = noon_elevation_rad.is_none_or(|noon| noon.to_degrees() > CIVIL_DEG);
    let least = if is_night { 8.0 } else { 2.0 };
    report.at_least(
        SKY_DAY,
        "noon / midnight",
        mean(noon) / mean(midnight).max(1e-6),
        least,
    );
    let zenith = luminance(image, noon, image.height - 1).max(1e-6);
    report.at_least(
        SKY_DAY,
        "horizon / zenith",
        luminance(image, noon, 0) / zenith,
        1.0,
    );
    check_steps(report, image);
}

/// How far the night share is outside of what the sun's elevation lets it be, at noon and at midnight, and of 0..1 at any time.
///
/// The sun goes round a great circle, so at midnight it stands as far below the horizon as above it at noon.
fn check_night(report: &mut Report, image: View, noon_elevation_rad: Option<f32>) {
    let Some(noon_elevation_rad) = noon_elevation_rad else {
        report.skip(SKY_NIGHT, NAME, "no manifest tells how high the sun stands");
        return;
    };
    let mut worst = 0.0_f64;
    for (x, elevation_rad) in [
        (image.width / 2, noon_elevation_rad),
        (0, -noon_elevation_rad),
    ] {
        let [least, most] = night_shares(elevation_rad.to_degrees());
        for y in 0..image.height {
            let share = f64::from(image.texel(x, y)[3]);
            worst = worst.max(least - share).max(share - most);
        }
    }
    for share in image.channel(3).map(f64::from) {
        worst = worst.max(-share).max(share - 1.0);
    }
    report.at_most(SKY_NIGHT, NAME, worst, 0.02);
}

/// The least and the greatest share of the night sky that shows with the sun at an elevation.
///
/// U.S. Naval Observatory, "Rise, Set, and Twilight Definitions": down to -6 degrees, in civil twilight, only the brightest
/// stars are seen; from -12 degrees, in astronomical twilight, most are; from -18 degrees the sun adds nothing.
fn night_shares(elevation_deg: f32) -> [f64; 2] {
    match elevation_deg {
        _ if elevation_deg >= 0.0 => [0.0, 0.0],
        _ if elevation_deg >= -CIVIL_DEG => [0.0, 0.5],
        _ if elevation_deg >= -12.0 => [0.0, 1.0],
        _ if elevation_deg > -18.0 => [0.5, 1.0],
        _ => [1.0, 1.0],
    }
}

/// The night share is a function of the sun's elevation, which time and noon give; the sun's way is symmetric about noon.
fn check_hours(report: &mut Report, image: View, noon_elevation_rad: Option<f32>) {
    let places = || (0..image.height).flat_map(|y| (0..image.width).map(move |x| (x, y)));
    let uneven = places().map(|(x, y)| {
        let evening = image.texel((image.width - x) % image.width, y);
        let pairs = image.texel(x, y).into_iter().zip(evening);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    });
    report.at_most(
        SKY_HOURS,
        &format!("{NAME} evening"),
        uneven.fold(0.0, f32::max),
        0.0,
    );
    let Some(noon) = noon_elevation_rad else {
        report.skip(SKY_HOURS, NAME, "no manifest tells how high the sun stands");
        return;
    };
    let off = places().map(|(x, y)| {
        let [_, sun_sin, _] = sun_direction(x as f32 / image.width as f32, noon);
        (image.texel(x, y)[3] - night_share(sun_sin)).abs()
    });
    // Half floats below 1 have steps of 1/2048 and less.
    report.at_most(SKY_HOURS, NAME, off.fold(0.0, f32::max), 1.0 / 2048.0);
}

/// Air scatters blue more than green and green more than red, and least of all that comes from above is reddened.
fn check_colour(report: &mut Report, image: View) {
    let zenith = image.texel(image.width / 2, image.height - 1);
    let steps = [zenith[1] - zenith[0], zenith[2] - zenith[1]];
    report.at_least(SKY_COLOUR, NAME, steps[0].min(steps[1]), 0.0);
}

/// The largest change of luminance from one time to the next, against the brightest of the whole day.
///
/// With 64 columns or more the sun climbs at most 5.6 degrees a column, and dusk takes it through 18.
fn check_steps(report: &mut Report, image: View) {
    let brightest = (0..image.width * image.height)
        .map(|i| luminance(image, i % image.width, i / image.width))
        .fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for y in 0..image.height {
        for x in 0..image.width {
            let next = luminance(image, (x + 1) % image.width, y);
            worst = worst.max((next - luminance(image, x, y)).abs());
        }
    }
    report.at_most(SKY_STEP, NAME, worst / brightest.max(1e-6), 0.34);
}

/// Luminance of linear BT.709 colour (ITU-R BT.709-6, item 3.2).
fn luminance(image: View, x: u32, y: u32) -> f64 {
    let t = image.texel(x, y);
    0.2126 * f64::from(t[0]) + 0.7152 * f64::from(t[1]) + 0.0722 * f64::from(t[2])
}
