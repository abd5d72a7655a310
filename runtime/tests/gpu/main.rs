//! What every choice of features draws: `--no-default-features` is the packed method alone.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

mod draws;
