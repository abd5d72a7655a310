//! Writes what the fuzz targets start from: `welkin-fuzz-seeds CORPUS` makes a folder a target, each with small files that
//! break no rule, so that what breaks one is a few bytes away.

use std::collections::BTreeMap;
use std::fs;
use std::io::Cursor;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use anyhow::Context;
use image::{ImageFormat, Rgb, Rgba};
use ktx2::{Header, LevelIndex};
use serde_json::Value;
use welkin_baker::{Inputs, Recipe};
use welkin_pack::manifest::MANIFEST_FILE;
use welkin_pack::{Pack, Texture, ktx};

/// Everything as small as it may be.
const SMALL: &str = r#"
name = "small"
[sun]
size = 32
[clouds]
size = 64
photo.file = "clouds.jpg"
[stars]
size = 64
count = 60
[galaxy]
size = 64
[sky]
suns = 16
[fbm]
size = 64
octaves = 2
[flares]
size = 64
[layers]
size = 64
[sprites]
size = 128
[field]
sections = 1
most_sprites = 1000
[skybox]
file = "sky.png"
size = 16
"#;

/// A star each, of every layout.
const CATALOGUES: [(&str, &str); 4] = [
    (
        "star.json",
        r#"{"type":"FeatureCollection","features":[{"id":88,"properties":{"mag":5.71,"bv":"0.911"},"geometry":{"type":"Point","coordinates":[0.2691,-48.8099]}}]}"#,
    ),
    (
        "hyg.csv",
        "id,proper,ra,dec,mag,ci\n91262,\"Vega\",18.61564,38.78369,0.03,-0.001\n",
    ),
    (
        "own.csv",
        "ra_deg;dec_deg;mag;bv\n279.2346;38.78369;0.03;-0.001\n",
    ),
    (
        "bsc.dat",
        "7001                                                                       183656.3+384701             0.03  -0.00\n",
    ),
];

fn main() -> anyhow::Result<()> {
    let corpus = std::env::args_os().nth(1);
    let corpus = PathBuf::from(corpus.context("say where: welkin-fuzz-seeds CORPUS")?);
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets-src");
    let save = |target: &str, name: &str, bytes: &[u8]| -> anyhow::Result<()> {
        let folder = corpus.join(target);
        fs::create_dir_all(&folder)?;
        fs::write(folder.join(name), bytes).with_context(|| format!("{target}/{name}"))
    };
    for (name, text) in CATALOGUES {
        save("catalogue", name, text.as_bytes())?;
    }
    for path in files(&assets.join("recipes"))? {
        save("recipe", &name(&path), &fs::read(&path)?)?;
    }
    save("recipe", "small.toml", SMALL.as_bytes())?;
    for path in files(&assets.join("models"))? {
        if path.extension().is_some_and(|e| e == "gltf" || e == "glb") {
            save("model", &name(&path), &fs::read(&path)?)?;
        }
    }
    for (name, bytes) in pictures()? {
        save("picture", name, &bytes)?;
    }
    let pack = small_pack()?;
    let files: BTreeMap<&str, &[u8]> = pack
        .files()
        .iter()
        .map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
        .collect();
    let manifest = files[MANIFEST_FILE];
    save("manifest", "pack.json", manifest)?;
    save("field", "field.glb", files["field.glb"])?;
    for entry in &pack.manifest().textures {
        let texture = pack.texture(entry.role).context("a texture of the pack")?;
        let packed = files[entry.file.as_str()];
        save("ktx", &entry.file, packed)?;
        let raw = raw_ktx(texture, packed)?;
        save("ktx", &format!("raw-{}", entry.file), &raw)?;
        let one = one_entry(manifest, Some(&entry.file))?;
        save("pack", entry.role.name(), &pack_input(&one, packed))?;
        save(
            "pack",
            &format!("raw-{}", entry.role.name()),
            &pack_input(&one, &raw),
        )?;
    }
    let field = pack_input(&one_entry(manifest, None)?, files["field.glb"]);
    save("pack", "field", &field)
}

fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// The files of a folder and of those in it.
fn files(folder: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            found.extend(files(&path)?);
        } else {
            found.push(path);
        }
    }
    Ok(found)
}

/// A small picture of each format, and of each depth of PNG.
fn pictures() -> anyhow::Result<Vec<(&'static str, Vec<u8>)>> {
    let at = |x: u32, y: u32, c: u32| (x * (5 + c) + y * 7) % 256;
    let rgb = image::RgbImage::from_fn(64, 64, |x, y| Rgb([0, 1, 2].map(|c| at(x, y, c) as u8)));
    let rgba =
        image::RgbaImage::from_fn(64, 32, |x, y| Rgba([0, 1, 2, 3].map(|c| at(x, y, c) as u8)));
    let float = image::Rgb32FImage::from_fn(32, 16, |x, y| {
        Rgb([0, 1, 2].map(|c| at(x, y, c) as f32 / 99.0))
    });
    let write = |picture: &image::DynamicImage, format| -> anyhow::Result<Vec<u8>> {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format)?;
        Ok(bytes.into_inner())
    };
    let (rgb, rgba) = (
        image::DynamicImage::from(rgb),
        image::DynamicImage::from(rgba),
    );
    let float = image::DynamicImage::from(float);
    Ok(vec![
        ("rgb.png", write(&rgb, ImageFormat::Png)?),
        ("rgba.png", write(&rgba, ImageFormat::Png)?),
        ("grey.png", write(&rgb.to_luma8().into(), ImageFormat::Png)?),
        (
            "rgb16.png",
            write(&rgb.to_rgb16().into(), ImageFormat::Png)?,
        ),
        ("rgb.jpg", write(&rgb, ImageFormat::Jpeg)?),
        (
            "grey.jpg",
            write(&rgb.to_luma8().into(), ImageFormat::Jpeg)?,
        ),
        ("float.hdr", write(&float, ImageFormat::Hdr)?),
        ("float.exr", write(&float, ImageFormat::OpenExr)?),
    ])
}

fn small_pack() -> anyhow::Result<Pack> {
    let sky = image::RgbImage::from_fn(64, 32, |x, y| Rgb([x as u8, y as u8, 90]));
    let mut bytes = Cursor::new(Vec::new());
    sky.write_to(&mut bytes, ImageFormat::Png)?;
    let photo =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets-src/photos/clouds-web.jpg");
    let files = BTreeMap::from([
        ("sky.png".to_string(), bytes.into_inner()),
        ("clouds.jpg".to_string(), fs::read(photo)?),
    ]);
    let resolved = Recipe::parse("small.toml", SMALL)?.resolve(None)?;
    let pack = welkin_baker::bake_from(&resolved, Inputs::Memory(&files), &|_| {
        ControlFlow::Continue(())
    });
    Ok(pack?)
}

/// The same file with texels that are not compressed, so that a changed byte is a changed texel.
fn raw_ktx(texture: &Texture, packed: &[u8]) -> anyhow::Result<Vec<u8>> {
    let start = packed.first_chunk().context("a header")?;
    let mut header = Header::from_bytes(start)?;
    header.supercompression_scheme = None;
    let index = header.index;
    let end = (index.kvd_byte_offset + index.kvd_byte_length) as usize;
    let mut bytes = packed[..end].to_vec();
    bytes[..Header::LENGTH].copy_from_slice(&header.as_bytes());
    for (level, texels) in texture.levels.iter().enumerate().rev() {
        let alignment = texture.format.bytes_per_texel().max(4);
        bytes.resize(bytes.len().next_multiple_of(alignment), 0);
        let entry = LevelIndex {
            byte_offset: bytes.len() as u64,
            byte_length: texels.len() as u64,
            uncompressed_byte_length: texels.len() as u64,
        };
        let at = Header::LENGTH + level * LevelIndex::LENGTH;
        bytes[at..at + LevelIndex::LENGTH].copy_from_slice(&entry.as_bytes());
        bytes.extend(texels);
    }
    ktx::decode("raw.ktx2", &bytes)?;
    Ok(bytes)
}

/// The manifest with one texture and no field, or with the field alone.
fn one_entry(manifest: &[u8], file: Option<&str>) -> anyhow::Result<Vec<u8>> {
    let mut manifest: Value = serde_json::from_slice(manifest)?;
    let object = manifest.as_object_mut().context("an object")?;
    object.insert("recipe".to_string(), "".into());
    if file.is_some() {
        object.remove("field");
    }
    let textures = object.get_mut("textures").and_then(Value::as_array_mut);
    textures
        .context("textures")?
        .retain(|entry| Some(entry["file"].as_str().unwrap_or_default()) == file);
    Ok(serde_json::to_vec(&manifest)?)
}

/// An input of the target `pack`: the manifest's length, the manifest, the file.
fn pack_input(manifest: &[u8], file: &[u8]) -> Vec<u8> {
    [&(manifest.len() as u32).to_le_bytes()[..], manifest, file].concat()
}
