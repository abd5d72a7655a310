//! The shadows on the ground: which blocks a frame draws, and into what.

use super::{Pass, VIEWS};
use crate::device::context::Context;
use crate::sprites::cast::Cast;
use crate::sprites::frame::Frame;
use crate::sprites::pipelines::{Behind, STRIDE};

impl Pass {
    /// Adds the blocks that throw shadows on the square of a frame, if it has one.
    pub(super) fn gather_cast(
        &mut self,
        context: &Context,
        queue: &wgpu::Queue,
        sheet: &wgpu::Texture,
        frame: &Frame<'_>,
        sight_m: f32,
    ) {
        self.cast = self.draws.len();
        let Some(cast) = Cast::of(frame) else {
            return;
        };
        if let Some(pipelines) = &mut self.pipelines[Behind::of(frame.params).index()] {
            pipelines.load_cast(context, &self.groups);
        }
        let view = cast.view(frame, sheet);
        queue.write_buffer(&self.views, CAST * STRIDE, bytemuck::bytes_of(&view));
        let (heights_m, overhang_m) = (self.scene.heights_m, f64::from(self.scene.overhang_m));
        let viewer_m = frame.viewer_m();
        self.find(viewer_m, f64::from(sight_m), &[], |block| {
            cast.meets(block, heights_m, overhang_m)
        });
        for index in 0..self.found.len() {
            let (_, block) = self.found[index];
            self.add_block(queue, frame, block, viewer_m, 1.0);
        }
        self.cast = self.draws.len();
    }

    /// Draws the blocks that were gathered over what is there.
    pub fn record_cast(
        &self,
        behind: Behind,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        target: &wgpu::TextureView,
    ) {
        let draws = &self.draws[self.pictured..self.cast];
        let pipelines = self.pipelines[behind.index()].as_ref();
        let Some(pipeline) = pipelines
            .and_then(|own| own.cast())
            .filter(|_| !draws.is_empty())
        else {
            return;
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadows of sprites"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Load,
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, shared, &[]);
        for (draw, block) in draws {
            self.draw_block(&mut pass, draw, (CAST * STRIDE) as u32, *block);
        }
    }
}

/// Number of the ground's view.
const CAST: u64 = VIEWS - 1;
