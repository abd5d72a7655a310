//! The clear sky and the sun: what anybody can see in them.

#![allow(
    clippy::disallowed_methods,
    reason = "no byte of a pack comes from here"
)]

use welkin_pack::air::{aureole_phase, unit_luminance_cd_m2};
use welkin_pack::mapping::{
    LOWEST_SUN_RAD, SKY_PARTS, SkyLayer, layer_to_sun, sky_to_texel, sun_to_layer, texel_to_sky,
};
use welkin_pack::{Image, Role};

use crate::common;

fn bake(text: &str, role: Role) -> Vec<Image> {
    let (_, all) = common::bake_for(&[role], text, None);
    common::images(&all, role).to_vec()
}

fn luminance(texel: [f32; 3]) -> f32 {
    0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2]
}

/// The table of a recipe.
struct Table {
    images: Vec<Image>,
    suns: u32,
}

impl Table {
    fn new(text: &str) -> Table {
        let images = bake(text, Role::Sky);
        let suns = images.len() as u32 / 4;
        Table { images, suns }
    }

    fn part(&self, sun: u32, part: u32) -> &Image {
        &self.images[SkyLayer { haze: 0, sun, part }.index(self.suns) as usize]
    }

    /// Radiance with all that a pack says of it, between texels and suns as a reader takes it. Angles in degrees.
    fn seen(&self, sun_deg: f32, elevation_deg: f32, azimuth_deg: f32) -> [f32; 3] {
        let [sun, view, azimuth] = [sun_deg, elevation_deg, azimuth_deg].map(f32::to_radians);
        let cosine = view.sin() * sun.sin() + view.cos() * sun.cos() * azimuth.cos();
        let phase = aureole_phase(cosine.clamp(-1.0, 1.0));
        let place = sun_to_layer(sun, self.suns);
        let below = (place as u32).min(self.suns - 2);
        let size = [self.images[0].width, self.images[0].height];
        let at = sky_to_texel(view.sin(), azimuth.cos(), size);
        let mut sum = [0.0; 3];
        for (layer, share) in [
            (below, below as f32 + 1.0 - place),
            (below + 1, place - below as f32),
        ] {
            for (part, weight) in [(0, share), (1, share * phase)] {
                let light = between(self.part(layer, part), at);
                sum.iter_mut()
                    .zip(light)
                    .for_each(|(s, l)| *s += weight * l);
            }
        }
        sum
    }
}

/// Bilinearly between texel centres.
fn between(image: &Image, [u, v]: [f32; 2]) -> [f32; 3] {
    let (x, y) = (
        (u as u32).min(image.width - 2),
        (v as u32).min(image.height - 2),
    );
    let (a, b) = (u - x as f32, v - y as f32);
    std::array::from_fn(|c| {
        let at = |x, y| image.texel(x, y)[c];
        let row = |y| at(x, y) + (at(x + 1, y) - at(x, y)) * a;
        row(y) + (row(y + 1) - row(y)) * b
    })
}

/// u' and v' of CIE 1976 of linear BT.709: u' grows towards red, v' falls towards blue. White is (0.198, 0.468).
fn chromaticity([r, g, b]: [f32; 3]) -> [f32; 2] {
    let x = 0.4124 * r + 0.3576 * g + 0.1805 * b;
    let y = luminance([r, g, b]);
    let z = 0.0193 * r + 0.1192 * g + 0.9505 * b;
    let sum = x + 15.0 * y + 3.0 * z;
    [4.0 * x / sum, 9.0 * y / sum]
}

/// Steps of 0.0011 in u'v' by which two colours differ: as many as the ellipses of MacAdam that they are apart (CIE TN 001:2014, "Chromaticity Difference
/// Specification for Light Sources").
const MACADAM: f32 = 0.0011;

/// What a light is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Hue {
    White,
    /// Of a dominant wavelength above 585 nm.
    Orange,
    /// 570 to 585 nm.
    Yellow,
    Green,
    Blue,
    Purple,
}

/// By the angle in u'v' about white, in degrees, from red towards yellow; 585 nm lie at 42 and 570 nm at 87 (CIE 1931 observer).
fn hue(rgb: [f32; 3]) -> Hue {
    let [u, v] = chromaticity(rgb);
    let [u, v] = [u - 0.1978, v - 0.4683];
    if u.hypot(v) < 5.0 * MACADAM {
        return Hue::White;
    }
    match v.atan2(u).to_degrees() {
        0.0..42.0 => Hue::Orange,
        42.0..87.0 => Hue::Yellow,
        // As much towards blue as away from it is cyan, which is counted to green.
        87.0..=180.0 => Hue::Green,
        -180.0..-90.0 => Hue::Blue,
        _ => Hue::Purple,
    }
}

#[test]
fn noon_is_blue_above_and_pale_below() {
    let table = Table::new("");
    for noon in [15.0, 30.0, 60.0] {
        let zenith = table.seen(noon, 90.0, 0.0);
        assert!(
            zenith[2] > 1.8 * zenith[1] && zenith[1] > 1.2 * zenith[0],
            "{noon}: {zenith:?}"
        );
        for azimuth in [90.0, 180.0] {
            let horizon = table.seen(noon, 2.0, azimuth);
            assert!(
                luminance(horizon) > 2.0 * luminance(zenith),
                "{noon}: {horizon:?} {zenith:?}"
            );
            let (blue_low, blue_high) = (horizon[2] / horizon[0], zenith[2] / zenith[0]);
            assert!(blue_low < 0.6 * blue_high, "{noon}: {horizon:?} {zenith:?}");
        }
    }
}

#[test]
fn sunset_is_warm_below_and_blue_above() {
    let table = Table::new("");
    for sun in [1.0, 0.0, -1.0] {
        for azimuth in [0.0, 30.0] {
            let low = table.seen(sun, 3.0, azimuth);
            assert!(low[0] > 1.5 * low[2], "{sun}: {low:?}");
        }
        let zenith = table.seen(sun, 90.0, 0.0);
        assert!(
            zenith[2] > 1.5 * zenith[0] && zenith[1] > zenith[0],
            "{sun}: {zenith:?}"
        );
        let opposite = table.seen(sun, 3.0, 180.0);
        assert!(luminance(table.seen(sun, 3.0, 0.0)) > 2.0 * luminance(opposite));
    }
    // The blue hour: the sun 6 degrees down, its light long through ozone.
    let zenith = table.seen(-6.0, 90.0, 0.0);
    assert!(
        zenith[2] > 2.0 * zenith[1] && zenith[1] > zenith[0],
        "{zenith:?}"
    );
}

/// Opposite a sun that has set: the earth's shadow, above it the belt of Venus, above that the blue of the sky (R. L. Lee, "Measuring and modeling
/// twilight's Belt of Venus", Applied Optics 54, 2015).
#[test]
fn the_earths_shadow_is_blue_below_a_pink_belt() {
    let table = Table::new("");
    for tenths in -50..=-20 {
        let sun = tenths as f32 / 10.0;
        let red = |elevation: f32| chromaticity(table.seen(sun, elevation, 180.0))[0];
        let elevations = (2..60).map(|i| i as f32 * 0.5);
        let belt = elevations
            .clone()
            .max_by(|a, b| red(*a).total_cmp(&red(*b)))
            .unwrap();
        let shadow = elevations
            .filter(|e| *e < belt)
            .min_by(|a, b| red(*a).total_cmp(&red(*b)))
            .unwrap();
        // While the sun is less than 3 degrees down nobody can miss it; then it fades.
        let steps = if sun >= -3.0 { 5.0 } else { 1.0 };
        for other in [shadow, 45.0] {
            let by = red(belt) - red(other);
            assert!(by > steps * MACADAM, "{sun}: {belt} to {other}: {by}");
        }
        let [dark, light] = [shadow, belt].map(|e| table.seen(sun, e, 180.0));
        assert!(
            luminance(light) > luminance(dark),
            "{sun}: {dark:?} {light:?}"
        );
        // Blue-grey: no hue but blue, and less of it than overhead.
        assert_eq!(hue(dark), Hue::Blue, "{sun}: {dark:?}");
        if sun >= -3.0 {
            // Pink: of the three it has least green.
            assert!(light[1] < light[0].min(light[2]), "{sun}: {light:?}");
        }
        // The shadow of an earth without air would end as high as the sun is deep; light passes some way above that.
        assert!(belt > -sun, "{sun}: {belt}");
    }
}

#[test]
fn the_twilight_goes_from_orange_over_yellow_to_blue() {
    let table = Table::new("");
    for tenths in -50..=-20 {
        let sun = tenths as f32 / 10.0;
        let mut hues: Vec<Hue> = (4..240)
            .map(|i| hue(table.seen(sun, i as f32 * 0.25, 0.0)))
            .filter(|hue| *hue != Hue::White)
            .collect();
        hues.dedup();
        assert_eq!(hues, [Hue::Orange, Hue::Yellow, Hue::Blue], "{sun}");
    }
}

#[test]
fn nothing_is_green_opposite_a_sunset() {
    let table = Table::new("");
    for tenths in -50..=0 {
        let sun = tenths as f32 / 10.0;
        for (elevation, azimuth) in
            (0..90).flat_map(|e| (100..=180).step_by(10).map(move |a| (e, a)))
        {
            let seen = table.seen(sun, elevation as f32, azimuth as f32);
            assert_ne!(
                hue(seen),
                Hue::Green,
                "{sun} {elevation} {azimuth}: {seen:?}"
            );
            // What counts as white may have a hundredth, the error of a table of half floats.
            let [red, green, blue] = seen;
            assert!(
                green < 1.01 * red.max(blue),
                "{sun} {elevation} {azimuth}: {seen:?}"
            );
        }
    }
}

#[test]
fn night_is_dark_and_blue() {
    let table = Table::new("");
    let lowest = LOWEST_SUN_RAD.to_degrees();
    for elevation in 0..=90 {
        for azimuth in [90.0, 180.0] {
            let seen = table.seen(lowest, elevation as f32, azimuth);
            assert!(
                seen[2] > seen[1] && seen[1] > seen[0] && seen[0] > 0.0,
                "{elevation}: {seen:?}"
            );
        }
        let sunward = table.seen(lowest, elevation as f32, 0.0);
        assert!(luminance(sunward) < 0.02, "{elevation}: {sunward:?}");
    }
    let [horizon, zenith] = [0.0, 90.0].map(|e| luminance(table.seen(lowest, e, 180.0)));
    assert!(horizon > zenith);
}

/// Mean luminance over the hemisphere, as it is stored.
fn mean(table: &Table, sun: f32) -> f32 {
    let mut sum = 0.0;
    for (i, azimuth) in (0..12).flat_map(|i| (0..12).map(move |a| (i, (a as f32 + 0.5) * 15.0))) {
        let elevation = ((i as f32 + 0.5) / 12.0).asin().to_degrees();
        sum += luminance(table.seen(sun, elevation, azimuth));
    }
    sum / 144.0
}

#[test]
fn it_grows_lighter_from_midnight_to_noon_without_steps() {
    let table = Table::new("");
    let stored: Vec<(f32, f32)> = (-72..=240)
        .map(|i| i as f32 * 0.25)
        .map(|sun| (sun, mean(&table, sun)))
        .collect();
    let light = |(sun, mean): (f32, f32)| mean * unit_luminance_cd_m2(sun.to_radians());
    let most = stored.iter().map(|s| s.1).fold(0.0, f32::max);
    for pair in stored.windows(2) {
        // In cd/m2 a higher sun never darkens the sky that it lights; a hundredth is for the cubics of the unit, which meet within some.
        assert!(light(pair[1]) > 0.99 * light(pair[0]), "{pair:?}");
        // A quarter of a degree is a minute: dawn takes more than twenty of them.
        assert!((pair[1].1 - pair[0].1).abs() < 0.05 * most, "{pair:?}");
    }
}

/// The largest bend of luminance along rows and columns, over the layer's brightest.
fn bend(table: &Table) -> f32 {
    let mut worst = 0.0_f32;
    for image in &table.images {
        let at = |x: u32, y: u32| {
            let t = image.texel(x, y);
            luminance([t[0], t[1], t[2]])
        };
        let places = (0..image.height).flat_map(|y| (0..image.width).map(move |x| (x, y)));
        let brightest = places.clone().map(|(x, y)| at(x, y)).fold(0.05, f32::max);
        let mut bend =
            |a: f32, b: f32, c: f32| worst = worst.max((a - 2.0 * b + c).abs() / brightest);
        for (x, y) in places {
            if (1..image.width - 1).contains(&x) {
                bend(at(x - 1, y), at(x, y), at(x + 1, y));
            }
            if (1..image.height - 1).contains(&y) {
                bend(at(x, y - 1), at(x, y), at(x, y + 1));
            }
        }
    }
    worst
}

/// What is smooth bends a quarter as much between texels half as far apart; what has an edge bends as much as before.
#[test]
fn a_finer_table_is_smoother() {
    let [coarse, fine] = ["width = 16\nheight = 32", "width = 32\nheight = 64"]
        .map(|size| bend(&Table::new(&format!("[sky]\nsuns = 16\n{size}\n"))));
    assert!(fine < 0.5 * coarse, "{fine} of {coarse}");
}

#[test]
fn the_zenith_is_one_direction_and_texels_are_where_they_say() {
    let table = Table::new("");
    for image in &table.images {
        let last = image.height - 1;
        let first = image.texel(0, last);
        for x in 1..image.width {
            let pairs = first.iter().zip(image.texel(x, last));
            // Rounding of 32-bit sums.
            assert!(pairs.clone().all(|(a, b)| (a - b).abs() <= 1e-4 * a), "{x}");
        }
    }
    let (sun, size) = (20, [16, 32]);
    let sun_deg = layer_to_sun(sun as f32, table.suns).to_degrees();
    let (sine, azimuth_cos) = texel_to_sky([5.0, 9.0], size);
    let seen = table.seen(
        sun_deg,
        sine.asin().to_degrees(),
        azimuth_cos.acos().to_degrees(),
    );
    let sun_rad = sun_deg.to_radians();
    let cosine = sine * sun_rad.sin() + (1.0 - sine * sine).sqrt() * sun_rad.cos() * azimuth_cos;
    let [rest, aureole] = [0, 1].map(|part| table.part(sun, part).texel(5, 9)[1]);
    let expected = rest + aureole * aureole_phase(cosine);
    assert!(
        (seen[1] / expected - 1.0).abs() < 1e-3,
        "{} {expected}",
        seen[1]
    );
    assert_eq!(table.images.len() as u32, 2 * table.suns * SKY_PARTS);
}

#[test]
fn haze_pales_the_sky_and_widens_the_glow() {
    let [none, some, much] = [0, 1, 6].map(|h| Table::new(&format!("[sky]\nhaze = {h}\n")));
    for sun in [15.0, 30.0, 60.0] {
        let blue = |table: &Table| {
            let [red, _, blue] = table.seen(sun, 60.0, 180.0);
            blue / red
        };
        let glow = |table: &Table| {
            luminance(table.seen(sun, sun + 10.0, 0.0)) / luminance(table.seen(sun, 60.0, 180.0))
        };
        assert!(
            blue(&none) > blue(&some) && blue(&some) > blue(&much),
            "{sun}"
        );
        assert!(
            glow(&none) < glow(&some) && glow(&some) < glow(&much),
            "{sun}"
        );
    }
}

#[test]
fn the_sun_is_a_soft_disc_in_a_glow() {
    for size in [64, 128] {
        let sun = &bake(&format!("[sun]\nsize = {size}\n"), Role::Sun)[0];
        let middle = size / 2;
        let right: Vec<&[f32]> = (middle..size).map(|x| sun.texel(x, middle)).collect();
        for pair in right.windows(2) {
            assert!(
                pair[1][0] <= pair[0][0] && pair[1][1] <= pair[0][1],
                "{pair:?}"
            );
        }
        // The middle lies half a texel off the centre.
        assert!(right[0][0] > 0.99 && right[0][1] > 0.97, "{:?}", right[0]);
        let edge = &right[right.len() / 2 - 3];
        assert!(edge[0] > 0.4 && edge[0] < 0.75, "darkened limb: {edge:?}");
        assert_eq!(
            right[right.len() / 2 + 2][0],
            0.0,
            "nothing beyond the limb"
        );
        let last = right[right.len() - 1];
        assert!(last[1] < 1.0 / 255.0, "{last:?}");
        for x in 0..size {
            for y in 0..size {
                assert_eq!(sun.texel(x, y), sun.texel(y, x));
                assert_eq!(sun.texel(x, y), sun.texel(size - 1 - x, y));
            }
        }
        assert_eq!(sun.texel(0, 0), &[0.0, 0.0]);
    }
}
