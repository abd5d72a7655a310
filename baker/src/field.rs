//! A field of clouds in space: boxes filled with sprites, made by an artist or by the field maker.
//!
//! # Theory
//! N. Wang, "Let There Be Clouds! Fast, Realistic Cloud-Rendering in Microsoft Flight Simulator 2004: A Century of
//! Flight", Game Developer, 2004. A cloud is modelled from boxes. Each box says how many sprites it gets, how large they
//! are, which pictures are on them, how far they may be turned and which shading group they belong to. Their centres are
//! random; then every sprite is taken away that is nearer to another than the cull distance.
//!
//! # Changes versus the paper
//! - Boxes come from a recipe, from a glTF file or from a maker of fields, one file a kind in `kinds/`.
//! - Sprites are turned here and not when the file is loaded, so that a frame is a pure function of the pack.
//! - Clouds have a rank, so that one field holds every cover from a clear sky to an overcast one: see `maker.rs`.
//!
//! # Practice
//! Everything stands on a grid of an eighth of a metre. So sums and differences of places are exact, and what was true of a
//! cloud at its origin is true of it wherever it goes.

pub(crate) mod boxes;
mod cloud;
mod clumps;
mod cull;
mod grid;
mod ground;
pub(crate) mod kinds;
pub(crate) mod light;
mod maker;
pub(crate) mod model;
mod place;
mod spread;

pub(crate) use maker::{field, files};
