//! `welkin bake`: a recipe becomes a pack, and on request pictures of its channels beside it.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use welkin_baker::{BakeError, FieldBound, FieldSettings, Notice, Progress, Recipe, Resolved};
use welkin_pack::place::verify_apart;
use welkin_pack::whole::{Folder, IsOurs};
use welkin_pack::{Overwrite, verify_place};
use welkin_pack::{Pack, PackError, Role, WriteError};

use super::side::{self, Kind};
use super::{input, interrupt, output};

#[derive(Debug, Args)]
pub struct BakeArgs {
    /// Recipe in TOML; without it the built-in recipe is baked
    recipe: Option<PathBuf>,
    /// Folder to make; missing folders above it are made too
    #[arg(short, long, value_name = "PACK")]
    output: PathBuf,
    /// Seed of every random stream, instead of the recipe's
    #[arg(long, value_name = "N", value_parser = seed, allow_hyphen_values = true)]
    seed: Option<u64>,
    /// Threads to use, 1 to 1024; the bytes are the same with any number [default: one a core]
    #[arg(long, value_name = "N", value_parser = threads, allow_hyphen_values = true)]
    threads: Option<u16>,
    /// Replace a pack that is there already, and the folders of --png and --exr; a folder with anything else in it is kept
    #[arg(long)]
    force: bool,
    /// Also write every channel as it is stored: one 8-bit image each, in a new folder
    #[arg(long, value_name = "DIR")]
    png: Option<PathBuf>,
    /// Also write every channel before it is quantised: one float image each, in a new folder
    #[arg(long, value_name = "DIR")]
    exr: Option<PathBuf>,
}

/// More than any machine has today.
const MOST_THREADS: u16 = 1024;

fn seed(text: &str) -> Result<u64, String> {
    text.parse()
        .map_err(|_| format!("expected a whole number from 0 to {}", u64::MAX))
}

fn threads(text: &str) -> Result<u16, String> {
    match text.parse() {
        Ok(count) if (1..=MOST_THREADS).contains(&count) => Ok(count),
        _ => Err(format!("expected a whole number from 1 to {MOST_THREADS}")),
    }
}

pub fn run(args: &BakeArgs) -> Result<()> {
    if let Some(threads) = args.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global()?;
    }
    let recipe = args
        .recipe
        .as_deref()
        .map_or_else(|| Ok(Recipe::default()), input::recipe)?;
    let resolved = recipe.resolve(args.seed)?;
    // Photographs are named from the recipe's folder.
    let base = args.recipe.as_deref().and_then(Path::parent);
    verify_places(args, &resolved, base)?;
    tell_bound(&resolved);
    let ours = args.force.then_some(side::is_ours as IsOurs);
    let begin = |place: &Path| Folder::begin(place, ours).map_err(|e| with_force(args, e));
    let png = args.png.as_deref().map(begin).transpose()?;
    let exr = args.exr.as_deref().map(begin).transpose()?;

    let tell = |notice: Notice| output::message(&notice.to_string());
    let pack = unless_interrupted(&resolved, base, tell, welkin_baker::bake)?;
    // A pack that `check` would refuse never appears.
    welkin_baker::verify(&pack)?;
    png.as_ref()
        .map_or(Ok(()), |folder| add_stored(folder, &pack))?;
    exr.as_ref()
        .map_or(Ok(()), |folder| add_linear(folder, &resolved, base))?;

    let saved = pack.save(&args.output, overwrite(args), &interrupt::requested);
    let mut leftovers = saved.map_err(|error| match error {
        PackError::Write(error) => with_force(args, error),
        error => error.into(),
    })?;
    let shown = args.output.display();
    for folder in [png, exr].into_iter().flatten() {
        let published = folder.publish().map_err(|e| with_force(args, e));
        leftovers.extend(published.map_err(|e| anyhow!("{e}; the pack {shown} is baked"))?);
    }
    output::leftovers(leftovers);
    let textures = pack.manifest().textures.len();
    output::message(&format!("{shown}: {textures} textures baked"));
    Ok(())
}

fn overwrite(args: &BakeArgs) -> Overwrite {
    if args.force {
        Overwrite::Replace
    } else {
        Overwrite::Keep
    }
}

/// Each output is a folder of its own, that is free or may be replaced, and no file that is read lies in one.
fn verify_places(args: &BakeArgs, resolved: &Resolved, base: Option<&Path>) -> Result<()> {
    let base = base.unwrap_or(Path::new(""));
    let named = resolved.files().into_iter().map(|file| base.join(file));
    let read: Vec<PathBuf> = args.recipe.iter().cloned().chain(named).collect();
    let read: Vec<&Path> = read.iter().map(PathBuf::as_path).collect();
    let written = [Some(&args.output), args.png.as_ref(), args.exr.as_ref()];
    let written: Vec<&Path> = written
        .into_iter()
        .flatten()
        .map(PathBuf::as_path)
        .collect();
    verify_apart(&read, &written)?;
    verify_place(&args.output, overwrite(args)).map_err(|e| with_force(args, e))
}

/// What is there without --force may be replaced with it.
fn with_force(args: &BakeArgs, error: WriteError) -> anyhow::Error {
    match error {
        WriteError::Exists { .. } if !args.force => {
            anyhow!("{error}, or replace it with --force")
        }
        error => error.into(),
    }
}

/// A field larger than usual is said before memory is taken for it.
fn tell_bound(resolved: &Resolved) {
    const USUAL_BYTES: usize = 8 << 20;
    let bound = resolved.field.as_ref().map(FieldSettings::bound);
    if let Some(bound) = bound.filter(|bound| bound.bytes > USUAL_BYTES) {
        let FieldBound {
            clouds,
            boxes,
            sprites,
            bytes,
        } = bound;
        output::message(&format!(
            "the field may have {sprites} sprites, {boxes} boxes and {clouds} clouds, which take {bytes} bytes of memory at most"
        ));
    }
}

pub type OnProgress<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// Shows a bar on a terminal and nothing elsewhere; passes notices and interruptions on.
pub fn with_progress<T>(tell: &(dyn Fn(Notice) + Sync), work: impl FnOnce(OnProgress) -> T) -> T {
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{bar:24} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    let done = work(&|progress| {
        bar.set_length(progress.total.into());
        bar.set_position(progress.done.into());
        bar.set_message(progress.step);
        if let Some(notice) = progress.notice {
            bar.suspend(|| tell(notice));
        }
        if interrupt::requested() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    bar.finish_and_clear();
    done
}

/// Bakes with a bar. It can be interrupted while a file is read that never ends.
fn unless_interrupted<T: Send + 'static>(
    resolved: &Resolved,
    base: Option<&Path>,
    tell: fn(Notice),
    work: Work<T>,
) -> Result<T> {
    let (resolved, base) = (resolved.clone(), base.map(Path::to_path_buf));
    let done = interrupt::unless_requested(move || {
        with_progress(&tell, |on_progress| {
            work(&resolved, base.as_deref(), on_progress)
        })
    })?;
    Ok(done?)
}

/// [`welkin_baker::bake`] or [`welkin_baker::sources`].
type Work<T> = fn(&Resolved, Option<&Path>, OnProgress) -> Result<T, BakeError>;

fn add_stored(folder: &Folder, pack: &Pack) -> Result<()> {
    for role in Role::ALL {
        if let Some(texture) = pack.texture(role) {
            side::add(folder, role, &side::images(texture), Kind::Png)?;
        }
    }
    Ok(())
}

fn add_linear(folder: &Folder, resolved: &Resolved, base: Option<&Path>) -> Result<()> {
    // It makes again what the pack was made from, so there is nothing new to tell.
    let sources = unless_interrupted(resolved, base, |_| (), welkin_baker::sources)?;
    for source in &sources {
        side::add(folder, source.role, &source.images, Kind::Exr)?;
    }
    Ok(())
}
