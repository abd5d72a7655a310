//! What every pass needs of a device: layouts, pipelines, textures, the shader's text. It knows no method by name.

pub mod config;
pub mod context;
pub mod layouts;
pub mod map;
pub mod pipeline;
pub mod shader;
pub mod upload;
