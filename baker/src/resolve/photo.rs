//! The table `[clouds.photo]`.

use toml::{Spanned, Value};

use super::{Recipe, SHAPE_MEANS};
use crate::error::RecipeError;
use crate::recipe::tables::Entry;
use crate::settings::{PhotoProjection, PhotoRegion, PhotoSeam, PhotoSettings};

/// The smallest side of a region, in texels: less holds no cloud.
const LEAST_SIDE: i64 = 64;

/// Black and white are apart by at least this, ten steps of a byte: nearer ones would show nothing but rounding.
const LEAST_LEVELS: f32 = 0.04;

/// Angle across the longer side by default, in degrees: the main camera of a phone, which is as a lens of 26 mm before a frame
/// of 34.6 x 26 mm.
const FOV_DEG: f32 = 67.0;

/// Where the horizon may be: far below a picture whose camera looks nearly straight up, or a little above one that looks down.
const HORIZONS: [f32; 2] = [-1.0, 20.0];

const FINISHED: &str =
    "none with `as_is = true`, which is for a finished tile; remove one of the two";

impl Recipe {
    pub(super) fn photo(&self, size: u32) -> Result<PhotoSettings, RecipeError> {
        let p = &self.tables.clouds.photo;
        let default = PhotoSettings::default();
        let as_is = self.switch("clouds.photo.as_is", &p.as_is)?;
        let mean = self.mean(
            "clouds.photo.mean",
            &p.mean,
            PhotoSettings::MEAN,
            SHAPE_MEANS,
        )?;
        let shaping = [
            ("flatten", &p.flatten),
            ("sharpness", &p.sharpness),
            ("projection", &p.projection),
            ("seam", &p.seam),
        ];
        for (name, entry) in shaping {
            if let Some(value) = entry.as_ref().filter(|_| as_is) {
                return Err(self.refuse(&format!("clouds.photo.{name}"), value, FINISHED));
            }
        }
        let real = |name: &str, entry, default, [least, most]: [f32; 2]| {
            self.real(&format!("clouds.photo.{name}"), entry, default, least, most)
        };
        Ok(PhotoSettings {
            file: self.photo_file("clouds.photo.file", &p.file)?,
            mask: self.photo_file("clouds.photo.mask", &p.mask)?,
            size,
            mean: (!as_is || p.mean.is_some()).then_some(mean),
            as_is,
            invert: self.switch("clouds.photo.invert", &p.invert)?,
            levels: self.photo_levels(&p.levels, default.levels)?,
            flatten: real("flatten", &p.flatten, default.flatten, [0.0, 1.0])?,
            sharpness: real("sharpness", &p.sharpness, default.sharpness, [0.25, 8.0])?,
            region: self.region(&p.region)?,
            projection: self.projection()?,
            seam: self.seam(&p.seam)?,
        })
    }

    fn seam(&self, entry: &Entry) -> Result<PhotoSeam, RecipeError> {
        let Some(value) = entry else {
            return Ok(PhotoSeam::Blend);
        };
        match value.get_ref().as_str() {
            Some("blend") => Ok(PhotoSeam::Blend),
            Some("cut") => Ok(PhotoSeam::Cut),
            _ => Err(self.refuse("clouds.photo.seam", value, "\"blend\" or \"cut\"")),
        }
    }

    fn projection(&self) -> Result<PhotoProjection, RecipeError> {
        let p = &self.tables.clouds.photo;
        let key = "clouds.photo.projection";
        let name = p
            .projection
            .as_ref()
            .map_or(Some("plan"), |value| value.get_ref().as_str());
        let none_with = |key: &str, entry: &Entry, expected: &str| match entry {
            Some(value) => Err(self.refuse(key, value, expected)),
            None => Ok(()),
        };
        let fov_key = "clouds.photo.fov_deg";
        match name {
            Some("plan") => {
                let expected = "none with `projection = \"plan\"`; remove one of the two";
                none_with(fov_key, &p.fov_deg, expected)?;
                none_with("clouds.photo.horizon", &p.horizon, expected)?;
                Ok(PhotoProjection::Plan)
            }
            Some("perspective") => Ok(PhotoProjection::Perspective {
                fov_rad: self.degrees(fov_key, &p.fov_deg, FOV_DEG, 5.0, 140.0)?,
                horizon: self.horizon(&p.horizon)?,
            }),
            Some("equirect") => {
                let expected = "none with a panorama, which has all azimuths; remove it";
                none_with(fov_key, &p.fov_deg, expected)?;
                Ok(PhotoProjection::Equirect {
                    horizon: self.horizon(&p.horizon)?,
                })
            }
            _ => {
                let Some(value) = &p.projection else {
                    return Ok(PhotoProjection::Plan);
                };
                let expected = "\"plan\", \"perspective\" or \"equirect\"";
                Err(self.refuse(key, value, expected))
            }
        }
    }

    /// The share of the height, or nothing where it is to be found.
    fn horizon(&self, entry: &Entry) -> Result<Option<f32>, RecipeError> {
        match entry {
            Some(value) if value.get_ref().as_str() == Some("auto") => Ok(None),
            Some(value) if value.get_ref().is_str() => {
                let expected = format!(
                    "\"auto\", or a number from {} to {}",
                    HORIZONS[0], HORIZONS[1]
                );
                Err(self.refuse("clouds.photo.horizon", value, expected))
            }
            None => Ok(None),
            Some(_) => {
                let [least, most] = HORIZONS;
                let share = self.real("clouds.photo.horizon", entry, 0.5, least, most)?;
                Ok(Some(share))
            }
        }
    }

    fn switch(&self, key: &str, entry: &Entry) -> Result<bool, RecipeError> {
        let Some(value) = entry else { return Ok(false) };
        let found = value.get_ref().as_bool();
        found.ok_or_else(|| self.refuse(key, value, "true or false"))
    }

    fn photo_file(&self, key: &str, entry: &Entry) -> Result<Option<String>, RecipeError> {
        let Some(value) = entry else { return Ok(None) };
        match value.get_ref().as_str() {
            Some(text) if !text.is_empty() => Ok(Some(text.to_string())),
            _ => Err(self.refuse(key, value, "the path of a photograph, as text")),
        }
    }

    fn photo_levels(&self, entry: &Entry, default: [f32; 2]) -> Result<[f32; 2], RecipeError> {
        let Some(value) = entry else {
            return Ok(default);
        };
        let number = |v: &Value| match v {
            Value::Float(f) => Some(*f as f32),
            Value::Integer(i) => Some(*i as f32),
            _ => None,
        };
        let levels = match value.get_ref().as_array().map(Vec::as_slice) {
            Some([black, white]) => number(black).zip(number(white)),
            _ => None,
        };
        let fits = |&(black, white): &(f32, f32)| {
            black >= 0.0 && white <= 1.0 && white - black >= LEAST_LEVELS
        };
        let found = levels.filter(fits).map(|(black, white)| [black, white]);
        found.ok_or_else(|| {
            let expected = format!(
                "black and white, two numbers from 0 to 1 that are {LEAST_LEVELS} or more apart"
            );
            self.refuse("clouds.photo.levels", value, expected)
        })
    }

    fn region(&self, entry: &Entry) -> Result<PhotoRegion, RecipeError> {
        let Some(value) = entry else {
            return Ok(PhotoRegion::Middle);
        };
        part(value).map(PhotoRegion::Part).ok_or_else(|| {
            let expected = format!(
                "left, top, width and height in texels of the picture, with sides of {LEAST_SIDE} or more"
            );
            self.refuse("clouds.photo.region", value, expected)
        })
    }
}

fn part(value: &Spanned<Value>) -> Option<[u32; 4]> {
    let numbers = value.get_ref().as_array()?.iter().map(Value::as_integer);
    let part = <[i64; 4]>::try_from(numbers.collect::<Option<Vec<i64>>>()?).ok()?;
    let is_large = part[2] >= LEAST_SIDE && part[3] >= LEAST_SIDE;
    let [Ok(left), Ok(top), Ok(width), Ok(height)] = part.map(u32::try_from) else {
        return None;
    };
    is_large.then_some([left, top, width, height])
}
