//! Stars of a date and place are seen where the almanac has them.

use glam::{DVec3, Quat, Vec2, Vec3};
use welkin_pack::mapping::StarPlace;
use welkin_pack::{Pack, Role};
use welkin_runtime::almanac::refraction::lifted;
use welkin_runtime::almanac::{self, Date, Place};
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, SkyParams};
use welkin_tests::{camera, gpu, pack, stars};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [160, 160];
const FOV_RAD: f32 = 0.25;

/// Every star of the upper half of the dome, and of the other half, turned about the line of its nodes.
fn on_dome(pack: &Pack, node: Vec2) -> Vec<Vec3> {
    let side = pack.texture(Role::Stars).expect("stars").width as usize;
    let half_turn = Quat::from_axis_angle(Vec3::new(node.x, 0.0, node.y), std::f32::consts::PI);
    let mut found = Vec::new();
    for texel in (0..side * side).map(|i| [i % side, i / side]) {
        if stars::star(pack, 0, texel, side).intensity == 0.0 {
            continue;
        }
        let uv = texel.map(|t| (t as f32 + 0.5) / side as f32);
        let tiles = (-2..=2).flat_map(|x| (-2..=2).map(move |y| [x, y]));
        let upper = tiles.map(|tile| stars::direction_of(StarPlace { tile, uv }));
        for direction in upper.filter(|d| d.y > 0.0) {
            found.extend([direction, half_turn * direction]);
        }
    }
    found
}

/// The dome's zenith is the pole, its north right ascension 0, its east 270 degrees.
fn seen(date: Date, place: Place, own: Vec3) -> Vec3 {
    let own = own.as_dvec3();
    let equatorial = DVec3::new(-own.z, -own.x, own.y);
    lifted(almanac::stars::turn(date, place) * equatorial).as_vec3()
}

#[test]
fn lone_stars_are_seen_where_the_almanac_has_them() {
    let pack = pack::stars_alone();
    let facts = PackData::new(&pack).expect("the pack has every role");
    let mut sky = gpu::sky(&pack, FORMAT);
    for (date, latitude_deg, longitude_deg, seconds) in [
        ("2026-01-15T22:00:00Z", 59.9, 30.3, 0.0),
        ("1969-07-20T20:00:00Z", -33.9, 20.0, 5000.0),
        ("2026-03-10T00:00:00Z", 0.0, 0.0, 0.0),
    ] {
        let date: Date = date.parse().expect("a date");
        let place = Place {
            latitude_deg,
            longitude_deg,
        };
        let params = SkyParams {
            date: Some(date),
            place,
            cover: 0.0,
            sun: false,
            moon: 0.0,
            ..SkyParams::default()
        };
        let now = date.after(seconds);
        let all: Vec<(Vec3, Vec3)> = on_dome(&pack, facts.galaxy_node)
            .into_iter()
            .map(|own| (own, seen(now, place, own)))
            .filter(|(_, direction)| direction.y > 0.15)
            .collect();
        // A tent is a pixel wide each way: alone is who has nobody within six pixels.
        let alone = 6.0 * FOV_RAD / SIZE[1] as f32;
        let lone = |index: usize| {
            let others = all.iter().enumerate().filter(|(other, _)| *other != index);
            others
                .map(|(_, (_, d))| d.distance(all[index].1))
                .all(|apart| apart > alone)
        };
        // Some of each half of the dome, low and high.
        for (is_upper, is_low) in [(true, true), (true, false), (false, true), (false, false)] {
            let fits = |index: &usize| {
                let (own, direction) = all[*index];
                (own.y > 0.05) == is_upper
                    && own.y.abs() > 0.05
                    && (direction.y < 0.5) == is_low
                    && lone(*index)
            };
            let picked: Vec<usize> = (0..all.len()).step_by(7).filter(fits).take(2).collect();
            // In the north the southern half of the sky stays low.
            let none = latitude_deg > 45.0 && !is_upper && !is_low;
            let wanted = if none { 0 } else { 2 };
            assert_eq!(picked.len(), wanted, "{date}: {is_upper} {is_low}");
            for index in picked {
                let direction = all[index].1;
                let azimuth = direction.x.atan2(-direction.z);
                let view = Camera::looking(azimuth, direction.y.asin(), FOV_RAD, SIZE);
                let uniforms = facts.uniforms(&params, &view, seconds, 0.0);
                let wanted = camera::pixel_of(&uniforms.camera, direction);
                let dark = SkyParams {
                    stars: false,
                    ..params
                };
                let with = gpu::render(&mut sky, FORMAT, &params, &view, seconds);
                let without = gpu::render(&mut sky, FORMAT, &dark, &view, seconds);
                let (mut sum, mut light) = (Vec2::ZERO, 0.0);
                for y in 0..SIZE[1] {
                    for x in 0..SIZE[0] {
                        let pixel = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                        if pixel.distance(wanted) < 4.0 {
                            let at = (y * SIZE[0] + x) as usize;
                            let own = (with[at][1] - without[at][1]).max(0.0);
                            sum += pixel * own;
                            light += own;
                        }
                    }
                }
                assert!(light > 0.0, "{date}: no star at {direction}");
                // A tenth of a pixel is 0.009 degrees.
                let off = (sum / light).distance(wanted);
                assert!(off < 0.1, "{date}: {direction} is off by {off} pixels");
            }
        }
    }
}
