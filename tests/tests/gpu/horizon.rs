//! No hard edge at the horizon, whatever the method, the model of the clear sky, the time and the cover.

use std::f32::consts::TAU;

use glam::Vec3;
use welkin_runtime::internals::clear_sky::gradient::GROUND_FALL;
use welkin_runtime::params::SkyModel;
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Columns of a strip.
const WIDTH: u32 = 24;

/// What a half float may be off by, over itself.
const HALF: f32 = 1.0 / 2048.0;

/// The sun's own disc and glow have an edge in the haze, of 1.4 degrees; the flare is no sky.
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
    azimuth_rad: f32,
    pitch: f32,
    rows: u32,
) -> Vec<Vec<Vec3>> {
    let half_height = 0.5 * pitch * rows as f32;
    let view = Camera {
        // A sixth of the horizon.
        aspect: (TAU / 12.0).tan() / half_height,
        ..Camera::looking(azimuth_rad, 0.0, 2.0 * half_height.atan(), [WIDTH, rows])
    };
    let texels = gpu::rgb(&gpu::render(sky, FORMAT, params, &view, 30.0));
    let rows = texels.chunks_exact(WIDTH as usize).rev();
    rows.map(<[Vec3]>::to_vec).collect()
}

/// Azimuths of the strips: that of the low sun and that of noon.
const AZIMUTHS: [f32; 2] = [0.25 * TAU, 0.5 * TAU];

/// The picture is continuous over the horizon.
///
/// Above it the gradient's rows go with the root of the elevation, below it the ground begins with a slope. So the step from
/// one side to the other is `J + b sqrt(h) + c h` at a distance h, J the edge; and from three distances, each a quarter of the one
/// before, J is `(D - 6 D' + 8 D'') / 3`. Clouds, haze and stars begin with no slope: they add terms of higher order only.
#[test]
fn there_is_no_edge_however_near_one_looks() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut worst = 0.0_f32;
    for params in skies() {
        for azimuth in AZIMUTHS {
            let steps = [8e-3, 2e-3, 5e-4].map(|pitch| {
                let rows = strip(&mut sky, &params, azimuth, pitch, 2);
                let pairs = rows[0].iter().zip(&rows[1]);
                pairs
                    .map(|(below, above)| (*above - *below, *above))
                    .collect::<Vec<_>>()
            });
            for (column, &(nearest, above)) in steps[2].iter().enumerate() {
                let [wide, near] = [0, 1].map(|i: usize| steps[i][column].0);
                let edge = (wide - 6.0 * near + 8.0 * nearest).abs() / 3.0;
                // Each of the steps is off by two half floats; and what 32 bits leave of the dark.
                let bound = above * (2.0 * 15.0 / 3.0 * HALF) + 1e-6;
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
    println!("edges are within {worst:.2} of half floats");
}

/// In a picture as one draws it, rows of a third of a degree, the step over the horizon is no larger than those beside it make it.
///
/// The root that goes from 0 to half a row is 1.37 times what it goes from there to one and a half; all else above rises by
/// less. Below, the ground darkens by `1 / (1 + s y)` from its full slope: half a row of that is 1 / 2 of the next one, and
/// by the product of slope and row more.
#[test]
fn the_step_over_the_horizon_is_one_among_others() {
    let (pitch, half) = (6e-3, 5);
    let below_share = 0.5 * (1.0 + GROUND_FALL * pitch);
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut worst = 0.0_f32;
    for params in skies() {
        for azimuth in AZIMUTHS {
            let rows = strip(&mut sky, &params, azimuth, pitch, 2 * half as u32);
            for (column, &here) in rows[half].iter().enumerate() {
                let step = |i: usize| (rows[i + 1][column] - rows[i][column]).abs();
                let above = (half..2 * half - 1).map(step).fold(Vec3::ZERO, Vec3::max);
                let below = step(half - 2);
                let noise = here * (4.0 * HALF) + 1e-6;
                let bound = 1.37 * above + below_share * below + noise;
                let share = (step(half - 1) / bound).max_element();
                worst = worst.max(share);
                assert!(
                    share < 1.0,
                    "{} at azimuth {azimuth}, column {column}: {}, at most {bound}",
                    name(&params),
                    step(half - 1)
                );
            }
        }
    }
    println!("steps are within {worst:.2} of what they may be");
}
