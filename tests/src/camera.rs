//! Twin of camera.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::geometry::camera::CameraUniforms;

/// Direction of a pixel, not normalised; (0.5, 0.5) is the centre of the upper left pixel.
pub fn ray_of(camera: &CameraUniforms, pixel: Vec2) -> Vec3 {
    let ndc = Vec2::new(
        pixel.x / camera.width_px * 2.0 - 1.0,
        1.0 - pixel.y / camera.height_px * 2.0,
    );
    camera.forward + camera.right * ndc.x + camera.up * ndc.y
}

/// Pixel coordinates of a direction in front of the camera.
pub fn pixel_of(camera: &CameraUniforms, direction: Vec3) -> Vec2 {
    let clip =
        [camera.clip_x, camera.clip_y, camera.clip_w].map(|row| direction.dot(row.truncate()));
    let ndc = Vec2::new(clip[0], clip[1]) / clip[2];
    (ndc * Vec2::new(0.5, -0.5) + 0.5) * Vec2::new(camera.width_px, camera.height_px)
}

#[cfg(test)]
mod tests {
    use super::*;
    use welkin_runtime::internals::pack_data::PackData;
    use welkin_runtime::{Camera, SkyParams};

    #[test]
    fn a_pixel_and_its_ray_are_inverse() {
        let facts = PackData::new(crate::pack::default_pack()).unwrap();
        let camera = Camera::looking(2.0, 0.5, 1.2, [320, 200]);
        let uniforms = facts
            .uniforms(&SkyParams::default(), &camera, 0.0, 0.0)
            .camera;
        for pixel in [
            Vec2::new(0.5, 0.5),
            Vec2::new(311.0, 17.25),
            Vec2::new(160.0, 100.0),
        ] {
            let back = pixel_of(&uniforms, ray_of(&uniforms, pixel).normalize());
            assert!((back - pixel).length() < 1e-3, "{pixel} {back}");
        }
    }
}
