//! Packs and fields, read by other people's readers, which Node.js runs.
//!
//! A program beside `it`, which wants nothing but cargo.

mod field_reader;
mod ktx_parse;
