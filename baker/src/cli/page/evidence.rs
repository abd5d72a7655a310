//! What can be seen of a channel: picture, 2x2 view, histogram, spectrum, levels.

use std::fmt::Write;

use anyhow::Result;
use welkin_pack::check::radial_spectrum;
use welkin_pack::role::{Filter, Wrap};
use welkin_pack::texture::decode;
use welkin_pack::{Image, Role, Shape, Texture};

use super::chart;
use super::picture::{self, Pictures, Shown};
use crate::cli::{preview, sky};

/// Most pixels a side of a picture, and of those of a cube, of which there are six.
const MOST: u32 = 256;
const MOST_OF_A_FACE: u32 = 128;

/// Most pixels a side of all layers of the clear sky: those of the default recipe.
const MOST_OF_A_SHEET: u32 = 640;

/// Most pixels a side of a picture of a higher level.
const MOST_OF_A_LEVEL: u32 = 64;

/// Most texels a side that a spectrum is made of: 16 MiB of numbers.
const MOST_OF_A_SPECTRUM: u32 = 1024;

/// Pixels a side on the screen, and of a level.
const SIDE: u32 = 208;

/// A texture's size in words.
pub fn size(texture: &Texture) -> String {
    let layers = match texture.shape {
        Shape::D2 => String::new(),
        Shape::Array => format!(", {} layers", texture.layers),
        Shape::Cube => ", 6 faces".to_string(),
    };
    let (width, height, format) = (texture.width, texture.height, texture.format.name());
    let levels = match texture.levels.len() {
        1 => "1 level".to_string(),
        n => format!("{n} levels"),
    };
    format!("{width}\u{d7}{height} {format}{layers}, {levels}")
}

/// Radiance in colour, as the preview shows it: the clear sky at some hours, the faces of a skybox. Nothing of other roles.
pub fn colour(role: Role, texture: &Texture, pictures: &mut Pictures) -> Result<String> {
    let shown: Vec<(String, Image)> = match role {
        Role::Sky => sky::looks(texture)
            .into_iter()
            .map(|look| (look.caption(), look.image))
            .collect(),
        Role::Skybox => (0..texture.layers)
            .map(|layer| {
                let face = role.layer_name(layer).unwrap_or_default();
                (face, texture.image(0, layer))
            })
            .collect(),
        _ => return Ok(String::new()),
    };
    let mut html = "<div class=\"row colour\">\n".to_string();
    for (caption, image) in shown {
        let most = if role == Role::Sky {
            MOST
        } else {
            MOST_OF_A_FACE
        };
        let shown = picture::colour(pictures, &preview::in_colour(&image), most)?;
        html += &figure(&shown, SIDE, "", &caption, &caption);
    }
    Ok(html + "</div>\n")
}

/// A picture with a line below it, `side` pixels on the screen.
fn figure(shown: &Shown, side: u32, crisp: &str, label: &str, caption: &str) -> String {
    let [width, height] = shown.size;
    let longer = width.max(height).max(1);
    let [on_screen, rows] = [width, height].map(|texels| (texels * side / longer).max(1));
    format!(
        "<figure><div class=\"picture{crisp} {}\" style=\"width:{on_screen}px;height:{rows}px\" role=\"img\" \
         aria-label=\"{label}\"></div><figcaption>{caption}</figcaption></figure>\n",
        shown.class
    )
}

/// All that is to be seen of a channel, a row a layer; of the clear sky's many layers one picture.
pub fn channel(
    role: Role,
    texture: &Texture,
    channel: usize,
    pictures: &mut Pictures,
) -> Result<String> {
    if role == Role::Sky {
        return of_sky(texture, channel, pictures);
    }
    let mut html = String::new();
    for layer in 0..texture.layers {
        html += &one_layer(role, texture, channel, layer, pictures)?;
    }
    Ok(html)
}

fn of_sky(texture: &Texture, channel: usize, pictures: &mut Pictures) -> Result<String> {
    let (role, spec) = (Role::Sky, &Role::Sky.spec().channels[channel]);
    let image = sky::sheet(texture, channel);
    let shown = picture::channel(pictures, role, &image, channel, MOST_OF_A_SHEET)?;
    let label = format!("{} {}", role.name(), spec.name);
    let size = format!("{}\u{d7}{}", image.width, image.height);
    let caption = format!(
        "{size}: suns across, zenith on top; below the aureole's light, then both with more haze"
    );
    let picture = figure(&shown, shown.size[0], "", &label, &caption);
    let histogram = chart::histogram(&image.texels, texture.format, spec.range, spec.unit);
    Ok(format!(
        "<div class=\"row\">\n{picture}<div class=\"charts\">{histogram}</div>\n</div>\n"
    ))
}

fn one_layer(
    role: Role,
    texture: &Texture,
    channel: usize,
    layer: u32,
    pictures: &mut Pictures,
) -> Result<String> {
    let spec = &role.spec().channels[channel];
    let image = one_channel(texture, 0, layer, channel);
    let most = match texture.shape {
        Shape::Cube => MOST_OF_A_FACE,
        Shape::D2 | Shape::Array => MOST,
    };
    let shown = picture::channel(pictures, role, &image, channel, most)?;
    let name = role.layer_name(layer);
    let title = match &name {
        Some(name) if texture.shape == Shape::Array && role != Role::Layers => {
            format!("<h4>layer {name}</h4>\n")
        }
        Some(name) => format!("<h4>{name}</h4>\n"),
        None => String::new(),
    };
    let mut html = format!("{title}<div class=\"row\">\n");
    let label = format!("{} {} {}", role.name(), name.unwrap_or_default(), spec.name);
    html += &picture(&shown, &image, role, spec.name, &label);
    // The gradient does not tile, though its texture does.
    if role.spec().wrap == Wrap::Repeat && spec.name != "gradient" {
        let _ = writeln!(
            html,
            "<figure><div class=\"picture seam{} {}\" style=\"width:{SIDE}px;height:{SIDE}px\" role=\"img\" \
             aria-label=\"{label}, 2 by 2\"></div><figcaption>2\u{d7}2, seams cross in the middle</figcaption></figure>",
            crisp(&shown, role),
            shown.class
        );
    }
    let histogram = chart::histogram(&image.texels, texture.format, spec.range, spec.unit);
    let _ = write!(
        html,
        "<div class=\"charts\">{histogram}{}</div>\n</div>\n",
        spectrum(texture, channel, layer)
    );
    if texture.levels.len() > 1 {
        html += &ladder(role, texture, channel, layer, pictures)?;
    }
    Ok(html)
}

fn picture(shown: &Shown, image: &Image, role: Role, channel: &str, label: &str) -> String {
    let [width, height] = shown.size;
    let mut caption = format!("{}\u{d7}{}", image.width, image.height);
    if [width, height] != [image.width, image.height] {
        let how = match role.spec().filter {
            Filter::Nearest => "upper left",
            Filter::Linear => "shown as",
        };
        let _ = write!(caption, ", {how} {width}\u{d7}{height}");
    }
    if preview::is_star_light(role, channel) {
        caption += ", cube root";
    }
    figure(shown, SIDE, crisp(shown, role), label, &caption)
}

/// One channel of an image of a texture: a quarter of the memory of all.
fn one_channel(texture: &Texture, level: usize, layer: u32, channel: usize) -> Image {
    let (width, height) = texture.level_size(level);
    let bytes = texture.level_bytes(level) / texture.layers as usize;
    let format = texture.format;
    let value = format.bytes_per_channel();
    let start = bytes * layer as usize;
    let texels = texture.levels[level][start..start + bytes].chunks_exact(format.bytes_per_texel());
    let of_channel = texels.flat_map(|texel| &texel[channel * value..(channel + 1) * value]);
    let stored: Vec<u8> = of_channel.copied().collect();
    Image {
        width,
        height,
        channels: 1,
        texels: decode(format, &stored),
    }
}

/// Texels that are larger than pixels, and records, are shown as squares.
fn crisp(shown: &Shown, role: Role) -> &'static str {
    if shown.size[0].max(shown.size[1]) < SIDE || role.spec().filter == Filter::Nearest {
        " crisp"
    } else {
        ""
    }
}

/// Of the first level that is not too large.
fn spectrum(texture: &Texture, channel: usize, layer: u32) -> String {
    let fits = |level: &usize| texture.level_size(*level).0 <= MOST_OF_A_SPECTRUM;
    let level = (0..texture.levels.len()).find(fits);
    let Some(energy) =
        level.and_then(|level| radial_spectrum(&one_channel(texture, level, layer, channel), 0))
    else {
        return String::new();
    };
    chart::spectrum(&energy)
}

/// Every higher level, all of one size on the screen: what a level has lost stands out.
fn ladder(
    role: Role,
    texture: &Texture,
    channel: usize,
    layer: u32,
    pictures: &mut Pictures,
) -> Result<String> {
    let mut html = "<div class=\"ladder\">".to_string();
    for level in 1..texture.levels.len() {
        let image = one_channel(texture, level, layer, channel);
        let shown = picture::channel(pictures, role, &image, channel, MOST_OF_A_LEVEL)?;
        let crisp = if shown.size[0] < MOST_OF_A_LEVEL {
            " crisp"
        } else {
            ""
        };
        let _ = write!(
            html,
            "<figure><div class=\"picture{crisp} {}\" role=\"img\" aria-label=\"level {level}\"></div><figcaption>{}</figcaption></figure>",
            shown.class, image.width
        );
    }
    html += "</div>\n";
    Ok(html)
}
