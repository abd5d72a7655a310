//! What all views of a sky share: the device, the pack on it and in memory, and the pipelines that were made.

use welkin_pack::{Pack, Role};
use wgpu::util::DeviceExt;

use crate::device::config::{Output, SkyConfig, opacity, output, step};
use crate::device::context::Context;
use crate::device::layouts::Layouts;
use crate::device::shader::Build;
use crate::device::upload::{SharedTextures, upload};
use crate::error::SkyError;
use crate::frame::Uniforms;
use crate::geometry::dome;
use crate::pack_data::PackData;
use crate::params::Method;
use crate::parts;
#[cfg(feature = "sprites")]
use crate::sprites::layer::Stock;

/// What of a sky is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Drawn {
    /// All of it.
    Sky,
    /// The opacity of its clouds.
    Opacity,
    /// What lies over a clear sky that is there.
    OverClear,
}

/// What all views of a sky share.
#[derive(Debug)]
pub(super) struct Common {
    pub context: Context,
    pub textures: SharedTextures,
    /// Bytes that each method's own textures of the pack have, at its place in [`Method::ALL`].
    pub pack_bytes: [u64; Method::ALL.len()],
    pub pack_data: PackData,
    /// From one level of the target to the next.
    pub step: f32,
    pub dome: Option<DomeBuffers>,
    #[cfg(feature = "sprites")]
    pub stock: Stock,
}

/// The dome's mesh on the device.
#[derive(Clone, Debug)]
pub(super) struct DomeBuffers {
    pub vertices: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub count: u32,
}

impl Common {
    /// Uploads a pack; without a step of the dome's mesh the sky is a triangle over the screen. Over another sky it has no clear sky of its own.
    ///
    /// # Errors
    /// See [`SkyError`]; the device is not touched before the configuration has been looked at.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
        dome_step_deg: Option<f32>,
        drawn: Drawn,
    ) -> Result<Common, SkyError> {
        let pack_data = PackData::new(pack)?;
        let features = device.features();
        let over = drawn == Drawn::OverClear;
        let build = Build {
            output: match drawn {
                Drawn::Sky | Drawn::OverClear => output(&config, features)?,
                Drawn::Opacity => opacity(&config, features)?,
            },
            reversed_depth: config.depth.is_some_and(|d| d.reversed),
            skybox: pack_data.skybox.is_some(),
            catalogue: pack_data.catalogue.is_some(),
            over,
        };
        let usable = config.target_format.guaranteed_format_features(features);
        let blends = usable
            .flags
            .contains(wgpu::TextureFormatFeatureFlags::BLENDABLE);
        if over && (build.output != Output::Radiance || !blends) {
            return Err(SkyError::OverFormat {
                format: config.target_format,
            });
        }
        let bytes = |role: Role| {
            let levels = pack.texture(role).map(|texture| &texture.levels);
            levels.map_or(0, |levels| {
                levels.iter().map(|level| level.len() as u64).sum()
            })
        };
        let mut own = [const { None }; Method::ALL.len()];
        for method in Method::ALL {
            let clouds = method.clouds();
            if clouds.uploads() {
                own[method as usize] = Some(upload(device, queue, pack, clouds.role())?);
            }
        }
        let context = Context {
            own,
            clouds_texels: pack_data.clouds_texels,
            mesh: dome_step_deg.is_some(),
            blends,
            device: device.clone(),
            config,
            build,
            compose: parts::text,
            layouts: Layouts::new(device, size_of::<Uniforms>() as u64),
            made: Default::default(),
        };
        Ok(Common {
            textures: SharedTextures::new(device, queue, pack)?,
            pack_bytes: Method::ALL.map(|method| bytes(method.clouds().role())),
            step: step(config.target_format),
            dome: dome_step_deg.map(|step| dome_buffers(device, step)),
            #[cfg(feature = "sprites")]
            stock: Stock::new(pack)?,
            context,
            pack_data,
        })
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
