//! The program `welkin-view`, run as its users run it, on a real adapter (software Vulkan will do).

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use exr::prelude::read_first_rgba_layer_from_file;

use crate::common::{failed, pack, render, run, view};

#[test]
fn a_frame_is_the_same_every_time_and_follows_its_options() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.png");
    let noon = render(&file, &[]);
    let picture = image::load_from_memory(&noon).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (70, 40));
    // By day the sky is bright and bluer than it is red.
    let sum = picture.pixels().fold([0_u64; 3], |sum, p| {
        [0, 1, 2].map(|i| sum[i] + u64::from(p.0[i]))
    });
    assert!(sum[2] > sum[0] && sum[2] > 70 * 40 * 100, "{sum:?}");
    assert_eq!(render(&file, &[]), noon);
    let options = [
        ["--cover", "0.9"],
        ["--height", "0.1"],
        ["--density", "0.9"],
        ["--time", "0"],
        ["--upper", "1"],
        ["--azimuth", "90"],
        ["--elevation", "60"],
        ["--fov", "30"],
        ["--at", "60"],
    ];
    for option in options {
        assert_ne!(render(&file, &option), noon, "{option:?}");
    }
    // These two say nothing alone: red needs a low sun, and speed needs time.
    let evening = [
        "--time",
        "0.74",
        "--azimuth",
        "270",
        "--elevation",
        "10",
        "--at",
        "60",
    ];
    let low_sun = render(&file, &evening);
    for option in [["--sunset", "1"], ["--speed", "1"]] {
        assert_ne!(
            render(&file, &[&evening[..], &option].concat()),
            low_sun,
            "{option:?}"
        );
    }
    assert_eq!(folder.path().read_dir().unwrap().count(), 1);
}

#[test]
fn an_exr_holds_finite_radiance_of_the_same_view() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.exr");
    render(&file, &[]);
    let image = read_first_rgba_layer_from_file(
        &file,
        |_, _| Vec::new(),
        |pixels: &mut Vec<[f32; 3]>, _, (r, g, b, _): (f32, f32, f32, f32)| pixels.push([r, g, b]),
    )
    .unwrap();
    let pixels = image.layer_data.channel_data.pixels;
    assert_eq!(pixels.len(), 70 * 40);
    assert!(pixels.iter().flatten().all(|v| v.is_finite() && *v >= 0.0));
    // Radiance is not squeezed into 0..1: a day's sky and its sun go beyond, or come well below white.
    assert!(pixels.iter().any(|p| p[2] > 0.05));
}

#[test]
fn what_cannot_be_drawn_is_told_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let attempt = |pack: &Path, file: &str, more: &[&str]| {
        let mut command = view(&["render"]);
        command
            .arg(pack)
            .arg("-o")
            .arg(folder.path().join(file))
            .args(more);
        run(command)
    };
    failed(
        &attempt(pack(), "frame.gif", &[]),
        1,
        &["frame.gif", ".png", ".exr"],
    );
    failed(
        &attempt(&folder.path().join("none"), "frame.png", &[]),
        1,
        &["none"],
    );
    failed(
        &attempt(pack(), "none/frame.png", &["--size", "4x4"]),
        1,
        &["none/frame.png", "cannot be written"],
    );
    failed(
        &attempt(pack(), "frame.png", &["--size", "32768x32768"]),
        1,
        &["32768x32768", "--size"],
    );
    failed(
        &attempt(pack(), "frame.png", &["--method", "volumes"]),
        2,
        &["--method", "packed"],
    );
    failed(
        &attempt(pack(), "frame.png", &["--cover", "2"]),
        2,
        &["--cover", "from 0 to 1"],
    );
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}

#[test]
fn without_an_adapter_it_says_what_to_install() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = view(&["render", "-o"]);
    command.arg(folder.path().join("frame.png")).arg(pack());
    // The Vulkan loader then finds no driver.
    let nothing = folder.path().join("none");
    command
        .env("WGPU_BACKEND", "vulkan")
        .env("VK_ICD_FILENAMES", &nothing)
        .env("VK_DRIVER_FILES", &nothing);
    command.env_remove("WGPU_ADAPTER_NAME");
    failed(
        &run(command),
        1,
        &["no graphics adapter", "mesa-vulkan-drivers"],
    );

    let mut command = view(&["bench"]);
    command.arg(pack()).env("WGPU_ADAPTER_NAME", "abacus");
    failed(&run(command), 1, &["abacus", "WGPU_ADAPTER_NAME"]);
}

#[test]
fn a_gpu_is_chosen_by_its_number_and_a_drawn_frame_says_nothing_on_standard_error() {
    let list = run(view(&["gpus"]));
    let text = String::from_utf8(list.stdout).unwrap();
    let rows: Vec<&str> = text.lines().skip(1).collect();
    assert!(list.status.success() && !rows.is_empty(), "{text}");
    assert!(rows[0].starts_with("0 "), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let frame = folder.path().join("frame.png");
    let draw = |gpu: &[&str]| {
        let mut command = view(&["render", "--size", "16x16", "-o"]);
        command.arg(&frame).arg(pack()).args(gpu);
        // As on a server that nobody has logged in to.
        command
            .env_remove("NODEVICE_SELECT")
            .env_remove("XDG_RUNTIME_DIR");
        run(command)
    };
    let plain = draw(&[]);
    assert!(plain.status.success(), "{plain:?}");
    assert_eq!(String::from_utf8_lossy(&plain.stderr), "");
    assert!(draw(&["--gpu", "0"]).status.success());
    failed(
        &draw(&["--gpu", "99"]),
        1,
        &["number 99", "welkin-view gpus"],
    );
    failed(
        &draw(&["--gpu", "ffff:ff:1f.7"]),
        1,
        &["ffff:ff:1f.7", "welkin-view gpus"],
    );
    failed(
        &draw(&["--gpu", "fast"]),
        2,
        &["PCI bus id", "welkin-view gpus"],
    );
}

#[test]
fn nothing_is_written_into_the_pack_that_is_drawn_or_twice_into_one_place() {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("pack");
    std::fs::create_dir(&copy).unwrap();
    let names = |folder: &Path| {
        let entries = folder.read_dir().unwrap().map(|e| e.unwrap());
        let mut all: Vec<_> = entries
            .map(|e| (e.file_name(), e.metadata().unwrap().len()))
            .collect();
        all.sort();
        all
    };
    for (name, _) in names(pack()) {
        std::fs::copy(pack().join(&name), copy.join(&name)).unwrap();
    }
    let before = names(&copy);
    let attempt = |args: &[&str]| {
        let mut command = view(&["render", "pack"]);
        command.args(args).current_dir(folder.path());
        run(command)
    };
    for args in [
        &["-o", "pack/clouds.ktx2", "--cubemap", "16"][..],
        &["-o", "pack/faces", "--cubemap", "16"],
        &["-o", "pack", "--cubemap", "16"],
        &["-o", "./pack/../pack/frame.png"],
        &["-o", "pack", "--frames", "2"],
        &["-o", ".", "--frames", "2"],
        &["-o", "a.png", "--method", "lit", "--shadow", "pack/s.png"],
    ] {
        failed(&attempt(args), 1, &["which is read"]);
    }
    let shadow = ["-o", "a.png", "--method", "lit", "--shadow", "./a.png"];
    failed(&attempt(&shadow), 1, &["./a.png", "named twice"]);
    assert_eq!(names(&copy), before);
    assert_eq!(names(folder.path()).len(), 1);
}
