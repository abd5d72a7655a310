//! The lens flare: where it is, when it is not, and how clouds dim it.

use glam::camera::rh::{proj::directx::perspective, view::look_to_mat4};
use glam::{Vec2, Vec3};
use welkin_pack::{FlareCell, Pack, Role, mapping};
use welkin_runtime::internals::clear_sky::flares::FlareUniforms;
use welkin_runtime::internals::clear_sky::flares::RATIOS;
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::film::Film;
use welkin_tests::renderer::{Frame, Twin};
use welkin_tests::{compare, gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const FOV_Y_RAD: f32 = 1.0;

/// A forenoon: the sun is up, far from zenith and horizon.
const TIME: f32 = 0.36;

fn params(method: Method, cover: f32) -> SkyParams {
    SkyParams {
        method,
        cover,
        time: TIME,
        flare: 1.0,
        ..SkyParams::default()
    }
}

fn sun(pack: &Pack, time: f32) -> [f32; 3] {
    mapping::sun_direction(time, pack.manifest().noon_elevation_rad)
}

/// A camera that sees the sun so far to the left and below of its axis, in radians; azimuth and elevation of that axis too.
fn beside_the_sun(pack: &Pack, [left, below]: [f32; 2], size: [u32; 2]) -> (Camera, [f32; 2]) {
    let (azimuth, elevation) = mapping::angles_from_direction(sun(pack, TIME));
    let axis = [azimuth + left, elevation + below];
    (Camera::looking(axis[0], axis[1], FOV_Y_RAD, size), axis)
}

/// What the flare alone adds to a picture.
fn added(sky: &mut Sky, params: &SkyParams, view: &Camera, seconds: f64) -> Vec<Vec3> {
    let [without, with] = [0.0, params.flare].map(|flare| {
        let params = SkyParams { flare, ..*params };
        gpu::rgb(&gpu::render(sky, FORMAT, &params, view, seconds))
    });
    with.iter().zip(&without).map(|(a, b)| *a - *b).collect()
}

fn brightness(picture: &[Vec3]) -> f32 {
    picture.iter().map(|light| light.element_sum()).sum()
}

/// The default pack, but for flares that are small blobs in the middle of their cells.
fn blobs() -> Pack {
    pack::changed_pack(None, |role, image| {
        if role != Role::Flares {
            return;
        }
        let (side, cell) = (image.width, image.width / FlareCell::A_SIDE);
        for (i, light) in image.texels.iter_mut().enumerate() {
            let place = |i: u32| ((i % cell) as f32 + 0.5) / cell as f32 * 2.0 - 1.0;
            let [x, y] = [i as u32 % side, i as u32 / side].map(place);
            *light = (1.0 - x.hypot(y) / 0.2).max(0.0);
        }
    })
}

/// The middle of each patch of light, weighed by its light.
fn patches(picture: &[Vec3], width: usize) -> Vec<Vec2> {
    // Half floats of a sky of at most 2 are off by 2^-10.
    let mut lit: Vec<bool> = picture
        .iter()
        .map(|light| light.element_sum() > 0.01)
        .collect();
    let mut middles = Vec::new();
    for start in 0..lit.len() {
        let (mut stack, mut sum, mut weight) = (vec![start], Vec2::ZERO, 0.0);
        while let Some(i) = stack.pop() {
            if !std::mem::replace(&mut lit[i], false) {
                continue;
            }
            let light = picture[i].element_sum();
            sum += light * Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
            weight += light;
            let near = [i.wrapping_sub(1), i + 1, i.wrapping_sub(width), i + width];
            stack.extend(near.into_iter().filter(|&i| i < picture.len() && lit[i]));
        }
        if weight > 0.0 {
            middles.push(sum / weight);
        }
    }
    middles
}

#[test]
fn flares_lie_on_the_line_through_sun_and_middle_at_the_papers_ratios() {
    let (pack, size) = (blobs(), [800, 600]);
    let mut sky = gpu::sky(&pack, FORMAT);
    let places = [
        [0.30, 0.0],
        [-0.30, 0.0],
        [0.0, 0.27],
        [0.0, -0.27],
        [0.25, 0.2],
        [-0.35, 0.15],
        [0.4, -0.25],
        [-0.2, -0.3],
        [0.16, -0.14],
        [-0.13, 0.3],
    ];
    for place in places {
        let (view, [azimuth, elevation]) = beside_the_sun(&pack, place, size);
        let found = patches(
            &added(&mut sky, &params(Method::Packed, 0.0), &view, 0.0),
            800,
        );
        // The sun as any application would project it.
        let axis = Vec3::from(mapping::direction_from_angles(azimuth, elevation));
        let aspect = size[0] as f32 / size[1] as f32;
        let clip =
            perspective(FOV_Y_RAD, aspect, 0.1, 100.0) * look_to_mat4(Vec3::ZERO, axis, Vec3::Y);
        let sun = clip.project_point3(Vec3::from(sun(&pack, TIME)) * 10.0);
        assert_eq!(found.len(), RATIOS.len(), "{place:?}: {found:?}");
        for ratio in RATIOS {
            let ndc = Vec2::new(sun.x, sun.y) * ratio;
            let pixel = (ndc * Vec2::new(0.5, -0.5) + 0.5) * Vec2::new(800.0, 600.0);
            let off = found
                .iter()
                .map(|f| f.distance(pixel))
                .fold(f32::MAX, f32::min);
            assert!(
                off < 1.0,
                "{place:?}: no flare within {off} pixels of {pixel}, at {ratio}: {found:?}"
            );
        }
    }
}

/// Whether a pixel's middle lies so near to an edge of a square that a rasteriser, which snaps corners to 1/256 of a
/// pixel, may count it in or out.
fn on_an_edge(flares: &FlareUniforms, pixel: usize, [width, height]: [u32; 2]) -> bool {
    let size = Vec2::new(width as f32, height as f32);
    let middle = Vec2::new(
        (pixel as u32 % width) as f32 + 0.5,
        (pixel as u32 / width) as f32 + 0.5,
    );
    flares.squares.iter().any(|square| {
        let Vec2 { x, y } = square.position;
        let from_square = middle - (Vec2::new(x, -y) * 0.5 + 0.5) * size;
        let to_edge = from_square.abs() - square.half_size * 0.5 * size;
        to_edge.abs().min_element() < 1.0 / 128.0
    })
}

#[test]
fn the_flare_is_the_twins() {
    let pack = pack::default_pack();
    let (mut sky, twin) = (gpu::sky(pack, FORMAT), Twin::new(pack));
    let size = [160, 120];
    for method in Method::DOMES {
        for (place, cover, seconds) in [
            ([0.2, 0.1], 0.0, 0.0),
            ([-0.3, 0.2], 0.5, 40.0),
            ([0.1, -0.25], 0.7, 300.0),
        ] {
            let (view, _) = beside_the_sun(pack, place, size);
            let params = SkyParams {
                sun: false,
                ..params(method, cover)
            };
            let actual = added(&mut sky, &params, &view, seconds);
            let mut frame = twin.frame_without_map(&params, &view, seconds);
            frame.map = gpu::read_map(&sky);
            let expected = frame.flare();
            let worth = frame.worth_of_reads(&frame.filter_steps(), Frame::flare);
            // Six reads of the atlas, each off by a step of 8-bit filtering, of at most 0.6 opacity in all; two half floats.
            let bound = |(pixel, worth): (usize, &Vec3)| match on_an_edge(
                &frame.uniforms.flares,
                pixel,
                size,
            ) {
                true => Vec3::INFINITY,
                false => *worth + 0.6 / 255.0 + 2.0 / 1024.0,
            };
            let bounds: Vec<Vec3> = worth.iter().enumerate().map(bound).collect();
            let ratio = |picture: &[Vec3]| -> Vec<Vec3> {
                picture.iter().zip(&bounds).map(|(p, b)| *p / *b).collect()
            };
            let difference = compare::difference(&ratio(&expected), &ratio(&actual), |_| 1.0);
            println!(
                "{} {place:?}: {difference:?}, light {}",
                method.name(),
                brightness(&expected)
            );
            if difference.worst > 1.0 {
                let file = format!("flares_{}_{cover}", method.name());
                let picture = compare::save(&file, &expected, &actual, size);
                panic!(
                    "{place:?} {method:?}: {difference:?}; see {}",
                    picture.display()
                );
            }
        }
    }
}

/// The most that light differs around the sun, over the brightest: of pixels that are as far from it to a quarter of a pixel.
fn spread_around(picture: &[Vec3], side: usize) -> f32 {
    let mut rings = vec![[f32::MAX, f32::MIN]; 4 * side];
    for (i, light) in picture.iter().enumerate() {
        let away = Vec2::new((i % side) as f32, (i / side) as f32) - 0.5 * (side as f32 - 1.0);
        let [least, most] = &mut rings[(4.0 * away.length()) as usize];
        (*least, *most) = (least.min(light.y), most.max(light.y));
    }
    let brightest = picture.iter().map(|light| light.y).fold(0.0, f32::max);
    let spreads = rings.iter().map(|[least, most]| most - least);
    spreads.fold(0.0, f32::max) / brightest
}

/// With the sun in the middle of the screen all pictures lie about it. They are round, as the paper has them; the starburst, which is
/// not, comes where it is asked for.
#[test]
fn the_flare_is_round_unless_a_starburst_is_asked_for() {
    let pack = pack::default_pack();
    let mut sky = gpu::sky(pack, FORMAT);
    let side = 301;
    let (view, _) = beside_the_sun(pack, [0.0, 0.0], [side; 2]);
    let clear = params(Method::Packed, 0.0);
    assert!(!SkyParams::default().starburst, "a disc by default");
    let [round, star] = [false, true].map(|starburst| {
        let params = SkyParams {
            starburst,
            sun: false,
            ..clear
        };
        spread_around(&added(&mut sky, &params, &view, 0.0), side as usize)
    });
    println!("round {round:.3}, starburst {star:.3}");
    // The sharpest edge, of the disc, is 2.4 pixels wide here: over a quarter of a pixel it falls by a tenth.
    assert!(round < 0.1, "{round}");
    assert!(
        star > 0.1,
        "the same number tells what is not round: {star}"
    );
}

#[test]
fn nothing_is_drawn_without_a_sun_in_view() {
    let pack = pack::default_pack();
    let mut sky = gpu::sky(pack, FORMAT);
    let size = [160, 120];
    let mut light = |params: &SkyParams, view: &Camera| {
        let picture = added(&mut sky, params, view, 0.0);
        picture.iter().filter(|light| **light != Vec3::ZERO).count()
    };
    for method in Method::DOMES {
        let params = params(method, 0.05);
        let at = |place: [f32; 2]| beside_the_sun(pack, place, size).0;
        assert!(
            light(&params, &at([0.1, 0.1])) > 1000,
            "{method:?}: there is one to begin with"
        );
        let half_turn = std::f32::consts::PI;
        for (what, place) in [
            ("behind", [half_turn, 0.0]),
            ("behind, above", [half_turn, 0.6]),
            ("at the right angle", [half_turn / 2.0, 0.0]),
            ("out at the left", [1.2, 0.0]),
            ("out at the right", [-1.2, 0.0]),
            ("out below", [0.0, 0.55]),
            ("out above", [0.0, -0.55]),
        ] {
            assert_eq!(light(&params, &at(place)), 0, "{method:?}, {what}");
        }
        assert_eq!(
            light(
                &SkyParams {
                    flare: 0.0,
                    ..params
                },
                &at([0.1, 0.1])
            ),
            0
        );
        // Under the horizon, straight ahead.
        for time in [0.0, 0.22, 0.78] {
            let (azimuth, elevation) = mapping::angles_from_direction(sun(pack, time));
            let view = Camera::looking(azimuth + 0.1, elevation + 0.1, FOV_Y_RAD, size);
            assert_eq!(
                light(&SkyParams { time, ..params }, &view),
                0,
                "{method:?} at {time}"
            );
        }
    }
}

#[test]
fn it_fades_where_the_sun_goes_out_of_view_and_as_it_sets() {
    let pack = pack::default_pack();
    let mut sky = gpu::sky(pack, FORMAT);
    let size = [160, 120];
    let clear = params(Method::Packed, 0.0);
    // 0.5 rad is the upper side of the screen. What is on the screen of the starburst changes too, so steps are small there.
    let strength = |view: &Camera, params: &SkyParams| {
        Twin::new(pack)
            .frame_without_map(params, view, 0.0)
            .uniforms
            .flares
            .strength
    };
    let mut last = f32::INFINITY;
    for below in [-0.40, -0.47, -0.48, -0.49, -0.495, -0.501] {
        let (view, _) = beside_the_sun(pack, [0.0, below], size);
        let now = strength(&view, &clear);
        assert!(
            now <= last && (0.0..=1.0).contains(&now),
            "{below}: {now} after {last}"
        );
        last = now;
    }
    assert_eq!(last, 0.0);
    let mut last = f32::INFINITY;
    for time in [0.70, 0.735, 0.74, 0.745, 0.75, 0.755] {
        let (azimuth, elevation) = mapping::angles_from_direction(sun(pack, time));
        let view = Camera::looking(azimuth + 0.1, elevation + 0.1, FOV_Y_RAD, size);
        let now = brightness(&added(&mut sky, &SkyParams { time, ..clear }, &view, 0.0));
        assert!(now <= last, "{time}: {now} after {last}");
        last = now;
    }
    assert_eq!(last, 0.0);
}

#[test]
fn it_falls_as_cover_grows() {
    let pack = pack::default_pack();
    let mut sky = gpu::sky(pack, FORMAT);
    let (view, _) = beside_the_sun(pack, [0.15, 0.1], [96, 72]);
    for method in Method::DOMES {
        let covers = (0..=20).map(|i| i as f32 / 20.0);
        let light: Vec<f32> = covers
            .map(|cover| brightness(&added(&mut sky, &params(method, cover), &view, 0.0)))
            .collect();
        println!("{}: {light:.1?}", method.name());
        for pair in light.windows(2) {
            // Each pixel's difference of half floats is off by 2^-11, one way or the other.
            assert!(
                pair[1] <= pair[0] + 0.002 * light[0],
                "{method:?}: {light:?}"
            );
        }
        assert!(light[20] < 0.1 * light[0], "{method:?}: {light:?}");
    }
}

/// In a time-lapse the flare is what the clouds in the picture itself leave of the sun: no more, no less, at any moment.
#[test]
fn it_falls_as_a_cloud_crosses_the_sun() {
    let pack = pack::default_pack();
    let (mut sky, mut film) = (gpu::sky(pack, FORMAT), Film::new());
    let side = 65;
    let (azimuth, elevation) = mapping::angles_from_direction(sun(pack, TIME));
    // A pixel is 0.002 rad wide: the looks about the sun, 0.012 away, are six pixels from the middle.
    let view = Camera::looking(azimuth, elevation, 0.13, [side, side]);
    for method in Method::DOMES {
        let params = SkyParams {
            speed: 0.5,
            sun: false,
            // The photo's large shapes would take longer to cross it.
            photo: 0.0,
            ..params(method, 0.5)
        };
        let full = brightness(&added(
            &mut sky,
            &SkyParams {
                cover: 0.0,
                ..params
            },
            &view,
            0.0,
        ));
        let uniforms = Twin::new(pack)
            .frame_without_map(&params, &view, 0.0)
            .uniforms;
        let pixel = 2.0 * (0.13_f32 / 2.0).tan() / side as f32;
        let away = (uniforms.flares.sun_radius / pixel).round() as usize;
        let (mut least, mut most) = (f32::MAX, f32::MIN);
        for i in 0..60 {
            let seconds = f64::from(i) * 2.0;
            let alpha = film.alpha(&params, &view, seconds);
            let (middle, row) = (32 * side as usize + 32, side as usize);
            let around = [
                middle - away,
                middle + away,
                middle - away * row,
                middle + away * row,
            ];
            let around: f32 = around.iter().map(|&i| alpha[i]).sum();
            let expected = 1.0 - (2.0 * alpha[middle] + around) / 6.0;
            let found = brightness(&added(&mut sky, &params, &view, seconds)) / full;
            // Looks are rounded to pixels, over which opacity changes by a few hundredths; half floats.
            assert!(
                (found - expected).abs() < 0.05,
                "{method:?} at {seconds} s: {found}, clouds leave {expected}"
            );
            (least, most) = (least.min(found), most.max(found));
        }
        println!(
            "{}: between {least:.2} and {most:.2} of the flare",
            method.name()
        );
        assert!(
            least < 0.3 && most > 0.9,
            "{method:?}: clouds come and go: {least} {most}"
        );
    }
}
