//! Tone curves on a device: those of the CPU, colour by colour, and in all that a frame is made of.

use glam::Vec3;
use half::f16;
use welkin_runtime::internals::clear_sky::light;
use welkin_runtime::internals::device::config::Output;
use welkin_runtime::internals::device::shader::{Build, compose};
use welkin_runtime::internals::geometry::part::Part;
use welkin_runtime::internals::geometry::uniforms::{Member, Struct};
use welkin_runtime::internals::tonemap::{self, TonemapUniforms, displayed};
use welkin_runtime::params::{SpriteParams, Tonemap};
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::{gpu, pack};

const SIZE: [u32; 2] = [96, 54];

/// The last step alone: a triangle over the target, a colour from a texture for each pixel.
const ALONE: Part = Part {
    constants: &[],
    structs: &[],
    wgsl: "
@group(0) @binding(0) var<uniform> uniforms: Uniforms;
@group(0) @binding(1) var colours: texture_2d<f32>;

@vertex
fn vs_alone(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fs_alone(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return vec4f(display_colour(textureLoad(colours, vec2i(position.xy), 0).rgb), 1.0);
}
",
};

/// A frame's uniforms, of the last step alone.
const WHOLE: Struct = Struct {
    name: "Uniforms",
    size: size_of::<TonemapUniforms>(),
    members: &[Member::new::<TonemapUniforms>("tonemap", 0)],
};

/// What the display shows of these colours, by the device.
fn toned(colours: &[Vec3], params: &SkyParams) -> Vec<Vec3> {
    let gpu::Gpu { device, queue, .. } = gpu::gpu();
    let build = Build {
        output: Output::Display,
        reversed_depth: false,
        skybox: false,
        catalogue: false,
        over: false,
    };
    let parts = [light::PART, tonemap::PART, ALONE];
    let text = compose(
        build,
        &[],
        vec![&TonemapUniforms::WGSL, &WHOLE],
        parts.iter(),
        &[],
    );
    let format = wgpu::TextureFormat::Rgba16Float;
    let pipeline = gpu::pipeline(&text, ["vs_alone", "fs_alone"], format);
    let size = wgpu::Extent3d {
        width: colours.len() as u32,
        height: 1,
        depth_or_array_layers: 1,
    };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let texels = colours.iter().flat_map(|c| c.extend(1.0).to_array());
    let texels: Vec<u8> = texels
        .flat_map(|c| f16::from_f32(c).to_le_bytes())
        .collect();
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(8 * size.width),
        rows_per_image: None,
    };
    queue.write_texture(texture.as_image_copy(), &texels, layout, size);
    let uniforms = tonemap::uniforms(params, 0.0);
    let bytes = [
        uniforms.exposure.to_le_bytes(),
        uniforms.dither.to_le_bytes(),
        uniforms.curve.to_le_bytes(),
        uniforms.agx_start.to_le_bytes(),
    ];
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: size_of::<TonemapUniforms>() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    queue.write_buffer(&buffer, 0, bytes.as_flattened());
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry {
                binding: 0,
                resource: buffer.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 1,
                resource: wgpu::BindingResource::TextureView(
                    &texture.create_view(&Default::default()),
                ),
            },
        ],
    });
    let target = gpu::target(format, [size.width, 1], 1);
    gpu::pass(&target, None, None, |pass| {
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    });
    gpu::rgb(&gpu::read(&target))
}

/// From below black over all that half floats hold, grey and in colours.
fn colours() -> Vec<Vec3> {
    let values = [
        -65_504.0, -0.5, 0.0, 1e-6, 0.004, 0.03, 0.08, 0.2, 0.76, 0.8, 1.0, 1.4, 6.0, 65_504.0,
    ];
    let pairs = values
        .iter()
        .flat_map(|&r| values.iter().map(move |&b| (r, b)));
    let half = |c: f32| f16::from_f32(c).to_f32();
    let colours = pairs.map(|(r, b)| Vec3::new(r, 0.5 * (r + b), b).map(half));
    colours.collect()
}

#[test]
fn every_curve_on_the_device_is_that_of_the_cpu() {
    for tonemap in Tonemap::ALL {
        for exposure_ev in [-16.0, -3.0, 0.0, 2.5, 16.0] {
            let params = SkyParams {
                tonemap,
                exposure_ev,
                ..SkyParams::default()
            };
            let actual = toned(&colours(), &params);
            for (&colour, actual) in colours().iter().zip(actual) {
                let expected = displayed(colour * params.exposure_factor(), tonemap);
                // A half float's step of 2^-11, and as much for each of the logarithm and the power of a GPU (2^-11 where they are near 1).
                let bound = 1e-6 + 3.0 / 2048.0 * expected;
                let off = (actual - expected).abs();
                assert!(
                    off.cmple(bound).all(),
                    "{tonemap:?} {exposure_ev} {colour}: {actual} {expected}"
                );
            }
        }
    }
}

fn view(azimuth_deg: f32, elevation_deg: f32) -> Camera {
    Camera::looking(
        azimuth_deg.to_radians(),
        elevation_deg.to_radians(),
        1.05,
        SIZE,
    )
}

/// Everything that has a colour: every method, towards the afternoon's sun, with rays and rain.
fn scenes() -> Vec<SkyParams> {
    let scene = |method: Method| {
        let mut params = SkyParams {
            method,
            time: 0.66,
            // Its glare is there on a display alone.
            sun: false,
            cover: 0.7,
            dither: false,
            flare: 0.0,
            ..SkyParams::default()
        };
        (params.weather.rays, params.weather.rain) = (1.0, 1.0);
        params
    };
    Method::ALL.map(scene).to_vec()
}

/// Which curve a picture was made by is told by the radiance of the same scene. Rays and rain are left out, since they are blended as the target
/// holds colours. So are sprites: their picture is only nearest to its own curve, and the one that is cut off is not asked for.
#[test]
fn every_part_of_a_frame_goes_through_the_curve() {
    let [linear, encoded] = [
        wgpu::TextureFormat::Rgba16Float,
        wgpu::TextureFormat::Rgba8UnormSrgb,
    ];
    let mut skies = [linear, encoded].map(|format| gpu::sky(pack::default_pack(), format));
    for mut scene in scenes() {
        (scene.weather.rays, scene.weather.rain) = (0.0, 0.0);
        // Bright enough that curves differ.
        let at = |tonemap: Tonemap| SkyParams {
            tonemap,
            exposure_ev: 2.0,
            ..scene
        };
        let mut draw = |sky: usize, params: &SkyParams| {
            skies[sky].reset_history();
            let format = [linear, encoded][sky];
            gpu::rgb(&gpu::render(
                &mut skies[sky],
                format,
                params,
                &view(240.0, 20.0),
                30.0,
            ))
        };
        let radiance = draw(0, &scene);
        for tonemap in Tonemap::ALL {
            let picture = draw(1, &at(tonemap));
            let apart = Tonemap::ALL.map(|other| {
                let pairs = picture.iter().zip(&radiance);
                let off = pairs.map(|(shown, &r)| {
                    let expected = welkin_tests::tonemap::to_bytes(r, &at(other));
                    (*shown * 255.0 - expected).abs().element_sum()
                });
                off.sum::<f32>() / (3 * picture.len()) as f32
            });
            println!("{} {tonemap:?}: {apart:?}", scene.method.name());
            let mut others = apart.to_vec();
            let own = others.remove(tonemap as usize);
            let nearest = others.into_iter().fold(f32::MAX, f32::min);
            let method = scene.method;
            match (method, tonemap) {
                (Method::Sprites, Tonemap::None) => {}
                (Method::Sprites, _) => assert!(own < nearest, "{tonemap:?}: {apart:?}"),
                // Bytes are off by a quarter of a step on average, and half floats by less.
                _ => assert!(
                    own < 0.5 && nearest > 1.0,
                    "{method:?} {tonemap:?}: {apart:?}"
                ),
            }
        }
    }
}

/// Nothing is left of anything, whatever draws it.
#[test]
fn with_sixteen_stops_less_all_is_black() {
    let format = wgpu::TextureFormat::Rgba8UnormSrgb;
    let mut sky = gpu::sky(pack::default_pack(), format);
    for scene in scenes() {
        for tonemap in Tonemap::ALL {
            let params = SkyParams {
                tonemap,
                exposure_ev: -16.0,
                // Its disc is as bright as half floats go: 1.
                sun: false,
                ..scene
            };
            sky.reset_history();
            let shown = gpu::rgb(&gpu::render(
                &mut sky,
                format,
                &params,
                &view(240.0, 20.0),
                30.0,
            ));
            let brightest = shown
                .iter()
                .fold(Vec3::ZERO, |most, c| most.max(*c))
                .max_element();
            assert!(
                brightest < 1.5 / 255.0,
                "{:?} {tonemap:?}: {brightest}",
                scene.method
            );
        }
    }
}

/// As everything else, though its colours are the display's own.
#[test]
fn a_flare_is_exposed_too() {
    let format = wgpu::TextureFormat::Rgba8UnormSrgb;
    let mut sky = gpu::sky(pack::default_pack(), format);
    let mut draw = |flare: f32, exposure_ev: f32| {
        let params = SkyParams {
            time: 0.66,
            cover: 0.0,
            dither: false,
            flare,
            exposure_ev,
            ..SkyParams::default()
        };
        gpu::rgb(&gpu::render(
            &mut sky,
            format,
            &params,
            &view(240.0, 20.0),
            0.0,
        ))
    };
    assert!(draw(1.0, 0.0) != draw(0.0, 0.0), "the flare is in view");
    assert!(draw(1.0, -16.0) == draw(0.0, -16.0));
}

/// The ring's pictures hold colours: with another curve, or a stop more, they are made anew at once.
#[test]
fn the_ring_of_impostors_follows_curve_and_exposure() {
    let format = wgpu::TextureFormat::Rgba8UnormSrgb;
    let mut sky = gpu::sky(pack::default_pack(), format);
    let first = SkyParams {
        method: Method::Sprites,
        cover: 0.7,
        dither: false,
        flare: 0.0,
        sprites: SpriteParams {
            ring_radius_m: 6_000.0,
            ..SpriteParams::default()
        },
        ..SkyParams::default()
    };
    let other_curve = SkyParams {
        tonemap: Tonemap::Agx,
        ..first
    };
    let brighter = SkyParams {
        exposure_ev: 1.0,
        ..other_curve
    };
    let mut draw = |params: &SkyParams, anew: bool| {
        if anew {
            sky.reset_history();
        }
        gpu::rgb(&gpu::render(
            &mut sky,
            format,
            params,
            &view(20.0, 4.0),
            0.0,
        ))
    };
    for [before, after] in [[first, other_curve], [other_curve, brighter]] {
        let wanted = draw(&after, true);
        let old = draw(&before, true);
        assert!(wanted != old, "the test can fail");
        assert!(draw(&after, false) == wanted, "{after:?}");
    }
}
