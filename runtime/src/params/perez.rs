//! What [`crate::params::SkyModel::Perez`] alone knows.

use super::range::ParamError;

/// Types of the standard: CIE S 011/E:2003 (ISO 15469:2004), table 1.
pub const STANDARD_SKIES: u8 = 15;

/// The overcast ones among them: types 1 to this one.
pub const LAST_OVERCAST: u8 = 5;

/// Smallest and largest turbidity. Below 1.65 Preetham's first factor turns negative at the zenith, and up to 2 the zenith is
/// very dark; 10 is a thick haze.
pub const TURBIDITY: [f32; 2] = [1.7, 10.0];

/// Smallest and largest a, b, c, d, e of the user. They hold the standard's and keep equation 1 above zero: with a from
/// -1 and b below 0 the first factor is, with c and e from 0 the second. A steeper d is a sun, not an aureole.
pub const CUSTOM: [[f32; 2]; 5] = [
    [-1.0, 10.0],
    [-5.0, -0.05],
    [0.0, 30.0],
    [-5.0, -0.1],
    [0.0, 2.0],
];

/// Where the numbers a to e of [`crate::params::SkyModel::Perez`]'s luminance come from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum PerezShape {
    /// From the turbidity: A. J. Preetham, P. Shirley, B. Smits, SIGGRAPH 1999.
    #[default]
    Preetham,
    /// A sky of the standard, type 1..=15: see [`crate::clear_sky::cie::SKIES`].
    Cie(u8),
    /// a, b, c, d, e, in the ranges of [`CUSTOM`].
    Custom([f32; 5]),
}

/// What [`crate::params::SkyModel::Perez`] alone knows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct PerezParams {
    /// How luminance is distributed.
    pub shape: PerezShape,
    /// Haze in the air, 1.7 (clear) to 10 (thick): all light that is scattered over that which air alone scatters.
    pub turbidity: f32,
}

impl Default for PerezParams {
    /// A clear day in a temperate climate.
    fn default() -> PerezParams {
        PerezParams {
            shape: PerezShape::Preetham,
            turbidity: 2.5,
        }
    }
}

impl PerezShape {
    /// The same in its ranges. Numbers of the user's that are no numbers leave Preetham's.
    pub(crate) fn clamped(self) -> PerezShape {
        match self {
            PerezShape::Preetham => self,
            PerezShape::Cie(number) => PerezShape::Cie(number.clamp(1, STANDARD_SKIES)),
            PerezShape::Custom(numbers) if numbers.iter().any(|n| n.is_nan()) => {
                PerezShape::Preetham
            }
            PerezShape::Custom(numbers) => PerezShape::Custom(std::array::from_fn(|i| {
                let [low, high] = CUSTOM[i];
                numbers[i].clamp(low, high)
            })),
        }
    }

    /// Tells the first number that [`PerezShape::clamped`] would change.
    pub(crate) fn check(self) -> Result<(), ParamError> {
        const KEYS: [&str; 5] = [
            "perez.shape.a",
            "perez.shape.b",
            "perez.shape.c",
            "perez.shape.d",
            "perez.shape.e",
        ];
        match self {
            PerezShape::Preetham => Ok(()),
            PerezShape::Cie(number) => {
                ParamError::unless("perez.shape.cie", number, 1..=STANDARD_SKIES)
            }
            PerezShape::Custom(numbers) => {
                for (i, [low, high]) in CUSTOM.into_iter().enumerate() {
                    ParamError::unless(KEYS[i], numbers[i], low..=high)?;
                }
                Ok(())
            }
        }
    }
}
