//! The parameters of Roden and Parberry, and a few of our own.

/// What the sky shall look like. The first six are the paper's, 0..1 each.
///
/// Values out of range are clamped when a frame is prepared, and what is not a number becomes the
/// default, so that a slider or a script can never make a frame of NaN.
///
/// T. Roden, I. Parberry, "Clouds and Stars: Efficient Real-Time Procedural Sky Rendering Using 3D
/// Hardware", ACE 2005, section 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyParams {
    /// Amount of cloud: 0 clear, 1 overcast.
    pub cover: f32,
    /// Height of the clouds over the viewer: 0 low (large on the sky), 1 high (small).
    pub height: f32,
    /// Density of the clouds: 0 bumpy and bright, 1 smooth with dark cores.
    pub density: f32,
    /// Strength of the red gradient over the clouds on the sun's side.
    pub sunset: f32,
    /// Wind speed: 0 still, 1 fast.
    pub speed: f32,
    /// Time of day: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset, 1 midnight again.
    pub time: f32,
    /// Amount of the thin upper layer, 0 (off) to 1.
    pub upper_layer: f32,
    /// Factor on the radiance before the tone curve, 0..=64. A float target gets radiance without it.
    pub exposure: f32,
    /// Whether targets of few bits are dithered by half a step.
    pub dither: bool,
}

/// The largest [`SkyParams::exposure`]: six stops over the default.
pub const MAX_EXPOSURE: f32 = 64.0;

impl Default for SkyParams {
    /// A fair day at noon.
    fn default() -> SkyParams {
        SkyParams {
            cover: 0.6,
            height: 0.7,
            density: 0.2,
            sunset: 0.0,
            speed: 0.1,
            time: 0.5,
            upper_layer: 0.0,
            exposure: 1.0,
            dither: true,
        }
    }
}

impl SkyParams {
    /// The parameters in the caption of the paper's figure 2.
    pub fn figure_2() -> SkyParams {
        SkyParams {
            cover: 0.69,
            height: 1.0,
            density: 0.0,
            sunset: 0.72,
            speed: 0.1,
            time: 0.35,
            ..Default::default()
        }
    }

    /// The parameters in the caption of the paper's figure 4.
    pub fn figure_4() -> SkyParams {
        SkyParams {
            cover: 0.57,
            height: 0.52,
            density: 0.84,
            sunset: 0.43,
            speed: 0.0,
            time: 0.72,
            ..Default::default()
        }
    }

    /// The same parameters, all in their ranges.
    pub fn clamped(self) -> SkyParams {
        let usual = SkyParams::default();
        let clamp = |value: f32, usual: f32, max: f32| {
            if value.is_nan() {
                usual
            } else {
                value.clamp(0.0, max)
            }
        };
        SkyParams {
            cover: clamp(self.cover, usual.cover, 1.0),
            height: clamp(self.height, usual.height, 1.0),
            density: clamp(self.density, usual.density, 1.0),
            sunset: clamp(self.sunset, usual.sunset, 1.0),
            speed: clamp(self.speed, usual.speed, 1.0),
            time: clamp(self.time, usual.time, 1.0),
            upper_layer: clamp(self.upper_layer, usual.upper_layer, 1.0),
            exposure: clamp(self.exposure, usual.exposure, MAX_EXPOSURE),
            dither: self.dither,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clamps_what_is_out_of_range_and_replaces_what_is_no_number() {
        let wild = SkyParams {
            cover: -3.0,
            height: f32::INFINITY,
            density: f32::NAN,
            time: f32::NEG_INFINITY,
            exposure: 1e30,
            ..Default::default()
        };
        let tame = wild.clamped();
        assert_eq!(
            (tame.cover, tame.height, tame.time, tame.exposure),
            (0.0, 1.0, 0.0, MAX_EXPOSURE)
        );
        assert_eq!(tame.density, SkyParams::default().density);
    }

    #[test]
    fn leaves_good_parameters_alone() {
        assert_eq!(SkyParams::figure_2().clamped(), SkyParams::figure_2());
        assert_eq!(SkyParams::figure_4().clamped(), SkyParams::figure_4());
    }
}
