//! A flight through clouds: no frame leaps.

use glam::DVec3;
use welkin_pack::Pack;
use welkin_runtime::SkyParams;
use welkin_runtime::params::SpriteParams;
use welkin_tests::{gpu, pack};

use super::{mean_difference, params, view, without_ring};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const SIZE: [u32; 2] = [128, 72];
const FRAMES: u32 = 300;

/// Changes from frame to frame on a straight way of so many metres a frame, with what is drawn for each.
fn changes(pack: &Pack, params: &SkyParams, from: DVec3, step_m: DVec3) -> Vec<f32> {
    let mut sky = gpu::sky(pack, FORMAT);
    let mut last = None;
    let mut changes = Vec::new();
    for frame in 0..=FRAMES {
        let place = from + step_m * f64::from(frame);
        let azimuth = (step_m.x.atan2(-step_m.z) as f32).to_degrees();
        let camera = view(place, azimuth, 0.0, SIZE);
        let now = gpu::rgb(&gpu::render(&mut sky, FORMAT, params, &camera, 0.0));
        changes.extend(last.map(|last: Vec<_>| mean_difference(&last, &now)));
        last = Some(now);
    }
    changes
}

/// The largest change over the median of all.
fn largest_over_median(changes: &[f32]) -> f32 {
    let mut sorted = changes.to_vec();
    sorted.sort_by(f32::total_cmp);
    sorted[sorted.len() - 1] / sorted[sorted.len() / 2]
}

/// The largest change over the larger of its two neighbours: what leaps and is still before and after.
fn spike(changes: &[f32]) -> f32 {
    let over = |w: &[f32]| w[1] / w[0].max(w[2]);
    changes.windows(3).map(over).fold(0.0, f32::max)
}

/// Two flights of 300 frames through clouds: no change is larger than three and a half times the median (what is dark beside what is bright makes it, and
/// so the light and the tone curve do: Hable's gives 3.1, the default 3.4). And nowhere does the picture leap: as a
/// sprite comes near and is passed, changes rise and fall over many frames.
///
/// From clear air into a cloud the median says nothing, since changes in it are six times as large, frame for frame. And deep in a sheet
/// large sprites close to the viewer may change places, which is a leap that docs/sprites.md tells of: no flight here meets one.
#[test]
fn a_flight_of_300_frames_has_no_leap() {
    let flights = [
        (
            0.5,
            DVec3::new(2000.0, 1300.0, 1000.0),
            DVec3::new(0.0, 0.3, -5.0),
        ),
        (
            0.7,
            DVec3::new(7000.0, 1350.0, 2000.0),
            DVec3::new(3.0, 0.0, -3.0),
        ),
    ];
    for (cover, from, step) in flights {
        for ring_radius_m in [0.0, SpriteParams::default().ring_radius_m] {
            let params = SkyParams {
                cover,
                sprites: SpriteParams {
                    ring_radius_m,
                    ..without_ring()
                },
                ..params()
            };
            let changes = changes(pack::default_pack(), &params, from, step);
            let (largest, spike) = (largest_over_median(&changes), spike(&changes));
            println!(
                "{from}, ring {ring_radius_m}: {largest:.2} of the median, {spike:.2} of its neighbours"
            );
            assert!(largest <= 3.5, "{from}, ring {ring_radius_m}: {largest}");
            assert!(spike <= 2.0, "{from}, ring {ring_radius_m}: {spike}");
        }
    }
}
