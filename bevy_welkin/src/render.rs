//! The render world: which camera sees which sky, the skies on Bevy's device, and each camera's view of one.

use std::sync::Arc;

use bevy::camera::MainPassResolutionOverride;
use bevy::core_pipeline::schedule::{Core3d, Core3dSystems};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::ecs::entity::EntityHashMap;
use bevy::pbr::AtmosphereSettings;
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue, ViewQuery};
use bevy::render::sync_component::{SyncComponent, SyncComponentPlugin};
use bevy::render::sync_world::RenderEntity;
use bevy::render::view::{ExtractedView, Msaa, ViewDepthStencilTexture, ViewTarget};
use bevy::render::{Extract, ExtractSchedule, Render, RenderApp, RenderSystems};
use welkin_pack::Pack;
use welkin_runtime::params::Tonemap;
use welkin_runtime::{DepthConfig, Sky, SkyConfig, View, glam};

use crate::pack::WelkinPack;
use crate::settings::{GlobalWelkinSky, WelkinSky, WelkinView};

/// What a camera sees, in the render world.
#[derive(Component, Clone)]
pub struct ExtractedSky {
    pub pack: Arc<Pack>,
    pub sky: WelkinSky,
    pub seconds: f64,
    /// Whether Bevy's atmosphere has drawn the clear sky.
    pub over: bool,
}

impl SyncComponent<RenderApp> for WelkinView {
    type Target = ExtractedSky;
}

fn extract(
    mut commands: Commands,
    views: Extract<
        Query<(
            RenderEntity,
            &WelkinView,
            Option<&WelkinSky>,
            Option<&Tonemapping>,
            Has<AtmosphereSettings>,
        )>,
    >,
    packs: Extract<Res<Assets<WelkinPack>>>,
    shared: Extract<Res<GlobalWelkinSky>>,
    time: Extract<Res<Time>>,
) {
    for (entity, view, own, tonemapping, over) in &views {
        let Some(pack) = packs.get(&view.0) else {
            commands.entity(entity).remove::<ExtractedSky>();
            continue;
        };
        let mut sky = *own.unwrap_or(&shared);
        if let Some(curve) = tonemapping.and_then(tonemap) {
            sky.params.tonemap = curve;
        }
        commands.entity(entity).insert(ExtractedSky {
            pack: pack.pack.clone(),
            seconds: sky.at(&time),
            sky,
            over,
        });
    }
}

/// The tone curve of a display target, where both know it.
fn tonemap(of: &Tonemapping) -> Option<Tonemap> {
    match of {
        Tonemapping::None => Some(Tonemap::None),
        Tonemapping::AgX => Some(Tonemap::Agx),
        Tonemapping::KhronosPbrNeutral => Some(Tonemap::Neutral),
        _ => None,
    }
}

/// What a sky on the device was made for.
#[derive(Clone)]
struct Made {
    pack: Arc<Pack>,
    config: SkyConfig,
    over: bool,
}

impl PartialEq for Made {
    fn eq(&self, other: &Made) -> bool {
        // A pack that was loaded anew is another one.
        Arc::ptr_eq(&self.pack, &other.pack)
            && self.config == other.config
            && self.over == other.over
    }
}

/// Every sky that a camera sees, and what each camera sees of it.
#[derive(Resource, Default)]
pub(crate) struct Skies {
    /// None where it could not be made, which was told then.
    skies: Vec<(Made, Option<Sky>)>,
    views: EntityHashMap<(Made, View)>,
}

impl Skies {
    /// What a camera has prepared.
    pub fn view(&self, camera: Entity) -> Option<&View> {
        self.views.get(&camera).map(|(_, view)| view)
    }
}

/// What a radiance of 1 may be in a target before a person is told: nights want more than a day, Bevy's default has 32.
const BLOWN: f32 = 24.0;

/// Writes a camera's frame and records its passes off screen.
pub(crate) fn prepare(
    view: ViewQuery<(
        &ExtractedSky,
        &ExtractedCamera,
        &ExtractedView,
        &ViewTarget,
        &ViewDepthStencilTexture,
        &Msaa,
        Option<&MainPassResolutionOverride>,
    )>,
    mut skies: ResMut<Skies>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    mut context: RenderContext,
) {
    let entity = view.entity();
    let (seen, camera, extracted, target, depth, msaa, smaller) = view.into_inner();
    let Skies { skies, views } = &mut *skies;
    // An orthographic camera has no directions to look in.
    let is_perspective = extracted.clip_from_view.w_axis.w == 0.0;
    let Some(viewport) = smaller
        .map(|MainPassResolutionOverride(size)| *size)
        .or(camera.physical_viewport_size)
        .filter(|_| is_perspective)
    else {
        views.remove(&entity);
        return;
    };
    let format = target.main_texture_format();
    let made = Made {
        pack: seen.pack.clone(),
        config: SkyConfig {
            target_format: format,
            depth: Some(DepthConfig {
                format: depth.texture().format(),
                reversed: true,
            }),
            sample_count: msaa.samples(),
        },
        over: seen.over,
    };
    if !skies.iter().any(|(other, _)| *other == made) {
        skies.push((made.clone(), build_sky(&made, &device, &queue)));
    }
    let sky = skies.iter().find(|(other, _)| *other == made);
    let Some(sky) = sky.and_then(|(_, sky)| sky.as_ref()) else {
        views.remove(&entity);
        return;
    };
    let (of, view) = views
        .entry(entity)
        .or_insert_with(|| (made.clone(), sky.view()));
    if *of != made {
        (*of, *view) = (made, sky.view());
    }

    let scale = seen.sky.unit() * camera.exposure;
    if scale > BLOWN {
        warn_once!(
            "a camera shows the white of a sunlit cloud as {scale}: give it an exposure for daylight, such as bevy_welkin::DAYLIGHT"
        );
    }
    let mut params = seen.sky.params.0;
    // Of a display target, which gets the finished colour.
    params.exposure = scale;
    params.exposure_ev = 0.0;
    params.auto_exposure = false;
    view.set_scale(scale);
    let matrix = |of: Mat4| glam::Mat4::from_cols_array(&of.to_cols_array());
    let view_from_world = matrix(extracted.world_from_view.to_matrix().inverse());
    let lens = matrix(extracted.clip_from_view);
    let camera = seen
        .sky
        .axes()
        .camera(view_from_world, lens, viewport.to_array());
    let encoder = context.command_encoder();
    view.prepare(sky, &queue, encoder, &params, &camera, seen.seconds);
}

fn build_sky(made: &Made, device: &RenderDevice, queue: &RenderQueue) -> Option<Sky> {
    let build = if made.over { Sky::over } else { Sky::new };
    build(device.wgpu_device(), queue, made.config, &made.pack)
        .inspect_err(|error| error!("a camera has no sky: {error}"))
        .ok()
}

/// Drops what no camera sees any more.
fn forget(mut skies: ResMut<Skies>, cameras: Query<(Entity, &ExtractedSky)>) {
    let Skies { skies, views } = &mut *skies;
    views.retain(|&camera, _| cameras.contains(camera));
    skies.retain(|(made, sky)| match sky {
        Some(_) => views.values().any(|(of, _)| of == made),
        // It is tried again with another pack.
        None => cameras
            .iter()
            .any(|(_, seen)| Arc::ptr_eq(&seen.pack, &made.pack)),
    });
}

pub(crate) fn build(app: &mut App) {
    app.add_plugins(SyncComponentPlugin::<WelkinView>::default());
    let Some(render_app) = app.get_sub_app_mut(RenderApp) else {
        return;
    };
    render_app
        .init_resource::<Skies>()
        .add_systems(ExtractSchedule, extract)
        .add_systems(Render, forget.in_set(RenderSystems::Cleanup))
        .add_systems(
            Core3d,
            prepare
                .after(Core3dSystems::Prepass)
                .before(Core3dSystems::MainPass),
        );
}
