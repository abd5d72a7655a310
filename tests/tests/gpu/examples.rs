//! The examples of the runtime, run as programs: their pictures are the golden ones.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::PathBuf;
use std::process::Command;

use image::RgbImage;
use image::imageops::{FilterType, resize};
use welkin_tests::gpu;

/// Golden pictures are smaller: width and height.
const SIZE: [u32; 2] = [320, 180];

/// What pixels may differ on average, in steps of 8 bits: another driver rounds otherwise, and a cloud's edge is a step wide.
const CLOSE: f64 = 2.0;

/// The program of an example, which `cargo build --workspace --examples` makes beside the tests.
fn program(name: &str) -> PathBuf {
    let mut folder = std::env::current_exe().unwrap();
    folder.pop();
    folder.pop();
    let file = folder.join("examples").join(name);
    assert!(
        file.exists(),
        "{} is not there: `make test-gpu` builds the examples first",
        file.display()
    );
    file
}

fn drawn(name: &str) -> RgbImage {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("picture.png");
    let output = Command::new(program(name)).arg(&file).output().unwrap();
    assert!(output.status.success(), "{name}: {output:?}");
    let picture = image::open(&file).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (1280, 720), "{name}");
    resize(&picture, SIZE[0], SIZE[1], FilterType::Triangle)
}

fn is_golden(name: &str) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("golden/example-{name}.png"));
    let found = drawn(name);
    if std::env::var_os("WELKIN_BLESS").is_some() && gpu::gpu().is_llvmpipe {
        found.save(&path).unwrap();
    }
    let golden = image::open(&path).unwrap().into_rgb8();
    let apart = found.as_raw().iter().zip(golden.as_raw());
    let sum: u32 = apart.map(|(a, b)| u32::from(a.abs_diff(*b))).sum();
    let mean = f64::from(sum) / golden.as_raw().len() as f64;
    assert!(mean < CLOSE, "{name}: {mean}");
}

#[test]
fn headless_draws_a_sunset() {
    is_golden("headless");
}

#[test]
fn offscreen_hdr_draws_hills_in_the_shadows_of_clouds() {
    is_golden("offscreen_hdr");
}

#[test]
fn two_cameras_see_one_sky() {
    is_golden("two_cameras");
}
