//! One grey image a channel, as files `ROLE.CHANNEL.png` and `ROLE.CHANNEL.exr`; in arrays and cubes
//! `ROLE.LAYER.CHANNEL.png`, where LAYER is a number from 1, or the name of a face or of a kind of cloud.

use anyhow::Result;
use image::ExtendedColorType;
use welkin_pack::texture::unorm8;
use welkin_pack::whole::Folder;
use welkin_pack::{Image, Role};

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

/// Adds every channel of a layer of a role's texture to a folder.
pub fn add(folder: &Folder, role: Role, layer: u32, image: &Image, kind: Kind) -> Result<()> {
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

fn file_name(role: Role, layer: u32, channel: &str, kind: Kind) -> String {
    let layer = role.layer_name(layer);
    let layer = layer.map_or(String::new(), |name| format!("{name}."));
    format!("{}.{layer}{channel}.{}", role.name(), kind.extension())
}

/// Whether a file has a name that [`add`] gives.
pub fn is_ours(name: &str) -> bool {
    let ours = |role: Role, kind: Kind| {
        (0..role.spec().layers[1]).any(|layer| {
            let mut channels = role.spec().channels.iter();
            channels.any(|c| name == file_name(role, layer, c.name, kind))
        })
    };
    Role::ALL
        .iter()
        .any(|&role| ours(role, Kind::Png) || ours(role, Kind::Exr))
}
