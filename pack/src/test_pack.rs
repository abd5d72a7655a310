//! A small pack that breaks no rule, for tests to break.

use crate::air::{skylight_lx, unit_luminance_cd_m2};
use crate::build::{PackInfo, Source};
use crate::format::Format;
use crate::image::Image;
use crate::layer_kind::LayerKind;
use crate::manifest::FractalNoise;
use crate::mapping::{
    FBM_STEPS_A_TILE, FlareCell, SKY_HAZES, SheetCell, SheetKind, cube_to_direction,
    galaxy_uv_to_direction, layer_to_sun, texel_to_sky,
};
use crate::pack::Pack;
use crate::role::Role;
use crate::test_field::field;
use crate::texel::{CatalogueStar, StarTexel};

/// A stream of numbers in 0..1: a 64-bit linear congruential generator (D. E. Knuth, MMIX), upper bits.
pub(crate) struct Stream(u64);

impl Stream {
    pub(crate) fn new(seed: u64) -> Stream {
        Stream(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(crate) fn unit(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / 16_777_216.0
    }

    pub(crate) fn below(&mut self, n: u32) -> u32 {
        ((self.unit() * n as f32) as u32).min(n - 1)
    }
}

pub(crate) fn info() -> PackInfo {
    PackInfo {
        name: "test".to_string(),
        seed: 7,
        baker: "welkin-test 0".to_string(),
        recipe: "name = \"test\"\n".to_string(),
        inputs: Vec::new(),
        noon_elevation_rad: NOON_RAD,
        aerosol_depths: [0.04, 0.24],
        noise: waves_as_noise(NOISE_MEAN),
        detail: waves_as_noise(DETAIL_MEAN),
    }
}

const NOON_RAD: f32 = 1.0;

const NOISE_MEAN: f32 = 0.26;
const DETAIL_MEAN: f32 = 0.5;

/// Waves of wave numbers about 2^1.5, as the noise that has its energy there.
fn waves_as_noise(mean: f32) -> FractalNoise {
    FractalNoise {
        cells: 7,
        octaves: 1,
        gain: 0.5,
        mean,
    }
}

pub(crate) fn sources() -> Vec<Source> {
    let source = |role: Role, images| Source {
        role,
        format: role.spec().formats[0],
        images,
    };
    vec![
        source(Role::Clouds, vec![clouds(64)]),
        source(Role::Stars, vec![stars(128, 500)]),
        source(Role::Galaxy, vec![galaxy(32)]),
        source(Role::Sky, sky()),
        source(Role::Sun, vec![sun(32)]),
        source(Role::Octaves, vec![octaves()]),
        source(Role::Fbm, fbm()),
        source(Role::Flares, vec![flares(64)]),
        source(Role::Layers, layers()),
        source(Role::Sprites, vec![sprites(128)]),
        source(Role::Skybox, (0..6).map(|face| skybox(face, 16)).collect()),
        source(Role::Catalogue, catalogue(8, 20)),
    ]
}

pub(crate) fn pack() -> Pack {
    with_clouds(Pack::build(info(), sources()).unwrap())
}

fn with_clouds(pack: Pack) -> Pack {
    pack.with_field(field()).unwrap()
}

/// Writes a pack's files into a folder, as they are.
pub(crate) fn write(pack: &Pack, folder: &std::path::Path) {
    for (name, bytes) in pack.files() {
        std::fs::write(folder.join(name), bytes).unwrap();
    }
}

pub(crate) fn clouds(size: u32) -> Image {
    let mut image = Image::new(size, size, 4);
    let channels = [
        (0, 0.06, 0.16),
        (1, 0.004, NOISE_MEAN),
        (2, 0.004, DETAIL_MEAN),
    ];
    for (channel, clear, mean) in channels {
        let field = with_mean(waves(size, channel as u64), clear, mean);
        for (texel, value) in image.texels.chunks_exact_mut(4).zip(field) {
            texel[channel] = value;
        }
    }
    for y in 0..size {
        for x in 0..size {
            let row = y as f32 / (size - 1) as f32;
            image.texel_mut(x, y)[3] = row * row;
        }
    }
    image
}

/// So many stars, each fainter than the one before.
pub(crate) fn catalogue(size: u32, count: u32) -> Vec<Image> {
    let mut images = vec![Image::new(size, size, 4); 3];
    for i in 0..count {
        let star = CatalogueStar {
            right_ascension_deg: 17.0 * f64::from(i),
            declination_deg: 4.0 * f64::from(i) - 40.0,
            magnitude: 0.2 * f64::from(i),
            colour_index: 0.05 * f64::from(i),
            rate: 12 + i as u8,
            variance: 30,
            phase: 5 * i as u8,
        };
        for (image, bytes) in images.iter_mut().zip(star.encode()) {
            let texel = image.texel_mut(i % size, i / size);
            texel.copy_from_slice(&bytes.map(|byte| f32::from(byte) / 255.0));
        }
    }
    images
}

/// Two waves across each other: four wave vectors.
pub(crate) fn few_waves(size: usize) -> Vec<f32> {
    let wave = |i: usize, n: f32| libm::cosf(std::f32::consts::TAU * n * i as f32 / size as f32);
    let at = |i: usize| 0.5 + 0.25 * (wave(i % size, 3.0) + wave(i / size, 2.0));
    (0..size * size).map(at).collect()
}

/// A field with a share of it clear, its peak at 1, and raised to the power that gives it a mean.
pub(crate) fn with_mean(mut field: Vec<f32>, clear: f32, mean: f32) -> Vec<f32> {
    let mut sorted = field.clone();
    sorted.sort_by(f32::total_cmp);
    let from = sorted[(clear * field.len() as f32) as usize];
    let bent = |value: f32, power: f32| libm::powf(((value - from) / (1.0 - from)).max(0.0), power);
    let mean_of =
        |power: f32| field.iter().map(|v| bent(*v, power)).sum::<f32>() / field.len() as f32;
    let (mut low, mut high) = (0.1, 10.0);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if mean_of(middle) > mean {
            low = middle;
        } else {
            high = middle;
        }
    }
    field.iter_mut().for_each(|v| *v = bent(*v, low));
    field
}

/// A sum of waves that fit into the tile, from 0 to 1.
pub(crate) fn waves(size: u32, seed: u64) -> Vec<f32> {
    let mut stream = Stream::new(seed);
    let waves: Vec<[f32; 3]> = (0..40)
        .map(|_| {
            [
                stream.below(9) as f32 - 4.0,
                stream.below(9) as f32 - 4.0,
                stream.unit(),
            ]
        })
        .collect();
    let at = |x: u32, y: u32| {
        let turn = |w: &[f32; 3]| (w[0] * x as f32 + w[1] * y as f32) / size as f32 + w[2];
        waves
            .iter()
            .map(|w| libm::cosf(std::f32::consts::TAU * turn(w)))
            .sum::<f32>()
    };
    let field: Vec<f32> = (0..size * size).map(|i| at(i % size, i / size)).collect();
    let (least, most) = field
        .iter()
        .fold((f32::MAX, f32::MIN), |(a, b), &v| (a.min(v), b.max(v)));
    field.iter().map(|v| (v - least) / (most - least)).collect()
}

pub(crate) fn stars(size: u32, count: usize) -> Image {
    let mut image = Image::new(size, size, 4);
    let mut stream = Stream::new(11);
    for _ in 0..count {
        let (x, y) = (stream.below(size), stream.below(size));
        let intensity = 0.05 + 0.71 * stream.unit();
        let star = StarTexel {
            intensity,
            rate: libm::floorf(12.8 + 240.0 * stream.unit()) / 255.0,
            variance: intensity * 0.3,
            phase: stream.unit() * 0.998,
        };
        let bytes = star.encode();
        image
            .texel_mut(x, y)
            .copy_from_slice(&bytes.map(|b| f32::from(b) / 255.0));
    }
    image
}

fn galaxy(size: u32) -> Image {
    let mut image = Image::new(size, size, 1);
    for y in 0..size {
        for x in 0..size {
            let uv = [x, y].map(|i| (i as f32 + 0.5) / size as f32);
            let [east, _, _] = galaxy_uv_to_direction(uv);
            image.texel_mut(x, y)[0] = 0.9 * libm::expf(-12.0 * east * east);
        }
    }
    image
}

/// A sky of 16 suns that gives the light of the hour.
fn sky() -> Vec<Image> {
    const SIZE: [u32; 2] = [8, 16];
    let mut images = Vec::new();
    for (haze, sun) in (0..SKY_HAZES).flat_map(|haze| (0..16).map(move |sun| (haze, sun))) {
        let sun_rad = layer_to_sun(sun as f32, 16);
        let level = skylight_lx(sun_rad) / unit_luminance_cd_m2(sun_rad) / 5.0;
        let mut parts = [(); 2].map(|()| Image::new(SIZE[0], SIZE[1], 4));
        for (y, x) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (y, x))) {
            let (sine, azimuth_cos) = texel_to_sky([x as f32, y as f32], SIZE);
            // On the side of the sun it is brighter, at the zenith there are no sides.
            let side = 1.0 + 0.5 * azimuth_cos * libm::sqrtf((1.0 - sine).max(0.0));
            let light = level * (2.0 - sine) * side;
            parts[0].texel_mut(x, y)[..3].copy_from_slice(&[light * 0.7, light * 0.8, light]);
            parts[1].texel_mut(x, y)[..3].fill(level * (1.0 + haze as f32));
        }
        images.extend(parts);
    }
    images
}

fn sun(size: u32) -> Image {
    let mut image = Image::new(size, size, 2);
    for y in 0..size {
        for x in 0..size {
            let unit = |i: u32| (i as f32 + 0.5) / size as f32 * 2.0 - 1.0;
            let radius = libm::sqrtf(unit(x) * unit(x) + unit(y) * unit(y));
            let disc = ((0.55 - radius) / 0.1).clamp(0.0, 1.0);
            let glow = (1.0 - radius).max(0.0);
            image
                .texel_mut(x, y)
                .copy_from_slice(&[disc, glow * glow * glow]);
        }
    }
    image
}

fn octaves() -> Image {
    let mut image = Image::new(32, 32, 4);
    let mut stream = Stream::new(21);
    for channel in 0..4 {
        // Every byte four times, in an order shuffled by Fisher and Yates.
        let mut values: Vec<u8> = (0..1024).map(|i| (i / 4) as u8).collect();
        for last in (1..1024_u32).rev() {
            values.swap(last as usize, stream.below(last + 1) as usize);
        }
        for (texel, value) in image.texels.chunks_exact_mut(4).zip(values) {
            texel[channel] = f32::from(value) / 255.0;
        }
    }
    image
}

/// Random values at `cells` lattice points a side, between them a smooth step.
pub(crate) fn noise(size: u32, cells: u32) -> Image {
    let mut stream = Stream::new(u64::from(cells));
    let lattice: Vec<f32> = (0..cells * cells).map(|_| stream.unit()).collect();
    let at = |x: u32, y: u32| lattice[((y % cells) * cells + x % cells) as usize];
    let step = size / cells;
    let smooth = |i: u32| {
        let t = (i % step) as f32 / step as f32;
        t * t * (3.0 - 2.0 * t)
    };
    let mut image = Image::new(size, size, 1);
    for (y, x) in (0..size).flat_map(|y| (0..size).map(move |x| (y, x))) {
        let (i, j) = (x / step, y / step);
        let row = |j: u32| at(i, j) + (at(i + 1, j) - at(i, j)) * smooth(x);
        image.texel_mut(x, y)[0] = row(j) + (row(j + 1) - row(j)) * smooth(y);
    }
    image
}

/// A layer of the role `fbm`: noise, and the same displaced.
pub(crate) fn displaced(noise: &Image) -> Image {
    let size = noise.width;
    let mut image = Image::new(size, size, 4);
    for (i, texel) in (0..).zip(image.texels.chunks_exact_mut(4)) {
        let (x, y) = (i % size, i / size);
        for (steps, value) in (0..4).rev().zip(texel) {
            *value = noise.texel((x + steps * size / FBM_STEPS_A_TILE) % size, y)[0];
        }
    }
    image
}

pub(crate) fn fbm() -> Vec<Image> {
    [8, 16].map(|cells| displaced(&noise(64, cells))).into()
}

fn flares(size: u32) -> Image {
    let mut image = Image::new(size, size, 1);
    let cell = size / FlareCell::A_SIDE;
    for part in FlareCell::ALL {
        let [left, top] = part.place().map(|i| i * cell);
        for (x, y) in (0..cell * cell).map(|i| (i % cell, i / cell)) {
            let unit = |i: u32| (i as f32 + 0.5) / cell as f32 * 2.0 - 1.0;
            let r = libm::sqrtf(unit(x) * unit(x) + unit(y) * unit(y));
            let light = match part {
                FlareCell::Disc => 0.8,
                FlareCell::Ring => libm::expf(-40.0 * (r - 0.7) * (r - 0.7)),
                FlareCell::Glow => 1.0 - r * r,
                FlareCell::Starburst => libm::expf(-8.0 * r),
            };
            let edge = ((0.87 - r) / 0.05).clamp(0.0, 1.0);
            image.texel_mut(left + x, top + y)[0] = light * edge;
        }
    }
    image
}

pub(crate) fn layers() -> Vec<Image> {
    let kinds = [31, 32, 33].into_iter().zip(LayerKind::ALL);
    kinds
        .map(|(seed, kind)| layer(&with_mean(waves(64, seed), 0.0, kind.mean_density())))
        .collect()
}

/// A layer of the role `layers` with this density and a root mean square slope of 0.7.
pub(crate) fn layer(density: &[f32]) -> Image {
    let size = density.len().isqrt();
    let at = |x: usize, y: usize| density[y % size * size + x % size];
    let differences: Vec<[f32; 2]> = (0..density.len())
        .map(|i| (i % size + size, i / size + size))
        .map(|(x, y)| [at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1)])
        .collect();
    let squares: f32 = differences.iter().flatten().map(|d| d * d).sum();
    let scale = 0.7 / libm::sqrtf(squares / density.len() as f32);
    let mut order: Vec<usize> = (0..density.len()).collect();
    order.sort_by(|&a, &b| density[a].total_cmp(&density[b]));
    let mut image = Image::new(size as u32, size as u32, 4);
    for (rank, i) in order.into_iter().enumerate() {
        let [x, y] = differences[i].map(|d| -scale * d);
        let [x, y] = [x, y].map(|n| 0.5 + 0.5 * n / libm::sqrtf(1.0 + x * x + y * y));
        let rank = (256 * rank / density.len()) as f32 / 255.0;
        image.texels[4 * i..][..4].copy_from_slice(&[x, y, density[i], rank]);
    }
    image
}

/// Discs of the kinds' opacities, with waves for eddies; the flat-bottomed one is half a disc.
fn sprites(size: u32) -> Image {
    let mut image = Image::new(size, size, 4);
    let side = size / SheetCell::A_SIDE;
    for cell in (0..SheetCell::COUNT).map(SheetCell) {
        let (peak, eddies) = match cell.kind() {
            SheetKind::Foggy => (0.7, 0.02),
            SheetKind::Wispy => (0.6, 0.1),
            SheetKind::FlatBottomed | SheetKind::Puffy => (1.0, 0.2),
        };
        let [left, top] = cell.place().map(|i| i * side);
        for (x, y) in (0..side * side).map(|i| (i % side, i / side)) {
            let [u, v] = [x, y].map(|i| (i as f32 + 0.5) / side as f32 * 2.0 - 1.0);
            let radius = libm::sqrtf(u * u + v * v);
            let is_cut = cell.kind() == SheetKind::FlatBottomed && v > 0.2;
            let alpha = if is_cut {
                0.0
            } else {
                peak * ((0.8 - radius) / 0.4).clamp(0.0, 1.0)
            };
            let wave = libm::sinf(9.0 * u) * libm::sinf(9.0 * v + f32::from(cell.0));
            let texel = image.texel_mut(left + x, top + y);
            texel.copy_from_slice(&[0.5 + eddies * wave, alpha, 0.5 - eddies * wave, 0.5]);
        }
    }
    image
}

/// A colour that changes smoothly with the direction, so that faces meet.
fn skybox(face: u32, size: u32) -> Image {
    let mut image = Image::new(size, size, 4);
    for y in 0..size {
        for x in 0..size {
            let st = [x, y].map(|i| (i as f32 + 0.5) / size as f32);
            let [east, up, south] = cube_to_direction(face, st);
            image.texel_mut(x, y).copy_from_slice(&[
                1.0 + 0.5 * east,
                1.0 + 0.8 * up,
                1.0 + 0.6 * south,
                0.7 + 0.3 * up,
            ]);
        }
    }
    image
}

/// Level 0 of every texture of a pack with one of them changed, built into a pack with true hashes.
pub(crate) fn with(role: Role, change: impl FnOnce(&mut Image)) -> Pack {
    with_images(role, |images| change(&mut images[0]))
}

/// The same with all layers of the texture to change.
pub(crate) fn with_images(role: Role, change: impl FnOnce(&mut Vec<Image>)) -> Pack {
    let mut sources = sources();
    change(&mut sources.iter_mut().find(|s| s.role == role).unwrap().images);
    Pack::build(info(), sources).unwrap()
}

/// A pack whose quantised texture was changed, with true hashes.
pub(crate) fn with_texture(role: Role, change: impl FnOnce(&mut crate::Texture)) -> Pack {
    let pack = pack();
    let mut textures: Vec<_> = Role::ALL
        .iter()
        .filter_map(|r| Some((*r, pack.texture(*r)?.clone())))
        .collect();
    change(&mut textures.iter_mut().find(|(r, _)| *r == role).unwrap().1);
    Pack::from_textures(info(), textures).unwrap()
}

/// The same clouds as half floats.
pub(crate) fn half_float_pack() -> Pack {
    let mut sources = sources();
    sources[0].format = Format::Rgba16Float;
    with_clouds(Pack::build(info(), sources).unwrap())
}
