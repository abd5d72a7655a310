//! The page of `welkin check --html`: every channel beside what was found in it, in one file that needs nothing else.
//!
//! Nothing in it comes from elsewhere, and no script is in it: its content security policy allows its own styles and pictures
//! alone. Every text of a pack is escaped.

mod chart;
mod evidence;
mod findings;
mod picture;
mod plan;
mod text;

use std::fmt::Write;

use anyhow::Result;
use welkin_pack::check::{Examined, Outcome, Report};
use welkin_pack::{Field, Role, Texture};

use super::interrupt;
use findings::{Of, worst};
use picture::Pictures;
use text::escaped;

const STYLE: &str = include_str!("page/style.css");

/// What is on a page.
pub struct Page<'a> {
    title: String,
    facts: Vec<(&'static str, String)>,
    report: &'a Report,
    textures: &'a [(Role, Texture)],
    field: Option<&'a Field>,
    /// The only channel that is shown.
    channel: Option<usize>,
}

impl<'a> Page<'a> {
    /// A pack.
    pub fn of_pack(examined: &'a Examined) -> Page<'a> {
        let manifest = &examined.manifest;
        let bytes: u64 = manifest.textures.iter().map(|t| t.file_bytes).sum();
        let field = manifest.field.as_ref().map_or(0, |f| f.file_bytes);
        // A manifest may say anything.
        let noon_deg = manifest.noon_elevation_rad.to_degrees();
        Page {
            title: manifest.name.clone(),
            facts: vec![
                ("baked by", manifest.baker.clone()),
                ("seed", manifest.seed.to_string()),
                ("sun at noon", format!("{noon_deg:.1}\u{b0}")),
                ("textures", manifest.textures.len().to_string()),
                ("bytes", bytes.saturating_add(field).to_string()),
                ("seal", manifest.seal.chars().take(16).collect()),
            ],
            report: &examined.report,
            textures: &examined.textures,
            field: examined.field.as_ref(),
            channel: None,
        }
    }

    /// A texture that is in no pack, or one of its channels.
    pub fn of_texture(
        name: &str,
        report: &'a Report,
        textures: &'a [(Role, Texture)],
        channel: Option<usize>,
    ) -> Page<'a> {
        let checked_as = textures.iter().map(|(role, _)| match channel {
            Some(channel) => format!("{}.{}", role.name(), role.spec().channels[channel].name),
            None => role.name().to_string(),
        });
        Page {
            title: name.to_string(),
            facts: vec![("checked as", checked_as.collect())],
            report,
            textures,
            field: None,
            channel,
        }
    }
}

/// The page as HTML.
pub fn html(page: &Page) -> Result<String> {
    let mut pictures = Pictures::default();
    let sections = sections(page, &mut pictures)?;
    let title = escaped(&page.title);
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}: welkin check</title>\n<style>\n{STYLE}"
    );
    html += pictures.css();
    html += "</style>\n";
    write!(
        html,
        "<header>\n<p class=\"program\">welkin check</p>\n<h1>{title}</h1>\n{}<dl class=\"facts\">",
        verdict(page.report)
    )?;
    for (name, value) in &page.facts {
        write!(
            html,
            "<div><dt>{name}</dt><dd>{}</dd></div>",
            escaped(value)
        )?;
    }
    html += "</dl>\n</header>\n";
    html += &navigation(page);
    html += "<main>\n";
    html += &findings::failed(page.report);
    html += &sections;
    html += "</main>\n</html>\n";
    Ok(html)
}

fn verdict(report: &Report) -> String {
    let failed = report.problems().count();
    let errors = report.findings.iter().filter(|f| f.is_error()).count();
    let (class, word) = match (report.is_sound(), failed) {
        (true, 0) => ("ok", "sound"),
        (true, _) => ("warning", "sound, with warnings"),
        (false, _) => ("error", "not sound"),
    };
    let [passed, skipped] = [Outcome::Passed, Outcome::Skipped].map(|o| report.count(o));
    let warnings = failed - errors;
    format!(
        "<p class=\"verdict {class}\"><strong>{word}</strong> <span>{passed} passed</span> <span>{errors} errors</span> \
         <span>{warnings} warnings</span> <span>{skipped} skipped</span></p>\n"
    )
}

/// What the page has a section for.
fn subjects(page: &Page) -> Vec<Of> {
    let roles = Role::ALL.into_iter().filter(|role| {
        let is_there = page.textures.iter().any(|(r, _)| r == role);
        is_there
            || findings::about(page.report, Of::Role(*role))
                .next()
                .is_some()
    });
    let field = findings::about(page.report, Of::Field).next().is_some() || page.field.is_some();
    let pack = findings::about(page.report, Of::Pack).next().is_some();
    let mut subjects: Vec<Of> = pack.then_some(Of::Pack).into_iter().collect();
    subjects.extend(roles.map(Of::Role));
    subjects.extend(field.then_some(Of::Field));
    subjects
}

fn navigation(page: &Page) -> String {
    let link = |of: Of| {
        let class = worst(findings::about(page.report, of));
        format!("<a href=\"#{0}\" class=\"{class}\">{0}</a>", of.name())
    };
    let links: Vec<String> = subjects(page).into_iter().map(link).collect();
    format!("<nav>{}</nav>\n", links.join(" "))
}

fn sections(page: &Page, pictures: &mut Pictures) -> Result<String> {
    let mut html = String::new();
    for of in subjects(page) {
        interrupt::stop_if_requested()?;
        let name = of.name();
        let texture = page.textures.iter().find(|(role, _)| of == Of::Role(*role));
        let size = texture.map_or(String::new(), |(_, texture)| evidence::size(texture));
        write!(
            html,
            "<section id=\"{name}\">\n<h2>{name} <small>{size}</small></h2>\n"
        )?;
        let whole = findings::about(page.report, of).filter(|f| findings::channel(f).is_none());
        html += &findings::table(whole);
        match (of, texture) {
            (Of::Field, _) => html += &page.field.map_or(String::new(), plan::field),
            (Of::Role(role), texture) => {
                if let Some((_, texture)) = texture.filter(|_| page.channel.is_none()) {
                    html += &evidence::colour(role, texture, pictures)?;
                }
                let channels = role.spec().channels.iter().enumerate();
                let shown = channels.filter(|(i, _)| page.channel.is_none_or(|only| only == *i));
                for (index, spec) in shown {
                    let of_channel = findings::about(page.report, of)
                        .filter(|f| findings::channel(f) == Some(index));
                    let mut evidence = String::new();
                    if let Some((_, texture)) = texture {
                        evidence = evidence::channel(role, texture, index, pictures)?;
                    }
                    let found = findings::table(of_channel);
                    if evidence.is_empty() && found.is_empty() {
                        continue;
                    }
                    write!(
                        html,
                        "<article id=\"{name}-{0}\">\n<h3>{0} <small>{1}</small></h3>\n<div class=\"evidence\">{evidence}</div>\n\
                         <div class=\"found\">{found}</div>\n</article>\n",
                        spec.name, spec.meaning
                    )?;
                }
            }
            (Of::Pack, _) => {}
        }
        html += "</section>\n";
    }
    Ok(html)
}

#[cfg(test)]
mod tests;
