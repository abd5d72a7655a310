//! The files that a recipe names.

use crate::settings::{CatalogueSource, ModelSource, Resolved, SkyboxPicture, SpriteSource};

impl Resolved {
    /// The files that the recipe names, as it names them: relative paths start from its folder.
    pub fn files(&self) -> Vec<&str> {
        let photo = &self.clouds.photo;
        let photo = photo.file.iter().chain(&photo.mask);
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
        let catalogue = match &self.stars.catalogue {
            Some(CatalogueSource::File(file)) => Some(file),
            Some(CatalogueSource::BuiltIn) | None => None,
        };
        let photo = photo.chain(catalogue);
        let files = photo.chain(sprites).chain(skybox).chain(models);
        files.map(String::as_str).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::{DEFAULT_RECIPE, Recipe};

    fn files(text: &str) -> Vec<String> {
        let resolved = Recipe::parse("r", text).unwrap().resolve(None).unwrap();
        resolved.files().into_iter().map(String::from).collect()
    }

    #[test]
    fn every_file_of_a_recipe_is_listed() {
        assert!(files(DEFAULT_RECIPE).is_empty());
        let text = "[clouds.photo]\nfile = 'p.png'\n[sprites]\nfile = 's.png'\n[skybox]\nfile = 'b.exr'\n\
             [[field.models]]\nkind = 'congestus'\nfile = 'm.glb'\n";
        assert_eq!(files(text), ["p.png", "s.png", "b.exr", "m.glb"]);
        assert_eq!(files("[stars]\ncatalogue = 's.csv'\n"), ["s.csv"]);
        assert!(files("[stars]\ncatalogue = 'built-in'\n").is_empty());
        let faces = "[skybox.faces]\neast = '1'\nwest = '2'\nup = '3'\ndown = '4'\nsouth = '5'\nnorth = '6'\n";
        assert_eq!(files(faces), ["1", "2", "3", "4", "5", "6"]);
        let cells: Vec<String> = (0..16).map(|cell| format!("{cell}.png")).collect();
        let text = format!("[sprites]\npictures = {cells:?}\n");
        assert_eq!(files(&text), cells);
    }
}
