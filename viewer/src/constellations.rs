//! Lines between the stars of ten constellations, over a picture of a date.

use glam::Vec2;
use welkin_runtime::almanac::refraction::lifted;
use welkin_runtime::almanac::{Date, Place, frames, stars};
use welkin_runtime::glam;
use welkin_runtime::internals::geometry::camera::{self, Camera};

use crate::frame::{Frame, Pixels};

/// Names, and lines from star to star, with a comma where one ends.
const CONSTELLATIONS: [(&str, &str); 10] = [
    (
        "Ursa Major",
        "Alkaid - Mizar - Alioth - Megrez - Phecda - Merak - Dubhe - Megrez",
    ),
    (
        "Orion",
        "Meissa - Betelgeuse - Alnitak - Saiph - Rigel - Mintaka - Bellatrix - Meissa, Alnitak - Alnilam - Mintaka",
    ),
    ("Crux", "Acrux - Gacrux, Mimosa - Imai"),
    ("Cassiopeia", "Caph - Schedar - gamma Cas - Ruchbah - Segin"),
    ("Cygnus", "Deneb - Sadr - Albireo, Aljanah - Sadr - Fawaris"),
    (
        "Lyra",
        "Vega - zeta Lyr - Sheliak - Sulafat - delta Lyr - zeta Lyr",
    ),
    (
        "Scorpius",
        "Acrab - Dschubba - pi Sco, Dschubba - Antares - tau Sco - Larawag - mu Sco - zeta Sco - eta Sco - Sargas - iota Sco - kappa Sco - Shaula",
    ),
    (
        "Leo",
        "Algenubi - Rasalas - Adhafera - Algieba - eta Leo - Regulus - Chertan - Denebola - Zosma - Algieba, Zosma - Chertan",
    ),
    (
        "Gemini",
        "Propus - Tejat - Mebsuta - Castor - Pollux - Wasat - Mekbuda - Alhena",
    ),
    (
        "Taurus",
        "Tianguan - Aldebaran - gamma Tau - delta Tau - Ain - Elnath, gamma Tau - lambda Tau",
    ),
];

/// Right ascension and declination of J2000, in degrees.
const STARS: [(&str, [f64; 2]); 71] = [
    ("Alkaid", [206.885, 49.313]),
    ("Mizar", [200.981, 54.925]),
    ("Alioth", [193.507, 55.960]),
    ("Megrez", [183.857, 57.033]),
    ("Phecda", [178.458, 53.695]),
    ("Merak", [165.460, 56.383]),
    ("Dubhe", [165.932, 61.751]),
    ("Meissa", [83.784, 9.934]),
    ("Betelgeuse", [88.793, 7.407]),
    ("Alnitak", [85.190, -1.943]),
    ("Alnilam", [84.053, -1.202]),
    ("Mintaka", [83.002, -0.299]),
    ("Saiph", [86.939, -9.670]),
    ("Rigel", [78.634, -8.202]),
    ("Bellatrix", [81.283, 6.350]),
    ("Acrux", [186.650, -63.099]),
    ("Gacrux", [187.791, -57.113]),
    ("Mimosa", [191.930, -59.689]),
    ("Imai", [183.786, -58.749]),
    ("Caph", [2.294, 59.150]),
    ("Schedar", [10.127, 56.537]),
    ("gamma Cas", [14.177, 60.717]),
    ("Ruchbah", [21.454, 60.235]),
    ("Segin", [28.599, 63.670]),
    ("Deneb", [310.358, 45.280]),
    ("Sadr", [305.557, 40.257]),
    ("Albireo", [292.680, 27.960]),
    ("Aljanah", [311.553, 33.970]),
    ("Fawaris", [296.244, 45.131]),
    ("Vega", [279.235, 38.784]),
    ("zeta Lyr", [281.193, 37.605]),
    ("Sheliak", [282.520, 33.363]),
    ("Sulafat", [284.736, 32.690]),
    ("delta Lyr", [283.626, 36.899]),
    ("Acrab", [241.359, -19.806]),
    ("Dschubba", [240.083, -22.622]),
    ("pi Sco", [239.713, -26.114]),
    ("Antares", [247.352, -26.432]),
    ("tau Sco", [248.971, -28.216]),
    ("Larawag", [252.541, -34.293]),
    ("mu Sco", [252.968, -38.047]),
    ("zeta Sco", [253.646, -42.361]),
    ("eta Sco", [258.038, -43.239]),
    ("Sargas", [264.330, -42.998]),
    ("iota Sco", [266.896, -40.127]),
    ("kappa Sco", [265.622, -39.030]),
    ("Shaula", [263.402, -37.104]),
    ("Algenubi", [146.463, 23.774]),
    ("Rasalas", [148.191, 26.007]),
    ("Adhafera", [154.173, 23.417]),
    ("Algieba", [154.993, 19.842]),
    ("eta Leo", [151.833, 16.763]),
    ("Regulus", [152.093, 11.967]),
    ("Chertan", [168.560, 15.430]),
    ("Denebola", [177.265, 14.572]),
    ("Zosma", [168.527, 20.524]),
    ("Propus", [93.719, 22.507]),
    ("Tejat", [95.740, 22.514]),
    ("Mebsuta", [100.983, 25.131]),
    ("Castor", [113.650, 31.888]),
    ("Pollux", [116.329, 28.026]),
    ("Wasat", [110.031, 21.982]),
    ("Mekbuda", [106.027, 20.570]),
    ("Alhena", [99.428, 16.399]),
    ("Tianguan", [84.411, 21.143]),
    ("Aldebaran", [68.980, 16.509]),
    ("gamma Tau", [64.948, 15.628]),
    ("delta Tau", [65.734, 17.543]),
    ("Ain", [67.154, 19.180]),
    ("Elnath", [81.573, 28.608]),
    ("lambda Tau", [60.170, 12.490]),
];

/// Colour of the lines, as sRGB bytes, and how much of it there is.
const COLOUR: [f32; 3] = [96.0, 140.0, 190.0];
const OPACITY: f32 = 0.55;
/// Half the width of a line, and how far from a star it ends, in pixels of a picture of 540 lines.
const HALF_WIDTH_PX: f32 = 0.6;
const GAP_PX: f32 = 7.0;

/// Draws the lines of all that are above the horizon over a picture of 8 bits; others it leaves as they are.
pub fn draw(frame: &mut Frame, camera: &Camera, date: Date, place: Place) {
    let (width, height) = (frame.width, frame.height);
    let Pixels::Srgb8(pixels) = &mut frame.pixels else {
        return;
    };
    let view = camera::uniforms(camera);
    let turn = stars::turn(date, place);
    let scale = (height as f32 / 540.0).max(1.0);
    for [from, to] in pairs() {
        let [from, to] = [from, to].map(|place| {
            let [ra, dec] = place.map(f64::to_radians);
            view.pixel_of(lifted(turn * frames::of_angles(ra, dec)).as_vec3())
        });
        let (Some(from), Some(to)) = (from, to) else {
            continue;
        };
        let along = (to - from).normalize_or_zero() * GAP_PX * scale;
        if (to - from).length() > 3.0 * GAP_PX * scale {
            let ends = [from + along, to - along];
            line(pixels, [width, height], ends, HALF_WIDTH_PX * scale);
        }
    }
}

/// The places of the two stars of every line.
fn pairs() -> impl Iterator<Item = [[f64; 2]; 2]> {
    let lines = CONSTELLATIONS
        .iter()
        .flat_map(|(_, lines)| lines.split(", "));
    lines.flat_map(|line| {
        let stars: Vec<[f64; 2]> = line.split(" - ").filter_map(star).collect();
        let pairs = stars.windows(2).map(|pair| [pair[0], pair[1]]);
        pairs.collect::<Vec<_>>()
    })
}

/// The place of a star.
fn star(name: &str) -> Option<[f64; 2]> {
    let found = STARS.iter().find(|(other, _)| *other == name);
    found.map(|(_, place)| *place)
}

/// Draws a line with soft edges.
fn line(pixels: &mut [[u8; 4]], size: [u32; 2], [from, to]: [Vec2; 2], half_width: f32) {
    let limit = Vec2::new(size[0] as f32, size[1] as f32) - 1.0;
    let reach = Vec2::splat(half_width + 1.0);
    let low = (from.min(to) - reach).max(Vec2::ZERO);
    let high = (from.max(to) + reach).min(limit);
    let along = to - from;
    for y in low.y as u32..=(high.y.max(-1.0) + 1.0) as u32 {
        for x in low.x as u32..=(high.x.max(-1.0) + 1.0) as u32 {
            let centre = Vec2::new(x as f32, y as f32) + 0.5;
            let share = ((centre - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            let away = centre.distance(from + along * share);
            let opacity = OPACITY * (half_width + 0.5 - away).clamp(0.0, 1.0);
            let at = y as usize * size[0] as usize + x as usize;
            let is_inside = x < size[0] && opacity > 0.0;
            if let Some(pixel) = pixels.get_mut(at).filter(|_| is_inside) {
                for (byte, colour) in pixel.iter_mut().zip(COLOUR) {
                    let old = f32::from(*byte);
                    *byte = (old + (colour - old) * opacity + 0.5) as u8;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The stars of the catalogue: place and magnitude.
    fn catalogue() -> Vec<([f64; 2], f64)> {
        let file = welkin_baker::built_in_catalogue().unwrap();
        let stars = welkin_baker::catalogue::read("stars.6.json", file).unwrap();
        let place = |star: &welkin_baker::catalogue::Star| {
            (
                [star.right_ascension_deg, star.declination_deg],
                star.magnitude,
            )
        };
        stars.iter().map(place).collect()
    }

    fn apart_deg(a: [f64; 2], b: [f64; 2]) -> f64 {
        let [a, b] = [a, b].map(|place| {
            let [ra, dec] = place.map(f64::to_radians);
            frames::of_angles(ra, dec)
        });
        a.cross(b).length().atan2(a.dot(b)).to_degrees()
    }

    #[test]
    fn every_star_of_a_line_is_a_bright_one_of_the_catalogue() {
        let catalogue = catalogue();
        for (name, place) in STARS {
            let near = catalogue
                .iter()
                .filter(|(own, _)| apart_deg(*own, place) < 0.05);
            let brightest = near.map(|(_, magnitude)| *magnitude).fold(9.0, f64::min);
            assert!(brightest < 4.6, "{name}: {brightest}");
        }
    }

    #[test]
    fn every_name_of_a_line_has_a_place_and_no_line_is_long() {
        for (name, lines) in CONSTELLATIONS {
            for star_name in lines.split(", ").flat_map(|line| line.split(" - ")) {
                assert!(star(star_name).is_some(), "{name}: {star_name}");
            }
        }
        for [from, to] in pairs() {
            let apart = apart_deg(from, to);
            assert!((0.5..20.0).contains(&apart), "{from:?} {to:?}: {apart}");
        }
        assert!(
            STARS
                .iter()
                .all(|(name, _)| CONSTELLATIONS.iter().any(|(_, l)| l.contains(name)))
        );
    }

    #[test]
    fn a_line_is_drawn_from_end_to_end_and_nowhere_else() {
        let mut pixels = vec![[0; 4]; 40 * 30];
        let ends = [Vec2::new(5.0, 5.5), Vec2::new(60.0, 5.5)];
        line(&mut pixels, [40, 30], ends, 0.6);
        let lit = |x: usize, y: usize| pixels[y * 40 + x][2] > 20;
        assert!((5..40).all(|x| lit(x, 5)) && !lit(2, 5));
        assert!((0..40).all(|x| !lit(x, 8) && !lit(x, 2)));
        for ends in [[-50.0, -9.0], [90.0, 200.0]] {
            let mut dark = vec![[0; 4]; 40 * 30];
            line(
                &mut dark,
                [40, 30],
                [Vec2::from(ends), Vec2::from(ends) + 3.0],
                0.6,
            );
            assert!(dark.iter().all(|pixel| *pixel == [0; 4]), "{ends:?}");
        }
    }
}
