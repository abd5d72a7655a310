//! Where pixels look, where they meet the dome, and what shader parts are made of.

pub mod axes;
pub mod camera;
pub mod dome;
pub mod harmonics;
pub mod math;
pub mod part;
pub mod uniforms;
