//! The shader's text, put together from one WGSL file a pass and the constants that Rust knows.

use std::fmt::Write;

use glam::Vec3;
use welkin_pack::mapping::{STAR_TILE_SIDE, STAR_TILE_START};

use crate::{clouds, dome, galaxy, sky, stars, sun, tonemap};

/// The WGSL files in the order in which they are joined.
const PARTS: [&str; 10] = [
    include_str!("../shaders/uniforms.wgsl"),
    include_str!("../shaders/camera.wgsl"),
    include_str!("../shaders/dome.wgsl"),
    include_str!("../shaders/sky.wgsl"),
    include_str!("../shaders/sun.wgsl"),
    include_str!("../shaders/stars.wgsl"),
    include_str!("../shaders/galaxy.wgsl"),
    include_str!("../shaders/clouds.wgsl"),
    include_str!("../shaders/tonemap.wgsl"),
    include_str!("../shaders/renderer.wgsl"),
];

/// What the last step writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// Linear radiance, for float targets.
    Radiance,
    /// Linear display light, for targets that the hardware encodes (`*Srgb`).
    Display,
    /// sRGB-encoded display light, for plain unorm targets.
    Encoded,
}

impl Output {
    /// Every kind of output.
    pub const ALL: [Output; 3] = [Output::Radiance, Output::Display, Output::Encoded];
}

/// The whole shader for one kind of output, with depth 1 or (reversed) 0 far away.
pub fn compose(output: Output, reversed_depth: bool) -> String {
    let mut text = constants(output, reversed_depth);
    for part in PARTS {
        text.push('\n');
        text.push_str(part);
    }
    text
}

fn constants(output: Output, reversed_depth: bool) -> String {
    let mut text = String::from("// Generated from the constants in Rust.\n");
    for (index, name) in ["OUTPUT_RADIANCE", "OUTPUT_DISPLAY", "OUTPUT_ENCODED"]
        .iter()
        .enumerate()
    {
        let _ = writeln!(text, "const {name} = {index}u;");
    }
    let _ = writeln!(text, "const OUTPUT = {}u;", output as u32);
    let numbers = [
        ("FAR_DEPTH", if reversed_depth { 0.0 } else { 1.0 }),
        ("TAU", std::f32::consts::TAU),
        ("SQRT_2", std::f32::consts::SQRT_2),
        ("CLOUD_SPHERE_RADIUS", dome::CLOUD_SPHERE_RADIUS),
        ("GROUND_FLOOR", sky::GROUND_FLOOR),
        ("GROUND_FALL", sky::GROUND_FALL),
        ("SUN_HORIZON", sun::HORIZON),
        ("STAR_TILE_SIDE", STAR_TILE_SIDE),
        ("STAR_RATE_STEPS", 255.0),
        ("STAR_GALAXY_BOOST", stars::GALAXY_BOOST),
        ("EXTINCTION", galaxy::EXTINCTION),
        ("CLOUD_EDGE", clouds::EDGE),
        ("CLOUD_CORE", clouds::CORE),
        ("CLOUD_FOLD", clouds::FOLD),
        ("UPPER_OPACITY", clouds::UPPER_OPACITY),
        ("UPPER_THRESHOLD", clouds::UPPER_THRESHOLD),
        ("TONE_SHOULDER", tonemap::SHOULDER),
        ("GALAXY_GRAIN_SCALE", galaxy::GRAIN_SCALE),
        ("TONE_KNEE", tonemap::KNEE),
    ];
    for (name, value) in numbers {
        let _ = writeln!(text, "const {name}: f32 = {value:?};");
    }
    let _ = writeln!(
        text,
        "const STAR_START = vec2f({:?}, {:?});",
        STAR_TILE_START[0], STAR_TILE_START[1]
    );
    for (name, colour) in [("STAR_WARM", stars::WARM), ("STAR_COLD", stars::COLD)] {
        let Vec3 { x, y, z } = colour;
        let _ = writeln!(text, "const {name} = vec3f({x:?}, {y:?}, {z:?});");
    }
    text
}

#[cfg(test)]
mod tests {
    use std::mem::{offset_of, size_of};

    use naga::valid::{Capabilities, ValidationFlags, Validator};
    use naga::{Module, TypeInner};

    use super::*;
    use crate::uniforms::*;

    fn parse(output: Output, reversed: bool) -> Module {
        let text = compose(output, reversed);
        naga::front::wgsl::parse_str(&text)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)))
    }

    #[test]
    fn every_variant_is_valid_without_any_extension() {
        for output in Output::ALL {
            for reversed in [false, true] {
                let module = parse(output, reversed);
                let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
                validator
                    .validate(&module)
                    .unwrap_or_else(|e| panic!("{output:?} {reversed}: {e:?}"));
                let entries: Vec<_> = module
                    .entry_points
                    .iter()
                    .map(|e| e.name.as_str())
                    .collect();
                assert_eq!(entries, ["vs_screen", "vs_dome", "fs_sky"]);
            }
        }
    }

    /// Offsets and size of a WGSL struct.
    fn layout(module: &Module, name: &str) -> (Vec<(String, u32)>, u32) {
        let (_, ty) = module
            .types
            .iter()
            .find(|(_, t)| t.name.as_deref() == Some(name))
            .expect(name);
        let TypeInner::Struct { members, span } = &ty.inner else {
            panic!("{name} is no struct")
        };
        (
            members
                .iter()
                .map(|m| (m.name.clone().unwrap_or_default(), m.offset))
                .collect(),
            *span,
        )
    }

    macro_rules! assert_same_layout {
        ($module:expr, $name:ident, $($field:ident),+) => {
            let rust = vec![$((stringify!($field).to_string(), offset_of!($name, $field) as u32)),+];
            assert_eq!(layout($module, stringify!($name)), (rust, size_of::<$name>() as u32), stringify!($name));
        };
    }

    #[test]
    fn rust_and_wgsl_agree_on_the_layout_of_every_struct() {
        let module = &parse(Output::Encoded, false);
        assert_same_layout!(
            module,
            CameraUniforms,
            right,
            up,
            forward,
            clip_x,
            clip_y,
            clip_w
        );
        assert_same_layout!(
            module,
            SkyUniforms,
            gradient,
            sun,
            wide,
            narrow,
            band,
            overcast
        );
        assert_same_layout!(module, SunUniforms, right, up, disc, glow);
        assert_same_layout!(module, StarUniforms, field);
        assert_same_layout!(module, GalaxyUniforms, light);
        assert_same_layout!(
            module,
            CloudUniforms,
            photo,
            noise,
            detail,
            upper,
            levels,
            gradient,
            shape,
            sunlight,
            ambient,
            tint
        );
        assert_same_layout!(module, TonemapUniforms, display);
        assert_same_layout!(
            module, Uniforms, camera, sky, sun, stars, galaxy, clouds, tonemap
        );
        assert_eq!(
            size_of::<Uniforms>() % 16,
            0,
            "WebGL2 wants uniform blocks in units of 16 bytes"
        );
    }
}
