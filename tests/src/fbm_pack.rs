//! Twin of clouds/fbm/pack.wgsl: the octaves of a pack, displaced for the sun as it stands.

use welkin_pack::role::Wrap;
use welkin_pack::{Image, Pack, Role};

use crate::map::rounded;
use crate::texture::Texture;

/// Channel of the noise itself.
const NOISE: usize = 3;

/// Every octave, coarsest first, with the noise three, two and one steps away in its first channels. `step` is in
/// tiles.
///
/// # Panics
/// If the pack has no octaves.
pub fn packed(pack: &Pack, step: [f32; 2]) -> Vec<Texture> {
    let layers = pack
        .texture(Role::Fbm)
        .expect("the pack has octaves")
        .layers;
    (0..layers)
        .map(|layer| displaced(&Texture::layer(pack, Role::Fbm, layer), step))
        .collect()
}

fn displaced(octave: &Texture, step: [f32; 2]) -> Texture {
    let [image] = octave.levels() else {
        panic!("octaves have one level");
    };
    let mut out = Image::new(image.width, image.height, 4);
    for (x, y) in (0..image.height).flat_map(|y| (0..image.width).map(move |x| (x, y))) {
        let u = (x as f32 + 0.5) / image.width as f32;
        let v = (y as f32 + 0.5) / image.height as f32;
        let away = [3.0, 2.0, 1.0, 0.0]
            .map(|steps| octave.sample([u + steps * step[0], v + steps * step[1]], 0.0)[NOISE]);
        out.texel_mut(x, y).copy_from_slice(&away);
    }
    Texture::from_levels(vec![rounded(out)], Wrap::Repeat)
}
