//! What cameras see: the runtime's own picture, whatever the target, the samples, the viewport and its size.

use bevy::camera::{Hdr, Viewport};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy_welkin::welkin_runtime::{Camera as SkyCamera, Method, Sky, SkyConfig, glam, wgpu};
use bevy_welkin::{DAYLIGHT, UNIT_CD_M2, WelkinSky, WelkinView};

use crate::stage::{Picture, SIZE, Stage, pack};

/// To the north-east and up: sky alone, with clouds.
fn upwards() -> Transform {
    Transform::from_xyz(300.0, 2.0, -100.0).looking_to(Vec3::new(0.6, 0.7, -0.5), Vec3::Y)
}

/// A radiance of 1 in a target of a camera.
fn scale() -> f32 {
    UNIT_CD_M2 * DAYLIGHT.exposure()
}

/// The same sky by the runtime alone, on the same device, without Bevy's schedules.
fn alone(stage: &Stage, sky: &WelkinSky, transform: Transform) -> Picture {
    let (device, queue) = device(stage);
    let config = SkyConfig {
        target_format: wgpu::TextureFormat::Rgba16Float,
        depth: None,
        sample_count: 1,
    };
    let mut drawn = Sky::new(&device, &queue, config, pack()).expect("a sky");
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: SIZE.x,
            height: SIZE.y,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: config.target_format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    drawn.prepare(&queue, &mut encoder, &sky.params, &camera(transform), 0.0);
    let view = texture.create_view(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        ..Default::default()
    });
    drawn.draw(&mut pass);
    drop(pass);
    let bytes = read(&device, &queue, encoder, &texture, 8);
    let half = |texel: &[u8], i| half::f16::from_le_bytes([texel[i], texel[i + 1]]).to_f32();
    Picture {
        size: SIZE,
        pixels: bytes
            .chunks_exact(8)
            .map(|texel| Vec3::new(half(texel, 0), half(texel, 2), half(texel, 4)) * scale())
            .collect(),
        bytes: Vec::new(),
    }
}

/// The shadows of its clouds for a viewer at a place, 0 to 1: 256 rows from north to south.
pub fn shadows(stage: &Stage, sky: &WelkinSky, place: Vec3) -> Vec<f32> {
    let (device, queue) = device(stage);
    let config = SkyConfig {
        target_format: wgpu::TextureFormat::Rgba16Float,
        depth: None,
        sample_count: 1,
    };
    let mut drawn = Sky::new(&device, &queue, config, pack()).expect("a sky");
    let mut encoder = device.create_command_encoder(&Default::default());
    let at = camera(Transform::from_translation(place));
    drawn.prepare(&queue, &mut encoder, &sky.params, &at, 0.0);
    let texture = drawn.shadow().expect("shadows").texture;
    let bytes = read(&device, &queue, encoder, texture, 1);
    bytes
        .iter()
        .map(|&level| f32::from(level) / 255.0)
        .collect()
}

fn device(stage: &Stage) -> (wgpu::Device, wgpu::Queue) {
    let world = stage.app.world();
    let device = world.resource::<RenderDevice>().wgpu_device().clone();
    let queue: &wgpu::Queue = world.resource::<RenderQueue>();
    (device, queue.clone())
}

/// The runtime's camera for one of Bevy's, with its default lens.
fn camera(transform: Transform) -> SkyCamera {
    let mut camera = SkyCamera::looking(0.0, 0.0, std::f32::consts::FRAC_PI_4, SIZE.to_array());
    let [x, y, z, w] = transform.rotation.to_array();
    camera.orientation = glam::Quat::from_xyzw(x, y, z, w);
    camera.position_m = transform.translation.to_array().into();
    camera
}

/// The bytes of a texture whose rows are a multiple of 256 of them.
fn read(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    mut encoder: wgpu::CommandEncoder,
    texture: &wgpu::Texture,
    texel_bytes: u32,
) -> Vec<u8> {
    let row = texel_bytes * texture.width();
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row * texture.height()),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(row),
        rows_per_image: None,
    };
    let into = wgpu::TexelCopyBufferInfo {
        buffer: &buffer,
        layout,
    };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), into, texture.size());
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |done| done.expect("mapped"));
    let _ = device.poll(wgpu::PollType::wait_indefinitely());
    buffer.get_mapped_range(..).expect("mapped").to_vec()
}

fn sky(method: Method) -> WelkinSky {
    let mut sky = WelkinSky::default();
    sky.params.method = method;
    sky.params.cover = 0.5;
    sky.params.time = 0.42;
    sky
}

#[test]
fn a_camera_sees_what_the_runtime_draws_in_every_target() {
    let mut stage = Stage::new("assets");
    let pack = stage.pack();
    stage.set(sky(Method::Fbm));
    let expected = alone(&stage, &sky(Method::Fbm), upwards());

    let (camera, image) = stage.camera(&pack, upwards());
    let radiance = stage.shoot(&image);
    let (mean, far) = radiance.differs(&expected);
    assert!(mean < 2e-3 && far < 2e-3, "radiance: {mean} {far}");

    // Its edges are soft already: samples change nothing of the sky.
    stage
        .app
        .world_mut()
        .entity_mut(camera)
        .insert(Msaa::Sample4);
    let (mean, far) = stage.shoot(&image).differs(&expected);
    assert!(mean < 2e-3 && far < 2e-3, "four samples: {mean} {far}");

    // The same place in a world of centimetres.
    let mut small = sky(Method::Fbm);
    small.metres_per_unit = 0.01;
    let far = upwards().with_translation(100.0 * upwards().translation);
    let mut seen = stage.app.world_mut().entity_mut(camera);
    seen.insert((Msaa::Off, far, small));
    let (mean, share) = stage.shoot(&image).differs(&expected);
    assert!(mean < 2e-3 && share < 2e-3, "centimetres: {mean} {share}");

    // A display target gets the colour that Bevy's own shaders would write: without a curve, radiance cut off at 1.
    let shown = stage.target(SIZE, TextureFormat::Rgba8UnormSrgb);
    let lens = stage.lens(&shown, upwards());
    stage.app.world_mut().entity_mut(camera).despawn();
    let camera = (lens, Msaa::Off, WelkinView(pack));
    let camera = stage.app.world_mut().spawn(camera).id();
    let clipped = Picture {
        pixels: expected.pixels.iter().map(|p| p.min(Vec3::ONE)).collect(),
        ..expected.clone()
    };
    let (mean, _) = stage.shoot(&shown).differs(&clipped);
    assert!(mean < 0.01, "a display's bytes: {mean}");
    let curve = Tonemapping::AgX;
    stage.app.world_mut().entity_mut(camera).insert(curve);
    let (mean, _) = stage.shoot(&shown).differs(&clipped);
    assert!(mean > 0.05, "the camera's own tone curve: {mean}");
}

#[test]
fn cameras_have_skies_of_their_own_side_by_side() {
    let mut stage = Stage::new("assets");
    let pack = stage.pack();
    stage.set(sky(Method::Packed));
    let mut dusk = sky(Method::Octaves);
    dusk.params.time = 0.74;

    let (whole, image) = stage.camera(&pack, upwards());
    let day = stage.shoot(&image);
    stage.app.world_mut().entity_mut(whole).insert(dusk);
    let evening = stage.shoot(&image);
    let (mean, _) = evening.differs(&day);
    assert!(mean > 0.2, "a camera's own sky: {mean}");
    stage.app.world_mut().entity_mut(whole).despawn();

    // Both in one target, each in its half: as large as the pictures of each alone.
    let both = stage.target(UVec2::new(SIZE.x, 2 * SIZE.y), TextureFormat::Rgba16Float);
    for (order, own) in [None, Some(dusk)].into_iter().enumerate() {
        let viewport = Viewport {
            physical_position: UVec2::new(0, order as u32 * SIZE.y),
            physical_size: SIZE,
            ..default()
        };
        let mut camera = Camera {
            viewport: Some(viewport),
            order: order as isize,
            ..default()
        };
        if order > 0 {
            camera.clear_color = ClearColorConfig::None;
        }
        let lens = stage.lens(&both, upwards());
        let seen = (lens, Hdr, Msaa::Off, WelkinView(pack.clone()));
        let mut entity = stage.app.world_mut().spawn(seen);
        entity.insert(camera);
        if let Some(own) = own {
            entity.insert(own);
        }
    }
    let halves = stage.shoot(&both);
    let pixels = (SIZE.x * SIZE.y) as usize;
    for (half, expected) in halves.pixels.chunks(pixels).zip([&day, &evening]) {
        let half = Picture {
            size: SIZE,
            pixels: half.to_vec(),
            bytes: Vec::new(),
        };
        let (mean, far) = half.differs(expected);
        assert!(mean < 1e-3 && far < 1e-3, "{mean} {far}");
    }
}

#[test]
fn a_sky_follows_the_size_of_its_target() {
    let mut stage = Stage::new("assets");
    let pack = stage.pack();
    stage.set(sky(Method::Packed));
    let (_, image) = stage.camera(&pack, upwards());
    let before = stage.shoot(&image);
    let larger = 2 * SIZE;
    let mut images = stage.app.world_mut().resource_mut::<Assets<Image>>();
    let mut target = images.get_mut(&image).expect("the target");
    target.resize(bevy::render::render_resource::Extent3d {
        width: larger.x,
        height: larger.y,
        depth_or_array_layers: 1,
    });
    drop(target);
    let after = stage.shoot(&image);
    assert_eq!(after.size, larger);
    let quarters = |x: u32, y: u32| {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)];
        four.map(|(i, j)| after.at(2 * x + i, 2 * y + j))
    };
    let halved = (0..SIZE.x * SIZE.y).map(|i| quarters(i % SIZE.x, i / SIZE.x));
    let halved = Picture {
        pixels: halved.map(|four| four.iter().sum::<Vec3>() / 4.0).collect(),
        ..before.clone()
    };
    // Clouds are drawn in finer detail.
    let (mean, _) = halved.differs(&before);
    assert!(mean < 0.03, "{mean}");
}
