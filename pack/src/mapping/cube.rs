//! The faces of a cube, as graphics interfaces number and turn them.
//!
//! Sampling a cube texture with a world direction gives the sky there. Cube maps are left-handed and the
//! world is right-handed, so the image of a face is the mirror image of what a viewer in the middle sees.

/// For each face, in the order of [`crate::format::CUBE_FACES`]: where its columns grow to (s), where its rows
/// grow to (t), and where it lies, as axes of the world.
///
/// Vulkan 1.3 specification, "Cube Map Face Selection", table of the major axes.
const FACES: [[[i8; 3]; 3]; 6] = [
    [[0, 0, -1], [0, -1, 0], [1, 0, 0]],
    [[0, 0, 1], [0, -1, 0], [-1, 0, 0]],
    [[1, 0, 0], [0, 0, 1], [0, 1, 0]],
    [[1, 0, 0], [0, 0, -1], [0, -1, 0]],
    [[1, 0, 0], [0, -1, 0], [0, 0, 1]],
    [[-1, 0, 0], [0, -1, 0], [0, 0, -1]],
];

/// A direction, of any length but 0, to a face of a cube (0 to 5) and texture coordinates on it, 0..1 each.
///
/// On an edge z wins over y and y over x, as Vulkan recommends.
pub fn direction_to_cube(direction: [f32; 3]) -> (u32, [f32; 2]) {
    let [x, y, z] = direction.map(f32::abs);
    let axis = if z >= x && z >= y {
        2
    } else {
        usize::from(y >= x)
    };
    let face = 2 * axis + usize::from(direction[axis] < 0.0);
    let along = |axis: [i8; 3]| -> f32 {
        let terms = axis.iter().zip(direction);
        terms.map(|(&a, d)| f32::from(a) * d).sum()
    };
    let [s, t, major] = FACES[face].map(along);
    (face as u32, [s, t].map(|c| 0.5 + 0.5 * c / major))
}

/// The inverse of [`direction_to_cube`]: a unit direction. Coordinates outside 0..1 go on in the plane of the
/// face.
///
/// # Panics
/// If there is no such face.
pub fn cube_to_direction(face: u32, st: [f32; 2]) -> [f32; 3] {
    let [s_axis, t_axis, major] = FACES[face as usize];
    let [s, t] = st.map(|c| 2.0 * c - 1.0);
    let point = [0, 1, 2]
        .map(|i| f32::from(s_axis[i]) * s + f32::from(t_axis[i]) * t + f32::from(major[i]));
    let length = libm::sqrtf(1.0 + s * s + t * t);
    point.map(|c| c / length)
}

/// The texel of a cube of `size` texels a side at column and row `texel` of a face. One column or one row
/// beyond a side is the neighbouring face's nearest.
///
/// Beyond a corner there is no texel; the answer is one of the three next to the corner.
///
/// # Panics
/// If there is no such face.
pub fn cube_texel(face: u32, texel: [i32; 2], size: u32) -> (u32, [u32; 2]) {
    let n = size as i32;
    if texel.iter().all(|i| (0..n).contains(i)) {
        return (face, texel.map(|i| i as u32));
    }
    // In half texels from the middle of the cube: texel centres are odd numbers less than n, and n + 1 beyond
    // a side.
    let [s_axis, t_axis, major] = FACES[face as usize].map(|axis| axis.map(i32::from));
    let [s, t] = texel.map(|i| (2 * i + 1 - n).clamp(-n - 1, n + 1));
    let point = [0, 1, 2].map(|i| s_axis[i] * s + t_axis[i] * t + (n - 1) * major[i]);
    let axis = (0..3).max_by_key(|&i| point[i].abs()).unwrap_or(0);
    let face = 2 * axis + usize::from(point[axis] < 0);
    let along = |axis: [i8; 3]| -> i32 {
        let terms = axis.iter().zip(point);
        terms.map(|(&a, p)| i32::from(a) * p).sum()
    };
    let place =
        [FACES[face][0], FACES[face][1]].map(|axis| ((along(axis) + n - 1) / 2).clamp(0, n - 1));
    (face as u32, place.map(|i| i as u32))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Edges excluded, where the direction belongs to either face.
    fn inside() -> impl Strategy<Value = f32> {
        0.001_f32..0.999
    }

    proptest! {
        #[test]
        fn cube_and_back(face in 0_u32..6, s in inside(), t in inside()) {
            let direction = cube_to_direction(face, [s, t]);
            let length: f32 = direction.iter().map(|c| c * c).sum();
            prop_assert!((length - 1.0).abs() < 1e-6);
            let (back, st) = direction_to_cube(direction);
            prop_assert_eq!(back, face);
            prop_assert!((st[0] - s).abs() < 1e-6 && (st[1] - t).abs() < 1e-6);
        }

        #[test]
        fn directions_and_back(x in -1.0_f32..1.0, y in -1.0_f32..1.0, z in -1.0_f32..1.0) {
            let length = libm::sqrtf(x * x + y * y + z * z);
            prop_assume!(length > 0.01);
            let (face, st) = direction_to_cube([x, y, z]);
            prop_assert!(st.iter().all(|c| (0.0..=1.0).contains(c)));
            let back = cube_to_direction(face, st);
            for (b, c) in back.iter().zip([x, y, z]) {
                prop_assert!((b - c / length).abs() < 1e-6);
            }
        }

        #[test]
        fn the_texel_beyond_a_side_is_the_nearest_of_the_neighbour(
            face in 0_u32..6, along in 0_i32..16, side in 0_usize..4
        ) {
            let size = 16;
            let texel = [[-1, along], [16, along], [along, -1], [along, 16]][side];
            let centre = |face: u32, texel: [i32; 2]| {
                cube_to_direction(face, texel.map(|i| (i as f32 + 0.5) / size as f32))
            };
            let (beyond, place) = cube_texel(face, texel, size);
            prop_assert_ne!(beyond, face);
            // Neighbours are nowhere further apart than in the middle of a face, 2/16 radians.
            let cosine = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>();
            let here = centre(face, texel.map(|i| i.clamp(0, 15)));
            let there = centre(beyond, place.map(|i| i as i32));
            prop_assert!(cosine(here, there) > libm::cosf(2.0 / 16.0));
            // Going back across the same side leads here again.
            let back = [[-1, 0], [1, 0], [0, -1], [0, 1]].iter().any(|step| {
                let next = [0, 1].map(|i| place[i] as i32 + step[i]);
                cube_texel(beyond, next, size) == (face, texel.map(|i| i.clamp(0, 15) as u32))
            });
            prop_assert!(back);
        }
    }

    #[test]
    fn faces_lie_where_their_names_say() {
        let middle = |face: u32| cube_to_direction(face, [0.5, 0.5]);
        let (east, up, south) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        let opposite = |d: [f32; 3]| d.map(|c: f32| 0.0 - c);
        assert_eq!(middle(0), east);
        assert_eq!(middle(1), opposite(east));
        assert_eq!(middle(2), up);
        assert_eq!(middle(3), opposite(up));
        assert_eq!(middle(4), south);
        assert_eq!(middle(5), opposite(south));
    }

    /// Facing north, east is on the right: the face is mirrored, so east lies on its left, at small s.
    #[test]
    fn faces_are_turned_as_graphics_interfaces_want_them() {
        assert!(cube_to_direction(5, [0.1, 0.5])[0] > 0.0, "east of north");
        assert!(cube_to_direction(0, [0.1, 0.5])[2] > 0.0, "south of east");
        for face in [0, 1, 4, 5] {
            assert!(
                cube_to_direction(face, [0.5, 0.1])[1] > 0.0,
                "row 0 is the upper one"
            );
        }
        assert!(
            cube_to_direction(2, [0.5, 0.1])[2] < 0.0,
            "up: row 0 is north"
        );
        assert!(
            cube_to_direction(3, [0.5, 0.1])[2] > 0.0,
            "down: row 0 is south"
        );
    }
}
