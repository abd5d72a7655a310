//! Custom properties of a node.

use std::f32::consts::PI;

use serde_json::value::RawValue;
use serde_json::{Map, Value};
use welkin_pack::SheetCell;
use welkin_pack::field::Category;

use crate::error::BakeError;
use crate::field::boxes::{CULL, GROUPS, ROTATIONS_DEG, SPRITE_SIZES_M, SPRITES, default_box};
use crate::settings::BoxSettings;

/// Makes an error from a key, what was found and what was expected.
type Unfit<'a> = dyn Fn(&str, String, String) -> BakeError + 'a;

const KEYS: [&str; 8] = [
    "sprites",
    "width_m",
    "height_m",
    "category",
    "rotation_deg",
    "group",
    "flat_bottom",
    "cull",
];

/// The properties of a sprite that is placed by hand.
const SPRITE_KEYS: [&str; 2] = ["cell", "group"];

/// Picture and shading group of a node that is a sprite: of one with the property `cell`.
pub(super) fn sprite(
    extras: Option<&RawValue>,
    unfit: &Unfit,
) -> Result<Option<(u8, u32)>, BakeError> {
    let map = extras.and_then(|e| serde_json::from_str::<Map<String, Value>>(e.get()).ok());
    let Some(map) = map.filter(|map| map.contains_key("cell")) else {
        return Ok(None);
    };
    refuse_others(&map, &SPRITE_KEYS, unfit)?;
    let extras = Extras { map, unfit };
    let cell = extras.whole("cell", 0, [0, u32::from(SheetCell::COUNT) - 1])?;
    let group = extras.whole("group", 0, [0, GROUPS])?;
    Ok(Some((cell as u8, group)))
}

/// So that none is misspelt.
fn refuse_others(map: &Map<String, Value>, keys: &[&str], unfit: &Unfit) -> Result<(), BakeError> {
    let other = map.keys().find(|key| !keys.contains(&key.as_str()));
    other.map_or(Ok(()), |key| {
        let (found, expected) = (format!("with a property `{key}`"), keys.join(", "));
        Err(unfit("extras", found, format!("none but {expected}")))
    })
}

/// What the properties say, and the defaults where they say nothing. Middle and size are left for the caller.
pub(super) fn read(extras: Option<&RawValue>, unfit: &Unfit) -> Result<BoxSettings, BakeError> {
    let default = default_box();
    let Some(extras) = extras else {
        return Ok(default);
    };
    let parsed = serde_json::from_str::<Map<String, Value>>(extras.get());
    let map = parsed.map_err(|e| unfit("extras", e.to_string(), "an object".to_string()))?;
    refuse_others(&map, &KEYS, unfit)?;
    let extras = Extras { map, unfit };
    let [least, most] = SPRITES;
    let rotation = extras.span("rotation_deg", ROTATIONS_DEG, ROTATIONS_DEG)?;
    Ok(BoxSettings {
        sprites: extras.whole("sprites", default.sprites, [least, most])?,
        width_m: extras.span("width_m", default.width_m, SPRITE_SIZES_M)?,
        height_m: extras.span("height_m", default.height_m, SPRITE_SIZES_M)?,
        category: extras.category(default.category)?,
        rotation_rad: rotation.map(|angle| angle * (PI / 180.0)),
        group: extras.whole("group", default.group, [0, GROUPS])?,
        flat_bottom: extras.flag("flat_bottom")?,
        cull: extras.real("cull", default.cull, CULL)?,
        ..default
    })
}

struct Extras<'a> {
    map: Map<String, Value>,
    unfit: &'a Unfit<'a>,
}

impl Extras<'_> {
    fn refuse(&self, key: &str, expected: String) -> BakeError {
        let found = self.map.get(key).map_or(String::new(), Value::to_string);
        (self.unfit)(key, found.chars().take(60).collect(), expected)
    }

    fn real(&self, key: &str, default: f32, [min, max]: [f32; 2]) -> Result<f32, BakeError> {
        let Some(value) = self.map.get(key) else {
            return Ok(default);
        };
        let found = number(value).filter(|n| (min..=max).contains(n));
        found.ok_or_else(|| self.refuse(key, format!("a number from {min} to {max}")))
    }

    /// A tool that knows only one kind of number may write 12.0 for 12.
    fn whole(&self, key: &str, default: u32, [min, max]: [u32; 2]) -> Result<u32, BakeError> {
        let Some(value) = self.map.get(key) else {
            return Ok(default);
        };
        let found = value.as_f64().filter(|n| *n == n.trunc());
        let found = found.filter(|n| (f64::from(min)..=f64::from(max)).contains(n));
        let found = found.map(|n| n as u32);
        found.ok_or_else(|| self.refuse(key, format!("an integer from {min} to {max}")))
    }

    fn span(
        &self,
        key: &str,
        default: [f32; 2],
        [min, max]: [f32; 2],
    ) -> Result<[f32; 2], BakeError> {
        let Some(value) = self.map.get(key) else {
            return Ok(default);
        };
        let list = value.as_array().map(Vec::as_slice).unwrap_or_default();
        let found = match list {
            [least, most] => number(least).zip(number(most)),
            _ => None,
        };
        let in_range = |n: f32| (min..=max).contains(&n);
        match found {
            Some((least, most)) if in_range(least) && in_range(most) && least <= most => {
                Ok([least, most])
            }
            _ => {
                let expected = format!("two numbers from {min} to {max}, the least first");
                Err(self.refuse(key, expected))
            }
        }
    }

    fn category(&self, default: Category) -> Result<Category, BakeError> {
        let Some(value) = self.map.get("category") else {
            return Ok(default);
        };
        let found = value.as_str().and_then(Category::from_name);
        found.ok_or_else(|| {
            let names = Category::ALL.map(Category::name).join("\", \"");
            self.refuse("category", format!("one of \"{names}\""))
        })
    }

    /// Some tools have no other truth than 0 and 1.
    fn flag(&self, key: &str) -> Result<bool, BakeError> {
        match self.map.get(key) {
            None => Ok(false),
            Some(Value::Bool(flag)) => Ok(*flag),
            Some(Value::Number(n)) if n.as_u64().is_some_and(|n| n < 2) => {
                Ok(n.as_u64() == Some(1))
            }
            Some(_) => Err(self.refuse(key, "true or false".to_string())),
        }
    }
}

fn number(value: &Value) -> Option<f32> {
    let number = value.as_f64()? as f32;
    number.is_finite().then_some(number)
}
