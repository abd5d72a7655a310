//! The recipe as it is used: defaults filled, types and ranges checked. Later stages never see TOML.

mod field;
mod layers;
mod photo;
mod skybox;
mod sprites;

use std::f32::consts::PI;
use std::ops::Range;

use toml::{Spanned, Value};
use welkin_pack::Format;
use welkin_pack::air::CLEAR_AEROSOL_DEPTH;
use welkin_pack::manifest::FractalNoise;

use crate::error::RecipeError;
use crate::recipe::tables::{Entry, Fractal, Sky};
use crate::recipe::{Recipe, line_and_column};
use crate::settings::{
    CatalogueSource, CloudSettings, FbmSettings, FlareSettings, GalaxySettings, GradientSettings,
    Resolved, SkySettings, StarSettings, SunSettings,
};

/// Means of photo and of noise. The power that makes the mean sharpens what is thin and digs pits into what is thick: beyond
/// these, cells of eight texels are no longer smooth at the texel.
const SHAPE_MEANS: [f32; 2] = [0.05, 0.68];

/// Means of detail, which may be rougher.
const DETAIL_MEANS: [f32; 2] = [0.02, 0.8];

/// Mean amount of cloud of the two together, `photo + noise (1 - photo)`, since every value of one drifts over every value
/// of the other. With less no cover makes an overcast, with more none opens the sky: the rule `cloud-cover` of `check`.
const AMOUNTS: [f32; 2] = [0.15, 0.7];

/// `sky.most_haze` by default: aerosol of an optical depth of 0.24, a hazy summer's day.
const MOST_HAZE: f32 = 6.0;
/// How much more the most haze is at the least: half floats tell them apart.
const LEAST_MORE_HAZE: f32 = 0.1;

impl Recipe {
    /// Fills defaults and checks every value. `seed` overrides the recipe's.
    ///
    /// # Errors
    /// [`RecipeError::Value`], which names the key, its place, what was found and what was expected.
    pub fn resolve(&self, seed: Option<u64>) -> Result<Resolved, RecipeError> {
        let t = &self.tables;
        let recipe_seed = self.seed(&t.seed)?;
        let size = self.size("clouds.size", &t.clouds.size, 512, 64, 4096)?;
        Ok(Resolved {
            name: self.name(&t.name)?,
            seed: seed.unwrap_or(recipe_seed),
            recipe: self.text.clone(),
            clouds: self.clouds(size)?,
            stars: self.stars()?,
            galaxy: self.galaxy()?,
            sky: SkySettings {
                width: self.size("sky.width", &t.sky.width, 16, 16, 64)?,
                height: self.size("sky.height", &t.sky.height, 32, 32, 64)?,
                suns: self.integer("sky.suns", &t.sky.suns, 40, 16, 64)?,
                aerosol_depths: self.aerosol_depths(&t.sky)?,
            },
            sun: SunSettings {
                size: self.size("sun.size", &t.sun.size, 128, 16, 1024)?,
                noon_elevation_rad: self.degrees(
                    "sun.noon_elevation_deg",
                    &t.sun.noon_elevation_deg,
                    60.0,
                    5.0,
                    90.0,
                )?,
            },
            fbm: self.fbm()?,
            flares: FlareSettings {
                size: self.size("flares.size", &t.flares.size, 256, 64, 1024)?,
            },
            layers: self.layers()?,
            sprites: self.sprites()?,
            skybox: self.skybox()?,
            field: self.field()?,
        })
    }

    fn clouds(&self, size: u32) -> Result<CloudSettings, RecipeError> {
        let c = &self.tables.clouds;
        let noise = FractalNoise {
            cells: 4,
            octaves: 5,
            gain: 0.45,
            mean: 0.22,
        };
        let detail = FractalNoise {
            cells: 8,
            octaves: 6,
            gain: 0.65,
            mean: 0.5,
        };
        let settings = CloudSettings {
            size,
            format: self.cloud_format(&c.format)?,
            photo: self.photo(size)?,
            noise: FractalNoise {
                mean: self.mean("clouds.noise.mean", &c.noise.mean, noise.mean, SHAPE_MEANS)?,
                ..self.fractal("clouds.noise", &c.noise, size, noise)?
            },
            detail: FractalNoise {
                mean: self.mean(
                    "clouds.detail.mean",
                    &c.detail.mean,
                    detail.mean,
                    DETAIL_MEANS,
                )?,
                ..self.fractal("clouds.detail", &c.detail, size, detail)?
            },
            gradient: GradientSettings {
                power: self.real("clouds.gradient.power", &c.gradient.power, 2.0, 1.0, 2.0)?,
            },
        };
        // Of a tile that is taken as it is nobody knows the mean yet.
        if let Some(mean) = settings.photo.mean {
            self.verify_amount(mean, settings.noise.mean)?;
        }
        Ok(settings)
    }

    fn mean(
        &self,
        key: &str,
        entry: &Entry,
        default: f32,
        [least, most]: [f32; 2],
    ) -> Result<f32, RecipeError> {
        self.real(key, entry, default, least, most)
    }

    /// Refuses photo and noise that together are too thin or too thick for the parameter cover to shut and to open the sky.
    fn verify_amount(&self, photo: f32, noise: f32) -> Result<(), RecipeError> {
        let amount = photo + noise * (1.0 - photo);
        let [least, most] = AMOUNTS;
        if (least..=most).contains(&amount) {
            return Ok(());
        }
        let c = &self.tables.clouds;
        let (key, entry, other_key, other) = match &c.noise.mean {
            Some(entry) => ("clouds.noise.mean", Some(entry), "clouds.photo.mean", photo),
            None => (
                "clouds.photo.mean",
                c.photo.mean.as_ref(),
                "clouds.noise.mean",
                noise,
            ),
        };
        // Defaults are in range, so one of the two is given.
        let Some(entry) = entry else { return Ok(()) };
        let range = AMOUNTS
            .map(|amount| ((amount - other) / (1.0 - other)).clamp(SHAPE_MEANS[0], SHAPE_MEANS[1]));
        // Two digits, rounded inwards, are in range for certain.
        let [least, most] = [
            libm::ceilf(100.0 * range[0]),
            libm::floorf(100.0 * range[1]),
        ];
        let expected = format!(
            "{} to {} with {other_key} = {other}",
            least / 100.0,
            most / 100.0
        );
        Err(self.refuse(key, entry, expected))
    }

    fn fractal(
        &self,
        table: &str,
        entry: &Fractal,
        size: u32,
        default: FractalNoise,
    ) -> Result<FractalNoise, RecipeError> {
        let key = |name: &str| format!("{table}.{name}");
        Ok(FractalNoise {
            // A cell of fewer than eight texels would not be smooth at the texel.
            cells: self.integer(
                &key("cells"),
                &entry.cells,
                default.cells.min(size / 8),
                1,
                size / 8,
            )?,
            octaves: self.integer(&key("octaves"), &entry.octaves, default.octaves, 1, 10)?,
            gain: self.real(&key("gain"), &entry.gain, default.gain, 0.0, 1.0)?,
            mean: default.mean,
        })
    }

    fn stars(&self) -> Result<StarSettings, RecipeError> {
        let s = &self.tables.stars;
        let size = self.size("stars.size", &s.size, 256, 64, 1024)?;
        // One star to 32 texels: the least distance between stars leaves room for that.
        let most = size * size / 32;
        Ok(StarSettings {
            size,
            count: self.integer("stars.count", &s.count, 1500.min(most), 1, most)?,
            // Five magnitudes are a factor of 100: the faintest star then keeps two of 255 steps.
            magnitudes: self.real("stars.magnitudes", &s.magnitudes, 5.0, 0.5, 5.0)?,
            brightest: self.real("stars.brightest", &s.brightest, 0.8, 0.8, 1.0)?,
            catalogue: self.catalogue(&s.catalogue)?,
        })
    }

    fn catalogue(&self, entry: &Entry) -> Result<Option<CatalogueSource>, RecipeError> {
        let Some(value) = entry else { return Ok(None) };
        match value.get_ref().as_str() {
            Some("built-in") => Ok(Some(CatalogueSource::BuiltIn)),
            Some(file) if !file.is_empty() => Ok(Some(CatalogueSource::File(file.to_string()))),
            _ => {
                let expected = "\"built-in\", or the path of a catalogue of stars, as text";
                Err(self.refuse("stars.catalogue", value, expected))
            }
        }
    }

    fn galaxy(&self) -> Result<GalaxySettings, RecipeError> {
        let g = &self.tables.galaxy;
        Ok(GalaxySettings {
            size: self.size("galaxy.size", &g.size, 128, 32, 1024)?,
            tilt_rad: self.degrees("galaxy.tilt_deg", &g.tilt_deg, 58.0, 0.0, 90.0)?,
            azimuth_rad: self.degrees("galaxy.azimuth_deg", &g.azimuth_deg, 35.0, 0.0, 360.0)?,
            dust: self.real("galaxy.dust", &g.dust, 0.8, 0.0, 1.0)?,
        })
    }

    fn fbm(&self) -> Result<FbmSettings, RecipeError> {
        let f = &self.tables.fbm;
        let size = self.size("fbm.size", &f.size, 256, 64, 1024)?;
        // The finest cell has two texels: with one there would be nothing between the lattice points.
        let finest = size / 2;
        let cells = self.size("fbm.cells", &f.cells, 8, 4, finest)?;
        let most = (finest / cells).ilog2() + 1;
        Ok(FbmSettings {
            size,
            octaves: self.integer("fbm.octaves", &f.octaves, 4.min(most), 1, most.min(8))?,
            cells,
        })
    }

    fn name(&self, entry: &Entry) -> Result<String, RecipeError> {
        let Some(value) = entry else {
            return Ok("default".to_string());
        };
        let fits =
            |s: &str| !s.is_empty() && s.chars().count() <= 64 && !s.chars().any(char::is_control);
        match value.get_ref().as_str() {
            Some(text) if fits(text) => Ok(text.to_string()),
            _ => Err(self.refuse("name", value, "a text of 1 to 64 characters on one line")),
        }
    }

    fn seed(&self, entry: &Entry) -> Result<u64, RecipeError> {
        let Some(value) = entry else { return Ok(1) };
        // TOML's integers end at 2^63 - 1; larger seeds can be given to `resolve`.
        let seed = value
            .get_ref()
            .as_integer()
            .and_then(|i| u64::try_from(i).ok());
        seed.ok_or_else(|| self.refuse("seed", value, format!("an integer from 0 to {}", i64::MAX)))
    }

    fn cloud_format(&self, entry: &Entry) -> Result<Format, RecipeError> {
        let Some(value) = entry else {
            return Ok(Format::Rgba8Unorm);
        };
        match value.get_ref().as_str() {
            Some("rgba8unorm" | "rgba8") => Ok(Format::Rgba8Unorm),
            Some("rgba16float" | "rgba16f") => Ok(Format::Rgba16Float),
            _ => Err(self.refuse("clouds.format", value, "\"rgba8unorm\" or \"rgba16float\"")),
        }
    }

    /// Optical depths of the aerosol: those of `haze` and of `most_haze`, which is more.
    fn aerosol_depths(&self, sky: &Sky) -> Result<[f32; 2], RecipeError> {
        let haze = self.real("sky.haze", &sky.haze, 1.0, 0.0, 10.0)?;
        let default = MOST_HAZE.max(2.0 * haze);
        let most = self.real("sky.most_haze", &sky.most_haze, default, 0.1, 40.0)?;
        match &sky.most_haze {
            Some(entry) if most < haze + LEAST_MORE_HAZE => {
                let expected = format!("{LEAST_MORE_HAZE} more than sky.haze, {haze}, or more");
                Err(self.refuse("sky.most_haze", entry, expected))
            }
            _ => Ok([haze, most].map(|haze| haze * CLEAR_AEROSOL_DEPTH)),
        }
    }

    fn size(
        &self,
        key: &str,
        entry: &Entry,
        default: u32,
        min: u32,
        max: u32,
    ) -> Result<u32, RecipeError> {
        let fits = |n: u32| n.is_power_of_two() && (min..=max).contains(&n);
        let expected = format!("a power of two from {min} to {max}");
        self.number(key, entry, default, fits, expected)
    }

    fn integer(
        &self,
        key: &str,
        entry: &Entry,
        default: u32,
        min: u32,
        max: u32,
    ) -> Result<u32, RecipeError> {
        let fits = |n: u32| (min..=max).contains(&n);
        let expected = format!("an integer from {min} to {max}");
        self.number(key, entry, default, fits, expected)
    }

    /// A whole number that fits, or the default where the recipe says nothing.
    fn number(
        &self,
        key: &str,
        entry: &Entry,
        default: u32,
        fits: impl Fn(u32) -> bool,
        expected: String,
    ) -> Result<u32, RecipeError> {
        let Some(value) = entry else {
            return Ok(default);
        };
        let found = value.get_ref().as_integer();
        found
            .and_then(|i| u32::try_from(i).ok())
            .filter(|&n| fits(n))
            .ok_or_else(|| self.refuse(key, value, expected))
    }

    fn real(
        &self,
        key: &str,
        entry: &Entry,
        default: f32,
        min: f32,
        max: f32,
    ) -> Result<f32, RecipeError> {
        let Some(value) = entry else {
            return Ok(default);
        };
        let number = match value.get_ref() {
            Value::Float(f) => Some(*f as f32),
            Value::Integer(i) => Some(*i as f32),
            _ => None,
        };
        // The comparison also refuses what is not a number.
        number
            .filter(|n| (min..=max).contains(n))
            .ok_or_else(|| self.refuse(key, value, format!("a number from {min} to {max}")))
    }

    fn degrees(
        &self,
        key: &str,
        entry: &Entry,
        default: f32,
        min: f32,
        max: f32,
    ) -> Result<f32, RecipeError> {
        Ok(self.real(key, entry, default, min, max)? * (PI / 180.0))
    }

    fn refuse(&self, key: &str, value: &Spanned<Value>, expected: impl ToString) -> RecipeError {
        self.refuse_at(key, value.span(), shown(value.get_ref()), expected)
    }

    fn refuse_at(
        &self,
        key: &str,
        span: Range<usize>,
        found: impl ToString,
        expected: impl ToString,
    ) -> RecipeError {
        let (line, column) = line_and_column(&self.text, span);
        RecipeError::Value {
            file: self.file.clone(),
            line,
            column,
            key: key.to_string(),
            found: found.to_string(),
            expected: expected.to_string(),
        }
    }
}

/// A value as its recipe wrote it, cut where it is long.
fn shown(value: &Value) -> String {
    const LONGEST: usize = 60;
    let text = match value {
        Value::Table(_) => "a table".to_string(),
        other => other.to_string(),
    };
    if text.chars().count() <= LONGEST {
        return text;
    }
    text.chars().take(LONGEST).chain("...".chars()).collect()
}
