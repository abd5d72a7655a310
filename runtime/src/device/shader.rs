//! The shader's text, put together from parts.

use std::f32::consts::{PI, SQRT_2, TAU};
use std::fmt::Write;

use super::config::Output;
use crate::geometry::part::{Part, Value};
use crate::params::{Method, SkyModel};

/// What is compiled into a shader, beside what its pipelines choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Build {
    /// What the last step writes.
    pub output: Output,
    /// Whether depth is 1 or (reversed) 0 far away.
    pub reversed_depth: bool,
    /// Which method's clouds `cloud_layer` gives.
    pub method: Method,
    /// How `sky_radiance` computes the clear sky.
    pub sky: SkyModel,
    /// Whether the pack has a skybox.
    pub skybox: bool,
}

/// The whole shader.
pub fn compose(build: Build, parts: &[Part]) -> String {
    let mut text = String::from("// Generated from the constants in Rust.\n");
    for (name, value) in constants(build) {
        value.write(name, &mut text);
    }
    for part in parts {
        part.write(&mut text);
    }
    let method = build.method.name();
    let _ = write!(
        text,
        "\n// Radiance and opacity of the clouds along a unit direction above the horizon, for a pixel that is so much narrower\n\
         // than one in the middle of the screen.\n\
         fn cloud_layer(direction: vec3f, narrowing: f32) -> vec4f {{\n    return {method}_layer(direction, narrowing);\n}}\n"
    );
    text
}

fn constants(build: Build) -> [(&'static str, Value); 11] {
    // Packed clouds are hardly ever opaque, and behind sprites there are none: to ask costs more than it saves.
    let ask_opaque = !matches!(build.method, Method::Packed | Method::Sprites);
    let far_depth = if build.reversed_depth { 0.0 } else { 1.0 };
    [
        ("OUTPUT_RADIANCE", Value::U32(Output::Radiance as u32)),
        ("OUTPUT_DISPLAY", Value::U32(Output::Display as u32)),
        ("OUTPUT_ENCODED", Value::U32(Output::Encoded as u32)),
        ("OUTPUT", Value::U32(build.output as u32)),
        ("SKYBOX", Value::Bool(build.skybox)),
        ("PEREZ", Value::Bool(build.sky == SkyModel::Perez)),
        ("ASK_OPAQUE", Value::Bool(ask_opaque)),
        ("FAR_DEPTH", Value::F32(far_depth)),
        ("PI", Value::F32(PI)),
        ("TAU", Value::F32(TAU)),
        ("SQRT_2", Value::F32(SQRT_2)),
    ]
}
