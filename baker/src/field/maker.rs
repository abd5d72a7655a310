//! Puts clouds into a field until the ground is covered as far as asked.
//!
//! Clouds come one after another, each over ground that is still free and far from those before. A cloud's rank is the share
//! of the ground that is below clouds when half of it is added: then showing the clouds whose rank is at most `c` covers the
//! share `c`, to half a cloud. Layers go on where the one before has ended.

use std::f32::consts::FRAC_PI_2;

use welkin_pack::Field;
use welkin_pack::field::Cloud;

use super::cloud::{self, Plan};
use super::ground::{Ground, SEEN};
use super::spread::Spread;
use super::{clumps, kinds, model};
use crate::error::BakeError;
use crate::inputs::{Named, Reader};
use crate::settings::{BoxSettings, CloudLayerSettings, FieldSettings, ModelSettings, ModelSource};
use crate::stream::Stream;

/// Cover that counts as full: the last gaps would each take a cloud of their own.
const FULL: f32 = 0.99;

/// A box of a sheet is needed where this share of what is below it is free.
const LEAST_FREE: f32 = 0.3;

/// Sprites of a piece of a sheet: as few as the article's clouds have.
const LEAST_SPRITES: usize = 5;

/// Sprites that it asks for at least, since the cull takes some.
const LEAST_ASKED: u32 = 12;

/// The files that the settings name, in their order.
pub(crate) fn files(settings: &FieldSettings) -> Vec<Named> {
    let models = settings.models.iter().enumerate();
    let named = |(index, model): (usize, &ModelSettings)| match &model.source {
        ModelSource::File(file) => Some(named(index, file)),
        ModelSource::Boxes(_) => None,
    };
    models.filter_map(named).collect()
}

fn named(index: usize, file: &str) -> Named {
    Named::new(
        format!("field.models[{index}].file"),
        file,
        model::MAX_BYTES,
    )
}

/// Makes the field.
///
/// Streams are named by the entry of the recipe and the number of the cloud, such as `field.clouds[0].12`.
///
/// # Errors
/// Those of reading a file; [`BakeError::Model`]; [`BakeError::Field`] if it would have more sprites than the settings allow, or more clouds or boxes
/// than a pack holds.
pub(crate) fn field(
    settings: &FieldSettings,
    reader: &Reader,
    seed: u64,
) -> Result<Field, BakeError> {
    let models = models(settings, reader)?;
    let ground = Ground::new(settings.sections);
    let mut maker = Maker {
        seed,
        most_sprites: settings.most_sprites as usize,
        spread: Spread::new(ground.side_m()),
        ground,
        clouds: Vec::new(),
        sprites: 0,
        boxes: 0,
    };
    for (index, (model, boxes)) in settings.models.iter().zip(&models).enumerate() {
        maker.add_copies(&format!("field.models[{index}]"), model, boxes)?;
    }
    for (index, layer) in settings.layers.iter().enumerate() {
        maker.add_layer(&format!("field.clouds[{index}]"), layer)?;
    }
    // Only a rank that the recipe gives can be out of order.
    maker.clouds.sort_by(|a, b| a.rank.total_cmp(&b.rank));
    let mut field = Field {
        sections: settings.sections,
        hours: settings.hours.clone(),
        clouds: maker.clouds,
    };
    field.expose();
    Ok(field)
}

/// The boxes of every model. All their sprites together are within the limit, before the cull.
fn models(settings: &FieldSettings, reader: &Reader) -> Result<Vec<Vec<BoxSettings>>, BakeError> {
    let mut models = Vec::with_capacity(settings.models.len());
    let mut sprites = 0;
    for (index, model) in settings.models.iter().enumerate() {
        let boxes = match &model.source {
            ModelSource::Boxes(boxes) => boxes.clone(),
            ModelSource::File(file) => {
                let read = reader.read(&named(index, file))?;
                model::boxes(&read.bytes, &read.file)?
            }
        };
        let a_copy: u32 = boxes.iter().map(|b| b.sprites).sum();
        sprites += a_copy as usize * model.copies as usize;
        if sprites > settings.most_sprites as usize {
            return Err(BakeError::Field {
                key: format!("field.models[{index}]"),
                what: "sprites",
                found: sprites,
                limit: settings.most_sprites as usize,
            });
        }
        models.push(boxes);
    }
    Ok(models)
}

/// Who asks for a cloud.
struct Order<'a> {
    /// The entry of the recipe.
    name: &'a str,
    rank: Option<f32>,
    /// Whether boxes that are not needed may be left out: not an artist's.
    is_piece: bool,
    /// Whether clumps are joined to shading groups: an artist's are as they are.
    joins_clumps: bool,
}

struct Maker {
    seed: u64,
    most_sprites: usize,
    ground: Ground,
    spread: Spread,
    clouds: Vec<Cloud>,
    sprites: usize,
    boxes: usize,
}

impl Maker {
    fn add_layer(&mut self, name: &str, layer: &CloudLayerSettings) -> Result<(), BakeError> {
        let mut places = Stream::new(self.seed, name);
        let order = Order {
            name,
            rank: None,
            is_piece: kinds::is_sheet(layer.kind),
            joins_clumps: true,
        };
        let mut number = 0;
        while self.ground.share() < layer.cover.min(FULL) {
            let stream = &mut Stream::new(self.seed, &format!("{name}.{number}"));
            let plan = Plan {
                kind: layer.kind,
                levels: layer.levels,
                boxes: &kinds::boxes(layer, stream),
            };
            self.add(&order, &plan, &mut places, stream)?;
            number += 1;
        }
        Ok(())
    }

    fn add_copies(
        &mut self,
        name: &str,
        model: &ModelSettings,
        boxes: &[BoxSettings],
    ) -> Result<(), BakeError> {
        let mut places = Stream::new(self.seed, name);
        let order = Order {
            name,
            rank: model.rank,
            is_piece: false,
            joins_clumps: false,
        };
        for number in 0..model.copies {
            let stream = &mut Stream::new(self.seed, &format!("{name}.{number}"));
            let turn = if model.copies == 1 {
                0
            } else {
                stream.bits() % 4
            };
            let boxes: Vec<BoxSettings> = boxes
                .iter()
                .map(|of_model| turned(of_model, turn, model))
                .collect();
            let plan = Plan {
                kind: model.kind,
                levels: model.levels,
                boxes: &boxes,
            };
            self.add(&order, &plan, &mut places, stream)?;
        }
        Ok(())
    }

    fn add(
        &mut self,
        order: &Order,
        plan: &Plan,
        places: &mut Stream,
        stream: &mut Stream,
    ) -> Result<(), BakeError> {
        let place = self.spread.next(&self.ground, reach_m(plan.boxes), places);
        let mut cloud = cloud::cloud(plan, stream);
        if order.is_piece {
            let boxes = &needed(plan.boxes, place, &self.ground);
            let piece = cloud::cloud(&Plan { boxes, ..*plan }, stream);
            // The cull may take what is needed; then it is the whole piece.
            if piece.sprites.len() >= LEAST_SPRITES {
                cloud = piece;
            }
        }
        if order.joins_clumps {
            clumps::join(&mut cloud);
        }
        self.count(order.name, &cloud)?;
        cloud::move_to(&mut cloud, place);
        let before = self.ground.share();
        self.ground.cover(&cloud);
        let rank = order.rank;
        cloud.rank = rank.unwrap_or(rounded(0.5 * (before + self.ground.share())));
        self.clouds.push(cloud);
        Ok(())
    }

    /// Counts a cloud, unless it is too much.
    fn count(&mut self, name: &str, cloud: &Cloud) -> Result<(), BakeError> {
        use welkin_pack::limits::{MAX_BOXES, MAX_CLOUDS};
        self.sprites += cloud.sprites.len();
        self.boxes += cloud.boxes.len();
        let counts = [
            ("sprites", self.sprites, self.most_sprites),
            ("boxes", self.boxes, MAX_BOXES),
            ("clouds", self.clouds.len() + 1, MAX_CLOUDS),
        ];
        for (what, found, limit) in counts {
            if found > limit {
                return Err(BakeError::Field {
                    key: name.to_string(),
                    what,
                    found,
                    limit,
                });
            }
        }
        Ok(())
    }
}

/// To a few places: there are some tens of thousands of cells of ground.
fn rounded(rank: f32) -> f32 {
    libm::roundf(rank * 1e5) / 1e5
}

/// How far boxes reach from the origin along the ground.
fn reach_m(boxes: &[BoxSettings]) -> f32 {
    let reach = |b: &BoxSettings, axis: usize| b.centre_m[axis].abs() + 0.5 * b.size_m[axis];
    let reaches = boxes.iter().map(|b| reach(b, 0).max(reach(b, 2)));
    reaches.fold(0.0, f32::max)
}

/// The boxes of a sheet that are over free ground, so that sprites do not lie on each other where pieces of it meet.
/// There are always enough of them for a cloud.
fn needed(boxes: &[BoxSettings], [x, z]: [f32; 2], ground: &Ground) -> Vec<BoxSettings> {
    let free = |b: &BoxSettings| {
        let sides = [0, 2].map(|axis| b.size_m[axis] + SEEN * b.width_m[1]);
        ground.free_share([x + b.centre_m[0], z + b.centre_m[2]], sides)
    };
    let mut order: Vec<(usize, f32)> = boxes.iter().map(free).enumerate().collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut sprites = 0;
    order.retain(|(index, free)| {
        let is_needed = *free >= LEAST_FREE || sprites < LEAST_ASKED;
        sprites += if is_needed { boxes[*index].sprites } else { 0 };
        is_needed
    });
    order.sort_by_key(|(index, _)| *index);
    order
        .iter()
        .map(|(index, _)| boxes[*index].clone())
        .collect()
}

/// A box of a model after quarter turns about the vertical axis, from its origin at the model's base above the sea. What lies flat
/// turns with it; what faces the viewer does so after any turn.
fn turned(of_model: &BoxSettings, quarters: u64, model: &ModelSettings) -> BoxSettings {
    let mut turned = of_model.clone();
    let quarter = |[x, y, z]: [f32; 3]| [z, y, 0.0 - x];
    for _ in 0..quarters {
        turned.centre_m = quarter(turned.centre_m);
        let [width, height, depth] = turned.size_m;
        turned.size_m = [depth, height, width];
        for sprite in &mut turned.by_hand {
            sprite.centre_m = quarter(sprite.centre_m);
            if model.kind.is_flat() {
                sprite.rotation_rad += FRAC_PI_2;
            }
        }
    }
    turned.centre_m[1] += model.base_m;
    for sprite in &mut turned.by_hand {
        sprite.centre_m[1] += model.base_m;
    }
    turned
}
