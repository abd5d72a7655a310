//! The sea below the horizon: its twin, its light, and what it leaves alone.

use glam::Vec3;
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{compare, gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [64, 48];

fn sea(method: Method, time: f32) -> SkyParams {
    SkyParams {
        method,
        time,
        sea: true,
        flare: 0.0,
        ..SkyParams::default()
    }
}

fn view(azimuth_deg: f32, elevation_deg: f32) -> Camera {
    let [azimuth, elevation] = [azimuth_deg, elevation_deg].map(f32::to_radians);
    Camera::looking(azimuth, elevation, 1.05, SIZE)
}

/// Pixel by pixel, towards the sun and away from it, by day and by moonlight.
#[test]
fn a_sea_is_the_twins() {
    let twin = Twin::new(pack::default_pack());
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let rough = SkyParams {
        waves: 1.0,
        cover: 0.95,
        ..sea(Method::Lit, 0.4)
    };
    for (name, params, view, seconds) in [
        ("noon", sea(Method::Packed, 0.45), view(120.0, -20.0), 3.0),
        (
            "evening",
            sea(Method::Octaves, 0.73),
            view(262.0, -12.0),
            900.0,
        ),
        ("fbm", sea(Method::Fbm, 0.6), view(20.0, -60.0), 1e6),
        ("rough", rough, view(40.0, -8.0), 12.0),
        (
            "moonlight",
            sea(Method::Packed, 0.06),
            view(200.0, -15.0),
            0.0,
        ),
    ] {
        let actual = gpu::rgb(&gpu::render(&mut sky, FORMAT, &params, &view, seconds));
        let mut frame = twin.frame_without_map(&params, &view, seconds);
        frame.map = gpu::read_map(&sky);
        let expected = frame.render();
        let off = frame.filter_steps();
        let worth = frame.worth_of_reads(&off, |frame| frame.render());
        // 3 % for half floats, bilinear weights and the exponentials of a GPU, of which the glitter has several.
        let bounds: Vec<Vec3> = worth
            .iter()
            .zip(&expected)
            .map(|(worth, e)| *worth + 0.03 * e.abs() + 1e-4)
            .collect();
        let difference = compare::in_bounds([&expected, &actual], &bounds);
        println!("{name}: {difference:?}");
        if difference.worst > 1.0 || difference.mean > 0.25 {
            let picture = compare::save(&format!("sea_{name}"), &expected, &actual, SIZE);
            let index = difference.pixel;
            panic!(
                "{name}: {difference:?}: {} {}; see {}",
                expected[index],
                actual[index],
                picture.display()
            );
        }
    }
}

/// Nothing above the horizon knows of it.
#[test]
fn the_sky_over_a_sea_is_that_over_land() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for method in Method::ALL {
        let params = sea(method, 0.6);
        let land = SkyParams {
            sea: false,
            ..params
        };
        let up = view(250.0, 60.0);
        let [one, other] =
            [params, land].map(|params| gpu::render(&mut sky, FORMAT, &params, &up, 2.0));
        assert!(one == other, "{method:?}");
    }
}

/// The path of the sun's glitter lies below the sun, and rougher water has a wider one that is less bright.
#[test]
fn glitter_lies_below_the_sun_and_widens_with_the_waves() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut of = |waves: f32| {
        let params = SkyParams {
            cover: 0.0,
            waves,
            sun: false,
            ..sea(Method::Packed, 0.68)
        };
        let sun = sky.light(&params, 0.0).sun.direction;
        let azimuth_deg = sun.x.atan2(-sun.z).to_degrees();
        let below = view(azimuth_deg, -sun.y.asin().to_degrees());
        let pixels = gpu::rgb(&gpu::render(&mut sky, FORMAT, &params, &below, 0.0));
        // Column by column, over the rows below the horizon.
        let columns: Vec<f32> = (0..SIZE[0])
            .map(|x| {
                let rows = SIZE[1] / 2..SIZE[1];
                rows.map(|y| luminance(pixels[(y * SIZE[0] + x) as usize]))
                    .sum()
            })
            .collect();
        let least = columns.iter().copied().fold(f32::MAX, f32::min);
        let lights: Vec<f32> = columns.iter().map(|light| light - least).collect();
        let sum: f32 = lights.iter().sum();
        let place = |x: usize| x as f32 + 0.5 - 0.5 * SIZE[0] as f32;
        let middle = lights
            .iter()
            .enumerate()
            .map(|(x, l)| l * place(x))
            .sum::<f32>()
            / sum;
        let spread = lights
            .iter()
            .enumerate()
            .map(|(x, l)| l * (place(x) - middle).powi(2))
            .sum::<f32>()
            / sum;
        let most = lights.iter().copied().fold(0.0_f32, f32::max);
        println!(
            "waves {waves}: middle {middle:.2}, width {:.2}, most {most:.2}",
            spread.sqrt()
        );
        (middle, spread.sqrt(), most)
    };
    let (calm, rough) = (of(0.0), of(1.0));
    assert!(
        calm.0.abs() < 2.5 && rough.0.abs() < 2.5,
        "{calm:?} {rough:?}"
    );
    assert!(
        rough.1 > 1.3 * calm.1 && rough.2 < 0.7 * calm.2,
        "{calm:?} {rough:?}"
    );
}
