//! The settings: what the sky is like, where one looks from, when.

use welkin_runtime::{Camera, SkyParams};

use crate::flashes;

/// The last second: 31 years are longer than any animation, and still exact to a microsecond in 64 bits.
pub(crate) const LAST_SECOND: f64 = 1e9;

/// All that a picture depends on but the pack and the size of the picture, and how time goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Parameters of the sky.
    pub params: SkyParams,
    /// Where one looks from, and where to.
    pub view: Viewpoint,
    /// Moment of the animation, in seconds, 0..=1e9.
    pub at_s: f64,
    /// Seconds of the animation that go by in a second, 0 (it stands) to 1000.
    pub rate: f32,
    /// Seconds that a day takes, 0 (the time of day stays) or up to 86400.
    pub day_length_s: f32,
    /// Flashes of lightning a minute, 0..=30. They follow from the moment.
    pub flashes_per_min: f32,
}

/// Where one looks from, and where to. Angles are in degrees, as a person reads them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// From north (0) towards east (90), -360..=360.
    pub azimuth_deg: f32,
    /// 0 is the horizon, 90 the zenith, -90..=90.
    pub elevation_deg: f32,
    /// Vertical field of view, 1..=150.
    pub fov_deg: f32,
    /// Metres to the east of the world's origin, -1e6..=1e6.
    pub east_m: f32,
    /// Metres to the north, of the same range.
    pub north_m: f32,
    /// Metres up, of the same range.
    pub up_m: f32,
}

impl Default for Viewpoint {
    fn default() -> Viewpoint {
        Viewpoint {
            azimuth_deg: 180.0,
            elevation_deg: 25.0,
            fov_deg: 60.0,
            east_m: 0.0,
            north_m: 0.0,
            up_m: 0.0,
        }
    }
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            params: SkyParams::default(),
            view: Viewpoint::default(),
            at_s: 0.0,
            rate: 1.0,
            day_length_s: 0.0,
            flashes_per_min: 0.0,
        }
    }
}

impl Viewpoint {
    /// The camera for a target of so many pixels.
    pub fn camera(&self, size_px: [u32; 2]) -> Camera {
        let [azimuth_rad, elevation_rad, fov_rad] =
            [self.azimuth_deg, self.elevation_deg, self.fov_deg].map(f32::to_radians);
        Camera {
            // North is -Z.
            position_m: [self.east_m, self.up_m, -self.north_m].into(),
            ..Camera::looking(azimuth_rad, elevation_rad, fov_rad, size_px)
        }
    }
}

impl Settings {
    /// The parameters of the frame at [`Settings::at_s`]: with the flash of that moment.
    pub fn frame_params(&self) -> SkyParams {
        let mut params = self.params;
        if self.flashes_per_min > 0.0 {
            params.weather.lightning = flashes::flash(self.flashes_per_min, self.at_s);
        }
        params
    }

    /// The camera for a target of so many pixels.
    pub fn camera(&self, size_px: [u32; 2]) -> Camera {
        self.view.camera(size_px)
    }

    /// Lets `seconds` of a person's time go by: the animation moves on, and the day if it has a length.
    pub fn advance(&mut self, seconds: f64) {
        let before_s = self.at_s;
        self.at_s = (self.at_s + seconds * f64::from(self.rate)).clamp(0.0, LAST_SECOND);
        if self.day_length_s > 0.0 {
            let days = seconds / f64::from(self.day_length_s);
            if let Some(date) = self.params.date {
                // The animation's own seconds make it go on too.
                let passed_s = self.at_s - before_s;
                self.params.date = Some(date.after(86_400.0 * days - passed_s));
                return;
            }
            self.params.time = (f64::from(self.params.time) + days).rem_euclid(1.0) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_day_goes_round_in_its_length() {
        let mut settings = Settings::default();
        (settings.day_length_s, settings.params.time) = (60.0, 0.75);
        settings.advance(30.0);
        assert!((settings.params.time - 0.25).abs() < 1e-6);
        settings.advance(-45.0);
        assert!((settings.params.time - 0.5).abs() < 1e-6);
    }

    #[test]
    fn a_date_goes_on_with_the_animation_or_by_the_length_of_a_day() {
        let mut settings = Settings::default();
        let start = "2026-06-21T18:30:00Z";
        settings.set("date", start).unwrap();
        settings.rate = 10.0;
        settings.advance(60.0);
        assert_eq!(settings.get("date").unwrap(), start, "at_s makes it go on");
        settings.day_length_s = 60.0;
        let shown = |s: &Settings| s.params.date.unwrap().unix_s() + s.at_s;
        let before = shown(&settings);
        settings.advance(30.0);
        assert!((shown(&settings) - before - 43_200.0).abs() < 1e-3);
        assert_eq!(settings.params.time, 0.5);
    }

    #[test]
    fn the_animation_goes_at_its_rate_and_stays_in_its_range() {
        let mut settings = Settings {
            rate: 20.0,
            ..Settings::default()
        };
        settings.advance(0.5);
        assert_eq!((settings.at_s, settings.params.time), (10.0, 0.5));
        settings.advance(-60.0);
        assert_eq!(settings.at_s, 0.0);
    }
}
