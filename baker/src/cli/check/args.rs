//! What is said on the command line to `welkin check`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Args;
use welkin_pack::Role;

#[derive(Debug, Args)]
pub struct CheckArgs {
    /// Folder of the pack; with --as a PNG, OpenEXR or KTX2 file
    #[arg(value_name = "PACK")]
    pub path: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Also bake the pack's recipe anew and compare every texel: proof, not statistics
    #[arg(long)]
    pub rebake: bool,
    /// For --rebake: the photograph of clouds that the recipe names
    #[arg(long, value_name = "FILE", requires = "rebake")]
    pub photo: Option<PathBuf>,
    /// For --rebake: another file that the recipe names, by its key, such as skybox.file=sky.exr; once for each
    #[arg(long, value_name = "KEY=FILE", requires = "rebake", value_parser = parse_input)]
    pub input: Vec<(String, OsString)>,
    /// Also write a page to look at: every channel beside what was found in it; a file of that name is replaced
    #[arg(long, value_name = "FILE.html")]
    pub html: Option<PathBuf>,
    /// Check a texture that is in no pack: a role such as clouds or stars, or one channel such as clouds.noise
    #[arg(long = "as", value_name = "ROLE", conflicts_with = "rebake", value_parser = parse_as)]
    pub role: Option<As>,
}

/// What `--as` names: a role, or one of its channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct As {
    pub role: Role,
    pub channel: Option<usize>,
}

/// Reads the value of `--as`.
fn parse_as(text: &str) -> Result<As, String> {
    let (name, channel) = match text.split_once('.') {
        Some((name, channel)) => (name, Some(channel)),
        None => (text, None),
    };
    let Some(role) = Role::ALL.into_iter().find(|role| role.name() == name) else {
        let names = Role::ALL.map(Role::name).join(", ");
        return Err(format!(
            "expected one of {names}, or one of their channels, such as clouds.noise"
        ));
    };
    let channels = role.spec().channels;
    let index = |wanted: &str| {
        let found = channels.iter().position(|c| c.name == wanted);
        found.ok_or_else(|| {
            let names: Vec<String> = channels
                .iter()
                .map(|c| format!("{name}.{}", c.name))
                .collect();
            format!("expected {name}, or one of {}", names.join(", "))
        })
    };
    Ok(As {
        role,
        channel: channel.map(index).transpose()?,
    })
}

/// Reads a value of `--input`.
fn parse_input(text: &str) -> Result<(String, OsString), String> {
    match text.split_once('=') {
        Some((key, file)) if !key.is_empty() && !file.is_empty() => {
            Ok((key.to_string(), file.into()))
        }
        _ => Err("expected KEY=FILE, such as skybox.file=sky.exr".to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_role_or_a_channel_is_named() {
        let whole = As {
            role: Role::Stars,
            channel: None,
        };
        assert_eq!(parse_as("stars"), Ok(whole));
        let noise = As {
            role: Role::Clouds,
            channel: Some(1),
        };
        assert_eq!(parse_as("clouds.noise"), Ok(noise));
        assert!(
            parse_as("cloud")
                .unwrap_err()
                .contains("clouds, stars, galaxy")
        );
        assert!(
            parse_as("sun.red")
                .unwrap_err()
                .contains("sun.disc, sun.glow")
        );
    }

    #[test]
    fn an_input_has_a_key_and_a_file() {
        let read = |text| parse_input(text).ok();
        assert_eq!(read("a.b=c=d"), Some(("a.b".to_string(), "c=d".into())));
        assert_eq!([read("a"), read("=b"), read("a=")], [None, None, None]);
    }
}
