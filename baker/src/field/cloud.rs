//! Boxes become a cloud.

use welkin_pack::field::{COLOUR_LEVELS, Cloud, CloudBox, CloudKind, ColourLevel, bounds};

use super::grid::snapped;
use super::{cull, place};
use crate::settings::BoxSettings;
use crate::stream::Stream;

/// What a cloud is made from.
pub(super) struct Plan<'a> {
    pub kind: CloudKind,
    pub levels: [ColourLevel; COLOUR_LEVELS],
    pub boxes: &'a [BoxSettings],
}

/// Fills the boxes with sprites. The cloud stands at its origin and has rank 0. Boxes of which the cull leaves nothing are
/// left out.
pub(super) fn cloud(plan: &Plan, stream: &mut Stream) -> Cloud {
    let groups = groups(plan.boxes);
    let mut sprites = Vec::new();
    let mut boxes = Vec::with_capacity(plan.boxes.len());
    for (index, settings) in plan.boxes.iter().enumerate() {
        let group = groups.binary_search(&settings.group).unwrap_or(0);
        let stored = stored(settings, group as u16);
        sprites.extend(place::sprites(settings, &stored, index as u16, stream));
        boxes.push(stored);
    }
    let cull_m: Vec<f32> = boxes.iter().map(|b| b.cull_m).collect();
    let mut cloud = Cloud {
        kind: plan.kind,
        rank: 0.0,
        centre_m: [0.0; 3],
        size_m: [0.0; 3],
        levels: plan.levels,
        groups_m: Vec::new(),
        sprites: cull::cull(sprites, &cull_m),
        boxes,
    };
    drop_empty_boxes(&mut cloud);
    (cloud.centre_m, cloud.size_m) = bounds(&cloud.boxes);
    cloud.groups_m = centres(&cloud.boxes, groups.len());
    cloud
}

/// The middles of so many shading groups.
pub(super) fn centres(boxes: &[CloudBox], count: usize) -> Vec<[f32; 3]> {
    let centre = |group: usize| {
        let of_group = boxes.iter().filter(|b| usize::from(b.group) == group);
        let (centre, _) = bounds(&of_group.copied().collect::<Vec<_>>());
        // A metre is nothing to a shade, and its text is shorter.
        centre.map(libm::roundf)
    };
    (0..count).map(centre).collect()
}

/// The numbers of the shading groups, each once, in order.
pub(super) fn groups(boxes: &[BoxSettings]) -> Vec<u32> {
    let mut groups: Vec<u32> = boxes.iter().map(|b| b.group).collect();
    groups.sort_unstable();
    groups.dedup();
    groups
}

/// A box as the pack has it: its edges on the grid.
pub(super) fn stored(settings: &BoxSettings, group: u16) -> CloudBox {
    CloudBox {
        centre_m: settings.centre_m.map(snapped),
        // Half of it is on the grid too.
        size_m: settings
            .size_m
            .map(|side| 2.0 * snapped(0.5 * side).max(0.125)),
        category: settings.category,
        group,
        cull_m: settings.cull_m(),
    }
}

fn drop_empty_boxes(cloud: &mut Cloud) {
    let mut filled = vec![false; cloud.boxes.len()];
    for sprite in &cloud.sprites {
        filled[usize::from(sprite.cloud_box)] = true;
    }
    let before = |index: usize| filled[..index].iter().filter(|f| **f).count() as u16;
    for sprite in &mut cloud.sprites {
        sprite.cloud_box = before(usize::from(sprite.cloud_box));
    }
    let mut index = 0;
    cloud.boxes.retain(|_| {
        index += 1;
        filled[index - 1]
    });
}

/// Moves a cloud along the ground.
pub(super) fn move_to(cloud: &mut Cloud, [x, z]: [f32; 2]) {
    let by = [snapped(x), 0.0, snapped(z)];
    let shift = |place: &mut [f32; 3]| (0..3).for_each(|axis| place[axis] += by[axis]);
    shift(&mut cloud.centre_m);
    cloud.groups_m.iter_mut().for_each(shift);
    cloud.boxes.iter_mut().for_each(|b| shift(&mut b.centre_m));
    cloud
        .sprites
        .iter_mut()
        .for_each(|s| shift(&mut s.centre_m));
}
