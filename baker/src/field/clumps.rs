//! Shading groups of clouds that the field maker makes: clumps that lie beside each other, joined.
//!
//! N. Wang, "Let There Be Clouds!", Game Developer, 2004, "Shading": a group is a section of some 30 sprites that are shaded as
//! a unit. A kind numbers its clumps (a heap, a storey of a tower, two lumps of a roll) such that neighbours follow on each
//! other; how many sprites they have is known after the cull.

use welkin_pack::field::Cloud;

use super::cloud::centres;

/// Sprites of a group.
const SPRITES: usize = 30;

/// Joins the clumps of a cloud, in their order, to groups of about [`SPRITES`] each; a cloud of fewer sprites is one group.
pub(super) fn join(cloud: &mut Cloud) {
    let mut sprites = vec![0; cloud.groups_m.len()];
    for sprite in &cloud.sprites {
        let own = &cloud.boxes[usize::from(sprite.cloud_box)];
        sprites[usize::from(own.group)] += 1;
    }
    let group_of = joined(&sprites);
    for own in &mut cloud.boxes {
        own.group = group_of[usize::from(own.group)];
    }
    let count = group_of.last().map_or(0, |last| usize::from(*last) + 1);
    cloud.groups_m = centres(&cloud.boxes, count);
}

/// The group of each clump, by its sprites: a group ends with the clump after which it is nearest to its share.
fn joined(sprites: &[usize]) -> Vec<u16> {
    let all: usize = sprites.iter().sum();
    let groups = ((all + SPRITES / 2) / SPRITES).max(1);
    let (mut before, mut group, mut is_empty) = (0, 0, true);
    let mut group_of = Vec::with_capacity(sprites.len());
    for own in sprites {
        // The middle of a clump is beyond the end of this group's share.
        let is_beyond = (2 * before + own) * groups > 2 * all * (usize::from(group) + 1);
        if is_beyond && !is_empty && usize::from(group) + 1 < groups {
            group += 1;
            is_empty = true;
        }
        group_of.push(group);
        is_empty &= *own == 0;
        before += own;
    }
    group_of
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clumps_are_joined_in_their_order() {
        assert_eq!(joined(&[5; 6]), [0; 6]);
        assert_eq!(joined(&[10; 6]), [0, 0, 0, 1, 1, 1]);
        assert_eq!(joined(&[3, 3]), [0, 0]);
        assert_eq!(joined(&[0, 60, 0, 0, 60]), [0, 0, 1, 1, 1]);
        assert_eq!(joined(&[200, 1]), [0, 1]);
        assert!(joined(&[]).is_empty());
    }

    #[test]
    fn small_clumps_make_groups_of_twenty_to_forty() {
        for all in 20..400 {
            let group_of = joined(&vec![1; all]);
            let count = usize::from(group_of[all - 1]) + 1;
            for group in 0..count {
                let own = group_of
                    .iter()
                    .filter(|g| usize::from(**g) == group)
                    .count();
                assert!((20..45).contains(&own), "{all}: {own}");
            }
        }
    }
}
