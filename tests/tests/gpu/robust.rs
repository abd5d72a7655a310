//! No parameter, camera, sun or time makes a pixel that is not a finite, positive amount of light.

use welkin_pack::{LayerKind, Pack, mapping};
use welkin_runtime::params::{Lightning, LitParams, OTHERS, PerezShape, SETTINGS, SkyModel};
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [65, 49];

fn assert_light(pack: &Pack, cases: &[(SkyParams, Camera, f64)]) {
    let mut sky = gpu::sky(pack, FORMAT);
    for (params, camera, seconds) in cases {
        let size = camera.viewport_px.map(|side| side.max(1));
        let target = gpu::target(FORMAT, size, 1);
        gpu::prepare(&mut sky, params, camera, *seconds);
        gpu::pass(&target, None, None, |pass| sky.draw(pass));
        for (index, texel) in gpu::read(&target).iter().enumerate() {
            let sound = texel.iter().all(|c| c.is_finite() && *c >= 0.0) && texel[3] == 1.0;
            assert!(
                sound,
                "{params:?} {camera:?} {seconds}: pixel {index} is {texel:?}"
            );
        }
    }
}

fn views() -> Vec<Camera> {
    let half_pi = std::f32::consts::FRAC_PI_2;
    // The middle pixel of an odd size looks exactly along the axis: zenith, nadir, horizon.
    [half_pi, -half_pi, 0.0]
        .map(|elevation| Camera::looking(0.0, elevation, 1.5, SIZE))
        .to_vec()
}

#[test]
fn at_every_hour_in_every_special_direction() {
    let hours = [0.0, 0.2, 0.25, 0.3, 0.5, 0.75, 0.8, 1.0];
    let mut cases = Vec::new();
    for method in Method::ALL {
        for view in views() {
            for time in hours {
                for sky in SkyModel::ALL {
                    let params = SkyParams {
                        time,
                        sky,
                        method,
                        upper_layer: 0.5,
                        ..SkyParams::default()
                    };
                    cases.push((params, view, 1.0));
                }
            }
        }
    }
    assert_light(pack::default_pack(), &cases);
}

#[test]
fn with_the_sun_exactly_at_the_zenith_on_the_horizon_and_at_the_nadir() {
    let overhead = pack::changed_pack(Some(std::f32::consts::FRAC_PI_2), |_, _| {});
    let mut cases = Vec::new();
    for method in Method::ALL {
        for view in views() {
            for time in [0.0, 0.25, 0.5, 0.75] {
                for sky in SkyModel::ALL {
                    let params = SkyParams {
                        time,
                        sky,
                        method,
                        ..SkyParams::default()
                    };
                    cases.push((params, view, 0.0));
                }
            }
        }
    }
    assert_light(&overhead, &cases);
}

/// Numbers as if by chance: a 64-bit linear congruential generator (D. E. Knuth, MMIX), upper bits.
struct Draw(u64);

impl Draw {
    fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        choices[(self.0 >> 33) as usize % choices.len()]
    }
}

/// Corners of what a camera and the weather may be: straight up and down, the narrowest and the widest view, one pixel, on the
/// ground, in a cloud and above them.
fn corner(draw: &mut Draw, method: Method, sky: SkyModel) -> (SkyParams, Camera, f64) {
    let (half_pi, turn) = (std::f32::consts::FRAC_PI_2, std::f32::consts::TAU);
    let elevation = [
        -half_pi,
        half_pi,
        0.0,
        -1e-4,
        1e-4,
        half_pi - 1e-4,
        -1.4,
        0.3,
    ];
    let fov_deg = [150.0_f32, 150.0, 120.0, 90.0, 1.0, 0.01, 177.0];
    let size = draw.of(&[[1, 1], [1, 1], [1, 3], [3, 1], [2, 2], [5, 3]]);
    let fov_rad = draw.of(&fov_deg).to_radians();
    let azimuth = draw.of(&[0.0, half_pi, turn / 2.0, 1.0]);
    let mut camera = Camera::looking(azimuth, draw.of(&elevation), fov_rad, size);
    camera.position_m.y = draw.of(&[0.0, 0.0, 2.0, 1250.0, 7600.0, 20_000.0, -1.0]);
    let mut params = SkyParams {
        method,
        sky,
        cover: draw.of(&[0.0, 0.5, 1.0]),
        height: draw.of(&[0.0, 1.0]),
        density: draw.of(&[0.0, 1.0]),
        sunset: draw.of(&[0.0, 1.0]),
        speed: draw.of(&[0.0, 1.0]),
        time: draw.of(&[0.0, 0.25, 0.5, 0.75]),
        flare: draw.of(&[0.0, 1.0]),
        upper_layer: draw.of(&[0.0, 1.0]),
        skybox: draw.of(&[0.0, 1.0]),
        ..SkyParams::default()
    };
    params.weather.rays = draw.of(&[0.0, 1.0]);
    params.weather.rain = draw.of(&[0.0, 0.1, 0.5, 1.0]);
    params.weather.lightning = Lightning {
        strength: draw.of(&[0.0, 1.0]),
        start_s: 10.0,
        place_m: draw.of(&[[0.0, 0.0], [2.0, -2.5], [1e6, 1e6]]),
    };
    (params, camera, draw.of(&[0.0, 10.01, 3.3]))
}

#[test]
fn at_the_corners_of_camera_and_weather() {
    let mut draw = Draw(1);
    let mut cases = Vec::new();
    for method in Method::ALL {
        for sky in SkyModel::ALL {
            cases.extend((0..8).map(|_| corner(&mut draw, method, sky)));
        }
    }
    assert_light(pack::default_pack(), &cases);
}

/// A sprite seen edge on: of a sliver of a triangle llvmpipe interpolates what is no number.
#[test]
fn at_a_sprite_seen_edge_on() {
    let size = [160, 90];
    let camera = Camera::looking(
        100_f32.to_radians(),
        17_f32.to_radians(),
        60_f32.to_radians(),
        size,
    );
    let params = SkyParams {
        method: Method::Sprites,
        time: 0.45,
        cover: 0.6,
        ..SkyParams::default()
    };
    let moments = (0..8).map(|step| 17.0 + f64::from(step) / 30.0);
    let cases: Vec<_> = moments.map(|seconds| (params, camera, seconds)).collect();
    assert_light(pack::default_pack(), &cases);
}

/// A ray along the fall of the rain never meets the planes that its streaks lie in.
#[test]
fn straight_along_the_fall_of_rain() {
    let half_pi = std::f32::consts::FRAC_PI_2;
    let mut cases = Vec::new();
    for (elevation, rain) in [
        (-half_pi, 0.1),
        (-half_pi, 0.5),
        (-half_pi, 1.0),
        (half_pi, 1.0),
    ] {
        for size in [[1, 1], [3, 3], [5, 1]] {
            let mut params = SkyParams {
                speed: 0.0,
                ..SkyParams::default()
            };
            params.weather.rain = rain;
            let fov_rad = 150.0_f32.to_radians();
            let camera = Camera::looking(0.0, elevation, fov_rad, size);
            cases.extend([0.0, 1.7].map(|seconds| (params, camera, seconds)));
        }
    }
    assert_light(pack::default_pack(), &cases);
}

/// Every number set to the same.
fn all(method: Method, number: f32) -> SkyParams {
    let mut params = SkyParams {
        starburst: true,
        sky: SkyModel::Perez,
        method,
        even_stars: true,
        ..SkyParams::default()
    };
    for setting in SETTINGS {
        for one in setting.numbers() {
            *(one.place)(&mut params) = number;
        }
    }
    for one in OTHERS {
        *(one.place)(&mut params) = number;
    }
    params.perez.shape = PerezShape::Custom([number; 5]);
    // More than eight would only take longer to be clamped to eight.
    params.octaves.count = if number >= 1.0 { 4 } else { 0 };
    params.weather.lightning.start_s = number.into();
    for (layer, kind) in params.lit.layers.iter_mut().zip([0, 1, 2, 0, 1, 2]) {
        layer.kind = LayerKind::ALL[kind];
    }
    params
}

/// Each number of the lit method at its ends and beyond them, all else as it is.
fn lit_extremes() -> Vec<SkyParams> {
    let day = SkyParams {
        method: Method::Lit,
        ..SkyParams::default()
    };
    let with = |change: &dyn Fn(&mut LitParams)| {
        let mut params = day;
        change(&mut params.lit);
        params
    };
    let shares = |share: f32| {
        with(&|lit| {
            for layer in &mut lit.layers {
                layer.share = share;
            }
        })
    };
    let mut cases = vec![
        shares(0.0),
        shares(1e-30),
        shares(1.0),
        with(&|lit| (lit.k1, lit.k2) = (0.0, 0.0)),
        with(&|lit| (lit.k1, lit.k2, lit.m) = (0.0, 1.0, 0.5)),
        with(&|lit| (lit.k1, lit.k2, lit.m) = (1.0, 1.0, 16.0)),
        with(&|lit| (lit.k1, lit.k2, lit.m) = (0.0, 1.0, 16.0)),
        with(&|lit| (lit.flattening, lit.radius_m) = (0.02, 1e3)),
        with(&|lit| (lit.flattening, lit.radius_m) = (1.0, 1e6)),
    ];
    for wild in [f32::NAN, f32::INFINITY, -1.0, 0.0] {
        cases.extend([
            with(&|lit| lit.radius_m = wild),
            with(&|lit| lit.flattening = wild),
            with(&|lit| lit.formation_interval_s = wild),
            with(&|lit| lit.layers[0].height = wild),
            with(&|lit| lit.layers[2].velocity_m_s = [wild, -wild]),
        ]);
    }
    let covers = [0.0, 1e-6, 0.05, 0.95, 1.0].map(|cover| SkyParams { cover, ..day });
    cases.extend(covers);
    cases
}

#[test]
fn with_every_dome_layer_and_light_of_the_lit_method() {
    let mut cases = Vec::new();
    for params in lit_extremes() {
        assert_eq!(params.clamped().check(), Ok(()));
        for time in [0.0, 0.252, 0.5] {
            let params = SkyParams { time, ..params };
            let level = Camera::looking(1.0, 0.3, 1.5, SIZE);
            cases.push((params, level, 3.0));
            // The sun or the moon in the middle of the picture.
            let sun = mapping::sun_direction(time, noon_elevation_rad());
            let towards = if time == 0.0 { sun.map(|c| -c) } else { sun };
            let (azimuth, elevation) = mapping::angles_from_direction(towards);
            let view = Camera::looking(azimuth, elevation, 0.5, SIZE);
            cases.push((params, view, 1e6));
        }
    }
    assert_light(pack::default_pack(), &cases);
}

/// A parameter's key, and values of it that are out of its range.
type Refused = (&'static str, fn(&mut SkyParams, f32), Vec<f32>);

#[test]
fn settings_out_of_range_are_told_by_their_names() {
    let cases: [Refused; 19] = [
        (
            "lit.radius_m",
            |p, v| p.lit.radius_m = v,
            vec![999.0, 1.1e6],
        ),
        (
            "lit.flattening",
            |p, v| p.lit.flattening = v,
            vec![0.0, 0.019, 1.01],
        ),
        ("lit.k1", |p, v| p.lit.k1 = v, vec![-0.01, 1.01]),
        ("lit.k2", |p, v| p.lit.k2 = v, vec![-0.01, 1.01]),
        ("lit.m", |p, v| p.lit.m = v, vec![0.0, 0.49, 16.1]),
        (
            "lit.formation_interval_s",
            |p, v| p.lit.formation_interval_s = v,
            vec![0.0, 86_401.0],
        ),
        ("moon", |p, v| p.moon = v, vec![-0.1, 1.1]),
        (
            "lit.layers[0].share",
            |p, v| p.lit.layers[0].share = v,
            vec![-0.1, 1.1],
        ),
        (
            "lit.layers[5].share",
            |p, v| p.lit.layers[5].share = v,
            vec![-0.1, 1.1],
        ),
        (
            "lit.layers[1].height",
            |p, v| p.lit.layers[1].height = v,
            vec![0.0, 20.1],
        ),
        (
            "lit.layers[2].velocity_m_s[0]",
            |p, v| p.lit.layers[2].velocity_m_s[0] = v,
            vec![-201.0, 201.0],
        ),
        (
            "lit.layers[4].velocity_m_s[1]",
            |p, v| p.lit.layers[4].velocity_m_s[1] = v,
            vec![-201.0, 201.0],
        ),
        ("weather.rays", |p, v| p.weather.rays = v, vec![-0.1, 1.1]),
        ("weather.rain", |p, v| p.weather.rain = v, vec![-0.1, 1.1]),
        (
            "weather.lightning.strength",
            |p, v| p.weather.lightning.strength = v,
            vec![-0.1, 1.1],
        ),
        (
            "weather.lightning.start_s",
            |p, v| p.weather.lightning.start_s = v.into(),
            vec![-1.1e9, 1.1e9],
        ),
        (
            "weather.lightning.place_m[0]",
            |p, v| p.weather.lightning.place_m[0] = v,
            vec![-1.1e6, 1.1e6],
        ),
        (
            "weather.lightning.place_m[1]",
            |p, v| p.weather.lightning.place_m[1] = v,
            vec![-1.1e6, 1.1e6],
        ),
        (
            "shadow_extent_m",
            |p, v| p.shadow_extent_m = v,
            vec![-1.0, 1.1e6],
        ),
    ];
    assert_eq!(SkyParams::default().check(), Ok(()));
    let numbers = SETTINGS.iter().flat_map(|setting| setting.numbers());
    for number in numbers.chain(OTHERS) {
        let [low, high] = number.range;
        let beyond = [low - 0.1 - low.abs() * 0.1, high * 1.1, f32::NAN];
        for value in beyond.into_iter().chain([f32::INFINITY, f32::NEG_INFINITY]) {
            let mut params = SkyParams::default();
            *(number.place)(&mut params) = value;
            assert_eq!(params.check().expect_err("out of range").key, number.field);
            assert_eq!(params.clamped().check(), Ok(()), "{} {value}", number.field);
        }
    }
    for (key, set, values) in cases {
        let wild = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
        for value in values.into_iter().chain(wild) {
            let mut params = SkyParams::default();
            set(&mut params, value);
            let error = params.check().expect_err("out of range");
            assert_eq!(error.key, key);
            let message = error.to_string();
            let told = message.starts_with(&format!("{key} is {value}, expected a number from "));
            assert!(told, "{message}");
            assert_eq!(params.clamped().check(), Ok(()), "{key} {value}");
        }
    }
}

/// As in every frame.
#[test]
fn settings_are_checked_and_clamped_without_an_allocation() {
    let allocated = allocation_counter::measure(|| {
        let params = std::hint::black_box(SkyParams::default());
        assert!(params.clamped().check().is_ok());
    });
    assert_eq!(allocated.count_total, 0);
}

fn noon_elevation_rad() -> f32 {
    pack::default_pack().manifest().noon_elevation_rad
}

#[test]
fn with_parameters_out_of_range_and_not_numbers() {
    let mut cases = Vec::new();
    for wild in [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        -1.0,
        2.0,
        1e30,
        0.0,
        1.0,
    ] {
        for method in Method::ALL {
            let params = all(method, wild);
            cases.extend(views().into_iter().map(|view| (params, view, 3.0)));
            let alone = SkyParams {
                density: wild,
                cover: 0.0,
                method,
                ..SkyParams::default()
            };
            cases.extend(views().into_iter().map(|view| (alone, view, 3.0)));
        }
    }
    assert_light(pack::default_pack(), &cases);
}

#[test]
fn with_times_without_end_and_broken_cameras() {
    let params = SkyParams {
        speed: 1.0,
        ..SkyParams::default()
    };
    let view = Camera::looking(0.0, 0.5, 1.0, SIZE);
    let mut cases = Vec::new();
    for method in Method::ALL {
        let params = SkyParams { method, ..params };
        let ages = [f64::NAN, f64::INFINITY, -1e12, 1e12, 1e300];
        cases.extend(ages.map(|seconds| (params, view, seconds)));
        let far = [f32::NAN, f32::INFINITY, -1e6, 1e30].map(|metres| Camera {
            position_m: glam::Vec3::splat(metres),
            ..view
        });
        cases.extend(far.map(|view| (params, view, 5.0)));
    }
    let cameras = [
        Camera::looking(f32::NAN, 0.0, 1.0, SIZE),
        Camera::looking(0.0, 0.0, 0.0, SIZE),
        Camera::looking(0.0, 0.0, 10.0, [0, 0]),
        Camera::from_matrices(glam::Mat4::ZERO, glam::Mat4::ZERO, SIZE),
    ];
    for time in [0.0, 0.5] {
        cases.extend(cameras.map(|camera| (SkyParams { time, ..params }, camera, 0.0)));
    }
    assert_light(pack::default_pack(), &cases);
}
