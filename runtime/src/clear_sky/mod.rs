//! The sky without clouds, by day and by night.

pub mod cie;
pub mod flares;
pub mod galaxy;
pub mod gradient;
pub mod light;
pub mod perez;
pub mod skybox;
pub mod stars;
pub mod sun;
