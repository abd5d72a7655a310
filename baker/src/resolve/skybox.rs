//! The table `skybox`.

use toml::Spanned;

use super::Recipe;
use crate::error::RecipeError;
use crate::recipe::tables::{Entry, Faces, Skybox};
use crate::settings::{SkyboxPicture, SkyboxSettings};

const FILE: &str = "the path of a PNG, JPEG, Radiance HDR or OpenEXR file, as text";

impl Recipe {
    pub(super) fn skybox(&self) -> Result<Option<SkyboxSettings>, RecipeError> {
        let Some(table) = &self.tables.skybox else {
            return Ok(None);
        };
        let s = table.get_ref();
        let size = s
            .size
            .as_ref()
            .map(|_| self.size("skybox.size", &s.size, 256, 16, 2048));
        Ok(Some(SkyboxSettings {
            picture: self.skybox_picture(table)?,
            size: size.transpose()?,
            gain: self.real("skybox.gain", &s.gain, 1.0, 0.001, 1000.0)?,
        }))
    }

    fn skybox_picture(&self, table: &Spanned<Skybox>) -> Result<SkyboxPicture, RecipeError> {
        let s = table.get_ref();
        match (&s.file, &s.faces) {
            (Some(_), None) => Ok(SkyboxPicture::Panorama {
                file: self.picture_file("skybox.file", &s.file, table.span())?,
                azimuth_rad: self.degrees("skybox.azimuth_deg", &s.azimuth_deg, 0.0, 0.0, 360.0)?,
            }),
            (None, Some(faces)) => {
                if let Some(value) = &s.azimuth_deg {
                    let expected =
                        "none with `faces`, which say themselves where they lie; remove it";
                    return Err(self.refuse("skybox.azimuth_deg", value, expected));
                }
                self.faces(faces)
            }
            (file, _) => {
                let found = if file.is_some() {
                    "given both `file` and `faces`"
                } else {
                    "without a picture"
                };
                let expected = "either `file`, a panorama, or `faces`";
                Err(self.refuse_at("skybox", table.span(), found, expected))
            }
        }
    }

    fn faces(&self, faces: &Spanned<Faces>) -> Result<SkyboxPicture, RecipeError> {
        let f = faces.get_ref();
        let file = |name: &str, entry: &Entry| {
            self.picture_file(&format!("skybox.faces.{name}"), entry, faces.span())
        };
        Ok(SkyboxPicture::Faces([
            file("east", &f.east)?,
            file("west", &f.west)?,
            file("up", &f.up)?,
            file("down", &f.down)?,
            file("south", &f.south)?,
            file("north", &f.north)?,
        ]))
    }

    /// A path that must be there; `table` is where it is missed.
    fn picture_file(
        &self,
        key: &str,
        entry: &Entry,
        table: std::ops::Range<usize>,
    ) -> Result<String, RecipeError> {
        let Some(value) = entry else {
            return Err(self.refuse_at(key, table, "missing", FILE));
        };
        match value.get_ref().as_str() {
            Some(text) if !text.is_empty() => Ok(text.to_string()),
            _ => Err(self.refuse(key, value, FILE)),
        }
    }
}
