//! Texture reads as a GPU does them: texel centres at (i + 0.5) / n, bilinear in a level, linear between levels.

use glam::Vec2;
use welkin_pack::role::Wrap;
use welkin_pack::{Image, Pack, Role};

/// A texture's levels as floats.
#[derive(Clone, Debug)]
pub struct Texture {
    levels: Vec<Image>,
    /// The texels of each level; missing channels are 0.
    texels: Vec<Vec<[f32; 4]>>,
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
        let texels = levels.iter().map(|image| {
            let four = |texel: &[f32]| [0, 1, 2, 3].map(|i| texel.get(i).copied().unwrap_or(0.0));
            let each = image.texels.chunks_exact(image.channels);
            each.map(four).collect()
        });
        Texture {
            texels: texels.collect(),
            levels,
            wrap,
        }
    }

    /// Its levels, largest first.
    pub fn levels(&self) -> &[Image] {
        &self.levels
    }

    /// One texel as it is; missing channels are 0.
    pub fn load(&self, [x, y]: [i32; 2], level: usize) -> [f32; 4] {
        let image = &self.levels[level];
        let [x, y] = [self.place(x, image.width), self.place(y, image.height)];
        self.texels[level][(y * image.width + x) as usize]
    }

    /// Where a texel beyond the sides is read.
    fn place(&self, i: i32, size: u32) -> u32 {
        match self.wrap {
            Wrap::Repeat => i.rem_euclid(size as i32) as u32,
            Wrap::Clamp => i.clamp(0, size as i32 - 1) as u32,
        }
    }

    /// A cubic B-spline of four linear reads, of the texels of the finer of two levels.
    pub fn splined(&self, uv: Vec2, level: f32) -> [f32; 4] {
        let whole = (level as usize).min(self.levels.len() - 1);
        let size = self.levels[whole].width as f32;
        let place = uv * size - 0.5;
        let f = place - place.floor();
        let g = 1.0 - f;
        let (first, last) = (g * g * g / 6.0, f * f * f / 6.0);
        let upper = last + (4.0 - 3.0 * g * g * (1.0 + f)) / 6.0;
        let low = (place.floor() - 0.5 + (1.0 - first / (1.0 - upper))) / size;
        let high = (place.floor() + 1.5 + last / upper) / size;
        let row = |v: f32| {
            let [west, east] = [low.x, high.x].map(|u| self.sample([u, v], level));
            mix(west, east, upper.x)
        };
        mix(row(low.y), row(high.y), upper.y)
    }

    /// Trilinear filtering at a level of detail, which is clamped to the levels there are.
    pub fn sample(&self, uv: [f32; 2], level: f32) -> [f32; 4] {
        let last = self.levels.len() - 1;
        let level = level.clamp(0.0, last as f32);
        let (fine, share) = (level as usize, level - level.floor());
        if share == 0.0 {
            return self.bilinear(uv, fine);
        }
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
        let near = |first: f32, size: u32| [0, 1].map(|d| self.place(first as i32 + d, size));
        let (columns, rows) = (near(left, image.width), near(top, image.height));
        let [upper, lower] = rows.map(|row| {
            let at = |column: u32| self.texels[level][(row * image.width + column) as usize];
            let [left_texel, right_texel] = columns.map(at);
            mix(left_texel, right_texel, x - left)
        });
        mix(upper, lower, y - top)
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
