//! Levels of the role `sprites`: cells stay apart.

use super::fold::fold;
use crate::image::Image;
use crate::mapping::SheetCell;

const GREYS: [usize; 3] = [0, 2, 3];
const ALPHA: usize = 1;

/// Weight of a transparent texel beside its opacity: so little that it counts only where all are transparent.
const LEAST_WEIGHT: f32 = 1.0 / 4096.0;

/// Averages opacity, and the greys of what is opaque, cell by cell: a cell's side is even, so no 2x2 texels are of two
/// cells. The outermost texels of every cell stay transparent, or bilinear filtering would take them into the next.
pub(super) fn halve(image: &Image) -> Image {
    let mut level = fold(image, |texels, out| {
        let weight = |texel: &[f32]| texel[ALPHA] + LEAST_WEIGHT;
        let weights: f32 = texels.iter().map(|t| weight(t)).sum();
        for grey in GREYS {
            let sum: f32 = texels.iter().map(|t| weight(t) * t[grey]).sum();
            out[grey] = sum / weights;
        }
        out[ALPHA] = texels.iter().map(|t| t[ALPHA]).sum::<f32>() / texels.len() as f32;
    });
    let cell = level.width / SheetCell::A_SIDE;
    let is_border = |i: u32| [0, cell - 1].contains(&(i % cell));
    for y in 0..level.height {
        for x in 0..level.width {
            if is_border(x) || is_border(y) {
                level.texel_mut(x, y)[ALPHA] = 0.0;
            }
        }
    }
    level
}

#[cfg(test)]
mod tests {
    use super::*;

    const GREY: usize = 0;

    /// A sheet of cells of 16 texels, transparent and of grey 0.2.
    fn blank() -> Image {
        let mut image = Image::new(64, 64, 4);
        image
            .texels
            .chunks_exact_mut(4)
            .for_each(|texel| texel[GREY] = 0.2);
        image
    }

    #[test]
    fn grey_is_that_of_the_opaque_and_goes_on_where_there_is_none() {
        let mut image = blank();
        image.texel_mut(4, 6).copy_from_slice(&[0.8, 0.5, 0.8, 0.1]);
        image
            .texel_mut(5, 6)
            .copy_from_slice(&[0.4, 0.25, 0.4, 0.7]);
        let level = halve(&image);
        let met = level.texel(2, 3);
        // (0.8 * 0.5 + 0.4 * 0.25) / 0.75, but for the least weights, of which there are four.
        assert!(
            (met[GREY] - 2.0 / 3.0).abs() < 4.0 * LEAST_WEIGHT,
            "{met:?}"
        );
        assert!((met[2] - met[GREY]).abs() < 4.0 * LEAST_WEIGHT);
        assert!((met[3] - 0.3).abs() < 4.0 * LEAST_WEIGHT, "{met:?}");
        assert!((met[ALPHA] - 0.1875).abs() < 1e-6);
        assert!((level.texel(7, 7)[GREY] - 0.2).abs() < 1e-6);
    }

    #[test]
    fn the_border_of_every_cell_stays_transparent() {
        let mut level = blank();
        level
            .texels
            .chunks_exact_mut(4)
            .for_each(|texel| texel[ALPHA] = 1.0);
        for cell in [8, 4] {
            level = halve(&level);
            for (i, texel) in (0..).zip(level.texels.chunks_exact(4)) {
                let [x, y] = [i % level.width, i / level.width].map(|i| i % cell);
                let inside = (1..cell - 1).contains(&x) && (1..cell - 1).contains(&y);
                assert_eq!(texel[ALPHA], if inside { 1.0 } else { 0.0 });
            }
        }
    }
}
