//! Baking in the background: the newest job wins, and what it makes is sound or is not handed over.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use anyhow::{Result, anyhow, bail};
use welkin_baker::Recipe;
use welkin_pack::{Overwrite, Pack};
use winit::event_loop::EventLoopProxy;

use super::recipe::with_photo;
use super::wake::{Baked, Wake};
use crate::told::told;

/// What to bake.
#[derive(Clone, Debug)]
pub struct Job {
    /// Where the recipe's text is.
    pub recipe: Text,
    /// A photograph that takes the place of the recipe's.
    pub photo: Option<PathBuf>,
    /// The folder that the pack is written to; a pack that is there is replaced.
    pub save_to: Option<PathBuf>,
}

/// The text of a recipe.
#[derive(Clone, Debug)]
pub enum Text {
    /// In this file; what it names is beside it.
    File(PathBuf),
    /// This one, which names no files.
    Here(String),
}

/// Bakes in the background.
#[derive(Debug)]
pub struct Baker {
    proxy: EventLoopProxy<Wake>,
    /// Number of the newest job; older ones stop.
    newest: Arc<AtomicU64>,
}

impl Baker {
    pub fn new(proxy: EventLoopProxy<Wake>) -> Baker {
        Baker {
            proxy,
            newest: Arc::default(),
        }
    }

    /// Begins a job; one that is at work stops.
    pub fn begin(&self, job: Job) {
        let number = self.newest.fetch_add(1, Ordering::SeqCst) + 1;
        let (proxy, newest) = (self.proxy.clone(), self.newest.clone());
        std::thread::spawn(move || {
            let is_newest = || newest.load(Ordering::SeqCst) == number;
            let tell = |step, share| {
                if is_newest() {
                    // Without a window there is nobody to tell.
                    proxy.send_event(Wake::Baking(step, share)).ok();
                }
            };
            let baked = bake(&job, &is_newest, &tell).map_err(|error| told(&error));
            if is_newest() {
                proxy.send_event(Wake::Baked(baked.into())).ok();
            }
        });
    }
}

fn bake(
    job: &Job,
    is_newest: &(dyn Fn() -> bool + Sync),
    tell: &(dyn Fn(&'static str, f32) + Sync),
) -> Result<Baked> {
    let recipe = read(job)?;
    let base = match &job.recipe {
        Text::File(file) => file.parent(),
        Text::Here(_) => None,
    };
    // A photograph that was dropped has a whole path, which needs no folder to start from.
    let base = base.or(job.photo.as_deref().and_then(Path::parent));
    let notices = Mutex::new(Vec::new());
    let pack = welkin_baker::bake(&recipe.resolve(None)?, base, &|progress| {
        tell(progress.step, progress.done as f32 / progress.total as f32);
        if let (Some(notice), Ok(mut notices)) = (progress.notice, notices.lock()) {
            notices.push(notice.to_string());
        }
        if is_newest() {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    })?;
    tell("check", 1.0);
    let mut warnings = notices.into_inner().unwrap_or_default();
    warnings.extend(checked(&pack)?);
    if let Some(folder) = &job.save_to {
        pack.save(folder, Overwrite::Replace, &|| !is_newest())?;
    }
    Ok(Baked {
        pack,
        saved_to: job.save_to.clone(),
        warnings,
    })
}

/// The warnings of `welkin check` about a pack.
///
/// # Errors
/// The key of the recipe to turn, if the pack is not sound.
fn checked(pack: &Pack) -> Result<Vec<String>> {
    let report = welkin_baker::verify(pack)?;
    Ok(report.problems().map(ToString::to_string).collect())
}

fn read(job: &Job) -> Result<Recipe> {
    let (name, mut text) = match &job.recipe {
        Text::File(file) => {
            let name = file.display().to_string();
            let text = std::fs::read_to_string(file)
                .map_err(|e| anyhow!("{name}: cannot be read: {e}; save the recipe there"))?;
            (name, text)
        }
        Text::Here(text) => ("the pack's recipe".to_string(), text.clone()),
    };
    if let Some(photo) = &job.photo {
        if !photo.is_file() {
            bail!("{}: is no file; drop a photograph", photo.display());
        }
        text = with_photo(&text, photo)?;
    }
    Ok(Recipe::parse(&name, &text)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: &str = "[clouds]\nsize = 64\n[stars]\nsize = 64\ncount = 50\n[galaxy]\nsize = 32\n[fbm]\nsize = 128\n\
         [flares]\nsize = 64\n[layers]\nsize = 64\n[sprites]\nsize = 128\n";

    fn job(text: &str) -> Job {
        Job {
            recipe: Text::Here(text.to_string()),
            photo: None,
            save_to: None,
        }
    }

    #[test]
    fn a_broken_recipe_is_told_with_its_line() {
        let error = bake(&job("seed = 1\ncolour = 3\n"), &|| true, &|_, _| ()).unwrap_err();
        let told = told(&error);
        assert!(told.contains("the pack's recipe:2:1"), "{told}");
    }

    #[test]
    fn a_job_that_is_not_the_newest_stops_and_writes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let save_to = Some(folder.path().join("pack"));
        let job = Job {
            save_to,
            ..job(SMALL)
        };
        let error = bake(&job, &|| false, &|_, _| ()).unwrap_err();
        assert!(told(&error).contains("cancelled"));
        assert_eq!(folder.path().read_dir().unwrap().count(), 0);
    }

    #[test]
    fn a_photograph_becomes_the_photo_channel_and_the_pack_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let photo = folder.path().join("turned.png");
        let built_in = "../assets-src/photos/god-rays-1024.png";
        image::open(built_in)
            .unwrap()
            .rotate90()
            .save(&photo)
            .unwrap();
        let defaults = bake(&job(SMALL), &|| true, &|_, _| ()).unwrap().pack;
        let place = folder.path().join("pack");
        let with = Job {
            photo: Some(photo),
            save_to: Some(place.clone()),
            ..job(SMALL)
        };
        let baked = bake(&with, &|| true, &|_, _| ()).unwrap();
        let red = |pack: &Pack| {
            let clouds = pack.texture(welkin_pack::Role::Clouds).unwrap();
            clouds.levels[0]
                .iter()
                .step_by(4)
                .copied()
                .collect::<Vec<_>>()
        };
        assert_ne!(red(&baked.pack), red(&defaults));
        assert_eq!(Pack::open(place).unwrap(), baked.pack);
    }
}
