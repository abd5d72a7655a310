//! Textures of a pack on the device.

use welkin_pack::{Format, Pack, Role, Shape, Texture};
use wgpu::util::{DeviceExt, TextureDataOrder};

use super::layouts::{CATALOGUE_BINDING, Layouts, SKY_BINDING, SKYBOX_BINDING, TEXTURES};
use crate::device::layouts::array_layers;
use crate::error::{SkyError, texture};

/// Uploads the texture of a role with all its levels; an array gets what [`array_layers`] adds, as zeros.
///
/// # Errors
/// [`SkyError::MissingTexture`], [`SkyError::TextureTooLarge`].
pub(crate) fn upload(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    pack: &Pack,
    role: Role,
) -> Result<wgpu::Texture, SkyError> {
    let texture = texture(pack, role)?;
    refuse_too_large(role, texture, device.limits().max_texture_dimension_2d)?;
    let (width, height) = (texture.width, texture.height);
    let layers = match texture.shape {
        Shape::Array => array_layers(texture.layers),
        Shape::D2 | Shape::Cube => texture.layers,
    };
    let descriptor = wgpu::TextureDescriptor {
        label: Some(role.name()),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: layers,
        },
        mip_level_count: texture.levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: format(texture),
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    let mut bytes = Vec::new();
    for level in &texture.levels {
        let end = bytes.len() + level.len() / texture.layers as usize * layers as usize;
        bytes.extend_from_slice(level);
        bytes.resize(end, 0);
    }
    Ok(device.create_texture_with_data(queue, &descriptor, TextureDataOrder::MipMajor, &bytes))
}

/// The skybox as a cube; a single empty texel a face if the pack has none.
///
/// # Errors
/// As [`upload`].
pub(crate) fn upload_skybox(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    pack: &Pack,
) -> Result<wgpu::Texture, SkyError> {
    if pack.texture(Role::Skybox).is_some() {
        return upload(device, queue, pack, Role::Skybox);
    }
    let descriptor = wgpu::TextureDescriptor {
        label: Some("no skybox"),
        size: wgpu::Extent3d {
            width: 1,
            height: 1,
            depth_or_array_layers: 6,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    let order = TextureDataOrder::MipMajor;
    Ok(device.create_texture_with_data(queue, &descriptor, order, &[0; 24]))
}

/// An empty plane that is written from here, now and again, and read.
pub(crate) fn written(
    device: &wgpu::Device,
    label: &str,
    format: wgpu::TextureFormat,
    [width, height]: [u32; 2],
) -> wgpu::Texture {
    written_array(device, label, format, [width, height, 1])
}

/// The same of several layers.
pub(crate) fn written_array(
    device: &wgpu::Device,
    label: &str,
    format: wgpu::TextureFormat,
    [width, height, depth_or_array_layers]: [u32; 3],
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// `limit` is the device's `max_texture_dimension_2d`.
fn refuse_too_large(role: Role, texture: &Texture, limit: u32) -> Result<(), SkyError> {
    let (width, height) = (texture.width, texture.height);
    if width.max(height) > limit {
        return Err(SkyError::TextureTooLarge {
            role,
            width,
            height,
            limit,
        });
    }
    Ok(())
}

fn format(texture: &Texture) -> wgpu::TextureFormat {
    match texture.format {
        Format::R8Unorm => wgpu::TextureFormat::R8Unorm,
        Format::Rg8Unorm => wgpu::TextureFormat::Rg8Unorm,
        Format::Rgba8Unorm => wgpu::TextureFormat::Rgba8Unorm,
        Format::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
    }
}

/// The samplers, and the pack's textures that every method may read.
#[derive(Debug)]
pub(crate) struct SharedTextures {
    samplers: [wgpu::Sampler; 2],
    /// By binding.
    views: Vec<(u32, wgpu::TextureView)>,
}

impl SharedTextures {
    /// Uploads those of a pack.
    ///
    /// # Errors
    /// As [`upload`].
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        pack: &Pack,
    ) -> Result<SharedTextures, SkyError> {
        let mut views = Vec::new();
        for (binding, role) in TEXTURES {
            let texture = upload(device, queue, pack, role)?;
            views.push((binding, texture.create_view(&Default::default())));
        }
        let skybox = upload_skybox(device, queue, pack)?;
        let cube = skybox.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::Cube),
            ..Default::default()
        });
        views.push((SKYBOX_BINDING, cube));
        Ok(SharedTextures {
            samplers: [wgpu::AddressMode::Repeat, wgpu::AddressMode::ClampToEdge]
                .map(|mode| sampler(device, mode)),
            views,
        })
    }

    /// Group 0 of a view, with its uniforms, the clear sky of its moment and the stars of a catalogue on its screen.
    pub fn group(
        &self,
        device: &wgpu::Device,
        layouts: &Layouts,
        uniforms: &wgpu::Buffer,
        [sky, catalogue]: [&wgpu::Texture; 2],
    ) -> wgpu::BindGroup {
        let [sky, catalogue] = [sky, catalogue].map(|t| t.create_view(&Default::default()));
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let mut entries = vec![
            entry(0, uniforms.as_entire_binding()),
            entry(SKY_BINDING, wgpu::BindingResource::TextureView(&sky)),
            entry(
                CATALOGUE_BINDING,
                wgpu::BindingResource::TextureView(&catalogue),
            ),
        ];
        let samplers = (1..).zip(&self.samplers);
        entries.extend(samplers.map(|(at, s)| entry(at, wgpu::BindingResource::Sampler(s))));
        let views = self.views.iter();
        entries.extend(views.map(|(at, v)| entry(*at, wgpu::BindingResource::TextureView(v))));
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("sky"),
            layout: &layouts.shared,
            entries: &entries,
        })
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texture_over_the_devices_limit_is_refused_with_its_size() {
        let texture = Texture {
            format: Format::R8Unorm,
            shape: welkin_pack::Shape::D2,
            width: 4096,
            height: 2,
            layers: 1,
            levels: Vec::new(),
        };
        assert_eq!(refuse_too_large(Role::Clouds, &texture, 4096), Ok(()));
        let message = refuse_too_large(Role::Clouds, &texture, 2048)
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("\"clouds\" is 4096x2") && message.contains("2048"),
            "{message}"
        );
    }
}
