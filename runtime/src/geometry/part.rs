//! A part of the shader: a WGSL file, and the constants and structs that Rust and WGSL share.
//!
//! Every pass owns its uniforms, its constants and its WGSL, and hands over one `PART`: `parts.rs` lists what every dome needs, `methods/` what each method does.

use std::fmt::Write;

use glam::Vec3;

use super::uniforms::Struct;

/// A part of the shader.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Constants that the text uses.
    pub constants: &'static [(&'static str, Value)],
    /// Structs that the text uses.
    pub structs: &'static [Struct],
    /// The text.
    pub wgsl: &'static str,
}

/// The value of a constant.
#[derive(Clone, Copy, Debug)]
pub enum Value {
    /// `bool`.
    Bool(bool),
    /// A whole number of any type.
    Int(i32),
    /// `u32`.
    U32(u32),
    /// `f32`.
    F32(f32),
    /// `f32`: the logarithm to the base 2, which Rust cannot take of a constant.
    Log2(f32),
    /// `vec2f`.
    Vec2([f32; 2]),
    /// `vec3f`.
    Vec3(Vec3),
    /// `vec4f`.
    Vec4([f32; 4]),
}

impl Part {
    /// Appends constants and text; structs come before all parts.
    pub fn write(&self, text: &mut String) {
        text.push('\n');
        for &(name, value) in self.constants {
            value.write(name, text);
        }
        text.push_str(self.wgsl);
    }
}

impl Value {
    /// Appends a constant.
    pub fn write(self, name: &str, text: &mut String) {
        let _ = match self {
            Value::Bool(value) => writeln!(text, "const {name} = {value};"),
            Value::Int(value) => writeln!(text, "const {name} = {value};"),
            Value::U32(value) => writeln!(text, "const {name} = {value}u;"),
            Value::F32(value) => writeln!(text, "const {name}: f32 = {value:?};"),
            Value::Log2(value) => writeln!(text, "const {name}: f32 = {:?};", value.log2()),
            Value::Vec2([x, y]) => writeln!(text, "const {name} = vec2f({x:?}, {y:?});"),
            Value::Vec3(Vec3 { x, y, z }) => {
                writeln!(text, "const {name} = vec3f({x:?}, {y:?}, {z:?});")
            }
            Value::Vec4([x, y, z, w]) => {
                writeln!(text, "const {name} = vec4f({x:?}, {y:?}, {z:?}, {w:?});")
            }
        };
    }
}
