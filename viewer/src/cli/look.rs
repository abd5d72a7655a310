//! The options of `welkin-view look`.

use std::path::PathBuf;

use super::gpu::GpuArgs;
use clap::Args;
use clap::builder::PossibleValuesParser;
use welkin_runtime::Method;
use welkin_runtime::params::whole_within;

#[derive(Debug, Args)]
pub struct LookArgs {
    /// Folder of the pack
    pub pack: PathBuf,
    /// Folder for a page with the pictures: index.html and PNG files, which are replaced
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Whose skies [default: every method's]
    #[arg(long, value_parser = PossibleValuesParser::new(Method::ALL.map(Method::name)))]
    method: Option<String>,
    /// Measure motion too, for so many seconds at 30 frames a second, 1 to 600: the largest change between two frames over the median one, and how much
    /// the zenith at last is like that at first, moved [default: 60]
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, require_equals = true, default_missing_value = "60", value_parser = motion_s)]
    pub motion: Option<u32>,
    #[command(flatten)]
    pub gpu: GpuArgs,
}

fn motion_s(text: &str) -> Result<u32, String> {
    whole_within(text, 1..=600)
}

impl LookArgs {
    /// Whose skies are looked at.
    pub fn methods(&self) -> Vec<Method> {
        let wanted = |method: &Method| {
            let name = self.method.as_deref();
            name.is_none_or(|name| name == method.name())
        };
        Method::ALL.into_iter().filter(wanted).collect()
    }
}
