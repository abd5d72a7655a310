//! A row of the panel for each kind of setting.

use egui::{ComboBox, DragValue, Response, Sense, Slider, SliderClamping, Ui};
use welkin_controls::{Input, Key, Settings};

use super::layers;

/// What the five numbers begin with: the clear sky of low turbidity, standard sky 12 of ISO 15469:2004.
const USUAL_PEREZ: &str = "-1,-0.32,10,-3,0.45";

/// Width of the names in points.
const NAMES: f32 = 92.0;

/// A row: the name, which gives the usual value back at a double click, and what moves the value.
pub fn row(ui: &mut Ui, key: &Key, settings: &mut Settings) {
    if key.input == Input::Layers {
        layers::show(ui, key, settings);
        return;
    }
    ui.horizontal(|ui| {
        if name(ui, key).double_clicked() {
            put(settings, key, &key.text(&Settings::default()));
        }
        value(ui, key, settings);
    });
}

fn name(ui: &mut Ui, key: &Key) -> Response {
    let label = egui::Label::new(key.label).sense(Sense::click());
    let size = egui::vec2(NAMES, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(
        size,
        egui::Layout::left_to_right(egui::Align::Center),
        |ui| {
            ui.set_min_width(NAMES);
            ui.add(label)
        },
    )
    .inner
    .on_hover_text(format!("{}. Double click: the usual value", key.help))
}

fn value(ui: &mut Ui, key: &Key, settings: &mut Settings) {
    let text = key.text(settings);
    match key.input {
        Input::Slider {
            low,
            high,
            logarithmic,
            whole,
            unit,
        } => {
            let mut number = text.parse().unwrap_or(low);
            // The flare is on or off for most.
            let is_switched = key.name == "flare" && switch(ui, &mut number, high);
            let mut slider = Slider::new(&mut number, low..=high)
                .logarithmic(logarithmic)
                .smallest_positive(0.1)
                // A number that moves by itself is left as it is.
                .clamping(SliderClamping::Edits)
                .max_decimals(3);
            if whole {
                slider = slider.integer();
            }
            let response = ui.add(slider);
            if response.changed() || is_switched {
                put(settings, key, &number.to_string());
            }
            if !unit.is_empty() {
                response.on_hover_text(unit);
            }
        }
        Input::Switch => {
            let mut is_on = text == "true";
            if ui.checkbox(&mut is_on, "").changed() {
                put(settings, key, &is_on.to_string());
            }
        }
        Input::Choice { choices, .. } => choice(ui, key, settings, choices),
        Input::Numbers {
            ranges, optional, ..
        } => numbers(ui, key, settings, ranges, optional),
        Input::Colour => colour(ui, key, settings),
        _ => field(ui, key, settings),
    }
}

/// A switch before a slider: off is 0. Whether it was used.
fn switch(ui: &mut Ui, number: &mut f64, on: f64) -> bool {
    let mut is_on = *number > 0.0;
    let is_switched = ui.checkbox(&mut is_on, "").changed();
    if is_switched {
        *number = if is_on { on } else { 0.0 };
    }
    is_switched
}

fn choice(ui: &mut Ui, key: &Key, settings: &mut Settings, choices: &[&str]) {
    let text = key.text(settings);
    ComboBox::from_id_salt(key.name)
        .selected_text(&text)
        .show_ui(ui, |ui| {
            for choice in choices {
                if ui.selectable_label(*choice == text, *choice).clicked() {
                    put(settings, key, choice);
                }
            }
        });
}

fn numbers(
    ui: &mut Ui,
    key: &Key,
    settings: &mut Settings,
    ranges: &[[f64; 2]],
    is_optional: bool,
) {
    let text = key.text(settings);
    let read = |text: &str| -> Option<Vec<f64>> {
        text.split(',').map(|part| part.parse().ok()).collect()
    };
    let mut numbers = read(&text);
    if is_optional {
        let mut is_on = numbers.is_some();
        if ui.checkbox(&mut is_on, "").changed() {
            let text = if is_on { USUAL_PEREZ } else { "none" };
            put(settings, key, text);
            numbers = read(text);
        }
    }
    let Some(mut numbers) = numbers else {
        return;
    };
    let mut is_changed = false;
    for (number, [low, high]) in numbers.iter_mut().zip(ranges) {
        let drag = DragValue::new(number)
            .range(*low..=*high)
            .speed((high - low) / 200.0)
            .max_decimals(3);
        is_changed |= ui.add(drag).changed();
    }
    if is_changed {
        let texts: Vec<String> = numbers.iter().map(|n| (*n as f32).to_string()).collect();
        put(settings, key, &texts.join(","));
    }
}

fn colour(ui: &mut Ui, key: &Key, settings: &mut Settings) {
    let text = key.text(settings);
    let mut parts = text.split(',').map(|part| part.parse().unwrap_or(0.0));
    let mut colour: [f32; 3] = std::array::from_fn(|_| parts.next().unwrap_or(0.0));
    if ui.color_edit_button_rgb(&mut colour).changed() {
        let [r, g, b] = colour.map(|part| part.clamp(0.0, 1.0));
        put(settings, key, &format!("{r},{g},{b}"));
    }
}

/// Text that is taken when the person has ended it, if it means something.
fn field(ui: &mut Ui, key: &Key, settings: &mut Settings) {
    let id = ui.make_persistent_id(key.name);
    let kept = ui.data(|data| data.get_temp::<String>(id));
    let mut text = kept.unwrap_or_else(|| key.text(settings));
    let response = ui.add(egui::TextEdit::singleline(&mut text).desired_width(f32::INFINITY));
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text));
    } else if response.lost_focus() {
        put(settings, key, &text);
        ui.data_mut(|data| data.remove::<String>(id));
    }
}

/// What is out of range stays as it was: a slider has no such value, and half a number is none.
fn put(settings: &mut Settings, key: &Key, text: &str) {
    key.set(settings, text).ok();
}
