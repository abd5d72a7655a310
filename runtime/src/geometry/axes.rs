//! Worlds with other axes or units than the sky's.
//!
//! The sky's world is right-handed, +X east, +Y up, +Z south, in metres. An application may have its up along any axis (+Z in Blender and in most
//! CAD programs) and any unit of length: [`Axes`] takes its matrices, directions and places there and back.

use glam::{Mat3, Mat4, Vec3};

use super::camera::Camera;

/// The axes and the unit of an application's right-handed world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// From the world's directions to the sky's, a rotation.
    to_sky: Mat3,
    metres_per_unit: f32,
}

impl Axes {
    /// The sky's own: +Y up, -Z north, metres.
    pub const Y_UP: Axes = Axes {
        to_sky: Mat3::IDENTITY,
        metres_per_unit: 1.0,
    };
    /// Blender's and most maps': +Z up, +Y north, +X east, metres.
    pub const Z_UP: Axes = Axes {
        to_sky: Mat3::from_cols(Vec3::X, Vec3::NEG_Z, Vec3::Y),
        metres_per_unit: 1.0,
    };

    /// A world whose directions up and north are these, of any length; of `north`, what is not level is left out. East is `north x up`.
    ///
    /// None if one of them is no direction or both are the same line, or if the unit is not a positive number of metres.
    pub fn new(up: Vec3, north: Vec3, metres_per_unit: f32) -> Option<Axes> {
        let up = up.try_normalize()?;
        let north = north.try_normalize()?;
        let level = (north - up * north.dot(up))
            .try_normalize()
            .filter(|_| north.cross(up).length() > 1e-4)?;
        let is_length = metres_per_unit.is_finite() && metres_per_unit > 0.0;
        is_length.then(|| Axes {
            to_sky: Mat3::from_cols(level.cross(up), up, -level).transpose(),
            metres_per_unit,
        })
    }

    /// A direction of the world in the sky.
    pub fn to_sky(&self, direction: Vec3) -> Vec3 {
        self.to_sky * direction
    }

    /// A direction of the sky in the world: that of [`Luminary`](crate::Luminary), say.
    pub fn from_sky(&self, direction: Vec3) -> Vec3 {
        self.to_sky.transpose() * direction
    }

    /// From the world's places to the sky's, in metres: for the shaders that ask [`air`](crate::air) and the clouds' shadows.
    pub fn matrix(&self) -> Mat4 {
        Mat4::from_mat3(self.to_sky * self.metres_per_unit)
    }

    /// The camera of the world's own matrices, as [`Camera::from_matrices`] wants them.
    pub fn camera(&self, view: Mat4, projection: Mat4, viewport_px: [u32; 2]) -> Camera {
        let unit = self.metres_per_unit;
        // In metres on both sides of the view.
        let view = Mat4::from_scale(Vec3::splat(unit)) * view * self.matrix().inverse();
        let mut camera = Camera::from_matrices(view, projection, viewport_px);
        // The near plane too.
        camera.clip_z = camera.clip_z.map(|[a, b]| [a, b * unit]);
        camera
    }
}

#[cfg(test)]
mod tests {
    use glam::camera::rh::proj::directx as projection;
    use glam::camera::rh::view;

    use super::*;

    const PX: [u32; 2] = [1600, 1200];

    #[test]
    fn well_known_axes_are_what_up_and_north_make() {
        let made = |up, north| Axes::new(up, north, 1.0).expect("axes");
        assert_eq!(made(Vec3::Y, Vec3::NEG_Z), Axes::Y_UP);
        assert_eq!(made(Vec3::Z * 3.0, Vec3::new(0.0, 2.0, 5.0)), Axes::Z_UP);
        assert_eq!(Axes::Z_UP.to_sky(Vec3::X), Vec3::X, "east");
        assert_eq!(Axes::Z_UP.to_sky(Vec3::Y), Vec3::NEG_Z, "north");
        assert_eq!(Axes::Z_UP.from_sky(Vec3::Y), Vec3::Z, "up");
    }

    #[test]
    fn any_axes_are_a_rotation() {
        let axes = Axes::new(Vec3::new(1.0, -2.0, 0.5), Vec3::new(0.3, 0.1, -4.0), 0.01);
        let axes = axes.expect("axes");
        assert!((axes.to_sky.determinant() - 1.0).abs() < 1e-5);
        let way = Vec3::new(0.2, -0.7, 0.4);
        assert!(axes.from_sky(axes.to_sky(way)).abs_diff_eq(way, 1e-5));
        assert!(
            axes.to_sky(Vec3::new(1.0, -2.0, 0.5).normalize())
                .abs_diff_eq(Vec3::Y, 1e-5)
        );
    }

    #[test]
    fn what_is_no_world_is_refused() {
        for (up, north, unit) in [
            (Vec3::ZERO, Vec3::X, 1.0),
            (Vec3::Y, Vec3::Y * -3.0, 1.0),
            (Vec3::Y, Vec3::new(f32::NAN, 0.0, 1.0), 1.0),
            (Vec3::Y, Vec3::X, 0.0),
            (Vec3::Y, Vec3::X, f32::INFINITY),
        ] {
            assert_eq!(Axes::new(up, north, unit), None, "{up} {north} {unit}");
        }
    }

    #[test]
    fn a_camera_looks_and_stands_where_it_does_in_its_world() {
        // Up is +Z, a unit is a centimetre: 300 m up, to the north-east and a little down.
        let axes = Axes::new(Vec3::Z, Vec3::Y, 0.01).expect("axes");
        let (eye, way) = (Vec3::new(1e4, -2e4, 3e4), Vec3::new(1.0, 1.0, -0.2));
        let seen = view::look_to_mat4(eye, way.normalize(), Vec3::Z);
        let lens = projection::perspective_infinite_reverse(1.0, 4.0 / 3.0, 10.0);
        let camera = axes.camera(seen, lens, PX);
        let stands = camera.position_m();
        assert!(
            stands.abs_diff_eq(Vec3::new(100.0, 300.0, 200.0), 1e-2),
            "{stands}"
        );
        let rays = camera.rays();
        let forward = Vec3::new(1.0, -0.2, -1.0).normalize();
        assert!(rays.forward.abs_diff_eq(forward, 1e-5), "{}", rays.forward);
        assert!(rays.right.y.abs() < 1e-6 && rays.up.y > 0.0);
        // A place 40 m before the viewer has the depth that the world's own matrices give it.
        let [a, b] = camera.clip_z.expect("depth");
        let clip = lens * seen * (eye + way.normalize() * 4000.0).extend(1.0);
        assert!((a + b / 40.0 - clip.z / clip.w).abs() < 1e-6);
    }
}
