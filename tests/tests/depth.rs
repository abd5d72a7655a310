//! The sky stands behind the scene, with either depth convention, and with four samples a pixel.

use welkin_runtime::{Camera, DepthConfig, Sky, SkyConfig, SkyError, SkyParams};
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

fn scene(samples: u32, reversed: bool) -> wgpu::RenderPipeline {
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
            targets: &[Some(FORMAT.into())],
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
        ..SkyParams::default()
    }
}

fn camera() -> Camera {
    Camera::looking(0.5, 0.4, 1.0, SIZE)
}

/// Scene and sky in one pass; the scene first or last.
fn with_scene(samples: u32, reversed: bool, scene_first: bool) -> Vec<[f32; 4]> {
    let depth = DepthConfig {
        format: DEPTH,
        reversed,
    };
    let config = SkyConfig {
        target_format: FORMAT,
        depth: Some(depth),
        sample_count: samples,
    };
    let mut sky = new_sky(config).expect("the sky is made");
    sky.prepare(&gpu::gpu().queue, &params(), &camera(), 0.0);
    let (target, depth) = (
        gpu::target(FORMAT, SIZE, 1),
        gpu::target(DEPTH, SIZE, samples),
    );
    let many = (samples > 1).then(|| gpu::target(FORMAT, SIZE, samples));
    let far = if reversed { 0.0 } else { 1.0 };
    let scene = scene(samples, reversed);
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

#[test]
fn the_scene_hides_the_sky_and_the_sky_fills_the_rest() {
    let plain = gpu::render(
        &mut gpu::sky(pack::default_pack(), FORMAT),
        FORMAT,
        &params(),
        &camera(),
        0.0,
    );
    for samples in [1, 4] {
        for reversed in [false, true] {
            for scene_first in [true, false] {
                let picture = with_scene(samples, reversed, scene_first);
                for (index, (texel, alone)) in picture.iter().zip(&plain).enumerate() {
                    let scene = index as u32 % SIZE[0] < SIZE[0] / 2;
                    let expected = if scene { [1.0, 0.0, 1.0, 1.0] } else { *alone };
                    // Shading happens once a pixel, so four samples hold one colour; resolving it may round.
                    let off = (0..4)
                        .map(|c| (texel[c] - expected[c]).abs())
                        .fold(0.0, f32::max);
                    let case = format!(
                        "{samples} samples, reversed {reversed}, scene first {scene_first}"
                    );
                    assert!(
                        off <= 1.01 / 255.0,
                        "{case}: pixel {index} is {texel:?}, expected {expected:?}"
                    );
                }
            }
        }
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
