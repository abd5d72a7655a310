//! The disc of sun and moon on a display.

use glam::Vec3;
use welkin_runtime::internals::clear_sky::light::SUN_RADIUS_RAD;
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const SIZE: [u32; 2] = [64, 64];

/// A pixel that the disc covers by half is as bright as its half: so as many pixels are white as the disc has area, however much brighter
/// than white it is. If every pixel that it touches were, they would be those of a disc half a pixel wider.
#[test]
fn the_disc_is_as_large_as_it_is() {
    let facts = PackData::new(pack::default_pack()).expect("the pack has every role");
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for time in [0.03, 0.5] {
        let params = SkyParams {
            time,
            cover: 0.0,
            stars: false,
            dither: false,
            // Short, so that what a lens scatters about it is dark.
            exposure_ev: if time == 0.5 { -9.0 } else { -4.0 },
            ..SkyParams::default()
        };
        let anywhere = Camera::looking(0.0, 0.5, 0.1, SIZE);
        let sun: Vec3 = facts
            .uniforms(&params, &anywhere, 0.0, 0.0)
            .sky
            .sun_direction;
        let azimuth_rad = sun.x.atan2(-sun.z);
        for radius_px in [3.0_f32, 6.0] {
            let fov_rad = SUN_RADIUS_RAD / radius_px * SIZE[1] as f32;
            // Not in the middle of a pixel.
            let view = Camera::looking(
                azimuth_rad,
                sun.y.asin() + 0.2 * fov_rad / 64.0,
                fov_rad,
                SIZE,
            );
            let pixels = gpu::rgb(&gpu::render(&mut sky, FORMAT, &params, &view, 0.0));
            let white = pixels
                .iter()
                .filter(|&&p| luminance(p) > 240.0 / 255.0)
                .count() as f32;
            let disc = std::f32::consts::PI * radius_px * radius_px;
            let wider = disc * (1.0 + 0.5 / radius_px).powi(2);
            println!(
                "{time}: {white} white pixels of a disc of {disc}, {wider} with half a pixel more"
            );
            assert!(
                (white / disc - 1.0).abs() < 0.15,
                "{time}: {white} of {disc}"
            );
        }
    }
}
