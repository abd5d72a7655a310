//! `welkin unpack`: one grey image a channel and layer, from level 0 of every texture.

use anyhow::Result;
use welkin_pack::{Format, Pack, Role};

use super::UnpackArgs;
use super::side::{self, Kind};
use super::whole::Folder;

pub fn run(args: &UnpackArgs) -> Result<()> {
    let pack = Pack::open(&args.pack)?;
    let folder = Folder::begin(&args.output, false, side::is_ours)?;
    for role in Role::ALL {
        let Some(texture) = pack.texture(role) else {
            continue;
        };
        let kind = match texture.format {
            Format::Rgba16Float => Kind::Exr,
            Format::R8Unorm | Format::Rg8Unorm | Format::Rgba8Unorm => Kind::Png,
        };
        for layer in 0..texture.layers {
            side::add(&folder, role, layer, &texture.image(0, layer), kind)?;
        }
    }
    folder.publish()
}
