//! `welkin check`: every rule with its figure, and an exit code that scripts can trust.
//!
//! 0: the pack is sound. 1: problems were found. 2: it cannot be read at all, what it was baked from is not at hand, or what was
//! found could not be written. With `--json` the report of `welkin-pack` is printed; docs/checks.md describes it.

mod files;

use std::ffi::OsString;
use std::process::ExitCode;

use anyhow::{Result, bail};
use welkin_baker::{RebakeError, decode_texture, rebake};
use welkin_pack::check::{Examined, Outcome, Report, check_texture, examine};
use welkin_pack::{Role, Texture};

use super::CheckArgs;
use super::page::{self, Page};
use super::{bake, file, input, interrupt, output};

const SOUND: u8 = 0;
const PROBLEMS: u8 = 1;
const UNREADABLE: u8 = 2;

/// What `--as` names: a role, or one of its channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct As {
    role: Role,
    channel: Option<usize>,
}

/// What was found, and what it was found in.
struct Checked {
    report: Report,
    page: Option<String>,
}

pub fn run(args: &CheckArgs) -> ExitCode {
    match run_and_write(args) {
        Ok(report) if report.is_sound() => ExitCode::from(SOUND),
        Ok(_) => ExitCode::from(PROBLEMS),
        Err(_) if interrupt::requested() => {
            output::message("interrupted; nothing was written");
            ExitCode::from(interrupt::EXIT_CODE)
        }
        Err(error) => output::failure(&error.to_string(), UNREADABLE),
    }
}

fn run_and_write(args: &CheckArgs) -> Result<Report> {
    if args.rebake || args.html.is_some() {
        interrupt::listen()?;
    }
    if let Some(html) = &args.html {
        files::verify_apart(html, args)?;
    }
    let Checked { report, page } = match args.role {
        Some(wanted) => check_file(args, wanted)?,
        None => check_pack(args)?,
    };
    if let (Some(html), Some(page)) = (&args.html, page) {
        interrupt::stop_if_requested()?;
        file::write(html, page.as_bytes())?;
    }
    output::result(&if args.json {
        report.to_json()
    } else {
        lines(&report)
    })?;
    Ok(report)
}

fn check_pack(args: &CheckArgs) -> Result<Checked> {
    if args.path.is_file() {
        bail!(
            "{}: is a file, expected the folder of a pack; say what texture it is with --as ROLE, such as --as clouds",
            args.path.display()
        );
    }
    let mut examined = examine(&args.path)?;
    if args.rebake {
        prove(&mut examined, args)?;
    }
    let page = args
        .html
        .as_ref()
        .map(|_| page::html(&Page::of_pack(&examined)));
    Ok(Checked {
        report: examined.report,
        page: page.transpose()?,
    })
}

/// Bakes the pack anew and adds what comes of it to the report.
fn prove(examined: &mut Examined, args: &CheckArgs) -> Result<()> {
    let given = files::given(args)?;
    let found = bake::with_progress(&|_| (), |on_progress| rebake(examined, &given, on_progress));
    match found {
        Ok(findings) => examined.report.findings.extend(findings),
        Err(error @ RebakeError::Missing { .. }) => bail!(
            "{}: {error}; give each with --input KEY=FILE, a photograph of clouds with --photo FILE",
            args.path.display()
        ),
        Err(error) => bail!("{}: {error}", args.path.display()),
    }
    Ok(())
}

/// A texture that is in no pack.
fn check_file(args: &CheckArgs, wanted: As) -> Result<Checked> {
    let As { role, channel } = wanted;
    let name = args.path.display().to_string();
    let bytes = input::bytes(&args.path)?;
    let file = decode_texture(&bytes, &name, role, channel)?;
    file.notes
        .iter()
        .for_each(|note| output::message(&format!("{name}: {note}")));
    let mut report = check_texture(role, &file.texture);
    if let Some(channel) = channel {
        keep_channel(&mut report, role, channel)?;
    }
    let textures: [(Role, Texture); 1] = [(role, file.texture)];
    let page = args.html.as_ref().map(|_| {
        let page = Page::of_texture(&name, &report, &textures, channel);
        page::html(&page)
    });
    Ok(Checked {
        report,
        page: page.transpose()?,
    })
}

/// Leaves the findings about one channel.
fn keep_channel(report: &mut Report, role: Role, channel: usize) -> Result<()> {
    let spec = role.spec();
    let name = format!("{}.{}", role.name(), spec.channels[channel].name);
    let is_about = |subject: &str| subject.split(' ').next() == Some(name.as_str());
    report.findings.retain(|finding| is_about(&finding.subject));
    if report.findings.is_empty() {
        bail!(
            "{name}: no rule looks at this channel alone; give the whole texture with --as {}",
            role.name()
        );
    }
    Ok(())
}

/// Reads the value of `--as`.
pub fn parse_as(text: &str) -> Result<As, String> {
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
pub fn parse_input(text: &str) -> Result<(String, OsString), String> {
    match text.split_once('=') {
        Some((key, file)) if !key.is_empty() && !file.is_empty() => {
            Ok((key.to_string(), file.into()))
        }
        _ => Err("expected KEY=FILE, such as skybox.file=sky.exr".to_string()),
    }
}

fn lines(report: &Report) -> String {
    let findings = report.findings.iter();
    let mut text: String = findings.map(|finding| format!("{finding}\n")).collect();
    let verdict = if report.is_sound() {
        "sound"
    } else {
        "not sound"
    };
    let [passed, failed, skipped] =
        [Outcome::Passed, Outcome::Failed, Outcome::Skipped].map(|o| count(report, o));
    text += &format!("{verdict}: {passed} passed, {failed} failed, {skipped} skipped\n");
    text
}

/// How many findings came out so.
pub fn count(report: &Report, outcome: Outcome) -> usize {
    let findings = report.findings.iter();
    findings.filter(|f| f.outcome == outcome).count()
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
