//! `[[field.models.boxes]]`.

use std::f32::consts::PI;
use std::ops::Range;

use welkin_pack::field::Category;

use crate::error::RecipeError;
use crate::field::boxes::{
    self, CULL, Fault, GROUPS, PLACES_M, ROTATIONS_DEG, SIZES_M, SPRITE_SIZES_M, SPRITES,
};
use crate::recipe::Recipe;
use crate::recipe::tables::{BoxTable, Entry};
use crate::settings::BoxSettings;

impl Recipe {
    pub(super) fn cloud_box(
        &self,
        key: &str,
        table: &BoxTable,
        span: Range<usize>,
    ) -> Result<BoxSettings, RecipeError> {
        let name = |name: &str| format!("{key}.{name}");
        let default = boxes::default_box();
        for (key, entry) in [("centre_m", &table.centre_m), ("size_m", &table.size_m)] {
            self.needed(&name(key), entry, span.clone(), "a list of 3 numbers")?;
        }
        let [least, most] = SPRITES;
        let (width, height) = (&table.width_m, &table.height_m);
        let degrees = self.span(
            &name("rotation_deg"),
            &table.rotation_deg,
            ROTATIONS_DEG,
            ROTATIONS_DEG,
        )?;
        let found = BoxSettings {
            centre_m: self.reals(&name("centre_m"), &table.centre_m, [0.0; 3], PLACES_M)?,
            size_m: self.reals(&name("size_m"), &table.size_m, [0.0; 3], SIZES_M)?,
            sprites: self.integer(
                &name("sprites"),
                &table.sprites,
                default.sprites,
                least,
                most,
            )?,
            width_m: self.span(&name("width_m"), width, default.width_m, SPRITE_SIZES_M)?,
            height_m: self.span(&name("height_m"), height, default.height_m, SPRITE_SIZES_M)?,
            category: self.category(&name("category"), &table.category, default.category)?,
            rotation_rad: degrees.map(|angle| angle * (PI / 180.0)),
            group: self.integer(&name("group"), &table.group, 0, 0, GROUPS)?,
            flat_bottom: self.flag(&name("flat_bottom"), &table.flat_bottom)?,
            cull: self.real(&name("cull"), &table.cull, default.cull, CULL[0], CULL[1])?,
            by_hand: Vec::new(),
        };
        boxes::verify(&found).map_err(
            |Fault {
                 key: of_box,
                 found,
                 expected,
             }| { self.refuse_at(&name(of_box), span, found, expected) },
        )?;
        Ok(found)
    }

    fn category(
        &self,
        key: &str,
        entry: &Entry,
        default: Category,
    ) -> Result<Category, RecipeError> {
        let Some(value) = entry else {
            return Ok(default);
        };
        let names = Category::ALL.map(Category::name);
        self.choice(key, entry, value.span(), &names, Category::from_name)
    }

    fn flag(&self, key: &str, entry: &Entry) -> Result<bool, RecipeError> {
        let Some(value) = entry else { return Ok(false) };
        let found = value.get_ref().as_bool();
        found.ok_or_else(|| self.refuse(key, value, "true or false"))
    }
}
