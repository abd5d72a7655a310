//! The pictures of the ring: which a frame draws, and what it draws into them.

use super::Pass;
use crate::device::context::Context;
use crate::sprites::frame::{Frame, cell_texels};
use crate::sprites::pipelines::{Behind, STRIDE, one_of, pictures};
use crate::sprites::ring::{Ring, Step};
use crate::sprites::scene::planes;
use crate::sprites::station::{self, SpriteView, Station};
use crate::sprites::wind::lift_m;

impl Pass {
    /// Lets the ring go on by a frame, and makes or drops its pictures.
    pub(super) fn step_ring(&mut self, context: &Context, now: Station) {
        let is_new = self.ring.is_none();
        let ring = self.ring.get_or_insert_with(|| Ring::new(now));
        self.step = if is_new { Step::All } else { ring.step(now) };
        let is_on = ring.current().is_on();
        let (device, output) = (&context.device, context.build.output);
        match self.step {
            Step::Keep => {}
            Step::All => {
                self.pictures = [is_on.then(|| pictures(device, output)), None];
                self.ring_group = None;
            }
            Step::Part([0, 0]) => {
                self.pictures[1] = Some(pictures(device, output));
                self.ring_group = None;
            }
            Step::Part(_) => {}
            Step::Swap => {
                self.pictures = [self.pictures[1].take().filter(|_| is_on), None];
                self.ring_group = None;
            }
        }
        if self.ring_group.is_none() {
            self.ring_group = self.make_ring_group(device);
        }
    }

    /// The first picture stands in for one that is not there: its share is 0.
    fn make_ring_group(&self, device: &wgpu::Device) -> Option<wgpu::BindGroup> {
        let any = self.pictures.iter().flatten().next()?;
        let view = |texture: &Option<wgpu::Texture>| {
            let texture = texture.as_ref().unwrap_or(any);
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            })
        };
        let [old, new] = [view(&self.pictures[0]), view(&self.pictures[1])];
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        Some(device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("ring"),
            layout: &self.groups.ring,
            entries: &[
                entry(5, one_of(&self.views, size_of::<SpriteView>())),
                entry(7, self.ring_uniforms.as_entire_binding()),
                entry(8, wgpu::BindingResource::TextureView(&old)),
                entry(9, wgpu::BindingResource::TextureView(&new)),
            ],
        }))
    }

    /// Adds the blocks of the pictures that this frame draws; gives those pictures and where their draws begin and end.
    pub(super) fn gather_pictures(
        &mut self,
        queue: &wgpu::Queue,
        sheet: &wgpu::Texture,
        frame: &Frame<'_>,
    ) -> Pictures {
        let mut pictures = Pictures::default();
        let next = self.ring.as_ref().and_then(Ring::next);
        let (station, first, last, parts) = match (self.step, &self.ring, next) {
            (Step::All, Some(ring), _) => (*ring.current(), 0, station::PICTURES, [0, 1]),
            (Step::Part([picture, part]), _, Some(next)) => {
                pictures.target = 1;
                (*next, picture, picture + 1, [part, next.parts()])
            }
            _ => return self.all_pictured(pictures),
        };
        if !station.is_on() {
            return self.all_pictured(pictures);
        }
        pictures.goes_on = parts[0] > 0;
        for picture in first..last {
            let begin = self.draws.len();
            let view = station.view(picture, cell_texels(sheet), -lift_m(frame.params));
            let offset = (1 + picture as u64) * STRIDE;
            queue.write_buffer(&self.views, offset, bytemuck::bytes_of(&view));
            let sides = planes(view.clip_x, view.clip_y, view.clip_w);
            self.find(station.place_m, station.distance_m, &sides, |block| {
                station.holds(block)
            });
            let [from, to] = [parts[0], parts[0] + 1].map(|i| i * self.found.len() / parts[1]);
            for index in from..to {
                let (_, block) = self.found[index];
                self.add_block(queue, frame, block, station.place_m, 1.0);
            }
            pictures.draws[picture] = Some([begin, self.draws.len()]);
        }
        self.all_pictured(pictures)
    }

    /// What is added from here on is for the screen.
    fn all_pictured(&mut self, pictures: Pictures) -> Pictures {
        self.pictured = self.draws.len();
        pictures
    }

    /// Draws the pictures that were gathered.
    pub(super) fn record_pictures(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        behind: Behind,
        pictures: Pictures,
    ) {
        let target = self.pictures[pictures.target].as_ref();
        let (Some(texture), Some(pipelines)) = (target, &self.pipelines[behind.index()]) else {
            return;
        };
        let load = if pictures.goes_on {
            wgpu::LoadOp::Load
        } else {
            wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)
        };
        for (picture, range) in pictures.draws.into_iter().enumerate() {
            let Some([begin, end]) = range else {
                continue;
            };
            let view = texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: picture as u32,
                array_layer_count: Some(1),
                ..Default::default()
            });
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("ring of impostors"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load,
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
            pass.set_pipeline(&pipelines.picture);
            pass.set_bind_group(0, shared, &[]);
            let offset = ((1 + picture as u64) * STRIDE) as u32;
            for (draw, block) in &self.draws[begin..end] {
                self.draw_block(&mut pass, draw, offset, *block);
            }
        }
    }
}

/// The pictures that a frame draws.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pictures {
    /// 0 of the ring in use, 1 of the next one.
    target: usize,
    /// Whether they are drawn over what is there of them.
    goes_on: bool,
    /// Where the draws of each begin and end.
    draws: [Option<[usize; 2]>; station::PICTURES],
}
