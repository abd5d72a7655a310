//! The kinds of cloud in the role `layers`.

/// A kind of cloud, in the order of the images of the role `layers`.
///
/// World Meteorological Organization, "International Cloud Atlas", WMO-No. 407, 2017, section 2.3.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub enum LayerKind {
    /// A sheet of rounded lumps and rolls with gaps between them.
    Stratocumulus,
    /// Separate heaps with crisp edges.
    Cumulus,
    /// Long fibres, some of them hooked.
    Cirrus,
}

impl LayerKind {
    /// Every kind; `ALL[i]` is image `i`.
    pub const ALL: [LayerKind; 3] = [
        LayerKind::Stratocumulus,
        LayerKind::Cumulus,
        LayerKind::Cirrus,
    ];

    /// The name used in recipes and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            LayerKind::Stratocumulus => "stratocumulus",
            LayerKind::Cumulus => "cumulus",
            LayerKind::Cirrus => "cirrus",
        }
    }

    /// The mean density that its layer is brought to.
    pub const fn mean_density(self) -> f32 {
        match self {
            LayerKind::Stratocumulus => 0.5,
            LayerKind::Cumulus => 0.4,
            LayerKind::Cirrus => 0.42,
        }
    }

    /// The kind of a name; the inverse of [`LayerKind::name`].
    pub fn from_name(name: &str) -> Option<LayerKind> {
        LayerKind::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_again_and_others_are_not() {
        for (index, kind) in LayerKind::ALL.into_iter().enumerate() {
            assert_eq!(LayerKind::from_name(kind.name()), Some(kind));
            assert_eq!(kind as usize, index);
        }
        for other in ["", "Cirrus", "cirrus ", "nimbus"] {
            assert_eq!(LayerKind::from_name(other), None, "{other:?}");
        }
    }
}
