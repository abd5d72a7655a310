//! `welkin-view render`: one frame of a pack's sky, saved as a picture.

use anyhow::{Result, ensure};
use welkin_pack::{Pack, Role};
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::render;
use welkin_viewer::save::{save, target_for};

use crate::cli::RenderArgs;

pub fn run(args: &RenderArgs) -> Result<()> {
    // The name is checked before anything slow begins.
    let target = target_for(&args.output)?;
    let pack = Pack::open(&args.pack)?;
    ensure!(
        args.light.skybox.is_none() || pack.texture(Role::Skybox).is_some(),
        "{}: has no skybox, so --skybox changes nothing; leave it out, or bake a pack from a recipe with a [skybox] table",
        args.pack.display()
    );
    let gpu = Gpu::open()?;
    let frame = render(&gpu, &pack, target, &args.view())?;
    save(&args.output, &frame)?;
    Ok(())
}
