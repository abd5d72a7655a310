//! Draws a sequence into a folder, frame by frame.

use std::io::Write;
use std::path::Path;

use anyhow::{Result, bail};
use indicatif::{ProgressBar, ProgressStyle};
use welkin_pack::interrupt;
use welkin_pack::whole::{sweep, write_file};
use welkin_viewer::export::sequence::{Sequence, open_folder, path};
use welkin_viewer::headless::View;

use super::artist::{Artist, Encoded};
use crate::told::tell_leftovers;

/// Draws the frames of a part, and replaces those that are there. Every frame appears whole or not at all, so what was drawn before an
/// interruption can stay.
pub fn draw(
    mut artist: Artist<'_>,
    view: &View,
    sequence: &Sequence,
    (folder, extension): (&Path, &str),
) -> Result<()> {
    open_folder(folder)?;
    tell_leftovers(&sweep(folder));
    interrupt::listen()?;
    let numbers = sequence.numbers();
    let bar = progress(numbers.len() as u64);
    let count = numbers.len();
    for (done, number) in numbers.enumerate() {
        if interrupt::requested() {
            bar.abandon();
            bail!(
                "interrupted: {done} of {count} frames are drawn; run it again to draw them anew"
            );
        }
        let file = path(folder, number, extension);
        let moment = View {
            seconds: sequence.seconds(number),
            ..view.clone()
        };
        let change = sequence.change(number);
        let drawn = artist.draw(&moment, change.as_ref(), &file.display().to_string())?;
        if let Encoded::File(bytes) = drawn {
            write_file(&file, &bytes, &|| false)?;
        }
        bar.inc(1);
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

/// A bar on standard error if that is a terminal, and nothing elsewhere.
fn progress(frames: u64) -> ProgressBar {
    let bar = ProgressBar::new(frames);
    if let Ok(style) = ProgressStyle::with_template("{bar:24} {pos}/{len} frames, {eta} left") {
        bar.set_style(style);
    }
    bar
}
