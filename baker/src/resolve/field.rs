//! The table `[field]`.

mod boxes;
mod values;

use std::ops::Range;

use toml::Spanned;
use welkin_pack::field::{CloudKind, Hour};
use welkin_pack::limits::{MAX_HOURS, MAX_SECTIONS, MAX_SPRITES};

use crate::error::RecipeError;
use crate::field::{kinds, light};
use crate::recipe::Recipe;
use crate::recipe::tables::{CloudLayer, Entry, FieldTable, HourTable, Model};
use crate::settings::{CloudLayerSettings, FieldSettings, ModelSettings, ModelSource};

/// The most that a list of a recipe may have: layers, models, boxes of a model.
const MAX_ENTRIES: usize = 256;

/// Heights above the sea: clouds end at the tropopause, which is at 18 km at most.
const HEIGHTS_M: [f32; 2] = [0.0, 20_000.0];

/// Between the base and the top of a layer.
const LEAST_DEPTH_M: f32 = 50.0;

impl Recipe {
    pub(super) fn field(&self) -> Result<Option<FieldSettings>, RecipeError> {
        let nothing = FieldTable::default();
        let f = self.tables.field.as_ref();
        let f = f.map_or(&nothing, Spanned::get_ref);
        let sections = self.integer("field.sections", &f.sections, 3, 0, MAX_SECTIONS)?;
        let most = MAX_SPRITES as u32;
        let settings = FieldSettings {
            sections,
            most_sprites: self.integer("field.most_sprites", &f.most_sprites, 16_384, 1, most)?,
            models: self.each("field.models", f.models.as_deref(), Recipe::model)?,
            layers: match &f.clouds {
                None if f.models.is_none() => light::default_layers(),
                clouds => self.each("field.clouds", clouds.as_deref(), Recipe::cloud_layer)?,
            },
            hours: self.hours(f.hours.as_deref())?,
        };
        if sections > 0 && settings.models.is_empty() && settings.layers.is_empty() {
            let expected = "`[[field.clouds]]` or `[[field.models]]`, or `sections = 0` to leave the field out";
            let span = self.field_span();
            return Err(self.refuse_at("field", span, "without a cloud", expected));
        }
        // A field has a cloud at least.
        let covers_nothing =
            settings.models.is_empty() && settings.layers.iter().all(|l| l.cover == 0.0);
        let first = f.clouds.as_deref().and_then(<[_]>::first);
        if let Some(cover) = first.and_then(|layer| layer.get_ref().cover.as_ref())
            && sections > 0
            && covers_nothing
        {
            let expected =
                "over 0, up to 1, in one layer at least, or `sections = 0` to leave the field out";
            return Err(self.refuse("field.clouds[0].cover", cover, expected));
        }
        // Many clouds of one rank come all at once, which the rule `field-spread` refuses.
        let ranks: Vec<_> = settings.models.iter().map(|model| model.rank).collect();
        let copies: u32 = settings.models.iter().map(|model| model.copies).sum();
        let are_alike = ranks.windows(2).all(|pair| pair[0] == pair[1]);
        if let Some(Some(rank)) = ranks.first()
            && sections > 0
            && settings.layers.iter().all(|layer| layer.cover == 0.0)
            && are_alike
            && copies >= 20
        {
            let expected = "ranks that differ, for twenty copies and more in all, or none: then they come one after another";
            let span = self.field_span();
            return Err(self.refuse_at("field.models[0].rank", span, rank, expected));
        }
        Ok((sections > 0).then_some(settings))
    }

    /// Where the table is.
    fn field_span(&self) -> Range<usize> {
        let table = self.tables.field.as_ref();
        table.map_or(0..0, Spanned::span)
    }

    /// Resolves a list of tables.
    fn each<T, R>(
        &self,
        key: &str,
        entries: Option<&[Spanned<T>]>,
        resolve: impl Fn(&Recipe, &str, &T, Range<usize>) -> Result<R, RecipeError>,
    ) -> Result<Vec<R>, RecipeError> {
        let entries = entries.unwrap_or_default();
        if let Some(entry) = entries.get(MAX_ENTRIES) {
            let expected = format!("at most {MAX_ENTRIES}");
            return Err(self.refuse_at(key, entry.span(), entries.len(), expected));
        }
        let entries = entries.iter().enumerate();
        entries
            .map(|(i, e)| resolve(self, &format!("{key}[{i}]"), e.get_ref(), e.span()))
            .collect()
    }

    fn cloud_layer(
        &self,
        key: &str,
        layer: &CloudLayer,
        table: Range<usize>,
    ) -> Result<CloudLayerSettings, RecipeError> {
        let name = |name: &str| format!("{key}.{name}");
        let kind = self.kind(&name("kind"), &layer.kind, table)?;
        let [base_m, top_m] = kinds::heights_m(kind);
        let base_m = self.height(&name("base_m"), &layer.base_m, base_m)?;
        let least = base_m + LEAST_DEPTH_M;
        let [_, most] = HEIGHTS_M;
        let top_m = top_m.max(least).min(most + LEAST_DEPTH_M);
        Ok(CloudLayerSettings {
            kind,
            cover: self.real(&name("cover"), &layer.cover, 0.5, 0.0, 1.0)?,
            base_m,
            top_m: self.real(
                &name("top_m"),
                &layer.top_m,
                top_m,
                least,
                most + LEAST_DEPTH_M,
            )?,
            density: self.real(&name("density"), &layer.density, 1.0, 0.25, 4.0)?,
            cull: self.real(&name("cull"), &layer.cull, 1.0 / 3.0, 0.05, 1.0)?,
            levels: self.levels(&name("levels"), &layer.levels, kind)?,
        })
    }

    fn model(
        &self,
        key: &str,
        model: &Model,
        table: Range<usize>,
    ) -> Result<ModelSettings, RecipeError> {
        let name = |name: &str| format!("{key}.{name}");
        let kind = self.kind(&name("kind"), &model.kind, table.clone())?;
        let [base_m, _] = kinds::heights_m(kind);
        let rank = model.rank.as_ref();
        let rank = rank.map(|_| self.real(&name("rank"), &model.rank, 0.0, 0.0, 1.0));
        Ok(ModelSettings {
            kind,
            source: self.model_source(key, model, table)?,
            copies: self.integer(&name("copies"), &model.copies, 1, 1, 256)?,
            base_m: self.height(&name("base_m"), &model.base_m, base_m)?,
            rank: rank.transpose()?,
            levels: self.levels(&name("levels"), &model.levels, kind)?,
        })
    }

    fn model_source(
        &self,
        key: &str,
        model: &Model,
        table: Range<usize>,
    ) -> Result<ModelSource, RecipeError> {
        match (&model.file, &model.boxes) {
            (Some(value), None) => match value.get_ref().as_str() {
                Some(file) if !file.is_empty() => Ok(ModelSource::File(file.to_string())),
                _ => {
                    let expected = "the path of a glTF file, as text";
                    Err(self.refuse(&format!("{key}.file"), value, expected))
                }
            },
            (None, Some(boxes)) if !boxes.is_empty() => {
                let key = format!("{key}.boxes");
                let boxes = self.each(&key, Some(boxes), Recipe::cloud_box)?;
                Ok(ModelSource::Boxes(boxes))
            }
            (file, boxes) => {
                let found = if file.is_some() && boxes.is_some() {
                    "given both `file` and `boxes`"
                } else {
                    "without boxes"
                };
                let expected = "either `file`, a glTF model, or `boxes`";
                Err(self.refuse_at(key, table, found, expected))
            }
        }
    }

    fn height(&self, key: &str, entry: &Entry, default: f32) -> Result<f32, RecipeError> {
        let [least, most] = HEIGHTS_M;
        self.real(key, entry, default, least, most)
    }

    fn kind(
        &self,
        key: &str,
        entry: &Entry,
        table: Range<usize>,
    ) -> Result<CloudKind, RecipeError> {
        let names = CloudKind::ALL.map(CloudKind::name);
        self.choice(key, entry, table, &names, CloudKind::from_name)
    }

    fn hours(&self, entries: Option<&[Spanned<HourTable>]>) -> Result<Vec<Hour>, RecipeError> {
        let Some(entries) = entries else {
            return Ok(light::default_hours());
        };
        let hours = self.each("field.hours", Some(entries), Recipe::hour)?;
        if let Some(entry) = entries.get(MAX_HOURS) {
            let expected = format!("at most {MAX_HOURS}");
            return Err(self.refuse_at("field.hours", entry.span(), entries.len(), expected));
        }
        let Some(first) = entries.first() else {
            let span = self.field_span();
            return Err(self.refuse_at("field.hours", span, "empty", "one hour or more"));
        };
        for (index, pair) in hours.windows(2).enumerate() {
            if pair[1].time <= pair[0].time {
                let key = format!("field.hours[{}].time", index + 1);
                let span = entries.get(index + 1).unwrap_or(first).span();
                let expected = format!("over {}: the hours in the order of time", pair[0].time);
                return Err(self.refuse_at(&key, span, pair[1].time, expected));
            }
        }
        let brightest = hours.iter().map(Hour::light).fold(0.0, f32::max);
        if brightest < Hour::LEAST_LIGHT {
            let expected = format!(
                "an hour with {} of `ambient` and `colour` together, or the clouds are always dark",
                Hour::LEAST_LIGHT
            );
            return Err(self.refuse_at("field.hours", first.span(), brightest, expected));
        }
        Ok(hours)
    }

    fn hour(&self, key: &str, hour: &HourTable, table: Range<usize>) -> Result<Hour, RecipeError> {
        let name = |name: &str| format!("{key}.{name}");
        self.needed(
            &name("time"),
            &hour.time,
            table.clone(),
            "a time of day, 0 to 0.999999",
        )?;
        self.needed(&name("colour"), &hour.colour, table, "red, green and blue")?;
        let least = self.real(&name("least"), &hour.least, 0.1, 0.0, 1.0)?;
        Ok(Hour {
            time: self.real(&name("time"), &hour.time, 0.0, 0.0, 0.999_999)?,
            ambient: self.real(&name("ambient"), &hour.ambient, 1.0, 0.0, 1.0)?,
            colour: self.reals(&name("colour"), &hour.colour, [0.0; 3], [0.0, 16.0])?,
            least,
            most: self.real(&name("most"), &hour.most, 1.0, least, 1.0)?,
        })
    }
}
