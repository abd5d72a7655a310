//! What can be seen of the pack from outside: what a check takes of memory, and that docs/papers.md is true.

#[cfg(feature = "write")]
mod memory;
mod papers;
