//! Whole-path tests that want no GPU and little time: golden packs, the closed forms of the sky, the order of the runtime's files.

mod catalogue;
mod datasets;
mod eclipse;
mod floors;
mod golden;
mod links;
mod perez;
mod sky_picture;
mod tonemap;
mod twilight;
