//! Files: settings, pictures, the pack.

use egui::{RichText, TextEdit, Ui};

use crate::window::state::{State, Wish};

pub fn show(ui: &mut Ui, state: &mut State) {
    let pack = &state.source.pack;
    let bytes: usize = pack.files().iter().map(|(_, bytes)| bytes.len()).sum();
    let kept = if state.source.is_saved {
        ""
    } else {
        ", not saved"
    };
    let name = &pack.manifest().name;
    let megabytes = bytes as f64 / 1e6;
    ui.label(RichText::new(format!("pack \"{name}\", {megabytes:.2} MB{kept}")).weak());
    let files = &mut state.files;
    let mut wishes = Vec::new();
    file(
        ui,
        &mut files.settings,
        &[("Save", Wish::SaveSettings), ("Load", Wish::LoadSettings)],
        &mut wishes,
    );
    file(
        ui,
        &mut files.picture,
        &[("Picture", Wish::SavePicture)],
        &mut wishes,
    );
    file(
        ui,
        &mut files.pack,
        &[("Save pack", Wish::SavePack)],
        &mut wishes,
    );
    ui.horizontal(|ui| {
        for (name, help, wish) in [
            (
                "Copy command",
                "Copies the command line that draws this picture",
                Wish::CopyCommand,
            ),
            (
                "Restart graphics",
                "Opens the GPU anew, after its driver changed or its pictures went wrong",
                Wish::RestartGraphics,
            ),
        ] {
            if ui.button(name).on_hover_text(help).clicked() {
                wishes.push(wish);
            }
        }
    });
    ui.weak("Drop a photograph, a pack's folder or settings here.");
    state.wishes.extend(wishes);
}

/// A field for a name, and what can be done with it.
fn file(ui: &mut Ui, name: &mut String, buttons: &[(&str, Wish)], wishes: &mut Vec<Wish>) {
    ui.horizontal(|ui| {
        ui.add(TextEdit::singleline(name).desired_width(150.0));
        for (text, wish) in buttons {
            if ui.button(*text).clicked() {
                wishes.push(*wish);
            }
        }
    });
}
