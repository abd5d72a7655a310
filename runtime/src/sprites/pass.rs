//! The sprites on a device.

mod cast;
mod pictures;

use glam::{DVec3, Vec3};
use welkin_pack::Field;
use wgpu::util::DeviceExt;

use super::device::{
    BLOCKS_A_SLOT, Blocks, amounts_texture, exposure_textures, index_buffers, instances_texture,
    sprites_group, uniform_buffer, upload, write_amounts, write_exposures,
};
use super::exposures::{Exposures, Span};
use super::frame::{Frame, screen_view, station};
use super::grid::{BlockId, around, slots_a_side};
use super::instances::{INSTANCES_PER_ROW, Instance};
use super::outline::{self, Outline};
use super::pipelines::{Behind, GroupLayouts, Pipelines, STRIDE};
use super::ring::{Ring, Step};
use super::scene::{AMOUNTS_SIDE, Draw, Scene, planes};
use super::station::{self, RingUniforms, SpriteView};
use crate::device::context::{Context, Dome, Shader};
use crate::params::{Method, Shading};

/// Views of a frame: the screen's, the ring's pictures', and the ground's.
const VIEWS: u64 = 2 + station::PICTURES as u64;

/// The sprites of a field, and what draws them.
#[derive(Debug)]
pub(crate) struct Pass {
    scene: Scene,
    groups: GroupLayouts,
    /// Before each of what may lie behind, at its place.
    pipelines: [Option<Pipelines>; Behind::COUNT],
    /// The pictures of the sprites.
    sheet: wgpu::Texture,
    instances: wgpu::Texture,
    /// Triangles of as many outlines and boxes as a slot has room for.
    indices: [wgpu::Buffer; 2],
    amounts: wgpu::Texture,
    views: wgpu::Buffer,
    outlines: wgpu::Buffer,
    blocks: Blocks,
    /// Light in the field.
    exposed: [wgpu::Texture; 2],
    exposed_span: Span,
    /// What they will hold from the first frame on.
    unwritten: Option<Exposures>,
    sprites_group: wgpu::BindGroup,
    ring: Option<Ring>,
    ring_uniforms: wgpu::Buffer,
    /// The pictures of the ring in use, and of the next one.
    pictures: [Option<wgpu::Texture>; 2],
    ring_group: Option<wgpu::BindGroup>,
    /// Blocks in view with their distances, before they are drawn.
    found: Vec<(f64, BlockId)>,
    /// Blocks of sprites of a picture or of the screen, the farthest first.
    draws: Vec<(Draw, u32)>,
    /// Those before this one are for the ring's pictures.
    pictured: usize,
    /// Those from there to this one are for the ground's shadows.
    cast: usize,
    step: Step,
    ring_shows: bool,
}

impl Pass {
    /// A field on a device, with its sheet of pictures, seen that far.
    pub fn new(
        context: &Context,
        sheet: &wgpu::Texture,
        field: &Field,
        outlines: &[Outline],
        distance_m: f32,
    ) -> Pass {
        let device = &context.device;
        let mut scene = Scene::new(field);
        let distance = scene.sight_m(distance_m, device.limits().max_texture_dimension_2d);
        scene.fit(distance);
        let groups = GroupLayouts::new(device);
        let amounts = amounts_texture(device, scene.amounts.len() as u32 / AMOUNTS_SIDE);
        let views = uniform_buffer(device, "views of sprites", VIEWS * STRIDE);
        let outlines = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("outlines of sprites"),
            contents: bytemuck::cast_slice(outlines),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let slots = slots_a_side(distance).pow(2);
        let exposures = Exposures::new(field);
        let exposed = exposure_textures(device, &exposures);
        let blocks = Blocks::new(device, slots, exposures.span);
        let instances = instances_texture(device, scene.rows(distance));
        Pass {
            indices: index_buffers(device, &scene),
            sprites_group: sprites_group(
                device,
                &groups,
                [sheet, &amounts, &instances],
                &exposed,
                [&views, &blocks.buffer, &outlines],
            ),
            ring_uniforms: uniform_buffer(device, "ring", size_of::<RingUniforms>() as u64),
            pipelines: [const { None }; Behind::COUNT],
            draws: Vec::with_capacity(BLOCKS_A_SLOT * slots),
            found: Vec::with_capacity(slots),
            ring: None,
            pictures: [const { None }; 2],
            ring_group: None,
            ring_shows: false,
            pictured: 0,
            cast: 0,
            instances,
            step: Step::Keep,
            sheet: sheet.clone(),
            exposed,
            exposed_span: exposures.span,
            unwritten: Some(exposures),
            scene,
            groups,
            amounts,
            views,
            outlines,
            blocks,
        }
    }

    /// Makes the pipelines if they are not there yet.
    pub fn load(&mut self, context: &Context, behind: Behind) {
        let groups = &self.groups;
        self.pipelines[behind.index()].get_or_insert_with(|| {
            let dome = Dome {
                method: Method::Sprites,
                shading: Shading::default(),
                sky: behind.sky,
                weather: false,
                sea: behind.sea,
            };
            Pipelines::new(context, &Shader::new(dome), groups)
        });
    }

    /// Computes a frame and records the pictures of the ring that it draws. Parameters are in range.
    pub fn record(
        &mut self,
        context: &Context,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        frame: &Frame<'_>,
    ) {
        let (device, sheet) = (&context.device, &self.sheet.clone());
        let asked = frame.params.sprites.distance_m;
        let sight_m = self
            .scene
            .sight_m(asked, device.limits().max_texture_dimension_2d);
        if self.scene.fit(sight_m) {
            self.refit(device, sheet, sight_m);
        }
        if let Some(exposures) = self.unwritten.take() {
            write_exposures(queue, &self.exposed, &exposures);
        }
        let viewer_m = frame.viewer_m();
        if self.scene.form(frame.params, frame.seconds) {
            write_amounts(queue, &self.amounts, &self.scene.amounts);
        }
        self.scene.lock(viewer_m);
        let screen = screen_view(context.config.depth, frame, sheet);
        queue.write_buffer(&self.views, 0, bytemuck::bytes_of(&screen));
        self.blocks.bytes.clear();
        self.draws.clear();
        let now = station(frame, viewer_m, sight_m, self.scene.heights_m);
        self.step_ring(context, now);
        let pictures = self.gather_pictures(queue, sheet, frame);
        self.gather_cast(context, queue, sheet, frame, sight_m);
        self.gather_screen(queue, &screen, frame, sight_m);
        queue.write_buffer(&self.blocks.buffer, 0, &self.blocks.bytes);
        self.record_pictures(encoder, shared, Behind::of(frame.params), pictures);
    }

    /// Draws the recorded frame over the sky.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, behind: Behind) {
        let Some(pipelines) = &self.pipelines[behind.index()] else {
            return;
        };
        if let Some(group) = self.ring_group.as_ref().filter(|_| self.ring_shows) {
            pass.set_pipeline(&pipelines.ring);
            pass.set_bind_group(1, group, &[0]);
            pass.draw(0..RING_VERTICES, 0..1);
        }
        pass.set_pipeline(&pipelines.sprites);
        for (draw, block) in &self.draws[self.cast..] {
            self.draw_block(pass, draw, 0, *block);
        }
    }

    /// Forgets what it knows of earlier frames: the next one is as that of a new sky.
    pub fn reset_history(&mut self) {
        self.ring = None;
        self.scene.reset_history();
    }

    /// Share of the sun's light that comes through to the viewer.
    pub fn clear_towards_sun(&self, frame: &Frame<'_>, sun: Vec3) -> f32 {
        let own = &frame.params.sprites;
        let reach = f64::from(own.distance_m);
        self.scene
            .clear_towards(sun, frame.viewer_m(), reach, frame.look.opacity)
    }

    /// Sprites that the recorded frame draws, on the screen and into the ring.
    pub fn drawn(&self) -> [u64; 2] {
        let count = |draws: &[(Draw, u32)]| draws.iter().map(|(d, _)| u64::from(d.count)).sum();
        [
            count(&self.draws[self.cast..]),
            count(&self.draws[..self.pictured]),
        ]
    }

    /// Bytes of the ring's pictures.
    pub fn ring_bytes(&self) -> u64 {
        self.pictures.iter().flatten().count() as u64 * station::BYTES
    }

    /// Bytes of all that it keeps on the device: sprites in sight, uniforms, amounts, pictures.
    pub fn bytes(&self) -> u64 {
        let [outlines, boxes] = &self.indices;
        let buffers = [&self.views, &self.blocks.buffer, outlines, boxes];
        buffers.iter().map(|b| b.size()).sum::<u64>()
            + u64::from(self.instances.height() * INSTANCES_PER_ROW) * size_of::<Instance>() as u64
            + self.scene.amounts.len() as u64
            + self.exposed_bytes()
            + self.ring_bytes()
    }

    fn exposed_bytes(&self) -> u64 {
        let size = self.exposed[0].size();
        2 * 4 * u64::from(size.width * size.height * size.depth_or_array_layers)
    }

    fn refit(&mut self, device: &wgpu::Device, sheet: &wgpu::Texture, sight_m: f32) {
        let slots = slots_a_side(sight_m).pow(2);
        self.instances = instances_texture(device, self.scene.rows(sight_m));
        self.blocks = Blocks::new(device, slots, self.exposed_span);
        self.draws = Vec::with_capacity(BLOCKS_A_SLOT * slots);
        self.found = Vec::with_capacity(slots);
        self.sprites_group = sprites_group(
            device,
            &self.groups,
            [sheet, &self.amounts, &self.instances],
            &self.exposed,
            [&self.views, &self.blocks.buffer, &self.outlines],
        );
    }

    /// Finds the blocks within a distance of a place of the field that are wanted and in view from there, the farthest first.
    fn find(
        &mut self,
        place_m: DVec3,
        distance_m: f64,
        sides: &[Vec3],
        wanted: impl Fn(BlockId) -> bool,
    ) {
        self.found.clear();
        for block in around(place_m, distance_m) {
            if wanted(block) && self.scene.is_in_view(block, place_m, sides) {
                self.found
                    .push((block.distance_of_middle_m(place_m), block));
            }
        }
        self.found
            .sort_unstable_by(|(a, block), (b, other)| b.total_cmp(a).then(block.cmp(other)));
    }

    fn gather_screen(
        &mut self,
        queue: &wgpu::Queue,
        screen: &SpriteView,
        frame: &Frame<'_>,
        sight_m: f32,
    ) {
        let viewer_m = frame.viewer_m();
        let sides = planes(screen.clip_x, screen.clip_y, screen.clip_w);
        let Some(ring) = self.ring else {
            return;
        };
        self.find(viewer_m, f64::from(sight_m), &sides, |block| {
            ring.share_of_sprites(block) > 0.0
        });
        for index in 0..self.found.len() {
            let (_, block) = self.found[index];
            let share = ring.share_of_sprites(block);
            self.add_block(queue, frame, block, viewer_m, share);
        }
        let (uniforms, shows) = ring.uniforms(viewer_m);
        self.ring_shows = shows && self.ring_group.is_some();
        queue.write_buffer(&self.ring_uniforms, 0, bytemuck::bytes_of(&uniforms));
    }

    /// Adds a block as it is seen from a place of the field, if it holds anything.
    fn add_block(
        &mut self,
        queue: &wgpu::Queue,
        frame: &Frame<'_>,
        block: BlockId,
        viewpoint_m: DVec3,
        share: f32,
    ) {
        let end = frame.look.billboards_m;
        let billboards = [end - 1.0 / frame.look.change_per_m, end];
        let instances = &self.instances;
        let upload = |row: u32, sprites: &[Instance]| upload(queue, instances, row, sprites);
        let viewer_m = frame.viewer_m();
        let draw = self
            .scene
            .draw(block, viewer_m, viewpoint_m, share, billboards, upload);
        if let Some(draw) = draw
            && let Some(offset) = self.blocks.add(&draw)
        {
            self.draws.push((draw, offset));
        }
    }

    fn draw_block(&self, pass: &mut wgpu::RenderPass<'_>, draw: &Draw, view: u32, block: u32) {
        pass.set_bind_group(1, &self.sprites_group, &[view, block]);
        let [outlines, boxes] = &self.indices;
        let indices = if draw.vertices == outline::BOX {
            boxes
        } else {
            outlines
        };
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..draw.count * outline::index_count(draw.vertices), 0, 0..1);
    }
}

/// Vertices of the ring's walls: two at each corner, the first one twice.
const RING_VERTICES: u32 = 2 * (station::PICTURES as u32 + 1);
