//! The field of clouds: how many of each kind.

use std::fmt::Write;

use serde_json::{Value, json};
use welkin_pack::field::{Cloud, CloudKind};
use welkin_pack::{Field, Pack, shown};

/// The clouds of one kind.
struct Kind<'a> {
    name: &'static str,
    clouds: Vec<&'a Cloud>,
}

impl Kind<'_> {
    fn boxes(&self) -> usize {
        self.clouds.iter().map(|cloud| cloud.boxes.len()).sum()
    }

    fn sprites(&self) -> usize {
        self.clouds.iter().map(|cloud| cloud.sprites.len()).sum()
    }

    /// Ranks of the first and of the last.
    fn ranks(&self) -> [f32; 2] {
        let rank = |cloud: Option<&&Cloud>| cloud.map_or(0.0, |cloud| cloud.rank);
        [rank(self.clouds.first()), rank(self.clouds.last())]
    }
}

/// The kinds that a field has.
fn kinds(field: &Field) -> impl Iterator<Item = Kind<'_>> {
    let kinds = CloudKind::ALL.into_iter().map(|kind| Kind {
        name: kind.name(),
        clouds: field.clouds.iter().filter(|c| c.kind == kind).collect(),
    });
    kinds.filter(|kind| !kind.clouds.is_empty())
}

/// What `--json` prints; null for a pack without a field.
pub(super) fn json(pack: &Pack) -> Value {
    let (Some(field), Some(entry)) = (pack.field(), &pack.manifest().field) else {
        return Value::Null;
    };
    let kinds = kinds(field).map(|kind| {
        let [first, last] = kind.ranks();
        json!({
            "kind": kind.name,
            "clouds": kind.clouds.len(),
            "boxes": kind.boxes(),
            "sprites": kind.sprites(),
            "first_rank": first,
            "last_rank": last,
        })
    });
    json!({
        "bytes": entry.file_bytes,
        "sections": field.sections,
        "boxes": field.box_count(),
        "sprites": field.sprite_count(),
        "kinds": kinds.collect::<Vec<_>>(),
    })
}

pub(super) fn table(pack: &Pack) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    let (Some(field), Some(entry)) = (pack.field(), &pack.manifest().field) else {
        return Ok(text);
    };
    let (sections, bytes, file) = (field.sections, entry.file_bytes, shown(&entry.file));
    writeln!(
        text,
        "\nfield  {sections}x{sections} sections, {bytes} bytes in {file}"
    )?;
    for kind in kinds(field) {
        let (name, clouds) = (kind.name, kind.clouds.len());
        let (boxes, sprites, [first, last]) = (kind.boxes(), kind.sprites(), kind.ranks());
        writeln!(
            text,
            "  {name:<14} {clouds} clouds, {boxes} boxes, {sprites} sprites, from cover {first:.3} to {last:.3}"
        )?;
    }
    Ok(text)
}
