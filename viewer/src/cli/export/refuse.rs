//! Which options go with environment maps and sequences, and which do not.

use clap::ArgMatches;
use welkin_viewer::export::sequence::MOST_FRAMES;

use super::ExportArgs;
use crate::cli::given::is_given;
use crate::cli::on_map::stray_on_map;

impl ExportArgs {
    /// An option that a map or a sequence would not look at, or that cannot hold there, is a mistake, and told.
    ///
    /// # Errors
    /// Which option it is, why it does not hold, and what to do.
    pub fn refuse_others(&self, given: &ArgMatches, rain: f32, flare: f32) -> Result<(), String> {
        if self.is_map() {
            self.refuse_on_maps(given, rain, flare)?;
        }
        let Some(frames) = self.count() else {
            return Ok(());
        };
        let sequence = self.sequence_option();
        if is_given(given, "shadow") {
            return Err(format!(
                "--shadow names one picture, and {sequence} draws many; leave it out, or draw frames one by one with --at"
            ));
        }
        if self.prefiltered {
            return Err(format!(
                "--prefiltered writes two files, and {sequence} draws many; leave it out, or draw frames one by one with --at"
            ));
        }
        if let Some(seconds) = self.loop_s {
            self.refuse_in_loop(given, seconds, frames)?;
        }
        match self.shard {
            Some(shard) if shard.count > frames => Err(format!(
                "--shard {}/{} has more parts than {sequence} has frames ({frames}); choose at most {frames} parts",
                shard.index, shard.count
            )),
            _ => Ok(()),
        }
    }

    fn refuse_in_loop(&self, given: &ArgMatches, seconds: f64, frames: u32) -> Result<(), String> {
        if is_given(given, "lightning") {
            return Err(
                "--lightning is one flash at one moment, and --loop shows two moments at once, before and after it; leave it out, or take --frames"
                    .to_string(),
            );
        }
        let fps = self.fps();
        match frames {
            0 | 1 => Err(format!(
                "--loop {seconds} at {fps} frames a second has less than 2 frames; choose a longer loop, or a larger --fps"
            )),
            2..=MOST_FRAMES => Ok(()),
            _ => Err(format!(
                "--loop {seconds} at {fps} frames a second has more than {MOST_FRAMES} frames; choose a shorter loop, or a smaller --fps"
            )),
        }
    }

    fn refuse_on_maps(&self, given: &ArgMatches, rain: f32, flare: f32) -> Result<(), String> {
        let map = match self.equirect {
            Some(_) => "--equirect",
            None => "--cubemap",
        };
        let is_given = |option: &str| is_given(given, option);
        match stray_on_map(self.cubemap.is_some(), is_given, rain, flare) {
            None => Ok(()),
            Some((option, why)) => Err(format!(
                "--{option} does not go with {map}: {why}; leave it out"
            )),
        }
    }
}
