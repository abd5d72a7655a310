//! A total eclipse as it is drawn: a dark disc, a ring of light around it, a dusk around the horizon.

use glam::Vec2;
use welkin_runtime::almanac::Place;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

#[test]
fn the_corona_is_a_ring_around_a_dark_disc() {
    let params = SkyParams {
        date: "2024-04-08T18:42:30Z".parse().ok(),
        place: Place {
            latitude_deg: 32.78,
            longitude_deg: -96.8,
        },
        cover: 0.0,
        ..SkyParams::default()
    };
    let facts = PackData::new(pack::default_pack()).expect("the pack has every role");
    let moon = facts.moment(&params, 0.0).moon;
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    // From a telescope to a wide view, in which the disc is four pixels wide and its edge is made of parts of pixels.
    for (fov_deg, size) in [(4.0_f32, [200, 200]), (60.0, [400, 400])] {
        let view = Camera::looking(
            moon.x.atan2(-moon.z),
            moon.y.asin(),
            fov_deg.to_radians(),
            size,
        );
        let texels = gpu::render(&mut sky, FORMAT, &params, &view, 0.0);
        // Pixels of a radius of the moon, 0.27 degrees.
        let radius =
            0.27_f32.to_radians() / (2.0 * (0.5 * fov_deg.to_radians()).tan()) * size[1] as f32;
        let middle = Vec2::new(size[0] as f32, size[1] as f32) * 0.5;
        let green = |from: f32, to: f32| {
            let all = texels.iter().enumerate().map(|(i, texel)| {
                let at = Vec2::new((i as u32 % size[0]) as f32, (i as u32 / size[0]) as f32) + 0.5;
                (at.distance(middle) / radius, texel[1])
            });
            let ring: Vec<f32> = all
                .filter(|(r, _)| (from..to).contains(r))
                .map(|(_, g)| g)
                .collect();
            assert!(!ring.is_empty());
            ring.iter().sum::<f32>() / ring.len() as f32
        };
        let sky_light = green(9.0, 10.0);
        if fov_deg < 10.0 {
            assert!(
                green(0.0, 0.9) < 0.5,
                "the disc is dark: {}",
                green(0.0, 0.9)
            );
            assert!(green(1.1, 1.4) > 20.0 * sky_light, "the inner corona");
            // Falls as the power -2.5 or faster: at three radii there is a sixth or less of what there is at a radius and a half.
            let [near, far] = [green(1.4, 1.6), green(2.9, 3.1)].map(|light| light - sky_light);
            assert!(far > 0.0 && far < near / 5.0, "{near} {far}");
        }
        // No pixel is as bright as one of the sun's own, thousands of whites.
        let brightest = texels.iter().map(|t| t[1]).fold(0.0, f32::max);
        assert!(brightest < 300.0, "{fov_deg}: {brightest}");
    }
}
