//! A number with a range.

/// A parameter out of its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key} is {found}, expected {expected}")]
pub struct ParamError {
    /// Name of the parameter, such as `octaves.formation_interval_s`.
    pub key: &'static str,
    /// As it is.
    pub found: String,
    /// As it should be.
    pub expected: String,
}

/// A number with its key, its default and its range.
pub(super) type Ranged<'a> = (&'static str, &'a mut f32, f32, [f32; 2]);
