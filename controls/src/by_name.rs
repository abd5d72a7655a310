//! Settings by name: pairs of names and texts, and the options of `welkin-view render`.

use welkin_runtime::params::PALETTES;

use crate::keys::{KEYS, Key, SettingError, index, key};
use crate::settings::Settings;

impl Settings {
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
            known.push((index(name)?, text));
        }
        known.sort_by_key(|(index, _)| *index);
        let mut changed = *self;
        for (index, text) in known {
            KEYS[index].set(&mut changed, text)?;
        }
        *self = changed;
        Ok(())
    }

    /// The settings that are not the usual ones, by name and text: what a link holds. [`Settings::from_pairs`] gives the settings back.
    pub fn changes(&self) -> Vec<(&'static str, String)> {
        let defaults = self.defaults();
        let changed = |key: &&Key| key.text(self) != key.text(&defaults);
        let changed = KEYS.iter().filter(changed);
        changed.map(|key| (key.name, key.text(self))).collect()
    }

    /// The usual settings, but for the palette, whose colours are the usual ones of its own.
    fn defaults(&self) -> Settings {
        let mut defaults = Settings::default();
        defaults.params.fbm = PALETTES[self.params.fbm.palette()].2;
        defaults
    }

    /// The options of `welkin-view render` that draw this moment, those that are not the usual ones.
    pub fn options(&self) -> Vec<String> {
        let frame = Settings {
            params: self.frame_params(),
            ..*self
        };
        let defaults = frame.defaults();
        let mut words = Vec::new();
        for key in KEYS {
            // The palette is usual in `usual`, but not at the command line.
            let changed = key.text(&frame) != key.text(&defaults) || key.name == "palette";
            if changed && key.applies(&frame) {
                words.extend(key.options(&frame));
            }
        }
        words
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
