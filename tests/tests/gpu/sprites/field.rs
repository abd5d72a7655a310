//! Small fields, and the pack that holds one.

use std::sync::OnceLock;

use welkin_pack::field::{
    COLOUR_LEVELS, Category, Cloud, CloudBox, CloudKind, ColourLevel, Exposure, Hour, Sprite,
};
use welkin_pack::{Field, Pack};
use welkin_tests::pack::default_pack;

/// The default pack with another field.
pub fn with(clouds: Vec<Cloud>) -> Pack {
    let mut field = Field {
        sections: 2,
        hours: vec![hour(0.0, 0.1), hour(0.4, 1.0), hour(0.7, 0.8)],
        clouds,
    };
    field.expose();
    let pack = default_pack().clone();
    pack.with_field(field).expect("the field is sound")
}

/// Two clouds: a heap with all kinds of pictures in two shading groups, and a flat one above it.
pub fn two_clouds() -> &'static Pack {
    static PACK: OnceLock<Pack> = OnceLock::new();
    PACK.get_or_init(|| with(vec![heap([2000.0, 1200.0, 1000.0], 0.0), sheet()]))
}

fn hour(time: f32, ambient: f32) -> Hour {
    Hour {
        time,
        ambient,
        colour: [0.7 * ambient, 0.6 * ambient, 0.5 * ambient],
        least: 0.05,
        most: 1.0,
    }
}

fn levels(alpha: f32) -> [ColourLevel; COLOUR_LEVELS] {
    std::array::from_fn(|i| {
        let height = i as f32 / 4.0;
        ColourLevel {
            height,
            rgba: [
                0.2 + 0.3 * height,
                0.25 + 0.3 * height,
                0.35 + 0.25 * height,
                alpha,
            ],
        }
    })
}

/// A cloud of 12 sprites in two boxes about a place.
pub fn heap(centre_m: [f32; 3], rank: f32) -> Cloud {
    let [x, y, z] = centre_m;
    let own_box = |east: f32, group: u16| CloudBox {
        centre_m: [x + east, y, z],
        size_m: [600.0, 400.0, 600.0],
        category: Category::Cumulus,
        group,
        cull_m: 20.0,
    };
    let sprites = (0..12_u8).map(|i| {
        let t = f32::from(i);
        let east = if i < 6 { -300.0 } else { 300.0 };
        Sprite {
            centre_m: [
                x + east + 250.0 * (t * 2.4).sin(),
                y + 180.0 * (t * 1.7).cos(),
                z + 250.0 * (t * 0.9).cos(),
            ],
            size_m: [260.0 + 20.0 * t, 240.0],
            rotation_rad: 0.4 * t,
            cell: i + i / 4,
            cloud_box: u16::from(i >= 6),
            exposure: Exposure::default(),
        }
    });
    Cloud {
        kind: CloudKind::Cumulus,
        rank,
        centre_m,
        size_m: [1200.0, 400.0, 600.0],
        levels: levels(1.0),
        groups_m: vec![[x - 300.0, y, z], [x + 300.0, y, z]],
        boxes: vec![own_box(-300.0, 0), own_box(300.0, 1)],
        sprites: sprites.collect(),
    }
}

/// Flat rectangles, five of them.
fn sheet() -> Cloud {
    let centre_m = [2500.0, 2600.0, 2500.0];
    let size_m = [3000.0, 60.0, 3000.0];
    let sprites = (0..5_u8).map(|i| Sprite {
        centre_m: [
            1300.0 + 550.0 * f32::from(i),
            2600.0 + 4.0 * f32::from(i),
            2500.0,
        ],
        size_m: [1400.0, 900.0],
        rotation_rad: 0.3 * f32::from(i),
        cell: 4 + i,
        cloud_box: 0,
        exposure: Exposure::default(),
    });
    Cloud {
        kind: CloudKind::Cirrus,
        rank: 0.5,
        centre_m,
        size_m,
        levels: levels(0.6),
        groups_m: vec![centre_m],
        boxes: vec![CloudBox {
            centre_m,
            size_m,
            category: Category::Wispy,
            group: 0,
            cull_m: 20.0,
        }],
        sprites: sprites.collect(),
    }
}
