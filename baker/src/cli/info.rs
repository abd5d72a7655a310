//! `welkin info`: what is in a pack. What the pack says of itself is quoted so that it stays on its line.
//!
//! `--json` prints one object: `folder` is the folder as it was named, `bytes` the size of all textures'
//! files together, `manifest` the manifest as docs/pack.schema.json describes it, and `field` the clouds by kind.

mod field;

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use clap::Args;
use serde_json::json;
use welkin_pack::manifest::{Channel, FractalNoise, TextureEntry};
use welkin_pack::{Manifest, Pack, shown};

use super::{output, picture};

#[derive(Debug, Args)]
pub struct PackArgs {
    /// Folder of the pack
    pack: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub fn run(args: &PackArgs) -> Result<ExitCode> {
    let pack = Pack::open(&args.pack)?;
    let manifest = pack.manifest();
    let text = if args.json {
        let folder = args.pack.display().to_string();
        let all = json!({
            "folder": folder,
            "bytes": bytes(manifest),
            "manifest": manifest,
            "field": field::json(&pack),
        });
        serde_json::to_string_pretty(&all)? + "\n"
    } else {
        table(manifest)? + &field::table(&pack)?
    };
    output::result(&text)?;
    Ok(ExitCode::SUCCESS)
}

fn bytes(manifest: &Manifest) -> u64 {
    manifest
        .textures
        .iter()
        .map(|texture| texture.file_bytes)
        .sum()
}

fn table(manifest: &Manifest) -> Result<String> {
    let mut text = String::new();
    writeln!(text, "name            {}", shown(&manifest.name))?;
    writeln!(text, "seed            {}", manifest.seed)?;
    writeln!(text, "format version  {}", manifest.version)?;
    writeln!(text, "baked by        {}", shown(&manifest.baker))?;
    writeln!(
        text,
        "sun at noon     {:.1} degrees",
        manifest.noon_elevation_rad.to_degrees()
    )?;
    writeln!(
        text,
        "textures        {}, {} bytes",
        manifest.textures.len(),
        bytes(manifest)
    )?;
    for input in &manifest.inputs {
        let (hash, key) = (shown(&input.blake3), shown(&input.key));
        writeln!(text, "input           {hash} {key}")?;
    }
    for entry in &manifest.textures {
        texture(&mut text, entry)?;
    }
    Ok(text)
}

fn texture(text: &mut String, entry: &TextureEntry) -> std::fmt::Result {
    let (role, size) = (entry.role.name(), picture::size_of(entry));
    let (bytes, file) = (entry.file_bytes, shown(&entry.file));
    writeln!(text, "\n{role}  {size}, {bytes} bytes in {file}")?;
    writeln!(text, "  texels {}", shown(&entry.texels_blake3))?;
    entry.channels.iter().try_for_each(|c| channel(text, c))
}

fn channel(text: &mut String, channel: &Channel) -> std::fmt::Result {
    let Channel {
        name,
        meaning,
        unit,
        range: [low, high],
        mean,
        spread,
        fractal,
    } = channel;
    let unit = if unit == "1" {
        String::new()
    } else {
        format!(" {}", shown(unit))
    };
    let octaves = fractal.map_or_else(String::new, |noise| {
        let FractalNoise {
            cells,
            octaves,
            gain,
            mean,
        } = noise;
        format!(" ({octaves} octaves from {cells} cells, gain {gain}, to the mean {mean})")
    });
    let (name, meaning) = (shown(name), shown(meaning));
    writeln!(
        text,
        "  {name:<10} {low}..{high}{unit}, mean {mean:.4}, spread {spread:.4}: {meaning}{octaves}"
    )
}
