//! The panel: what there is to move, built from [`KEYS`].

mod files;
mod layers;
mod rows;

use egui::{Color32, Frame, Margin, Panel, RichText, ScrollArea, Ui};
use welkin_controls::{Group, KEYS, Key, PRESETS};
use welkin_pack::Role;
use welkin_runtime::Method;
use welkin_viewer::pass_times::Part;

use super::keyboard;
use super::state::State;

/// Width of the panel in points.
const WIDTH: f32 = 332.0;

/// The context of a panel.
pub fn context() -> egui::Context {
    let context = egui::Context::default();
    context.set_theme(egui::Theme::Dark);
    context.all_styles_mut(|style| {
        style.spacing.slider_width = 132.0;
        style.visuals.panel_fill = Color32::from_rgba_unmultiplied(14, 16, 20, 244);
        style.visuals.weak_text_alpha = 0.85;
        style.visuals.override_text_color = Some(Color32::from_gray(225));
        style.interaction.selectable_labels = false;
    });
    context
}

/// Shows the panel, unless it is hidden.
pub fn show(ui: &mut Ui, state: &mut State) {
    state.panel_edge_px = 0.0;
    if !state.panel_shown {
        return;
    }
    let fill = ui.visuals().panel_fill;
    let frame = Frame::new().fill(fill).inner_margin(Margin::same(10));
    let panel = Panel::left("panel")
        .exact_size(WIDTH)
        .resizable(false)
        .frame(frame)
        .show(ui, |ui| {
            // At the foot, where they move nothing that a hand is about to take.
            if state.baking.is_some() || !state.notices.is_empty() {
                Panel::bottom("notices")
                    .frame(Frame::new().inner_margin(Margin::symmetric(0, 6)))
                    .resizable(false)
                    .show(ui, |ui| notices(ui, state));
            }
            ScrollArea::vertical()
                .auto_shrink(false)
                .show(ui, |ui| controls(ui, state));
        });
    state.panel_edge_px = f64::from(panel.response.rect.right() * ui.pixels_per_point());
}

fn controls(ui: &mut Ui, state: &mut State) {
    methods(ui, state);
    weathers(ui, state);
    ui.separator();
    group(ui, state, Group::Sky);
    for (title, of) in [
        ("Clouds", Group::Clouds),
        ("Clear sky", Group::Air),
        ("Sun, stars, background", Group::Light),
        ("Weather", Group::Weather),
        ("Time", Group::Time),
        ("Camera", Group::Camera),
    ] {
        let is_open = matches!(of, Group::Light | Group::Time);
        section(ui, title, is_open, |ui| match of {
            Group::Time => time(ui, state),
            Group::Camera => camera(ui, state),
            _ => group(ui, state, of),
        });
    }
    section(ui, "GPU", true, |ui| gpu(ui, state));
    section(ui, "Files", true, |ui| files::show(ui, state));
    section(ui, "Keys", false, keys);
}

/// A section that is open or closed at first.
fn section(ui: &mut Ui, title: &str, is_open: bool, add: impl FnOnce(&mut Ui)) {
    egui::CollapsingHeader::new(title)
        .default_open(is_open)
        .show_unindented(ui, add);
}

fn methods(ui: &mut Ui, state: &mut State) {
    ui.horizontal(|ui| {
        for method in Method::ALL {
            ui.selectable_value(&mut state.settings.params.method, method, method.name())
                .on_hover_text(format!("{}. {}", method.title(), method.paper()));
        }
    });
    let is_missing =
        state.settings.params.method == Method::Sprites && state.source.pack.field().is_none();
    if is_missing {
        ui.colored_label(
            ui.visuals().warn_fg_color,
            "this pack has no clouds in space",
        );
    }
}

fn weathers(ui: &mut Ui, state: &mut State) {
    let mut chosen = None;
    ui.horizontal(|ui| {
        // All six in a row.
        ui.spacing_mut().button_padding.x = 5.0;
        ui.spacing_mut().item_spacing.x = 3.0;
        for preset in &PRESETS {
            let is_on = preset.is(&state.settings);
            let label = ui.selectable_label(is_on, preset.name);
            if label.on_hover_text(preset.help).clicked() {
                chosen = Some(preset);
            }
        }
    });
    if let Some(preset) = chosen {
        state.begin_weather(preset);
    }
}

/// The settings of a group that the method looks at.
fn group(ui: &mut Ui, state: &mut State, group: Group) {
    let has_skybox = state.source.pack.texture(Role::Skybox).is_some();
    // The method has a row of its own.
    let is_shown = |key: &&Key| key.name != "method" && (key.name != "skybox" || has_skybox);
    for key in KEYS
        .iter()
        .filter(|key| key.group == group)
        .filter(is_shown)
    {
        if key.applies(&state.settings) {
            rows::row(ui, key, &mut state.settings);
        }
    }
}

fn time(ui: &mut Ui, state: &mut State) {
    ui.horizontal(|ui| {
        let (word, help) = if state.playing {
            ("Stop", "Time stands")
        } else {
            ("Go on", "Time goes on")
        };
        if ui.button(word).on_hover_text(help).clicked() {
            state.playing = !state.playing;
        }
        for (name, day_length_s) in [("Real time", 0.0), ("Day in a minute", 60.0)] {
            let is_on = state.settings.day_length_s == day_length_s;
            if ui.selectable_label(is_on, name).clicked() {
                state.settings.day_length_s = day_length_s;
            }
        }
    });
    group(ui, state, Group::Time);
}

fn camera(ui: &mut Ui, state: &mut State) {
    ui.checkbox(&mut state.pilot.flying, "Fly (F)");
    if state.pilot.flying {
        let speed = format!("{:.0} m/s, by the wheel", state.pilot.speed_m_s);
        ui.label(speed);
    }
    group(ui, state, Group::Camera);
}

fn gpu(ui: &mut Ui, state: &State) {
    ui.label(RichText::new(&state.adapter).weak());
    egui::Grid::new("times").show(ui, |ui| {
        for part in Part::ALL {
            ui.label(part.name());
            match state.times.pass_ms(part) {
                Some(ms) => ui.monospace(format!("{ms:8.3} ms")),
                None => ui.weak("not told by this device"),
            };
            ui.end_row();
        }
        if let Some(ms) = state.times.frame_ms() {
            ui.label("from frame to frame");
            ui.monospace(format!("{ms:8.3} ms"));
            ui.end_row();
        }
    });
}

fn keys(ui: &mut Ui) {
    egui::Grid::new("keys").show(ui, |ui| {
        for (key, does) in keyboard::HELP {
            ui.monospace(key);
            ui.label(does);
            ui.end_row();
        }
    });
}

fn notices(ui: &mut Ui, state: &mut State) {
    if let Some((step, share)) = state.baking {
        ui.add(egui::ProgressBar::new(share).text(format!("baking: {step}")));
    }
    let mut gone = None;
    for (index, notice) in state.notices.iter().enumerate() {
        let colour = if notice.is_error {
            ui.visuals().error_fg_color
        } else {
            ui.visuals().weak_text_color()
        };
        ui.horizontal_top(|ui| {
            if ui.small_button("×").on_hover_text("Dismiss").clicked() {
                gone = Some(index);
            }
            ui.add(egui::Label::new(RichText::new(&notice.text).color(colour)).wrap());
        });
    }
    if let Some(index) = gone {
        state.notices.remove(index);
    }
}
