//! A small field that breaks no rule, for tests to break.

use crate::field::{
    Category, Cloud, CloudBox, CloudKind, ColourLevel, Exposure, Field, Hour, Sprite, bounds,
    rounded_rotation,
};

/// One section with 20 clouds of two boxes each, five sprites a box in a row; every fifth is cirrus.
pub(crate) fn field() -> Field {
    let hour = |time: f32, ambient: f32| Hour {
        time,
        ambient,
        colour: [0.5 * ambient, 0.5, 0.4],
        least: 0.1,
        most: 1.0,
    };
    let mut field = Field {
        sections: 1,
        hours: vec![
            hour(0.0, 0.04),
            hour(0.3, 0.7),
            hour(0.5, 1.0),
            hour(0.7, 0.7),
        ],
        clouds: (0..20).map(cloud).collect(),
    };
    field.expose();
    field
}

fn cloud(index: usize) -> Cloud {
    let kind = if index % 5 == 4 {
        CloudKind::Cirrus
    } else {
        CloudKind::Cumulus
    };
    let corner = [180.0 * index as f32, 1000.0, 1900.0];
    let boxes: Vec<CloudBox> = (0..2)
        .map(|i| CloudBox {
            centre_m: [corner[0], corner[1] + 200.0 * i as f32, corner[2]],
            size_m: [600.0, 200.0, 100.0],
            category: Category::ALL[(index + i) % 3],
            group: i as u16,
            cull_m: 90.0,
        })
        .collect();
    let sprites = (0..10).map(|i| {
        let of_box = boxes[i / 5];
        let [x, y, z] = of_box.centre_m;
        Sprite {
            centre_m: [x - 200.0 + 100.0 * (i % 5) as f32, y, z],
            size_m: [250.5, 240.0],
            rotation_rad: rounded_rotation(0.3 * i as f32),
            cell: ((index + i) % 16) as u8,
            cloud_box: (i / 5) as u16,
            exposure: Exposure::default(),
        }
    });
    let (centre_m, size_m) = bounds(&boxes);
    let level = |i: usize| ColourLevel {
        height: i as f32 / 4.0,
        rgba: [
            0.4 + 0.05 * i as f32,
            0.5,
            if kind.is_flat() { 0.7 } else { 0.6 },
            1.0,
        ],
    };
    Cloud {
        kind,
        rank: index as f32 / 20.0,
        centre_m,
        size_m,
        levels: [0, 1, 2, 3, 4].map(level),
        groups_m: boxes.iter().map(|b| b.centre_m).collect(),
        sprites: sprites.collect(),
        boxes,
    }
}
