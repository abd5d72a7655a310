//! `welkin-view look`: the structure of each method's clouds in numbers, beside those of photographs, how evenly they move, and a page of its skies.
//!
//! The numbers are necessary and not enough: whoever changes clouds looks at the page too, beside a photograph.

mod motion;
mod page;
mod scene;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use welkin_pack::place::verify_apart;
use welkin_pack::whole::{sweep, write_files};
use welkin_pack::{Pack, interrupt};
use welkin_runtime::{Method, Oktas};
use welkin_viewer::frame::{Frame, Target};
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::{Stage, View};
use welkin_viewer::save::{Format, encode};
use welkin_viewer::structure::{fine_over_coarse, repetition};

use crate::cli::LookArgs;
use crate::told::{print, tell_leftovers};
use motion::Motion;
use page::{Picture, Shown};
use scene::{MEASURED, OKTAS, SHOWN, Scene};

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
    motion: Option<Motion>,
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
                        "{name}, {} at {oktas} oktas: structure {found:.3}, expected {least} to {most}",
                        scene.name
                    ));
                }
            }
        }
        if self.repetition > MOST_REPETITION {
            problems.push(format!(
                "{name}: the zenith looks {:.3} like itself moved away, expected at most {MOST_REPETITION}",
                self.repetition
            ));
        }
        problems.extend(self.motion.and_then(|motion| motion.problem(self.method)));
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
        let motion = self.motion.map(|motion| {
            let columns = motion.columns();
            format!("{:8} motion  {columns}\n", self.method.name())
        });
        rows.chain([zenith]).chain(motion).collect()
    }
}

pub fn run(args: &LookArgs) -> Result<()> {
    if let Some(folder) = &args.output {
        open(folder, args)?;
    }
    let pack = Pack::open(&args.pack)?;
    let gpu = Gpu::open(args.gpu.gpu.as_ref())?;
    let oktas = Oktas::new(&pack)?;
    interrupt::listen()?;
    let [a, b, c] = OKTAS;
    print(&format!("method   hour    {a} oktas  {b}     {c}\n"))?;
    let (mut problems, mut shown, mut files) = (Vec::new(), Vec::new(), Vec::new());
    for method in args.methods() {
        let mut stage = Stage::new(&gpu, &pack, Target::Srgb8)?;
        let mut draw = |view: &View| -> Result<Frame> {
            ensure!(!interrupt::requested(), "interrupted: nothing is written");
            stage.reset_history();
            Ok(stage.draw(view)?)
        };
        let mut found = Found {
            method,
            structure: [[None; OKTAS.len()]; MEASURED.len()],
            repetition: repetition(&draw(&scene::zenith(method))?),
            motion: None,
        };
        for (scene, row) in MEASURED.iter().zip(&mut found.structure) {
            for (wanted, found) in OKTAS.iter().zip(row) {
                let mut view = scene.view(method);
                view.params.cover = oktas.cover(&view.params, *wanted);
                *found = fine_over_coarse(&draw(&view)?);
            }
        }
        if let Some(seconds) = args.motion {
            found.motion = Some(Motion::of(&gpu, &pack, method, seconds)?);
        }
        print(&found.table())?;
        problems.extend(found.problems());
        let mut pictures = Vec::new();
        for scene in args.output.iter().flat_map(|_| &SHOWN) {
            let frame = draw(&scene.view(method))?;
            let file = picture_name(method, scene);
            files.push((file.clone(), encode(&file, Format::Png, &frame)?));
            pictures.push(Picture {
                file,
                scene: scene.name,
                structure: fine_over_coarse(&frame),
            });
        }
        shown.push(Shown {
            method,
            motion: found.motion.map(|motion| motion.sentence()),
            pictures,
        });
    }
    if let Some(folder) = &args.output {
        files.push((PAGE.into(), page::html(&shown, &problems).into_bytes()));
        write(folder, &files)?;
    }
    for problem in &problems {
        print(&format!("beyond the bounds: {problem}\n"))?;
    }
    ensure!(
        problems.is_empty(),
        "{} of the numbers are not those of clouds; they are listed under the table",
        problems.len()
    );
    Ok(())
}

/// The name of the page.
const PAGE: &str = "index.html";

fn picture_name(method: Method, scene: &Scene) -> String {
    format!("{}-{}.png", method.name(), scene.name)
}

/// Makes the folder of the page, and refuses what could not be written into it.
fn open(folder: &Path, args: &LookArgs) -> Result<()> {
    verify_apart(&[&args.pack], &[folder])?;
    fs::create_dir_all(folder).with_context(|| {
        format!(
            "{}: cannot be made; choose a place that can be written",
            folder.display()
        )
    })?;
    tell_leftovers(&sweep(folder));
    let pictures = args.methods().into_iter();
    let pictures =
        pictures.flat_map(|method| SHOWN.iter().map(move |scene| picture_name(method, scene)));
    for name in pictures.chain([PAGE.to_string()]) {
        let file = folder.join(name);
        ensure!(
            !file.is_dir(),
            "{}: is a folder; move it, or choose another place",
            file.display()
        );
    }
    Ok(())
}

/// All files or none.
fn write(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<()> {
    let paths: Vec<PathBuf> = files.iter().map(|(name, _)| folder.join(name)).collect();
    let pairs = paths.iter().zip(files);
    let pairs: Vec<(&Path, &[u8])> = pairs
        .map(|(path, (_, bytes))| (path.as_path(), bytes.as_slice()))
        .collect();
    Ok(write_files(&pairs, &interrupt::requested)?)
}
