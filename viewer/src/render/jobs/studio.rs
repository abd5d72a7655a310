//! What jobs are drawn with: packs, device, labels; what is begun of a job, and what a finished one is.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use welkin_controls::KEYS;
use welkin_pack::place::verify_apart;
use welkin_viewer::export::sequence::Shard;
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::{Back, Begun};

use super::super::artist::{Drawing, Encoded, Picture};
use super::super::oktas::cover_for_oktas;
use super::index::{Index, Known};
use super::labels::{self, Drawn, Picture as Labelled, Told};
use super::line::{Line, PackTold, hash};
use super::packs::{Opened, Packs};
use super::source::{Numbered, at, read_all};
use crate::cli::{Label, RenderArgs, Shot};
use crate::job::{Job, settings_told};

/// What a line of the index says of the program, and a job's hash follows from: another version may draw another picture.
const WRITER: &str = concat!("welkin-view ", env!("CARGO_PKG_VERSION"));

/// A job that was looked at.
pub struct Task {
    /// With the cover that its oktas want.
    job: Job,
    hash: String,
    labels: Vec<String>,
}

/// A picture that was begun, or has come back.
pub struct Work<P, F> {
    file: String,
    line: Line,
    picture: P,
    labels: Drawn<F>,
}

/// A picture that is finished, but for being written.
pub struct Finished {
    pub line: Line,
    /// What each file is, its name and its bytes, the picture last.
    pub files: Vec<(String, String, Vec<u8>)>,
}

/// What jobs are drawn with.
pub struct Studio<'a> {
    packs: Packs<'a>,
    gpu: &'a Gpu,
    args: &'a RenderArgs,
    labels: &'a [Label],
    /// Where the packs of jobs are.
    base: PathBuf,
}

impl<'a> Studio<'a> {
    /// With the pack of the command line open.
    pub fn open(
        gpu: &'a Gpu,
        args: &'a RenderArgs,
        labels: &'a [Label],
        base: PathBuf,
    ) -> Result<Studio<'a>> {
        let mut packs = Packs::new(gpu, &args.output);
        packs.get(&args.pack)?;
        Ok(Studio {
            packs,
            gpu,
            args,
            labels,
            base,
        })
    }

    /// Looks at every job of a file before anything is drawn, and counts those of a part.
    pub fn verify_all(&mut self, jobs: &Path, shard: Shard) -> Result<u64> {
        let mut numbered = Numbered::new(Shard::WHOLE);
        let mut count = 0_u64;
        read_all(jobs, |number, text| {
            let place = || at(jobs, number);
            if let Some(job) = numbered.job(text, number).with_context(place)? {
                self.verify(&job).with_context(place)?;
                let file = self.args.output.join(job.file());
                ensure!(
                    file.file_name() != jobs.file_name() || verify_apart(&[jobs], &[&file]).is_ok(),
                    "{}: its picture would be written over the jobs; give it another name",
                    place()
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

    /// Looks at a job: that it can be drawn, and what it is.
    pub fn task(&mut self, mut job: Job) -> Result<Task> {
        self.verify(&job)?;
        let labels = self.labels.iter().map(|label| label.name()).collect();
        let opened = self.pack(&job)?;
        if let Some(oktas) = job.oktas {
            let found = cover_for_oktas(&opened.calibration, &job.settings.params, oktas)?;
            job.settings.params.cover = found;
        }
        Ok(Task {
            hash: job_hash(&job, &opened.seal)?,
            job,
            labels,
        })
    }

    /// Begins a picture.
    pub fn begin(&mut self, task: Task) -> Result<Work<Drawing, Begun>> {
        let (wanted, job) = (self.labels, task.job);
        let opened = self.pack(&job)?;
        let (view, artist) = (job.view(), &mut opened.artist);
        let azimuth_rad = job.azimuth_deg.to_radians();
        let picture = artist.begin(job.shot, azimuth_rad, &view, None)?;
        let labels = Drawn::begin(wanted, artist, &job, &view)?;
        let line = Line {
            files: BTreeMap::new(),
            tar: None,
            job: task.hash,
            labels: task.labels,
            told: Told::default(),
            writer: WRITER,
            pack: PackTold {
                name: opened.name.clone(),
                seal: opened.seal.clone(),
            },
            seed: job.seed,
            size: BTreeMap::from([job.size_told()]),
            settings: settings_told(&job.settings),
            weather: job.weather.clone(),
            name: job.name.clone(),
        };
        Ok(Work {
            file: job.file(),
            line,
            picture,
            labels,
        })
    }
}

impl Task {
    pub fn name(&self) -> &str {
        &self.job.name
    }

    /// What is known of it, if that is of the same job.
    ///
    /// # Errors
    /// That it is of another job, unless it may be replaced.
    pub fn known<'i>(&self, index: &'i Index, force: bool) -> Result<Option<&'i Known>> {
        let Some(known) = index.known(&self.job.name) else {
            return Ok(None);
        };
        ensure!(
            known.job == self.hash || force,
            "{} is there, made by another job; choose another name or folder, or add --force to replace it",
            self.job.file()
        );
        Ok(Some(known).filter(|known| known.job == self.hash))
    }

    /// Whether all that is wanted is there, in this tar file or beside it.
    pub fn is_there(&self, known: Option<&Known>, tar: Option<&str>) -> bool {
        known.is_some_and(|known| {
            known.is_whole && known.labels == self.labels && known.tar.as_deref() == tar
        })
    }
}

impl Work<Drawing, Begun> {
    /// Waits until it is there.
    pub fn wait(self, gpu: &Gpu) -> Result<Work<Picture, Back>> {
        Ok(Work {
            file: self.file,
            line: self.line,
            picture: self.picture.wait(gpu)?,
            labels: self.labels.wait(gpu)?,
        })
    }
}

impl Work<Picture, Back> {
    /// Encodes it; `folder` is where it goes, for errors.
    pub fn finish(self, folder: &Path) -> Result<Finished> {
        let (mut line, mut files) = (self.line, Vec::new());
        let (pictures, told) = self.labels.finish()?;
        line.told = told;
        for Labelled { label, bytes } in pictures {
            let kind = label.name();
            let file = format!("{}.{kind}.png", line.name);
            files.push((kind, file, bytes));
        }
        let place = folder.join(&self.file).display().to_string();
        if let Encoded::File(bytes) = self.picture.encode(&place)? {
            files.push(("picture".to_string(), self.file, bytes));
        }
        Ok(Finished { line, files })
    }
}

/// A hash of all that a picture follows from, but for the device.
fn job_hash(job: &Job, seal: &str) -> Result<String> {
    let settings = KEYS.iter().map(|key| (key.name, key.text(&job.settings)));
    let settings: BTreeMap<&str, String> = settings.collect();
    let told = (&job.seed, &job.oktas, job.azimuth_deg, &job.weather);
    let (size, format) = (job.size_told(), job.shot.extension());
    let all = serde_json::to_vec(&(WRITER, seal, settings, size, format, told))?;
    Ok(hash(&all))
}
