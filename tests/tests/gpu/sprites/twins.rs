//! GPU and CPU agree on sprites, pixel by pixel.

use glam::{DVec3, Vec2, Vec3};
use welkin_pack::Role;
use welkin_pack::field::SECTION_SIDE_M;
use welkin_runtime::internals::sprites::exposures::Exposures;
use welkin_runtime::internals::sprites::grid::{BlockId, around};
use welkin_runtime::internals::sprites::instances::{Instance, sections};
use welkin_runtime::internals::sprites::outline::{BOXES_BEYOND_M, outlines};
use welkin_runtime::internals::sprites::pipelines::SpriteBlock;
use welkin_runtime::internals::sprites::station::SpriteView;
use welkin_runtime::internals::sprites::{SOFT, formation};
use welkin_runtime::params::{Lightning, Shading, SkyModel, SpriteParams};
use welkin_runtime::{Camera, SkyParams};
use welkin_tests::renderer::{FILTER_STEP, Frame, Twin};
use welkin_tests::sprites::{Inputs, Placed, along, placed};
use welkin_tests::texture::Texture;
use welkin_tests::{camera, compare, gpu};

use super::{field, params, view, without_ring};

const SIZE: [u32; 2] = [80, 60];

/// Every sprite as it stands for a viewer, the farthest first. The field neither drifts nor is it lifted.
fn stand(inputs: &Inputs, params: &SkyParams, viewer: DVec3, seconds: f64) -> Vec<Placed> {
    let field = field::two_clouds().field().unwrap();
    let all = sections(field);
    let mut found: Vec<(f32, Placed)> = Vec::new();
    // As blocks are drawn: the farthest block first, and in it the farthest sprite.
    let mut blocks: Vec<BlockId> = around(viewer, f64::from(params.sprites.distance_m)).collect();
    blocks.sort_by(|a, b| {
        b.distance_of_middle_m(viewer)
            .total_cmp(&a.distance_of_middle_m(viewer))
    });
    for block in blocks {
        let corner = block.corner_m();
        let origin = (DVec3::new(corner.x, 0.0, corner.y) - viewer).as_vec3();
        let far = block.distance_of_middle_m(viewer) > f64::from(BOXES_BEYOND_M);
        let uniform = SpriteBlock {
            origin,
            opacity: 1.0,
            section: SECTION_SIDE_M
                * Vec2::new((block.index(2) % 2) as f32, (block.index(2) / 2) as f32),
            vertices_log2: if far { 2 } else { 3 },
            ..Default::default()
        };
        let mut own: Vec<&Instance> = all[block.index(2)].instances.iter().collect();
        let distance = |i: &Instance| (origin + i.centre_m()).length();
        own.sort_by(|a, b| distance(b).total_cmp(&distance(a)));
        for instance in own {
            let rank = field.clouds[instance.cloud()].rank;
            let amount = formation::amount(instance.cloud(), rank, params, seconds);
            // As the device holds it: a byte.
            let amount = (amount * 255.0).round() / 255.0;
            let sprite = placed(inputs, instance, &uniform, amount);
            found.extend(sprite.map(|sprite| (distance(instance), sprite)));
        }
    }
    found.into_iter().map(|(_, sprite)| sprite).collect()
}

/// The picture, with every read of the sheet off by so much in grey and alpha.
fn picture(frame: &Frame, inputs: &Inputs, sprites: &[Placed], off: [f32; 2]) -> Vec<Vec3> {
    let mut behind = frame.render().into_iter();
    let uniforms = &frame.uniforms;
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
    pixels
        .map(|[x, y]| {
            let pixel = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let ray = camera::ray_of(&uniforms.camera, pixel);
            let mut colour = behind.next().unwrap();
            for sprite in sprites {
                if let Some((radiance, alpha)) = along(inputs, sprite, ray) {
                    let relief = sprite.corners[0].1.relief() * off[0];
                    let alpha = if alpha > 0.0 {
                        (alpha + off[1]).clamp(0.0, 1.0)
                    } else {
                        0.0
                    };
                    colour = colour.lerp(radiance + relief, alpha);
                }
            }
            colour
        })
        .collect()
}

fn cases() -> Vec<(&'static str, SkyParams, Camera)> {
    let defaults = params();
    let south_of = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let ground = view(south_of(2000.0, 2.0, 2600.0), 0.0, 35.0, SIZE);
    let beside = view(south_of(3300.0, 1250.0, 1100.0), 270.0, 0.0, SIZE);
    let above = view(south_of(2000.0, 3600.0, 2500.0), 0.0, -50.0, SIZE);
    let below = view(south_of(2100.0, 100.0, 1100.0), 90.0, 88.0, SIZE);
    let far = view(south_of(2000.0, 2.0, 9000.0), 0.0, 8.0, SIZE);
    let forming = SkyParams {
        sprites: SpriteParams {
            formation: 0.6,
            ..without_ring()
        },
        ..defaults
    };
    let billboards = SkyParams {
        sprites: SpriteParams {
            billboards_beyond_m: 8500.0,
            ..without_ring()
        },
        ..defaults
    };
    let sunset = SkyParams {
        time: 0.74,
        sunset: 1.0,
        density: 1.0,
        ..defaults
    };
    let perez = SkyParams {
        sky: SkyModel::Perez,
        ..defaults
    };
    let night = SkyParams {
        time: 0.95,
        ..defaults
    };
    let paper = SkyParams {
        shading: Shading::Paper,
        ..defaults
    };
    let paper_sunset = SkyParams {
        shading: Shading::Paper,
        ..sunset
    };
    let mut stormy = SkyParams {
        time: 0.8,
        ..defaults
    };
    stormy.weather.lightning = Lightning {
        strength: 1.0,
        start_s: -0.01,
        place_m: [2300.0, 900.0],
    };
    vec![
        ("ground", defaults, ground),
        ("beside", defaults, beside),
        ("above", defaults, above),
        ("below", defaults, below),
        ("far", defaults, far),
        ("forming", forming, ground),
        ("billboards", billboards, far),
        ("sunset", sunset, ground),
        ("perez", perez, ground),
        ("night", night, ground),
        ("paper", paper, ground),
        ("paper at sunset", paper_sunset, ground),
        ("lightning", stormy, ground),
    ]
}

#[test]
fn radiance_of_sprites_agrees_in_a_float_target() {
    let format = wgpu::TextureFormat::Rgba16Float;
    let pack = field::two_clouds();
    let mut sky = gpu::sky(pack, format);
    let twin = Twin::new(pack);
    let [clouds, sheet] = [Role::Clouds, Role::Sprites].map(|role| Texture::new(pack, role));
    let outlines = outlines(pack.texture(Role::Sprites).unwrap());
    let exposures = Exposures::new(pack.field().unwrap());
    for (name, params, camera) in cases() {
        sky.reset_history();
        let actual = gpu::rgb(&gpu::render(&mut sky, format, &params, &camera, 0.0));
        let frame = twin.frame(&params, &camera, 0.0);
        let uniforms = &frame.uniforms;
        let pixel = 2.0
            * (uniforms.camera.right.length() / uniforms.camera.width_px)
                .max(uniforms.camera.up.length() / uniforms.camera.height_px);
        let view = SpriteView {
            height_m: camera.position_m.y,
            pixel_rad: SOFT * pixel,
            cell_texels: 128.0,
            ..Default::default()
        };
        let inputs = Inputs {
            uniforms,
            view: &view,
            clouds: &clouds,
            sky: &frame.sky,
            sheet: &sheet,
            outlines: &outlines,
            exposures: &exposures,
        };
        let lifted = camera.position_m.as_dvec3();
        let sprites = stand(&inputs, &params, lifted, 0.0);
        let expected = picture(&frame, &inputs, &sprites, [0.0; 2]);
        let step = FILTER_STEP;
        let off = [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]]
            .map(|off| picture(&frame, &inputs, &sprites, off));
        // What a step of 8-bit filtering in grey and in alpha is worth, 2 % for half floats and the exponentials of a GPU.
        let bounds: Vec<Vec3> = (0..expected.len())
            .map(|i| {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k: usize| (off[k][i] - expected[i]).abs());
                a.max(b) + c.max(d) + 0.02 * expected[i].abs() + 1e-4
            })
            .collect();
        let scaled = |picture: &[Vec3]| -> Vec<Vec3> {
            picture.iter().zip(&bounds).map(|(p, b)| *p / *b).collect()
        };
        let difference = compare::difference(&scaled(&expected), &scaled(&actual), |_| 1.0);
        println!("{name}: {} sprites, {difference:?}", sprites.len());
        assert!(!sprites.is_empty(), "{name}");
        if difference.worst > 1.0 || difference.mean > 0.25 {
            let picture = compare::save(&format!("twins_sprites_{name}"), &expected, &actual, SIZE);
            panic!("{name}: {difference:?}; see {}", picture.display());
        }
    }
}
