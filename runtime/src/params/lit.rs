//! What [`crate::Method::Lit`] alone knows.

use welkin_pack::LayerKind;

/// The most layers: two iterations of three.
pub const MAX_LAYERS: usize = 6;

// The literal, since rustc 1.95 stumbles over a named length where a closure updates a captured `LitParams`.
const _: () = assert!(MAX_LAYERS == 6);

/// The least and the largest [`LitLayer::share`].
pub const SHARE: [f32; 2] = [0.0, 1.0];

/// The least and the largest [`LitLayer::height`], in heights of the dome.
pub const LAYER_HEIGHT: [f32; 2] = [0.1, 20.0];

/// The least and the largest [`LitLayer::velocity_m_s`], along each axis.
pub const VELOCITY_M_S: [f32; 2] = [-200.0, 200.0];

/// The layers that one iteration draws.
pub const LAYERS_AN_ITERATION: usize = 3;

/// What [`crate::Method::Lit`] alone knows. See [`crate::clouds::lit`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
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
}

/// A layer of clouds of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
        }
    }
}
