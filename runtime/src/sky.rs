//! The sky on a device: what is made once, what is written each frame, what is drawn.
//!
//! # Practice
//! [`Sky`] owns the pack's textures, some three megabytes, and one uniform buffer. What only one method needs, its pipelines
//! and its map, is made when that method is first prepared or [`Sky::load`]ed, and kept. Draw after the opaque scene:
//! pixels that the scene covers then cost nothing.

use welkin_pack::{Field, Pack, Role};
use wgpu::util::DeviceExt;

use crate::clear_sky::flares;
use crate::clouds::shadow::{self, Shadow};
use crate::device::common::Common;
use crate::device::config::{SkyConfig, output, step};
use crate::device::layouts::Layouts;
use crate::device::pipeline::Variant;
use crate::device::shader::Build;
use crate::device::upload::{shared_group, upload};
use crate::error::{SkyError, texture};
use crate::frame::Uniforms;
use crate::geometry::camera::Camera;
use crate::geometry::dome;
use crate::geometry::math::finite;
use crate::pack_data::PackData;
use crate::params::{DEFAULT_OCTAVES, Method, SkyModel, SkyParams};
use crate::parts::PARTS;
use crate::program::{OwnMap, Program};
use crate::sprites;
use crate::sprites::outline::{Outline, outlines};
use crate::weather::rain;

/// A sky on a device.
#[derive(Debug)]
pub struct Sky {
    common: Common,
    shared: wgpu::BindGroup,
    buffer: wgpu::Buffer,
    /// Bytes that each method's own textures of the pack have, at its place in [`Method::ALL`].
    pack_bytes: [u64; Method::ALL.len()],
    pack_data: PackData,
    step: f32,
    dome: Option<DomeBuffers>,
    programs: [Option<Program>; Method::ALL.len()],
    field: Option<Field>,
    outlines: Vec<Outline>,
    sprites: Option<Box<sprites::pass::Pass>>,
    prepared: Option<Prepared>,
}

/// What the prepared frame draws with.
#[derive(Clone, Copy, Debug)]
struct Prepared {
    method: Method,
    sky: SkyModel,
    variant: Variant,
    rays: bool,
    /// Vertices of the rain, 0 without.
    rain: u32,
    flare: bool,
    shadow: Option<shadow::Area>,
    sprites: bool,
}

/// The dome's mesh on the device.
#[derive(Debug)]
struct DomeBuffers {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    count: u32,
}

impl Sky {
    /// Uploads the textures of a pack and builds the pipelines. The sky is drawn as one triangle over the screen.
    ///
    /// # Errors
    /// See [`SkyError`]; the device is not touched before the configuration has been looked at.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
    ) -> Result<Sky, SkyError> {
        Sky::build(device, queue, config, pack, None)
    }

    /// As [`Sky::new`], drawn on the papers' dome mesh with a vertex every `step_deg` degrees: the same
    /// picture above the horizon, and nothing below it. See [`dome::mesh`].
    ///
    /// # Errors
    /// As [`Sky::new`].
    pub fn with_dome_mesh(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
        step_deg: f32,
    ) -> Result<Sky, SkyError> {
        Sky::build(device, queue, config, pack, Some(step_deg))
    }

    fn build(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
        dome_step_deg: Option<f32>,
    ) -> Result<Sky, SkyError> {
        let pack_data = PackData::new(pack)?;
        let features = device.features();
        let build = Build {
            output: output(&config, features)?,
            reversed_depth: config.depth.is_some_and(|d| d.reversed),
            method: Method::Packed,
            sky: SkyModel::Gradient,
            skybox: pack_data.skybox.is_some(),
        };
        let layouts = Layouts::new(device, size_of::<Uniforms>() as u64);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("sky uniforms"),
            size: size_of::<Uniforms>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bytes = |role: Role| {
            let levels = pack.texture(role).map(|texture| &texture.levels);
            levels.map_or(0, |levels| {
                levels.iter().map(|level| level.len() as u64).sum()
            })
        };
        let usable = config.target_format.guaranteed_format_features(features);
        let common = Common {
            fbm: upload(device, queue, pack, Role::Fbm)?,
            layers: upload(device, queue, pack, Role::Layers)?,
            sheet: upload(device, queue, pack, Role::Sprites)?,
            mesh: dome_step_deg.is_some(),
            blends: usable
                .flags
                .contains(wgpu::TextureFormatFeatureFlags::BLENDABLE),
            device: device.clone(),
            config,
            build,
            parts: &PARTS,
            layouts,
        };
        Ok(Sky {
            shared: shared_group(device, queue, pack, &common.layouts, &buffer)?,
            pack_bytes: [
                Role::Clouds,
                Role::Octaves,
                Role::Fbm,
                Role::Layers,
                Role::Sprites,
            ]
            .map(bytes),
            step: step(config.target_format),
            dome: dome_step_deg.map(|step| dome_buffers(device, step)),
            programs: [const { None }; Method::ALL.len()],
            field: pack.field().cloned(),
            outlines: outlines(texture(pack, Role::Sprites)?),
            sprites: None,
            prepared: None,
            common,
            buffer,
            pack_data,
        })
    }

    /// Compiles the shader of a method with a sky model and makes the method's map, so that their first frame need not.
    /// For [`Method::Sprites`] that is what draws the sprites over a clear dome.
    pub fn load(&mut self, method: Method, sky: SkyModel) {
        let octaves = DEFAULT_OCTAVES;
        let params = SkyParams {
            method,
            sky,
            ..SkyParams::default()
        };
        self.fit_sprites(&params);
        let dome = params.dome().method;
        fitting(&mut self.programs, &self.common, dome, sky, octaves);
    }

    /// Makes what draws sprites, if the parameters want them and pack and target allow them.
    fn fit_sprites(&mut self, params: &SkyParams) -> Option<&mut sprites::pass::Pass> {
        let field = self.field.as_ref()?;
        if params.method != Method::Sprites || !self.common.blends {
            return None;
        }
        let (common, outlines) = (&self.common, &self.outlines);
        let distance_m = params.sprites.distance_m;
        let pass = self.sprites.get_or_insert_with(|| {
            sprites::pass::Pass::new(common, field, outlines, distance_m).into()
        });
        pass.load(common, params.sky);
        Some(pass)
    }

    /// Whether the pack has what a method draws from.
    ///
    /// # Errors
    /// [`SkyError::MissingField`] for [`Method::Sprites`] with a pack that has no clouds in space: it then draws the dome alone.
    pub fn supports(&self, method: Method) -> Result<(), SkyError> {
        if method == Method::Sprites && self.field.is_none() {
            return Err(SkyError::MissingField);
        }
        Ok(())
    }

    /// Forgets what [`Method::Sprites`] keeps of earlier frames, its ring of impostors and the facing of sprites near the viewer: the next
    /// frame is drawn as a new sky would draw it. No other method keeps anything.
    pub fn forget(&mut self) {
        if let Some(pass) = &mut self.sprites {
            pass.forget();
        }
    }

    /// Sprites that the prepared frame draws: on the screen, and into the ring of impostors.
    pub fn sprites_drawn(&self) -> [u64; 2] {
        let shows = self.prepared.is_some_and(|prepared| prepared.sprites);
        let pass = self.sprites.as_ref().filter(|_| shows);
        pass.map_or([0; 2], |pass| pass.drawn())
    }

    /// Bytes of the ring of impostors: 2 MiB, and 4 MiB while it changes.
    pub fn ring_bytes(&self) -> u64 {
        self.sprites.as_ref().map_or(0, |pass| pass.ring_bytes())
    }

    /// Computes a frame: writes its uniforms and records the off-screen passes of its method into `encoder`, before the
    /// pass in which the sky is drawn. `seconds` moves clouds and stars; any value will do.
    ///
    /// Nothing of a picture is remembered from frame to frame: the same arguments give the same picture, but with
    /// [`Method::Sprites`], see [`Sky::forget`]. Submit the encoder before the next frame is prepared.
    pub fn prepare(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
    ) {
        let whole = params.clamped();
        let params = whole.dome();
        let mut uniforms = self.pack_data.uniforms(&whole, camera, seconds, self.step);
        self.fit_sprites(&whole);
        let seconds = finite(seconds);
        let (screen, look) = (uniforms.camera, uniforms.sprites);
        let frame = sprites::frame::Frame {
            params: &whole,
            camera,
            seconds,
            screen: &screen,
            look: &look,
        };
        let shown = self
            .sprites
            .as_mut()
            .filter(|_| whole.method == Method::Sprites);
        let sprites = shown.is_some();
        if let Some(pass) = shown {
            pass.record(&self.common, queue, encoder, &self.shared, &frame);
            if uniforms.flares.strength > 0.0 {
                let sun = uniforms.sky.sun_direction;
                uniforms.flares.strength *= pass.clear_towards_sun(&frame, sun);
            }
        }
        queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(&uniforms));
        let states = match params.method {
            Method::Octaves => self.pack_data.octave_states(&params, seconds),
            _ => Vec::new(),
        };
        let program = fitting(
            &mut self.programs,
            &self.common,
            params.method,
            params.sky,
            params.octaves.count,
        );
        match &mut program.map {
            OwnMap::None => {}
            OwnMap::Octaves(pass) => pass.record(queue, encoder, &self.shared, &states),
            OwnMap::Fbm(pass) => pass.record(encoder, &self.shared, uniforms.fbm.sun_step),
            OwnMap::Lit(pass) => pass.record(encoder, &self.shared, uniforms.lit.count as usize),
        }
        let shadow = shadow::Area::of(&params, camera.position_m().as_dvec3());
        if shadow.is_some() {
            program.record_shadow(&self.common, encoder, &self.shared);
        }
        let rays = uniforms.rays.opacity > 0.0;
        let rain = rain::vertices(&uniforms.rain);
        if rays {
            program.record_rays(&self.common, encoder, &self.shared);
        }
        let variant = Variant::of(&uniforms);
        // A flash that is told is made ready for before it begins.
        if variant.weather || params.weather.lightning.strength > 0.0 {
            program.fit_sky(&self.common, params.sky, true);
        }
        if rain > 0 {
            program.fit_rain(&self.common);
        }
        self.prepared = Some(Prepared {
            method: params.method,
            sky: params.sky,
            variant,
            rays,
            rain,
            flare: uniforms.flares.strength > 0.0,
            shadow,
            sprites,
        });
    }

    /// Draws the prepared frame into a pass whose attachments are as the configuration said.
    ///
    /// Before the first [`Sky::prepare`] there is nothing to draw.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some((prepared, program)) = self.current() else {
            return;
        };
        let Some(pipeline) = program.pipeline(prepared.sky, prepared.variant) else {
            return;
        };
        pass.set_bind_group(0, &self.shared, &[]);
        if let Some(group) = program.map.group() {
            pass.set_bind_group(1, group, &[]);
        }
        pass.set_pipeline(pipeline);
        match &self.dome {
            None => pass.draw(0..3, 0..1),
            Some(dome) => {
                pass.set_vertex_buffer(0, dome.vertices.slice(..));
                pass.set_index_buffer(dome.indices.slice(..), wgpu::IndexFormat::Uint16);
                pass.draw_indexed(0..dome.count, 0, 0..1);
            }
        }
        // What lies over the sky, from the farthest to the nearest.
        if let Some(sprites) = self.sprites.as_ref().filter(|_| prepared.sprites) {
            sprites.draw(pass, prepared.sky);
        }
        if let Some(rays) = program.rays.as_ref().filter(|_| prepared.rays) {
            pass.set_pipeline(&rays.overlay);
            pass.set_bind_group(1, rays.group(), &[]);
            pass.draw(0..3, 0..1);
        }
        if let Some(rain) = program.rain.as_ref().filter(|_| prepared.rain > 0) {
            pass.set_pipeline(rain);
            pass.draw(0..prepared.rain, 0..1);
        }
        if let Some(flare) = program.flare.as_ref().filter(|_| prepared.flare) {
            pass.set_pipeline(flare);
            if let Some(group) = program.map.group() {
                pass.set_bind_group(1, group, &[]);
            }
            pass.draw(0..4, 0..flares::COUNT);
        }
    }

    /// The cloud map of the prepared frame, if its method draws one: it tiles, and level 0 is as fine as it gets.
    ///
    /// Its red channel is the amount of cloud ([`Method::Octaves`], before cover) or the shade ([`Method::Fbm`], with
    /// the cover in alpha). That of [`Method::Lit`] is an array, a layer each (see [`crate::clouds::lit_map`]); its last one is empty.
    pub fn cloud_map(&self) -> Option<&wgpu::Texture> {
        let (_, program) = self.current()?;
        program.map.texture()
    }

    /// The shadows that the clouds of the prepared frame throw on the ground: see [`crate::clouds::shadow`].
    ///
    /// None without [`Method::Lit`], and where [`SkyParams::shadow_extent_m`] is 0.
    pub fn shadow(&self) -> Option<Shadow<'_>> {
        let (prepared, program) = self.current()?;
        let area = prepared.shadow?;
        Some(Shadow {
            texture: program.shadow()?,
            centre_m: area.centre_m.as_vec2().to_array(),
            extent_m: area.extent_m as f32,
        })
    }

    /// Bytes of the textures that only this method reads: its own of the pack and, once they are made, those that it draws.
    pub fn memory_bytes(&self, method: Method) -> u64 {
        let own = self.programs[method as usize].as_ref();
        let sprites = self
            .sprites
            .as_ref()
            .filter(|_| method == Method::Sprites)
            .map_or(0, |pass| pass.bytes());
        self.pack_bytes[method as usize] + own.map_or(0, Program::bytes) + sprites
    }

    fn current(&self) -> Option<(Prepared, &Program)> {
        let prepared = self.prepared?;
        Some((prepared, self.programs[prepared.method as usize].as_ref()?))
    }
}

/// The program of a method with the pipelines of a sky model, made if they are not there yet; `octaves` is how many
/// [`Method::Octaves`] sums.
fn fitting<'a>(
    programs: &'a mut [Option<Program>; Method::ALL.len()],
    common: &Common,
    method: Method,
    sky: SkyModel,
    octaves: u32,
) -> &'a mut Program {
    let new = || Program::new(common, method, sky, octaves);
    let program = programs[method as usize].get_or_insert_with(new);
    program.fit(common, sky, octaves);
    program
}

fn dome_buffers(device: &wgpu::Device, step_deg: f32) -> DomeBuffers {
    let mesh = dome::mesh(step_deg);
    let buffer = |contents: &[u8], usage: wgpu::BufferUsages| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("dome"),
            contents,
            usage,
        })
    };
    DomeBuffers {
        vertices: buffer(
            bytemuck::cast_slice(&mesh.vertices),
            wgpu::BufferUsages::VERTEX,
        ),
        indices: buffer(
            bytemuck::cast_slice(&mesh.indices),
            wgpu::BufferUsages::INDEX,
        ),
        count: mesh.indices.len() as u32,
    }
}
