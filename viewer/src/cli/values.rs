//! What several commands take: the size of a picture.

/// Sides above this are no texture on any GPU; what the GPU at hand takes is checked when it is known.
pub const MAX_SIDE: u32 = 32_768;

pub fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text
        .split_once('x')
        .and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match sides {
        Some(size) if size.iter().all(|side| (1..=MAX_SIDE).contains(side)) => Ok(size),
        _ => Err(format!(
            "expected WIDTHxHEIGHT, each from 1 to {MAX_SIDE}, such as 1600x1200"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_side_belongs_to_the_range() {
        assert_eq!(size("1x32768"), Ok([1, MAX_SIDE]));
    }
}
