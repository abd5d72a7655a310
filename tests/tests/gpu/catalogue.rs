//! Stars of a catalogue as they are drawn: where, how bright, and behind clouds.

use glam::{DVec3, Vec2, Vec3};
use welkin_pack::Pack;
use welkin_runtime::almanac::refraction::lifted;
use welkin_runtime::almanac::{self, Place};
use welkin_runtime::internals::clear_sky::eye;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, Sky, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{camera, catalogue, compare, gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Names, J2000 places, and where astropy has them at dates and places, in degrees.
const STARS: &str = include_str!("../../../runtime/tests/data/almanac-stars.csv");

fn night(date: &str, latitude_deg: f32, longitude_deg: f32) -> SkyParams {
    SkyParams {
        date: Some(date.parse().expect("a date")),
        place: Place {
            latitude_deg,
            longitude_deg,
        },
        cover: 0.0,
        sun: false,
        moon: 0.0,
        ..SkyParams::default()
    }
}

/// A picture of a pack less that of one without any star, so that no planet and no airglow is left.
fn starlight(skies: &mut [Sky; 2], params: &SkyParams, view: &Camera) -> Vec<Vec3> {
    let [with, without] = skies;
    let [with, without] = [with, without].map(|sky| {
        let texels = gpu::render(sky, FORMAT, params, view, 0.0);
        gpu::rgb(&texels)
    });
    with.into_iter().zip(without).map(|(a, b)| a - b).collect()
}

/// The sky of a pack, and that of a catalogue without stars.
fn skies(pack: &Pack) -> [Sky; 2] {
    [pack, &pack::catalogue_alone(|_| false)].map(|pack| gpu::sky(pack, FORMAT))
}

fn luminance(colour: Vec3) -> f64 {
    f64::from(colour.dot(Vec3::new(0.2126, 0.7152, 0.0722)))
}

fn centre(index: usize, size: [u32; 2]) -> Vec2 {
    let [x, y] = [index as u32 % size[0], index as u32 / size[0]];
    Vec2::new(x as f32, y as f32) + 0.5
}

/// Azimuth and elevation, in radians, of a unit vector of the world.
fn angles(direction: DVec3) -> [f64; 2] {
    let azimuth = direction.x.atan2(-direction.z);
    [azimuth, direction.y.atan2(direction.x.hypot(direction.z))]
}

/// A unit vector of the world.
fn of_angles([azimuth, elevation]: [f64; 2]) -> DVec3 {
    let flat = elevation.cos();
    DVec3::new(flat * azimuth.sin(), elevation.sin(), -flat * azimuth.cos())
}

/// How far from a direction the brightest star near it is drawn, in degrees.
fn off_deg(skies: &mut [Sky; 2], facts: &PackData, params: &SkyParams, wanted: DVec3) -> f64 {
    // A pixel as a screen of 2160 lines at 60 degrees has: 0.03 degrees. No star half as bright is within the 1.7 degrees to either side.
    let (size, fov_rad) = ([120, 120], 0.062);
    let [azimuth, elevation] = angles(wanted).map(|angle| angle as f32);
    let view = Camera::looking(azimuth, elevation, fov_rad, size);
    let light = starlight(skies, params, &view);
    let brightest = (0..light.len()).max_by(|a, b| light[*a].y.total_cmp(&light[*b].y));
    let mut middle = centre(brightest.expect("there are pixels"), size);
    for _ in 0..4 {
        let near = light.iter().enumerate();
        let near = near.filter(|(i, _)| centre(*i, size).distance(middle) < 5.0);
        let (sum, total) = near.fold((Vec2::ZERO, 0.0), |(sum, total), (i, light)| {
            (sum + centre(i, size) * light.y, total + light.y)
        });
        middle = sum / total;
    }
    let camera = facts.uniforms(params, &view, 0.0, 0.0).camera;
    let found = camera::ray_of(&camera, middle).as_dvec3().normalize();
    found
        .cross(wanted)
        .length()
        .atan2(found.dot(wanted))
        .to_degrees()
}

#[test]
fn named_stars_are_drawn_where_astropy_has_them() {
    let pack = pack::catalogue_alone(|_| true);
    let facts = PackData::new(&pack).expect("the pack has every role");
    let mut skies = skies(&pack);
    let is_night = |params: &SkyParams| facts.lit_sky(params, 0.0).light.night == 1.0;
    // What is promised, in degrees.
    let mut drawn = |name: &str, params: &SkyParams, wanted: DVec3| {
        let off = off_deg(&mut skies, &facts, params, wanted);
        println!("{name} at {:?}: {off:.4} degrees off", params.date);
        assert!(off < 0.1, "{name}: {off}");
    };
    let mut names = std::collections::BTreeMap::new();
    let rows = STARS.lines().filter(|line| !line.starts_with('#')).skip(1);
    for row in rows.map(|row| row.split(',').collect::<Vec<_>>()) {
        let number = |i: usize| row[i].parse::<f64>().expect("a number");
        names.insert(row[3], [4, 5].map(|i| number(i).to_radians()));
        let params = night(row[0], number(1) as f32, number(2) as f32);
        // Astropy's refraction is not made for the last degrees above the horizon.
        if number(7) > 5.0 && is_night(&params) {
            let wanted = of_angles([6, 8].map(|i| number(i).to_radians()));
            drawn(row[3], &params, wanted);
        }
    }
    // Where it was day in astropy's table, by the almanac, which is held to that.
    let nights = [
        ("2026-01-15T22:00:00Z", 40.0),
        ("2026-07-15T22:00:00Z", 40.0),
        ("2026-01-15T22:00:00Z", -34.0),
        ("2026-05-15T21:00:00Z", -34.0),
        ("2026-10-15T22:00:00Z", -34.0),
    ];
    let mut count = 0;
    for (name, [ra, dec]) in names {
        for (date, latitude_deg) in nights {
            let params = night(date, latitude_deg, 0.0);
            let date = params.date.expect("it has a date");
            let turn = almanac::stars::turn(date, params.place);
            let wanted = lifted(turn * almanac::frames::of_angles(ra, dec));
            if wanted.y > 0.1 && is_night(&params) {
                drawn(name, &params, wanted);
                count += 1;
                break;
            }
        }
    }
    println!("{count} stars");
    assert!(count >= 10);
}

#[test]
fn the_light_of_each_class_of_magnitude_is_the_catalogue_s() {
    let params = SkyParams {
        even_stars: true,
        ..night("2026-01-18T23:00:00Z", 20.0, 0.0)
    };
    let size = [768, 768];
    let quarter = std::f32::consts::FRAC_PI_2;
    let faces = [0.0, 1.0, 2.0, 3.0].map(|side| (side * quarter, 0.0));
    let own = welkin_baker::catalogue::read("own", pack::CATALOGUE).expect("a catalogue");
    for class in -2..6 {
        let within = |magnitude: f64| magnitude.floor() as i32 == class;
        let pack = pack::catalogue_alone(within);
        let facts = PackData::new(&pack).expect("the pack has every role");
        let mut skies = skies(&pack);
        let (mut found, mut one_sr) = (0.0, 0.0);
        let all = faces.into_iter().chain([(0.0, quarter)]);
        for (azimuth, elevation) in all {
            let view = Camera::looking(azimuth, elevation, quarter, size);
            let uniforms = facts.uniforms(&params, &view, 0.0, 0.0);
            let lit = facts.lit_sky(&params, 0.0);
            let night = facts.night_sky(&lit, &params, &view, 0.0).expect("night");
            let middle_sr = 4.0 / f64::from(size[0] * size[1]);
            one_sr = f64::from(night.one) * middle_sr;
            let light = starlight(&mut skies, &params, &view);
            for (index, light) in light.iter().enumerate() {
                let ray = camera::ray_of(&uniforms.camera, centre(index, size));
                found += luminance(*light) * middle_sr / f64::from(ray.length()).powi(3);
            }
        }
        // From the catalogue's own file, through the air.
        let view = Camera::looking(0.0, 0.0, quarter, size);
        let lit = facts.lit_sky(&params, 0.0);
        let night = facts.night_sky(&lit, &params, &view, 0.0).expect("night");
        let mut wanted = 0.0;
        for star in own.iter().filter(|star| within(star.magnitude)) {
            let record = welkin_pack::CatalogueStar {
                right_ascension_deg: star.right_ascension_deg,
                declination_deg: star.declination_deg,
                ..Default::default()
            };
            let sine = catalogue::seen(&record, &night).y as f32;
            if sine <= 0.0 {
                continue;
            }
            let dimmed = f64::from(night.air.magnitudes(sine));
            let share = eye::share(night.faintest, (star.magnitude + dimmed) as f32);
            wanted += 10.0_f64.powf(-0.4 * (star.magnitude + dimmed)) * f64::from(share);
        }
        let ratio = found / one_sr / wanted;
        println!("magnitude {class} to {}: {ratio:.4}", class + 1);
        assert!((ratio - 1.0).abs() < 0.03, "{class}: {ratio}");
    }
}

/// A picture and its twin's differ by no more than 2 %, as of the sky without a catalogue, and 1e-3 of a star's own light, since a star that is
/// a hundredth of a pixel away gives another pixel so much of its light.
#[test]
fn the_twin_draws_the_same_stars() {
    let pack = pack::catalogued();
    let mut sky = gpu::sky(pack, FORMAT);
    let twin = Twin::new(pack);
    let size = [96, 72];
    let dated = SkyParams {
        cover: 0.35,
        ..night("2026-01-15T21:00:00Z", 51.5, 0.0)
    };
    let plain = SkyParams {
        date: None,
        time: 0.95,
        ..dated
    };
    let southern = night("2026-06-14T12:00:00Z", -33.9, 151.2);
    for (name, params, azimuth, elevation, seconds) in [
        ("orion", dated, 165.0_f32, 30.0_f32, 3.5),
        ("plain", plain, 200.0, 40.0, 1e6),
        ("crux", southern, 190.0, 60.0, 0.0),
        ("horizon", southern, 90.0, 8.0, 11.0),
    ] {
        let view = Camera::looking(azimuth.to_radians(), elevation.to_radians(), 1.05, size);
        let actual = gpu::rgb(&gpu::render(&mut sky, FORMAT, &params, &view, seconds));
        let mut frame = twin.frame_without_map(&params, &view, seconds);
        frame.map = gpu::read_map(&sky);
        let expected = frame.render();
        // The stars alone, without clouds.
        let bright = frame.behind();
        let off = frame.filter_steps();
        let worth = frame.worth_of_reads(&off, |frame| frame.clouds_over(&bright));
        let around = |index: usize| {
            let at = centre(index, size);
            let near = (0..bright.len()).filter(|i| centre(*i, size).distance(at) < 1.5);
            near.map(|i| bright[i].max_element()).fold(0.0, f32::max)
        };
        let bounds: Vec<Vec3> = (0..expected.len())
            .map(|i| 0.02 * expected[i] + worth[i] + (0.01 * around(i) + 1e-4))
            .collect();
        let difference = compare::in_bounds([&expected, &actual], &bounds);
        println!("{name}: {difference:?}");
        // Ten times the darkest sky.
        let seen = bright.iter().any(|b| b.max_element() > 0.03);
        assert!(seen, "{name}: no star is seen");
        if difference.worst > 1.0 {
            let picture = compare::save(&format!("catalogue_{name}"), &expected, &actual, size);
            panic!("{name}: {difference:?}; see {}", picture.display());
        }
    }
}

#[test]
fn clouds_hide_stars() {
    let mut skies = skies(&pack::catalogue_alone(|_| true));
    let view = Camera::looking(2.9, 0.6, 1.0, [320, 180]);
    let mut light = |cover: f32| -> f64 {
        let params = SkyParams {
            cover,
            density: 1.0,
            ..night("2026-01-15T21:00:00Z", 51.5, 0.0)
        };
        let light = starlight(&mut skies, &params, &view);
        light.iter().map(|light| luminance(*light)).sum()
    };
    let [clear, shut] = [0.0, 1.0].map(&mut light);
    assert!(clear > 1.0 && shut < 0.05 * clear, "{clear} {shut}");
}
