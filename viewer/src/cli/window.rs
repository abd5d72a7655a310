//! The options of the window.

use std::path::PathBuf;

use clap::Args;

use super::gpu::GpuArgs;
use super::values::size;

/// What `welkin-view` without a command takes.
#[derive(Debug, Default, Args)]
pub struct WindowArgs {
    /// Pack to look at in a window; without one, that of the built-in recipe
    pub pack: Option<PathBuf>,
    /// Bake this recipe now and each time that it is saved, in the background, and show the new sky once it is sound. With PACK, it is
    /// written there too, over the pack that is there
    #[arg(long, value_name = "RECIPE.toml")]
    pub watch: Option<PathBuf>,
    /// File of settings to begin with, if it is there, and to save to
    #[arg(long, value_name = "SETTINGS.toml")]
    pub settings: Option<PathBuf>,
    /// Size of the window in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x800", value_parser = size, allow_hyphen_values = true)]
    pub window_size: [u32; 2],
    #[command(flatten)]
    pub gpu: GpuArgs,
}
