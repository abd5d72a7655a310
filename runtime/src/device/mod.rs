//! What every pass needs of a device: layouts, pipelines, textures, the shader's text. It knows no method, but for the layout that the dome of `lit` needs.

pub mod config;
pub mod context;
pub mod layouts;
pub mod map;
pub mod pipeline;
pub mod shader;
pub mod upload;
