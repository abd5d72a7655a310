//! The sun: its disc with limb darkening, and the glow around it.
//!
//! Both channels are drawn about the centre of the texture at their own angular scale, which the runtime
//! chooses; `r` is the distance from the centre, 1 in the middle of a side.

use welkin_pack::Image;

use crate::filter::smoothstep;
use crate::settings::SunSettings;

/// Radius of the disc.
const DISC_RADIUS: f32 = 0.5;

/// Half the width of the disc's soft edge, in texels.
const EDGE_TEXELS: f32 = 1.5;

/// The same at most, in radii of the square: in a small texture the disc still ends where it should.
const MOST_EDGE: f32 = 0.1;

/// Radius at which the glow's core has fallen to half.
const GLOW_CORE: f32 = 0.22;

/// Two channels: disc and glow, 0..1.
pub(crate) fn image(settings: &SunSettings) -> Image {
    let mut image = Image::new(settings.size, settings.size, 2);
    let half = settings.size as f32 / 2.0;
    for y in 0..settings.size {
        for x in 0..settings.size {
            let [dx, dy] = [x, y].map(|i| (i as f32 + 0.5 - half) / half);
            let r = libm::sqrtf(dx * dx + dy * dy);
            image
                .texel_mut(x, y)
                .copy_from_slice(&[disc(r, (EDGE_TEXELS / half).min(MOST_EDGE)), glow(r)]);
        }
    }
    image
}

/// Limb darkening of a grey atmosphere: I(mu) / I(1) = 2/5 + 3/5 mu.
///
/// A. S. Eddington, "The Internal Constitution of the Stars", 1926, section 226.
fn disc(r: f32, edge: f32) -> f32 {
    let s = (r / DISC_RADIUS).min(1.0);
    let mu = libm::sqrtf(1.0 - s * s);
    (0.4 + 0.6 * mu) * (1.0 - smoothstep(DISC_RADIUS - edge, DISC_RADIUS + edge, r))
}

/// A bright core with long skirts, brought to 0 at r = 1 with a level slope: forward scattering by haze.
fn glow(r: f32) -> f32 {
    let q = r / GLOW_CORE;
    let window = (1.0 - r * r).max(0.0);
    window * window / (1.0 + q * q)
}
