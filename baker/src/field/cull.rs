//! Takes away every sprite that is too near to another.

use std::collections::BTreeMap;

use welkin_pack::field::Sprite;

/// The sprites that are left, in their order.
///
/// The list is gone through once; a sprite stays if no sprite that has stayed is nearer than the cull distance. Of two
/// boxes with different distances, `cull_m` by box, the smaller one counts: the dense one is meant to be dense.
///
/// A grid as coarse as the largest distance: only the 27 cells around a sprite are looked at.
pub(super) fn cull(sprites: Vec<Sprite>, cull_m: &[f32]) -> Vec<Sprite> {
    let largest = cull_m.iter().copied().fold(1.0, f32::max);
    let cell = |sprite: &Sprite| sprite.centre_m.map(|c| libm::floorf(c / largest) as i32);
    let mut grid: BTreeMap<[i32; 3], Vec<Sprite>> = BTreeMap::new();
    let mut kept = Vec::with_capacity(sprites.len());
    for sprite in sprites {
        let at = cell(&sprite);
        let mut near = around(at).filter_map(|cell| grid.get(&cell)).flatten();
        if near.all(|other| are_apart(&sprite, other, cull_m)) {
            grid.entry(at).or_default().push(sprite);
            kept.push(sprite);
        }
    }
    kept
}

fn around([x, y, z]: [i32; 3]) -> impl Iterator<Item = [i32; 3]> {
    let near = |c: i32| c - 1..=c + 1;
    near(x).flat_map(move |x| near(y).flat_map(move |y| near(z).map(move |z| [x, y, z])))
}

/// Exact: places are multiples of an eighth of a metre.
fn are_apart(a: &Sprite, b: &Sprite, cull_m: &[f32]) -> bool {
    let cull = |sprite: &Sprite| f64::from(cull_m[usize::from(sprite.cloud_box)]);
    let least = cull(a).min(cull(b));
    let squares = (0..3).map(|axis| {
        let d = f64::from(a.centre_m[axis]) - f64::from(b.centre_m[axis]);
        d * d
    });
    squares.sum::<f64>() >= least * least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::Stream;

    fn sprites(count: usize, side_m: f64) -> Vec<Sprite> {
        let mut stream = Stream::new(3, "test");
        (0..count)
            .map(|i| Sprite {
                centre_m: std::array::from_fn(|_| {
                    crate::field::grid::snapped((side_m * (stream.unit() - 0.5)) as f32)
                }),
                size_m: [200.0; 2],
                rotation_rad: 0.0,
                cell: 10,
                cloud_box: (i % 2) as u16,
                exposure: welkin_pack::field::Exposure::default(),
            })
            .collect()
    }

    /// All pairs, as the article's list.
    fn by_all_pairs(sprites: &[Sprite], cull_m: &[f32]) -> Vec<Sprite> {
        let mut kept: Vec<Sprite> = Vec::new();
        for sprite in sprites {
            if kept.iter().all(|other| are_apart(sprite, other, cull_m)) {
                kept.push(*sprite);
            }
        }
        kept
    }

    #[test]
    fn the_grid_keeps_what_all_pairs_keep() {
        for cull_m in [[60.0, 60.0], [20.0, 90.0], [0.0, 50.0], [0.0, 0.0]] {
            let all = sprites(600, 500.0);
            let kept = cull(all.clone(), &cull_m);
            assert_eq!(kept, by_all_pairs(&all, &cull_m), "{cull_m:?}");
            assert_eq!(kept.len() == all.len(), cull_m == [0.0, 0.0]);
        }
    }

    #[test]
    fn whom_the_cull_takes_was_near_to_one_that_stayed() {
        let (all, cull_m) = (sprites(600, 500.0), [70.0, 70.0]);
        let kept = cull(all.clone(), &cull_m);
        for sprite in all.iter().filter(|s| !kept.contains(s)) {
            assert!(kept.iter().any(|other| !are_apart(sprite, other, &cull_m)));
        }
    }
}
