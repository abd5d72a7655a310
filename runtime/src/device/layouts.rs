//! The bind groups: what every pass shares in group 0, what a method or an off-screen pass adds in group 1.

use welkin_pack::Role;

/// Bindings of the textures, as frame.wgsl declares them.
pub(crate) const TEXTURES: [(u32, Role); 5] = [
    (3, Role::Clouds),
    (4, Role::Stars),
    (5, Role::Galaxy),
    (7, Role::Sun),
    (8, Role::Flares),
];

/// Binding of the clear sky of the moment.
pub(crate) const SKY_BINDING: u32 = 6;

/// Binding of the skybox, the only cube.
pub(crate) const SKYBOX_BINDING: u32 = 9;

/// Binding of the stars of a catalogue.
pub(crate) const CATALOGUE_BINDING: u32 = 10;

/// Layouts of the groups: what every pass shares in group 0, what a method adds in group 1.
#[derive(Debug)]
pub(crate) struct Layouts {
    /// Uniforms, samplers and the pack's textures.
    pub shared: wgpu::BindGroupLayout,
    /// One 2-D texture, at binding 0.
    pub texture: wgpu::BindGroupLayout,
    /// One array of textures, at binding 1.
    pub layers: wgpu::BindGroupLayout,
    /// Two arrays: the pack's layers at binding 1, their map at binding 2.
    pub lit: wgpu::BindGroupLayout,
}

impl Layouts {
    pub fn new(device: &wgpu::Device, uniform_bytes: u64) -> Layouts {
        let own = |bindings: &[u32], dimension| {
            let entries = bindings.iter().map(|&b| entry(b, texture(true, dimension)));
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("sky, a method's own"),
                entries: &entries.collect::<Vec<_>>(),
            })
        };
        Layouts {
            shared: shared_layout(device, uniform_bytes),
            texture: own(&[0], wgpu::TextureViewDimension::D2),
            layers: own(&[1], wgpu::TextureViewDimension::D2Array),
            lit: own(&[1, 2], wgpu::TextureViewDimension::D2Array),
        }
    }

    /// Group 1 with one 2-D texture.
    pub fn texture_group(
        &self,
        device: &wgpu::Device,
        view: &wgpu::TextureView,
    ) -> wgpu::BindGroup {
        group(device, &self.texture, &[(0, view)])
    }

    /// Group 1 with an array of textures: it has [`array_layers`].
    pub fn layers_group(&self, device: &wgpu::Device, texture: &wgpu::Texture) -> wgpu::BindGroup {
        group(device, &self.layers, &[(1, &array(texture))])
    }

    /// Group 1 with one level of an array of textures.
    pub fn array_group(&self, device: &wgpu::Device, view: &wgpu::TextureView) -> wgpu::BindGroup {
        group(device, &self.layers, &[(1, view)])
    }

    /// Group 1 of the lit method's dome.
    pub fn lit_group(
        &self,
        device: &wgpu::Device,
        layers: &wgpu::Texture,
        map: &wgpu::Texture,
    ) -> wgpu::BindGroup {
        group(device, &self.lit, &[(1, &array(layers)), (2, &array(map))])
    }

    /// The layout of a pipeline whose group 1, if it has one, is `own`.
    pub fn pipeline_layout(
        &self,
        device: &wgpu::Device,
        own: Option<&wgpu::BindGroupLayout>,
    ) -> wgpu::PipelineLayout {
        let mut groups = vec![Some(&self.shared)];
        groups.extend(own.map(Some));
        device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("sky"),
            bind_group_layouts: &groups,
            ..Default::default()
        })
    }
}

fn group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    views: &[(u32, &wgpu::TextureView)],
) -> wgpu::BindGroup {
    let entries = views.iter().map(|&(binding, view)| wgpu::BindGroupEntry {
        binding,
        resource: wgpu::BindingResource::TextureView(view),
    });
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("sky, a method's own"),
        layout,
        entries: &entries.collect::<Vec<_>>(),
    })
}

/// Layers of a square texture that is read as an array of `count`.
///
/// On GL, wgpu goes by a texture's size alone: it takes one layer for a plane, and a square six, or a multiple, for a cube.
pub(crate) fn array_layers(count: u32) -> u32 {
    if count == 1 || count.is_multiple_of(6) {
        count + 1
    } else {
        count
    }
}

/// A view of all layers.
fn array(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

/// Everything is seen by both stages: the flare asks for the clouds before the sun in its vertex stage.
pub(crate) fn entry(binding: u32, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty,
        count: None,
    }
}

pub(crate) fn texture(
    filterable: bool,
    view_dimension: wgpu::TextureViewDimension,
) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable },
        view_dimension,
        multisampled: false,
    }
}

fn shared_layout(device: &wgpu::Device, uniform_bytes: u64) -> wgpu::BindGroupLayout {
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: wgpu::BufferSize::new(uniform_bytes),
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    let (plane, cube) = (
        wgpu::TextureViewDimension::D2,
        wgpu::TextureViewDimension::Cube,
    );
    let mut entries = vec![entry(0, uniform), entry(1, sampler), entry(2, sampler)];
    // Stars are records: they are loaded, never filtered.
    entries.extend(
        TEXTURES.map(|(binding, role)| entry(binding, texture(role != Role::Stars, plane))),
    );
    entries.push(entry(SKY_BINDING, texture(true, plane)));
    entries.push(entry(SKYBOX_BINDING, texture(true, cube)));
    entries.push(entry(CATALOGUE_BINDING, texture(false, plane)));
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("sky, shared"),
        entries: &entries,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_array_has_the_layers_of_a_plane_or_of_a_cube() {
        for count in 1..=24 {
            let layers = array_layers(count);
            assert!(layers >= count && layers <= count + 1, "{count}");
            assert!(layers != 1 && !layers.is_multiple_of(6), "{count}");
        }
        assert_eq!([2, 3, 8].map(array_layers), [2, 3, 8]);
    }
}
