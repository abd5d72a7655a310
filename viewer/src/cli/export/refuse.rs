//! Which options go with environment maps and sequences, and which do not.

use clap::ArgMatches;

use super::ExportArgs;
use crate::cli::given::is_given;

impl ExportArgs {
    /// An option that a map or a sequence would not look at, or that cannot hold there, is a mistake, and told.
    ///
    /// # Errors
    /// Which option it is, why it does not hold, and what to do.
    pub fn refuse_others(&self, given: &ArgMatches, rain: f32, flare: f32) -> Result<(), String> {
        if self.is_map() {
            self.refuse_on_maps(given, rain, flare)?;
        }
        let Some(frames) = self.frames else {
            return Ok(());
        };
        if is_given(given, "shadow") {
            return Err(
                "--shadow names one picture, and --frames draws many; leave it out, or draw frames one by one with --at"
                    .to_string(),
            );
        }
        if self.prefiltered {
            return Err(
                "--prefiltered writes two files, and --frames draws many; leave it out, or draw frames one by one with --at"
                    .to_string(),
            );
        }
        match self.shard {
            Some(shard) if shard.count > frames => Err(format!(
                "--shard {}/{} has more parts than --frames {frames} has frames; choose at most {frames} parts",
                shard.index, shard.count
            )),
            _ => Ok(()),
        }
    }

    fn refuse_on_maps(&self, given: &ArgMatches, rain: f32, flare: f32) -> Result<(), String> {
        let (map, sized) = match self.equirect {
            Some(_) => ("--equirect", "its own number is its width"),
            None => ("--cubemap", "its own number is the side of a face"),
        };
        let cases = [
            ("size", true, sized),
            ("elevation", true, "it looks everywhere"),
            ("fov", true, "it looks everywhere"),
            (
                "azimuth",
                self.cubemap.is_some(),
                "its faces look along the axes of the world",
            ),
            (
                "flare",
                flare > 0.0,
                "a lens flare belongs to one camera, and is left out",
            ),
            (
                "starburst",
                true,
                "a lens flare belongs to one camera, and is left out",
            ),
            (
                "rain",
                rain > 0.0,
                "streaks of rain belong to one screen and do not meet across faces",
            ),
            (
                "shadow",
                true,
                "shadows on the ground are drawn with a frame of their own",
            ),
        ];
        let stray = cases
            .iter()
            .find(|(option, matters, _)| *matters && is_given(given, option));
        match stray {
            None => Ok(()),
            Some((option, _, why)) => Err(format!(
                "--{option} does not go with {map}: {why}; leave it out"
            )),
        }
    }
}
