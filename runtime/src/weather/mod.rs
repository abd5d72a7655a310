//! Rain, rays and lightning.

pub mod lightning;
pub mod rain;
pub mod rays;
