//! The options of `welkin-view look`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;
use welkin_runtime::Method;

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
