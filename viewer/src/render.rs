//! `welkin-view render`: a pack's sky as a picture, an environment map, or a sequence of either.

mod artist;
mod jobs;
mod oktas;
mod pipeline;
mod progress;
mod sequence;

use std::path::Path;

use anyhow::{Error, Result, ensure};
use welkin_pack::place::verify_apart;
use welkin_pack::whole::sweep_beside;
use welkin_pack::{Pack, Role};
use welkin_runtime::{Method, Oktas, SkyError};
use welkin_viewer::constellations;
use welkin_viewer::export::Environment;
use welkin_viewer::export::light::Light;
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::render;
use welkin_viewer::save::save;

use crate::cli::{RenderArgs, Shot};
use crate::save_light::{self, json_path};
use crate::told::tell_leftovers;
use artist::Artist;
use oktas::cover_for_oktas;

pub fn run(args: &RenderArgs) -> Result<()> {
    if let Some(jobs) = &args.jobs.jobs {
        return jobs::run(args, jobs);
    }
    // The name is checked before anything slow begins.
    let shot = args.shot().map_err(Error::msg)?;
    let prefiltered = args.export.prefiltered;
    let json = prefiltered.then(|| json_path(&args.output));
    let outputs = [Some(&args.output), args.shadow.as_ref(), json.as_ref()];
    let outputs: Vec<&Path> = outputs.into_iter().flatten().map(AsRef::as_ref).collect();
    verify_apart(&[&args.pack], &outputs)?;
    let pack = Pack::open(&args.pack)?;
    ensure!(
        !args.settings.is_given("skybox") || pack.texture(Role::Skybox).is_some(),
        "{}: has no skybox, so --skybox changes nothing; leave it out, or bake a pack from a recipe with a [skybox] table",
        args.pack.display()
    );
    let mut view = args.view();
    ensure!(
        view.params.method != Method::Sprites || pack.field().is_some(),
        "{}: {}",
        args.pack.display(),
        SkyError::MissingField
    );
    if let Some(oktas) = args.oktas {
        view.params.cover = cover_for_oktas(&Oktas::new(&pack)?, &view.params, oktas)?;
    }
    let gpu = Gpu::open(args.gpu.gpu.as_ref())?;
    let sequence = args.export.sequence(view.seconds);
    tell_leftovers(&sweep_beside(&args.output));
    match (shot, sequence) {
        (Shot::Frame(format), None) => {
            let mut drawn = render(&gpu, &pack, format.target(), &view)?;
            if let Some(date) = view.params.date.filter(|_| args.constellations) {
                let now = date.after(view.seconds);
                constellations::draw(&mut drawn.frame, &view.camera, now, view.params.place);
            }
            save(&args.output, &drawn.frame)?;
            if let (Some(file), Some(shadow)) = (&args.shadow, &drawn.shadow) {
                save(file, shadow)?;
            }
            Ok(())
        }
        (Shot::Ktx2(side), None) if prefiltered => {
            let map = Environment::new(&gpu, &pack)?.cubemap(&view, side)?;
            save_light::save(&Light::of(map), &args.output, &args.pack)
        }
        (shot, sequence) => {
            let settings = &args.settings;
            let azimuth_deg = if settings.is_given("azimuth") {
                settings.settings.view.azimuth_deg
            } else {
                0.0
            };
            let shot = (shot, azimuth_deg.to_radians());
            match sequence {
                None => artist::draw(&gpu, pack, shot, &view, &args.output),
                Some(sequence) => {
                    let mut artist = Artist::new(&gpu, pack);
                    sequence::draw(&gpu, &mut artist, shot, &view, &sequence, &args.output)
                }
            }
        }
    }
}
