//! The table `[sprites]`.

use super::Recipe;
use crate::error::RecipeError;
use crate::settings::{SpriteShape, SpritesSettings};

impl Recipe {
    pub(super) fn sprites(&self) -> Result<SpritesSettings, RecipeError> {
        let s = &self.tables.sprites;
        Ok(SpritesSettings {
            size: self.size("sprites.size", &s.size, 512, 128, 2048)?,
            contrast: self.real("sprites.contrast", &s.contrast, 1.0, 0.0, 2.0)?,
            shape: SpriteShape {
                detail: self.real("sprites.detail", &s.detail, 1.0, 0.0, 1.5)?,
                softness: self.real("sprites.softness", &s.softness, 1.0, 0.5, 3.0)?,
            },
        })
    }
}
