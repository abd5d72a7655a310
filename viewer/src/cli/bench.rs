//! The options of `welkin-view bench`.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser};
use clap::{Args, ValueEnum};
use welkin_runtime::params::{SETTINGS, whole_within};
use welkin_runtime::{Method, SkyParams};

use super::gpu::GpuArgs;
use super::values::size;
use crate::bench::scene::SpriteScene;

#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Folder of the pack
    pub pack: PathBuf,
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true, help = size_help())]
    pub size: Option<[u32; 2]>,
    /// Whose skies are timed [default: packed, or the protocol's]
    #[arg(long, value_parser = methods())]
    pub method: Option<Methods>,
    /// Which field of clouds of --method sprites is timed [default: all of them]
    #[arg(long, value_enum)]
    pub scene: Option<SpriteScene>,
    /// Radius of the ring of impostors of --method sprites in metres, 4000 to 60000: small is fast, but shows
    #[arg(long, value_name = "M", value_parser = ring_radius_m, default_value_t = RING_M, allow_hyphen_values = true)]
    pub ring: f32,
    /// Measure as a paper did, which sets method and sizes, and print its figures beside
    #[arg(long, value_enum)]
    pub protocol: Option<Protocol>,
    #[arg(long, value_name = "N", value_parser = frames, allow_hyphen_values = true, help = frames_help())]
    pub frames: Option<u32>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub gpu: GpuArgs,
}

/// Pixels where neither option nor protocol says how many.
const SIZE: [u32; 2] = [1600, 1200];
/// Radius of the ring where the option does not say, in metres: about that of the article whose figure the rows stand beside, and half
/// of a sky's own default.
const RING_M: f32 = 6_000.0;
/// Frames where neither says how many.
const FRAMES: u32 = 100;
/// The most that are asked for.
const MOST_FRAMES: u32 = 100_000;

fn size_help() -> String {
    let [width, height] = SIZE;
    format!("Pixels, width by height [default: {width}x{height}, or the protocol's]")
}

fn frames_help() -> String {
    let theirs = Protocol::Mukhina.frames();
    format!(
        "Frames that are timed, after a warm-up, 1 to {MOST_FRAMES} [default: {FRAMES}; {theirs} with --protocol mukhina]"
    )
}

/// The methods of a benchmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Methods {
    /// One of them.
    One(Method),
    /// Every method, in one table.
    All,
}

/// What is timed of a method.
const fn timed(method: Method) -> &'static str {
    match method {
        Method::Octaves => "Octaves of white noise, with the cost of each count",
        Method::Fbm => "Octaves of smooth noise, with the cost of a sun that moves",
        Method::Lit => {
            "Mukhina and Bezgodov: lit layers, with the cost of one and six, of shadows, rays and rain"
        }
        Method::Sprites => "Wang: clouds in space, with and without the ring of impostors",
        _ => method.title(),
    }
}

fn methods() -> ValueParser {
    let value = |method: Method| PossibleValue::new(method.name()).help(timed(method));
    let all = PossibleValue::new("all").help("Every method, in one table");
    let values = Method::ALL.into_iter().map(value).chain([all]);
    let named = |name: String| {
        let one = Method::ALL.into_iter().find(|one| one.name() == name);
        one.map_or(Methods::All, Methods::One)
    };
    ValueParser::new(PossibleValuesParser::new(values).map(named))
}

impl Methods {
    /// Those that are meant.
    pub fn list(self) -> Vec<Method> {
        match self {
            Methods::One(method) => vec![method],
            Methods::All => Method::ALL.to_vec(),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Methods::One(method) => method.name(),
            Methods::All => "all",
        }
    }
}

/// A measurement that was published.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Protocol {
    /// Mukhina and Bezgodov 2015: mean of 500 frames of lit at 800x600, 1280x720, 1920x1080
    Mukhina,
}

impl Protocol {
    /// Frames of each size.
    pub const fn frames(self) -> u32 {
        match self {
            Protocol::Mukhina => 500,
        }
    }
}

fn frames(text: &str) -> Result<u32, String> {
    whole_within(text, 1..=MOST_FRAMES)
}

/// As the setting takes it.
fn ring_radius_m(text: &str) -> Result<f32, String> {
    let mut params = SkyParams::default();
    for ring in SETTINGS.iter().filter(|row| row.words.name == "ring") {
        ring.read(&mut params, text)?;
    }
    Ok(params.sprites.ring_radius_m)
}

impl BenchArgs {
    /// Pixels of a frame without a protocol.
    pub fn size(&self) -> [u32; 2] {
        self.size.unwrap_or(SIZE)
    }

    /// Methods without a protocol.
    pub fn methods(&self) -> Vec<Method> {
        self.method.map_or(vec![Method::Packed], Methods::list)
    }

    /// Frames that are timed.
    pub fn frames(&self) -> u32 {
        let defaults = self.protocol.map_or(FRAMES, Protocol::frames);
        self.frames.unwrap_or(defaults)
    }

    /// What a protocol sets cannot be set again.
    ///
    /// # Errors
    /// Which option it is, and what the protocol says.
    pub fn refuse_others(&self) -> Result<(), String> {
        if self.scene.is_some() && self.method != Some(Methods::One(Method::Sprites)) {
            return Err(
                "--scene belongs to --method sprites; leave it out or say --method sprites"
                    .to_string(),
            );
        }
        if self.protocol.is_none() {
            return Ok(());
        }
        if let Some([width, height]) = self.size {
            return Err(format!(
                "--size {width}x{height} does not go with --protocol mukhina, whose sizes are 800x600, 1280x720 \
                 and 1920x1080; leave out one of the two"
            ));
        }
        match self.method {
            None | Some(Methods::One(Method::Lit)) => Ok(()),
            Some(other) => Err(format!(
                "--method {} does not go with --protocol mukhina, which times lit; leave out --method, or the protocol",
                other.name()
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::cli::{Cli, Command};

    use super::*;

    fn read(words: &[&str]) -> Result<BenchArgs, String> {
        match Cli::read(["welkin-view", "bench", "pack"].iter().chain(words)).map(|c| c.command) {
            Ok(Some(Command::Bench(args))) => Ok(args),
            Ok(other) => panic!("{words:?}: {other:?}"),
            Err(error) => Err(error.to_string()),
        }
    }

    #[test]
    fn a_benchmark_is_of_one_method_or_of_all() {
        let of = |words: &[&str]| read(words).unwrap().methods();
        assert_eq!(of(&[]), [Method::Packed]);
        assert_eq!(of(&["--method", "all"]), Method::ALL);
        for method in Method::ALL {
            assert_eq!(of(&["--method", method.name()]), [method]);
        }
        let error = read(&["--method", "volumes"]).unwrap_err();
        assert!(
            error.contains("packed, octaves, fbm, lit, sprites, all"),
            "{error}"
        );
    }

    #[test]
    fn a_scene_is_of_sprites() {
        let words = ["--method", "sprites", "--scene", "overcast"];
        assert_eq!(read(&words).unwrap().scene, Some(SpriteScene::Overcast));
        let error = read(&["--scene", "sparse"]).unwrap_err();
        assert!(
            error.contains("--scene belongs to --method sprites"),
            "{error}"
        );
        let error = read(&["--method", "sprites", "--scene", "foggy"]).unwrap_err();
        assert!(error.contains("sparse, broken, overcast"), "{error}");
    }

    #[test]
    fn the_frames_of_a_benchmark_have_a_range() {
        for frames in ["0", "100001", "-1", "many"] {
            let error = read(&["--frames", frames]).unwrap_err();
            assert!(error.contains("--frames"), "{error}");
        }
    }

    #[test]
    fn a_protocol_sets_how_many_frames_unless_they_are_given() {
        let frames = |words: &[&str]| read(words).unwrap().frames();
        assert_eq!(frames(&[]), FRAMES);
        assert_eq!(frames(&["--protocol", "mukhina"]), 500);
        assert_eq!(frames(&["--protocol", "mukhina", "--frames", "7"]), 7);
        assert!(read(&["--protocol", "mukhina", "--method", "lit"]).is_ok());
    }

    #[test]
    fn what_the_protocol_sets_cannot_be_set_again() {
        for method in ["packed", "octaves", "fbm", "all"] {
            let error = read(&["--protocol", "mukhina", "--method", method]).unwrap_err();
            let told =
                format!("--method {method} does not go with --protocol mukhina, which times lit");
            assert!(error.contains(&told), "{error}");
            assert!(error.contains("Usage: welkin-view bench"), "{error}");
        }
        // The default size too, if it is said.
        for size in ["640x480", "1600x1200"] {
            let error = read(&["--protocol", "mukhina", "--size", size]).unwrap_err();
            let told = format!("--size {size} does not go with --protocol mukhina");
            assert!(
                error.contains(&told) && error.contains("1920x1080"),
                "{error}"
            );
        }
    }

    #[test]
    fn an_unknown_protocol_is_answered_with_those_that_there_are() {
        let error = read(&["--protocol", "quilez"]).unwrap_err();
        assert!(error.contains("'quilez' for '--protocol"), "{error}");
        assert!(error.contains("[possible values: mukhina]"), "{error}");
    }
}
