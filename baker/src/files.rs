//! The files that a recipe names.

use crate::settings::{ModelSource, Resolved, SkyboxPicture, SpriteSource};

impl Resolved {
    /// The files that the recipe names, as it names them: relative paths start from its folder.
    pub fn files(&self) -> Vec<&str> {
        let photo = self.clouds.photo.file.iter();
        let sprites: &[String] = match &self.sprites.source {
            SpriteSource::Noise(_) => &[],
            SpriteSource::Sheet(file) => std::slice::from_ref(file),
            SpriteSource::Cells(files) => files.as_slice(),
        };
        let skybox: &[String] = match self.skybox.as_ref().map(|skybox| &skybox.picture) {
            None => &[],
            Some(SkyboxPicture::Panorama { file, .. }) => std::slice::from_ref(file),
            Some(SkyboxPicture::Faces(files)) => files.as_slice(),
        };
        let models = self.field.iter().flat_map(|field| &field.models);
        let models = models.filter_map(|model| match &model.source {
            ModelSource::File(file) => Some(file),
            ModelSource::Boxes(_) => None,
        });
        let files = photo.chain(sprites).chain(skybox).chain(models);
        files.map(String::as_str).collect()
    }
}
