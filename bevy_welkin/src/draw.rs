//! Draws each camera's sky: behind the scene after what is opaque, or over Bevy's atmosphere as the farthest of what is transparent.

use bevy::camera::{MainPassResolutionOverride, Viewport};
use bevy::core_pipeline::core_3d::{
    Transparent3d, TransparentSortingInfo3d, main_opaque_pass_3d, main_transparent_pass_3d,
};
use bevy::core_pipeline::schedule::{Core3d, Core3dSystems};
use bevy::pbr::main_transmissive_pass_3d;
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_phase::{
    Draw, DrawError, DrawFunctions, PhaseItemExtraIndex, TrackedRenderPass, ViewSortedRenderPhases,
};
use bevy::render::render_resource::{CachedRenderPipelineId, RenderPassDescriptor, StoreOp};
use bevy::render::renderer::{RenderContext, ViewQuery};
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ExtractedView, ViewDepthStencilTexture, ViewTarget};
use bevy::render::{Render, RenderApp, RenderSystems};

use crate::render::{ExtractedSky, Skies};

/// A pass of its own: what refracts the scene reads the target after it.
fn behind(
    view: ViewQuery<(
        &ExtractedSky,
        &ExtractedCamera,
        &ViewTarget,
        &ViewDepthStencilTexture,
        Option<&MainPassResolutionOverride>,
    )>,
    skies: Res<Skies>,
    mut context: RenderContext,
) {
    let prepared = skies.view(view.entity());
    let (seen, camera, target, depth, smaller) = view.into_inner();
    let Some(sky) = prepared.filter(|_| !seen.over) else {
        return;
    };
    let diagnostics = context.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = context.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("welkin"),
        color_attachments: &[Some(target.get_color_attachment())],
        depth_stencil_attachment: Some(depth.get_attachment(StoreOp::Store)),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, "welkin");
    let viewport = Viewport::from_viewport_and_override(camera.viewport.as_ref(), smaller);
    if let Some(viewport) = viewport {
        pass.set_camera_viewport(&viewport);
    }
    sky.draw(pass.wgpu_pass());
    span.end(&mut pass);
}

/// Bevy draws its atmosphere over what is opaque, by a system that it does not name to others; the transparent phase comes after that.
struct DrawOver;

impl Draw<Transparent3d> for DrawOver {
    fn draw<'w>(
        &mut self,
        world: &'w World,
        pass: &mut TrackedRenderPass<'w>,
        view: Entity,
        _item: &Transparent3d,
    ) -> Result<(), DrawError> {
        let skies = world.get_resource::<Skies>();
        if let Some(sky) = skies.and_then(|skies| skies.view(view)) {
            sky.draw(pass.wgpu_pass());
        }
        Ok(())
    }
}

/// Farther than anything that is sorted with it.
const FARTHEST: f32 = -1e30;

fn queue_over(
    cameras: Query<(Entity, MainEntity, &ExtractedView, &ExtractedSky)>,
    functions: Res<DrawFunctions<Transparent3d>>,
    mut phases: ResMut<ViewSortedRenderPhases<Transparent3d>>,
) {
    let Some(draw_function) = functions.read().get_id::<DrawOver>() else {
        return;
    };
    for (entity, main_entity, view, _) in cameras.iter().filter(|(.., seen)| seen.over) {
        let Some(phase) = phases.get_mut(&view.retained_view_entity) else {
            continue;
        };
        phase.add_transient(Transparent3d {
            sorting_info: TransparentSortingInfo3d::Sorted {
                mesh_center: view.world_from_view.translation(),
                depth_bias: FARTHEST,
            },
            distance: FARTHEST,
            pipeline: CachedRenderPipelineId::INVALID,
            entity: (entity, main_entity.into()),
            draw_function,
            batch_range: 0..1,
            extra_index: PhaseItemExtraIndex::None,
            indexed: false,
        });
    }
}

pub(crate) fn build(app: &mut App) {
    let Some(render_app) = app.get_sub_app_mut(RenderApp) else {
        return;
    };
    let functions = render_app
        .world()
        .resource::<DrawFunctions<Transparent3d>>();
    functions.write().add(DrawOver);
    render_app
        .add_systems(Render, queue_over.in_set(RenderSystems::Queue))
        .add_systems(
            Core3d,
            behind
                .after(main_opaque_pass_3d)
                .before(main_transmissive_pass_3d)
                .before(main_transparent_pass_3d)
                .in_set(Core3dSystems::MainPass),
        );
}
