//! The faces of a cube map: which way each looks, and the cameras that draw it.
//!
//! Cube maps are left-handed: +X to the right, +Y up, +Z forward (Khronos Group, "KTX File Format Specification", version 2.0, and the
//! tables of OpenGL and Vulkan). The world is right-handed, so one axis changes its sign: forward, +Z, is north, which is -Z of the world;
//! +X is east and +Y up in both. So each face is what a viewer in the middle sees, not its mirror image.

use glam::{Mat3, Quat, Vec2, Vec3};
use welkin_pack::mapping::{cube_to_direction, direction_to_cube};
use welkin_runtime::Camera;

/// Names of the faces, in their order: +X east, -X west, +Y up, -Y down, +Z north, -Z south.
pub const FACES: [&str; 6] = ["px", "nx", "py", "ny", "pz", "nz"];

/// A direction of the world in the cube's axes, and the other way round.
pub fn flip([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, y, -z]
}

/// A direction of the world, of any length but 0, to the number of a face and texture coordinates on it, 0..1 each, from the upper left corner.
pub fn direction_to_face(direction: [f32; 3]) -> (usize, [f32; 2]) {
    let (face, st) = direction_to_cube(flip(direction));
    (face as usize, st)
}

/// The inverse of [`direction_to_face`]: a unit direction of the world. Coordinates outside 0..1 go on in the plane of the face.
///
/// # Panics
/// If there is no such face.
pub fn face_to_direction(face: usize, st: [f32; 2]) -> [f32; 3] {
    flip(cube_to_direction(face as u32, st))
}

/// The direction of a texel's centre, on a face of `side` texels a side.
///
/// # Panics
/// If there is no such face.
pub fn texel_direction(face: usize, [x, y]: [u32; 2], side: u32) -> Vec3 {
    let st = [x, y].map(|i| (i as f32 + 0.5) / side as f32);
    Vec3::from(face_to_direction(face, st))
}

/// The solid angle of a texel, in steradians, on a face of `side` texels a side.
///
/// From a corner of the face's plane to its middle it is `atan(xy / sqrt(x² + y² + 1))`, the sphere's area over the rectangle between.
pub fn texel_solid_angle([x, y]: [u32; 2], side: u32) -> f64 {
    let edge = |i: u32| 2.0 * f64::from(i) / f64::from(side) - 1.0;
    let corner = |x: f64, y: f64| (x * y / (x * x + y * y + 1.0).sqrt()).atan();
    let (left, right, high, low) = (edge(x), edge(x + 1), edge(y), edge(y + 1));
    corner(right, low) - corner(left, low) - corner(right, high) + corner(left, high)
}

/// A part of the plane of a face, in texels from its upper left corner. It may reach beyond the face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Column and row of its first texel.
    pub start: [i32; 2],
    /// Columns and rows.
    pub size: [u32; 2],
}

/// The camera that sees a part of a face of `side` texels a side, a pixel a texel, from where `viewer` stands.
///
/// # Panics
/// If there is no such face.
pub fn camera(face: usize, side: u32, tile: Tile, viewer: &Camera) -> Camera {
    let [half_width, half_height] = tile.size.map(|n| n as f32 / side as f32);
    // The middle of the tile on the plane at distance 1, whose face reaches from -1 to 1.
    let middle = |axis: usize| {
        (2 * tile.start[axis] + tile.size[axis] as i32 - side as i32) as f32 / side as f32
    };
    Camera {
        orientation: orientation(face),
        fov_y_rad: 2.0 * half_height.atan(),
        aspect: half_width / half_height,
        lens_shift: Vec2::new(middle(0) / half_width, -middle(1) / half_height),
        viewport_px: tile.size,
        ..*viewer
    }
}

fn orientation(face: usize) -> Quat {
    let towards = |st| Vec3::from(face_to_direction(face, st));
    let forward = towards([0.5, 0.5]);
    // The axes are whole numbers: what the square root has left over is rounded away.
    let to_side = |st| (towards(st) * std::f32::consts::SQRT_2 - forward).round();
    let (right, up) = (to_side([1.0, 0.5]), to_side([0.5, 0.0]));
    Quat::from_mat3(&Mat3::from_cols(right, up, -forward))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SIDE: u32 = 64;
    const WHOLE: Tile = Tile {
        start: [0, 0],
        size: [SIDE; 2],
    };

    fn viewer() -> Camera {
        Camera {
            position_m: Vec3::new(3.0, 40.0, -5.0),
            ..Camera::looking(0.3, 0.2, 1.0, [7, 9])
        }
    }

    /// Where a pixel of a camera looks; (0, 0) is its upper left corner.
    fn seen(camera: &Camera, pixel: [f32; 2]) -> Vec3 {
        let rays = camera.rays();
        let [x, y] = [0, 1].map(|i| 2.0 * pixel[i] / camera.viewport_px[i] as f32 - 1.0);
        (rays.forward + rays.right * x - rays.up * y).normalize()
    }

    proptest! {
        #[test]
        fn directions_to_faces_and_back(x in -1.0_f32..1.0, y in -1.0_f32..1.0, z in -1.0_f32..1.0) {
            let direction = Vec3::new(x, y, z);
            prop_assume!(direction.length() > 0.01);
            let (face, st) = direction_to_face(direction.to_array());
            let back = Vec3::from(face_to_direction(face, st));
            // Six roundings of numbers of about 1.
            prop_assert!(back.abs_diff_eq(direction.normalize(), 1e-6));
        }

        #[test]
        fn faces_to_directions_and_back(face in 0_usize..6, s in 0.001_f32..0.999, t in 0.001_f32..0.999) {
            let (back, st) = direction_to_face(face_to_direction(face, [s, t]));
            prop_assert_eq!(back, face);
            prop_assert!((st[0] - s).abs() < 1e-6 && (st[1] - t).abs() < 1e-6);
        }

        #[test]
        fn a_camera_sees_each_texel_of_its_tile_in_its_place(
            face in 0_usize..6,
            start in [-3_i32..60, -3_i32..60],
            size in [1_u32..40, 1_u32..40],
            at in [0.0_f32..1.0, 0.0_f32..1.0],
        ) {
            let camera = camera(face, SIDE, Tile { start, size }, &viewer());
            let pixel = [0, 1].map(|i| at[i] * size[i] as f32);
            let st = [0, 1].map(|i| (start[i] as f32 + pixel[i]) / SIDE as f32);
            let wanted = Vec3::from(face_to_direction(face, st));
            // A tangent and its arc, a quaternion: a dozen roundings, of which 1e-5 is 80.
            prop_assert!(seen(&camera, pixel).abs_diff_eq(wanted, 1e-5));
        }
    }

    #[test]
    fn solid_angles_are_those_of_the_sphere() {
        for side in [1, 4, 17] {
            let texels = || (0..side).flat_map(move |y| (0..side).map(move |x| [x, y]));
            let sum: f64 = texels().map(|at| texel_solid_angle(at, side)).sum();
            assert!((6.0 * sum / (4.0 * std::f64::consts::PI) - 1.0).abs() < 1e-12);
        }
        // Of a small texel: its area on the plane, by the cube of its distance.
        for at in [[0, 0], [511, 512], [900, 30]] {
            let [x, y] = at.map(|i: u32| (f64::from(i) + 0.5) / 512.0 - 1.0);
            let small = (2.0 / 1024.0_f64).powi(2) * (1.0 + x * x + y * y).powf(-1.5);
            // The next term is the square of a texel's side, 4e-6, with a factor of a few.
            assert!((texel_solid_angle(at, 1024) / small - 1.0).abs() < 2e-5);
        }
    }

    #[test]
    fn faces_look_where_they_should_and_are_not_mirrored() {
        let (east, up, north) = (Vec3::X, Vec3::Y, Vec3::NEG_Z);
        // Forward, and what is to the right of it and above it.
        let faces = [
            (east, -north, up),
            (-east, north, up),
            (up, east, -north),
            (-up, east, north),
            (north, east, up),
            (-north, -east, up),
        ];
        for (face, (forward, right, above)) in faces.into_iter().enumerate() {
            let rays = camera(face, SIDE, WHOLE, &viewer()).rays();
            for (found, wanted) in [
                (rays.forward, forward),
                (rays.right, right),
                (rays.up, above),
            ] {
                assert!(found.abs_diff_eq(wanted, 1e-6), "{}", FACES[face]);
            }
        }
    }

    #[test]
    fn a_camera_stands_where_the_viewer_does_and_its_pixels_are_as_fine_as_those_of_the_face() {
        let part = Tile {
            start: [-2, 10],
            size: [20, 30],
        };
        let side_of_a_pixel = |tile: Tile| {
            let rays = camera(4, SIDE, tile, &viewer()).rays();
            [
                rays.right.length() / tile.size[0] as f32,
                rays.up.length() / tile.size[1] as f32,
            ]
        };
        assert_eq!(
            camera(4, SIDE, part, &viewer()).position_m,
            viewer().position_m
        );
        for (whole, part) in side_of_a_pixel(WHOLE).iter().zip(side_of_a_pixel(part)) {
            assert!((whole / part - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn edges_of_neighbours_are_the_same_directions() {
        // Twelve edges, each seen from both of its faces.
        let mut met = 0;
        let edge = |face: usize, side: usize, along: f32| {
            let st = [[0.0, along], [1.0, along], [along, 0.0], [along, 1.0]][side];
            Vec3::from(face_to_direction(face, st))
        };
        let sides = || (0..6).flat_map(|face| (0..4).map(move |side| (face, side)));
        for (face, side) in sides() {
            for (other, other_side) in sides().filter(|(other, _)| *other > face) {
                let meets = |turned: bool| {
                    [0.1, 0.4, 0.9].iter().all(|&along| {
                        let there = if turned { 1.0 - along } else { along };
                        let apart = edge(face, side, along) - edge(other, other_side, there);
                        apart.length() < 1e-6
                    })
                };
                met += usize::from(meets(false) || meets(true));
            }
        }
        assert_eq!(met, 12);
    }
}
