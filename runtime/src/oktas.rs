//! Cover in oktas: which `cover` makes a method show a number of eighths of the sky.
//!
//! # Theory
//! An okta is an eighth of the sky covered by cloud (World Meteorological Organization, "International Cloud Atlas", 2017).
//! Here a direction is covered where the clouds' opacity is above [`OPAQUE`], and the sky is what stands higher than
//! [`LEAST_SINE`], weighted by solid angle.
//!
//! A method's opacity is a fixed function of a few numbers that it reads at places which have nothing to do with each other,
//! so the share of covered sky is the share of their joint distribution that gives enough opacity. It needs no picture:
//! - packed: photo, noise and detail, with the histograms of the pack's texels ([`crate::clouds::packed`], lines 14 to 25).
//! - octaves: the map holds shares of its own distribution, evenly distributed by construction; three domes and the finer
//!   read are independent ([`crate::clouds::octaves`]).
//! - fbm: octaves drift apart, so the distribution of their sum is the convolution of theirs ([`crate::clouds::fbm`]).
//! - sprites: clouds have ranks by the share of the ground that they cover together; its oktas are that share.
//! - lit: the blend of ranks is evenly distributed by construction, layers are independent, and cover is the covered share but for
//!   thin cloud before thin cloud ([`crate::clouds::lit`]).
//!
//! Each opacity is inverted in closed form for one of those numbers and averaged over the others. The cover is found by
//! bisection, since it enters in several places.
//!
//! # Changes versus the papers
//! None of them says how much of the sky its cover covers.
//!
//! # Practice
//! [`Oktas`] is made once a pack. A cover costs a millisecond or two and depends on neither camera nor moment: find it when a
//! setting changes. It is right on average over moments; one moment is a sample (docs/cover.md).

use welkin_pack::Pack;

use crate::clouds::coverage::Distributions;
use crate::clouds::shared::OPAQUE;
use crate::error::SkyError;
use crate::frame::Uniforms;
use crate::geometry::camera::Camera;
use crate::geometry::math::smoothstep;
use crate::methods::interface::Shown;
use crate::pack_data::PackData;
use crate::params::SkyParams;

/// Sine of the lowest elevation that counts, 10 degrees: below it haze hides clouds, as it hides them from an observer.
pub const LEAST_SINE: f32 = 0.173_648_18;

/// Eighths of a whole sky.
const OKTAS: f32 = 8.0;
/// Steps of a bisection: to 1 / 2^20 of the range.
const BISECTIONS: usize = 20;

/// What a pack's clouds cover: how the numbers that make opacity are distributed in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Oktas {
    pack_data: PackData,
    texels: Distributions,
}

impl Oktas {
    /// Counts the texels of level 0: some milliseconds.
    ///
    /// # Errors
    /// As [`PackData::new`].
    pub fn new(pack: &Pack) -> Result<Oktas, SkyError> {
        Ok(Oktas {
            pack_data: PackData::new(pack)?,
            texels: Distributions::new(pack)?,
        })
    }

    /// The `cover` with which the method of `params`, all else as it is, shows `oktas` eighths of cloud on average.
    ///
    /// 0 is no cloud of any kind that cover rules, 8 the cover 1. Oktas out of 0..=8 are clamped; what is no number leaves the
    /// cover as it is. If the other parameters do not let the method show so much, as domes without a cover do, the answer is
    /// 1; if they show more without any cover, as the upper layer of [`Method::Packed`](crate::params::Method::Packed) may, it is 0.
    pub fn cover(&self, params: &SkyParams, oktas: f32) -> f32 {
        if oktas.is_nan() {
            return params.clamped().cover;
        }
        if oktas <= 0.0 || oktas >= OKTAS {
            return if oktas > 0.0 { 1.0 } else { 0.0 };
        }
        let shows = |cover: f32| self.shown(&SkyParams { cover, ..*params });
        let (mut low, mut high) = (0.0, 1.0);
        if shows(low) >= oktas {
            return low;
        }
        if shows(high) <= oktas {
            return high;
        }
        for _ in 0..BISECTIONS {
            let cover = 0.5 * (low + high);
            if shows(cover) < oktas {
                low = cover;
            } else {
                high = cover;
            }
        }
        0.5 * (low + high)
    }

    /// How many oktas parameters show on average, 0..=8. The sprites counts the ground below clouds instead of the sky, as its
    /// cover does: clouds in space hide more of the sky than they stand over, the more the taller they are.
    pub fn shown(&self, params: &SkyParams) -> f32 {
        // Neither camera nor moment change what is read here.
        let camera = Camera::looking(0.0, 0.0, 1.0, [1, 1]);
        let uniforms = self.pack_data.uniforms(params, &camera, 0.0, 0.0);
        let shown = Shown {
            params: &params.clamped(),
            uniforms: &uniforms,
            texels: &self.texels,
        };
        let share = |opacity: f32| params.method.clouds().covered(&shown, opacity);
        let [hazy, clearness] = haze(&uniforms);
        OKTAS * ((1.0 - hazy) * share(OPAQUE) + hazy * share(OPAQUE / clearness))
    }
}

/// The share of the counted sky that lies in the haze of the horizon, and what the haze leaves of opacity in its middle.
fn haze(uniforms: &Uniforms) -> [f32; 2] {
    let out = uniforms.clouds.haze_scale.recip();
    let hazy = ((out - LEAST_SINE) / (1.0 - LEAST_SINE)).max(0.0);
    [hazy, smoothstep(0.0, out, 0.5 * (out + LEAST_SINE))]
}
