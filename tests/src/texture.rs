//! Texture reads as a GPU does them: texel centres at (i + 0.5) / n, bilinear in a level, linear between levels.

use welkin_pack::role::Wrap;
use welkin_pack::{Image, Pack, Role};

/// A texture's levels as floats.
#[derive(Clone, Debug)]
pub struct Texture {
    levels: Vec<Image>,
    wrap: Wrap,
}

impl Texture {
    /// The texture of a role.
    ///
    /// # Panics
    /// If the pack lacks it.
    pub fn new(pack: &Pack, role: Role) -> Texture {
        Texture::layer(pack, role, 0)
    }

    /// One layer of an array, or face of a cube, from 0.
    ///
    /// # Panics
    /// If the pack lacks it.
    pub fn layer(pack: &Pack, role: Role, layer: u32) -> Texture {
        let texture = pack.texture(role).expect("the pack has every role");
        let levels = (0..texture.levels.len())
            .map(|level| texture.image(level, layer))
            .collect();
        Texture::from_levels(levels, role.spec().wrap)
    }

    /// A texture of these levels, largest first.
    pub fn from_levels(levels: Vec<Image>, wrap: Wrap) -> Texture {
        Texture { levels, wrap }
    }

    /// Its levels, largest first.
    pub fn levels(&self) -> &[Image] {
        &self.levels
    }

    /// One texel as it is; missing channels are 0.
    pub fn load(&self, texel: [i32; 2], level: usize) -> [f32; 4] {
        let image = &self.levels[level];
        let place = |i: i32, size: u32| match self.wrap {
            Wrap::Repeat => i.rem_euclid(size as i32) as u32,
            Wrap::Clamp => i.clamp(0, size as i32 - 1) as u32,
        };
        let mut out = [0.0; 4];
        let texel = image.texel(place(texel[0], image.width), place(texel[1], image.height));
        out[..texel.len()].copy_from_slice(texel);
        out
    }

    /// Trilinear filtering at a level of detail, which is clamped to the levels there are.
    pub fn sample(&self, uv: [f32; 2], level: f32) -> [f32; 4] {
        let last = self.levels.len() - 1;
        let level = level.clamp(0.0, last as f32);
        let (fine, share) = (level as usize, level - level.floor());
        mix(
            self.bilinear(uv, fine),
            self.bilinear(uv, (fine + 1).min(last)),
            share,
        )
    }

    fn bilinear(&self, uv: [f32; 2], level: usize) -> [f32; 4] {
        let image = &self.levels[level];
        let (x, y) = (
            uv[0] * image.width as f32 - 0.5,
            uv[1] * image.height as f32 - 0.5,
        );
        let (left, top) = (x.floor(), y.floor());
        let row = |dy: i32| {
            let at = |dx: i32| self.load([left as i32 + dx, top as i32 + dy], level);
            mix(at(0), at(1), x - left)
        };
        mix(row(0), row(1), y - top)
    }
}

/// WGSL's mix.
pub(crate) fn mix(a: [f32; 4], b: [f32; 4], share: f32) -> [f32; 4] {
    [0, 1, 2, 3].map(|i| a[i] * (1.0 - share) + b[i] * share)
}

/// WGSL's smoothstep.
pub fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
