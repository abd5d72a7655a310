//! The camera: where each pixel looks.
//!
//! The sky is centred on the viewer, so directions are nearly all; where the viewer stands moves the clouds
//! of near layers against those of far ones. A pixel's direction is linear in
//! its place on the screen before it is normalised: `forward + x right + y up`, with x, y in -1..1.

use glam::{Mat4, Quat, Vec2, Vec3, Vec4};

use crate::geometry::part::Part;
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[],
    structs: &[CameraUniforms::WGSL],
    wgsl: include_str!("camera.wgsl"),
};

uniforms! {
    /// Camera.
    CameraUniforms {
        /// From the middle of the screen to its right side.
        right: Vec3,
        /// Width of the screen in pixels.
        width_px: f32,
        /// From the middle of the screen to its upper side.
        up: Vec3,
        /// Height of the screen in pixels.
        height_px: f32,
        /// To the middle of the screen.
        forward: Vec3,
        /// Nothing.
        _pad: f32,
        /// Row of a matrix: dot of its xyz with a direction gives its clip x.
        clip_x: Vec4,
        /// The same for y.
        clip_y: Vec4,
        /// The same for w.
        clip_w: Vec4,
    }
}

impl CameraUniforms {
    /// Where a direction is in clip space, -1 to 1 each way on the screen, if it is before the camera.
    pub fn on_screen(&self, direction: Vec3) -> Option<Vec2> {
        let along = |row: Vec4| direction.dot(row.truncate());
        let w = along(self.clip_w);
        (w > 1e-4).then(|| Vec2::new(along(self.clip_x), along(self.clip_y)) / w)
    }

    /// Pixel coordinates of a direction above the horizon and before the camera: (0, 0) is the upper left corner.
    pub fn pixel_of(&self, direction: Vec3) -> Option<Vec2> {
        let place = self.on_screen(direction).filter(|_| direction.y > 0.0)?;
        let size_px = Vec2::new(self.width_px, self.height_px);
        Some((0.5 + Vec2::new(0.5, -0.5) * place) * size_px)
    }
}

/// A perspective camera. The world is right-handed: +Y up, north -Z, east +X.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Rotation from camera space (looking along -Z, +Y up, +X right) to the world.
    pub orientation: Quat,
    /// Vertical field of view, in radians.
    pub fov_y_rad: f32,
    /// Width of the picture over its height.
    pub aspect: f32,
    /// Where the axis of the lens meets the screen, in -1..1; zero for all but off-centre projections.
    pub lens_shift: Vec2,
    /// Width and height of the target in pixels.
    pub viewport_px: [u32; 2],
    /// Where the viewer stands, in metres from the origin of the world; what is not finite counts as 0.
    pub position_m: Vec3,
    /// Depth of what stands in space, in clip space: `clip z = a w + b`, with `w` the distance along the axis in metres. None for a projection
    /// whose far plane is infinitely far.
    pub clip_z: Option<[f32; 2]>,
}

/// The field of view is kept inside this range, in radians: a tangent is neither 0 nor infinite.
const FOV_RANGE_RAD: [f32; 2] = [1e-3, 3.1];

/// The camera as the shaders want it: `direction = forward + x right + y up` for x, y in -1..1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rays {
    /// From the middle of the screen to its right side.
    pub right: Vec3,
    /// From the middle of the screen to its upper side.
    pub up: Vec3,
    /// To the middle of the screen. The axis of the lens has length 1.
    pub forward: Vec3,
}

impl Camera {
    /// A camera that looks at an azimuth (from north towards east) and an elevation, horizon level.
    pub fn looking(
        azimuth_rad: f32,
        elevation_rad: f32,
        fov_y_rad: f32,
        viewport_px: [u32; 2],
    ) -> Camera {
        Camera {
            orientation: Quat::from_rotation_y(-azimuth_rad) * Quat::from_rotation_x(elevation_rad),
            fov_y_rad,
            aspect: viewport_px[0].max(1) as f32 / viewport_px[1].max(1) as f32,
            lens_shift: Vec2::ZERO,
            viewport_px,
            position_m: Vec3::ZERO,
            clip_z: None,
        }
    }

    /// The camera of an application's own matrices.
    ///
    /// `view` takes the world, in metres, to a camera that looks along -Z, `projection` is a right-handed perspective to wgpu's clip space, standard or
    /// reversed depth, finite or infinite, centred or not.
    pub fn from_matrices(view: Mat4, projection: Mat4, viewport_px: [u32; 2]) -> Camera {
        let (_, rotation, _) = view.to_scale_rotation_translation();
        let position_m = view.inverse().w_axis.truncate();
        let (x_scale, y_scale) = (projection.x_axis.x, projection.y_axis.y);
        Camera {
            orientation: rotation.inverse(),
            fov_y_rad: 2.0 * (1.0 / y_scale).atan(),
            aspect: y_scale / x_scale,
            lens_shift: Vec2::new(projection.z_axis.x, projection.z_axis.y),
            viewport_px,
            position_m,
            clip_z: Some([-projection.z_axis.z, projection.w_axis.z]),
        }
    }

    /// Where the viewer stands, in metres.
    pub fn position_m(&self) -> Vec3 {
        if self.position_m.is_finite() {
            self.position_m
        } else {
            Vec3::ZERO
        }
    }

    /// The directions of the screen. What is not finite in the camera is replaced, so these never are.
    pub fn rays(&self) -> Rays {
        let fov = if self.fov_y_rad.is_nan() {
            1.0
        } else {
            self.fov_y_rad
        };
        let half_height = (fov.clamp(FOV_RANGE_RAD[0], FOV_RANGE_RAD[1]) / 2.0).tan();
        let aspect = if self.aspect.is_finite() {
            self.aspect.clamp(1e-3, 1e3)
        } else {
            1.0
        };
        let rotation = if self.orientation.is_finite() && self.orientation.length_squared() > 1e-12
        {
            self.orientation.normalize()
        } else {
            Quat::IDENTITY
        };
        let shift = if self.lens_shift.is_finite() {
            self.lens_shift
        } else {
            Vec2::ZERO
        };
        let right = rotation * Vec3::X * (half_height * aspect);
        let up = rotation * Vec3::Y * half_height;
        Rays {
            right,
            up,
            forward: rotation * Vec3::NEG_Z + right * shift.x + up * shift.y,
        }
    }

    /// Width and height of a pixel in the middle of the screen, in radians.
    pub(crate) fn pixel_rad(&self) -> [f32; 2] {
        let (rays, viewport) = (self.rays(), self.viewport());
        [
            2.0 * rays.right.length() / viewport.x,
            2.0 * rays.up.length() / viewport.y,
        ]
    }

    /// Width and height of the target in pixels, neither of them 0.
    pub fn viewport(&self) -> Vec2 {
        Vec2::new(
            self.viewport_px[0].max(1) as f32,
            self.viewport_px[1].max(1) as f32,
        )
    }
}

/// The camera's share of the uniforms.
pub fn uniforms(camera: &Camera) -> CameraUniforms {
    let (rays, viewport) = (camera.rays(), camera.viewport());
    // Rows of the inverse of [right up forward]: a direction's coordinates in that basis are its clip
    // x, y and w.
    let inverse = glam::Mat3::from_cols(rays.right, rays.up, rays.forward)
        .inverse()
        .transpose();
    CameraUniforms {
        right: rays.right,
        width_px: viewport.x,
        up: rays.up,
        height_px: viewport.y,
        forward: rays.forward,
        clip_x: inverse.x_axis.extend(0.0),
        clip_y: inverse.y_axis.extend(0.0),
        clip_w: inverse.z_axis.extend(0.0),
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    // DirectX's clip space is wgpu's: +Y up, depth 0..1.
    use glam::camera::rh::proj::directx as projection;

    use super::*;

    const PX: [u32; 2] = [1600, 1200];

    #[test]
    fn looks_where_it_is_told() {
        let half_pi = std::f32::consts::FRAC_PI_2;
        let forward =
            |azimuth, elevation| Camera::looking(azimuth, elevation, 1.0, PX).rays().forward;
        assert!(forward(0.0, 0.0).abs_diff_eq(Vec3::NEG_Z, 1e-6), "north");
        assert!(forward(half_pi, 0.0).abs_diff_eq(Vec3::X, 1e-6), "east");
        assert!(forward(2.0, half_pi).abs_diff_eq(Vec3::Y, 1e-6), "zenith");
    }

    #[test]
    fn matrices_give_the_same_rays_as_angles() {
        let camera = Camera::looking(0.7, 0.3, 1.1, PX);
        let view = Mat4::from_quat(camera.orientation.inverse())
            * Mat4::from_translation(Vec3::new(4.0, 2.0, -9.0));
        let projections = [
            projection::perspective(1.1, camera.aspect, 0.1, 100.0),
            projection::perspective_infinite_reverse(1.1, camera.aspect, 0.1),
        ];
        for projection in projections {
            let (a, b) = (
                camera.rays(),
                Camera::from_matrices(view, projection, PX).rays(),
            );
            assert!(
                a.right.abs_diff_eq(b.right, 1e-5) && a.up.abs_diff_eq(b.up, 1e-5),
                "{a:?} {b:?}"
            );
            assert!(a.forward.abs_diff_eq(b.forward, 1e-5), "{a:?} {b:?}");
            let stands = Camera::from_matrices(view, projection, PX).position_m();
            assert!(
                stands.abs_diff_eq(Vec3::new(-4.0, -2.0, 9.0), 1e-5),
                "{stands}"
            );
        }
    }

    #[test]
    fn rays_are_the_inverse_of_an_off_centre_projection() {
        let projection = projection::frustum(-0.3, 0.5, -0.2, 0.4, 0.5, 50.0);
        let rays = Camera::from_matrices(Mat4::IDENTITY, projection, PX).rays();
        for (x, y) in [(-1.0, -1.0), (0.3, -0.7), (1.0, 1.0)] {
            let direction = rays.forward + rays.right * x + rays.up * y;
            let clip = projection * (direction * 7.0).extend(1.0);
            assert!((clip.x / clip.w - x).abs() < 1e-5 && (clip.y / clip.w - y).abs() < 1e-5);
        }
    }

    #[test]
    fn a_broken_camera_still_has_finite_rays() {
        let nan = f32::NAN;
        for broken in [
            Camera::looking(nan, 0.0, 1.0, [0, 0]),
            Camera::looking(0.0, 0.0, nan, PX),
            Camera::looking(0.0, 0.0, f32::INFINITY, PX),
            Camera::from_matrices(Mat4::ZERO, Mat4::ZERO, PX),
        ] {
            let rays = broken.rays();
            assert!(
                rays.right.is_finite() && rays.up.is_finite() && rays.forward.is_finite(),
                "{broken:?}"
            );
        }
    }
}
