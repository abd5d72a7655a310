//! ICC profiles of a photograph: which light its stored values mean.
//!
//! Profiles of three curves and a matrix, which cameras and editors write (sRGB, Adobe RGB, Display P3, ProPhoto), and those of
//! one grey curve: ISO 15076-1:2010 (ICC.1:2010), 8.3.3 and 8.4.3, formulas F.1 to F.4. Read by hand, since a library's
//! vector instructions would give each processor its own bytes.

use crate::error::{BakeError, unfit};

/// Linear light of BT.709 from stored values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Profile {
    /// Stored 0..1 to linear 0..1, of red, green and blue.
    pub curves: [Curve; 3],
    /// Linear values of the profile to linear BT.709, row by row.
    pub matrix: [[f64; 3]; 3],
}

/// A tone curve, stored 0..1 to linear 0..1.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Curve {
    /// The values at even steps, straight between them (10.6); of a single entry a power.
    Table(Vec<u16>),
    /// A power.
    Power(f64),
    /// 10.18, functions 0 to 4 as the last of them: `(a x + b)^g + e` from `d` on and `c x + f` below. In the order g, a, b, c, d, e, f.
    Parametric([f64; 7]),
}

impl Curve {
    pub fn at(&self, x: f64) -> f64 {
        let value = match self {
            Curve::Power(power) => libm::pow(x, *power),
            Curve::Table(table) => {
                let place = x * (table.len() - 1) as f64;
                let first = (place as usize).min(table.len() - 2);
                let [a, b] = [table[first], table[first + 1]].map(f64::from);
                (a + (b - a) * (place - first as f64)) / 65535.0
            }
            Curve::Parametric([g, a, b, c, d, e, f]) => {
                if x >= *d {
                    libm::pow((a * x + b).max(0.0), *g) + e
                } else {
                    c * x + f
                }
            }
        };
        value.clamp(0.0, 1.0)
    }
}

/// Red, green and blue of sRGB as columns in the profile connection space, whose white is D50: IEC 61966-2-1, annex F, as
/// profiles have them.
const SRGB: [[f64; 3]; 3] = [
    [0.43607, 0.38515, 0.14307],
    [0.22249, 0.71687, 0.06061],
    [0.01392, 0.09708, 0.71410],
];

/// The colours of grey, and of anything that is as sRGB is.
const UNIT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// How far a curve or a colour may be from sRGB and still be meant as it: half a step of a byte in stored values. Profiles of
/// sRGB differ by that.
const NEAR: f64 = 0.5 / 255.0;

/// Reads a profile. Nothing is returned for one that means sRGB, which is what values without a profile mean.
pub(super) fn read(bytes: &[u8], file: &str) -> Result<Option<Profile>, BakeError> {
    let broken = || {
        let expected = "a whole one of red, green and blue or of grey; save the picture as sRGB";
        unfit(file, "ICC profile", "broken", expected)
    };
    let is_profile = bytes.get(36..40) == Some(b"acsp");
    let space = bytes
        .get(16..20)
        .filter(|_| is_profile)
        .ok_or_else(broken)?;
    let profile = match space {
        b"GRAY" => {
            let curve = curve(tag(bytes, b"kTRC").ok_or_else(broken)?).ok_or_else(broken)?;
            Profile {
                curves: [curve.clone(), curve.clone(), curve],
                matrix: UNIT,
            }
        }
        b"RGB " => {
            let Some(colours) = colours(bytes) else {
                let expected = "one of a matrix and curves; save the picture as sRGB";
                return Err(unfit(file, "ICC profile", "one of tables", expected));
            };
            let matrix = product(inverse(SRGB).ok_or_else(broken)?, colours);
            let of = |name| curve(tag(bytes, name)?);
            match [b"rTRC", b"gTRC", b"bTRC"].map(of) {
                [Some(r), Some(g), Some(b)] => Profile {
                    curves: [r, g, b],
                    matrix,
                },
                _ => return Err(broken()),
            }
        }
        other => {
            let found = format!("of {}", String::from_utf8_lossy(other).trim());
            let expected = "one of RGB or GRAY; convert the picture to sRGB";
            return Err(unfit(file, "ICC profile", found, expected));
        }
    };
    Ok((!is_srgb(&profile)).then_some(profile))
}

/// The data of a tag (7.3).
fn tag<'a>(bytes: &'a [u8], name: &[u8; 4]) -> Option<&'a [u8]> {
    let count = long(bytes, 128)?.min(256);
    let entry = (0..count)
        .map(|i| 132 + 12 * i)
        .find(|&at| bytes.get(at..at + 4) == Some(name))?;
    let (start, length) = (long(bytes, entry + 4)?, long(bytes, entry + 8)?);
    bytes.get(start..start.checked_add(length)?)
}

fn long(bytes: &[u8], at: usize) -> Option<usize> {
    let four = bytes.get(at..at + 4)?;
    Some(u32::from_be_bytes([four[0], four[1], four[2], four[3]]) as usize)
}

fn short(bytes: &[u8], at: usize) -> Option<u16> {
    let two = bytes.get(at..at + 2)?;
    Some(u16::from_be_bytes([two[0], two[1]]))
}

/// A number of 16 bits before the point and 16 after it (4.3).
fn fixed(bytes: &[u8], at: usize) -> Option<f64> {
    Some(f64::from(long(bytes, at)? as u32 as i32) / 65536.0)
}

/// Red, green and blue as columns.
fn colours(bytes: &[u8]) -> Option<[[f64; 3]; 3]> {
    let column = |name| {
        let data = tag(bytes, name)?;
        Some([fixed(data, 8)?, fixed(data, 12)?, fixed(data, 16)?])
    };
    let [r, g, b] = [column(b"rXYZ")?, column(b"gXYZ")?, column(b"bXYZ")?];
    Some([0, 1, 2].map(|row| [r[row], g[row], b[row]]))
}

fn curve(data: &[u8]) -> Option<Curve> {
    match data.get(..4)? {
        b"curv" => {
            let count = long(data, 8)?;
            match count {
                0 => Some(Curve::Power(1.0)),
                1 => Some(Curve::Power(f64::from(short(data, 12)?) / 256.0)),
                _ => {
                    let table = data.get(12..12_usize.checked_add(count.checked_mul(2)?)?)?;
                    let (pairs, _) = table.as_chunks();
                    Some(Curve::Table(
                        pairs.iter().map(|&pair| u16::from_be_bytes(pair)).collect(),
                    ))
                }
            }
        }
        b"para" => {
            let kind = short(data, 8)?;
            let p = |i: usize| fixed(data, 12 + 4 * i);
            let [g, a, b] = [p(0)?, p(1).unwrap_or(1.0), p(2).unwrap_or(0.0)];
            // Functions 1 and 2 begin where `a x + b` is 0.
            let from = || (a != 0.0).then_some(-b / a);
            Some(match kind {
                0 => Curve::Power(g),
                1 => Curve::Parametric([g, a, b, 0.0, from()?, 0.0, 0.0]),
                2 => Curve::Parametric([g, a, b, 0.0, from()?, p(3)?, p(3)?]),
                3 => Curve::Parametric([g, a, b, p(3)?, p(4)?, 0.0, 0.0]),
                4 => Curve::Parametric([g, a, b, p(3)?, p(4)?, p(5)?, p(6)?]),
                _ => return None,
            })
        }
        _ => None,
    }
}

fn product(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let cell = |row: usize, column: usize| (0..3).map(|i| a[row][i] * b[i][column]).sum();
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| cell(row, column)))
}

/// By cofactors.
fn inverse(m: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let cofactor = |row: usize, column: usize| {
        let [r, s] = [(row + 1) % 3, (row + 2) % 3];
        let [c, d] = [(column + 1) % 3, (column + 2) % 3];
        m[r][c] * m[s][d] - m[r][d] * m[s][c]
    };
    let determinant: f64 = (0..3).map(|i| m[0][i] * cofactor(0, i)).sum();
    let cell = |row: usize, column: usize| cofactor(column, row) / determinant;
    (determinant != 0.0).then(|| [0, 1, 2].map(|row| [0, 1, 2].map(|column| cell(row, column))))
}

/// Whether the profile gives no other bytes than sRGB does.
fn is_srgb(profile: &Profile) -> bool {
    let cells = profile
        .matrix
        .as_flattened()
        .iter()
        .zip(UNIT.as_flattened());
    let same_colours = { cells }.all(|(a, b)| (a - b).abs() < NEAR);
    let same_curves = profile.curves.iter().all(|curve| {
        (0_u8..=255).all(|stored| {
            let stored = f64::from(stored) / 255.0;
            (super::srgb::encode(curve.at(stored) as f32) - stored as f32).abs() < NEAR as f32
        })
    });
    same_colours && same_curves
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inverse_undoes() {
        let one = product(inverse(SRGB).unwrap(), SRGB);
        for (a, b) in one.as_flattened().iter().zip(UNIT.as_flattened()) {
            assert!((a - b).abs() < 1e-12, "{one:?}");
        }
        assert_eq!(inverse([[1.0, 2.0, 3.0]; 3]), None);
    }

    #[test]
    fn curves_go_through_their_points() {
        let table = Curve::Table(vec![0, 10_000, 65535]);
        for (x, expected) in [(0.0, 0.0), (0.25, 5000.0), (0.5, 10_000.0), (1.0, 65535.0)] {
            assert!((table.at(x) * 65535.0 - expected).abs() < 1e-9);
        }
        // IEC 61966-2-1 as function 3.
        let srgb = [
            2.4,
            1.0 / 1.055,
            0.055 / 1.055,
            1.0 / 12.92,
            0.04045,
            0.0,
            0.0,
        ];
        let curve = Curve::Parametric(srgb);
        for stored in [0.0, 0.02, 0.3, 0.9, 1.0] {
            let linear = f64::from(super::super::srgb::decode(stored as f32));
            assert!((curve.at(stored) - linear).abs() < 1e-6, "{stored}");
        }
    }
}
