//! A picture of the sky, drawn as `welkin-view render` draws it: without the panel, and with nothing kept from earlier frames.

use std::path::Path;

use anyhow::Result;
use welkin_controls::Settings;
use welkin_pack::Pack;
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::{View, render};
use welkin_viewer::save::{save, target_for};

/// Draws and saves it, in the format that the name says.
///
/// # Errors
/// A name without a format, a device or a disk that fails.
pub fn take(
    gpu: &Gpu,
    pack: &Pack,
    settings: &Settings,
    size_px: [u32; 2],
    file: &Path,
) -> Result<()> {
    let view = View {
        params: settings.frame_params(),
        camera: settings.camera(size_px),
        seconds: settings.at_s,
    };
    let drawn = render(gpu, pack, target_for(file)?, &view)?;
    Ok(save(file, &drawn.frame)?)
}
