//! What the panel and the keys ask for, carried out.

use std::path::{Path, PathBuf};

use anyhow::Result;
use welkin_pack::Overwrite;
use welkin_pack::whole::write_file;
use winit::window::Fullscreen;

use super::app::App;
use super::state::{Wish, read_settings};
use super::{command, shot};

impl App {
    /// Carries a wish out, and tells what was done.
    pub(super) fn fulfil(&mut self, wish: Wish) -> Result<Option<String>> {
        let Some(graphics) = &mut self.graphics else {
            return Ok(None);
        };
        let state = &mut self.state;
        let size_px = graphics.size_px();
        match wish {
            Wish::SaveSettings => {
                let file = state.files.settings.clone();
                let text = state.settings.to_toml();
                write_file(Path::new(&file), text.as_bytes(), &|| false)?;
                return Ok(Some(format!("{file}: settings saved")));
            }
            Wish::LoadSettings => {
                let file = state.files.settings.clone();
                state.settings = read_settings(Path::new(&file))?;
                state.blend = None;
                return Ok(Some(format!("{file}: settings loaded")));
            }
            Wish::SavePicture => {
                let file = state.files.picture.clone();
                let pack = &state.source.pack;
                let place = Path::new(&file);
                shot::take(&graphics.gpu, pack, &state.settings, size_px, place)?;
                return Ok(Some(format!("{file}: picture saved")));
            }
            Wish::CopyCommand => {
                let folder = state.source.folder.clone();
                let folder = folder.unwrap_or_else(|| state.files.pack.clone().into());
                let picture = &state.files.picture;
                let text = command::render(&folder, picture, size_px, &state.settings);
                graphics.egui.set_clipboard_text(text.clone());
                let unsaved = if state.source.is_saved {
                    ""
                } else {
                    "; save the pack there first"
                };
                return Ok(Some(format!("copied{unsaved}: {text}")));
            }
            Wish::SavePack => {
                let folder = PathBuf::from(&state.files.pack);
                let source = &mut state.source;
                let left = source.pack.save(&folder, Overwrite::Replace, &|| false)?;
                (source.folder, source.is_saved) = (Some(folder), true);
                let left: String = left.iter().map(|left| format!("; {left}")).collect();
                return Ok(Some(format!("{}: pack saved{left}", state.files.pack)));
            }
            // It goes the way of a device that was lost.
            Wish::RestartGraphics => graphics.gpu.device.destroy(),
            Wish::ToggleFullscreen => {
                let is_full = graphics.window.fullscreen().is_some();
                let full = (!is_full).then_some(Fullscreen::Borderless(None));
                graphics.window.set_fullscreen(full);
            }
        }
        Ok(None)
    }
}
