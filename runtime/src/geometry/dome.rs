//! The domes: a mesh as the papers draw it, and the analytic hit that replaces it.
//!
//! # Theory
//! Roden and Parberry (ACE 2005, section 2) put a cloud dome inside a sky dome that is centred on the
//! viewer. Here the cloud dome is a cap of a sphere: its lowest visible layer floats at height 1 above
//! the viewer, and the centre of the sphere lies [`CLOUD_SPHERE_RADIUS`] below. A ray from the
//! viewer meets it at `t = s - r y` with `s = sqrt((r y)^2 + 2 r + 1)`, y the sine of the elevation.
//!
//! # Changes versus the paper
//! The dome is intersected for each pixel instead of interpolating texture coordinates over a mesh:
//! no pole, no facets, and no vertex work. [`mesh`] still gives the paper's mesh; its coordinates
//! converge to the analytic ones with the square of the step.
//!
//! # Practice
//! One square root and a handful of multiplications a pixel. The mesh is for tests;
//! [`crate::Sky::new`] does not need it.

use glam::Vec3;

use crate::geometry::part::{Part, Value};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[("CLOUD_SPHERE_RADIUS", Value::F32(CLOUD_SPHERE_RADIUS))],
    structs: &[],
    wgsl: include_str!("dome.wgsl"),
};

/// Radius of the sphere below the cloud dome, in heights of the cloud layer over the viewer.
///
/// The real earth would give about 3000 and clouds that never end; domes of games use 10 to 20, which
/// brings the clouds at the horizon near enough to be seen.
pub const CLOUD_SPHERE_RADIUS: f32 = 16.0;

/// Where a ray from the viewer meets the cloud dome.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The point, in heights of the cloud layer, viewer at the origin.
    pub position: Vec3,
    /// Distance to the viewer in the same unit: 1 overhead, sqrt(2 r + 1) on the horizon.
    pub distance: f32,
    /// Cosine of the angle between the ray and the dome's normal.
    pub cos_incidence: f32,
}

/// Intersects the cloud dome with a ray from the viewer along a unit direction.
///
/// Every direction has exactly one hit, those below the horizon too, since the viewer is inside the sphere.
pub fn intersect(direction: Vec3) -> Hit {
    let r = CLOUD_SPHERE_RADIUS;
    let ry = r * direction.y;
    let s = (ry * ry + 2.0 * r + 1.0).sqrt();
    let distance = s - ry;
    Hit {
        position: direction * distance,
        distance,
        cos_incidence: s / (r + 1.0),
    }
}

/// A vertex of the dome mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Vertex {
    /// Unit direction from the viewer: the sky dome has radius 1.
    pub position: [f32; 3],
    /// East and south coordinate of the hit with the cloud dome, in heights of the cloud layer.
    pub uv: [f32; 2],
}

/// A dome from the horizon to the zenith.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Rings from the horizon up; each starts and ends at azimuth 0.
    pub vertices: Vec<Vertex>,
    /// One triangle strip over all rings, joined by triangles without area. Front faces (counter-clockwise)
    /// look at the viewer.
    pub indices: Vec<u16>,
}

/// The smallest step of [`mesh`] in degrees: finer ones would not fit 16-bit indices.
pub const MIN_STEP_DEG: f32 = 1.0;
/// The largest step of [`mesh`] in degrees.
pub const MAX_STEP_DEG: f32 = 45.0;

/// The dome as a triangle strip, a vertex every `step_deg` degrees of azimuth and of elevation.
///
/// Ten degrees are the papers' choice. The step is clamped to [`MIN_STEP_DEG`]..=[`MAX_STEP_DEG`] and
/// shortened until it divides 90 degrees; what is not a number becomes ten.
pub fn mesh(step_deg: f32) -> Mesh {
    mesh_of(step_deg, |direction| intersect(direction).position)
}

/// The same of a dome that rays meet at `position`.
pub(crate) fn mesh_of(step_deg: f32, position: impl Fn(Vec3) -> Vec3) -> Mesh {
    let step = if step_deg.is_nan() {
        10.0
    } else {
        step_deg.clamp(MIN_STEP_DEG, MAX_STEP_DEG)
    };
    let rings = (90.0 / step).ceil() as u16;
    let columns = rings * 4;
    let vertex = |ring: u16, column: u16| {
        let elevation = f32::from(ring) / f32::from(rings) * std::f32::consts::FRAC_PI_2;
        let azimuth = f32::from(column % columns) / f32::from(columns) * std::f32::consts::TAU;
        let direction = Vec3::from(welkin_pack::mapping::direction_from_angles(
            azimuth, elevation,
        ));
        let hit = position(direction);
        Vertex {
            position: direction.to_array(),
            uv: [hit.x, hit.z],
        }
    };
    let vertices = (0..=rings)
        .flat_map(|ring| (0..=columns).map(move |column| vertex(ring, column)))
        .collect();
    Mesh {
        vertices,
        indices: strip(rings, columns),
    }
}

fn strip(rings: u16, columns: u16) -> Vec<u16> {
    let stride = columns + 1;
    let mut indices = Vec::new();
    for ring in 0..rings {
        let (lower, upper) = (ring * stride, (ring + 1) * stride);
        if ring > 0 {
            // Twice the last vertex, twice the next: triangles without area, and the winding is kept.
            indices.extend([lower - stride + columns, upper]);
        }
        indices.extend((0..=columns).flat_map(|column| [upper + column, lower + column]));
    }
    indices
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_lie_on_the_sphere() {
        for (azimuth, elevation) in [(0.0, 1.57), (1.0, 0.0), (2.0, 0.4), (5.0, -0.7)] {
            let direction = Vec3::from(welkin_pack::mapping::direction_from_angles(
                azimuth, elevation,
            ));
            let hit = intersect(direction);
            let from_centre = hit.position + Vec3::Y * CLOUD_SPHERE_RADIUS;
            assert!((from_centre.length() - (CLOUD_SPHERE_RADIUS + 1.0)).abs() < 1e-4);
            let cos = from_centre.normalize().dot(direction);
            assert!((cos - hit.cos_incidence).abs() < 1e-5);
        }
        assert_eq!(intersect(Vec3::Y).distance, 1.0);
        assert!(
            (intersect(Vec3::X).distance - (2.0 * CLOUD_SPHERE_RADIUS + 1.0).sqrt()).abs() < 1e-5
        );
    }

    #[test]
    fn ten_degrees_give_the_papers_mesh() {
        let mesh = mesh(10.0);
        // 0, 10 .. 90 degrees of elevation, and 36 columns whose first is there twice.
        assert_eq!(mesh.vertices.len(), 10 * 37);
        assert_eq!(mesh.indices.len(), 9 * 2 * 37 + 8 * 2);
        assert!(
            mesh.indices
                .iter()
                .all(|&i| usize::from(i) < mesh.vertices.len())
        );
    }

    #[test]
    fn the_strip_covers_the_dome_once_and_faces_one_way() {
        let mesh = mesh(2.0);
        let mut area = 0.0;
        for (index, corners) in mesh.indices.windows(3).enumerate() {
            let [a, b, c] =
                [0, 1, 2].map(|k| Vec3::from(mesh.vertices[usize::from(corners[k])].position));
            // In a strip every second triangle is wound the other way round.
            let normal = (b - a).cross(c - a) * if index % 2 == 0 { 1.0 } else { -1.0 };
            area += normal.length() / 2.0;
            assert!(
                normal.dot(a + b + c) <= 1e-7,
                "triangle {index} faces outwards"
            );
        }
        // A hemisphere has 2 pi; facets of 2 degrees lie below it by some 1e-4.
        assert!((area / std::f32::consts::TAU - 1.0).abs() < 1e-3, "{area}");
    }

    #[test]
    fn any_step_fits_16_bit_indices() {
        for step in [f32::NAN, -1.0, 0.0, 1.0, 7.0, 1e9] {
            let mesh = mesh(step);
            assert!(mesh.vertices.len() <= usize::from(u16::MAX) + 1, "{step}");
            assert!(mesh.indices.len() > 3, "{step}");
        }
    }
}
