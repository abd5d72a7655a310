//! `welkin preview`: every channel of every texture on one labelled sheet.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use image::imageops::{self, FilterType};
use image::{ExtendedColorType, GrayImage, Rgb, RgbImage};
use welkin_pack::manifest::{Channel, TextureEntry};
use welkin_pack::role::Filter;
use welkin_pack::texture::unorm8;
use welkin_pack::{Image, Manifest, Pack, Role, Texture};

use super::sheet::{self, PANEL, Panel, Section};
use super::{file, input, interrupt, picture, sky};

/// Textures that are read texel by texel are shown in part, each texel at least this many pixels large.
const TEXEL_PIXELS: u32 = 2;

/// Brings the brightest sky near to white; the sheet needs no more than that the hues are right.
const SKY_EXPOSURE: f32 = 1.5;

#[derive(Debug, Args)]
pub struct PreviewArgs {
    /// Folder of the pack
    pack: PathBuf,
    /// PNG to write; a file of that name is replaced
    #[arg(short, long, value_name = "FILE.png")]
    output: PathBuf,
}

pub fn run(args: &PreviewArgs) -> Result<()> {
    file::verify_png(&args.output, &args.pack)?;
    let pack = input::pack(&args.pack)?;
    let manifest = pack.manifest();
    let sections: Vec<Section> = manifest
        .textures
        .iter()
        .flat_map(|entry| sections(&pack, entry))
        .collect();
    interrupt::stop_if_requested()?;
    let sheet = sheet::lay_out(
        &format!("pack {}", manifest.name),
        &summary(manifest),
        sections,
    );
    let png = picture::png(
        sheet.width,
        sheet.height,
        ExtendedColorType::Rgb8,
        &sheet.rgb,
    )?;
    file::write(&args.output, &png)
}

fn summary(manifest: &Manifest) -> String {
    let bytes: u64 = manifest
        .textures
        .iter()
        .map(|texture| texture.file_bytes)
        .sum();
    let textures = manifest.textures.len();
    format!(
        "seed {}, baked by {}, {textures} textures, {} kB. channels are shown from 0 (black) to 1 (white)",
        manifest.seed,
        manifest.baker,
        bytes.div_ceil(1000)
    )
}

fn sections(pack: &Pack, entry: &TextureEntry) -> Vec<Section> {
    let Some(texture) = pack.texture(entry.role) else {
        return Vec::new();
    };
    match entry.role {
        Role::Skybox => return skybox(texture, entry),
        Role::Sky => return clear_sky(texture, entry),
        _ => {}
    }
    (0..texture.layers)
        .map(|layer| section(&texture.image(0, layer), entry, layer))
        .collect()
}

fn section(image: &Image, entry: &TextureEntry, layer: u32) -> Section {
    let channels = entry.channels.iter().enumerate();
    let panels: Vec<Panel> = channels
        .map(|(i, channel)| channel_panel(entry, image, i, channel))
        .collect();
    let layer = entry.role.layer_name(layer);
    let layer = layer.map_or(String::new(), |name| format!(" {name}"));
    Section {
        title: format!("{}{layer}", entry.role.name()),
        note: picture::size_of(entry),
        panels,
    }
}

/// The faces in colour, and what they cover.
fn skybox(texture: &Texture, entry: &TextureEntry) -> Vec<Section> {
    let faces: Vec<(String, Image)> = (0..texture.layers)
        .map(|layer| {
            let name = entry.role.layer_name(layer).unwrap_or_default();
            (name, texture.image(0, layer))
        })
        .collect();
    let section = |channels: &str, panel: &dyn Fn(&Image) -> RgbImage| Section {
        title: format!("{} {channels}", entry.role.name()),
        note: picture::size_of(entry),
        panels: faces
            .iter()
            .map(|(name, image)| Panel {
                title: name.clone(),
                note: channels.to_string(),
                width: PANEL,
                height: PANEL,
                pixels: imageops::resize(&panel(image), PANEL, PANEL, FilterType::Triangle)
                    .pixels()
                    .map(|p| p.0)
                    .collect(),
            })
            .collect(),
    };
    vec![
        section("colour", &in_colour),
        section("cover", &|image| {
            RgbImage::from_fn(image.width, image.height, |x, y| {
                Rgb([unorm8(image.texel(x, y)[3]); 3])
            })
        }),
    ]
}

/// The clear sky at some hours in colour, and every layer of each channel.
fn clear_sky(texture: &Texture, entry: &TextureEntry) -> Vec<Section> {
    let look = |look: sky::Look| {
        let shown = in_colour(&look.image);
        Panel {
            title: format!("sun {:.0} deg", look.sun_deg),
            note: "sun in the middle, zenith on top".to_string(),
            width: shown.width(),
            height: shown.height(),
            pixels: shown.pixels().map(|p| p.0).collect(),
        }
    };
    let channel = |(index, channel): (usize, &Channel)| {
        let sheet = sky::sheet(texture, index);
        Panel {
            note: "suns across, zenith on top".to_string(),
            ..channel_panel(entry, &sheet, 0, channel)
        }
    };
    let section = |what: &str, panels| Section {
        title: format!("{} {what}", entry.role.name()),
        note: picture::size_of(entry),
        panels,
    };
    vec![
        section(
            "colour",
            sky::looks(texture).into_iter().map(look).collect(),
        ),
        section(
            "layers",
            entry.channels.iter().enumerate().map(channel).collect(),
        ),
    ]
}

/// Radiance as a colour picture.
pub fn in_colour(image: &Image) -> RgbImage {
    RgbImage::from_fn(image.width, image.height, |x, y| {
        let texel = image.texel(x, y);
        Rgb([texel[0], texel[1], texel[2]].map(display))
    })
}

/// Most stars are so faint that only the cube root of their light shows on paper.
pub fn is_star_light(role: Role, channel: &str) -> bool {
    role == Role::Stars && ["intensity", "variance"].contains(&channel)
}

/// How a channel is shown: the cube root of the light of stars, all else as it is.
pub fn curve(role: Role, channel: &str) -> fn(f32) -> f32 {
    if is_star_light(role, channel) {
        libm::cbrtf
    } else {
        |value| value
    }
}

fn channel_panel(entry: &TextureEntry, image: &Image, index: usize, channel: &Channel) -> Panel {
    let is_star_light = is_star_light(entry.role, &channel.name);
    let curve = curve(entry.role, &channel.name);
    let grey: Vec<u8> = image
        .channel(index)
        .map(|value| unorm8(curve(value)))
        .collect();
    // The image has just as many values as texels, so the buffer fits.
    let grey = GrayImage::from_raw(image.width, image.height, grey).unwrap_or_default();
    let (shown, part) = match entry.sampler.filter {
        Filter::Linear => (fit(&grey), String::new()),
        Filter::Nearest => magnified_corner(&grey),
    };
    Panel {
        title: channel.name.clone(),
        note: if is_star_light {
            format!("cube root{part}")
        } else {
            statistics(image, index) + &part
        },
        width: shown.width(),
        height: shown.height(),
        pixels: shown.pixels().map(|p| [p.0[0]; 3]).collect(),
    }
}

/// Of this layer: the manifest's figures are of all layers together.
fn statistics(image: &Image, channel: usize) -> String {
    let (mean, spread) = image.mean_and_spread(channel);
    format!("mean {mean:.3} spread {spread:.3}")
}

/// Resized so that the longer side is a panel's.
fn fit(grey: &GrayImage) -> GrayImage {
    let longer = grey.width().max(grey.height()).max(1);
    let [width, height] = [grey.width(), grey.height()].map(|side| (side * PANEL / longer).max(1));
    imageops::resize(grey, width, height, FilterType::Triangle)
}

/// The upper left corner with every texel as a square, so that single texels can be seen.
fn magnified_corner(grey: &GrayImage) -> (GrayImage, String) {
    let longer = grey.width().max(grey.height()).max(1);
    let pixels = (PANEL / longer).max(TEXEL_PIXELS);
    let [width, height] = [grey.width(), grey.height()].map(|side| side.min(PANEL / pixels));
    let corner = imageops::crop_imm(grey, 0, 0, width, height).to_image();
    let [shown_width, shown_height] = [width, height].map(|side| side * pixels);
    let shown = imageops::resize(&corner, shown_width, shown_height, FilterType::Nearest);
    (shown, format!(" ({width}x{height})"))
}

/// Radiance to an sRGB byte: an exponential shoulder, then the curve of IEC 61966-2-1.
fn display(radiance: f32) -> u8 {
    let linear = 1.0 - libm::expf(-SKY_EXPOSURE * radiance.max(0.0));
    unorm8(if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_display_curve_goes_from_black_to_white_and_never_back() {
        assert_eq!(
            [display(0.0), display(f32::INFINITY), display(-1.0)],
            [0, 255, 0]
        );
        assert!((1..100).all(|i| display(i as f32 * 0.02) >= display((i - 1) as f32 * 0.02)));
        // Night, dusk and day must be told apart on paper.
        assert!(display(0.01) > 10 && display(0.1) > 80 && display(1.0) > 200);
    }

    #[test]
    fn every_shape_fits_a_panel() {
        for (width, height) in [(512, 512), (128, 64), (1, 4096), (64, 1)] {
            let shown = fit(&GrayImage::new(width, height));
            assert!(
                shown.width() <= PANEL && shown.height() <= PANEL,
                "{width}x{height}"
            );
        }
    }
}
