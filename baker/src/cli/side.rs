//! One grey image a channel, as files `ROLE.CHANNEL.png` and `ROLE.CHANNEL.exr`; in arrays and cubes
//! `ROLE.LAYER.CHANNEL.png`, where LAYER is a number from 1, or the name of a face or of a kind of cloud. The layers of the clear sky, a
//! hundred and more, lie one below the other in one image.

use anyhow::Result;
use image::ExtendedColorType;
use welkin_pack::texture::unorm8;
use welkin_pack::whole::Folder;
use welkin_pack::{Image, Role, Texture};

use super::{interrupt, picture};

/// How a channel is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// 8 bits, 0..1 to 0..255; what lies outside is clamped.
    Png,
    /// 32-bit floats, unchanged.
    Exr,
}

impl Kind {
    const fn extension(self) -> &'static str {
        match self {
            Kind::Png => "png",
            Kind::Exr => "exr",
        }
    }
}

/// Adds every channel of a role's images, one a layer, to a folder.
pub fn add(folder: &Folder, role: Role, images: &[Image], kind: Kind) -> Result<()> {
    if role == Role::Sky {
        return add_image(folder, role, None, &stacked(images), kind);
    }
    (0..)
        .zip(images)
        .try_for_each(|(layer, image)| add_image(folder, role, Some(layer), image, kind))
}

/// One below the other.
fn stacked(images: &[Image]) -> Image {
    let mut whole = Image::new(images.first().map_or(0, |i| i.width), 0, 4);
    for image in images {
        whole.height += image.height;
        whole.texels.extend_from_slice(&image.texels);
    }
    whole
}

fn add_image(
    folder: &Folder,
    role: Role,
    layer: Option<u32>,
    image: &Image,
    kind: Kind,
) -> Result<()> {
    for (index, channel) in role.spec().channels.iter().enumerate() {
        let values = image.channel(index);
        let bytes = match kind {
            Kind::Png => {
                let grey: Vec<u8> = values.map(unorm8).collect();
                picture::png(image.width, image.height, ExtendedColorType::L8, &grey)?
            }
            Kind::Exr => picture::grey_exr(image.width, image.height, values.collect())?,
        };
        interrupt::stop_if_requested()?;
        folder.add(&file_name(role, layer, channel.name, kind), &bytes)?;
    }
    Ok(())
}

fn file_name(role: Role, layer: Option<u32>, channel: &str, kind: Kind) -> String {
    let layer = layer.and_then(|layer| role.layer_name(layer));
    let layer = layer.map_or(String::new(), |name| format!("{name}."));
    format!("{}.{layer}{channel}.{}", role.name(), kind.extension())
}

/// The images of level 0 of a texture, one a layer.
pub fn images(texture: &Texture) -> Vec<Image> {
    (0..texture.layers)
        .map(|layer| texture.image(0, layer))
        .collect()
}

/// Whether a file has a name that [`add`] gives.
pub fn is_ours(name: &str) -> bool {
    let ours = |role: Role, kind: Kind| {
        let layers = (0..role.spec().layers[1]).map(Some);
        layers.chain([None]).any(|layer| {
            let mut channels = role.spec().channels.iter();
            channels.any(|c| name == file_name(role, layer, c.name, kind))
        })
    };
    Role::ALL
        .iter()
        .any(|&role| ours(role, Kind::Png) || ours(role, Kind::Exr))
}
