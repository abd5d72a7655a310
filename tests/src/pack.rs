//! Packs for tests: the default one, and changed ones.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::OnceLock;

use welkin_baker::Resolved;
use welkin_pack::mapping::cube_to_direction;
use welkin_pack::{CatalogueStar, Format, Image, LayerKind, Pack, PackInfo, Role, Source};

/// The default recipe's pack, baked once a test program.
///
/// # Panics
/// If it cannot be baked: no test can go on without it.
pub fn default_pack() -> &'static Pack {
    static PACK: OnceLock<Pack> = OnceLock::new();
    PACK.get_or_init(|| {
        welkin_baker::bake(&resolved(), None, &|_| ControlFlow::Continue(()))
            .expect("the default pack bakes")
    })
}

fn resolved() -> Resolved {
    welkin_baker::Recipe::default()
        .resolve(None)
        .expect("the default recipe resolves")
}

/// The pack of a recipe in assets-src/recipes.
///
/// # Panics
/// If it cannot be baked.
pub fn recipe_pack(name: &str) -> Pack {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets-src/recipes");
    let file = folder.join(format!("{name}.toml"));
    let text = std::fs::read_to_string(&file).expect("the recipe is there");
    let resolved = welkin_baker::Recipe::parse(&file.display().to_string(), &text)
        .and_then(|recipe| recipe.resolve(None))
        .expect("the recipe resolves");
    welkin_baker::bake(&resolved, Some(&folder), &|_| ControlFlow::Continue(()))
        .expect("the pack bakes")
}

/// The default pack with `count` octaves of smooth noise: its own, again and again. More than six have cells finer than two texels of
/// its 256, so each stands four times side by side.
///
/// # Panics
/// If that is no pack.
pub fn with_octaves(count: usize) -> Pack {
    let mut sources = sources();
    for source in &mut sources {
        if source.role == Role::Fbm {
            let times = if count > 6 { 4 } else { 1 };
            let images = source.images.iter().map(|image| repeated(image, times));
            source.images = images
                .collect::<Vec<_>>()
                .into_iter()
                .cycle()
                .take(count)
                .collect();
        }
    }
    build(None, sources)
}

/// The default pack with other images and another sun: `change` gets every linear image (one a layer) with its role.
///
/// # Panics
/// If the changed images are no pack any more.
pub fn changed_pack(noon_elevation_rad: Option<f32>, change: impl Fn(Role, &mut Image)) -> Pack {
    let mut sources = sources();
    sources
        .iter_mut()
        .flat_map(|source| source.images.iter_mut().map(|image| (source.role, image)))
        .for_each(|(role, image)| change(role, image));
    build(noon_elevation_rad, sources)
}

/// An image that tiles, so many times along u and along v.
fn repeated(image: &Image, times: u32) -> Image {
    let (width, height) = (times * image.width, times * image.height);
    let mut out = Image::new(width, height, image.channels);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let texel = image.texel(x % image.width, y % image.height);
        out.texel_mut(x, y).copy_from_slice(texel);
    }
    out
}

/// The default pack, with its clouds in space, in a skybox that has one radiance all around.
///
/// # Panics
/// If that is no pack.
pub fn in_skybox(radiance: f32) -> Pack {
    let field = default_pack().field().expect("there is one").clone();
    with_skybox(16, |_| [radiance, radiance, radiance, 1.0])
        .with_any_field(field)
        .expect("the default field is sound")
}

/// The default pack with a skybox of `size` texels a face: `scene` gives radiance times cover and cover along a
/// unit direction.
///
/// # Panics
/// If that is no pack.
pub fn with_skybox(size: u32, scene: impl Fn([f32; 3]) -> [f32; 4]) -> Pack {
    let mut sources = sources();
    sources.push(skybox(size, scene));
    build(None, sources)
}

fn skybox(size: u32, scene: impl Fn([f32; 3]) -> [f32; 4]) -> Source {
    let face = |face| {
        let mut image = Image::new(size, size, 4);
        for (i, texel) in (0..).zip(image.texels.chunks_exact_mut(4)) {
            let st = [i % size, i / size].map(|c| (c as f32 + 0.5) / size as f32);
            texel.copy_from_slice(&scene(cube_to_direction(face, st)));
        }
        image
    };
    Source {
        role: Role::Skybox,
        format: Format::Rgba16Float,
        images: (0..6).map(face).collect(),
    }
}

/// The default recipe's pack by another seed, made so that a picture shows nothing but opacity: by night its clouds are black,
/// before a skybox of radiance 1.
///
/// # Panics
/// If that is no pack.
pub fn opacity_alone(seed: u64) -> Pack {
    let resolved = welkin_baker::Recipe::default()
        .resolve(Some(seed))
        .expect("the default recipe resolves");
    let mut sources =
        welkin_baker::sources(&resolved, None, &|_| ControlFlow::Continue(())).expect("the images");
    for source in sources.iter_mut().filter(|s| s.role == Role::Sky) {
        source.images.iter_mut().for_each(|i| i.texels.fill(0.0));
    }
    sources.push(skybox(16, |_| [1.0; 4]));
    build(None, sources)
}

/// The default images, made once a test program.
fn sources() -> Vec<Source> {
    static SOURCES: OnceLock<Vec<Source>> = OnceLock::new();
    let made = SOURCES.get_or_init(|| {
        welkin_baker::sources(&resolved(), None, &|_| ControlFlow::Continue(()))
            .expect("the default images are made")
    });
    made.clone()
}

fn build(noon_elevation_rad: Option<f32>, sources: Vec<Source>) -> Pack {
    let defaults = default_pack().manifest();
    let info = PackInfo {
        name: "changed".to_string(),
        seed: defaults.seed,
        baker: "welkin-tests".to_string(),
        recipe: String::new(),
        inputs: Vec::new(),
        noon_elevation_rad: noon_elevation_rad.unwrap_or(defaults.noon_elevation_rad),
        aerosol_depths: defaults.aerosol_depths,
        noise: resolved().clouds.noise,
        detail: resolved().clouds.detail,
    };
    Pack::build(info, sources).expect("the changed pack is sound")
}

/// A pack whose sky is black, without a galaxy: nothing but the stars is left.
pub fn stars_alone() -> Pack {
    changed_pack(None, |role, image| match role {
        Role::Sky | Role::Galaxy => image.texels.fill(0.0),
        _ => {}
    })
}

/// The built-in catalogue's own file.
pub const CATALOGUE: &[u8] = include_bytes!("../../assets-src/stars/stars.6.json");

/// The pack of the recipe of a winter night, baked once a test program.
///
/// # Panics
/// If it cannot be baked: no test can go on without it.
pub fn catalogued() -> &'static Pack {
    static PACK: OnceLock<Pack> = OnceLock::new();
    PACK.get_or_init(|| recipe_pack("winter-night"))
}

/// The stars of a pack's catalogue in their order.
pub fn catalogue_records(pack: &Pack) -> Vec<CatalogueStar> {
    let Some(texture) = pack.texture(Role::Catalogue) else {
        return Vec::new();
    };
    let layers = texture.levels[0].chunks_exact(4 * (texture.width * texture.height) as usize);
    let layers: Vec<&[u8]> = layers.collect();
    let texel = |layer: usize, i: usize| std::array::from_fn(|byte| layers[layer][4 * i + byte]);
    let count = layers[1].chunks_exact(4).filter(|t| t[3] == 255).count();
    (0..count)
        .map(|i| CatalogueStar::decode([texel(0, i), texel(1, i), texel(2, i)]))
        .collect()
}

/// The pack of a winter night under a black sky, without a galaxy and without flicker; of the stars those of some magnitudes.
///
/// # Panics
/// If that is no pack.
pub fn catalogue_alone(is_kept: impl Fn(f64) -> bool) -> Pack {
    let mut sources = sources();
    for source in &mut sources {
        if matches!(source.role, Role::Sky | Role::Galaxy) {
            source.images.iter_mut().for_each(|i| i.texels.fill(0.0));
        }
    }
    let size = 128;
    let mut images = vec![Image::new(size, size, 4); 3];
    let stars = catalogue_records(catalogued());
    let kept = stars.into_iter().filter(|star| is_kept(star.magnitude));
    for (i, star) in (0..).zip(kept) {
        let steady = CatalogueStar {
            variance: 0,
            ..star
        };
        for (image, bytes) in images.iter_mut().zip(steady.encode()) {
            let texel = image.texel_mut(i % size, i / size);
            texel.copy_from_slice(&bytes.map(|byte| f32::from(byte) / 255.0));
        }
    }
    sources.push(Source {
        role: Role::Catalogue,
        format: Format::Rgba8Unorm,
        images,
    });
    build(None, sources)
}

/// The default pack without the light of the sky, in a black skybox: a picture shows nothing but what sun or moon make of
/// clouds. `change` gets the linear image of each kind of layer.
///
/// # Panics
/// If that is no pack.
pub fn lit_alone(change: impl Fn(LayerKind, &mut Image)) -> Pack {
    let mut sources = sources();
    for source in &mut sources {
        match source.role {
            Role::Sky => source.images.iter_mut().for_each(|i| i.texels.fill(0.0)),
            Role::Layers => {
                let kinds = LayerKind::ALL.into_iter().zip(&mut source.images);
                kinds.for_each(|(kind, image)| change(kind, image));
            }
            _ => {}
        }
    }
    sources.push(skybox(16, |_| [0.0, 0.0, 0.0, 1.0]));
    build(None, sources)
}
