//! Who walks sees near clouds move more than far ones, by the closed form.

use glam::Vec2;
use welkin_pack::LayerKind;
use welkin_runtime::internals::clouds::octaves::HEIGHTS_M;
use welkin_runtime::internals::clouds::shared::LOW_HEIGHT_M;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::params::{LitParams, OctaveParams, Shading};
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIDE: i32 = 128;

/// Shifts up to this many pixels are looked for.
const FARTHEST: i32 = 30;

/// Straight up, so narrow that the cloud dome is a plane: at 0.15 radians it is off by 0.1 %.
fn view() -> Camera {
    upwards(0.3)
}

fn upwards(fov_rad: f32) -> Camera {
    let side = SIDE as u32;
    Camera::looking(0.3, std::f32::consts::FRAC_PI_2, fov_rad, [side, side])
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

/// What is seen in a moment of a walk through the wind.
#[derive(Clone, Copy)]
struct Moment {
    view: Camera,
    /// Where the viewer stands, in metres to the east and to the south.
    place_m: Vec2,
    seconds: f64,
}

fn start(view: Camera) -> Moment {
    Moment {
        view,
        place_m: Vec2::ZERO,
        seconds: 40.0,
    }
}

/// Draws the clouds alone before and after a walk, in metres to the east and to the south, and compares the shift with
/// that of a layer `height_m` above.
fn assert_moves(params: &SkyParams, view: Camera, height_m: f64, walk_m: Vec2) {
    let end = Moment {
        place_m: walk_m,
        ..start(view)
    };
    // What was overhead is behind now: the clouds move against the walk.
    assert_shifts(params, end, -walk_m / height_m as f32);
}

/// Draws the clouds alone at two moments and compares their shift with the way that they should have gone, in heights to the
/// east and to the south.
fn assert_shifts(params: &SkyParams, end: Moment, heights: Vec2) {
    let mut sky = gpu::sky(&pack::in_skybox(0.0), FORMAT);
    let [a, b] = [start(end.view), end].map(|moment| {
        let mut view = moment.view;
        view.position_m = glam::Vec3::new(moment.place_m.x, 0.0, moment.place_m.y);
        let texels = gpu::render(&mut sky, FORMAT, params, &view, moment.seconds);
        texels.iter().map(|texel| texel[1]).collect::<Vec<_>>()
    });
    let contrast =
        a.iter().fold(f32::MIN, |m, v| m.max(*v)) - a.iter().fold(f32::MAX, |m, v| m.min(*v));
    assert!(contrast > 0.1, "there are clouds to see: {contrast}");
    let rays = end.view.rays();
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
        "{}: {found}, expected {expected}",
        params.method.name()
    );
}

fn defaults(method: Method) -> SkyParams {
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
            ..defaults(Method::Octaves)
        };
        // The same walk moves higher clouds less; one as much longer as they are higher moves them as far.
        assert_moves(&params, view(), height_m, WALK_M);
        let farther_m = WALK_M * (height_m / LOW_HEIGHT_M) as f32;
        assert_moves(&params, view(), height_m, farther_m);
    }
}

/// Where the lowest layer floats.
fn lit_height_m(lit: &LitParams) -> f64 {
    f64::from(lit.radius_m * lit.flattening * lit.layers[0].height)
}

/// A view of the lit method's dome, which is so flat that its middle is a plane: at 0.45 radians it is off by 0.1 %.
const LIT_FOV_RAD: f32 = 0.9;

/// 25 pixels.
const LIT_WALK_HEIGHTS: Vec2 = Vec2::new(0.145, -0.122);

/// The default layers of the lit method alone, their heights in metres and their velocities.
fn layers() -> impl Iterator<Item = (SkyParams, f64, Vec2)> {
    let mut defaults = defaults(Method::Lit);
    // Light scattered forwards stays where it is.
    defaults.lit.k2 = 0.0;
    let shown = defaults.lit.layers.iter().filter(|layer| layer.share > 0.0);
    let count = shown.count();
    (0..count).map(move |index| {
        let mut params = defaults;
        for (other, layer) in params.lit.layers.iter_mut().enumerate() {
            layer.share = if other == index { 1.0 } else { 0.0 };
            // Of streaks one does not see how far they go along themselves.
            layer.kind = LayerKind::Stratocumulus;
        }
        let layer = params.lit.layers[index];
        let height_m = params.lit.radius_m * params.lit.flattening * layer.height;
        (params, f64::from(height_m), layer.velocity_m_s.into())
    })
}

#[test]
fn each_layer_of_lit_moves_by_its_own_height() {
    assert_eq!(layers().count(), 3);
    for (params, height_m, _) in layers() {
        let walk_m = LIT_WALK_HEIGHTS * height_m as f32;
        assert_moves(&params, upwards(LIT_FOV_RAD), height_m, walk_m);
        assert_moves(&params, upwards(LIT_FOV_RAD), height_m, 0.3 * walk_m);
    }
}

#[test]
fn each_layer_of_lit_goes_its_own_way() {
    for (mut params, height_m, velocity_m_s) in layers() {
        params.speed = 0.5;
        // So that nothing forms meanwhile.
        params.lit.formation_interval_s = 86_400.0;
        // As far as the walk.
        let heights = velocity_m_s.normalize() * LIT_WALK_HEIGHTS.length();
        let mut end = start(upwards(LIT_FOV_RAD));
        let speed_m_s = velocity_m_s.length() * params.speed;
        end.seconds += f64::from(heights.length() / speed_m_s) * height_m;
        assert_shifts(&params, end, heights);
    }
}

#[test]
fn the_other_methods_float_as_low_clouds() {
    for method in [Method::Packed, Method::Fbm] {
        assert_moves(&defaults(method), view(), LOW_HEIGHT_M, WALK_M);
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
    for method in Method::DOMES {
        let mut params = defaults(method);
        // Light that clouds scatter changes with the way that one looks.
        params.shading = Shading::Paper;
        params.octaves.domes = [1.0, 0.0, 0.0];
        params.lit = LitParams::with_layers(&params.lit.layers[..1]);
        if method == Method::Lit {
            // With more, one of its clouds fills the view; and its paper's light is scattered forwards too.
            params.cover = 0.4;
            params.lit.k2 = 0.0;
        }
        let height_m = match method {
            Method::Lit => lit_height_m(&params.lit),
            _ => LOW_HEIGHT_M,
        };
        let mut at = |up_m: f64| {
            let mut view = view();
            view.position_m.y = up_m as f32;
            let texels = gpu::render(&mut sky, FORMAT, &params, &view, 40.0);
            texels.iter().map(|texel| texel[1]).collect::<Vec<_>>()
        };
        let (below, above) = (at(0.0), at(height_m / 2.0));
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
    for method in Method::DOMES {
        let mut at = |x: f32| {
            let mut view = view();
            view.position_m.x = x;
            gpu::render(&mut sky, FORMAT, &defaults(method), &view, 40.0)
        };
        let (broken, origin) = (at(f32::NAN), at(0.0));
        assert!(broken == origin, "{}", method.name());
    }
}

/// The offset of a method's lowest clouds, in tiles 0..1, for a viewer so far to the east.
fn offset(params: &SkyParams, east_m: f64) -> f32 {
    let facts = PackData::new(pack::default_pack()).expect("the pack has every role");
    let mut view = view();
    view.position_m.x = east_m as f32;
    let uniforms = facts.uniforms(params, &view, 40.0, 0.0);
    match params.method {
        Method::Packed | Method::Sprites => uniforms.packed.photo_offset.x,
        Method::Octaves => uniforms.octaves.low.offset.x,
        Method::Fbm => uniforms.fbm.offset.x,
        Method::Lit => uniforms.lit.layers[0].offset.x,
    }
}

/// Offsets are reduced to 0..1: where one begins anew, everything that is read by it must begin anew too.
#[test]
fn nothing_jumps_where_a_tile_begins_anew() {
    let mut sky = gpu::sky(&pack::in_skybox(0.0), FORMAT);
    for method in Method::DOMES {
        let params = SkyParams {
            cover: 0.7,
            ..defaults(method)
        };
        // Tiles have some kilometres, so within twenty an offset begins anew: it is bracketed, then halved to a tenth of a metre.
        let wraps = |a: f64, b: f64| (offset(&params, a) - offset(&params, b)).abs() > 0.5;
        let start = (0..200).map(|i| 100.0 * f64::from(i));
        let mut near = start
            .clone()
            .find(|&a| wraps(a, a + 100.0))
            .expect("a tile ends");
        let mut step = 50.0;
        while step > 0.05 {
            if !wraps(near, near + step) {
                near += step;
            }
            step *= 0.5;
        }
        let [a, b] = [near, near + 0.1].map(|east_m| {
            let mut view = Camera::looking(0.3, 1.2, 1.0, [SIDE as u32; 2]);
            view.position_m.x = east_m as f32;
            let texels = gpu::render(&mut sky, FORMAT, &params, &view, 40.0);
            texels.iter().map(|texel| texel[1]).collect::<Vec<_>>()
        });
        let apart = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
        let (mean, contrast) = (apart.sum::<f32>() / a.len() as f32, deviation(&a));
        // A tenth of a metre is a seventieth of a pixel, and less than a tenth of one for noise five times as fine. Clouds that have nothing to
        // do with each other differ by more than their own deviation.
        println!(
            "{}: off by {mean:.5}, clouds spread by {contrast:.4}",
            method.name()
        );
        assert!(contrast > 0.01, "{method:?}: there are no clouds to see");
        assert!(mean < 0.05 * contrast, "{method:?}: {mean} of {contrast}");
    }
}

fn deviation(values: &[f32]) -> f32 {
    let mean = values.iter().sum::<f32>() / values.len() as f32;
    let squares = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f32>();
    (squares / values.len() as f32).sqrt()
}
