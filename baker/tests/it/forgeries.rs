//! Packs that are well formed, with true hashes and a true seal, and do not hold what they say: each is refused, and by the rule
//! that is meant for it.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use serde_json::{Value, json};
use welkin_baker::{Recipe, Resolved};
use welkin_pack::check::{Report, check_memory};
use welkin_pack::mapping::SkyLayer;
use welkin_pack::{Field, Format, Image, Pack, PackInfo, Role, Source, Texture};

const RECIPE: &str = r#"
[clouds]
size = 128
format = "FORMAT"
[clouds.detail]
cells = 12
[stars]
size = 128
count = 400
[galaxy]
size = 64
[sky]
suns = 24
[sun]
size = 64
[fbm]
size = 64
octaves = 2
[flares]
size = 64
[layers]
size = 64
[sprites]
size = 128
[field]
sections = 1
"#;

/// A recipe, baked.
struct Baked {
    info: PackInfo,
    sources: Vec<Source>,
    field: Field,
}

impl Baked {
    fn new(format: &str) -> Baked {
        let text = RECIPE.replace("FORMAT", format);
        let resolved = Recipe::parse("recipe", &text)
            .unwrap()
            .resolve(None)
            .unwrap();
        let go_on = |_| ControlFlow::Continue(());
        let field =
            welkin_baker::cloud_field(resolved.field.as_ref().unwrap(), None, resolved.seed);
        Baked {
            info: info(&resolved),
            sources: welkin_baker::sources(&resolved, None, &go_on).unwrap(),
            field: field.unwrap(),
        }
    }

    fn pack(&self) -> Pack {
        Pack::build(self.info.clone(), self.sources.clone())
            .unwrap()
            .with_field(self.field.clone())
            .unwrap()
    }

    /// With level 0 of a texture changed, and its levels made from that.
    fn image(&self, role: Role, change: impl FnOnce(&mut Vec<Image>)) -> Pack {
        let mut sources = self.sources.clone();
        change(&mut sources.iter_mut().find(|s| s.role == role).unwrap().images);
        Pack::build(self.info.clone(), sources)
            .unwrap()
            .with_field(self.field.clone())
            .unwrap()
    }

    fn texels(&self, role: Role, change: impl Fn(&mut [f32])) -> Pack {
        self.image(role, |images| {
            for image in images {
                image
                    .texels
                    .chunks_exact_mut(image.channels)
                    .for_each(&change);
            }
        })
    }

    /// With a texture changed as it is stored.
    fn texture(&self, role: Role, change: impl FnOnce(&mut Texture)) -> Pack {
        let pack = self.pack();
        let mut textures: Vec<(Role, Texture)> = Role::ALL
            .into_iter()
            .filter_map(|r| Some((r, pack.texture(r)?.clone())))
            .collect();
        change(&mut textures.iter_mut().find(|(r, _)| *r == role).unwrap().1);
        Pack::from_textures(self.info.clone(), textures)
            .unwrap()
            .with_field(self.field.clone())
            .unwrap()
    }

    fn field(&self, change: impl FnOnce(&mut Field)) -> Pack {
        let mut field = self.field.clone();
        change(&mut field);
        Pack::build(self.info.clone(), self.sources.clone())
            .unwrap()
            .with_any_field(field)
            .unwrap()
    }
}

fn info(resolved: &Resolved) -> PackInfo {
    PackInfo {
        name: resolved.name.clone(),
        seed: resolved.seed,
        baker: "forger".to_string(),
        recipe: resolved.recipe.clone(),
        inputs: Vec::new(),
        noon_elevation_rad: resolved.sun.noon_elevation_rad,
        aerosol_depths: resolved.sky.aerosol_depths,
        noise: resolved.clouds.noise,
        detail: resolved.clouds.detail,
    }
}

type Files = BTreeMap<String, Vec<u8>>;

fn files(pack: &Pack) -> Files {
    pack.files().iter().cloned().collect()
}

fn checked(files: &Files) -> Report {
    check_memory("forged", files).unwrap()
}

fn errors(report: &Report) -> Vec<&'static str> {
    let mut rules: Vec<_> = report
        .findings
        .iter()
        .filter(|f| f.is_error())
        .map(|f| f.rule)
        .collect();
    rules.dedup();
    rules
}

/// What has been tried.
#[derive(Default)]
struct Table {
    count: usize,
    missed: Vec<String>,
}

impl Table {
    fn refuse(&mut self, what: &str, rule: &str, pack: &Pack) {
        self.refuse_files(what, rule, &files(pack));
    }

    fn refuse_files(&mut self, what: &str, rule: &str, files: &Files) {
        self.count += 1;
        let found = errors(&checked(files));
        if !found.contains(&rule) {
            self.missed
                .push(format!("{what}: expected {rule}, found {found:?}"));
        }
    }

    fn end(self, least: usize) {
        assert!(self.missed.is_empty(), "{:#?}", self.missed);
        assert!(self.count >= least, "{}", self.count);
    }
}

/// Elevations of the sun in the table of the sky.
const SUNS: u32 = 24;

const CLOUDS: [&str; 3] = ["photo", "noise", "detail"];

/// Waves along u, 0..1.
fn stripes(image: &mut Image, channel: usize) {
    let width = image.width;
    for (i, texel) in (0..).zip(image.texels.chunks_exact_mut(image.channels)) {
        let turn = std::f64::consts::TAU * 4.0 * f64::from(i % width) / f64::from(width);
        texel[channel] = (0.5 + 0.5 * libm::sin(turn)) as f32;
    }
}

/// Numbers without order, 0..1.
fn white(image: &mut Image, channel: usize) {
    let mut state = 7_u64;
    for texel in image.texels.chunks_exact_mut(image.channels) {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        texel[channel] = (state >> 40) as f32 / 16_777_216.0;
    }
}

#[test]
fn forged_clouds_are_refused_in_bytes_and_in_half_floats() {
    let mut table = Table::default();
    for format in ["rgba8unorm", "rgba16float"] {
        let baked = Baked::new(format);
        assert!(
            checked(&files(&baked.pack())).is_sound(),
            "the pack is sound before"
        );
        let of = |what: &str| format!("{format}: {what}");
        let clouds = |change: &dyn Fn(&mut [f32])| baked.texels(Role::Clouds, change);
        for (a, b, rule) in [
            (0, 1, "cloud-clear"),
            (1, 2, "cloud-band"),
            (0, 2, "cloud-clear"),
            (2, 3, "gradient-monotone"),
        ] {
            table.refuse(
                &of(&format!("{a} and {b} swapped")),
                rule,
                &clouds(&|t| t.swap(a, b)),
            );
        }
        for (to, from) in [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)] {
            table.refuse(
                &of(&format!("{to} a copy of {from}")),
                "cloud-apart",
                &clouds(&|t| t[to] = t[from]),
            );
            let curve = |v: f32| libm::powf(v, 0.7);
            table.refuse(
                &of(&format!("{to} a curve of {from}")),
                "cloud-apart",
                &clouds(&|t| t[to] = curve(t[from])),
            );
        }
        for (channel, name) in CLOUDS.into_iter().enumerate() {
            let change = |change: &dyn Fn(f32) -> f32| {
                clouds(&|t| t[channel] = change(t[channel]).clamp(0.0, 1.0))
            };
            table.refuse(
                &of(&format!("{name} inverted")),
                "cloud-clear",
                &change(&|v| 1.0 - v),
            );
            table.refuse(
                &of(&format!("{name} plus 50")),
                "cloud-clear",
                &change(&|v| v + 50.0 / 255.0),
            );
            table.refuse(
                &of(&format!("{name} minus 50")),
                "cloud-clear",
                &change(&|v| v - 50.0 / 255.0),
            );
            table.refuse(
                &of(&format!("{name} at half")),
                "cloud-clear",
                &change(&|v| 0.5 * v),
            );
            table.refuse(
                &of(&format!("{name} constant")),
                "cloud-spread",
                &change(&|_| 0.3),
            );
            let of_image = |change: &dyn Fn(&mut Image)| {
                baked.image(Role::Clouds, |images| change(&mut images[0]))
            };
            table.refuse(
                &of(&format!("{name} of stripes")),
                "cloud-waves",
                &of_image(&|i| stripes(i, channel)),
            );
            table.refuse(
                &of(&format!("{name} of white noise")),
                "smooth",
                &of_image(&|i| white(i, channel)),
            );
        }
        let finer = |image: &mut Image| {
            let sound = image.clone();
            for (i, texel) in (0..).zip(image.texels.chunks_exact_mut(4)) {
                texel[1] = sound.texel(2 * (i % 128) % 128, 2 * (i / 128) % 128)[1];
            }
        };
        table.refuse(
            &of("noise twice as fine"),
            "cloud-band",
            &baked.image(Role::Clouds, |i| finer(&mut i[0])),
        );
        table.refuse(
            &of("gradient upside down"),
            "gradient-monotone",
            &clouds(&|t| t[3] = 1.0 - t[3]),
        );
        table.refuse(
            &of("gradient at half"),
            "gradient-ends",
            &clouds(&|t| t[3] *= 0.5),
        );
        forged_levels(&mut table, &baked, format);
    }
    table.end(70);
}

fn forged_levels(table: &mut Table, baked: &Baked, format: &str) {
    let of = |what: &str| format!("{format}: levels {what}");
    let colours = |t: &Texture| t.format.bytes_per_texel() * 3 / 4;
    let constant = baked.texture(Role::Clouds, |t| {
        let (bytes, kept) = (t.format.bytes_per_texel(), colours(t));
        let mean = t.levels[t.levels.len() - 1].clone();
        for level in &mut t.levels[1..] {
            level
                .chunks_exact_mut(bytes)
                .for_each(|texel| texel[..kept].copy_from_slice(&mean[..kept]));
        }
    });
    table.refuse(&of("constant"), "level-mean", &constant);
    let moved = baked.texture(Role::Clouds, |t| {
        let (bytes, kept) = (t.format.bytes_per_texel(), colours(t));
        for level in 1..t.levels.len() - 1 {
            // By half of the texture along u: the mean and all seams stay.
            let width = t.level_size(level).0 as usize;
            let sound = t.levels[level].clone();
            for (i, texel) in t.levels[level].chunks_exact_mut(bytes).enumerate() {
                let from = i / width * width + (i + width / 2) % width;
                texel[..kept].copy_from_slice(&sound[from * bytes..][..kept]);
            }
        }
    });
    table.refuse(&of("moved"), "level-mean", &moved);
    let brighter = baked.texture(Role::Clouds, |t| {
        let bytes = t.format.bytes_per_texel();
        t.levels[3]
            .chunks_exact_mut(bytes)
            .for_each(|texel| texel[bytes / 4 - 1] += 3);
    });
    table.refuse(&of("brighter"), "level-mean", &brighter);
    if format == "rgba16float" {
        let nan = half::f16::NAN.to_le_bytes();
        let broken = baked.texture(Role::Clouds, |t| {
            for level in &mut t.levels[1..] {
                level
                    .chunks_exact_mut(2)
                    .for_each(|half| half.copy_from_slice(&nan));
            }
        });
        table.refuse(&of("of no numbers"), "finite", &broken);
        let infinite = baked.texture(Role::Clouds, |t| {
            t.levels[2][..2].copy_from_slice(&half::f16::INFINITY.to_le_bytes());
        });
        table.refuse(&of("with an infinity"), "finite", &infinite);
    }
}

#[test]
fn forged_night_skies_are_refused() {
    let baked = Baked::new("rgba8unorm");
    let mut table = Table::default();
    let stars = |change: &dyn Fn(&mut [f32])| {
        baked.texels(Role::Stars, |t| {
            if t[0] > 0.0 {
                change(t)
            }
        })
    };
    let level = |change: &dyn Fn(&mut [u8])| {
        baked.texture(Role::Stars, |t| {
            t.levels[1]
                .chunks_exact_mut(4)
                .filter(|t| t[0] > 0)
                .for_each(change);
        })
    };
    for (what, rule, pack) in [
        ("variance 0", "star-flicker", stars(&|t| t[2] = 0.0)),
        (
            "variance at a tenth",
            "star-flicker",
            stars(&|t| t[2] *= 0.1),
        ),
        (
            "variance of intensity",
            "star-flicker",
            stars(&|t| t[2] = t[0].min(1.0 - t[0])),
        ),
        (
            "variance and intensity swapped",
            "star-clip",
            stars(&|t| t.swap(0, 2)),
        ),
        ("rate 0", "star-rate", stars(&|t| t[1] = 0.0)),
        ("one rate", "star-rate", stars(&|t| t[1] = 0.4)),
        (
            "rate inverted in part",
            "star-rate",
            stars(&|t| t[1] = t[1].max(0.5)),
        ),
        (
            "rate and phase swapped",
            "star-rate",
            stars(&|t| t.swap(1, 3)),
        ),
        ("one phase", "star-phase", stars(&|t| t[3] = 0.4)),
        (
            "phases of half a turn",
            "star-phase",
            stars(&|t| t[3] *= 0.5),
        ),
        (
            "intensity at half",
            "star-brightest",
            stars(&|t| {
                t[0] = 0.5 * t[0] + 0.01;
                t[2] *= 0.5;
            }),
        ),
        (
            "no stars",
            "star-share",
            baked.texels(Role::Stars, |t| t.fill(0.0)),
        ),
        (
            "stars everywhere",
            "star-share",
            baked.texels(Role::Stars, |t| t.copy_from_slice(&[0.5, 0.5, 0.1, 0.5])),
        ),
        (
            "numbers without stars",
            "star-empty",
            baked.texels(Role::Stars, |t| {
                if t[0] == 0.0 {
                    t[3] = 0.5
                }
            }),
        ),
        (
            "level 1 without flicker",
            "star-flicker",
            level(&|t| t[2] = 0),
        ),
        (
            "level 1 darker",
            "star-light",
            level(&|t| {
                t[0] = t[0].div_ceil(2);
                t[2] /= 2;
            }),
        ),
        (
            "level 1 of other phases",
            "star-record",
            level(&|t| t[3] ^= 0x80),
        ),
        (
            "level 1 of other rates",
            "star-record",
            level(&|t| t[1] ^= 0x10),
        ),
        (
            "level 2 moved",
            "star-record",
            baked.texture(Role::Stars, |t| t.levels[2].rotate_left(4)),
        ),
        ("stars on a lattice", "star-lattice", lattice(&baked)),
        (
            "galaxy constant",
            "galaxy-band",
            baked.texels(Role::Galaxy, |t| t[0] = 0.4),
        ),
        (
            "galaxy of noise",
            "galaxy-band",
            baked.image(Role::Galaxy, |i| white(&mut i[0], 0)),
        ),
        (
            "galaxy of stripes",
            "galaxy-band",
            baked.image(Role::Galaxy, |i| stripes(&mut i[0], 0)),
        ),
        (
            "galaxy inverted",
            "galaxy-brightness",
            baked.texels(Role::Galaxy, |t| t[0] = 1.0 - t[0]),
        ),
        (
            "galaxy black",
            "galaxy-brightness",
            baked.texels(Role::Galaxy, |t| t[0] = 0.0),
        ),
        (
            "galaxy at a tenth",
            "galaxy-brightness",
            baked.texels(Role::Galaxy, |t| t[0] *= 0.1),
        ),
        (
            "galaxy levels mirrored",
            "level-mean",
            baked.texture(Role::Galaxy, |t| t.levels[1].reverse()),
        ),
    ] {
        table.refuse(what, rule, &pack);
    }
    table.end(25);
}

fn lattice(baked: &Baked) -> Pack {
    baked.image(Role::Stars, |images| {
        let image = &mut images[0];
        let stars: Vec<[f32; 4]> = image
            .texels
            .chunks_exact(4)
            .filter(|t| t[0] > 0.0)
            .map(|t| [t[0], t[1], t[2], t[3]])
            .collect();
        image.texels.fill(0.0);
        for (i, star) in (0..).zip(stars) {
            let (x, y) = (i % 20 * 6, i / 20 * 6);
            image.texel_mut(x, y).copy_from_slice(&star);
        }
    })
}

#[test]
fn forged_day_skies_are_refused() {
    let baked = Baked::new("rgba8unorm");
    let mut table = Table::default();
    let sky = |change: &dyn Fn(&mut [f32])| baked.texels(Role::Sky, change);
    // Each texel from another haze, sun, part, column and row.
    type Place = [u32; 5];
    let moved = |from: &dyn Fn(Place) -> Place| {
        baked.image(Role::Sky, |images| {
            let sound = images.clone();
            let layers = (0..2).flat_map(|h| (0..SUNS).flat_map(move |s| [[h, s, 0], [h, s, 1]]));
            let index = |haze, sun, part| SkyLayer { haze, sun, part }.index(SUNS) as usize;
            for [haze, sun, part] in layers {
                for (y, x) in (0..32).flat_map(|y| (0..16).map(move |x| (y, x))) {
                    let [h, s, p, from_x, from_y] = from([haze, sun, part, x, y]);
                    let texel = sound[index(h, s, p)].texel(from_x, from_y);
                    images[index(haze, sun, part)]
                        .texel_mut(x, y)
                        .copy_from_slice(texel);
                }
            }
        })
    };
    let grey = |t: &mut [f32]| {
        let mean = (t[0] + t[1] + t[2]) / 3.0;
        t[..3].fill(mean);
    };
    let sun = |change: &dyn Fn(&mut [f32])| baked.texels(Role::Sun, change);
    for (what, rule, pack) in [
        ("red and blue swapped", "sky-colour", sky(&|t| t.swap(0, 2))),
        (
            "green and blue swapped",
            "sky-colour",
            sky(&|t| t.swap(1, 2)),
        ),
        (
            "red and green swapped",
            "sky-colour",
            sky(&|t| t.swap(0, 1)),
        ),
        ("grey", "sky-colour", sky(&grey)),
        ("negative", "sky-range", sky(&|t| t[0] = -t[0])),
        (
            "something where nothing is",
            "sky-range",
            sky(&|t| t[3] = 0.5),
        ),
        (
            "blue and nothing swapped",
            "sky-range",
            sky(&|t| t.swap(2, 3)),
        ),
        ("black", "sky-light", sky(&|t| t.fill(0.0))),
        (
            "of one colour",
            "sky-light",
            sky(&|t| t[..3].copy_from_slice(&[0.2, 0.3, 0.5])),
        ),
        (
            "at a tenth",
            "sky-light",
            sky(&|t| t.iter_mut().for_each(|v| *v *= 0.1)),
        ),
        (
            "noon at every hour",
            "sky-light",
            moved(&|[h, _, p, x, y]| [h, SUNS - 1, p, x, y]),
        ),
        (
            "suns backwards",
            "sky-light",
            moved(&|[h, s, p, x, y]| [h, SUNS - 1 - s, p, x, y]),
        ),
        (
            "three suns late",
            "sky-light",
            moved(&|[h, s, p, x, y]| [h, s.saturating_sub(3), p, x, y]),
        ),
        (
            "three suns early",
            "sky-light",
            moved(&|[h, s, p, x, y]| [h, (s + 3).min(SUNS - 1), p, x, y]),
        ),
        (
            "upside down",
            "sky-zenith",
            moved(&|[h, s, p, x, y]| [h, s, p, x, 31 - y]),
        ),
        (
            "the sun at its back",
            "sky-dusk",
            moved(&|[h, s, p, x, y]| [h, s, p, 15 - x, y]),
        ),
        (
            "the same at every azimuth",
            "sky-dusk",
            moved(&|[h, s, p, _, y]| [h, s, p, 8, y]),
        ),
        (
            "columns in another order",
            "sky-smooth",
            moved(&|[h, s, p, x, y]| [h, s, p, x * 5 % 16, y]),
        ),
        (
            "hazes swapped",
            "sky-haze",
            moved(&|[h, s, p, x, y]| [1 - h, s, p, x, y]),
        ),
        (
            "one haze for both",
            "sky-haze",
            moved(&|[_, s, p, x, y]| [0, s, p, x, y]),
        ),
        (
            "parts swapped",
            "sky-light",
            moved(&|[h, s, p, x, y]| [h, s, 1 - p, x, y]),
        ),
        (
            "no aureole",
            "sky-haze",
            baked.image(Role::Sky, |images| {
                images
                    .iter_mut()
                    .skip(1)
                    .step_by(2)
                    .for_each(|i| i.texels.fill(0.0));
            }),
        ),
        ("sun black", "sun-disc", sun(&|t| t.fill(0.0))),
        ("disc and glow swapped", "sun-disc", sun(&|t| t.swap(0, 1))),
        ("disc inverted", "sun-disc", sun(&|t| t[0] = 1.0 - t[0])),
        ("glow inverted", "sun-border", sun(&|t| t[1] = 1.0 - t[1])),
        ("disc at half", "sun-disc", sun(&|t| t[0] *= 0.5)),
        (
            "sun beside its place",
            "sun-round",
            baked.image(Role::Sun, |i| i[0].texels.rotate_right(12)),
        ),
        (
            "sun levels mirrored",
            "level-mean",
            baked.texture(Role::Sun, |t| {
                t.levels[1].rotate_left(16);
            }),
        ),
    ] {
        table.refuse(what, rule, &pack);
    }
    table.end(29);
}

#[test]
fn forged_textures_of_the_other_methods_are_refused() {
    let baked = Baked::new("rgba8unorm");
    let mut table = Table::default();
    let texels = |role: Role, change: &dyn Fn(&mut [f32])| baked.texels(role, change);
    for (what, rule, pack) in [
        (
            "octaves constant",
            "noise-flat",
            texels(Role::Octaves, &|t| t[1] = 0.5),
        ),
        (
            "octaves at half",
            "noise-flat",
            texels(Role::Octaves, &|t| t[2] *= 0.5),
        ),
        (
            "octaves of stripes",
            "noise-flat",
            baked.image(Role::Octaves, |i| stripes(&mut i[0], 3)),
        ),
        (
            "octaves in order",
            "noise-white",
            baked.image(Role::Octaves, |i| {
                for (n, texel) in i[0].texels.chunks_exact_mut(4).enumerate() {
                    texel[0] = (n / 4) as f32 / 255.0;
                }
            }),
        ),
        (
            "fbm layers swapped",
            "octave-band",
            baked.image(Role::Fbm, |i| i.swap(0, 1)),
        ),
        (
            "fbm steps swapped",
            "displaced",
            texels(Role::Fbm, &|t| t.swap(0, 1)),
        ),
        (
            "fbm noise and steps swapped",
            "displaced",
            texels(Role::Fbm, &|t| t.swap(0, 3)),
        ),
        (
            "fbm noise inverted",
            "displaced",
            texels(Role::Fbm, &|t| t[3] = 1.0 - t[3]),
        ),
        (
            "fbm of less contrast",
            "octave-even",
            texels(Role::Fbm, &|t| {
                t.iter_mut().for_each(|v| *v = 0.25 + 0.5 * *v)
            }),
        ),
        (
            "fbm plus 50",
            "octave-even",
            texels(Role::Fbm, &|t| {
                t.iter_mut().for_each(|v| *v = (*v + 0.2).min(1.0))
            }),
        ),
        (
            "fbm constant",
            "octave-band",
            texels(Role::Fbm, &|t| t.fill(0.5)),
        ),
        (
            "flares black",
            "flare-cells",
            texels(Role::Flares, &|t| t[0] = 0.0),
        ),
        (
            "flares inverted",
            "flare-cells",
            texels(Role::Flares, &|t| t[0] = 1.0 - t[0]),
        ),
        (
            "flares a cell to the right",
            "flare-shape",
            baked.image(Role::Flares, |i| i[0].texels.rotate_right(32)),
        ),
        (
            "flares a cell down",
            "flare-shape",
            baked.image(Role::Flares, |i| i[0].texels.rotate_right(64 * 32)),
        ),
        (
            "layers 0 and 1 swapped",
            "layer-mean",
            baked.image(Role::Layers, |i| i.swap(0, 1)),
        ),
        (
            "layers 1 and 2 swapped",
            "layer-mean",
            baked.image(Role::Layers, |i| i.swap(1, 2)),
        ),
        (
            "layers 0 and 2 swapped",
            "layer-mean",
            baked.image(Role::Layers, |i| i.swap(0, 2)),
        ),
        (
            "normals swapped",
            "normal-slope",
            texels(Role::Layers, &|t| t.swap(0, 1)),
        ),
        (
            "normals mirrored",
            "normal-slope",
            texels(Role::Layers, &|t| t[0] = 1.0 - t[0]),
        ),
        (
            "normals from below",
            "normal-slope",
            texels(Role::Layers, &|t| {
                t[..2].iter_mut().for_each(|v| *v = 1.0 - *v)
            }),
        ),
        (
            "normals flat",
            "normal-slope",
            texels(Role::Layers, &|t| t[..2].fill(0.5)),
        ),
        (
            "density inverted",
            "rank-order",
            texels(Role::Layers, &|t| t[2] = 1.0 - t[2]),
        ),
        (
            "density and rank inverted",
            "normal-slope",
            texels(Role::Layers, &|t| {
                t[2..].iter_mut().for_each(|v| *v = 1.0 - *v)
            }),
        ),
        (
            "rank inverted",
            "rank-order",
            texels(Role::Layers, &|t| t[3] = 1.0 - t[3]),
        ),
        (
            "rank constant",
            "rank-flat",
            texels(Role::Layers, &|t| t[3] = 0.5),
        ),
        (
            "rank of density",
            "rank-flat",
            texels(Role::Layers, &|t| t[3] = t[2]),
        ),
        (
            "density and rank swapped",
            "rank-flat",
            texels(Role::Layers, &|t| t.swap(2, 3)),
        ),
        (
            "layers' level moved",
            "level-mean",
            baked.texture(Role::Layers, |t| t.levels[1].rotate_left(64)),
        ),
        (
            "grey and alpha swapped",
            "sprite-border",
            texels(Role::Sprites, &|t| t.swap(0, 1)),
        ),
        (
            "alpha inverted",
            "sprite-border",
            texels(Role::Sprites, &|t| t[1] = 1.0 - t[1]),
        ),
        (
            "alpha 0",
            "sprite-cells",
            texels(Role::Sprites, &|t| t[1] = 0.0),
        ),
        (
            "sprites' level moved",
            "sprite-level",
            baked.texture(Role::Sprites, |t| t.levels[1].rotate_left(256)),
        ),
    ] {
        table.refuse(what, rule, &pack);
    }
    table.end(30);
}

#[test]
fn forged_fields_are_refused() {
    let baked = Baked::new("rgba8unorm");
    let mut table = Table::default();
    let field = |change: &dyn Fn(&mut Field)| baked.field(change);
    for (what, rule, pack) in [
        (
            "ranks alike",
            "field-spread",
            field(&|f| f.clouds.iter_mut().for_each(|c| c.rank = 0.5)),
        ),
        (
            "ranks backwards",
            "field-rank",
            field(&|f| f.clouds.reverse()),
        ),
        (
            "a rank above 1",
            "field-rank",
            field(&|f| f.clouds.iter_mut().for_each(|c| c.rank += 1.0)),
        ),
        (
            "sprites 10 km wide",
            "field-size",
            field(&|f| f.clouds[0].sprites[0].size_m = [10_000.0; 2]),
        ),
        (
            "all sprites 10 km wide",
            "field-size",
            field(&|f| {
                f.clouds
                    .iter_mut()
                    .flat_map(|c| &mut c.sprites)
                    .for_each(|s| s.size_m = [10_000.0; 2]);
            }),
        ),
        (
            "a sprite beside its box",
            "field-boxes",
            field(&|f| f.clouds[0].sprites[0].centre_m[0] += 5000.0),
        ),
        (
            "sprites in one place",
            "field-cull",
            field(&|f| {
                let cloud = f.clouds.iter_mut().find(|c| c.sprites.len() > 1).unwrap();
                cloud.sprites[1] = cloud.sprites[0];
            }),
        ),
        (
            "no light",
            "field-light",
            field(&|f| {
                f.hours
                    .iter_mut()
                    .for_each(|h| (h.ambient, h.colour) = (0.0, [0.0; 3]))
            }),
        ),
        (
            "hours backwards",
            "field-hours",
            field(&|f| f.hours.reverse()),
        ),
        (
            "light on the dark side",
            "field-hours",
            field(&|f| {
                f.hours
                    .iter_mut()
                    .for_each(|h| std::mem::swap(&mut h.least, &mut h.most))
            }),
        ),
        (
            "colours below 0",
            "field-range",
            field(&|f| f.clouds[0].levels[0].rgba[0] = -1.0),
        ),
        (
            "a picture that is not there",
            "field-index",
            field(&|f| f.clouds[0].sprites[0].cell = 77),
        ),
    ] {
        table.refuse(what, rule, &pack);
    }
    table.end(12);
}

/// Writes a manifest that says something else, and seals it: the hash of its text with 64 zeros for a seal.
fn resealed(pack: &Pack, change: impl FnOnce(&mut Value)) -> Files {
    let mut files = files(pack);
    let mut manifest: Value = serde_json::from_slice(&files["pack.json"]).unwrap();
    change(&mut manifest);
    let zeros = "0".repeat(64);
    manifest["seal"] = json!(zeros);
    let text = serde_json::to_string_pretty(&manifest).unwrap() + "\n";
    let seal = blake3::hash(text.as_bytes()).to_hex().to_string();
    files.insert(
        "pack.json".to_string(),
        text.replace(&zeros, &seal).into_bytes(),
    );
    files
}

#[test]
fn forged_manifests_are_refused() {
    let baked = Baked::new("rgba8unorm");
    let pack = baked.pack();
    assert!(
        checked(&resealed(&pack, |_| {})).is_sound(),
        "sealed again, nothing changed"
    );
    let mut table = Table::default();
    let clouds = |m: &mut Value, key: &str, value: Value| m["textures"][0][key] = value;
    let channel = |m: &mut Value, texture: usize, channel: usize, key: &str, value: Value| {
        m["textures"][texture]["channels"][channel][key] = value;
    };
    type Change<'a> = &'a dyn Fn(&mut Value);
    let cases: [(&str, &str, Change); 24] = [
        ("noon 1e9", "manifest", &|m| {
            m["noon_elevation_rad"] = json!(1e9)
        }),
        ("noon 0", "manifest", &|m| {
            m["noon_elevation_rad"] = json!(0.0)
        }),
        ("noon below the horizon", "manifest", &|m| {
            m["noon_elevation_rad"] = json!(-0.5)
        }),
        ("depths that fall", "manifest", &|m| {
            m["aerosol_depths"] = json!([0.24, 0.04])
        }),
        ("a range that lies", "manifest", &|m| {
            channel(m, 1, 1, "range", json!([0.0, 1.0]))
        }),
        ("a unit that lies", "manifest", &|m| {
            channel(m, 1, 1, "unit", json!("s"))
        }),
        ("a meaning that lies", "manifest", &|m| {
            channel(m, 0, 0, "meaning", json!("height"))
        }),
        ("a name that lies", "manifest", &|m| {
            channel(m, 0, 0, "name", json!("noise"))
        }),
        ("a sampler that lies", "manifest", &|m| {
            clouds(m, "sampler", json!({"wrap": "clamp", "filter": "linear"}))
        }),
        ("a filter that lies", "manifest", &|m| {
            clouds(m, "sampler", json!({"wrap": "repeat", "filter": "nearest"}))
        }),
        ("stars that are filtered", "manifest", &|m| {
            m["textures"][1]["sampler"] = json!({"wrap": "repeat", "filter": "linear"})
        }),
        ("a mean that lies", "statistics", &|m| {
            channel(m, 0, 1, "mean", json!(0.3))
        }),
        ("a spread that lies", "statistics", &|m| {
            channel(m, 0, 1, "spread", json!(0.3))
        }),
        ("no octaves", "manifest", &|m| {
            m["textures"][0]["channels"][1]
                .as_object_mut()
                .unwrap()
                .remove("fractal");
        }),
        ("octaves of a photograph", "manifest", &|m| {
            let fractal = m["textures"][0]["channels"][1]["fractal"].clone();
            channel(m, 0, 0, "fractal", fractal);
        }),
        ("no cells", "manifest", &|m| {
            m["textures"][0]["channels"][1]["fractal"]["cells"] = json!(0)
        }),
        ("other cells", "cloud-band", &|m| {
            m["textures"][0]["channels"][1]["fractal"]["cells"] = json!(16)
        }),
        ("another mean to reach", "cloud-mean", &|m| {
            m["textures"][0]["channels"][1]["fractal"]["mean"] = json!(0.3)
        }),
        ("another width", "manifest", &|m| {
            clouds(m, "width", json!(64))
        }),
        ("other levels", "manifest", &|m| {
            clouds(m, "levels", json!(3))
        }),
        ("another file", "manifest", &|m| {
            clouds(m, "file", json!("stars.ktx2"))
        }),
        ("a role twice", "manifest", &|m| {
            m["textures"][1] = m["textures"][0].clone()
        }),
        ("another format", "layout", &|m| {
            clouds(m, "format", json!("rgba16float"))
        }),
        ("more sprites", "field-file", &|m| {
            m["field"]["sprites"] = json!(1)
        }),
    ];
    for (what, rule, change) in cases {
        table.refuse_files(what, rule, &resealed(&pack, change));
    }
    let mut broken = files(&pack);
    let text = String::from_utf8(broken["pack.json"].clone()).unwrap();
    broken.insert(
        "pack.json".to_string(),
        text.replace("\"seed\": 1,", "\"seed\": 2,").into_bytes(),
    );
    table.refuse_files("another seed under the old seal", "seal", &broken);
    let mut swapped = files(&pack);
    let [stars, clouds] = ["stars.ktx2", "clouds.ktx2"].map(|name| swapped[name].clone());
    swapped.insert("stars.ktx2".to_string(), clouds);
    swapped.insert("clouds.ktx2".to_string(), stars);
    table.refuse_files("files swapped", "file-hash", &swapped);
    table.end(26);
}

#[test]
fn formats_are_told_apart() {
    // Half floats that say they are bytes do not decode as such.
    let baked = Baked::new("rgba16float");
    assert_eq!(
        baked.pack().texture(Role::Clouds).unwrap().format,
        Format::Rgba16Float
    );
}
