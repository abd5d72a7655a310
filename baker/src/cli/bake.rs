//! `welkin bake`: a recipe becomes a pack, and on request pictures of its channels beside it.

use std::fs::File;
use std::io::Read;
use std::ops::ControlFlow;
use std::path::Path;

use anyhow::{Result, anyhow, bail};
use indicatif::{ProgressBar, ProgressStyle};
use welkin_baker::{FieldBound, FieldSettings, Notice, Progress, Recipe, Resolved};
use welkin_pack::pack::Overwrite;
use welkin_pack::{Pack, Role};

use super::BakeArgs;
use super::side::{self, Kind};
use super::whole::Folder;
use super::{interrupt, output};

/// A recipe has some dozens of lines; what is larger is something else.
const MAX_RECIPE_BYTES: u64 = 1 << 20;

pub fn run(args: &BakeArgs) -> Result<()> {
    verify_places(args)?;
    if let Some(threads) = args.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global()?;
    }
    let recipe = args
        .recipe
        .as_deref()
        .map_or_else(|| Ok(Recipe::default()), read_recipe)?;
    let resolved = recipe.resolve(args.seed)?;
    tell_bound(&resolved);
    // Photographs are named from the recipe's folder.
    let base = args.recipe.as_deref().and_then(Path::parent);
    let begin = |place: &Path| Folder::begin(place, args.force, side::is_ours);
    let png = args.png.as_deref().map(begin).transpose()?;
    let exr = args.exr.as_deref().map(begin).transpose()?;

    let bake = |on_progress: OnProgress| welkin_baker::bake(&resolved, base, on_progress);
    let pack = with_progress(&|notice| output::message(&notice.to_string()), bake)?;
    // A pack that `check` would refuse never appears.
    welkin_baker::verify(&pack)?;
    png.as_ref()
        .map_or(Ok(()), |folder| add_stored(folder, &pack))?;
    exr.as_ref()
        .map_or(Ok(()), |folder| add_linear(folder, &resolved, base))?;

    let overwrite = if args.force {
        Overwrite::Replace
    } else {
        Overwrite::Keep
    };
    pack.save(&args.output, overwrite, &interrupt::requested)?;
    for folder in [png, exr].into_iter().flatten() {
        folder.publish()?;
    }
    let textures = pack.manifest().textures.len();
    output::message(&format!(
        "{}: {textures} textures baked",
        args.output.display()
    ));
    Ok(())
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

/// Each of the three is a folder of its own; two in one place would replace each other.
fn verify_places(args: &BakeArgs) -> Result<()> {
    let places = [Some(&args.output), args.png.as_ref(), args.exr.as_ref()];
    let places: Vec<_> = places.into_iter().flatten().collect();
    for (i, place) in places.iter().enumerate() {
        if places[..i].contains(place) {
            bail!(
                "{}: named twice; give -o, --png and --exr a folder each",
                place.display()
            );
        }
    }
    Ok(())
}

fn read_recipe(path: &Path) -> Result<Recipe> {
    let name = path.display().to_string();
    let unreadable = |e| anyhow!("{name}: cannot be read: {e}; expected a recipe in TOML");
    let mut text = String::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(MAX_RECIPE_BYTES + 1)
        .read_to_string(&mut text)
        .map_err(unreadable)?;
    if text.len() as u64 > MAX_RECIPE_BYTES {
        bail!("{name}: is larger than {MAX_RECIPE_BYTES} bytes, expected a recipe in TOML");
    }
    Ok(Recipe::parse(&name, &text)?)
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

fn add_stored(folder: &Folder, pack: &Pack) -> Result<()> {
    for role in Role::ALL {
        if let Some(texture) = pack.texture(role) {
            for layer in 0..texture.layers {
                side::add(folder, role, layer, &texture.image(0, layer), Kind::Png)?;
            }
        }
    }
    Ok(())
}

fn add_linear(folder: &Folder, resolved: &Resolved, base: Option<&Path>) -> Result<()> {
    // It makes again what the pack was made from, so there is nothing new to tell.
    let make = |on_progress: OnProgress| welkin_baker::sources(resolved, base, on_progress);
    let sources = with_progress(&|_| (), make)?;
    for source in &sources {
        for (layer, image) in (0..).zip(&source.images) {
            side::add(folder, source.role, layer, image, Kind::Exr)?;
        }
    }
    Ok(())
}
