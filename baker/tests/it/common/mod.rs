//! What several tests need.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::ops::ControlFlow;

use welkin_baker::{Recipe, Resolved, sources};
use welkin_pack::{Image, Role, Source};

/// Resolves a recipe and makes its images.
pub fn bake(text: &str, seed: Option<u64>) -> (Resolved, Vec<Source>) {
    let resolved = Recipe::parse("sky.toml", text)
        .unwrap()
        .resolve(seed)
        .unwrap();
    let sources = sources(&resolved, None, &|_| ControlFlow::Continue(())).unwrap();
    (resolved, sources)
}

/// The images of a role, one a layer.
pub fn images(sources: &[Source], role: Role) -> &[Image] {
    &sources.iter().find(|s| s.role == role).unwrap().images
}

/// The only or first image of a role.
pub fn image(sources: &[Source], role: Role) -> &Image {
    &images(sources, role)[0]
}
