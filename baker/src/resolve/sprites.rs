//! The table `[sprites]`.

use toml::{Spanned, Value};

use super::Recipe;
use crate::error::RecipeError;
use crate::recipe::tables::Entry;
use crate::settings::{SpriteShape, SpriteSource, SpritesSettings};

const FILE: &str = "the path of a PNG or OpenEXR file with alpha, as text";

const PICTURES: &str = "a list of 16 files: 3 of fog, 1 with a flat bottom, 6 of wisps, 6 of puffs";

const EITHER: &str = "none with `file`, which is a picture of all cells; remove one of the two";

impl Recipe {
    pub(super) fn sprites(&self) -> Result<SpritesSettings, RecipeError> {
        let s = &self.tables.sprites;
        Ok(SpritesSettings {
            size: self.size("sprites.size", &s.size, 512, 128, 2048)?,
            contrast: self.real("sprites.contrast", &s.contrast, 1.0, 0.0, 2.0)?,
            source: self.sprite_source()?,
        })
    }

    fn sprite_source(&self) -> Result<SpriteSource, RecipeError> {
        let s = &self.tables.sprites;
        let source = match (&s.file, &s.pictures) {
            (None, None) => {
                return Ok(SpriteSource::Noise(SpriteShape {
                    detail: self.real("sprites.detail", &s.detail, 1.0, 0.0, 1.5)?,
                    softness: self.real("sprites.softness", &s.softness, 1.0, 0.5, 3.0)?,
                }));
            }
            (Some(file), None) => SpriteSource::Sheet(self.sprite_file("sprites.file", file)?),
            (None, Some(pictures)) => self.sprite_cells(pictures)?,
            (Some(_), Some(pictures)) => {
                let span = pictures.span();
                return Err(self.refuse_at("sprites.pictures", span, "given", EITHER));
            }
        };
        self.refuse_shape("sprites.detail", &s.detail)?;
        self.refuse_shape("sprites.softness", &s.softness)?;
        Ok(source)
    }

    fn sprite_cells(
        &self,
        pictures: &Spanned<Vec<Spanned<Value>>>,
    ) -> Result<SpriteSource, RecipeError> {
        let entries = pictures.get_ref().iter().enumerate();
        let files: Vec<String> = entries
            .map(|(cell, value)| self.sprite_file(&format!("sprites.pictures[{cell}]"), value))
            .collect::<Result<_, _>>()?;
        let refuse = |files: Vec<String>| {
            let found = format!("a list of {}", files.len());
            self.refuse_at("sprites.pictures", pictures.span(), found, PICTURES)
        };
        let cells = Box::new(files.try_into().map_err(refuse)?);
        Ok(SpriteSource::Cells(cells))
    }

    fn sprite_file(&self, key: &str, value: &Spanned<Value>) -> Result<String, RecipeError> {
        match value.get_ref().as_str() {
            Some(text) if !text.is_empty() => Ok(text.to_string()),
            _ => Err(self.refuse(key, value, FILE)),
        }
    }

    /// Refuses a key that shapes clouds of noise.
    fn refuse_shape(&self, key: &str, entry: &Entry) -> Result<(), RecipeError> {
        match entry {
            Some(value) => {
                let expected = "none with pictures, which have a shape of their own; remove it";
                Err(self.refuse(key, value, expected))
            }
            None => Ok(()),
        }
    }
}
