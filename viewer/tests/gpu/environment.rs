//! Environment maps of real skies: their faces meet, and look where they should.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::sync::OnceLock;

use glam::Vec3;
use welkin_pack::mapping::{cube_texel, sun_direction};
use welkin_pack::{Image, Pack, PackInfo, Role};
use welkin_runtime::params::{Lightning, SkyModel, WeatherParams};
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_viewer::export::Environment;
use welkin_viewer::export::cube::face_to_direction;
use welkin_viewer::export::cubemap::Cubemap;
use welkin_viewer::export::equirect::equirect_to_direction;
use welkin_viewer::frame::{Frame, Pixels};
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::View;

use crate::common;

const SIDE: u32 = 128;

fn gpu() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| Gpu::open(None).unwrap())
}

fn sky() -> Environment<'static> {
    static PACK: OnceLock<Pack> = OnceLock::new();
    let pack = PACK.get_or_init(|| Pack::open(common::pack()).unwrap());
    Environment::new(gpu(), pack).unwrap()
}

fn view(params: SkyParams) -> View {
    View {
        params,
        camera: Camera::looking(0.0, 0.0, 1.0, [1, 1]),
        seconds: 40.0,
    }
}

/// Noon, sunset and night of a method.
fn hours(method: Method) -> [(&'static str, SkyParams); 3] {
    let of = |time, sunset, cover| SkyParams {
        method,
        time,
        sunset,
        cover,
        ..SkyParams::default()
    };
    [
        ("noon", of(0.45, 0.0, 0.6)),
        ("sunset", of(0.742, 1.0, 0.6)),
        ("night", of(0.02, 0.0, 0.35)),
    ]
}

/// Four texels in a row.
type Four = [(u32, [i32; 2]); 4];

/// Texels on both sides of each edge of the cube, from one face to the next; and beside them the same within a face, three texels from the edge.
fn rows() -> Vec<(Four, Four)> {
    let last = SIDE as i32 - 1;
    let mut rows = Vec::new();
    for face in 0..6 {
        for (along, side) in (0..=last).flat_map(|i| (0..4).map(move |side| (i, side))) {
            let (start, out) = [
                ([0, along], [-1, 0]),
                ([last, along], [1, 0]),
                ([along, 0], [0, -1]),
                ([along, last], [0, 1]),
            ][side];
            let inward =
                |from: [i32; 2], out: [i32; 2], n: i32| [0, 1].map(|i| from[i] - n * out[i]);
            let (other, place) = cube_texel(face, inward(start, out, -1), SIDE);
            // Each edge once.
            if other < face {
                continue;
            }
            let place = place.map(|i| i as i32);
            let back = [[-1, 0], [1, 0], [0, -1], [0, 1]]
                .into_iter()
                .find(|&step| {
                    let there = inward(place, step, -1);
                    let beyond = there.iter().any(|i| !(0..=last).contains(i));
                    beyond && cube_texel(other, there, SIDE) == (face, start.map(|i| i as u32))
                });
            // A corner has two neighbours, and either answer.
            let Some(back) = back else { continue };
            let across = [
                (face, inward(start, out, 1)),
                (face, start),
                (other, place),
                (other, inward(place, back, 1)),
            ];
            let within = [5, 4, 3, 2].map(|n| (face, inward(start, out, n)));
            rows.push((across, within));
        }
    }
    rows
}

/// How far the two ends of four texels disagree about what is halfway: each goes on in a straight line.
fn gap(map: &Cubemap, four: Four) -> f64 {
    let texel = |(face, [x, y]): (u32, [i32; 2])| {
        map.faces[face as usize].texel(x as u32, y as u32).to_vec()
    };
    let [a, b, c, d] = four.map(texel);
    (0..3)
        .map(|i| f64::from((1.5 * b[i] - 0.5 * a[i] - 1.5 * c[i] + 0.5 * d[i]).abs()))
        .sum()
}

/// The mean gap across the edges, over that within faces.
fn seam(map: &Cubemap) -> f64 {
    let rows = rows();
    let (across, within) = rows.iter().fold((0.0, 0.0), |(across, within), row| {
        (across + gap(map, row.0), within + gap(map, row.1))
    });
    across / within
}

/// The default pack without its stars. They are points, of which some lie on edges, and each would change the mean by chance; that they
/// keep their light over all faces of a cube is asked in tests/tests/gpu/stars.rs. The galaxy stays.
fn starless_sky() -> Environment<'static> {
    static PACK: OnceLock<Pack> = OnceLock::new();
    let pack = PACK.get_or_init(|| {
        let pack = Pack::open(common::pack()).unwrap();
        let info = PackInfo {
            seed: pack.manifest().seed,
            noon_elevation_rad: pack.manifest().noon_elevation_rad,
            ..PackInfo::default()
        };
        let textures = Role::ALL.into_iter().filter_map(|role| {
            let mut texture = pack.texture(role)?.clone();
            if role == Role::Stars {
                texture.levels.iter_mut().for_each(|level| level.fill(0));
            }
            Some((role, texture))
        });
        let starless = Pack::from_textures(info, textures.collect()).unwrap();
        let field = pack.field().unwrap().clone();
        starless.with_any_field(field).unwrap()
    });
    Environment::new(gpu(), pack).unwrap()
}

/// Without a seam both are gaps of the same sky, on lines three texels apart, and their means are alike but for chance: at 1. A seam adds
/// itself to the one and not to the other; where it is as large as what the sky does by itself, it is at 2. Half of that would not be seen.
const NO_SEAM: f64 = 1.5;

#[test]
fn every_edge_of_the_cube_has_its_rows() {
    // Twelve edges, of whose ends a few may be left out: three faces meet in each of the eight corners.
    let count = rows().len();
    assert!(
        count <= 12 * SIDE as usize && count >= 12 * (SIDE as usize - 2),
        "{count}"
    );
}

#[test]
fn faces_of_every_method_meet_by_day_at_sunset_and_by_night() {
    let mut sky = starless_sky();
    for method in Method::ALL {
        for (hour, params) in hours(method) {
            let map = sky.cubemap(&view(params), SIDE).unwrap();
            assert!(
                map.faces
                    .iter()
                    .all(|f| f.texels.iter().all(|t| t.is_finite() && *t >= 0.0))
            );
            let seam = seam(&map);
            println!("{} {hour}: {seam:.3}", method.name());
            assert!(seam < NO_SEAM, "{} {hour}: {seam}", method.name());
        }
    }
}

#[test]
fn faces_meet_with_rays_lightning_another_sky_and_from_above_the_clouds() {
    let weather = WeatherParams {
        rays: 1.0,
        lightning: Lightning {
            place_m: [2500.0, -2500.0],
            start_s: 39.99,
            strength: 1.0,
        },
        ..WeatherParams::default()
    };
    let mut sky = sky();
    for method in [Method::Fbm, Method::Sprites] {
        let [_, (_, sunset), _] = hours(method);
        let params = SkyParams {
            weather,
            sky: SkyModel::Perez,
            ..sunset
        };
        let mut view = view(params);
        view.camera.position_m = Vec3::new(300.0, 2500.0, -700.0);
        let seam = seam(&sky.cubemap(&view, SIDE).unwrap());
        println!("{}: {seam:.3}", method.name());
        assert!(seam < NO_SEAM, "{}: {seam}", method.name());
    }
}

#[test]
fn a_seam_would_be_found() {
    let [(_, noon), ..] = hours(Method::Packed);
    let map = sky().cubemap(&view(noon), SIDE).unwrap();
    // A twentieth is less than clouds change by from texel to texel.
    let clear = SkyParams { cover: 0.0, ..noon };
    let clear = sky().cubemap(&view(clear), SIDE).unwrap();
    let broken = |map: &Cubemap, change: &dyn Fn(&mut Vec<Image>)| {
        let mut map = map.clone();
        change(&mut map.faces);
        seam(&map)
    };
    // A face that lies on its side, two in each other's place, one mirrored, one a twentieth brighter.
    let turned = broken(&map, &|faces| {
        let face = faces[2].clone();
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            faces[2]
                .texel_mut(x, y)
                .copy_from_slice(face.texel(y, SIDE - 1 - x));
        }
    });
    let swapped = broken(&map, &|faces| faces.swap(0, 1));
    let mirrored = broken(&map, &|faces| {
        let face = faces[4].clone();
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            faces[4]
                .texel_mut(x, y)
                .copy_from_slice(face.texel(SIDE - 1 - x, y));
        }
    });
    let brighter = broken(&clear, &|faces| {
        faces[4].texels.iter_mut().for_each(|t| *t *= 1.05)
    });
    for (fault, seam) in [
        ("turned", turned),
        ("swapped", swapped),
        ("mirrored", mirrored),
        ("brighter", brighter),
    ] {
        println!("{fault}: {seam:.3}");
        assert!(seam > NO_SEAM, "{fault}: {seam}");
    }
}

/// The unit direction of the brightest of some texels.
fn brightest(texels: impl Iterator<Item = (Vec3, f32)>) -> Vec3 {
    texels.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0
}

#[test]
fn the_sun_is_where_it_should_be() {
    let pack = Pack::open(common::pack()).unwrap();
    let mut sky = sky();
    // Low in the east, high in the south, low in the west; the zenith's face and the sides'.
    for time in [0.3, 0.36, 0.5, 0.7] {
        let params = SkyParams {
            cover: 0.0,
            time,
            ..SkyParams::default()
        };
        let wanted = Vec3::from(sun_direction(time, pack.manifest().noon_elevation_rad));
        let map = sky.cubemap(&view(params), SIDE).unwrap();
        let texels = (0..6)
            .flat_map(|face: usize| (0..SIDE * SIDE).map(move |i| (face, [i % SIDE, i / SIDE])));
        let found = brightest(texels.map(|(face, at)| {
            let st = at.map(|i| (i as f32 + 0.5) / SIDE as f32);
            let radiance = map.faces[face].texel(at[0], at[1])[1];
            (Vec3::from(face_to_direction(face, st)), radiance)
        }));
        // Half the diagonal of a texel, and the disc's radius of 0.0095 that may reach into the next one.
        let half_diagonal = std::f32::consts::SQRT_2 / SIDE as f32;
        assert!(
            found.angle_between(wanted) < half_diagonal + 0.0095,
            "{time}: {found} {wanted}"
        );

        let width = 4 * SIDE;
        for azimuth in [0.0, 1.5] {
            let Frame { pixels, .. } = sky.equirect(&view(params), width, azimuth).unwrap();
            let Pixels::Linear(pixels) = pixels else {
                panic!("radiance")
            };
            let found = brightest(pixels.iter().zip(0..).map(|(pixel, i): (_, u32)| {
                let uv = [
                    ((i % width) as f32 + 0.5) / width as f32,
                    ((i / width) as f32 + 0.5) / (width / 2) as f32,
                ];
                (
                    Vec3::from(equirect_to_direction(uv, azimuth)),
                    pixel[1].to_f32(),
                )
            }));
            let half_diagonal = std::f32::consts::PI * std::f32::consts::SQRT_2 / width as f32;
            assert!(
                found.angle_between(wanted) < half_diagonal + 0.0095,
                "{time}: {found} {wanted}"
            );
        }
    }
}

#[test]
fn a_map_does_not_depend_on_those_before_it_nor_on_where_the_camera_looks() {
    for method in Method::ALL {
        let [(_, noon), (_, sunset), _] = hours(method);
        let of = |sky: &mut Environment<'_>, azimuth: f32| {
            let mut view = view(noon);
            view.camera = Camera {
                position_m: Vec3::new(0.0, 1300.0, 0.0),
                ..Camera::looking(azimuth, 0.3, 0.7, [9, 5])
            };
            sky.cubemap(&view, 32).unwrap()
        };
        let fresh = of(&mut sky(), 0.0);
        let mut used = sky();
        used.cubemap(&view(sunset), 16).unwrap();
        assert!(of(&mut used, 2.0) == fresh, "{}", method.name());
    }
}
