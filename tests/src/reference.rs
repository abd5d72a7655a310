//! A path tracer through the bodies that the sprites of a field stand for: what their light is held to.
//!
//! # Theory
//! Each sprite is an ellipsoid of droplets that are all white: light is scattered, never absorbed, by the phase function of L. G. Henyey, J. L. Greenstein,
//! "Diffuse Radiation in the Galaxy", 1941. Paths from the viewer are free between collisions (E. Woodcock and others, 1965, with null collisions), meet the sun at
//! each of them, and end in the sky or on the ground. So single and multiple scattering are right but for noise.
//!
//! # Practice
//! Nothing of it is shared with what it is compared with: bodies are on a grid of their own, and light goes through them by chance.

use glam::Vec3;
use welkin_pack::field::Cloud;
use welkin_pack::{SheetCell, SheetKind};

/// Extinction in the middle of a body, 1 / m: cumulus of a fair day have 0.01 to 0.1 (K. Franklin and others give liquid water of 0.3 g/m3 and drops
/// of 10 micrometres: 0.045).
const EXTINCTION_M: f32 = 0.045;

/// The same of wisps and fog, as shares of it.
const THIN: f32 = 0.1;

/// Half axes of a body, as shares of the sprite's width and height.
const BODY: f32 = 0.42;

/// Asymmetry of the phase function of cloud droplets in sunlight.
const ASYMMETRY: f32 = 0.85;

/// Side of a cell of the grid, in metres.
const CELL_M: f32 = 25.0;

/// Step of a ray to the sun, in metres.
const SHADOW_STEP_M: f32 = 30.0;

/// A path ends after so many collisions, in what the ambient light is.
const MOST_COLLISIONS: usize = 400;

/// The light on a cloud: radiances.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Unit vector to the sun.
    pub to_sun: Vec3,
    /// What a white surface that faces the sun sends.
    pub sunlight: f32,
    /// The sky's.
    pub sky: f32,
    /// The ground's.
    pub ground: f32,
}

/// A cloud as a volume.
pub struct Volume {
    low: Vec3,
    counts: [usize; 3],
    extinctions: Vec<f32>,
    largest: f32,
}

impl Volume {
    /// The bodies of a cloud's sprites.
    pub fn new(cloud: &Cloud) -> Volume {
        let reach = |side: f32| BODY * side + CELL_M;
        let (mut low, mut high) = (Vec3::MAX, Vec3::MIN);
        for sprite in &cloud.sprites {
            let [width, height] = sprite.size_m.map(reach);
            let half = Vec3::new(width, height, width);
            low = low.min(Vec3::from(sprite.centre_m) - half);
            high = high.max(Vec3::from(sprite.centre_m) + half);
        }
        let counts = ((high - low) / CELL_M)
            .to_array()
            .map(|c| c.ceil() as usize + 1);
        let mut extinctions = vec![0.0; counts.iter().product()];
        for (i, extinction) in extinctions.iter_mut().enumerate() {
            let [x, y] = [i % counts[0], i / counts[0] % counts[1]];
            let z = i / (counts[0] * counts[1]);
            let place = low + Vec3::from([x, y, z].map(|c| c as f32)) * CELL_M;
            *extinction = cloud.sprites.iter().fold(0.0, |most: f32, sprite| {
                let [width, height] = sprite.size_m.map(|side| BODY * side);
                let away = (place - Vec3::from(sprite.centre_m)) / Vec3::new(width, height, width);
                let dense = match SheetCell(sprite.cell).kind() {
                    SheetKind::Puffy | SheetKind::FlatBottomed => EXTINCTION_M,
                    SheetKind::Foggy | SheetKind::Wispy => THIN * EXTINCTION_M,
                };
                // Full within half of the body, none at its surface.
                let depth = 1.0 - away.length();
                most.max(dense * (2.0 * depth).clamp(0.0, 1.0))
            });
        }
        Volume {
            low,
            counts,
            largest: extinctions.iter().copied().fold(0.0, f32::max),
            extinctions,
        }
    }

    /// Extinction between eight cells; 0 outside.
    fn at(&self, place: Vec3) -> f32 {
        let there = (place - self.low) / CELL_M;
        let from = there.floor();
        let part = there - from;
        let [x, y, z] = from.to_array().map(|c| c as i64);
        let cell = |dx: i64, dy: i64, dz: i64| {
            let at = [x + dx, y + dy, z + dz];
            let inside = (0..3).all(|a| (0..self.counts[a] as i64).contains(&at[a]));
            let [x, y, z] = at.map(|c| c as usize);
            let index = || (z * self.counts[1] + y) * self.counts[0] + x;
            if inside {
                self.extinctions[index()]
            } else {
                0.0
            }
        };
        let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
        let row = |dy, dz| mix(cell(0, dy, dz), cell(1, dy, dz), part.x);
        let sheet = |dz| mix(row(0, dz), row(1, dz), part.y);
        mix(sheet(0), sheet(1), part.z)
    }

    /// Where a ray is in the box of the volume: from and to, in metres.
    fn span(&self, from: Vec3, ray: Vec3) -> Option<[f32; 2]> {
        let size = Vec3::from(self.counts.map(|c| (c - 1) as f32)) * CELL_M;
        let inverse = ray.recip();
        let (a, b) = (
            (self.low - from) * inverse,
            (self.low + size - from) * inverse,
        );
        let near = a.min(b).max_element().max(0.0);
        let far = a.max(b).min_element();
        (near < far).then_some([near, far])
    }

    /// What of light comes along a ray.
    pub fn transmittance(&self, from: Vec3, ray: Vec3, step_m: f32) -> f32 {
        let Some([near, far]) = self.span(from, ray) else {
            return 1.0;
        };
        let steps = ((far - near) / step_m).ceil().max(1.0);
        let step = (far - near) / steps;
        let depth: f32 = (0..steps as usize)
            .map(|i| self.at(from + ray * (near + (i as f32 + 0.5) * step)))
            .sum();
        libm::expf(-depth * step)
    }

    /// Radiance that comes to a place against a ray that meets the cloud, by one path; none if it meets none.
    pub fn path(&self, from: Vec3, ray: Vec3, light: &Light, chance: &mut Chance) -> Option<f32> {
        let (mut place, mut ray) = (from, ray);
        let mut radiance = 0.0;
        for collision in 0..MOST_COLLISIONS {
            let Some(met) = self.free(place, ray, chance) else {
                let outside = if ray.y > 0.0 { light.sky } else { light.ground };
                return (collision > 0).then_some(radiance + outside);
            };
            place = met;
            // The irradiance of the sun is pi times what a white surface sends.
            let phase = henyey_greenstein(ray.dot(light.to_sun));
            let through = self.transmittance(place, light.to_sun, SHADOW_STEP_M);
            radiance += std::f32::consts::PI * light.sunlight * phase * through;
            ray = scatter(ray, chance);
        }
        Some(radiance)
    }

    /// The next collision.
    fn free(&self, from: Vec3, ray: Vec3, chance: &mut Chance) -> Option<Vec3> {
        let [mut at, far] = self.span(from, ray)?;
        loop {
            at -= libm::logf(1.0 - chance.unit()) / self.largest;
            if at >= far {
                return None;
            }
            let place = from + ray * at;
            if chance.unit() * self.largest < self.at(place) {
                return Some(place);
            }
        }
    }
}

/// Its integral over all directions is 1.
fn henyey_greenstein(cosine: f32) -> f32 {
    let g = ASYMMETRY;
    let base = 1.0 + g * g - 2.0 * g * cosine;
    (1.0 - g * g) / (4.0 * std::f32::consts::PI * base * base.sqrt())
}

/// A direction after a collision.
fn scatter(ray: Vec3, chance: &mut Chance) -> Vec3 {
    let g = ASYMMETRY;
    let part = (1.0 - g * g) / (1.0 - g + 2.0 * g * chance.unit());
    let cosine = ((1.0 + g * g - part * part) / (2.0 * g)).clamp(-1.0, 1.0);
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (sin, cos) = libm::sincosf(std::f32::consts::TAU * chance.unit());
    let (right, up) = ray.any_orthonormal_pair();
    (ray * cosine + (right * cos + up * sin) * sine).normalize()
}

/// Random numbers: a 64-bit linear congruential generator (D. E. Knuth, MMIX), upper bits.
#[derive(Clone, Debug)]
pub struct Chance(u64);

impl Chance {
    /// A stream of its own.
    pub fn new(seed: u64) -> Chance {
        Chance(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// 0 to below 1.
    fn unit(&mut self) -> f32 {
        let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = next.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / 16_777_216.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scattered_rays_have_the_mean_cosine_of_the_phase_function() {
        let mut chance = Chance::new(1);
        let ray = Vec3::new(0.48, -0.6, 0.64);
        let count = 20_000;
        let sum: f32 = (0..count).map(|_| scatter(ray, &mut chance).dot(ray)).sum();
        // Four standard errors: cosines spread by less than 0.35.
        assert!((sum / count as f32 - ASYMMETRY).abs() < 0.01);
        let whole: f32 = (0..2000)
            .map(|i| henyey_greenstein((i as f32 + 0.5) / 1000.0 - 1.0))
            .sum();
        assert!((whole / 1000.0 * 2.0 * std::f32::consts::PI - 1.0).abs() < 0.01);
    }

    /// A white cloud in a sky that is as bright everywhere cannot be seen: the furnace test.
    #[test]
    fn a_cloud_in_a_furnace_is_as_bright_as_the_furnace() {
        let cloud = crate::pack::default_pack()
            .field()
            .expect("the default pack has a field")
            .clouds[0]
            .clone();
        let volume = Volume::new(&cloud);
        let light = Light {
            to_sun: Vec3::Y,
            sunlight: 0.0,
            sky: 0.7,
            ground: 0.7,
        };
        let mut chance = Chance::new(2);
        let from = Vec3::from(cloud.centre_m) - Vec3::Z * 3000.0;
        for _ in 0..200 {
            if let Some(radiance) = volume.path(from, Vec3::Z, &light, &mut chance) {
                assert!((radiance - 0.7).abs() < 1e-6, "{radiance}");
            }
        }
    }
}
