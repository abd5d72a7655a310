//! The options of the clear sky's model.

use clap::{ArgMatches, Args, ValueEnum};
use welkin_runtime::internals::clear_sky::cie::LAST_OVERCAST;
use welkin_runtime::params::{PerezParams, PerezShape, SkyModel};

use super::values::{cie_type, perez, perez_ranges, turbidity};
use super::{belongs, is_given};

/// What only the Perez sky knows: see [`OWN`].
#[derive(Debug, Args)]
#[command(next_help_heading = "Clear sky")]
pub struct ClearSkyArgs {
    /// How the clear sky is computed
    #[arg(long, value_enum, default_value_t = SkyName::Gradient)]
    pub sky: SkyName,
    /// perez: haze in the air, 1.7 (clear) to 10 (thick)
    #[arg(long, value_name = "T", default_value_t = PerezParams::default().turbidity, value_parser = turbidity, allow_hyphen_values = true)]
    pub turbidity: f32,
    /// perez: luminance of a standard sky of ISO 15469, 1 (overcast) to 12 (clear) to 15 [default: by the turbidity]
    #[arg(long, value_name = "N", value_parser = cie_type, allow_hyphen_values = true, conflicts_with = "perez")]
    pub cie: Option<u8>,
    #[arg(long, value_name = "A,B,C,D,E", value_parser = perez, allow_hyphen_values = true, help = perez_help())]
    pub perez: Option<[f32; 5]>,
}

/// How the clear sky is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SkyName {
    /// The pack's day gradient, with light scattered around the sun
    Gradient,
    /// Perez's distribution of light around sun and zenith, in Preetham's colours
    Perez,
}

impl From<SkyName> for SkyModel {
    fn from(name: SkyName) -> SkyModel {
        match name {
            SkyName::Gradient => SkyModel::Gradient,
            SkyName::Perez => SkyModel::Perez,
        }
    }
}

fn perez_help() -> String {
    format!(
        "perez: luminance by five numbers of one's own, {} [default: by the turbidity]",
        perez_ranges()
    )
}

/// The options that --sky gradient does not look at.
const OWN: [&str; 3] = ["turbidity", "cie", "perez"];

impl ClearSkyArgs {
    pub fn perez_params(&self) -> PerezParams {
        let custom = self.perez.map(PerezShape::Custom);
        PerezParams {
            shape: custom.or(self.cie.map(PerezShape::Cie)).unwrap_or_default(),
            turbidity: self.turbidity,
        }
    }

    /// An option that the model would not look at is a mistake, and told.
    ///
    /// # Errors
    /// Which option it is, and whose.
    pub fn refuse_others(&self, given: &ArgMatches) -> Result<(), String> {
        if self.sky == SkyName::Gradient {
            return match OWN.iter().find(|option| is_given(given, option)) {
                None => Ok(()),
                Some(option) => Err(belongs(
                    option,
                    "--sky perez",
                    "--sky gradient",
                    "add --sky perez",
                )),
            };
        }
        match self.cie {
            Some(number @ ..=LAST_OVERCAST) if is_given(given, "turbidity") => Err(format!(
                "--turbidity colours clear skies, and --cie {number} is overcast and white; leave it out or take --cie {} to 15",
                LAST_OVERCAST + 1
            )),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use welkin_runtime::SkyParams;

    use crate::cli::{Cli, Command};

    use super::*;

    fn read(args: &[&str]) -> Result<SkyParams, String> {
        let words = ["welkin-view", "render", "pack", "-o", "f.png"];
        match Cli::read(words.iter().chain(args)).map(|cli| cli.command) {
            Ok(Some(Command::Render(render))) => Ok(render.view().params),
            Ok(other) => panic!("{args:?}: {other:?}"),
            Err(error) => Err(error.to_string()),
        }
    }

    #[test]
    fn a_model_is_chosen_by_name_and_shaped_by_its_options() {
        for model in SkyModel::ALL {
            let params = read(&["--sky", model.name()]).unwrap();
            let usual = SkyParams::default();
            assert_eq!(
                params,
                SkyParams {
                    sky: model,
                    ..usual
                }
            );
        }
        let of = |args: &[&str]| read(&[&["--sky", "perez"], args].concat()).unwrap().perez;
        assert_eq!(of(&["--turbidity", "4"]).turbidity, 4.0);
        assert_eq!(of(&["--cie", "12"]).shape, PerezShape::Cie(12));
        let custom = of(&["--perez", "-1,-0.3,10,-3,0.45"]).shape;
        assert_eq!(custom, PerezShape::Custom([-1.0, -0.3, 10.0, -3.0, 0.45]));
    }

    #[test]
    fn options_of_the_other_model_are_refused() {
        for option in [
            ["--turbidity", "3"],
            ["--cie", "12"],
            ["--perez", "0,-1,0,-1,0"],
        ] {
            let error = read(&option).unwrap_err();
            let told = format!("{} belongs to --sky perez", option[0]);
            assert!(error.contains(&told), "{error}");
        }
        let error = read(&["--sky", "perez", "--cie", "5", "--turbidity", "3"]).unwrap_err();
        assert!(error.contains("--cie 5 is overcast and white"), "{error}");
        assert!(read(&["--sky", "perez", "--cie", "6", "--turbidity", "3"]).is_ok());
        let both = ["--sky", "perez", "--cie", "5", "--perez", "0,-1,0,-1,0"];
        assert!(read(&both).unwrap_err().contains("cannot be used with"));
    }

    #[test]
    fn what_is_out_of_range_is_refused_with_the_range() {
        for (option, values, expected) in [
            (
                "--turbidity",
                ["1.6", "10.1", "nan"],
                "expected a number from 1.7 to 10",
            ),
            (
                "--cie",
                ["0", "16", "clear"],
                "expected a whole number from 1 to 15",
            ),
            (
                "--perez",
                ["1,-1,1,-1", "0,0,0,-1,0", "0,-1,nan,-1,0"],
                "expected five numbers: -1 to 10, -5 to -0.05, 0 to 30, -5 to -0.1, 0 to 2",
            ),
        ] {
            for value in values {
                let error = read(&["--sky", "perez", option, value]).unwrap_err();
                assert!(error.contains(expected), "{value}: {error}");
            }
        }
        let error = read(&["--sky", "hosek"]).unwrap_err();
        assert!(error.contains("gradient, perez"), "{error}");
    }
}
