//! The options of `welkin-view cube`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use welkin_runtime::params::within;

use super::export::{is_ktx2, side, sides};

#[derive(Debug, Args)]
pub struct CubeArgs {
    /// Panorama of the whole sky (equirectangular, twice as wide as high): Radiance HDR or OpenEXR, linear
    #[arg(value_name = "IMAGE.hdr|.exr")]
    pub panorama: PathBuf,
    /// Cube map to write; the JSON beside it ends in .json. Files of these names are replaced
    #[arg(short, long, value_name = "CUBE.ktx2", value_parser = PathBufValueParser::new().try_map(ktx2_name))]
    pub output: PathBuf,
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = side, allow_hyphen_values = true, help = size_help())]
    pub size: u32,
    /// Azimuth in the middle of the panorama, from north (0) towards east (90), in degrees, -360 to 360
    #[arg(long, value_name = "DEG", default_value_t = 0.0, value_parser = azimuth, allow_hyphen_values = true)]
    pub azimuth: f32,
}

fn size_help() -> String {
    format!("Texels a side of a face, {}", sides())
}

fn ktx2_name(file: PathBuf) -> Result<PathBuf, String> {
    if is_ktx2(&file) {
        return Ok(file);
    }
    Err("expected a name that ends in .ktx2".to_string())
}

fn azimuth(text: &str) -> Result<f32, String> {
    within(text, -360.0..=360.0, " degrees")
}

#[cfg(test)]
mod tests {
    use crate::cli::{Cli, Command};

    fn read(words: &[&str]) -> Result<super::CubeArgs, String> {
        let command = ["welkin-view", "cube", "sky.hdr"];
        match Cli::read(command.iter().chain(words)).map(|cli| cli.command) {
            Ok(Some(Command::Cube(args))) => Ok(args),
            Ok(other) => panic!("{words:?}: {other:?}"),
            Err(error) => Err(error.to_string()),
        }
    }

    #[test]
    fn a_panorama_and_a_name_are_enough() {
        let args = read(&["-o", "sky.KTX2"]).unwrap();
        assert_eq!((args.size, args.azimuth), (256, 0.0));
        let args = read(&["-o", "c.ktx2", "--size", "64", "--azimuth", "-90"]).unwrap();
        assert_eq!((args.size, args.azimuth), (64, -90.0));
    }

    #[test]
    fn what_does_not_suit_is_refused_with_what_does() {
        for (words, told) in [
            (&["-o", "c.exr"][..], "ends in .ktx2"),
            (&[], "--output"),
            (
                &["-o", "c.ktx2", "--size", "100"],
                "a power of two from 16 to 2048",
            ),
            (&["-o", "c.ktx2", "--azimuth", "361"], "-360 to 360 degrees"),
        ] {
            let error = read(words).unwrap_err();
            assert!(error.contains(told), "{words:?}: {error}");
        }
    }
}
