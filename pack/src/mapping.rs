//! Where a direction lies in a texture: the parameterisations that baker and runtime share.
//!
//! Directions are unit vectors, right-handed, +Y up, north -Z, east +X. Every mapping comes with its
//! inverse, and a test sends points there and back.

mod cube;
mod flares;
mod sheet;
mod sky;

use std::f32::consts::SQRT_2;

pub use cube::{cube_texel, cube_to_direction, direction_to_cube};
pub use flares::FlareCell;
pub use sheet::{SheetCell, SheetKind};
pub use sky::{
    LOWEST_SUN_RAD, SKY_HAZES, SKY_PARTS, SkyLayer, layer_to_sun, sky_to_texel, sun_to_layer,
    texel_to_sky,
};

/// Azimuth (from north towards east) and elevation, both in radians, to a unit direction.
pub fn direction_from_angles(azimuth_rad: f32, elevation_rad: f32) -> [f32; 3] {
    let (sin_a, cos_a) = (libm::sinf(azimuth_rad), libm::cosf(azimuth_rad));
    let (sin_e, cos_e) = (libm::sinf(elevation_rad), libm::cosf(elevation_rad));
    [cos_e * sin_a, sin_e, -cos_e * cos_a]
}

/// A unit direction to azimuth (0..2 pi, from north towards east) and elevation, in radians.
pub fn angles_from_direction(direction: [f32; 3]) -> (f32, f32) {
    let [x, y, z] = direction;
    let azimuth = libm::atan2f(x, -z);
    let azimuth = if azimuth < 0.0 {
        azimuth + std::f32::consts::TAU
    } else {
        azimuth
    };
    (azimuth, libm::asinf(y.clamp(-1.0, 1.0)))
}

/// A unit direction to the plane of the dome: Lambert's azimuthal equal-area projection about the zenith.
///
/// The zenith is (0, 0), the horizon the circle of radius sqrt(2), +x east, +y south. One unit of area is
/// one steradian, so nothing is denser or thinner at the pole. Not defined at the nadir.
///
/// J. H. Lambert, "Anmerkungen und Zusaetze zur Entwerfung der Land- und Himmelscharten", 1772;
/// J. P. Snyder, "Map Projections: A Working Manual", USGS Professional Paper 1395, 1987, eq. 24-2.
pub fn direction_to_dome(direction: [f32; 3]) -> [f32; 2] {
    let [x, y, z] = direction;
    let k = libm::sqrtf(2.0 / (1.0 + y));
    [x * k, z * k]
}

/// The inverse of [`direction_to_dome`].
pub fn dome_to_direction(dome: [f32; 2]) -> [f32; 3] {
    let r2 = dome[0] * dome[0] + dome[1] * dome[1];
    let k = libm::sqrtf((1.0 - r2 / 4.0).max(0.0));
    [dome[0] * k, 1.0 - r2 / 2.0, dome[1] * k]
}

/// A unit direction to texture coordinates of the role `galaxy`: the dome's square, zenith in the middle.
pub fn direction_to_galaxy_uv(direction: [f32; 3]) -> [f32; 2] {
    direction_to_dome(direction).map(|p| 0.5 + p / (2.0 * SQRT_2))
}

/// The inverse of [`direction_to_galaxy_uv`].
pub fn galaxy_uv_to_direction(uv: [f32; 2]) -> [f32; 3] {
    dome_to_direction(uv.map(|c| (c - 0.5) * (2.0 * SQRT_2)))
}

/// Side of one tile of the star texture on the plane of the dome, where one unit of area is a steradian.
pub const STAR_TILE_SIDE: f32 = 1.0;

/// Where the zenith lies on the plane of the tiles. Four tiles around a corner are turns of each other, so no
/// corner may be overhead, where the symmetry would be seen.
pub const STAR_TILE_START: [f32; 2] = [0.289, 0.410];

/// A place in the star texture: tile, and texel within its turned copy of the texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarPlace {
    /// Which tile of the plane of the dome.
    pub tile: [i32; 2],
    /// Coordinates in the texture, 0..1 each, after the tile's own turn.
    pub uv: [f32; 2],
}

/// A point on the plane of the dome to its place in the star texture.
///
/// The texture is tiled, and each tile is mirrored and transposed by its own parities, so that bright
/// stars do not repeat in rows. Stars lie at texel centres and are never filtered across a tile's edge.
pub fn dome_to_star(dome: [f32; 2]) -> StarPlace {
    let plane = [0, 1].map(|i| (dome[i] + STAR_TILE_START[i]) / STAR_TILE_SIDE);
    let tile = plane.map(|p| libm::floorf(p) as i32);
    let local = [0, 1].map(|i| plane[i] - tile[i] as f32);
    StarPlace {
        tile,
        uv: turn(tile, local),
    }
}

/// The inverse of [`dome_to_star`].
pub fn star_to_dome(place: StarPlace) -> [f32; 2] {
    let local = turn_back(place.tile, place.uv);
    [0, 1].map(|i| (place.tile[i] as f32 + local[i]) * STAR_TILE_SIDE - STAR_TILE_START[i])
}

fn turn(tile: [i32; 2], uv: [f32; 2]) -> [f32; 2] {
    let flipped = flip(tile, uv);
    if swaps(tile) {
        [flipped[1], flipped[0]]
    } else {
        flipped
    }
}

fn turn_back(tile: [i32; 2], uv: [f32; 2]) -> [f32; 2] {
    let swapped = if swaps(tile) { [uv[1], uv[0]] } else { uv };
    flip(tile, swapped)
}

fn flip(tile: [i32; 2], uv: [f32; 2]) -> [f32; 2] {
    [0, 1].map(|i| if tile[i] & 1 == 1 { 1.0 - uv[i] } else { uv[i] })
}

fn swaps(tile: [i32; 2]) -> bool {
    (tile[0] >> 1) & 1 != (tile[1] >> 1) & 1
}

/// Where in the rows of the sunset gradient a direction lies: 0 (top) opposite the sun's azimuth on the
/// horizon, 1 (bottom) on the horizon below the sun. `sun_azimuth` is a unit vector (east, south).
pub fn direction_to_gradient(direction: [f32; 3], sun_azimuth: [f32; 2]) -> f32 {
    0.5 + 0.5 * (direction[0] * sun_azimuth[0] + direction[2] * sun_azimuth[1])
}

/// Steps of the ray march of the role `fbm` across one tile: a step is `size / FBM_STEPS_A_TILE` texels.
pub const FBM_STEPS_A_TILE: u32 = 64;

/// Fewest cells across the first layer of the role `fbm`; each layer has twice those of the one before.
pub const FBM_LEAST_CELLS: u32 = 4;

/// Unit direction towards the sun at a time of day (0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset).
///
/// The sun goes round a great circle that rises due east, stands `noon_elevation_rad` high in the south at
/// noon, and sets due west: the sky of an equinox.
pub fn sun_direction(time: f32, noon_elevation_rad: f32) -> [f32; 3] {
    let turn = std::f32::consts::TAU * (time - libm::floorf(time));
    let (east, up) = (libm::sinf(turn), -libm::cosf(turn));
    [
        east,
        up * libm::sinf(noon_elevation_rad),
        up * libm::cosf(noon_elevation_rad),
    ]
}

/// Sines of the sun's elevation between which stars appear: -5 degrees (the first stars) and -16 degrees.
pub const NIGHT_SINES: [f32; 2] = [-0.0872, -0.2756];

/// Share of the night sky that shows through, 0..1, from the sine of the sun's elevation: a smooth step between
/// [`NIGHT_SINES`].
pub fn night_share(sun_sin: f32) -> f32 {
    let [first, last] = NIGHT_SINES;
    let t = ((sun_sin - first) / (last - first)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn direction() -> impl Strategy<Value = [f32; 3]> {
        // The projection loses its digits next to the nadir, where nothing is drawn.
        (0.0_f32..std::f32::consts::TAU, -1.2_f32..1.57)
            .prop_map(|(azimuth, elevation)| direction_from_angles(azimuth, elevation))
    }

    fn apart(a: &[f32], b: &[f32]) -> f32 {
        a.iter()
            .zip(b)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f32::max)
    }

    proptest! {
        #[test]
        fn angles_and_back(direction in direction()) {
            let (azimuth, elevation) = angles_from_direction(direction);
            // asin loses half of the digits next to the poles.
            prop_assert!(apart(&direction, &direction_from_angles(azimuth, elevation)) < 5e-4);
        }

        #[test]
        fn dome_and_back(direction in direction()) {
            prop_assert!(apart(&direction, &dome_to_direction(direction_to_dome(direction))) < 2e-5);
        }

        #[test]
        fn galaxy_and_back(u in 0.1_f32..0.9, v in 0.1_f32..0.9) {
            prop_assert!(apart(&[u, v], &direction_to_galaxy_uv(galaxy_uv_to_direction([u, v]))) < 1e-5);
        }

        #[test]
        fn stars_and_back(x in -1.4_f32..1.4, y in -1.4_f32..1.4) {
            let place = dome_to_star([x, y]);
            prop_assert!(place.uv.iter().all(|c| (0.0..=1.0).contains(c)));
            prop_assert!(apart(&[x, y], &star_to_dome(place)) < 1e-6);
        }
    }

    #[test]
    fn the_dome_keeps_areas() {
        // The band between two elevations covers as much of the plane as it does of the sphere.
        let radius = |elevation: f32| {
            direction_to_dome(direction_from_angles(1.0, elevation)).map(|p| p * p)
        };
        for (low, high) in [(0.0, 0.2), (0.5, 0.9), (1.3, 1.57)] {
            let [a, b] = [low, high].map(|e| radius(e).iter().sum::<f32>());
            let plane = std::f32::consts::PI * (a - b);
            let sphere = std::f32::consts::TAU * (libm::sinf(high) - libm::sinf(low));
            assert!((plane - sphere).abs() < 1e-5 * sphere.max(1.0));
        }
    }

    #[test]
    fn compass_and_clock() {
        assert!(apart(&direction_from_angles(0.0, 0.0), &[0.0, 0.0, -1.0]) < 1e-6);
        assert!(
            apart(
                &direction_from_angles(std::f32::consts::FRAC_PI_2, 0.0),
                &[1.0, 0.0, 0.0]
            ) < 1e-6
        );
        let noon = 1.0;
        assert!(apart(&sun_direction(0.25, noon), &[1.0, 0.0, 0.0]) < 1e-6);
        assert!(
            apart(
                &sun_direction(0.5, noon),
                &direction_from_angles(std::f32::consts::PI, noon)
            ) < 1e-6
        );
        assert!(apart(&sun_direction(0.75, noon), &[-1.0, 0.0, 0.0]) < 1e-6);
        assert!(sun_direction(0.0, noon)[1] < -0.8);
        assert!(apart(&sun_direction(1.3, noon), &sun_direction(0.3, noon)) < 1e-6);
    }

    #[test]
    fn neighbouring_tiles_are_turned_differently() {
        let uv = |tile: [i32; 2]| {
            let place = StarPlace {
                tile,
                uv: turn(tile, [0.2, 0.4]),
            };
            dome_to_star(star_to_dome(place)).uv
        };
        let mut turns: Vec<[u32; 2]> = Vec::new();
        for tile in (-2..2).flat_map(|x| (-2..2).map(move |y| [x, y])) {
            turns.push(uv(tile).map(|c| (c * 10.0).round() as u32));
        }
        turns.sort();
        turns.dedup();
        assert_eq!(turns.len(), 8);
    }

    #[test]
    fn the_gradient_runs_from_opposite_the_sun_to_below_it() {
        let sun = [0.6, 0.8];
        assert_eq!(direction_to_gradient([0.6, 0.0, 0.8], sun), 1.0);
        assert_eq!(direction_to_gradient([-0.6, 0.0, -0.8], sun), 0.0);
        assert_eq!(direction_to_gradient([0.0, 1.0, 0.0], sun), 0.5);
    }
}
