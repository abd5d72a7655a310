//! Twin of clouds/packed/map.wgsl: the photo here and at three places towards the sun.

use glam::Vec2;
use welkin_pack::Image;
use welkin_runtime::internals::clouds::packed::PackedUniforms;
use welkin_runtime::internals::clouds::packed::map::PLACES;

use crate::texture::Texture;

/// What a texel of level 0 may be off by, in bytes, at most and on average: a texture unit may filter across, along and between levels in
/// 8 bits, the target rounds by half a byte, and on average rounding is off by a quarter of its step. The photo here is read at its texels.
pub const ALLOWANCE: ([f32; 4], [f32; 4]) = ([2.0, 2.0, 2.0, 0.5], [0.75, 0.75, 0.75, 0.25]);

/// Level 0 of the map, not rounded.
pub fn render(packed: &PackedUniforms, clouds: &Texture) -> Image {
    let side = packed.map_side as u32;
    let halved = libm::log2f(clouds.levels()[0].width as f32 / packed.map_side);
    let mut map = Image::new(side, side, 4);
    for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
        let uv = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / packed.map_side;
        let photo = |uv: Vec2, level: f32| clouds.sample(uv.to_array(), level)[0];
        let place = |i: usize| photo(uv + PLACES[i] * packed.photo_step, packed.march_levels[i]);
        let texel = [place(0), place(1), place(2), photo(uv, halved)];
        map.texel_mut(x, y).copy_from_slice(&texel);
    }
    map
}
