//! The sky on a device: what is made once, what is written each frame, what is drawn.
//!
//! # Practice
//! [`Sky`] owns its pipelines, five textures and one uniform buffer, a few hundred kilobytes in all. Draw
//! after the opaque scene: pixels that the scene covers then cost nothing.

use welkin_pack::Pack;
use wgpu::util::DeviceExt;

use crate::dome;
use crate::frame::Facts;
use crate::pipeline::{TEXTURES, Variant, bind_group_layout, pipelines, shader_text};
use crate::uniforms::Uniforms;
use crate::upload::upload;
use crate::{Camera, SkyError, SkyParams, tonemap};

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
    pipelines: [wgpu::RenderPipeline; 4],
    /// The one that the prepared frame needs.
    variant: Variant,
    bind_group: wgpu::BindGroup,
    buffer: wgpu::Buffer,
    facts: Facts,
    step: f32,
    dome: Option<DomeBuffers>,
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
        let text = shader_text(&config, device.features())?;
        let layout = bind_group_layout(device);
        let pipelines = pipelines(device, &config, &text, &layout, dome_step_deg.is_some());
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("sky uniforms"),
            size: size_of::<Uniforms>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bind_group = bind_group(device, queue, pack, &layout, &buffer)?;
        let step = tonemap::step(config.target_format);
        let dome = dome_step_deg.map(|step| dome_buffers(device, step));
        Ok(Sky {
            pipelines,
            variant: Variant::ALL[0],
            bind_group,
            buffer,
            facts,
            step,
            dome,
        })
    }

    /// Computes a frame and writes its uniforms. `seconds` moves clouds and stars; any value will do.
    ///
    /// Nothing is remembered from frame to frame: the same arguments give the same picture.
    pub fn prepare(
        &mut self,
        queue: &wgpu::Queue,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
    ) {
        let uniforms = self.facts.uniforms(params, camera, seconds, self.step);
        self.variant = Variant::of(&uniforms);
        queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(&uniforms));
    }

    /// Draws the prepared frame into a pass whose attachments are as the configuration said.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipelines[self.variant.index()]);
        pass.set_bind_group(0, &self.bind_group, &[]);
        match &self.dome {
            None => pass.draw(0..3, 0..1),
            Some(dome) => {
                pass.set_vertex_buffer(0, dome.vertices.slice(..));
                pass.set_index_buffer(dome.indices.slice(..), wgpu::IndexFormat::Uint16);
                pass.draw_indexed(0..dome.count, 0, 0..1);
            }
        }
    }
}

fn bind_group(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    pack: &Pack,
    layout: &wgpu::BindGroupLayout,
    buffer: &wgpu::Buffer,
) -> Result<wgpu::BindGroup, SkyError> {
    let samplers = [wgpu::AddressMode::Repeat, wgpu::AddressMode::ClampToEdge]
        .map(|mode| sampler(device, mode));
    let views = TEXTURES
        .map(|(binding, role)| upload(device, queue, pack, role).map(|view| (binding, view)));
    let views = views.into_iter().collect::<Result<Vec<_>, SkyError>>()?;
    let mut entries = vec![
        wgpu::BindGroupEntry {
            binding: 0,
            resource: buffer.as_entire_binding(),
        },
        wgpu::BindGroupEntry {
            binding: 1,
            resource: wgpu::BindingResource::Sampler(&samplers[0]),
        },
        wgpu::BindGroupEntry {
            binding: 2,
            resource: wgpu::BindingResource::Sampler(&samplers[1]),
        },
    ];
    entries.extend(views.iter().map(|(binding, view)| wgpu::BindGroupEntry {
        binding: *binding,
        resource: wgpu::BindingResource::TextureView(view),
    }));
    Ok(device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("sky"),
        layout,
        entries: &entries,
    }))
}

fn sampler(device: &wgpu::Device, mode: wgpu::AddressMode) -> wgpu::Sampler {
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("sky"),
        address_mode_u: mode,
        address_mode_v: mode,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..Default::default()
    })
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
