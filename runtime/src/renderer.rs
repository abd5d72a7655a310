//! The sky on a device: what is made once, what is written each frame, what is drawn.
//!
//! # Practice
//! [`Sky`] owns the pack's textures, some three megabytes, and one uniform buffer. What only one method needs, its pipelines
//! and its map, is made when that method is first prepared or [`Sky::load`]ed, and kept. Draw after the opaque scene:
//! pixels that the scene covers then cost nothing.

use welkin_pack::{Pack, Role};
use wgpu::util::DeviceExt;

use crate::frame::Facts;
use crate::layouts::{Layouts, shared_group};
use crate::pipeline::{Variant, flare_pipeline, output, pipelines};
use crate::shader::{Build, compose};
use crate::uniforms::Uniforms;
use crate::upload::upload;
use crate::{
    Camera, Method, SkyError, SkyModel, SkyParams, dome, fbm_map, flares, map, octaves_map, tonemap,
};

/// What the sky is drawn onto.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyConfig {
    /// Format of the colour target. A float format gets raw radiance (linear BT.709, 1 is the white of a
    /// sunlit cloud at noon), the others a tonemapped and encoded picture. Alpha is always 1.
    pub target_format: wgpu::TextureFormat,
    /// Depth attachment of the pass, if it has one. It is tested, never written.
    pub depth: Option<DepthConfig>,
    /// Samples a pixel of the pass, 1 or 4.
    pub sample_count: u32,
}

/// The depth attachment of the pass in which the sky is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthConfig {
    /// Its format.
    pub format: wgpu::TextureFormat,
    /// Whether 0 is far and 1 near.
    pub reversed: bool,
}

/// A sky on a device.
#[derive(Debug)]
pub struct Sky {
    device: wgpu::Device,
    config: SkyConfig,
    build: Build,
    layouts: Layouts,
    shared: wgpu::BindGroup,
    buffer: wgpu::Buffer,
    /// The octaves of [`Method::Fbm`] as the pack has them.
    fbm: wgpu::Texture,
    /// Bytes that each method's own textures of the pack have, at its place in [`Method::ALL`].
    pack_bytes: [u64; Method::ALL.len()],
    facts: Facts,
    step: f32,
    dome: Option<DomeBuffers>,
    /// Whether the target can be added to.
    blends: bool,
    programs: [Option<Program>; Method::ALL.len()],
    prepared: Option<Prepared>,
}

/// What only one method needs.
#[derive(Debug)]
struct Program {
    /// Of each sky model, at its place in [`SkyModel::ALL`].
    pipelines: [Option<[wgpu::RenderPipeline; 4]>; SkyModel::ALL.len()],
    flare: Option<wgpu::RenderPipeline>,
    map: OwnMap,
}

/// The off-screen part of a method.
#[derive(Debug)]
enum OwnMap {
    None,
    Octaves(Box<octaves_map::Pass>),
    Fbm(Box<fbm_map::Pass>),
}

/// What the prepared frame draws with.
#[derive(Clone, Copy, Debug)]
struct Prepared {
    method: Method,
    sky: SkyModel,
    variant: Variant,
    flare: bool,
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
        let facts = Facts::new(pack)?;
        let features = device.features();
        let build = Build {
            output: output(&config, features)?,
            reversed_depth: config.depth.is_some_and(|d| d.reversed),
            method: Method::Packed,
            sky: SkyModel::Gradient,
            skybox: facts.skybox.is_some(),
        };
        let layouts = Layouts::new(device);
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
        Ok(Sky {
            shared: shared_group(device, queue, pack, &layouts, &buffer)?,
            fbm: upload(device, queue, pack, Role::Fbm)?,
            pack_bytes: [Role::Clouds, Role::Octaves, Role::Fbm].map(bytes),
            step: tonemap::step(config.target_format),
            dome: dome_step_deg.map(|step| dome_buffers(device, step)),
            blends: usable
                .flags
                .contains(wgpu::TextureFormatFeatureFlags::BLENDABLE),
            programs: [const { None }; Method::ALL.len()],
            prepared: None,
            device: device.clone(),
            config,
            build,
            layouts,
            buffer,
            facts,
        })
    }

    /// Compiles the shader of a method with a sky model and makes the method's map, so that their first frame need not.
    pub fn load(&mut self, method: Method, sky: SkyModel) {
        self.program(method, sky, octaves_map::DEFAULT_COUNT);
    }

    /// Computes a frame: writes its uniforms and records the off-screen passes of its method into `encoder`, before the
    /// pass in which the sky is drawn. `seconds` moves clouds and stars; any value will do.
    ///
    /// Nothing of a picture is remembered from frame to frame: the same arguments give the same picture. Submit the
    /// encoder before the next frame is prepared.
    pub fn prepare(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
    ) {
        let params = params.clamped();
        let uniforms = self.facts.uniforms(&params, camera, seconds, self.step);
        queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(&uniforms));
        let states = match params.method {
            Method::Octaves => self.facts.octave_states(&params, seconds),
            _ => Vec::new(),
        };
        let shared = self.shared.clone();
        let program = self.program(params.method, params.sky, params.octaves.count);
        match &mut program.map {
            OwnMap::None => {}
            OwnMap::Octaves(pass) => pass.record(queue, encoder, &shared, &states),
            OwnMap::Fbm(pass) => {
                let [x, y, ..] = uniforms.fbm.step;
                pass.record(encoder, &shared, [x, y]);
            }
        }
        self.prepared = Some(Prepared {
            method: params.method,
            sky: params.sky,
            variant: Variant::of(&uniforms),
            flare: uniforms.flares.light[0] > 0.0,
        });
    }

    /// Draws the prepared frame into a pass whose attachments are as the configuration said.
    ///
    /// Before the first [`Sky::prepare`] there is nothing to draw.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some((prepared, program)) = self.current() else {
            return;
        };
        let Some(pipelines) = &program.pipelines[prepared.sky as usize] else {
            return;
        };
        pass.set_bind_group(0, &self.shared, &[]);
        if let Some(map) = program.map.map() {
            pass.set_bind_group(1, &map.group, &[]);
        }
        pass.set_pipeline(&pipelines[prepared.variant.index()]);
        match &self.dome {
            None => pass.draw(0..3, 0..1),
            Some(dome) => {
                pass.set_vertex_buffer(0, dome.vertices.slice(..));
                pass.set_index_buffer(dome.indices.slice(..), wgpu::IndexFormat::Uint16);
                pass.draw_indexed(0..dome.count, 0, 0..1);
            }
        }
        if let Some(flare) = program.flare.as_ref().filter(|_| prepared.flare) {
            pass.set_pipeline(flare);
            pass.draw(0..4, 0..flares::COUNT);
        }
    }

    /// The cloud map of the prepared frame, if its method draws one: it tiles, and level 0 is as fine as it gets.
    ///
    /// Its red channel is the amount of cloud ([`Method::Octaves`], before cover) or the shade ([`Method::Fbm`], with
    /// the cover in alpha).
    pub fn cloud_map(&self) -> Option<&wgpu::Texture> {
        let (_, program) = self.current()?;
        program.map.map().map(map::Map::texture)
    }

    /// Bytes of the textures that only this method reads: its own of the pack and, once it is loaded, its map.
    pub fn memory_bytes(&self, method: Method) -> u64 {
        let own = self.programs[method as usize]
            .as_ref()
            .map_or(0, |program| match &program.map {
                OwnMap::None => 0,
                OwnMap::Octaves(pass) => pass.bytes(),
                OwnMap::Fbm(pass) => pass.bytes(),
            });
        self.pack_bytes[method as usize] + own
    }

    fn current(&self) -> Option<(Prepared, &Program)> {
        let prepared = self.prepared?;
        Some((prepared, self.programs[prepared.method as usize].as_ref()?))
    }

    /// The program of a method with the pipelines of a sky model, made if they are not there yet; `octaves` is how many
    /// [`Method::Octaves`] sums.
    fn program(&mut self, method: Method, sky: SkyModel, octaves: u32) -> &mut Program {
        let (device, layouts, config) = (&self.device, &self.layouts, &self.config);
        let build = Build {
            method,
            sky,
            ..self.build
        };
        let module = || {
            device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(method.name()),
                source: wgpu::ShaderSource::Wgsl(compose(build).into()),
            })
        };
        let mesh = self.dome.is_some();
        let slot = &mut self.programs[method as usize];
        let new = || {
            let module = module();
            let mut models = [const { None }; SkyModel::ALL.len()];
            models[sky as usize] = Some(pipelines(device, config, &module, layouts, method, mesh));
            Program {
                pipelines: models,
                flare: self
                    .blends
                    .then(|| flare_pipeline(device, config, &module, layouts, method)),
                map: match method {
                    Method::Packed => OwnMap::None,
                    Method::Octaves => OwnMap::Octaves(
                        octaves_map::Pass::new(device, &module, layouts, octaves).into(),
                    ),
                    Method::Fbm => {
                        OwnMap::Fbm(fbm_map::Pass::new(device, &module, layouts, &self.fbm).into())
                    }
                },
            }
        };
        let program = slot.get_or_insert_with(new);
        program.pipelines[sky as usize]
            .get_or_insert_with(|| pipelines(device, config, &module(), layouts, method, mesh));
        if let OwnMap::Octaves(pass) = &mut program.map {
            pass.fit(device, layouts, octaves);
        }
        program
    }
}

impl OwnMap {
    fn map(&self) -> Option<&map::Map> {
        match self {
            OwnMap::None => None,
            OwnMap::Octaves(pass) => Some(&pass.map),
            OwnMap::Fbm(pass) => Some(&pass.map),
        }
    }
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
