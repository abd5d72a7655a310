//! The settings: what the sky is like, where one looks from, when.

use welkin_pack::shown;
use welkin_runtime::{Camera, SkyParams};

use crate::flashes;
use crate::key::Key;
use crate::keys::{KEYS, key};

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

/// What is wrong with a setting.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingError {
    /// There is no setting of that name.
    #[error("there is no setting \"{}\"; did you mean \"{nearest}\"?", shown(.key))]
    Unknown {
        /// As it was called.
        key: String,
        /// The name that is most like it.
        nearest: &'static str,
    },
    /// It has no such value.
    #[error("{key} is \"{}\", {}", shown(.found), shown(.expected))]
    Value {
        /// Name of the setting.
        key: &'static str,
        /// As it was given.
        found: String,
        /// What it may be, beginning with "expected".
        expected: String,
    },
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
        let last = crate::values::LAST_SECOND;
        self.at_s = (self.at_s + seconds * f64::from(self.rate)).clamp(0.0, last);
        if self.day_length_s > 0.0 {
            let days = seconds / f64::from(self.day_length_s);
            self.params.time = (f64::from(self.params.time) + days).rem_euclid(1.0) as f32;
        }
    }

    /// Gives a setting the value that the text says.
    ///
    /// # Errors
    /// [`SettingError`]; nothing is changed then.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), SettingError> {
        key(name)?.set(self, text)
    }

    /// The text of a setting, as [`Settings::set`] takes it.
    ///
    /// # Errors
    /// [`SettingError::Unknown`].
    pub fn get(&self, name: &str) -> Result<String, SettingError> {
        Ok(key(name)?.text(self))
    }

    /// The usual settings with these values. The order of the pairs does not matter.
    ///
    /// # Errors
    /// [`SettingError`] of the first pair that is wrong.
    pub fn from_pairs<'a>(
        pairs: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Settings, SettingError> {
        let mut settings = Settings::default();
        settings.set_pairs(pairs)?;
        Ok(settings)
    }

    /// Gives several settings their values, whatever their order: a palette does not undo the colours given with it.
    ///
    /// # Errors
    /// [`SettingError`] of the first pair that is wrong; nothing is changed then.
    pub fn set_pairs<'a>(
        &mut self,
        pairs: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<(), SettingError> {
        let mut known = Vec::new();
        for (name, text) in pairs {
            let key = key(name)?;
            let place = KEYS.iter().position(|k| k.name == key.name);
            known.push((place, key, text));
        }
        known.sort_by_key(|(place, ..)| *place);
        let mut changed = *self;
        for (_, key, text) in known {
            key.set(&mut changed, text)?;
        }
        *self = changed;
        Ok(())
    }

    /// The settings that are not the usual ones, by name and text: what a link holds. [`Settings::from_pairs`] gives the settings back.
    pub fn changes(&self) -> Vec<(&'static str, String)> {
        let usual = self.usual();
        let changed = |key: &&Key| key.text(self) != key.text(&usual);
        let told = KEYS.iter().filter(changed);
        told.map(|key| (key.name, key.text(self))).collect()
    }

    /// The usual settings, but for the palette, whose colours are the usual ones of its own.
    fn usual(&self) -> Settings {
        let mut usual = Settings::default();
        usual.params.fbm = crate::text::palette(&self.params.fbm).colours();
        usual
    }

    /// The options of `welkin-view render` that draw this moment, those that are not the usual ones.
    pub fn options(&self) -> Vec<String> {
        let frame = Settings {
            params: self.frame_params(),
            ..*self
        };
        let usual = frame.usual();
        let mut words = Vec::new();
        for key in KEYS {
            // The palette is usual in `usual`, but not at the command line.
            let changed = key.text(&frame) != key.text(&usual) || key.name == "palette";
            if changed && key.applies(&frame) {
                words.extend(key.words(&frame));
            }
        }
        words
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

    #[test]
    fn what_is_wrong_is_told_and_changes_nothing() {
        let mut settings = Settings::default();
        let told = |error: SettingError| error.to_string();
        assert_eq!(
            settings.set("covr", "1").map_err(told),
            Err("there is no setting \"covr\"; did you mean \"cover\"?".to_string())
        );
        let pairs = [("height", "0.25"), ("cover", "1.5")];
        assert_eq!(
            settings.set_pairs(pairs).map_err(told),
            Err("cover is \"1.5\", expected a number from 0 to 1".to_string())
        );
        assert_eq!(settings, Settings::default());
    }

    #[test]
    fn flashes_are_of_the_frame_and_not_of_the_settings() {
        let settings = Settings {
            flashes_per_min: 10.0,
            ..Settings::default()
        };
        assert!(settings.frame_params().weather.lightning.strength > 0.0);
        assert_eq!(settings.params.weather.lightning.strength, 0.0);
        assert!(settings.options().contains(&"--lightning".to_string()));
    }
}
