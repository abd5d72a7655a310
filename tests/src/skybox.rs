//! Twin of skybox.wgsl.

use glam::Vec3;
use welkin_pack::mapping::{cube_texel, direction_to_cube};
use welkin_pack::{Image, Pack, Role};
use welkin_runtime::internals::clear_sky::skybox::SkyboxUniforms;

use crate::texture::mix as blend;

/// A cube texture's levels as floats, six faces each.
#[derive(Clone, Debug)]
pub struct Skybox {
    levels: Vec<Vec<Image>>,
}

/// What is seen along a unit direction, with `radiance` behind the picture.
pub fn mix(uniforms: &SkyboxUniforms, skybox: &Skybox, radiance: Vec3, direction: Vec3) -> Vec3 {
    let [red, green, blue, cover] = skybox.sample(direction, uniforms.lod);
    radiance * (1.0 - cover * uniforms.weight) + Vec3::new(red, green, blue) * uniforms.weight
}

impl Skybox {
    /// The skybox of a pack, if it has one.
    pub fn new(pack: &Pack) -> Option<Skybox> {
        let texture = pack.texture(Role::Skybox)?;
        let faces = |level| (0..texture.layers).map(move |face| texture.image(level, face));
        Some(Skybox {
            levels: (0..texture.levels.len())
                .map(|level| faces(level).collect())
                .collect(),
        })
    }

    /// Trilinear filtering along a direction, at a level of detail, which is clamped to the levels there are.
    pub fn sample(&self, direction: Vec3, level: f32) -> [f32; 4] {
        let last = self.levels.len() - 1;
        let level = level.clamp(0.0, last as f32);
        let (fine, share) = (level as usize, level - level.floor());
        blend(
            self.bilinear(direction, fine),
            self.bilinear(direction, (fine + 1).min(last)),
            share,
        )
    }

    fn bilinear(&self, direction: Vec3, level: usize) -> [f32; 4] {
        let (face, st) = direction_to_cube(direction.to_array());
        let size = self.levels[level][0].width;
        let [x, y] = st.map(|c| c * size as f32 - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let row = |dy: i32| {
            let at = |dx: i32| self.load(level, face, [left as i32 + dx, top as i32 + dy]);
            blend(at(0), at(1), x - left)
        };
        blend(row(0), row(1), y - top)
    }

    /// A texel of a face; beyond a side it is the neighbouring face's.
    ///
    /// Vulkan 1.3 specification, "Cube Map Edge Handling": beyond a corner there is no texel, and a device
    /// should take the mean of the three that meet there.
    fn load(&self, level: usize, face: u32, [x, y]: [i32; 2]) -> [f32; 4] {
        let faces = &self.levels[level];
        let size = faces[0].width as i32;
        let inside = |i: i32| i.clamp(0, size - 1);
        let one = |place: [i32; 2]| {
            let (face, [x, y]) = cube_texel(face, place, size as u32);
            let texel = faces[face as usize].texel(x, y);
            [texel[0], texel[1], texel[2], texel[3]]
        };
        if inside(x) == x || inside(y) == y {
            return one([x, y]);
        }
        let corner = [[inside(x), inside(y)], [x, inside(y)], [inside(x), y]].map(one);
        [0, 1, 2, 3].map(|i| (corner[0][i] + corner[1][i] + corner[2][i]) / 3.0)
    }
}
