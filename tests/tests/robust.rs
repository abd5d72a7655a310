//! No parameter, camera, sun or time makes a pixel that is not a finite, positive amount of light.

use welkin_pack::Pack;
use welkin_runtime::{
    Camera, FbmParams, Method, OctaveParams, PerezParams, PerezShape, SkyModel, SkyParams,
};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [65, 49];

fn assert_light(pack: &Pack, cases: &[(SkyParams, Camera, f64)]) {
    let mut sky = gpu::sky(pack, FORMAT);
    for (params, camera, seconds) in cases {
        let target = gpu::target(FORMAT, SIZE, 1);
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

/// Every number set to the same.
fn all(method: Method, number: f32) -> SkyParams {
    SkyParams {
        cover: number,
        height: number,
        density: number,
        sunset: number,
        speed: number,
        time: number,
        upper_layer: number,
        exposure: number,
        dither: true,
        sky: SkyModel::Perez,
        perez: PerezParams {
            shape: PerezShape::Custom([number; 5]),
            turbidity: number,
        },
        method,
        octaves: OctaveParams {
            // More than eight would only take longer to be clamped to eight.
            count: if number >= 1.0 { 4 } else { 0 },
            sharpness: number,
            formation_interval_s: number,
            domes: [number; 3],
        },
        fbm: FbmParams {
            sharpness: number,
            lit: [number; 3],
            shaded: [number; 3],
        },
        sun: true,
        stars: true,
        flare: number,
        skybox: number,
    }
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
