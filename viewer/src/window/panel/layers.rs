//! The layers of clouds: a row each.

use egui::{ComboBox, DragValue, Ui};
use welkin_controls::{Key, Settings};
use welkin_pack::LayerKind;
use welkin_runtime::params::LitLayer;
use welkin_runtime::params::MAX_LAYERS;

/// The least share, with which a layer is still there.
const LEAST_SHARE: f32 = 0.01;

pub fn show(ui: &mut Ui, key: &Key, settings: &mut Settings) {
    ui.label(key.label).on_hover_text(key.help);
    let layers = &mut settings.params.lit.layers;
    let count = layers.iter().filter(|layer| layer.share > 0.0).count();
    let (mut is_settled, mut gone) = (false, None);
    for (index, layer) in layers[..count].iter_mut().enumerate() {
        ui.horizontal(|ui| {
            is_settled |= row(ui, index, layer);
            if count > 1 && ui.small_button("×").on_hover_text("Leave it out").clicked() {
                gone = Some(index);
            }
        });
        ui.horizontal(|ui| is_settled |= velocity(ui, layer));
    }
    if let Some(index) = gone {
        layers[index].share = 0.0;
        is_settled = true;
    }
    if count < MAX_LAYERS && ui.small_button("+ layer").clicked() {
        layers[count] = LitLayer::of(LayerKind::Cumulus, 0.3);
        is_settled = true;
    }
    if is_settled {
        // Brought into the order of their heights only now: a row does not leave the pointer that drags it.
        let text = key.text(settings);
        key.set(settings, &text).ok();
    }
}

/// A layer's row; whether the person has ended a change.
fn row(ui: &mut Ui, index: usize, layer: &mut LitLayer) -> bool {
    let mut is_settled = false;
    ComboBox::from_id_salt(("kind", index))
        .width(110.0)
        .selected_text(layer.kind.name())
        .show_ui(ui, |ui| {
            for kind in LayerKind::ALL {
                is_settled |= ui
                    .selectable_value(&mut layer.kind, kind, kind.name())
                    .changed();
            }
        });
    if is_settled {
        layer.velocity_m_s = LitLayer::of(layer.kind, layer.share).velocity_m_s;
    }
    let share = DragValue::new(&mut layer.share)
        .range(LEAST_SHARE..=1.0)
        .speed(0.005)
        .max_decimals(3);
    let height = DragValue::new(&mut layer.height)
        .range(0.1..=20.0)
        .speed(0.02)
        .max_decimals(3);
    let share = ui.add(share).on_hover_text("Its part in the cover");
    let height = ui
        .add(height)
        .on_hover_text("Where it floats, in heights of the dome");
    is_settled
        || [share, height]
            .iter()
            .any(|r| r.drag_stopped() || r.lost_focus())
}

/// Where a layer goes; whether the person has ended a change.
fn velocity(ui: &mut Ui, layer: &mut LitLayer) -> bool {
    ui.label("m/s to east, south")
        .on_hover_text("Where it goes at speed 1");
    let mut is_settled = false;
    for value in &mut layer.velocity_m_s {
        let drag = DragValue::new(value).range(-200.0..=200.0).speed(0.5);
        let response = ui.add(drag.max_decimals(1));
        is_settled |= response.drag_stopped() || response.lost_focus();
    }
    is_settled
}
