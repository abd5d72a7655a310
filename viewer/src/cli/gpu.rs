//! The option that chooses a GPU.

use std::str::FromStr;

use clap::Args;
use welkin_viewer::wanted::Wanted;

#[derive(Debug, Default, Args)]
pub struct GpuArgs {
    /// GPU to draw with, by its number or PCI bus id as `welkin-view gpus` lists them [default: the fastest]
    #[arg(long, value_name = "N|BUS-ID", value_parser = Wanted::from_str, allow_hyphen_values = true)]
    pub gpu: Option<Wanted>,
}
