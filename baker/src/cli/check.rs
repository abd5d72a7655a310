//! `welkin check`: every rule with its figure, and an exit code that scripts can trust.
//!
//! 0: the pack is sound. 1: problems were found. 2: it cannot be read at all, what it was baked from is not at hand, or what was
//! found could not be written. With `--json` the report of `welkin-pack` is printed; docs/checks.md describes it.

mod args;
mod files;

use std::process::ExitCode;

use anyhow::{Result, bail};
use welkin_baker::{RebakeError, decode_texture, rebake};
use welkin_pack::check::{Examined, Outcome, Report, check_texture, examine};
use welkin_pack::{Role, Texture};

use super::page::{self, Page};
use super::{bake, file, input, interrupt, output};
use args::As;
pub use args::CheckArgs;

const SOUND: u8 = 0;
const PROBLEMS: u8 = 1;
const UNREADABLE: u8 = 2;

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

fn lines(report: &Report) -> String {
    let findings = report.findings.iter();
    let mut text: String = findings.map(|finding| format!("{finding}\n")).collect();
    let verdict = if report.is_sound() {
        "sound"
    } else {
        "not sound"
    };
    let [passed, failed, skipped] =
        [Outcome::Passed, Outcome::Failed, Outcome::Skipped].map(|o| report.count(o));
    text += &format!("{verdict}: {passed} passed, {failed} failed, {skipped} skipped\n");
    text
}
