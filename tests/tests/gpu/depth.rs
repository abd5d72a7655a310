//! The sky stands behind the scene, with either depth convention, and with four samples a pixel.

use welkin_pack::mapping;
use welkin_runtime::{Camera, DepthConfig, Method, Sky, SkyConfig, SkyError, SkyParams};
use welkin_tests::{gpu, pack};

const SIZE: [u32; 2] = [64, 48];
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The left half of the screen in magenta, at half depth.
const SCENE: &str = "
@vertex fn vs(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) - 1.0, f32(i >> 1u) * 2.0 - 1.0, 0.5, 1.0);
}
@fragment fn fs() -> @location(0) vec4f { return vec4f(1.0, 0.0, 1.0, 1.0); }
";

fn scene(samples: u32, reversed: bool, format: wgpu::TextureFormat) -> wgpu::RenderPipeline {
    let device = &gpu::gpu().device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(SCENE.into()),
    });
    let compare = if reversed {
        wgpu::CompareFunction::Greater
    } else {
        wgpu::CompareFunction::Less
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vs"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState {
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(compare),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState {
            count: samples,
            ..Default::default()
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fs"),
            compilation_options: Default::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn new_sky(config: SkyConfig) -> Result<Sky, SkyError> {
    Sky::new(
        &gpu::gpu().device,
        &gpu::gpu().queue,
        config,
        pack::default_pack(),
    )
}

fn params() -> SkyParams {
    SkyParams {
        time: 0.4,
        flare: 0.0,
        ..SkyParams::default()
    }
}

fn camera() -> Camera {
    Camera::looking(0.5, 0.4, 1.0, SIZE)
}

/// How scene and sky are drawn.
#[derive(Clone, Copy, Debug)]
struct Setting {
    format: wgpu::TextureFormat,
    samples: u32,
    reversed: bool,
    scene_first: bool,
}

/// Scene and sky in one pass.
fn with_scene(setting: Setting, params: &SkyParams, camera: &Camera) -> Vec<[f32; 4]> {
    let Setting {
        format,
        samples,
        reversed,
        scene_first,
    } = setting;
    let depth = DepthConfig {
        format: DEPTH,
        reversed,
    };
    let config = SkyConfig {
        target_format: format,
        depth: Some(depth),
        sample_count: samples,
    };
    let mut sky = new_sky(config).expect("the sky is made");
    gpu::prepare(&mut sky, params, camera, 0.0);
    let (target, depth) = (
        gpu::target(format, SIZE, 1),
        gpu::target(DEPTH, SIZE, samples),
    );
    let many = (samples > 1).then(|| gpu::target(format, SIZE, samples));
    let far = if reversed { 0.0 } else { 1.0 };
    let scene = scene(samples, reversed, format);
    gpu::pass(&target, many.as_ref(), Some((&depth, far)), |pass| {
        if !scene_first {
            sky.draw(pass);
        }
        pass.set_pipeline(&scene);
        pass.draw(0..4, 0..1);
        if scene_first {
            sky.draw(pass);
        }
    });
    gpu::read(&target)
}

/// Every way to draw into a target of this format.
fn settings(format: wgpu::TextureFormat) -> Vec<Setting> {
    let mut settings = Vec::new();
    for samples in [1, 4] {
        for reversed in [false, true] {
            for scene_first in [true, false] {
                settings.push(Setting {
                    format,
                    samples,
                    reversed,
                    scene_first,
                });
            }
        }
    }
    settings
}

#[test]
fn the_scene_hides_the_sky_and_the_sky_fills_the_rest() {
    let plain = gpu::render(
        &mut gpu::sky(pack::default_pack(), FORMAT),
        FORMAT,
        &params(),
        &camera(),
        0.0,
    );
    for setting in settings(FORMAT) {
        let picture = with_scene(setting, &params(), &camera());
        for (index, (texel, alone)) in picture.iter().zip(&plain).enumerate() {
            let scene = index as u32 % SIZE[0] < SIZE[0] / 2;
            let expected = if scene { [1.0, 0.0, 1.0, 1.0] } else { *alone };
            // Shading happens once a pixel, so four samples hold one colour; resolving it may round.
            let off = (0..4)
                .map(|c| (texel[c] - expected[c]).abs())
                .fold(0.0, f32::max);
            assert!(
                off <= 1.01 / 255.0,
                "{setting:?}: pixel {index} is {texel:?}, expected {expected:?}"
            );
        }
    }
}

/// The flare is light in the lens, before everything: it falls on the scene as on the sky, with any method.
#[test]
fn the_flare_lies_over_the_scene() {
    let format = wgpu::TextureFormat::Rgba16Float;
    let pack = pack::default_pack();
    let sun = mapping::sun_direction(0.4, pack.manifest().noon_elevation_rad);
    let (azimuth, elevation) = mapping::angles_from_direction(sun);
    let camera = Camera::looking(azimuth + 0.15, elevation + 0.1, 1.0, SIZE);
    for (index, setting) in settings(format)
        .into_iter()
        .filter(|s| s.scene_first)
        .enumerate()
    {
        let params = SkyParams {
            method: Method::DOMES[index % Method::DOMES.len()],
            sun: false,
            cover: 0.2,
            ..params()
        };
        let [without, with] = [0.0, 1.0].map(|flare| SkyParams { flare, ..params });
        let mut plain = gpu::sky(pack, format);
        let [sky_without, sky_with] =
            [&without, &with].map(|params| gpu::render(&mut plain, format, params, &camera, 0.0));
        let [scene_without, scene_with] =
            [&without, &with].map(|params| with_scene(setting, params, &camera));
        // Four half floats of at most 2. Of four samples some lie inside a square where its edge crosses a pixel; there the
        // pictures of the flare are nearly black.
        let bound = if setting.samples == 1 {
            4.0 / 1024.0
        } else {
            0.02
        };
        let mut over_scene = 0.0;
        for index in 0..scene_with.len() {
            for c in 0..3 {
                let on_sky = sky_with[index][c] - sky_without[index][c];
                let on_scene = scene_with[index][c] - scene_without[index][c];
                assert!(
                    (on_sky - on_scene).abs() < bound,
                    "{setting:?}: pixel {index}: {on_scene} for {on_sky}"
                );
                if index as u32 % SIZE[0] < SIZE[0] / 2 {
                    over_scene += on_scene;
                }
            }
        }
        assert!(
            over_scene > 1.0,
            "{setting:?}: there is a flare over the scene: {over_scene}"
        );
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_with_advice() {
    let good = SkyConfig {
        target_format: FORMAT,
        depth: None,
        sample_count: 1,
    };
    let refused = |config: SkyConfig| new_sky(config).expect_err("refused");
    let stencil = wgpu::TextureFormat::Stencil8;
    let cases = [
        (
            SkyConfig {
                sample_count: 3,
                ..good
            },
            "sample_count",
        ),
        (
            SkyConfig {
                sample_count: 0,
                ..good
            },
            "sample_count",
        ),
        (
            SkyConfig {
                target_format: wgpu::TextureFormat::R8Uint,
                ..good
            },
            "Unorm",
        ),
        (
            SkyConfig {
                depth: Some(DepthConfig {
                    format: stencil,
                    reversed: false,
                }),
                ..good
            },
            "Depth",
        ),
    ];
    for (config, advice) in cases {
        let message = refused(config).to_string();
        assert!(message.contains(advice), "{config:?}: {message}");
    }
}
