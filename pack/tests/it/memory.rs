//! What a check takes of memory: no more than the largest texture and 256 MB, whatever a small file claims to hold.

use std::collections::BTreeMap;

use welkin_pack::check::check_memory;
use welkin_pack::manifest::{Channel, FractalNoise, MANIFEST_FILE, Sampler, TextureEntry, VERSION};
use welkin_pack::{Field, Format, Manifest, Role, Texture, ktx};

/// What a check may take beside the texels of one texture.
const MOST_BYTES: u64 = 256_000_000;

/// Lists, the report, and what a decoder keeps whatever the size.
const SLACK_BYTES: u64 = 1_000_000;

fn texture(role: Role, format: Format, [width, height]: [u32; 2], byte: u8) -> Texture {
    let spec = role.spec();
    let mut texture = Texture {
        format,
        shape: spec.shape,
        width,
        height,
        layers: spec.layers[1],
        levels: Vec::new(),
    };
    if spec.least_cells.is_some() {
        texture.layers = width.ilog2() - 2;
    }
    for level in 0..spec.mips.count(width, height) {
        texture.levels.push(vec![byte; texture.level_bytes(level)]);
    }
    texture
}

fn hash(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

/// A pack of this texture alone, with true hashes and seal.
fn files(role: Role, texture: &Texture) -> BTreeMap<String, Vec<u8>> {
    let spec = role.spec();
    let file = ktx::encode("t", texture, "test").expect("a file");
    let channel = |spec: &welkin_pack::role::ChannelSpec| Channel {
        name: spec.name.to_string(),
        meaning: spec.meaning.to_string(),
        unit: spec.unit.to_string(),
        range: spec.range,
        mean: 0.0,
        spread: 0.0,
        fractal: spec.is_fractal.then_some(FractalNoise {
            cells: 4,
            octaves: 5,
            gain: 0.5,
            mean: 0.26,
        }),
    };
    let entry = TextureEntry {
        role,
        file: role.file(),
        format: texture.format,
        shape: texture.shape,
        width: texture.width,
        height: texture.height,
        layers: texture.layers,
        levels: texture.levels.len() as u32,
        sampler: Sampler {
            wrap: spec.wrap,
            filter: spec.filter,
        },
        channels: spec.channels.iter().map(channel).collect(),
        file_bytes: file.len() as u64,
        file_blake3: hash(&file),
        texels_blake3: texture.blake3().to_hex().to_string(),
    };
    let manifest = Manifest {
        kind: "welkin-pack".to_string(),
        version: VERSION,
        name: "bomb".to_string(),
        seed: 1,
        baker: "test".to_string(),
        recipe: String::new(),
        inputs: Vec::new(),
        noon_elevation_rad: 1.0,
        aerosol_depths: [0.04, 0.24],
        textures: vec![entry],
        field: None,
        seal: "0".repeat(64),
    };
    let text = serde_json::to_string_pretty(&manifest).expect("a text");
    let sealed = text.replace(
        &format!("\"seal\": \"{}\"", manifest.seal),
        &format!("\"seal\": \"{}\"", hash(text.as_bytes())),
    );
    BTreeMap::from([
        (role.file(), file),
        (MANIFEST_FILE.to_string(), sealed.into_bytes()),
    ])
}

/// The largest texture of each role: its format and its size.
const LARGEST: [(Role, Format, [u32; 2]); 10] = [
    (Role::Clouds, Format::Rgba16Float, [4096, 4096]),
    (Role::Stars, Format::Rgba8Unorm, [4096, 4096]),
    (Role::Galaxy, Format::R8Unorm, [8192, 8192]),
    (Role::Sky, Format::Rgba16Float, [64, 64]),
    (Role::Sun, Format::Rg8Unorm, [8192, 8192]),
    (Role::Fbm, Format::Rgba8Unorm, [1024, 1024]),
    (Role::Flares, Format::R8Unorm, [1024, 1024]),
    (Role::Layers, Format::Rgba8Unorm, [1024, 1024]),
    (Role::Sprites, Format::Rgba8Unorm, [2048, 2048]),
    (Role::Skybox, Format::Rgba16Float, [2048, 2048]),
];

/// Checks packs whose textures have a side of this part of the largest, and gives a line of figures for each.
fn check_parts(part: u32) -> Vec<String> {
    let mut lines = Vec::new();
    for (role, format, size) in LARGEST {
        let size = size.map(|side| side / part);
        for byte in [0, 255] {
            let texture = texture(role, format, size, byte);
            let texels: usize = texture.levels.iter().map(Vec::len).sum();
            let files = files(role, &texture);
            let file_bytes: usize = files.values().map(Vec::len).sum();
            drop(texture);
            let mut report = None;
            let taken = allocation_counter::measure(|| {
                report = check_memory("t", &files).ok();
            });
            let report = report.expect("a report");
            let container = report.findings.iter().find(|f| f.rule == "texel-hash");
            let outcome = container.expect("a finding").outcome;
            assert_eq!(outcome, welkin_pack::check::Outcome::Passed, "{role:?}");
            let beyond = taken.bytes_max.saturating_sub(texels as u64);
            lines.push(format!("{role:?} {size:?} {byte}: file {file_bytes} B, texels {texels} B, beyond them {beyond} B"));
            let most = MOST_BYTES / u64::from(part * part) + SLACK_BYTES;
            assert!(beyond <= most, "{role:?} {size:?}: {beyond} of {most}");
        }
    }
    lines
}

/// An eighth of the sides, or with WELKIN_LONG=1 all of them, which takes minutes in a release build:
/// `WELKIN_LONG=1 cargo test --release -p welkin-pack --features write --test it -- memory:: --nocapture`.
#[test]
fn a_check_takes_little_beside_the_texels() {
    let is_long = std::env::var_os("WELKIN_LONG").is_some();
    let lines = check_parts(if is_long { 1 } else { 8 });
    lines.iter().for_each(|line| println!("{line}"));
}

/// A glTF file of 16 MiB with lists of nothing, which took a hundred bytes of memory for three of the file.
#[test]
fn a_field_of_empty_lists_takes_little() {
    for key in ["scenes", "nodes", "buffers", "accessors", "extensionsUsed"] {
        let entry = if key == "extensionsUsed" {
            "\"\","
        } else {
            "{},"
        };
        let mut json = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"{key}\":[");
        json.push_str(&entry.repeat(5_000_000));
        json.push_str(if key == "extensionsUsed" {
            "\"\"]}"
        } else {
            "{}]}"
        });
        json.push_str(&" ".repeat(json.len().next_multiple_of(4) - json.len()));
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        bytes.extend((json.len() as u32 + 28).to_le_bytes());
        bytes.extend((json.len() as u32).to_le_bytes());
        bytes.extend(b"JSON");
        bytes.extend(json.as_bytes());
        bytes.extend([0, 0, 0, 0, b'B', b'I', b'N', 0]);
        let taken = allocation_counter::measure(|| {
            assert!(Field::from_glb("t.glb", &bytes).is_err());
        });
        assert!(taken.bytes_max < 1_000_000, "{key}: {}", taken.bytes_max);
    }
}
