//! Many skies in one process: a picture for each line of a file or of a pipe, with the packs and the device open all the while.

mod index;
mod labels;
mod line;
mod lines;
mod packs;
mod put;
mod source;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use welkin_controls::{KEYS, Settings};
use welkin_pack::interrupt;
use welkin_pack::place::verify_apart;
use welkin_pack::whole::sweep;
use welkin_viewer::export::sequence::Shard;
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::{Back, Begun};

use self::index::{Index, file_name};
use self::labels::{Drawn, Picture as Labelled, Told};
use self::line::{Line, PackTold, hash};
use self::packs::{Opened, Packs};
use self::put::put;
use self::source::{Numbered, Source, read_all};
use super::artist::{Drawing, Encoded, Picture};
use super::oktas::cover_for_oktas;
use super::pipeline::{Next, overlap};
use super::progress::progress;
use crate::cli::{Label, RenderArgs, Shot};
use crate::job::{Job, settings_told};
use crate::told::tell_leftovers;

/// What a line of the index says of the program, and a job's hash follows from: another version may draw another picture.
const WRITER: &str = concat!("welkin-view ", env!("CARGO_PKG_VERSION"));

/// A picture that was begun, or one that is there.
enum Work<P, F> {
    Kept(String),
    Drawn(Box<Sheet>, P, Box<Drawn<F>>),
}

/// Which files that are there may be replaced.
enum MayReplace {
    /// Those of an earlier run of the same job.
    Its(Vec<String>),
    Any,
}

impl MayReplace {
    fn has(&self, file: &str) -> bool {
        match self {
            MayReplace::Its(files) => files.iter().any(|own| own == file),
            MayReplace::Any => true,
        }
    }
}

/// What is known of a picture before it is drawn.
struct Sheet {
    file: String,
    line: Line,
    may_replace: MayReplace,
}

/// Draws the jobs of a file, or those that come through standard input.
pub fn run(args: &RenderArgs, jobs: &Path) -> Result<()> {
    let (folder, shard) = (&args.output, args.export.shard.unwrap_or(Shard::WHOLE));
    let source = Source::open(jobs)?;
    if source.is_file() {
        verify_apart(&[jobs], &[&folder.join(file_name(shard))])?;
    }
    let gpu = Gpu::open(args.gpu.gpu.as_ref())?;
    let labels = args.jobs.labels();
    let mut studio = Studio {
        packs: Packs::new(&gpu, folder),
        gpu: &gpu,
        labels: &labels,
        args,
        base: source.base(),
    };
    studio.packs.get(&args.pack)?;
    let count = match source.is_file() {
        true => Some(studio.verify_all(jobs, shard)?),
        false => None,
    };
    if !folder.is_dir() {
        std::fs::create_dir(folder).with_context(|| {
            format!(
                "{}: cannot be made; make the folder above it",
                folder.display()
            )
        })?;
    }
    tell_leftovers(&sweep(folder));
    let mut index = Index::open(folder, shard)?;
    interrupt::listen()?;
    let bar = progress(count, "jobs");
    let [mut drawn, mut kept] = [0_u64; 2];
    let mut numbered = Numbered::new(shard);
    let mut source = source;
    let done = {
        // Lines are added while pictures are begun, each by its own part.
        let index = RefCell::new(&mut index);
        overlap(
            |may_wait| {
                if interrupt::requested() {
                    return Ok(Next::End);
                }
                loop {
                    let Some(line) = source.next(may_wait)? else {
                        return Ok(Next::Later);
                    };
                    let Some((number, text)) = line else {
                        return Ok(Next::End);
                    };
                    let at = || source::at(jobs, number);
                    if let Some(job) = numbered.job(&text, number).with_context(at)? {
                        let begun = studio.begin(&job, &index.borrow());
                        return Ok(Next::Begun(begun.with_context(at)?));
                    }
                }
            },
            |work| match work {
                Work::Drawn(sheet, drawing, labels) => Ok(Work::Drawn(
                    sheet,
                    drawing.wait(&gpu)?,
                    Box::new(labels.wait(&gpu)?),
                )),
                Work::Kept(name) => Ok(Work::Kept(name)),
            },
            |work| finish(folder, work),
            |(name, line)| {
                let mut index = index.borrow_mut();
                match line {
                    None => {
                        kept += 1;
                        index.keep(name);
                    }
                    Some(line) => {
                        drawn += 1;
                        index.add(name, &line)?;
                    }
                }
                bar.inc(1);
                Ok(())
            },
        )
    };
    bar.finish_and_clear();
    index.close()?;
    done?;
    let told = format!("{drawn} drawn, {kept} were there");
    if interrupt::requested() {
        bail!("interrupted: {told}; run it again to go on");
    }
    writeln!(std::io::stderr(), "{}: {told}", folder.display()).ok();
    Ok(())
}

/// What jobs are drawn with.
struct Studio<'a> {
    packs: Packs<'a>,
    gpu: &'a Gpu,
    args: &'a RenderArgs,
    labels: &'a [Label],
    /// Where the packs of jobs are.
    base: PathBuf,
}

impl<'a> Studio<'a> {
    /// Looks at every job of a file before anything is drawn, and counts those of a part.
    fn verify_all(&mut self, jobs: &Path, shard: Shard) -> Result<u64> {
        let mut numbered = Numbered::new(Shard::WHOLE);
        let mut count = 0_u64;
        read_all(jobs, |number, text| {
            let at = || source::at(jobs, number);
            if let Some(job) = numbered.job(text, number).with_context(at)? {
                self.verify(&job).with_context(at)?;
                let file = self.args.output.join(job.file());
                ensure!(
                    file.file_name() != jobs.file_name() || verify_apart(&[jobs], &[&file]).is_ok(),
                    "{}: its picture would be written over the jobs; give it another name",
                    at()
                );
                count += 1;
            }
            Ok(())
        })?;
        let parts = u64::from(shard.count);
        Ok((count + parts - u64::from(shard.index)) / parts)
    }

    fn pack(&mut self, job: &Job) -> Result<&mut Opened<'a>> {
        match &job.pack {
            None => self.packs.get(&self.args.pack),
            Some(pack) => self.packs.get(&self.base.join(pack)),
        }
    }

    /// That a job can be drawn.
    fn verify(&mut self, job: &Job) -> Result<()> {
        if let Shot::Frame(format) = job.shot {
            self.gpu.verify_size(format.target(), job.size)?;
        }
        labels::verify(self.labels, job.shot)?;
        let opened = self.pack(job)?;
        opened.verify(job.settings.params.method)
    }

    /// Begins a job, unless what it makes is there.
    fn begin(&mut self, job: &Job, index: &Index) -> Result<Work<Drawing, Begun>> {
        self.verify(job)?;
        let force = self.args.jobs.force;
        let wanted = self.labels;
        let opened = self.pack(job)?;
        let mut settings = job.settings;
        let labels: Vec<String> = wanted.iter().map(|label| label.name()).collect();
        if let Some(oktas) = job.oktas {
            let found = cover_for_oktas(&opened.calibration, &settings.params, oktas)?;
            settings.params.cover = found;
        }
        let job_hash = job_hash(job, &settings, &opened.seal)?;
        let known = index.known(&job.name);
        let is_same = known.is_some_and(|known| known.job == job_hash);
        if let Some(known) = known {
            if is_same && known.is_whole && known.labels == labels {
                return Ok(Work::Kept(job.name.clone()));
            }
            ensure!(
                is_same || force,
                "{} is there, made by another job; choose another name or folder, or add --force to replace it",
                job.file()
            );
        }
        let drawn = Job {
            settings,
            ..job.clone()
        };
        let line = Line {
            name: job.name.clone(),
            files: BTreeMap::new(),
            job: job_hash,
            labels,
            told: Told::default(),
            writer: WRITER,
            pack: PackTold {
                name: opened.name.clone(),
                seal: opened.seal.clone(),
            },
            seed: job.seed,
            weather: job.weather.clone(),
            size: BTreeMap::from([job.size_told()]),
            settings: settings_told(&settings),
        };
        let azimuth_rad = job.azimuth_deg.to_radians();
        let (view, artist) = (drawn.view(), &mut opened.artist);
        let drawing = artist.begin(job.shot, azimuth_rad, &view, None)?;
        let beside = Drawn::begin(wanted, artist, job, &view)?;
        let may_replace = match known {
            _ if force => MayReplace::Any,
            Some(known) => MayReplace::Its(known.files.clone()),
            None => MayReplace::Its(Vec::new()),
        };
        let sheet = Sheet {
            file: job.file(),
            line,
            may_replace,
        };
        Ok(Work::Drawn(Box::new(sheet), drawing, Box::new(beside)))
    }
}

/// Encodes and writes a picture; its name, and its line of the index.
fn finish(folder: &Path, work: Work<Picture, Back>) -> Result<(String, Option<String>)> {
    let (sheet, picture, labels) = match work {
        Work::Kept(name) => return Ok((name, None)),
        Work::Drawn(sheet, picture, labels) => (*sheet, picture, labels),
    };
    let file = folder.join(&sheet.file).display().to_string();
    let mut line = sheet.line;
    let (pictures, told) = labels.finish()?;
    line.told = told;
    for Labelled { label, bytes } in pictures {
        let name = label.name();
        let file = format!("{}.{name}.png", line.name);
        let may_replace = sheet.may_replace.has(&file);
        let made = put(folder, file, &bytes, may_replace)?;
        line.files.insert(name, made);
    }
    if let Encoded::File(bytes) = picture.encode(&file)? {
        let may_replace = sheet.may_replace.has(&sheet.file);
        let made = put(folder, sheet.file, &bytes, may_replace)?;
        line.files.insert("picture".to_string(), made);
    }
    let told = serde_json::to_string(&line)?;
    Ok((line.name, Some(told)))
}

/// A hash of all that a picture follows from, but for the device.
fn job_hash(job: &Job, settings: &Settings, seal: &str) -> Result<String> {
    let settings = KEYS.iter().map(|key| (key.name, key.text(settings)));
    let settings: BTreeMap<&str, String> = settings.collect();
    let told = (&job.seed, &job.oktas, job.azimuth_deg, &job.weather);
    let (size, format) = (job.size_told(), job.shot.extension());
    let all = serde_json::to_vec(&(WRITER, seal, settings, size, format, told))?;
    Ok(hash(&all))
}
