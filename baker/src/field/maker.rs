//! Puts clouds into a field until the ground is covered as far as asked.
//!
//! Clouds come one after another, each over ground that is still free and far from those before. A cloud's rank is the share
//! of the ground that is below clouds when half of it is added: then showing the clouds whose rank is at most `c` covers the
//! share `c`, to half a cloud. Layers go on where the one before has ended.

use welkin_pack::Field;
use welkin_pack::field::Cloud;

use super::cloud::{self, Plan};
use super::ground::Ground;
use super::kinds;
use super::spread::Spread;
use crate::error::BakeError;
use crate::settings::{BoxSettings, CloudLayerSettings, FieldSettings, ModelSettings};
use crate::stream::Stream;

/// Cover that counts as full: the last gaps would each take a cloud of their own.
const FULL: f32 = 0.995;

/// Makes the field. `models` has the boxes of each model of the settings.
///
/// Streams are named by the entry of the recipe and the number of the cloud, such as `field.clouds.0.12`.
///
/// # Errors
/// [`BakeError::Field`] if it would have more sprites than the settings allow, or more clouds or boxes than a pack holds.
pub(crate) fn field(
    settings: &FieldSettings,
    models: &[Vec<BoxSettings>],
    seed: u64,
) -> Result<Field, BakeError> {
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
    for (index, (model, boxes)) in settings.models.iter().zip(models).enumerate() {
        maker.add_copies(&format!("field.models.{index}"), model, boxes)?;
    }
    for (index, layer) in settings.layers.iter().enumerate() {
        maker.add_layer(&format!("field.clouds.{index}"), layer)?;
    }
    // Only a rank that the recipe gives can be out of order.
    maker.clouds.sort_by(|a, b| a.rank.total_cmp(&b.rank));
    Ok(Field {
        sections: settings.sections,
        hours: settings.hours.clone(),
        clouds: maker.clouds,
    })
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
        let mut number = 0;
        while self.ground.share() < layer.cover.min(FULL) {
            let stream = &mut Stream::new(self.seed, &format!("{name}.{number}"));
            let plan = Plan {
                kind: layer.kind,
                levels: layer.levels,
                boxes: &kinds::boxes(layer, stream),
            };
            self.add(name, &plan, None, &mut places, stream)?;
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
        for number in 0..model.copies {
            let stream = &mut Stream::new(self.seed, &format!("{name}.{number}"));
            let turn = if model.copies == 1 {
                0
            } else {
                stream.bits() % 4
            };
            let boxes: Vec<BoxSettings> = boxes
                .iter()
                .map(|of_model| turned(of_model, turn, model.base_m))
                .collect();
            let plan = Plan {
                kind: model.kind,
                levels: model.levels,
                boxes: &boxes,
            };
            self.add(name, &plan, model.rank, &mut places, stream)?;
        }
        Ok(())
    }

    fn add(
        &mut self,
        name: &str,
        plan: &Plan,
        rank: Option<f32>,
        places: &mut Stream,
        stream: &mut Stream,
    ) -> Result<(), BakeError> {
        let mut cloud = cloud::cloud(plan, stream);
        self.count(name, &cloud)?;
        let place = self.spread.next(&self.ground.free(), places);
        cloud::move_to(&mut cloud, place);
        let before = self.ground.share();
        self.ground.cover(&cloud);
        cloud.rank = rank.unwrap_or(0.5 * (before + self.ground.share()));
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
                    limit,
                });
            }
        }
        Ok(())
    }
}

/// A box of a model after quarter turns about the vertical axis, from its origin at `base_m` above the sea.
fn turned(of_model: &BoxSettings, quarters: u64, base_m: f32) -> BoxSettings {
    let mut turned = of_model.clone();
    for _ in 0..quarters {
        let ([x, y, z], [width, height, depth]) = (turned.centre_m, turned.size_m);
        turned.centre_m = [z, y, 0.0 - x];
        turned.size_m = [depth, height, width];
    }
    turned.centre_m[1] += base_m;
    turned
}
