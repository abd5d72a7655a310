//! The shader's text, put together from parts.

use std::f32::consts::{PI, SQRT_2, TAU};
use std::fmt::Write;

use super::config::Output;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::Struct;

/// What is compiled into a shader, beside what its pipelines choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Build {
    /// What the last step writes.
    pub output: Output,
    /// Whether depth is 1 or (reversed) 0 far away.
    pub reversed_depth: bool,
    /// Whether the pack has a skybox.
    pub skybox: bool,
    /// Whether it has a catalogue of stars.
    pub catalogue: bool,
    /// Whether the application has drawn a clear sky of its own, over which clouds, stars and moon are laid.
    pub over: bool,
}

/// A shader of these structs and parts. Each call is a function that parts ask for, and what gives it.
pub fn compose<'a>(
    build: Build,
    own: &[(&str, Value)],
    structs: Vec<&Struct>,
    parts: impl Iterator<Item = &'a Part>,
    calls: &[(&str, String)],
) -> String {
    let mut text = String::from("// Generated from the constants in Rust.\n");
    for (name, value) in constants(build).iter().chain(own) {
        value.write(name, &mut text);
    }
    for shared in structs {
        shared.write(&mut text);
    }
    for part in parts {
        part.write(&mut text);
    }
    for (function, call) in calls {
        let _ = write!(text, "\nfn {function} {{\n    return {call};\n}}\n");
    }
    text
}

fn constants(build: Build) -> [(&'static str, Value); 12] {
    let far_depth = if build.reversed_depth { 0.0 } else { 1.0 };
    [
        ("OUTPUT_RADIANCE", Value::U32(Output::Radiance as u32)),
        ("OUTPUT_DISPLAY", Value::U32(Output::Display as u32)),
        ("OUTPUT_ENCODED", Value::U32(Output::Encoded as u32)),
        ("OUTPUT_OPACITY", Value::U32(Output::Opacity as u32)),
        ("OUTPUT", Value::U32(build.output as u32)),
        ("SKYBOX", Value::Bool(build.skybox)),
        ("CATALOGUE", Value::Bool(build.catalogue)),
        ("OVER", Value::Bool(build.over)),
        ("FAR_DEPTH", Value::F32(far_depth)),
        ("PI", Value::F32(PI)),
        ("TAU", Value::F32(TAU)),
        ("SQRT_2", Value::F32(SQRT_2)),
    ]
}
