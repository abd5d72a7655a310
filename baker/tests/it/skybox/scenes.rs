//! Where the picture comes to lie, and how it is filtered.

use welkin_baker::{SkyboxPicture, skybox_faces};
use welkin_pack::Image;
use welkin_pack::format::CUBE_FACES;
use welkin_pack::mapping::cube_to_direction;

use super::{bake, bake_faces, panorama, plain_exr, scene, settings, worst};

/// A bilinear sample between texels of `step` radians is off by up to `step^2 / 8` times the second
/// derivative on each axis, the mean over a texel of `side` radians by `side^2 / 24` on each. The steepest
/// channel of the scene bends by 0.8 a square radian, and at a pole, where columns meet, by a little more.
fn tolerance(step: f32, side: f32) -> f32 {
    2.0 * 0.8 * (step * step / 8.0 + side * side / 24.0) + 1e-5
}

#[test]
fn every_direction_of_a_panorama_comes_to_lie_where_a_cube_is_sampled() {
    for (width, size) in [(256, 64), (256, 16), (64, 128)] {
        let faces = bake("sky.exr", &plain_exr(&panorama(width, scene)), Some(size)).unwrap();
        let allowed = tolerance(std::f32::consts::TAU / width as f32, 2.0 / size as f32);
        let worst = worst(&faces, scene);
        println!("{width} to {size}: {worst} of {allowed}");
        assert!(worst < allowed, "{width} to {size}: {worst} of {allowed}");
    }
}

#[test]
fn the_azimuth_turns_a_panorama_to_the_right() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("sky.exr"),
        plain_exr(&panorama(128, scene)),
    )
    .unwrap();
    let turned = |azimuth_rad| {
        let mut settings = settings("sky.exr", Some(32));
        settings.picture = SkyboxPicture::Panorama {
            file: "sky.exr".to_string(),
            azimuth_rad,
        };
        skybox_faces(&settings, Some(folder.path())).unwrap()
    };
    // What was north lies in the east, and what was east in the south.
    let allowed = tolerance(std::f32::consts::TAU / 128.0, 2.0 / 32.0);
    let quarter = turned(std::f32::consts::FRAC_PI_2);
    assert!(worst(&quarter, |[x, y, z]| scene([z, y, -x])) < allowed);
    assert!(worst(&turned(std::f32::consts::TAU), scene) < allowed);
}

/// Six pictures as a viewer in the middle sees them, upright, in the order of the cube.
fn views(size: u32) -> [Image; 6] {
    // Ahead, to the right, upwards. Up: its lower edge is north, so upwards is south; down: the reverse.
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let back = |v: [f32; 3]| v.map(|c| -c);
    let axes = [
        [x, z, y],
        [back(x), back(z), y],
        [y, x, z],
        [back(y), x, back(z)],
        [z, back(x), y],
        [back(z), x, y],
    ];
    axes.map(|[ahead, right, upwards]| {
        let mut image = Image::new(size, size, 4);
        for row in 0..size {
            for column in 0..size {
                let [u, v] = [column, row].map(|i| (i as f32 + 0.5) / size as f32 * 2.0 - 1.0);
                let ray = [0, 1, 2].map(|i| ahead[i] + u * right[i] - v * upwards[i]);
                let length = (1.0 + u * u + v * v).sqrt();
                let colour = scene(ray.map(|c| c / length));
                image.texel_mut(column, row).copy_from_slice(&colour);
            }
        }
        image
    })
}

#[test]
fn six_faces_lie_as_they_are_seen_from_the_middle() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = views(32).map(|view| plain_exr(&view));
    let same = bake_faces(folder.path(), &pictures, None).unwrap();
    assert_eq!(same[0].width, 32);
    // One sample in the middle of each texel: nothing but rounding.
    assert!(worst(&same, scene) < 1e-5, "{}", worst(&same, scene));
    for size in [16, 128] {
        let other = bake_faces(folder.path(), &pictures, Some(size)).unwrap();
        let (worst, allowed) = (
            worst(&other, scene),
            tolerance(2.0 / 32.0, 2.0 / size as f32),
        );
        // On an edge two faces bend a grid of texels, which makes up to half a texel's slope more.
        let bend = 0.8 * 0.5 * (2.0 / 32.0) * 0.5;
        println!("32 to {size}: {worst} of {allowed} + {bend}");
        assert!(worst < allowed + bend, "32 to {size}: {worst}");
    }
}

#[test]
fn faces_that_change_places_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let mut pictures = views(32).map(|view| plain_exr(&view));
    for (a, b) in [(0, 1), (2, 3), (4, 5), (0, 4)] {
        pictures.swap(a, b);
        let faces = bake_faces(folder.path(), &pictures, None).unwrap();
        assert!(
            worst(&faces, scene) > 0.3,
            "{} {}",
            CUBE_FACES[a],
            CUBE_FACES[b]
        );
        pictures.swap(a, b);
    }
}

/// Radiance times solid angle, over all faces.
fn light(faces: &[Image]) -> f64 {
    let mut sum = 0.0;
    for (face, image) in (0..).zip(faces) {
        let size = image.width;
        for (i, texel) in (0..).zip(image.texels.chunks_exact(4)) {
            let st = [i % size, i / size].map(|c| (c as f32 + 0.5) / size as f32);
            let along = cube_to_direction(face, st)[face as usize / 2].abs();
            let solid_angle = 4.0 / f64::from(size * size) * libm::pow(f64::from(along), 3.0);
            sum += f64::from(texel[0]) * solid_angle;
        }
    }
    sum
}

#[test]
fn a_small_sun_keeps_its_light_wherever_it_stands() {
    let width = 512_u32;
    let step = std::f64::consts::TAU / f64::from(width);
    let mut total = 0.0;
    let places = [
        (3, 128),
        (61, 90),
        (64, 128),
        (200, 100),
        (256, 60),
        (333, 170),
        (511, 125),
    ];
    for (x, y) in places {
        let mut picture = panorama(width, |_| [0.0, 0.0, 0.0, 1.0]);
        picture.texel_mut(x, y)[0] = 20_000.0;
        let elevation = std::f64::consts::FRAC_PI_2 - (f64::from(y) + 0.5) * step;
        let expected = 20_000.0 * step * step * libm::cos(elevation);
        let share = light(&bake("sky.exr", &plain_exr(&picture), Some(64)).unwrap()) / expected;
        println!("{x} {y}: {share}");
        // Bilinear samples half a texel to a texel apart weigh a texel 0.88 to 1.13 times on an axis, whatever
        // the phase; a point sample would lose the sun or make it ten times as bright.
        assert!((0.77..1.28).contains(&share), "{x} {y}: {share}");
        total += share / places.len() as f64;
    }
    assert!((total - 1.0).abs() < 0.1, "{total}");
}

#[test]
fn fine_patterns_become_their_mean() {
    let mut board = panorama(1024, |_| [0.0, 0.0, 0.0, 1.0]);
    for y in 0..board.height {
        for x in 0..board.width {
            board.texel_mut(x, y)[0] = ((x + y) % 2) as f32;
        }
    }
    let faces = bake("sky.exr", &plain_exr(&board), Some(16)).unwrap();
    for value in faces.iter().flat_map(|face| face.channel(0)) {
        // 441 samples of spread 1/6 have a mean of spread 0.008: six times that.
        assert!((value - 0.5).abs() < 0.05, "{value}");
    }
}

#[test]
fn the_size_follows_the_picture_unless_it_is_given() {
    let side = |width: u32, size: Option<u32>| {
        bake("sky.exr", &plain_exr(&panorama(width, scene)), size).unwrap()[0].width
    };
    assert_eq!(side(64, None), 16);
    assert_eq!(side(256, None), 64);
    assert_eq!(side(300, None), 64);
    assert_eq!(side(256, Some(32)), 32);
}

#[test]
fn the_bytes_do_not_depend_on_the_number_of_threads() {
    let picture = plain_exr(&panorama(128, scene));
    let with_threads = |count: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(count)
            .build()
            .unwrap();
        pool.install(|| bake("sky.exr", &picture, None).unwrap())
    };
    assert_eq!(with_threads(1), with_threads(3));
}
