//! The table `[clouds.photo]`.

use toml::{Spanned, Value};

use super::{Recipe, SHAPE_MEANS};
use crate::error::RecipeError;
use crate::recipe::tables::Entry;
use crate::settings::{PhotoRegion, PhotoSettings};

/// The smallest side of a region, in texels: less holds no cloud.
const LEAST_SIDE: i64 = 64;

/// Black and white are apart by at least this, ten steps of a byte: nearer ones would show nothing but rounding.
const LEAST_LEVELS: f32 = 0.04;

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
        for (name, entry) in [("flatten", &p.flatten), ("sharpness", &p.sharpness)] {
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
        })
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
