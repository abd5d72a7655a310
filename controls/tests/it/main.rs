//! The controls through their public face.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

mod written;
