//! How layers of each kind look. Numbers are chosen by eye.

use welkin_pack::LayerKind;

/// How layers of a kind look.
pub(super) struct Look {
    /// How far the texture reaches, in metres, at height 0 and 1.
    pub tile_m: [f64; 2],
    /// Thickness, as a share of the layer's distribution, at which it is opaque.
    pub opaque: f32,
    /// Opacity where it is thick.
    pub opacity: f32,
    /// How fast shade deepens.
    pub shade: f32,
    /// Factor on the horizontal part of normals.
    pub relief: f32,
    /// How much the grain roughens it, 0 for not at all.
    pub grain: f32,
    /// Halvings of sunlight by a height of 1 at density 0.
    pub extinction: f32,
    /// Level of the second read: smooth lumps are patches of fibres.
    pub second_level: f32,
    /// How thick such clouds are, in metres: how far their shade reaches.
    pub thickness_m: f64,
}

pub(super) const fn look(kind: LayerKind) -> Look {
    match kind {
        LayerKind::Stratocumulus => Look {
            tile_m: [14_000.0, 7_000.0],
            opaque: 0.30,
            opacity: 1.0,
            shade: 2.1,
            relief: 1.0,
            grain: 2.2,
            extinction: 3.6,
            second_level: 0.0,
            thickness_m: 350.0,
        },
        LayerKind::Cumulus => Look {
            tile_m: [10_500.0, 5_500.0],
            opaque: 0.20,
            opacity: 1.0,
            shade: 3.0,
            relief: 1.0,
            grain: 2.2,
            extinction: 4.2,
            second_level: 0.0,
            thickness_m: 700.0,
        },
        LayerKind::Cirrus => Look {
            tile_m: [42_000.0, 24_000.0],
            opaque: 0.9,
            opacity: 0.65,
            shade: 0.5,
            relief: 0.5,
            grain: 0.0,
            extinction: 0.6,
            second_level: 3.0,
            thickness_m: 200.0,
        },
    }
}
