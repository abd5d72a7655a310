//! What [`crate::Method::Lit`] alone knows.

use welkin_pack::LayerKind;

use super::range::Ranged;

/// The most layers: two iterations of three.
pub const MAX_LAYERS: usize = 6;

// The literal, since rustc 1.95 stumbles over a named length where a closure updates a captured `LitParams`.
const _: () = assert!(MAX_LAYERS == 6);

/// The layers that one iteration draws.
pub const LAYERS_AN_ITERATION: usize = 3;

/// What [`crate::Method::Lit`] alone knows. See [`crate::clouds::lit`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LitParams {
    /// Radius of the dome's rim in metres, 1000..=1000000: the paper's user-defined size.
    pub radius_m: f32,
    /// Height of the dome over its radius, 0.02 (flat) to 1 (a hemisphere).
    pub flattening: f32,
    /// Layers from the lowest to the highest. Those without a share are not drawn.
    pub layers: [LitLayer; 6],
    /// Light scattered to all sides, 0..=1: the paper's `k1`.
    pub k1: f32,
    /// Light scattered forwards, 0..=1: the paper's `k2`.
    pub k2: f32,
    /// How narrow the lighted area around the sun is and how fast shade deepens, 0.5..=16: the paper's `m`.
    pub m: f32,
    /// Seconds in which a cloud forms or dissolves, 1..=86400.
    pub formation_interval_s: f32,
    /// Strength of the full moon's light on clouds, 0..=1; it stands opposite the sun.
    pub moon: f32,
}

/// A layer of clouds of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LitLayer {
    /// Which layer of the pack's texture it shows.
    pub kind: LayerKind,
    /// Its part in [`crate::SkyParams::cover`] beside the other layers' shares, 0..=1; 0 leaves it out.
    pub share: f32,
    /// Where it floats, in heights of the dome, 0.1..=20.
    pub height: f32,
    /// Where it goes at speed 1, in metres a second to the east and to the south, -200..=200.
    pub velocity_m_s: [f32; 2],
}

impl LitLayer {
    /// A layer of this kind where it usually floats and as it usually moves.
    ///
    /// Heights are those of the World Meteorological Organization, "International Cloud Atlas", 2017 (low clouds 0 to 2 km, high
    /// ones 5 to 13 km) over the default dome's 1400 m.
    pub const fn of(kind: LayerKind, share: f32) -> LitLayer {
        let (height, velocity_m_s) = match kind {
            LayerKind::Stratocumulus => (1.0, [32.0, 24.0]),
            LayerKind::Cumulus => (0.8, [36.0, 18.0]),
            LayerKind::Cirrus => (5.5, [60.0, 110.0]),
        };
        LitLayer {
            kind,
            share,
            height,
            velocity_m_s,
        }
    }
}

impl LitParams {
    /// The default dome and light with other layers, at most [`MAX_LAYERS`]; more are left out.
    pub fn with_layers(layers: &[LitLayer]) -> LitParams {
        let mut params = LitParams::default();
        for (index, slot) in params.layers.iter_mut().enumerate() {
            *slot = layers.get(index).copied().unwrap_or(NO_LAYER);
        }
        params
    }
}

/// A slot without a layer.
const NO_LAYER: LitLayer = LitLayer::of(LayerKind::Stratocumulus, 0.0);

impl Default for LitParams {
    /// Three layers: stratocumulus, some more of it higher up, cirrus.
    fn default() -> LitParams {
        let higher = LitLayer {
            height: 2.1,
            velocity_m_s: [30.0, 50.0],
            ..LitLayer::of(LayerKind::Stratocumulus, 0.2)
        };
        LitParams {
            radius_m: 14_000.0,
            flattening: 0.1,
            layers: [
                LitLayer::of(LayerKind::Stratocumulus, 0.6),
                higher,
                LitLayer::of(LayerKind::Cirrus, 0.2),
                NO_LAYER,
                NO_LAYER,
                NO_LAYER,
            ],
            k1: 0.52,
            k2: 0.68,
            m: 3.5,
            formation_interval_s: 240.0,
            moon: 1.0,
        }
    }
}

/// Every number that has a range.
pub(super) fn numbers(lit: &mut LitParams) -> Vec<Ranged<'_>> {
    let usual = LitParams::default();
    let mut numbers: Vec<Ranged<'_>> = vec![
        (
            "lit.radius_m",
            &mut lit.radius_m,
            usual.radius_m,
            [1e3, 1e6],
        ),
        (
            "lit.flattening",
            &mut lit.flattening,
            usual.flattening,
            [0.02, 1.0],
        ),
        ("lit.k1", &mut lit.k1, usual.k1, [0.0, 1.0]),
        ("lit.k2", &mut lit.k2, usual.k2, [0.0, 1.0]),
        ("lit.m", &mut lit.m, usual.m, [0.5, 16.0]),
        (
            "lit.formation_interval_s",
            &mut lit.formation_interval_s,
            usual.formation_interval_s,
            [1.0, 86_400.0],
        ),
        ("lit.moon", &mut lit.moon, usual.moon, [0.0, 1.0]),
    ];
    let layers = lit.layers.iter_mut().zip(&LAYER_KEYS).zip(&usual.layers);
    for ((layer, [share, height, east, south]), usual) in layers {
        let [to_east, to_south] = &mut layer.velocity_m_s;
        let [usual_east, usual_south] = usual.velocity_m_s;
        numbers.extend([
            (*share, &mut layer.share, usual.share, [0.0, 1.0]),
            (*height, &mut layer.height, usual.height, [0.1, 20.0]),
            (*east, to_east, usual_east, [-200.0, 200.0]),
            (*south, to_south, usual_south, [-200.0, 200.0]),
        ]);
    }
    numbers
}

/// Names of a layer's numbers, for errors.
macro_rules! layer_keys {
    ($($index:literal),*) => {
        [$([
            concat!("lit.layers[", $index, "].share"),
            concat!("lit.layers[", $index, "].height"),
            concat!("lit.layers[", $index, "].velocity_m_s[0]"),
            concat!("lit.layers[", $index, "].velocity_m_s[1]"),
        ]),*]
    };
}

const LAYER_KEYS: [[&str; 4]; MAX_LAYERS] = layer_keys!(0, 1, 2, 3, 4, 5);
