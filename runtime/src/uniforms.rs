//! The uniform buffer: everything that is constant over a frame.
//!
//! All members are four floats wide or arrays of such, so that Rust's layout is WGSL's without padding. The WGSL structs
//! of the same names are in the file of each pass; a test of [`crate::shader`] compares both.

use bytemuck::{Pod, Zeroable};

/// Camera: see shaders/camera.wgsl for what each component holds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct CameraUniforms {
    /// xyz: from the middle of the screen to its right side; w: width in pixels.
    pub right: [f32; 4],
    /// xyz: from the middle of the screen to its upper side; w: height in pixels.
    pub up: [f32; 4],
    /// xyz: to the middle of the screen.
    pub forward: [f32; 4],
    /// xyz: dot with a direction gives its clip x.
    pub clip_x: [f32; 4],
    /// xyz: the same for y.
    pub clip_y: [f32; 4],
    /// xyz: the same for w.
    pub clip_w: [f32; 4],
}

/// Clear sky.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SkyUniforms {
    /// x: u of the time; y, z: `v = y + z * sqrt(sin elevation)`; w: share of the night sky.
    pub gradient: [f32; 4],
    /// xyz: unit direction towards the sun.
    pub sun: [f32; 4],
    /// rgb: radiance of the wide lobe towards the sun; w: its sharpness.
    pub wide: [f32; 4],
    /// rgb: radiance of the narrow lobe, the twelfth power of the wide one.
    pub narrow: [f32; 4],
    /// rgb: radiance of the twilight band on the horizon; w: how fast it fades upwards.
    pub band: [f32; 4],
    /// rgb: radiance of a shut sky; w: how far the sky is shut.
    pub overcast: [f32; 4],
}

/// The clear sky of Perez and others. Each of a to e, base and zenith holds luminance, chromaticity x and chromaticity y.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct PerezUniforms {
    /// xyz: unit direction towards the sun, or to the horizon above it; w: share of this model.
    pub sun: [f32; 4],
    /// xyz: how the horizon darkens (above 0) or brightens.
    pub a: [f32; 4],
    /// xyz: how fast, times log2 of e.
    pub b: [f32; 4],
    /// xyz: strength of the aureole.
    pub c: [f32; 4],
    /// xyz: how fast it falls, times log2 of e.
    pub d: [f32; 4],
    /// xyz: light scattered back.
    pub e: [f32; 4],
    /// xyz: what aureole and backscatter are added to.
    pub base: [f32; 4],
    /// xyz: the value at the zenith, over f(0, Z).
    pub zenith: [f32; 4],
}

/// The sun's square.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SunUniforms {
    /// xyz: the screen's right about the sun, over the glow's half side; w: glow's half side over the disc's.
    pub right: [f32; 4],
    /// xyz: the same upwards; w: 1 if there is a sun to draw.
    pub up: [f32; 4],
    /// rgb: radiance of the disc; w: level of the texture for it.
    pub disc: [f32; 4],
    /// rgb: radiance of the glow; w: level of the texture for it.
    pub glow: [f32; 4],
    /// xyz: unit direction towards what is drawn, the sun or the moon.
    pub towards: [f32; 4],
}

/// Stars.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct StarUniforms {
    /// x: level of the records; y: texels a side of that level; z: place in the flicker's period, 0..1; w: brightness.
    pub field: [f32; 4],
    /// x: 1 if light is spread over the pixel's own solid angle, 0 if over that of one in the middle; y: 1 if the level above that of the
    /// records tells where they are, 0 if a pixel reads one texel alone; z: how far a tent reaches, in radians; w: not used.
    pub spread: [f32; 4],
}

/// Galaxy.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct GalaxyUniforms {
    /// rgb: radiance of the brightest place, times the share of the night sky; w: level of detail of the grain.
    pub light: [f32; 4],
    /// x: the grain without noise and detail; y, z: what noise and detail add where they are 1. Its mean is 1.
    pub grain: [f32; 4],
}

/// The skybox.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SkyboxUniforms {
    /// x: share of the skybox where its cover is 1; y: level of detail.
    pub mix: [f32; 4],
}

/// What the clouds of every method share.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct CloudUniforms {
    /// xy: unit vector to the sun's azimuth (east, south); zw: `v = z + w * place`.
    pub gradient: [f32; 4],
    /// rgb: light of the sun on clouds; w: 1 / sine of the elevation at which clouds are out of the haze.
    pub sunlight: [f32; 4],
    /// rgb: light of the sky on clouds.
    pub ambient: [f32; 4],
    /// rgb: the sunset colour, display-referred; w: sunset.
    pub tint: [f32; 4],
}

/// Clouds of the packed method.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct PackedUniforms {
    /// x: scale; yz: offset; w: level of detail at distance 1.
    pub photo: [f32; 4],
    /// xy: scale times cosine and sine of its turn; zw: offset.
    pub noise: [f32; 4],
    /// x: scale; yz: offset; w: level of detail at distance 1.
    pub detail: [f32; 4],
    /// xy: scale to the east and to the south; zw: offset.
    pub upper: [f32; 4],
    /// x, y: level of detail of noise and upper layer at distance 1; z: smoothness (line 19).
    pub levels: [f32; 4],
    /// x: the cut of line 15; y: 1 / cover, as clamped in line 16; z: density; w: amount of the upper layer.
    pub shape: [f32; 4],
}

/// A dome of the octaves method.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct OctaveDome {
    /// xy: what a height to the east, zw: to the south adds to uv.
    pub axes: [f32; 4],
    /// xy: offset; z: level of detail at distance 1; w: the cut, 1 - cover.
    pub place: [f32; 4],
}

/// Clouds of the octaves method.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct OctaveUniforms {
    /// Low clouds.
    pub low: OctaveDome,
    /// Middle clouds.
    pub middle: OctaveDome,
    /// High clouds.
    pub high: OctaveDome,
    /// x: log2 of (1 - sharpness)^255; y: how thickness darkens; z: relief; w: share of the finer read.
    pub shape: [f32; 4],
    /// xy: a step of the low dome towards the sun, in uv.
    pub sun: [f32; 4],
    /// Copies of the noise across the map, octaves 1 to 4.
    pub cells_a: [f32; 4],
    /// The same, octaves 5 to 8.
    pub cells_b: [f32; 4],
    /// x: octaves; y: texels a side of the map; z: grey of a thin edge; w: 1 / thickness at which the high dome is full.
    pub map: [f32; 4],
}

/// Clouds of the fbm method.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct FbmUniforms {
    /// xy: what a height to the east, zw: to the south adds to uv.
    pub axes: [f32; 4],
    /// xy: offset; z: level of detail at distance 1.
    pub place: [f32; 4],
    /// x: m; y: n; z: octaves; w: texels a side of the map.
    pub remap: [f32; 4],
    /// rgb: the lit colour; w: what the shade is multiplied by.
    pub lit: [f32; 4],
    /// rgb: the shaded colour; w: share of the finer read.
    pub shaded: [f32; 4],
    /// xy: a step of the ray towards the sun, in tiles; z: mean of the sum of octaves; w: n for the ray's heights.
    pub step: [f32; 4],
    /// Offsets of octaves 1 and 2.
    pub offsets_a: [f32; 4],
    /// 3 and 4.
    pub offsets_b: [f32; 4],
    /// 5 and 6.
    pub offsets_c: [f32; 4],
    /// 7 and 8.
    pub offsets_d: [f32; 4],
    /// Weights of octaves 1 to 4.
    pub weights_a: [f32; 4],
    /// 5 to 8.
    pub weights_b: [f32; 4],
}

/// A layer of the lit method.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct LitLayerUniforms {
    /// xy: what a height of the dome to the east, zw: to the south adds to uv.
    pub axes: [f32; 4],
    /// xy: offset; zw: how far the second read is from the first.
    pub place: [f32; 4],
    /// x: the cut; y: 1 / thickness at which it is opaque; z: opacity where thick; w: how fast shade deepens.
    pub shape: [f32; 4],
    /// x: share of the way to the sun that a step of the blur takes; z: level of detail at distance 1; w: layer of the pack's texture.
    pub sun: [f32; 4],
    /// xy: horizontal part of the direction to the sun, along u and v; z: share of the grain; w: relief.
    pub facing: [f32; 4],
}

/// Clouds of the lit method.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct LitUniforms {
    /// x: `f^2`; y: `1 - f^2`, f the flattening; z: layers; w: texels a side of the map.
    pub dome: [f32; 4],
    /// rgb: light of sun or moon on clouds; w: k1.
    pub light: [f32; 4],
    /// xyz: unit direction towards sun or moon; w: k2.
    pub towards: [f32; 4],
    /// xy: where sun or moon is seen on the dome's plane, in its heights.
    pub source: [f32; 4],
    /// rgb: light of the sky on clouds; w: m.
    pub ambient: [f32; 4],
    /// From the lowest to the highest.
    pub layers: [LitLayerUniforms; crate::params::MAX_LAYERS],
}

/// Shadows of the lit method's clouds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ShadowUniforms {
    /// Of each layer, xy: where its dome is seen in the corner of the texture; z: what a texel adds; w: level of detail.
    pub layers: [[f32; 4]; crate::params::MAX_LAYERS],
}

/// A flash of lightning, all 0 without one.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct LightningUniforms {
    /// xy: where it is on the plane of the dome; w: 1 / luminance of the brightest cloud without it.
    pub place: [f32; 4],
    /// rgb: its light.
    pub light: [f32; 4],
}

/// Crepuscular rays.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct RayUniforms {
    /// xyz: unit direction towards the sun; w: opacity of the strongest ray, 0 without rays.
    pub sun: [f32; 4],
    /// xyz: unit vector across it, along the horizon.
    pub right: [f32; 4],
    /// xyz: the third one, away from the horizon.
    pub up: [f32; 4],
    /// rgb: radiance of haze in the light; w: halvings of the rays by a chord of 1.
    pub bright: [f32; 4],
    /// rgb: radiance of haze in the shade; w: 1 / a pixel in the middle of the screen, in radians.
    pub dark: [f32; 4],
}

/// Rain, all 0 without.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct RainUniforms {
    /// xyz: unit vector across the fall; w: share of the drops that are there.
    pub right: [f32; 4],
    /// xyz: unit vector against the fall; w: a pixel in the middle of the screen, in radians.
    pub up: [f32; 4],
    /// xyz: the third one.
    pub forward: [f32; 4],
    /// x: first column in sight; y: how many.
    pub sight: [f32; 4],
    /// rgb: radiance of a streak.
    pub streak: [f32; 4],
    /// rgb: radiance of the haze; w: its opacity at the horizon.
    pub haze: [f32; 4],
    /// Of each kind of drop, x, y: how often it has fallen the whole height, fraction and whole part; z: least radius; w: how far
    /// from it radii go.
    pub places: [[f32; 4]; crate::rain::KINDS],
    /// x: half the width of a streak, y: half its length, both in metres; z: opacity.
    pub sizes: [[f32; 4]; crate::rain::KINDS],
}

/// The lens flare.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct FlareUniforms {
    /// x: strength of the whole flare; y: radius, as a sine, in which clouds hide the sun.
    pub light: [f32; 4],
    /// xy: middle, zw: half sides, in clip space.
    pub places: [[f32; 4]; 6],
    /// rgb: colour; w: opacity.
    pub colours: [[f32; 4]; 6],
    /// xy: corner, z: side of the atlas cell; w: level of detail.
    pub cells: [[f32; 4]; 6],
}

/// Clouds of sprites: see shaders/sprites.wgsl for what each component holds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpriteUniforms {
    /// xyz: unit direction towards sun or moon; w: contrast of the sheet's relief.
    pub sun: [f32; 4],
    /// rgb: the most light of sun or moon; w: share of it where a group faces away.
    pub colour: [f32; 4],
    /// rgb: factor on the colour levels; w: share of `colour` where a group faces sun or moon.
    pub ambient: [f32; 4],
    /// x: extinction at sea level; y: 1 / scale height; z: opacity; w: how much darker bases are.
    pub air: [f32; 4],
    /// x: 1 / width of the rim of sight; y: its end; z: 1 / width of the change to billboards; w: its end.
    pub fade: [f32; 4],
    /// rgb: light of a flash where it strikes.
    pub flash: [f32; 4],
    /// xyz: from the viewer to the flash; w: 1 / its reach.
    pub flash_place: [f32; 4],
}

/// A viewpoint that sprites are drawn for, in a buffer of its own: see shaders/sprites.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpriteView {
    /// Dot of xyz with a place gives its clip x.
    pub clip_x: [f32; 4],
    /// The same for y.
    pub clip_y: [f32; 4],
    /// The same for z, plus w.
    pub clip_z: [f32; 4],
    /// The same as x for w.
    pub clip_w: [f32; 4],
    /// x: height above the sea; y: a pixel in radians; z: texels a side of a cell.
    pub viewer: [f32; 4],
}

/// A block of sprites, in a buffer of its own.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpriteBlock {
    /// xyz: from the viewpoint to its corner; w: its opacity.
    pub origin: [f32; 4],
    /// x: number of its first sprite in the texture; y: log2 of the vertices of each.
    pub slot: [u32; 4],
}

/// One of two rings that are cross-faded: see shaders/ring.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct RingSet {
    /// xyz: from the viewer to the middle of the ring; w: its share.
    pub place: [f32; 4],
    /// x: tangent of the elevation at the upper edge; y: 1 / (that less the lower edge's); z: 1 / width of a picture.
    pub span: [f32; 4],
}

/// The ring of impostors, in a buffer of its own.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct RingUniforms {
    /// The ring in use.
    pub used: RingSet,
    /// The one that it fades to.
    pub next: RingSet,
    /// x: radius; y, z: tangents at the lower and the upper edge of what is drawn.
    pub walls: [f32; 4],
    /// Of each side, from the north to the east: outward normal (east, south), and along it, clockwise.
    pub sides: [[f32; 4]; 8],
}

/// The last step.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct TonemapUniforms {
    /// x: exposure; y: size of the dither, 0 for none.
    pub display: [f32; 4],
}

/// The whole buffer, a struct a pass.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Uniforms {
    /// Where pixels look.
    pub camera: CameraUniforms,
    /// Clear sky.
    pub sky: SkyUniforms,
    /// Clear sky of Perez and others.
    pub perez: PerezUniforms,
    /// The sun's square.
    pub sun: SunUniforms,
    /// Stars.
    pub stars: StarUniforms,
    /// Galaxy.
    pub galaxy: GalaxyUniforms,
    /// The skybox.
    pub skybox: SkyboxUniforms,
    /// What the clouds of every method share.
    pub clouds: CloudUniforms,
    /// Clouds of the packed method.
    pub packed: PackedUniforms,
    /// Clouds of the octaves method.
    pub octaves: OctaveUniforms,
    /// Clouds of the fbm method.
    pub fbm: FbmUniforms,
    /// Clouds of the lit method.
    pub lit: LitUniforms,
    /// Clouds of the sprites method.
    pub sprites: SpriteUniforms,
    /// Shadows of the lit method's clouds.
    pub shadow: ShadowUniforms,
    /// A flash of lightning.
    pub lightning: LightningUniforms,
    /// Crepuscular rays.
    pub rays: RayUniforms,
    /// Rain.
    pub rain: RainUniforms,
    /// The lens flare.
    pub flares: FlareUniforms,
    /// The last step.
    pub tonemap: TonemapUniforms,
}

/// Three numbers and a fourth.
pub(crate) fn vec4(xyz: glam::Vec3, w: f32) -> [f32; 4] {
    xyz.extend(w).to_array()
}
