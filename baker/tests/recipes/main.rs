//! Recipes of all kinds are refused or make sound packs.
//!
//! A program beside `it`: `make test` and `make recipes` compile it for release too, where it bakes hundreds of times as many, and
//! without the rest of the tests.

mod legal;
mod sound;
