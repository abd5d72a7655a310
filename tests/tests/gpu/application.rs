//! The functions that applications put into their own shaders, asked on a device.

use glam::Vec3;
use welkin_tests::gpu;

/// A vector as WGSL has it.
pub fn vector(v: Vec3) -> String {
    format!("vec3f({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

/// What the function `asked(a: vec3f, b: vec3f) -> vec3f` of a text gives for each pair; `uniform` is at binding 0.
pub fn asked(text: &str, uniform: &[f32], [first, second]: [&[Vec3]; 2]) -> Vec<Vec3> {
    let gpu::Gpu { device, queue, .. } = gpu::gpu();
    let list = |vectors: &[Vec3]| {
        let texts: Vec<String> = vectors.iter().map(|v| vector(*v)).collect();
        format!("array<vec3f, {}>({})", texts.len(), texts.join(", "))
    };
    let text = format!(
        "{text}
        @vertex fn vs(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {{
            return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
        }}
        @fragment fn fs(@builtin(position) position: vec4f) -> @location(0) vec4f {{
            var first = {};
            var second = {};
            let i = u32(position.x);
            return vec4f(asked(first[i], second[i]), 1.0);
        }}",
        list(first),
        list(second),
    );
    let format = wgpu::TextureFormat::Rgba32Float;
    let pipeline = gpu::pipeline(&text, ["vs", "fs"], format);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("of the application"),
        size: size_of_val(uniform) as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let bytes: Vec<u8> = uniform.iter().flat_map(|f| f.to_le_bytes()).collect();
    queue.write_buffer(&buffer, 0, &bytes);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("of the application"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: buffer.as_entire_binding(),
        }],
    });
    let target = gpu::target(format, [first.len() as u32, 1], 1);
    gpu::pass(&target, None, None, |pass| {
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    });
    gpu::rgb(&gpu::read(&target))
}
