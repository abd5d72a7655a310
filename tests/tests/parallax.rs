//! Who walks sees near clouds move more than far ones, by the closed form.

use glam::Vec2;
use welkin_runtime::clouds::LOW_HEIGHT_M;
use welkin_runtime::octaves::HEIGHTS_M;
use welkin_runtime::{Camera, Method, OctaveParams, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIDE: i32 = 128;

/// Shifts up to this many pixels are looked for.
const FARTHEST: i32 = 30;

/// Straight up, so narrow that the cloud dome is a plane: at 0.15 radians it is off by 0.1 %.
fn view() -> Camera {
    let side = SIDE as u32;
    Camera::looking(0.3, std::f32::consts::FRAC_PI_2, 0.3, [side, side])
}

/// Where `b` holds what the middle of `a` holds: the shift of least squares, in pixels to the right and down.
fn shift(a: &[f32], b: &[f32]) -> [i32; 2] {
    let middle = FARTHEST..SIDE - FARTHEST;
    let apart = |[dx, dy]: [i32; 2]| -> f32 {
        let row = |y: i32| {
            let from = |picture: &[f32], x: i32, y: i32| picture[(y * SIDE + x) as usize];
            let squares = middle
                .clone()
                .map(|x| from(a, x, y) - from(b, x + dx, y + dy));
            squares.map(|d| d * d).sum::<f32>()
        };
        middle.clone().map(row).sum()
    };
    let shifts =
        (-FARTHEST..=FARTHEST).flat_map(|dy| (-FARTHEST..=FARTHEST).map(move |dx| [dx, dy]));
    let each = shifts.map(|shift| (apart(shift), shift));
    each.min_by(|a, b| a.0.total_cmp(&b.0))
        .expect("there are shifts")
        .1
}

/// Draws the clouds alone before and after a walk, in metres to the east and to the south, and compares the shift with
/// that of a layer `height_m` above.
fn assert_moves(params: &SkyParams, height_m: f64, walk_m: Vec2) {
    let mut sky = gpu::sky(&pack::in_skybox(0.0), FORMAT);
    let mut walked = view();
    walked.position_m = glam::Vec3::new(walk_m.x, 0.0, walk_m.y);
    let [a, b] = [view(), walked].map(|view| {
        let texels = gpu::render(&mut sky, FORMAT, params, &view, 40.0);
        texels.iter().map(|texel| texel[1]).collect::<Vec<_>>()
    });
    let contrast =
        a.iter().fold(f32::MIN, |m, v| m.max(*v)) - a.iter().fold(f32::MAX, |m, v| m.min(*v));
    assert!(contrast > 0.1, "there are clouds to see: {contrast}");
    // What was overhead is behind now: the clouds move against the walk, on the screen along its axes.
    let rays = view().rays();
    let heights = -walk_m / height_m as f32;
    let on_screen = |axis: glam::Vec3| {
        let pixel = 2.0 * axis.length() / SIDE as f32;
        heights.dot(Vec2::new(axis.x, axis.z)) / axis.length() / pixel
    };
    let expected = Vec2::new(on_screen(rays.right), -on_screen(rays.up));
    let [x, y] = shift(&a, &b);
    let found = Vec2::new(x as f32, y as f32);
    // A shift is looked for in whole pixels, which is half of one on each axis, and where clouds are streaks half of one
    // more.
    assert!(
        (found - expected).abs().max_element() < 1.5,
        "{} at {height_m} m: {found}, expected {expected}",
        params.method.name()
    );
}

fn usual(method: Method) -> SkyParams {
    SkyParams {
        method,
        sun: false,
        flare: 0.0,
        ..SkyParams::default()
    }
}

/// 25 pixels for the lowest clouds.
const WALK_M: Vec2 = Vec2::new(45.0, -38.0);

#[test]
fn each_dome_of_the_octaves_moves_by_its_own_height() {
    for (index, height_m) in HEIGHTS_M.into_iter().enumerate() {
        let mut domes = [0.0; 3];
        domes[index] = 1.0;
        let params = SkyParams {
            octaves: OctaveParams {
                domes,
                ..OctaveParams::default()
            },
            ..usual(Method::Octaves)
        };
        // The same walk moves higher clouds less; one as much longer as they are higher moves them as far.
        assert_moves(&params, height_m, WALK_M);
        assert_moves(&params, height_m, WALK_M * (height_m / LOW_HEIGHT_M) as f32);
    }
}

#[test]
fn the_other_methods_float_as_low_clouds() {
    for method in [Method::Packed, Method::Fbm] {
        assert_moves(&usual(method), LOW_HEIGHT_M, WALK_M);
    }
}

/// A picture of half the size: the mean of 2x2 pixels.
fn halved(picture: &[f32]) -> Vec<f32> {
    let (half, side) = (SIDE as usize / 2, SIDE as usize);
    let corner = |i: usize| i / half * 2 * side + i % half * 2;
    let mean = |i: usize| {
        [0, 1, side, side + 1]
            .map(|to| picture[corner(i) + to])
            .iter()
            .sum::<f32>()
            / 4.0
    };
    (0..half * half).map(mean).collect()
}

/// Half way up to the clouds they look twice as large.
#[test]
fn who_climbs_comes_nearer() {
    let mut sky = gpu::sky(&pack::in_skybox(0.0), FORMAT);
    for method in Method::ALL {
        let mut params = usual(method);
        params.octaves.domes = [1.0, 0.0, 0.0];
        let mut at = |up_m: f64| {
            let mut view = view();
            view.position_m.y = up_m as f32;
            let texels = gpu::render(&mut sky, FORMAT, &params, &view, 40.0);
            texels.iter().map(|texel| texel[1]).collect::<Vec<_>>()
        };
        let (below, above) = (at(0.0), at(LOW_HEIGHT_M / 2.0));
        let middle = SIDE as usize / 4..3 * SIDE as usize / 4;
        let rows = middle
            .clone()
            .map(|y| below[y * SIDE as usize..][middle.clone()].to_vec());
        let (expected, found) = (rows.collect::<Vec<_>>().concat(), halved(&above));
        let square = |v: &mut dyn Iterator<Item = f32>| {
            v.map(|x| x * x).sum::<f32>() / expected.len() as f32
        };
        let mean = expected.iter().sum::<f32>() / expected.len() as f32;
        let off = square(&mut expected.iter().zip(&found).map(|(e, f)| e - f)).sqrt();
        let spread = square(&mut expected.iter().map(|e| e - mean)).sqrt();
        println!(
            "{}: off by {off:.4}, clouds spread by {spread:.4}",
            method.name()
        );
        // From nearer a finer level is read, which differs in what the pixels below could not tell.
        assert!(off < 0.1 * spread, "{}: {off} of {spread}", method.name());
    }
}

#[test]
fn a_place_that_is_no_number_is_the_origin() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for method in Method::ALL {
        let mut at = |x: f32| {
            let mut view = view();
            view.position_m.x = x;
            gpu::render(&mut sky, FORMAT, &usual(method), &view, 40.0)
        };
        let (broken, origin) = (at(f32::NAN), at(0.0));
        assert!(broken == origin, "{}", method.name());
    }
}
