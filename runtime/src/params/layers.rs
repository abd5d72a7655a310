//! Layers of clouds as text: between commas.

use welkin_pack::LayerKind;

use super::lit::{LAYER_HEIGHT, LitLayer, LitParams, MAX_LAYERS, SHARE, VELOCITY_M_S};
use super::range::within;

/// How it is written.
pub const LAYERS_FORM: &str = "KIND[:SHARE[:HEIGHT[:EAST:SOUTH]]],...";

/// What it means.
pub fn layers_help() -> String {
    format!(
        "1 to {MAX_LAYERS} layers between commas; lower ones hide higher ones. KIND is one of {}; SHARE its part in the \
         cover beside the other layers, 0 to 1, or else 1; HEIGHT counts in heights of the dome, 0.1 to 20, or else is the \
         kind's; EAST and SOUTH say where it goes at speed 1, in metres a second, -200 to 200, or else as its kind does",
        kinds()
    )
}

/// Layers as text. Those without a share are left out.
pub fn layers_text(layers: &[LitLayer]) -> String {
    let shown = layers.iter().filter(|layer| layer.share > 0.0);
    shown.map(written).collect::<Vec<_>>().join(",")
}

fn written(layer: &LitLayer) -> String {
    let (kind, [east, south]) = (layer.kind.name(), layer.velocity_m_s);
    format!("{kind}:{}:{}:{east}:{south}", layer.share, layer.height)
}

fn kinds() -> String {
    LayerKind::ALL.map(LayerKind::name).join(", ")
}

/// Layers from text, brought into the order of their heights: that is how they lie before each other.
///
/// # Errors
/// Which layer is wrong, and what was expected.
pub fn layers(text: &str) -> Result<[LitLayer; MAX_LAYERS], String> {
    let mut layers = text
        .split(',')
        .map(|one| layer(one.trim()))
        .collect::<Result<Vec<_>, _>>()?;
    if layers.len() > MAX_LAYERS {
        return Err(format!(
            "{} layers, expected 1 to {MAX_LAYERS}",
            layers.len()
        ));
    }
    layers.sort_by(|a, b| a.height.total_cmp(&b.height));
    Ok(LitParams::with_layers(&layers).layers)
}

fn layer(text: &str) -> Result<LitLayer, String> {
    let mut parts = text.split(':').map(str::trim);
    let name = parts.next().unwrap_or_default();
    let [share, height, east, south, too_much] = std::array::from_fn(|_| parts.next());
    let kind = LayerKind::from_name(name).ok_or_else(|| {
        format!(
            "\"{name}\" is no kind of cloud; expected one of {}",
            kinds()
        )
    })?;
    let form = |fault: &str| {
        format!(
            "\"{text}\" {fault}; expected KIND[:SHARE[:HEIGHT[:EAST:SOUTH]]], such as {name}:0.7:1.2 or {name}:0.7:1.2:30:-15"
        )
    };
    if too_much.is_some() {
        return Err(form("has too many parts"));
    }
    if east.is_some() && south.is_none() {
        return Err(form("has a velocity to the east and none to the south"));
    }
    let mut layer = LitLayer::of(kind, 1.0);
    let read = |key: &str, text: &str, [low, high]: [f32; 2], unit: &str| {
        within(text, low..=high, unit)
            .map_err(|expected| format!("the {key} of {name} is \"{text}\", {expected}"))
    };
    if let Some(share) = share {
        layer.share = read("share", share, SHARE, "")?;
    }
    if let Some(height) = height {
        layer.height = read("height", height, LAYER_HEIGHT, " heights of the dome")?;
    }
    layer.velocity_m_s = velocity_m_s(&layer);
    let [to_east, to_south] = &mut layer.velocity_m_s;
    for (text, value, key) in [
        (east, to_east, "velocity to the east"),
        (south, to_south, "velocity to the south"),
    ] {
        if let Some(text) = text {
            *value = read(key, text, VELOCITY_M_S, " metres a second")?;
        }
    }
    Ok(layer)
}

/// Without a velocity of its own a layer at the height of a usual one of its kind moves as that one does, others as their kind does.
fn velocity_m_s(layer: &LitLayer) -> [f32; 2] {
    let defaults = LitParams::default().layers;
    let like = |other: &&LitLayer| (other.kind, other.height) == (layer.kind, layer.height);
    defaults
        .iter()
        .find(like)
        .map_or(layer.velocity_m_s, |defaults| defaults.velocity_m_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_of_the_usual_layers_stands_for_them() {
        let defaults = LitParams::default().layers;
        assert_eq!(layers(&layers_text(&defaults)), Ok(defaults));
    }

    #[test]
    fn each_layer_has_the_velocity_that_it_is_given() {
        let text = "cumulus:0.5:1:-12.5:0,cirrus:0.5:6:0:200";
        let [low, high, ..] = layers(text).unwrap();
        assert_eq!(low.velocity_m_s, [-12.5, 0.0]);
        assert_eq!(high.velocity_m_s, [0.0, 200.0]);
        assert_eq!(layers_text(&[low, high]), text);
    }

    #[test]
    fn half_a_velocity_and_one_out_of_range_are_refused() {
        for (text, expected) in [
            (
                "cumulus:1:1:5",
                "has a velocity to the east and none to the south",
            ),
            ("cumulus:1:1:5:6:7", "has too many parts"),
            (
                "cumulus:1:1:201:0",
                "the velocity to the east of cumulus is \"201\"",
            ),
            (
                "cumulus:1:1:0:x",
                "the velocity to the south of cumulus is \"x\"",
            ),
        ] {
            let error = layers(text).unwrap_err();
            assert!(error.contains(expected), "{error}");
        }
    }

    #[test]
    fn a_share_that_changes_moves_no_cloud() {
        let [_, higher, ..] = layers("stratocumulus:0.6:1,stratocumulus:0.9:2.1").unwrap();
        assert_eq!(
            higher.velocity_m_s,
            LitParams::default().layers[1].velocity_m_s
        );
    }
}
