//! `welkin-view render`: one frame of a pack's sky, saved as a picture.

use anyhow::Result;
use welkin_pack::Pack;
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::render;
use welkin_viewer::save::{save, target_for};

use crate::cli::{Method, RenderArgs};

pub fn run(args: &RenderArgs) -> Result<()> {
    // The name is checked before anything slow begins.
    let target = target_for(&args.output)?;
    let pack = Pack::open(&args.pack)?;
    let gpu = Gpu::open()?;
    let frame = match args.method {
        Method::Packed => render(&gpu, &pack, target, &args.view())?,
    };
    save(&args.output, &frame)?;
    Ok(())
}
