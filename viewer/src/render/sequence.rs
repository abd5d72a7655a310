//! Draws a sequence into a folder, frame by frame.

use std::io::Write;
use std::path::Path;

use anyhow::{Result, bail};
use indicatif::{ProgressBar, ProgressStyle};
use welkin_viewer::export::sequence::{Sequence, open_folder, path};
use welkin_viewer::headless::View;
use welkin_viewer::save::{Format, save_bytes};

use super::artist::{Artist, Encoded};
use crate::interrupt;

/// Draws the frames of a part, and replaces those that are there. Every frame appears whole or not at all, so what was drawn before an
/// interruption can stay.
pub fn draw(
    mut artist: Artist<'_>,
    view: &View,
    sequence: &Sequence,
    (folder, extension): (&Path, &str),
) -> Result<()> {
    let pictures = Format::ALL.map(Format::extension);
    open_folder(folder, &[&pictures[..], &["ktx2"]].concat())?;
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
        if let Encoded::File(bytes) = artist.draw(&moment, &file.display().to_string())? {
            save_bytes(&file, &bytes)?;
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
