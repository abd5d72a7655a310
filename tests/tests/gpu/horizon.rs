//! The horizon: a line to who stands on the ground, none to who flies, whatever the method, the model of the clear sky, the time and the
//! cover.

use std::f32::consts::TAU;

use glam::Vec3;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::params::SkyModel;
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Columns of a strip.
const WIDTH: u32 = 24;

/// What the roots of a small angle in 32 bits are worth, over the radiance: 1e-7 of 1e-4, twice under a root, times the slope of some rows.
const ANGLE: f32 = 1e-4;

/// A bilinear weight has 8 bits.
const WEIGHT: f32 = 1.0 / 256.0;

/// The most that the two lowest rows of the clear sky's picture are apart, over themselves.
fn rows_apart(data: &PackData, params: &SkyParams) -> f32 {
    let image = data.lit_sky(params, 0.0).view.image();
    let colour = |x: u32, y: u32| Vec3::from_slice(&image.texel(x, y)[..3]);
    let apart = (0..image.width).map(|x| {
        let [low, high] = [0, 1].map(|y| colour(x, y));
        ((high - low).abs() / low.max(Vec3::splat(1e-6))).max_element()
    });
    apart.fold(0.0, f32::max)
}

/// The sun's own disc has an edge; the flare is no sky.
fn skies() -> Vec<SkyParams> {
    let mut skies = Vec::new();
    for method in Method::DOMES {
        for sky in SkyModel::ALL {
            // Noon, a sun at 4 degrees, night.
            for time in [0.5, 0.265, 0.0] {
                for cover in [0.6, 1.0] {
                    skies.push(SkyParams {
                        method,
                        sky,
                        time,
                        cover,
                        sun: false,
                        flare: 0.0,
                        ..SkyParams::default()
                    });
                }
            }
        }
    }
    skies
}

fn name(params: &SkyParams) -> String {
    let (method, sky) = (params.method.name(), params.sky.name());
    format!(
        "{method}, {sky}, time {}, cover {}",
        params.time, params.cover
    )
}

/// A strip of a picture around the horizon, row by row from below it to above it: rows `pitch` apart (in tangents of the
/// elevation), the middle two of them half of that below and above the horizon.
fn strip(
    sky: &mut Sky,
    params: &SkyParams,
    height_m: f32,
    azimuth_rad: f32,
    pitch: f32,
    rows: u32,
) -> Vec<Vec<Vec3>> {
    let half_height = 0.5 * pitch * rows as f32;
    let view = Camera {
        // A sixth of the horizon.
        aspect: (TAU / 12.0).tan() / half_height,
        position_m: Vec3::new(0.0, height_m, 0.0),
        ..Camera::looking(azimuth_rad, 0.0, 2.0 * half_height.atan(), [WIDTH, rows])
    };
    let texels = gpu::rgb(&gpu::render(sky, FORMAT, params, &view, 30.0));
    let rows = texels.chunks_exact(WIDTH as usize).rev();
    rows.map(<[Vec3]>::to_vec).collect()
}

/// Azimuths of the strips: that of the low sun and that of noon.
const AZIMUTHS: [f32; 2] = [0.25 * TAU, 0.5 * TAU];

/// From 500 m up the picture is continuous over the horizon: near it, air hides the ground.
///
/// Above it the table's rows go with the root of the elevation, below it nothing of the ground is left. So the step from
/// one side to the other is `J + b sqrt(h) + c h` at a distance h, J the edge; and from three distances, each a quarter of the one
/// before, J is `(D - 6 D' + 8 D'') / 3`. Clouds, haze and stars begin with no slope: they add terms of higher order only.
#[test]
fn there_is_no_edge_however_near_one_looks() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut worst = 0.0_f32;
    let data = PackData::new(pack::default_pack()).expect("the pack has every role");
    for params in skies() {
        let rows = rows_apart(&data, &params);
        for azimuth in AZIMUTHS {
            let steps = [2e-3, 5e-4, 1.25e-4].map(|pitch| {
                // Ten rows, since no camera sees less than a thousandth of a radian.
                let rows = strip(&mut sky, &params, 500.0, azimuth, pitch, 10);
                let pairs = rows[4].iter().zip(&rows[5]);
                pairs
                    .map(|(below, above)| (*above - *below, *above))
                    .collect::<Vec<_>>()
            });
            for (column, &(nearest, above)) in steps[2].iter().enumerate() {
                let [wide, near] = [0, 1].map(|i: usize| steps[i][column].0);
                let edge = (wide - 6.0 * near + 8.0 * nearest).abs() / 3.0;
                // Each of the steps is off by a weight of 8 bits between two rows and by what 32 bits leave of small angles.
                let bound = above * (15.0 / 3.0 * (WEIGHT * rows + ANGLE)) + 1e-6;
                let share = (edge / bound).max_element();
                worst = worst.max(share);
                assert!(
                    share < 1.0,
                    "{} at azimuth {azimuth}, column {column}: {edge}, at most {bound}",
                    name(&params)
                );
            }
        }
    }
    println!("edges are within {worst:.2} of rounding");
}

/// Who stands on the ground sees where it ends by day: a third of a degree below the horizon it is darker than the sky a third above, if less so
/// under Perez's sky, whose horizon is dim.
#[test]
fn from_the_ground_the_horizon_is_a_line() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for params in skies()
        .iter()
        .filter(|params| params.time == 0.5 && params.cover < 1.0)
    {
        let rows = strip(&mut sky, params, 1.7, 0.5 * TAU, 1.2e-2, 2);
        for (below, above) in rows[0].iter().zip(&rows[1]) {
            let most = match params.sky {
                SkyModel::Table => 0.7,
                SkyModel::Perez => 0.85,
            };
            assert!(
                below.y < most * above.y,
                "{}: {below} {above}",
                name(params)
            );
        }
    }
}
