//! Many skies in one process: a picture for each line of a file or of a pipe, with the packs and the device open all the while.

mod archive;
mod groups;
mod index;
mod labels;
mod line;
mod lines;
mod packs;
mod put;
mod source;
mod studio;

use std::cell::RefCell;
use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result, bail};
use welkin_pack::interrupt;
use welkin_pack::place::verify_apart;
use welkin_pack::whole::sweep;
use welkin_viewer::export::sequence::Shard;
use welkin_viewer::gpu::Gpu;

use self::archive::{Archive, tar_name};
use self::groups::{Group, Groups, Placed};
use self::index::{Index, file_name};
use self::line::Line;
use self::put::put;
use self::source::{Numbered, Source};
use self::studio::{Finished, Studio};
use super::pipeline::{Next, overlap};
use super::progress::progress;
use crate::cli::RenderArgs;
use crate::told::tell_leftovers;

/// What is done of a job.
enum Done {
    /// It was there.
    Kept(String),
    /// Its files are written.
    Written(Line),
    /// It is to go into a tar file.
    Finished(Finished, Group),
}

/// Draws the jobs of a file, or those that come through standard input.
pub fn run(args: &RenderArgs, jobs: &Path) -> Result<()> {
    let (folder, shard) = (&args.output, args.export.shard.unwrap_or(Shard::WHOLE));
    let (force, tar) = (args.jobs.force, args.jobs.tar);
    let mut source = Source::open(jobs)?;
    if source.is_file() {
        verify_apart(&[jobs], &[&folder.join(file_name(shard))])?;
    }
    let gpu = Gpu::open(args.gpu.gpu.as_ref())?;
    let labels = args.jobs.labels();
    let mut studio = Studio::open(&gpu, args, &labels, source.base())?;
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
    let (mut numbered, mut groups) = (Numbered::new(shard), Groups::new(tar, force));
    let mut archive = Archive::default();
    let tar_of = |number| tar_name(shard, number);
    let done = {
        // Lines are added while pictures are begun, each by its own part.
        let index = RefCell::new(&mut index);
        overlap(
            |may_wait| {
                loop {
                    if interrupt::requested() {
                        return Ok(Next::End);
                    }
                    match groups.next() {
                        Some(Placed::Kept(name)) => return Ok(Next::Begun(Err(name))),
                        Some(Placed::Task(task, group)) => {
                            return Ok(Next::Begun(Ok((studio.begin(*task)?, group))));
                        }
                        None => {}
                    }
                    let Some(line) = source.next(may_wait)? else {
                        return Ok(Next::Later);
                    };
                    let Some((number, text)) = line else {
                        if groups.is_empty() {
                            return Ok(Next::End);
                        }
                        groups.end(&index.borrow(), tar_of)?;
                        continue;
                    };
                    let at = || source::at(jobs, number);
                    if let Some(job) = numbered.job(&text, number).with_context(at)? {
                        let task = studio.task(job).with_context(at)?;
                        groups.add((task, at()), &index.borrow(), tar_of)?;
                    }
                }
            },
            |begun| match begun {
                Ok((work, group)) => Ok(Ok((work.wait(&gpu)?, group))),
                Err(name) => Ok(Err(name)),
            },
            |back| match back {
                Err(name) => Ok(Done::Kept(name)),
                Ok((work, group)) => {
                    let finished = work.finish(folder)?;
                    match tar {
                        None => write(folder, finished, &group, force).map(Done::Written),
                        Some(_) => Ok(Done::Finished(finished, group)),
                    }
                }
            },
            |done| {
                let mut index = index.borrow_mut();
                let lines = match done {
                    Done::Kept(name) => {
                        kept += 1;
                        bar.inc(1);
                        index.keep(name);
                        return Ok(());
                    }
                    Done::Written(line) => vec![line],
                    Done::Finished(finished, group) => {
                        let file = tar_of(group.number);
                        archive.add((finished, &group), folder, file, force)?
                    }
                };
                for line in lines {
                    drawn += 1;
                    bar.inc(1);
                    index.add(&line)?;
                }
                Ok(())
            },
        )
    };
    bar.finish_and_clear();
    index.close(done.is_ok() && !interrupt::requested())?;
    done?;
    let told = format!("{drawn} drawn, {kept} were there");
    if interrupt::requested() {
        bail!("interrupted: {told}; run it again to go on");
    }
    writeln!(std::io::stderr(), "{}: {told}", folder.display()).ok();
    Ok(())
}

/// Writes the files of a picture, the picture last.
fn write(folder: &Path, finished: Finished, group: &Group, force: bool) -> Result<Line> {
    let Finished { mut line, files } = finished;
    for (kind, file, bytes) in files {
        let may_replace = force || group.own.contains(&file);
        let made = put(folder, file, &bytes, may_replace)?;
        line.files.insert(kind, made);
    }
    Ok(line)
}
