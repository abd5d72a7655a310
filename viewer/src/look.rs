//! `welkin-view look`: the structure of each method's clouds in numbers, beside those of photographs, and a page of its skies.
//!
//! The numbers are necessary and not enough: whoever changes clouds looks at the page too, beside a photograph.

mod page;
mod scene;

use std::fs;
use std::io::Write;

use anyhow::{Context, Result, bail};
use welkin_pack::whole::write_file;
use welkin_pack::{Pack, interrupt};
use welkin_runtime::{Method, Oktas};
use welkin_viewer::frame::{Frame, Target};
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::{Stage, View};
use welkin_viewer::save::{Format, encode};
use welkin_viewer::structure::{fine_over_coarse, repetition};

use crate::cli::LookArgs;
use page::Picture;
use scene::{MEASURED, OKTAS, SHOWN};

/// Fine over coarse structure that clouds may have: photographs have 0.12 to 0.25.
const STRUCTURE: [f32; 2] = [0.10, 0.28];
/// The most that a view of the zenith may look like itself, moved away.
const MOST_REPETITION: f32 = 0.3;

/// What was found of a method.
struct Found {
    method: Method,
    /// Of each hour and cover, fine over coarse structure, if there are clouds enough.
    structure: [[Option<f32>; OKTAS.len()]; MEASURED.len()],
    repetition: f32,
}

impl Found {
    /// What is beyond the bounds.
    fn problems(&self) -> Vec<String> {
        let name = self.method.name();
        let mut problems = Vec::new();
        for (scene, row) in MEASURED.iter().zip(self.structure) {
            for (oktas, found) in OKTAS.iter().zip(row) {
                let Some(found) = found else { continue };
                if !(STRUCTURE[0]..=STRUCTURE[1]).contains(&found) {
                    let [least, most] = STRUCTURE;
                    problems.push(format!(
                        "{name}, {} at {oktas} oktas: structure {found:.2}, expected {least} to {most}",
                        scene.name
                    ));
                }
            }
        }
        if self.repetition > MOST_REPETITION {
            problems.push(format!(
                "{name}: the zenith looks {:.2} like itself moved away, expected at most {MOST_REPETITION}",
                self.repetition
            ));
        }
        problems
    }

    /// A row for each hour.
    fn table(&self) -> String {
        let number = |found: &Option<f32>| found.map_or("    -".into(), |n| format!("{n:5.2}"));
        let rows = MEASURED.iter().zip(&self.structure).map(|(scene, row)| {
            let row: Vec<String> = row.iter().map(number).collect();
            format!(
                "{:8} {:7} {}\n",
                self.method.name(),
                scene.name,
                row.join(" ")
            )
        });
        let zenith = format!("{:8} zenith  {:5.2}\n", self.method.name(), self.repetition);
        rows.chain([zenith]).collect()
    }
}

pub fn run(args: &LookArgs) -> Result<()> {
    let pack = Pack::open(&args.pack)?;
    let gpu = Gpu::open()?;
    let oktas = Oktas::new(&pack)?;
    if let Some(folder) = &args.output {
        fs::create_dir_all(folder)
            .with_context(|| format!("{}: cannot be made", folder.display()))?;
    }
    let mut stdout = std::io::stdout().lock();
    let [a, b, c] = OKTAS;
    writeln!(stdout, "method   hour    {a} oktas  {b}     {c}").ok();
    let (mut problems, mut pictures) = (Vec::new(), Vec::new());
    for method in args.methods() {
        let mut stage = Stage::new(&gpu, &pack, Target::Srgb8)?;
        let mut draw = |view: &View| {
            stage.reset_history();
            stage.draw(view)
        };
        let mut found = Found {
            method,
            structure: [[None; OKTAS.len()]; MEASURED.len()],
            repetition: repetition(&draw(&scene::zenith(method))?),
        };
        for (scene, row) in MEASURED.iter().zip(&mut found.structure) {
            for (wanted, found) in OKTAS.iter().zip(row) {
                let mut view = scene.view(method);
                view.params.cover = oktas.cover(&view.params, *wanted);
                *found = fine_over_coarse(&draw(&view)?);
                if interrupt::requested() {
                    bail!("interrupted");
                }
            }
        }
        write!(stdout, "{}", found.table()).ok();
        problems.extend(found.problems());
        for scene in args.output.iter().flat_map(|_| &SHOWN) {
            let frame = draw(&scene.view(method))?;
            pictures.push(picture(args, method, scene.name, &frame)?);
        }
    }
    if let Some(folder) = &args.output {
        let page = page::html(&pictures, &problems);
        write_file(
            &folder.join("index.html"),
            page.as_bytes(),
            &interrupt::requested,
        )?;
    }
    if problems.is_empty() {
        return Ok(());
    }
    for problem in &problems {
        writeln!(stdout, "beyond the bounds: {problem}").ok();
    }
    bail!(
        "{} of the numbers are not those of clouds; the table tells which",
        problems.len()
    )
}

/// Saves a picture of the page.
fn picture(args: &LookArgs, method: Method, scene: &'static str, frame: &Frame) -> Result<Picture> {
    let file = format!("{}-{scene}.png", method.name());
    let folder = args.output.as_deref().unwrap_or(&args.pack);
    let bytes = encode(&file, Format::Png, frame)?;
    write_file(&folder.join(&file), &bytes, &interrupt::requested)?;
    Ok(Picture {
        file,
        method,
        scene,
        structure: fine_over_coarse(frame),
    })
}
