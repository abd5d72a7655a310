//! The shadow of each cloud on Bevy's materials, as the texture of the directional light that the sun is.

use bevy::core_pipeline::schedule::{Core3d, Core3dSystems};
use bevy::light::DirectionalLightTexture;
use bevy::pbr::decal::clustered::clustered_decals_are_usable;
use bevy::prelude::*;
use bevy::render::render_asset::RenderAssets;
use bevy::render::render_resource::TextureFormat;
use bevy::render::renderer::{RenderAdapter, RenderContext, RenderDevice, RenderQueue, ViewQuery};
use bevy::render::sync_world::MainEntity;
use bevy::render::texture::GpuImage;
use bevy::render::{Extract, ExtractSchedule, RenderApp};
use welkin_runtime::shadow;
use welkin_runtime::wgpu;

use crate::WelkinSystems;
use crate::light::{EachCloud, WelkinLight, WelkinViewLight, first, luminance, luminary};
use crate::render::Skies;
use crate::settings::bevy_vec3;

/// On a [`WelkinLight`]: clouds throw shadows on Bevy's materials, in a circle about the camera whose diameter is
/// [`SkyParams::shadow_extent_m`](welkin_runtime::SkyParams::shadow_extent_m) of its sky, 0 for none. Beyond it they repeat.
///
/// They are those of the ground at height 0, thrown along the light on whatever stands there. It wants what Bevy's light textures want: binding arrays, so
/// neither WebGL2 nor Metal. Elsewhere clouds dim the light by their mean.
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Clone, Debug, Default)]
#[require(WelkinLight)]
pub struct WelkinShadows;

/// Texels a side of the light's texture: twice those of the shadows, which it holds turned.
const SIDE: u32 = 2 * shadow::SIDE;
/// Sine of the least elevation that the texture is laid out for; clouds throw no shadows from below it.
const LEAST_SINE: f32 = 0.02;

/// The shadows that a frame wants drawn.
#[derive(Resource, Clone)]
struct Wanted {
    camera: Entity,
    image: Handle<Image>,
    /// Middle of the light's texture on the ground: metres to the east and to the south.
    centre_m: Vec2,
    towards: Vec2,
    mean: f32,
}

fn drive(
    mut commands: Commands,
    mut lights: Query<(Entity, &mut Transform, Has<DirectionalLightTexture>), With<WelkinShadows>>,
    views: Query<(
        Entity,
        &Camera,
        (Entity, &WelkinViewLight, &GlobalTransform),
    )>,
    device: Option<Res<RenderDevice>>,
    adapter: Option<Res<RenderAdapter>>,
    mut images: ResMut<Assets<Image>>,
    mut kept: Local<Option<Handle<Image>>>,
) {
    let can = |device: &RenderDevice, adapter: &RenderAdapter| {
        clustered_decals_are_usable(device, adapter)
    };
    let usable = device.zip(adapter).is_some_and(|(d, a)| can(&d, &a));
    let view =
        first(views.iter()).filter(|(_, view, _)| usable && view.sky.params.shadow_extent_m > 0.0);
    let Some((camera, view, place)) = view else {
        commands.remove_resource::<Wanted>();
        for (entity, mut transform, _) in lights.iter_mut().filter(|(.., has)| *has) {
            transform.scale = Vec3::ONE;
            let mut light = commands.entity(entity);
            light.remove::<(DirectionalLightTexture, EachCloud)>();
        }
        return;
    };
    let image = kept.get_or_insert_with(|| {
        let mut image = Image::new_target_texture(SIDE, SIDE, TextureFormat::R8Unorm, None);
        image.data = Some(vec![255; (SIDE * SIDE) as usize]);
        images.add(image)
    });
    let from = luminary(&view.light);
    let direction = bevy_vec3(from.direction);
    let [clear, mean] = [from.clear_irradiance, from.irradiance].map(|e| luminance(bevy_vec3(e)));
    let metres = view.sky.metres_per_unit;
    let extent_m = view.sky.params.shadow_extent_m;
    // Whole texels of the shadows: those stay where they are as the camera moves, and so does what is read of them.
    let texel_m = extent_m / shadow::SIDE as f32;
    let place_m = place.translation().xz() * metres;
    let centre_m = (place_m / texel_m).round() * texel_m;
    commands.insert_resource(Wanted {
        camera,
        image: image.clone(),
        centre_m,
        towards: direction.xz().normalize_or(Vec2::NEG_Y),
        mean: if clear > 0.0 { mean / clear } else { 1.0 },
    });
    let radius = 0.5 * extent_m / metres;
    let sine = direction.y.max(LEAST_SINE);
    for (entity, mut transform, has) in &mut lights {
        let [x, z] = (centre_m / metres).to_array();
        transform.translation = Vec3::new(x, 0.0, z);
        transform.scale = Vec3::new(radius, radius * sine, radius);
        if !has {
            let texture = DirectionalLightTexture {
                image: image.clone(),
                tiled: true,
            };
            commands.entity(entity).insert((texture, EachCloud));
        }
    }
}

fn extract(mut commands: Commands, wanted: Extract<Option<Res<Wanted>>>) {
    match wanted.as_ref() {
        Some(wanted) => commands.insert_resource((**wanted).clone()),
        None => commands.remove_resource::<Wanted>(),
    }
}

/// The pass on a device.
struct Turn {
    pipeline: wgpu::RenderPipeline,
    uniforms: wgpu::Buffer,
    sampler: wgpu::Sampler,
}

impl Turn {
    fn new(device: &wgpu::Device) -> Turn {
        let module = device.create_shader_module(wgpu::include_wgsl!("shadows.wgsl"));
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("welkin shadows"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs_turn"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fs_turn"),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::TextureFormat::R8Unorm.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Turn {
            pipeline,
            uniforms: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("welkin shadows"),
                size: size_of::<[f32; 8]>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            sampler: device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
        }
    }
}

fn draw(
    view: ViewQuery<MainEntity>,
    wanted: Option<Res<Wanted>>,
    skies: Res<Skies>,
    images: Res<RenderAssets<GpuImage>>,
    queue: Res<RenderQueue>,
    mut context: RenderContext,
    mut made: Local<Option<Turn>>,
) {
    let entity = view.entity();
    let Some(wanted) = wanted.filter(|wanted| wanted.camera == view.into_inner()) else {
        return;
    };
    let shadow = skies.view(entity).and_then(|view| view.shadow());
    let Some((shadow, image)) = shadow.zip(images.get(&wanted.image)) else {
        return;
    };
    let device = context.render_device().wgpu_device().clone();
    let turn = made.get_or_insert_with(|| Turn::new(&device));
    let moved = (wanted.centre_m - Vec2::from(shadow.centre_m)) / shadow.extent_m;
    let [east, south] = wanted.towards.to_array();
    let uniforms = [east, south, moved.x, moved.y, wanted.mean, 0.0, 0.0, 0.0];
    queue.write_buffer(&turn.uniforms, 0, bytemuck::cast_slice(&uniforms));
    let from = shadow.texture.create_view(&Default::default());
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("welkin shadows"),
        layout: &turn.pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry {
                binding: 0,
                resource: turn.uniforms.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 1,
                resource: wgpu::BindingResource::TextureView(&from),
            },
            wgpu::BindGroupEntry {
                binding: 2,
                resource: wgpu::BindingResource::Sampler(&turn.sampler),
            },
        ],
    });
    let encoder = context.command_encoder();
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("welkin shadows"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &image.texture_view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::WHITE),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    });
    pass.set_pipeline(&turn.pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.draw(0..3, 0..1);
}

pub(crate) fn build(app: &mut App) {
    app.register_type::<WelkinShadows>().add_systems(
        PostUpdate,
        drive
            .in_set(WelkinSystems::Drive)
            .after(crate::light::drive),
    );
}

pub(crate) fn build_render(app: &mut App) {
    let Some(render_app) = app.get_sub_app_mut(RenderApp) else {
        return;
    };
    render_app
        .add_systems(ExtractSchedule, extract)
        .add_systems(
            Core3d,
            draw.after(crate::render::prepare)
                .after(Core3dSystems::Prepass)
                .before(Core3dSystems::MainPass),
        );
}
