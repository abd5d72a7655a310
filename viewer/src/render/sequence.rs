//! Draws a sequence into a folder, frame by frame.

use std::io::Write;
use std::path::Path;

use anyhow::{Result, bail};
use welkin_pack::interrupt;
use welkin_pack::whole::{sweep, write_file};
use welkin_viewer::export::sequence::{Sequence, open_folder, path};
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::View;

use super::artist::{Artist, Encoded};
use super::pipeline::{Next, overlap};
use super::progress::progress;
use crate::cli::Shot;
use crate::told::tell_leftovers;

/// Draws the frames of a part, and replaces those that are there. Every frame appears whole or not at all, so what was drawn before an
/// interruption can stay.
pub fn draw(
    gpu: &Gpu,
    artist: &mut Artist<'_>,
    (shot, azimuth_rad): (Shot, f32),
    view: &View,
    sequence: &Sequence,
    folder: &Path,
) -> Result<()> {
    open_folder(folder)?;
    tell_leftovers(&sweep(folder));
    interrupt::listen()?;
    let mut numbers = sequence.numbers();
    let count = numbers.len();
    let bar = progress(Some(count as u64), "frames");
    let mut done = 0;
    overlap(
        |_| {
            let next = numbers.next().filter(|_| !interrupt::requested());
            let Some(number) = next else {
                return Ok(Next::End);
            };
            let moment = View {
                seconds: sequence.seconds(number),
                ..view.clone()
            };
            let change = sequence.change(number);
            let drawing = artist.begin(shot, azimuth_rad, &moment, change.as_ref())?;
            Ok(Next::Begun((number, drawing)))
        },
        |(number, drawing)| Ok((number, drawing.wait(gpu)?)),
        |(number, picture)| {
            let file = path(folder, number, shot.extension());
            if let Encoded::File(bytes) = picture.encode(&file.display().to_string())? {
                write_file(&file, &bytes, &|| false)?;
            }
            Ok(())
        },
        |()| {
            done += 1;
            bar.inc(1);
            Ok(())
        },
    )?;
    if done < count {
        bar.abandon();
        bail!("interrupted: {done} of {count} frames are drawn; run it again to draw them anew");
    }
    bar.finish_and_clear();
    writeln!(
        std::io::stderr(),
        "{}: {count} frames drawn",
        folder.display()
    )
    .ok();
    Ok(())
}
