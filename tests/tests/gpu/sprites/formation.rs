//! Clouds form from their middle, and cover brings them.

use glam::{DVec3, Vec3};
use welkin_runtime::params::SpriteParams;
use welkin_runtime::{Method, SkyError, SkyParams};
use welkin_tests::{gpu, pack};

use super::{field, mean_difference, params, view, without_ring};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [96, 64];

fn formed(formation: f32) -> SkyParams {
    SkyParams {
        sprites: SpriteParams {
            formation,
            ..without_ring()
        },
        ..params()
    }
}

/// What the cloud changes at every pixel of a picture without it.
fn change(formation: f32) -> Vec<f32> {
    let pack = field::with(vec![field::heap([2000.0, 1200.0, 1000.0], 0.0)]);
    let camera = view(DVec3::new(2000.0, 1200.0, 2800.0), 0.0, 0.0, SIZE);
    let mut sky = gpu::sky(&pack, FORMAT);
    let mut draw = |formation| {
        gpu::rgb(&gpu::render(
            &mut sky,
            FORMAT,
            &formed(formation),
            &camera,
            0.0,
        ))
    };
    let (without, with) = (draw(0.0), draw(formation));
    without
        .iter()
        .zip(&with)
        .map(|(a, b): (&Vec3, &Vec3)| (*a - *b).length())
        .collect()
}

#[test]
fn the_core_comes_before_the_edges() {
    // Columns within a quarter of the cloud's width from its middle, and those beyond.
    let sums = |change: &[f32]| {
        let mut sums = [0.0; 2];
        for row in change.chunks_exact(SIZE[0] as usize) {
            for (x, value) in row.iter().enumerate() {
                let off = (x as f32 - 0.5 * SIZE[0] as f32).abs();
                sums[usize::from(off > 0.13 * SIZE[0] as f32)] += value;
            }
        }
        sums
    };
    let [whole_core, whole_edge] = sums(&change(1.0));
    let mut last = [0.0; 2];
    for step in 1..=6 {
        let amount = step as f32 / 6.0;
        let [core, edge] = sums(&change(amount));
        println!(
            "{amount:.2}: core {:.2}, edge {:.2}",
            core / whole_core,
            edge / whole_edge
        );
        assert!(core > last[0] && edge >= last[1], "it grows");
        assert!(core / whole_core >= edge / whole_edge - 1e-4, "core first");
        last = [core, edge];
    }
    assert_eq!(change(0.0).iter().copied().fold(0.0, f32::max), 0.0);
}

#[test]
fn more_cover_is_more_cloud_and_none_is_the_dome_alone() {
    let camera = view(DVec3::new(0.0, 2.0, 0.0), 30.0, 25.0, SIZE);
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let at = |cover: f32| SkyParams { cover, ..params() };
    let mut draw =
        |params: &SkyParams| gpu::rgb(&gpu::render(&mut sky, FORMAT, params, &camera, 0.0));
    let clear = draw(&at(0.0));
    let dome = draw(&SkyParams {
        method: Method::Packed,
        ..at(0.0)
    });
    assert_eq!(clear, dome);
    let shown: Vec<f32> = [0.1, 0.3, 0.5, 0.7]
        .map(|cover| mean_difference(&draw(&at(cover)), &clear))
        .to_vec();
    assert!(shown.windows(2).all(|pair| pair[1] > pair[0]), "{shown:?}");
}

/// The same moment is the same sky, whatever was before it, and moments far away are as good.
#[test]
fn any_moment_is_drawn_at_once() {
    let camera = view(DVec3::new(0.0, 2.0, 0.0), 30.0, 25.0, SIZE);
    let params = SkyParams {
        cover: 0.5,
        speed: 0.5,
        ..params()
    };
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut at = |seconds: f64| gpu::render(&mut sky, FORMAT, &params, &camera, seconds);
    let first = at(1e6);
    let others: Vec<_> = [0.0, 100.0, 350.0].map(&mut at).to_vec();
    assert!(others.windows(2).all(|pair| pair[0] != pair[1]));
    assert_eq!(at(1e6), first);
}

/// Every method's dome may be behind the sprites: without any, the picture is that method's own.
#[test]
fn without_sprites_the_dome_behind_is_all_there_is() {
    let camera = view(DVec3::new(300.0, 2.0, 0.0), 30.0, 25.0, SIZE);
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut draw = |params: &SkyParams| gpu::render(&mut sky, FORMAT, params, &camera, 20.0);
    for method in Method::DOMES {
        let own = SkyParams {
            method,
            cover: 0.5,
            ..params()
        };
        let behind = SkyParams {
            method: Method::Sprites,
            cover: 0.0,
            sprites: SpriteParams {
                behind: method,
                behind_cover: 0.5,
                ..without_ring()
            },
            ..own
        };
        assert!(draw(&own) == draw(&behind), "{method:?}");
        let with = SkyParams {
            cover: 0.6,
            ..behind
        };
        assert!(draw(&with) != draw(&behind), "{method:?}");
    }
}

#[test]
fn a_pack_without_a_field_is_told_and_draws_the_dome_alone() {
    let pack = pack::changed_pack(None, |_, _| {});
    assert!(pack.field().is_none());
    let camera = view(DVec3::new(0.0, 2.0, 0.0), 30.0, 25.0, SIZE);
    let mut sky = gpu::sky(&pack, FORMAT);
    assert_eq!(sky.supports(Method::Sprites), Err(SkyError::MissingField));
    assert_eq!(sky.supports(Method::Lit), Ok(()));
    let at = |cover: f32| SkyParams { cover, ..params() };
    let mut draw = |params: &SkyParams| gpu::render(&mut sky, FORMAT, params, &camera, 0.0);
    assert!(draw(&at(0.7)) == draw(&at(0.0)));
}
