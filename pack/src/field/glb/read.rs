//! Reads the file: instances and extras become a field again.

use super::accessor::Instances;
use super::container;
use super::document::{BOXES, CloudExtras, Document, FieldExtras, HourExtras, INSTANCING, SPRITES};
use super::rotation::rotation;
use crate::error::PackError;
use crate::field::{
    Category, Cloud, CloudBox, CloudKind, ColourLevel, Exposure, Field, Hour, Sprite, bounds,
};
use crate::limits::{MAX_CLOUDS, MAX_GROUPS, MAX_HOURS};

/// Decodes the bytes of a file. What the numbers mean is not looked at here: see [`Field::verify`].
///
/// # Errors
/// [`PackError`] if it is not a file as docs/pack-format.md describes it. Counts are compared with
/// [`crate::limits`] and with the length of the file before anything is allocated for them.
pub(crate) fn decode(file: &str, bytes: &[u8]) -> Result<Field, PackError> {
    let (json, bin) = container::split(file, bytes)?;
    let mut document: Document = serde_json::from_slice(json).map_err(|e| {
        PackError::value(
            file,
            "JSON",
            e,
            "a field as docs/pack-format.md describes it",
        )
    })?;
    let bin = verify_gltf(file, &document, bin)?;
    let scene = document.scene;
    let scene = document.scenes.get_mut(scene);
    let Some(extras) = scene.and_then(|scene| scene.extras.take()) else {
        let expected = "`extras` with `welkin_field`";
        return Err(PackError::value(file, "scene", "without", expected));
    };
    let extras = extras.welkin_field;
    at_most(file, "clouds", extras.clouds.len(), MAX_CLOUDS)?;
    at_most(file, "hours", extras.hours.len(), MAX_HOURS)?;
    let clouds = extras.clouds.iter().enumerate();
    let clouds: Result<Vec<Cloud>, PackError> = clouds
        .map(|(index, cloud)| cloud_of(file, index, cloud, &extras))
        .collect();
    let mut clouds = clouds?;
    add_boxes(
        file,
        &Instances::of(file, BOXES, &document, bin)?,
        &mut clouds,
    )?;
    add_sprites(
        file,
        &Instances::of(file, SPRITES, &document, bin)?,
        &mut clouds,
    )?;
    for cloud in &mut clouds {
        (cloud.centre_m, cloud.size_m) = bounds(&cloud.boxes);
    }
    Ok(Field {
        sections: extras.sections,
        hours: extras.hours.iter().map(hour).collect(),
        clouds,
    })
}

/// What glTF asks of any file of this kind: a version and extensions that this reader knows, and one buffer, which is in the
/// file. Gives its bytes.
fn verify_gltf<'a>(file: &str, document: &Document, bin: &'a [u8]) -> Result<&'a [u8], PackError> {
    let bad = |key: &str, found: String, expected: &str| {
        Err(PackError::value(file, key, found, expected))
    };
    let asset = &document.asset;
    let minor = asset.version.strip_prefix("2.");
    if minor.is_none_or(|minor| minor.parse::<u32>().is_err()) {
        return bad("asset.version", asset.version.clone(), "2.0");
    }
    if let Some(least) = asset.min_version.as_ref().filter(|least| *least != "2.0") {
        return bad("asset.minVersion", least.clone(), "2.0");
    }
    if !document
        .extensions_used
        .iter()
        .any(|name| name == INSTANCING)
    {
        let found = document.extensions_used.join(", ");
        return bad("extensionsUsed", found, INSTANCING);
    }
    let unknown = |name: &&String| *name != INSTANCING;
    if let Some(name) = document.extensions_required.iter().find(unknown) {
        return bad("extensionsRequired", name.clone(), INSTANCING);
    }
    let [buffer] = &document.buffers[..] else {
        let found = format!("{} of them", document.buffers.len());
        return bad("buffers", found, "one");
    };
    if buffer.uri.is_some() {
        return bad("buffers[0]", "with a uri".into(), "the bytes of this file");
    }
    // The chunk is filled up to a multiple of four.
    let bytes = usize::try_from(buffer.byte_length).ok();
    let bytes = bytes.and_then(|length| bin.split_at_checked(length));
    match bytes {
        Some((bytes, padding)) if padding.len() < 4 && padding.iter().all(|b| *b == 0) => Ok(bytes),
        _ => {
            let expected = format!("the {} bytes of the chunk", bin.len());
            bad(
                "buffers[0].byteLength",
                buffer.byte_length.to_string(),
                &expected,
            )
        }
    }
}

fn at_most(file: &str, key: &str, found: usize, limit: usize) -> Result<(), PackError> {
    if found <= limit {
        return Ok(());
    }
    Err(PackError::TooLarge {
        file: file.to_string(),
        key: format!("count of {key}"),
        found: found as u64,
        limit: limit as u64,
    })
}

/// A cloud without its boxes and sprites.
fn cloud_of(
    file: &str,
    index: usize,
    cloud: &CloudExtras,
    extras: &FieldExtras,
) -> Result<Cloud, PackError> {
    let key = |name: &str| format!("clouds[{index}].{name}");
    let Some(kind) = CloudKind::from_name(&cloud.kind) else {
        let expected = CloudKind::ALL.map(CloudKind::name).join(", ");
        let expected = format!("one of {expected}");
        return Err(PackError::value(file, &key("kind"), &cloud.kind, expected));
    };
    let Some(levels) = extras.levels.get(cloud.levels) else {
        let expected = format!("below {}", extras.levels.len());
        return Err(PackError::value(
            file,
            &key("levels"),
            cloud.levels,
            expected,
        ));
    };
    at_most(file, &key("groups"), cloud.groups.len(), MAX_GROUPS)?;
    let level = |[height, red, green, blue, alpha]: [f32; 5]| ColourLevel {
        height,
        rgba: [red, green, blue, alpha],
    };
    Ok(Cloud {
        kind,
        rank: cloud.rank,
        centre_m: [0.0; 3],
        size_m: [0.0; 3],
        levels: levels.map(level),
        groups_m: cloud.groups.clone(),
        boxes: Vec::new(),
        sprites: Vec::new(),
    })
}

fn hour(hour: &HourExtras) -> Hour {
    Hour {
        time: hour.time,
        ambient: hour.ambient,
        colour: hour.colour,
        least: hour.least,
        most: hour.most,
    }
}

fn add_boxes(file: &str, boxes: &Instances, clouds: &mut [Cloud]) -> Result<(), PackError> {
    let centres = boxes.vectors("TRANSLATION")?;
    let sizes = boxes.vectors("SCALE")?;
    let culls = boxes.floats("_CULL")?;
    let categories = boxes.numbers("_CATEGORY")?;
    let groups = boxes.numbers("_GROUP")?;
    let owners = boxes.numbers("_CLOUD")?;
    for i in 0..boxes.count {
        let category = Category::ALL.get(usize::from(categories[i]));
        let Some(&category) = category else {
            let expected = format!("below {}", Category::ALL.len());
            return Err(PackError::value(
                file,
                "boxes._CATEGORY",
                categories[i],
                expected,
            ));
        };
        let cloud = owner(file, "boxes._CLOUD", clouds, owners[i])?;
        cloud.boxes.push(CloudBox {
            centre_m: centres[i],
            size_m: sizes[i],
            category,
            group: groups[i],
            cull_m: culls[i],
        });
    }
    Ok(())
}

fn add_sprites(file: &str, sprites: &Instances, clouds: &mut [Cloud]) -> Result<(), PackError> {
    let centres = sprites.vectors("TRANSLATION")?;
    let sizes = sprites.vectors("SCALE")?;
    let rotations = sprites.quaternions("ROTATION")?;
    let cells = sprites.numbers("_CELL")?;
    let groups = sprites.numbers("_GROUP")?;
    let owners = sprites.numbers("_CLOUD")?;
    let boxes = sprites.numbers("_BOX")?;
    let sun = sprites.bytes("_SUN")?;
    let sky = sprites.bytes("_SKY")?;
    for i in 0..sprites.count {
        let bad = |name: &str, found: String, expected: &str| {
            Err(PackError::value(
                file,
                &format!("sprites.{name}"),
                found,
                expected,
            ))
        };
        let cloud = owner(file, "sprites._CLOUD", clouds, owners[i])?;
        let Ok(cell) = u8::try_from(cells[i]) else {
            return bad("_CELL", cells[i].to_string(), "a cell of the sheet");
        };
        let Some(rotation_rad) = rotation(rotations[i], cloud.kind.is_flat()) else {
            let found = format!("{:?}", rotations[i]);
            return bad(
                "ROTATION",
                found,
                "a 4096th of a turn, as docs/pack-format.md says",
            );
        };
        let [width, height, depth] = sizes[i];
        if depth != 1.0 {
            return bad("SCALE", format!("{depth} in z"), "1: sprites are flat");
        }
        // A box that is not there is told by `Field::verify`.
        let of_box = cloud.boxes.get(usize::from(boxes[i]));
        if of_box.is_some_and(|of_box| of_box.group != groups[i]) {
            return bad("_GROUP", groups[i].to_string(), "the group of its box");
        }
        cloud.sprites.push(Sprite {
            centre_m: centres[i],
            size_m: [width, height],
            rotation_rad,
            cell,
            cloud_box: boxes[i],
            exposure: Exposure {
                sides: sun[i],
                above: sky[i][0],
                sky: sky[i][1],
                halvings: sky[i][2],
            },
        });
    }
    Ok(())
}

fn owner<'a>(
    file: &str,
    key: &str,
    clouds: &'a mut [Cloud],
    index: u16,
) -> Result<&'a mut Cloud, PackError> {
    let expected = format!("below {}", clouds.len());
    let cloud = clouds.get_mut(usize::from(index));
    cloud.ok_or_else(|| PackError::value(file, key, index, expected))
}
