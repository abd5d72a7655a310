//! The default pack and many others are sound, and the same bytes come out of every build.
//!
//! A program beside `it`: it bakes whole packs by the dozen, which takes as long as all of `make check`.

mod default_pack;
mod determinism;
