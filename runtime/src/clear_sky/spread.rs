//! How the light of a star is spread on a screen.
//!
//! # Theory
//! A star is as sharp as a screen can show it: a tent one pixel wide each way, whose weights add up to 1 wherever it is. Light that an eye scatters makes
//! bright stars larger: G. Spencer, P. Shirley, K. Zimmerman, D. P. Greenberg, "Physically-based glare effects for digital images", SIGGRAPH 1995, section 2.2, is a
//! sum of which one part, of 0.478 for eyes used to the night, is `a / (2 pi (r + a)^3)` with a = 0.02 degrees. The wing here is `s / (2 pi (r^2 + s^2)^1.5)`, which falls
//! alike. It has that share at that size, or, on a screen with wider pixels, the share that gives Spencer's light some pixels away; and it has all light that is more
//! than half of a pixel's white, and is then so wide that its middle is white. So no light of a bright star is lost, its colour is seen, and the brighter is the larger.
//! A wing ends where it is lost in the darkest sky.
//!
//! # Changes
//! Spencer's sum has a narrow part, within a pixel, and a wide one, a veil over degrees: both are left to the tent, since no screen and no eye tells them there. What a
//! screen cannot show is no part of it: an eye sees the real star scatter more than it sees of a screen.
//!
//! # Practice
//! Two roots a star.

use std::f32::consts::TAU;

/// The angle a of the eye's wing, in radians: 0.02 degrees.
const WING_RAD: f32 = 0.02 * std::f32::consts::PI / 180.0;
/// Its share of the light.
const WING_SHARE: f32 = 0.478;
/// The least radius s, in pixels: with it the sum over pixels is the integral, wherever the star is between them.
const LEAST_CORE_PX: f32 = 1.5;
/// The radiance at which a wing ends: a sixth of the darkest sky's.
pub const WING_END: f32 = 4e-4;
/// Where it ends at the latest, in pixels.
pub const FARTHEST_PX: f32 = 128.0;

/// The most radiance that the tent gives to a pixel, exposed: half of white, so that with the wing's middle it is not much more than white, and has its colour.
const MOST_TENT: f32 = 0.5;
/// Radiance of the middle of a wide wing, exposed.
const MOST_WING: f32 = 1.0;

/// What the shape of stars follows from, beside their light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// The angle a, in pixels.
    pub wing_px: f32,
    /// What is white, as a radiance.
    pub white: f32,
}

/// How the light of a star is spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// How far it reaches, in pixels.
    pub reach: f32,
    /// The share in the tent.
    pub core: f32,
    /// What the wing's profile is multiplied by, for a light of 1, in pixels.
    pub wing: f32,
    /// Square of its radius s, in square pixels.
    pub square: f32,
    /// What the profile, `(r^2 + s^2)^-1.5`, ends at.
    pub end: f32,
}

impl Screen {
    /// With pixels of this size, in radians, and this exposure.
    pub fn of(pixel_rad: [f32; 2], exposure: f32) -> Screen {
        Screen {
            wing_px: WING_RAD / (pixel_rad[0] * pixel_rad[1]).sqrt(),
            white: 1.0 / exposure.max(1e-6),
        }
    }

    /// The spread of a star whose light makes a pixel so bright.
    pub fn spread(self, luminance: f32) -> Spread {
        let least = self.wing_px.max(LEAST_CORE_PX);
        let scattered = WING_SHARE * self.wing_px / least;
        let kept = ((1.0 - scattered) * luminance).min(MOST_TENT * self.white);
        let rest = luminance - kept;
        let radius = (rest / (TAU * MOST_WING * self.white)).sqrt().max(least);
        let wing = rest * radius / TAU;
        let reach = (wing / WING_END).cbrt().min(FARTHEST_PX);
        if reach < 1.0 + least {
            // A wing within the tent is none.
            return Spread {
                reach: 1.0,
                core: 1.0,
                wing: 1.0,
                square: 1.0,
                end: f32::MAX,
            };
        }
        let square = radius * radius;
        let far = reach * reach + square;
        let end = far.powf(-1.5);
        // The integral of the profile less its end, to where it ends, over a turn.
        let integral = 1.0 / radius - 1.0 / far.sqrt() - 0.5 * end * reach * reach;
        Spread {
            reach,
            core: kept / luminance,
            wing: rest / luminance / (TAU * integral),
            square,
            end,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn screens() -> impl Iterator<Item = Screen> {
        let pixels = [3e-3, 1e-3, 3e-4, 5e-5];
        pixels
            .into_iter()
            .flat_map(|rad| [0.5, 1.0, 4.0].map(|exposure| Screen::of([rad; 2], exposure)))
    }

    /// What a pixel gets of a light of 1 that is so far away.
    fn profile(spread: &Spread, away: [f32; 2]) -> f32 {
        let [x, y] = away.map(|away| (1.0 - away.abs()).max(0.0));
        let square = away[0] * away[0] + away[1] * away[1] + spread.square;
        spread.core * x * y + spread.wing * (square.powf(-1.5) - spread.end).max(0.0)
    }

    #[test]
    fn tent_and_wing_have_all_the_light_wherever_they_are_between_pixels() {
        for screen in screens() {
            for luminance in [0.01, 0.3, 2.1, 5.0, 80.0, 3000.0] {
                let spread = screen.spread(luminance);
                assert!((0.0..=1.0).contains(&spread.core), "{screen:?} {spread:?}");
                for step in 0..9 {
                    let middle = [0.33 * (step % 3) as f32, 0.33 * (step / 3) as f32];
                    let side = spread.reach as i32 + 2;
                    let mut sum = 0.0_f64;
                    for (x, y) in (-side..=side).flat_map(|y| (-side..=side).map(move |x| (x, y))) {
                        let away = [x as f32 - middle[0], y as f32 - middle[1]];
                        sum += f64::from(profile(&spread, away));
                    }
                    // What is asked of the sum of light is 3 %.
                    assert!((sum - 1.0).abs() < 0.01, "{screen:?} {luminance}: {sum}");
                }
            }
        }
    }

    #[test]
    fn brighter_stars_are_larger_and_faint_ones_are_points() {
        for screen in screens() {
            let mut last = 0.0;
            // To Sirius at 2160 lines, 300.
            for step in 0..165 {
                let luminance = 1e-3 * 1.08_f32.powi(step);
                let spread = screen.spread(luminance);
                assert!(
                    spread.reach >= last && spread.reach <= FARTHEST_PX,
                    "{step}"
                );
                last = spread.reach;
                // White, and no more than what a tent and a wing have, wherever the star is.
                let most = (MOST_TENT + MOST_WING) * screen.white;
                assert!(
                    luminance * profile(&spread, [0.0; 2]) <= most.max(luminance.min(most)) * 1.2
                );
            }
            assert_eq!(screen.spread(1e-3).reach, 1.0);
        }
    }

    #[test]
    fn a_star_of_the_fifth_magnitude_is_a_point_at_2160_lines_and_sirius_no_wider_than_the_moon() {
        let screen = Screen::of([2.0 * 30.0_f32.to_radians().tan() / 2160.0; 2], 1.0);
        let one = crate::clear_sky::stars::radiance_of_one(256, [5.346e-4; 2], 1.0);
        let of = |magnitude: f64| {
            screen.spread(one * welkin_pack::starlight::light_of_magnitude(magnitude) as f32)
        };
        assert!(of(5.0).core > 0.5 && of(5.0).square.sqrt() == LEAST_CORE_PX);
        // Half of a wing's light is within the square root of 3 of its radius; the moon is 16 pixels wide there.
        assert!(2.0 * (3.0 * of(-1.46).square).sqrt() < 32.0);
        assert!(of(2.0).square.sqrt() < 3.0);
    }

    #[test]
    fn some_pixels_away_it_is_spencer_s() {
        // Fine pixels, and a star that a display shows whole.
        let screen = Screen::of([5e-5; 2], 1e-3);
        let spread = screen.spread(20.0);
        let a = screen.wing_px;
        for r in [8.0_f32 * a, 6.0 * a] {
            if r > 0.8 * spread.reach {
                continue;
            }
            let spencer = WING_SHARE * a / (TAU * (r + a).powi(3));
            let found = profile(&spread, [r, 0.0]) + spread.wing * spread.end;
            // (1 + a / r)^3 at most.
            assert!(
                (1.0..1.6).contains(&(found / spencer)),
                "{}",
                found / spencer
            );
        }
    }
}
