//! `welkin-view cube`: anyone's panorama as image-based light.

use std::io::Write;

use anyhow::Result;
use welkin_pack::place::verify_apart;
use welkin_pack::whole::sweep_beside;
use welkin_viewer::export::light::Light;
use welkin_viewer::export::panorama::cubemap;
use welkin_viewer::export::panorama::read::panorama;

use crate::cli::CubeArgs;
use crate::save_light::{json_path, save};
use crate::told::tell_leftovers;

pub fn run(args: &CubeArgs) -> Result<()> {
    verify_apart(&[&args.panorama], &[&args.output, &json_path(&args.output)])?;
    let read = panorama(&args.panorama)?;
    tell_leftovers(&sweep_beside(&args.output));
    let file = args.panorama.display();
    for (count, told) in [
        (
            read.infinite,
            "infinite, and count as 65504, the largest half float",
        ),
        (read.negative, "below 0, and count as 0"),
    ] {
        if count > 0 {
            writeln!(std::io::stderr(), "{file}: {count} texels are {told}").ok();
        }
    }
    let map = cubemap(&read.image, args.size, args.azimuth.to_radians());
    save(&Light::of(map), &args.output, &args.panorama)
}
