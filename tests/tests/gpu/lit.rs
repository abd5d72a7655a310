//! Clouds of the lit method are lit as the paper's equations say: measured on pictures.
//!
//! In a pack without the light of the sky a picture holds `alpha F` alone (equation 6), and light that comes through
//! (equation 4) is switched off by k1 = k2 = 0 and is 1 with k1 = 1: quotients of pictures leave single terms.

use std::sync::OnceLock;

use glam::{Vec2, Vec3};
use welkin_pack::{Image, LayerKind, Pack, mapping};
use welkin_runtime::internals::clouds::lit::LitUniforms;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::params::{LitLayer, LitParams, Shading};
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::film::Film;
use welkin_tests::{camera, gpu, lit_paper, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [96, 96];

/// The default clouds and nothing but what sun or moon make of them.
fn lit_alone() -> &'static Pack {
    static PACK: OnceLock<Pack> = OnceLock::new();
    PACK.get_or_init(|| pack::lit_alone(|_, _| {}))
}

/// What a half float may be off by, over itself.
const HALF: f32 = 1.0 / 2048.0;
/// The smallest half float.
const LEAST_HALF: f32 = 1.0 / 16_777_216.0;

/// One layer of a kind, and nothing before or behind it.
fn one(kind: LayerKind) -> SkyParams {
    SkyParams {
        method: Method::Lit,
        shading: Shading::Paper,
        lit: LitParams::with_layers(&[LitLayer::of(kind, 1.0)]),
        sun: false,
        stars: false,
        flare: 0.0,
        ..SkyParams::default()
    }
}

/// The same with other constants of equations 4 and 5.
fn with(params: &SkyParams, [k1, k2, m]: [f32; 3]) -> SkyParams {
    let mut params = *params;
    (params.lit.k1, params.lit.k2, params.lit.m) = (k1, k2, m);
    params
}

/// The green channel of a picture.
fn draw(sky: &mut Sky, params: &SkyParams, view: &Camera, seconds: f64) -> Vec<f32> {
    let texels = gpu::render(sky, FORMAT, params, view, seconds);
    texels.iter().map(|texel| texel[1]).collect()
}

fn overhead(fov_rad: f32) -> Camera {
    Camera::looking(0.0, std::f32::consts::FRAC_PI_2, fov_rad, SIZE)
}

fn uniforms(pack: &Pack, params: &SkyParams) -> LitUniforms {
    let facts = PackData::new(pack).expect("the pack has every role");
    facts.uniforms(params, &overhead(1.0), 0.0, 0.0).lit
}

fn sun(pack: &Pack, time: f32) -> Vec3 {
    mapping::sun_direction(time, pack.manifest().noon_elevation_rad).into()
}

/// The directions of a camera's pixels.
fn directions(pack: &Pack, view: &Camera) -> Vec<Vec3> {
    let facts = PackData::new(pack).expect("the pack has every role");
    let uniforms = facts.uniforms(&SkyParams::default(), view, 0.0, 0.0).camera;
    let [width, height] = view.viewport_px;
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| Vec2::new(x as f32, y as f32)));
    pixels
        .map(|pixel| camera::ray_of(&uniforms, pixel + 0.5).normalize())
        .collect()
}

/// `(a - c) / (b - c)` of pictures, with what half floats make it off by, where it is known to a fiftieth.
fn quotients(a: &[f32], b: &[f32], c: &[f32]) -> Vec<Option<[f32; 2]>> {
    let quotient = |((a, b), c): ((&f32, &f32), &f32)| {
        let (over, under) = (a - c, b - c);
        let ratio = over / under;
        let off = (HALF * ((a + c) + (b + c) * ratio.abs()) + LEAST_HALF) / under;
        (under > 0.05 && off < 0.02).then_some([ratio, off])
    };
    a.iter().zip(b).zip(c).map(quotient).collect()
}

/// With the same m the shade is the same, and the difference to k1 = k2 = 0 is `LS SH`.
#[test]
fn what_comes_through_rises_towards_the_sun_as_equation_4_says() {
    let pack = lit_alone();
    let mut sky = gpu::sky(pack, FORMAT);
    let three = SkyParams {
        lit: LitParams::default(),
        ..one(LayerKind::Stratocumulus)
    };
    for (params, time) in [
        (one(LayerKind::Cirrus), 0.5),
        (one(LayerKind::Stratocumulus), 0.35),
        (three, 0.71),
    ] {
        let params = SkyParams { time, ..params };
        let towards = sun(pack, time);
        let (azimuth, _) = mapping::angles_from_direction(towards.to_array());
        for (away, m) in [(0.0, 1.0), (1.5, 3.0), (3.1, 0.5)] {
            let view = Camera::looking(azimuth + away, 0.8, 1.4, SIZE);
            let directions = directions(pack, &view);
            let mut draw =
                |k1: f32, k2: f32| draw(&mut sky, &with(&params, [k1, k2, m]), &view, 9.0);
            let (none, all) = (draw(0.0, 0.0), draw(1.0, 0.0));
            for [k1, k2] in [[0.55, 0.45], [0.0, 1.0], [0.9, 0.1], [1.0, 1.0]] {
                let seen = quotients(&draw(k1, k2), &all, &none);
                let pixels = seen
                    .iter()
                    .zip(&directions)
                    .filter_map(|(s, d)| Some((s.as_ref()?, d)));
                let mut count = 0;
                for ([seen, off], direction) in pixels {
                    let expected = (k1 + k2 * direction.dot(towards)).max(0.0).powf(m);
                    // A power of a GPU is off by 2^-10 of itself, and so is that of k1 = 1.
                    let bound = off + 2.0 * expected / 1024.0;
                    assert!(
                        (seen - expected).abs() < bound,
                        "time {time}, k {k1} {k2} {m}: {seen} along {direction}, expected {expected} within {bound}"
                    );
                    count += 1;
                }
                assert!(count > 500, "time {time}: clouds in {count} pixels only");
            }
        }
    }
}

/// A pack whose normals are all the same.
fn tilted(normal: Vec2) -> Pack {
    pack::lit_alone(|_, image| {
        for texel in image.texels.chunks_exact_mut(4) {
            texel[..2].copy_from_slice(&(normal * 0.5 + 0.5).to_array());
        }
    })
}

/// Cirrus has no grain: its normals are read once only.
#[test]
fn what_falls_on_a_cloud_is_equation_3() {
    for (tilt, way) in [(0.0, 0.0), (0.5, 0.4), (0.8, 2.0), (0.8, -1.0), (0.3, 4.0)] {
        let normal = tilt * Vec2::from_angle(way);
        let pack = tilted(normal);
        let mut sky = gpu::sky(&pack, FORMAT);
        // A sun below 30 degrees lights the sides of clouds, too.
        for time in [0.36, 0.4, 0.5, 0.64] {
            let params = SkyParams {
                time,
                ..one(LayerKind::Cirrus)
            };
            // Turned as the layer, and as flat as the kind's relief.
            let lit = uniforms(&pack, &params);
            let layer = lit.layers[0];
            assert_eq!(layer.grain, 0.0);
            let Vec2 { x, y } = layer.east_axis;
            let turned = Vec2::new(x, -y).normalize();
            let across = layer.relief * turned.rotate(normal);
            let upwards = (1.0 - across.length_squared()).sqrt();
            let normal = Vec3::new(across.x, upwards, across.y);
            let expected = normal.dot(sun(&pack, time)).max(0.0);
            let view = overhead(0.2);
            let mut draw = |k1: f32| draw(&mut sky, &with(&params, [k1, 0.0, 2.0]), &view, 3.0);
            let (none, all) = (draw(0.0), draw(1.0));
            let black = vec![0.0; none.len()];
            // LT SH over LS SH with LS = 1: what is there without light from behind over what that adds.
            let added: Vec<f32> = all
                .iter()
                .zip(&none)
                .map(|(all, none)| all - none)
                .collect();
            let mut count = 0;
            for [seen, off] in quotients(&none, &added, &black).into_iter().flatten() {
                // Bytes of a normal's part, in two reads of the pack, the map and its read: three, rounded up. A difference of
                // half floats is off by both.
                let bytes = 3.0 * 2.0 / 255.0 * layer.relief * 2.0_f32.sqrt();
                let bound = bytes * (1.0 + across.length() / upwards) + 3.0 * off;
                assert!(
                    (seen - expected).abs() < bound,
                    "normal {normal} at {time}: {seen}, expected {expected} within {bound}"
                );
                count += 1;
            }
            assert!(count > 500, "clouds in {count} pixels only");
        }
    }
}

/// What is seen of clouds overhead: opacity, and light over opacity.
struct Seen {
    alpha: Vec<f32>,
    light: Vec<f32>,
}

fn look(film: &mut Film, sky: &mut Sky, params: &SkyParams, seconds: f64) -> Seen {
    let view = overhead(1.8);
    let alpha = film.alpha(params, &view, seconds);
    let light = draw(sky, params, &view, seconds);
    let light = light.iter().zip(&alpha).map(|(l, a)| l / a.max(1e-3));
    Seen {
        light: light.collect(),
        alpha,
    }
}

fn mean(values: impl Iterator<Item = f32>) -> f32 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), v| (sum + v, count + 1));
    assert!(count > 30, "there are pixels to look at: {count}");
    sum / count as f32
}

impl Seen {
    /// Mean light of the pixels with this opacity.
    fn light_of(&self, alpha: std::ops::Range<f32>) -> f32 {
        let pixels = self.light.iter().zip(&self.alpha);
        mean(pixels.filter(|(_, a)| alpha.contains(a)).map(|(l, _)| *l))
    }

    /// Mean light of the rims that face a way on the screen (right and down): where opacity falls that way.
    fn light_of_rims(&self, way: Vec2) -> f32 {
        let side = SIZE[0] as usize;
        let slope = |i: usize| {
            let along = |step: usize| self.alpha[i + step] - self.alpha[i - step];
            Vec2::new(along(1), along(side))
        };
        let inside = (1..side - 1).flat_map(|y| (1..side - 1).map(move |x| y * side + x));
        let rims = inside.filter(|&i| (0.2..0.9).contains(&self.alpha[i]));
        // Within 45 degrees.
        let facing = rims.filter(|&i| {
            let slope = slope(i);
            -slope.dot(way) > 0.7 * slope.length()
        });
        mean(facing.map(|i| self.light[i]))
    }
}

/// Moments with clouds that have nothing to do with each other.
const MOMENTS: [f64; 5] = [0.0, 700.0, 1500.0, 2300.0, 4000.0];

/// At a low sun, in every one of twenty skies; by chance once in a million times. The light from behind is switched off towards
/// all sides alike, so that a rim is not brighter for being nearer to the sun on the screen.
#[test]
fn rims_towards_the_sun_are_brighter_than_those_that_face_away() {
    let pack = lit_alone();
    let (mut film, mut sky) = (Film::new(), gpu::sky(pack, FORMAT));
    for kind in [LayerKind::Stratocumulus, LayerKind::Cumulus] {
        for time in [0.29, 0.71] {
            let params = SkyParams { time, ..one(kind) };
            let params = with(&params, [0.55, 0.0, params.lit.m]);
            let rays = overhead(1.8).rays();
            let towards = sun(pack, time);
            let way = Vec2::new(towards.dot(rays.right), -towards.dot(rays.up)).normalize();
            for seconds in MOMENTS {
                let seen = look(&mut film, &mut sky, &params, seconds);
                let [near, far] = [way, -way].map(|way| seen.light_of_rims(way));
                println!(
                    "{} at {time}, {seconds} s: {near:.3} towards the sun, {far:.3} away",
                    kind.name()
                );
                assert!(near > far, "{kind:?} at {time}, {seconds} s: {near}, {far}");
            }
        }
    }
}

#[test]
fn thick_middles_are_darker_than_thin_edges() {
    let pack = lit_alone();
    let (mut film, mut sky) = (Film::new(), gpu::sky(pack, FORMAT));
    for kind in [LayerKind::Stratocumulus, LayerKind::Cumulus] {
        for (density, shading) in [0.2, 0.8]
            .into_iter()
            .flat_map(|d| Shading::ALL.map(|s| (d, s)))
        {
            let params = SkyParams {
                time: 0.45,
                density,
                shading,
                ..one(kind)
            };
            for seconds in MOMENTS {
                let seen = look(&mut film, &mut sky, &params, seconds);
                let [thin, thick] = [0.1..0.5, 0.97..2.0].map(|alpha| seen.light_of(alpha));
                println!(
                    "{} {shading:?} {density}, {seconds} s: thin {thin:.3}, thick {thick:.3}",
                    kind.name()
                );
                assert!(
                    thick < thin,
                    "{kind:?} {shading:?} {density} at {seconds} s: {thick}, {thin}"
                );
            }
        }
    }
}

/// Level 0 of the first layer of the map.
fn top_of_map(sky: &mut Sky, params: &SkyParams) -> Image {
    gpu::prepare(sky, params, &overhead(1.0), 0.0);
    gpu::read_map(sky)[0].levels()[0].clone()
}

/// Equation 5's exponent: with m = 1 the map holds `1 - sum C`, and with another m its power.
#[test]
fn shade_is_a_power_of_what_is_left() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for kind in LayerKind::ALL {
        let mut shade = |m: f32| {
            let params = with(&one(kind), [0.5, 0.5, m]);
            let map = top_of_map(&mut sky, &params);
            map.channel(3).collect::<Vec<_>>()
        };
        let left = shade(1.0);
        assert!(left.iter().any(|l| *l < 0.9), "{kind:?} shades");
        for m in [0.5, 3.0, 8.0] {
            for (left, shade) in left.iter().zip(shade(m)) {
                // Both are rounded to bytes, and the power makes of it what its slope does there.
                let half = 0.5 / 255.0;
                let [less, more] = [left - half, left + half].map(|l| l.max(0.0).powf(m));
                assert!(
                    (less - 1.01 * half..more + 1.01 * half).contains(&shade),
                    "{kind:?}, m {m}: {shade} of {left}"
                );
            }
        }
    }
}

/// The places whose shade is blurred lie on straight lines that meet where the sun is seen, from all sides of it: no two of these
/// lines are parallel.
#[test]
fn shade_is_blurred_radially_from_where_the_sun_is_seen() {
    let pack = pack::default_pack();
    for time in [0.3, 0.4, 0.5, 0.72] {
        let params = SkyParams {
            time,
            ..one(LayerKind::Cumulus)
        };
        let lit = uniforms(pack, &params);
        let towards = sun(pack, time);
        let seen =
            welkin_runtime::internals::clouds::lit::intersect(params.lit.flattening, towards)
                .position;
        let source = Vec2::new(seen.x, seen.z);
        for turn in 0..16 {
            let away = Vec2::from_angle(turn as f32 / 16.0 * std::f32::consts::TAU);
            for distance in [0.1, 1.0, 6.0] {
                let plane = source + away * distance;
                let [own, near, far] = lit_paper::places(&lit, 0, plane);
                assert_eq!(own, plane);
                let (first, second) = (near - own, far - near);
                assert!((first - second).length() < 1e-5 * distance, "evenly apart");
                let along = first.normalize();
                assert!(along.dot(-away) > 0.9999, "{along} from {away}");
                assert!((far - own).length() <= distance, "never beyond the sun");
            }
        }
    }
}

/// A disc of cloud between a place and the sun shades it, and one beside the line or behind the place does not: by the shader, seen
/// through pictures of a pack with one blob of cloud.
#[test]
fn a_cloud_is_shaded_by_what_is_between_it_and_the_sun() {
    // A wall of cloud, thin but for one thick stripe along v: thick places shade the thin ones on the far side of the sun.
    let stripe = pack::lit_alone(|_, image| {
        let side = image.width as f32;
        for (i, texel) in image.texels.chunks_exact_mut(4).enumerate() {
            let x = (i % side as usize) as f32 / side;
            let thick = f32::from(u8::from((0.45..0.55).contains(&x)));
            texel.copy_from_slice(&[0.5, 0.5, 0.5 * thick, 0.55 + 0.45 * thick]);
        }
    });
    let mut sky = gpu::sky(&stripe, FORMAT);
    for time in [0.32, 0.68] {
        let mut params = SkyParams {
            time,
            cover: 1.0,
            ..one(LayerKind::Cumulus)
        };
        params.lit.formation_interval_s = 86_400.0;
        let lit = uniforms(&stripe, &params);
        let step = lit.layers[0].blur_step;
        // As wide as the stripe is surely in sight.
        let view = overhead(2.4);
        let light = draw(
            &mut sky,
            &with(&params, [0.0, 0.0, params.lit.m]),
            &view,
            0.0,
        );
        let map = gpu::read_map(&sky)[0].levels()[0].clone();
        let own = |plane: Vec2| {
            let layer = lit.layers[0];
            let uv = layer.east_axis * plane.x + layer.south_axis * plane.y + layer.offset;
            let texel = |c: f32| (c.rem_euclid(1.0) * map.width as f32) as u32 % map.width;
            map.texel(texel(uv.x), texel(uv.y))[3]
        };
        // Thin places: those with a thick one on the way to the sun are darker than those with one as far the other way.
        let (mut shaded, mut free) = (Vec::new(), Vec::new());
        for (direction, light) in directions(&stripe, &view).iter().zip(&light) {
            let distance = welkin_runtime::internals::clouds::lit::intersect(
                params.lit.flattening,
                *direction,
            )
            .distance;
            let plane = Vec2::new(direction.x, direction.z) * distance;
            let [here, near, far] = lit_paper::places(&lit, 0, plane);
            let (way, thin) = (near - here, own(here));
            let [behind, beyond] = [here - way, here - 2.0 * way].map(own);
            let [near, far] = [near, far].map(own);
            if near.min(far) < 0.6 * thin && behind.min(beyond) > 0.95 * thin {
                shaded.push(*light);
            } else if near.min(far) > 0.95 * thin && behind.min(beyond) < 0.6 * thin {
                free.push(*light);
            }
        }
        let (shaded, free) = (mean(shaded.into_iter()), mean(free.into_iter()));
        println!("time {time}, step {step}: {shaded:.3} shaded, {free:.3} free");
        // At the least the farthest of the three places, a sixth of the blur, has lost four tenths.
        assert!(
            shaded < (1.0 - 0.4 / 6.0) * free,
            "time {time}: {shaded} {free}"
        );
    }
}

/// The light on clouds: first the sun's, ever redder as it sets, then the moon's from the other side.
#[test]
fn the_sun_sets_red_and_the_moon_takes_over() {
    let pack = pack::default_pack();
    let at = |time: f32, moon: f32| {
        let mut params = one(LayerKind::Stratocumulus);
        (params.time, params.moon) = (time, moon);
        let lit = uniforms(pack, &params);
        (lit.light, lit.light_direction)
    };
    let mut last = 0.0;
    // Below 6 degrees the clouds' own air mass ends the reddening.
    for time in [0.5, 0.6, 0.66, 0.7, 0.72] {
        let (light, towards) = at(time, 1.0);
        assert!((towards - sun(pack, time)).length() < 1e-6, "time {time}");
        let redness = light.x / light.z;
        assert!(redness > last, "time {time}: {light}");
        last = redness;
    }
    let (full, towards) = at(0.0, 1.0);
    assert!((towards + sun(pack, 0.0)).length() < 1e-6 && towards.y > 0.0);
    assert!(full.min_element() > 0.0);
    assert!((at(0.0, 0.5).0 * 2.0 - full).abs().max_element() < 1e-6);
    assert_eq!(at(0.0, 0.0).0, Vec3::ZERO);
    assert_eq!(at(0.5, 1.0), at(0.5, 0.0), "no moon by day");
    // Nothing is lit while the light goes over to the other side of the sky: a step of sin x = 0.0031 along its rise over 0.14
    // makes 3 x^2 = 0.0015 of it.
    for step in 0..2000 {
        let [before, after] = [step, step + 1].map(|i| at(i as f32 / 2000.0, 1.0));
        let turned = before.1.dot(after.1) < 0.0;
        let lit = before.0.max(after.0);
        assert!(
            !turned || lit.cmple(full * 0.002).all(),
            "step {step}: {lit}"
        );
    }
}

/// By night too, clouds in a picture have the light that the moon gives: half a moon, half the light, over that of the airglow.
#[test]
fn the_moon_lights_clouds() {
    let mut sky = gpu::sky(lit_alone(), FORMAT);
    let mut lit_by = |moon: f32| {
        let mut params = SkyParams {
            time: 0.0,
            ..one(LayerKind::Stratocumulus)
        };
        params.moon = moon;
        draw(&mut sky, &params, &overhead(1.0), 5.0)
    };
    let [none, half, full] = [0.0, 0.5, 1.0].map(&mut lit_by);
    assert!(
        none.iter().all(|light| *light < 0.005),
        "next to no light but the moon's"
    );
    assert!(full.iter().any(|light| *light > 0.03), "the moon shines");
    for ((none, half), full) in none.iter().zip(&half).zip(&full) {
        let off = HALF * (2.0 * half + full + none) + LEAST_HALF;
        assert!(
            (2.0 * half - full - none).abs() <= off,
            "{none} {half} {full}"
        );
    }
}
