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

/// Tables of a recipe with which their textures are as small as they may be, and no clouds stand in space.
const SMALL: [(&str, &str); 9] = [
    ("clouds", "size = 64"),
    ("stars", "size = 64\ncount = 20"),
    ("galaxy", "size = 32"),
    ("sky", "suns = 16"),
    ("fbm", "size = 64\ncells = 16"),
    ("flares", "size = 64"),
    ("layers", "size = 64"),
    ("sprites", "size = 128"),
    ("field", "sections = 0"),
];

/// The same where these roles alone are looked at: the others are small. No channel depends on another's size.
pub fn bake_for(roles: &[Role], text: &str, seed: Option<u64>) -> (Resolved, Vec<Source>) {
    let asked = |table: &str| {
        roles.iter().any(|role| role.name() == table) || text.contains(&format!("[{table}]"))
    };
    let others = SMALL.iter().filter(|(table, _)| !asked(table));
    let small: String = others
        .map(|(table, lines)| format!("[{table}]\n{lines}\n"))
        .collect();
    bake(&format!("{small}{text}"), seed)
}

/// The images of a role, one a layer.
pub fn images(sources: &[Source], role: Role) -> &[Image] {
    &sources.iter().find(|s| s.role == role).unwrap().images
}

/// The only or first image of a role.
pub fn image(sources: &[Source], role: Role) -> &Image {
    &images(sources, role)[0]
}

/// Clouds of a few sizes on blue, without any symmetry.
pub fn sky(width: u32, height: u32) -> image::RgbImage {
    image::RgbImage::from_fn(width, height, |x, y| {
        let wave = |a: f32, b: f32, phase: f32| libm::sinf(a * x as f32 + b * y as f32 + phase);
        let cloud = 0.5
            + 0.3 * wave(0.13, 0.04, 0.3) * wave(-0.03, 0.17, 1.0)
            + 0.2 * wave(0.31, 0.23, 2.0);
        let byte = |v: f32| (v.clamp(0.0, 1.0) * 255.0) as u8;
        image::Rgb([
            byte(0.2 + 0.7 * cloud),
            byte(0.35 + 0.55 * cloud),
            byte(0.7 + 0.2 * cloud),
        ])
    })
}
