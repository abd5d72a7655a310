//! The light on a scene: the shader of an application says what the CPU does.

use glam::Vec3;
use welkin_runtime::{SkyParams, light};
use welkin_tests::{gpu, pack};

use super::application;

#[test]
fn the_shader_says_what_the_cpu_does() {
    let sky = gpu::sky(pack::default_pack(), wgpu::TextureFormat::Rgba16Float);
    let mut normals = vec![Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
    normals.extend((0..20).map(|i| {
        let (along, up) = (i as f32 * 2.4, (i as f32 - 9.5) / 10.0);
        let flat = (1.0 - up * up).sqrt();
        Vec3::new(flat * along.cos(), up, flat * along.sin())
    }));
    for time in [0.0, 0.3, 0.5, 0.74] {
        let params = SkyParams {
            time,
            ..SkyParams::default()
        };
        let given = sky.light(&params, 0.0);
        let function = format!(
            "{}
            @group(0) @binding(0) var<uniform> light: SkyLight;
            fn asked(normal: vec3f, which: vec3f) -> vec3f {{
                if which.x > 0.5 {{ return sky_light_ambient(light, normal); }}
                if which.y > 0.5 {{ return sky_light_direct(light, normal); }}
                return sky_light_clear(light, normal);
            }}",
            light::WGSL
        );
        let asked = |which: Vec3| {
            let which = vec![which; normals.len()];
            application::asked(&function, &given.uniform(), [&normals, &which])
        };
        let direct = |normal: Vec3, clear: bool| {
            let of = |from: light::Luminary| {
                let irradiance = if clear {
                    from.clear_irradiance
                } else {
                    from.irradiance
                };
                irradiance * from.direction.dot(normal).max(0.0)
            };
            of(given.sun) + of(given.moon)
        };
        let [ambient, shaded, clear] = [Vec3::X, Vec3::Y, Vec3::Z].map(asked);
        for (i, normal) in normals.iter().enumerate() {
            for (found, expected) in [
                (ambient[i], given.ambient_irradiance(*normal)),
                (shaded[i], direct(*normal, false)),
                (clear[i], direct(*normal, true)),
            ] {
                // Sums of nine terms in single precision.
                let close = (found - expected).abs().cmple(expected * 1e-4 + 1e-5);
                assert!(close.all(), "{time} {normal}: {found} {expected}");
            }
        }
        assert!(given.sun.clear_irradiance.cmpge(given.sun.irradiance).all());
    }
}
