//! `welkin-view bench`: milliseconds of a frame, of each method and of the reference passes, in one run.
//!
//! The frames take turns, one after another, so that a change of the GPU's clock meets all of them alike.
//! Each sky is prepared anew for each of its frames, a sixtieth of a second after the last, so that nothing
//! off screen is left from the frame before. docs/json.md tells what `--json` prints.

mod measure;
mod mukhina;
mod report;
pub mod scene;

use anyhow::Result;
use welkin_pack::Pack;
use welkin_viewer::gpu::{Gpu, GpuError};

use crate::cli::{BenchArgs, Protocol};
use crate::told;
use measure::{WARM_UP_FRAMES, clock, measure};
use report::Report;
use scene::{scenes, scenes_of_sprites};

pub fn run(args: &BenchArgs) -> Result<()> {
    let pack = Pack::open(&args.pack)?;
    let gpu = Gpu::open(args.gpu.gpu.as_ref())?;
    let text = match args.protocol {
        None => print(args, &report(&gpu, &pack, args)?, Report::table),
        Some(Protocol::Mukhina) => print(
            args,
            &mukhina::report(&gpu, &pack, args.frames())?,
            mukhina::Report::table,
        ),
    }?;
    told::print(&text)
}

/// A report as the options want it.
fn print<R: serde::Serialize>(
    args: &BenchArgs,
    report: &R,
    table: fn(&R) -> String,
) -> Result<String> {
    Ok(if args.json {
        serde_json::to_string_pretty(report)? + "\n"
    } else {
        table(report)
    })
}

fn report(gpu: &Gpu, pack: &Pack, args: &BenchArgs) -> Result<Report, GpuError> {
    let scenes = match args.scene {
        Some(of) => scenes_of_sprites(of, args.ring).into(),
        None => {
            let of = |method| scenes(method, args.ring);
            args.methods().into_iter().flat_map(of).collect()
        }
    };
    Ok(Report {
        adapter: gpu.adapter.clone(),
        clock: clock(gpu),
        size: args.size(),
        frames: args.frames(),
        warm_up_frames: WARM_UP_FRAMES,
        passes: measure(gpu, pack, scenes, args.size(), args.frames())?,
    })
}
