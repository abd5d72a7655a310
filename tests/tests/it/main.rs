//! Whole-path tests without a GPU: packs, the closed forms of the sky, the order of the runtime's files.

mod default_pack;
mod determinism;
mod floors;
mod golden;
mod perez;
mod twilight;
