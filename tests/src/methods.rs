//! The choice between the methods' layers.

use glam::Vec3;
use welkin_runtime::Method;
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::params::Shading;

use crate::clouds::Inputs;
use crate::{fbm, lit, lit_paper, octaves, packed, packed_paper};

/// How many channels of clouds or of a map a method reads in a place.
pub fn reads(method: Method, shading: Shading, uniforms: &Uniforms) -> usize {
    match method {
        Method::Packed => match shading {
            Shading::Scattered => 8,
            Shading::Paper => 4,
        },
        Method::Sprites => 1,
        Method::Octaves => 5,
        Method::Fbm => 3,
        Method::Lit => lit::reads(&uniforms.lit, shading),
    }
}

/// Radiance and opacity of a method's clouds along a unit direction above the horizon. `narrowing` is the cosine
/// of its angle to the axis of the lens.
pub fn layer(method: Method, inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    match method {
        Method::Packed => match inputs.shading {
            Shading::Scattered => packed::layer(inputs, direction, narrowing),
            Shading::Paper => packed_paper::layer(inputs, direction, narrowing),
        },
        Method::Sprites => packed::upper_layer(inputs, direction, narrowing),
        Method::Octaves => octaves::layer(inputs, direction, narrowing),
        Method::Fbm => fbm::layer(inputs, direction, narrowing),
        Method::Lit => match inputs.shading {
            Shading::Scattered => lit::layer(inputs, direction, narrowing),
            Shading::Paper => lit_paper::layer(inputs, direction, narrowing),
        },
    }
}
