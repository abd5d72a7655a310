//! The skies that are compared.

use glam::Vec3;
use welkin_pack::LayerKind;
use welkin_runtime::almanac::refraction::lifted;
use welkin_runtime::almanac::{Place, moon};
use welkin_runtime::params::{
    FbmParams, LitLayer, LitParams, OctaveParams, PerezParams, PerezShape, Shading, SkyModel,
    Tonemap,
};
use welkin_runtime::{Camera, Method, SkyParams};

pub const SIZE: [u32; 2] = [96, 72];

/// A sky to compare.
pub struct Case {
    pub name: String,
    pub params: SkyParams,
    pub camera: Camera,
    pub seconds: f64,
}

/// Azimuth and elevation of the camera are in degrees.
fn case(name: &str, params: SkyParams, azimuth: f32, elevation: f32, seconds: f64) -> Case {
    Case {
        name: format!("{}_{name}", params.method.name()),
        params: SkyParams {
            flare: 0.0,
            ..params
        },
        camera: camera(azimuth, elevation),
        seconds,
    }
}

pub fn camera(azimuth_deg: f32, elevation_deg: f32) -> Camera {
    Camera::looking(
        azimuth_deg.to_radians(),
        elevation_deg.to_radians(),
        1.05,
        SIZE,
    )
}

/// A sky of a date and place, seen through a telescope: the moon fills the middle.
fn moon_case(name: &str, date: &str, place: Place) -> Case {
    let date = date.parse().ok();
    let params = SkyParams {
        date,
        place,
        cover: 0.2,
        ..SkyParams::default()
    };
    let moon = date.map_or(Vec3::Y, |date| {
        lifted(moon::seen(date, place).direction).as_vec3()
    });
    let azimuth_rad = moon.x.atan2(-moon.z);
    let mut case = case(name, params, 0.0, 0.0, 0.0);
    case.camera = Camera::looking(azimuth_rad, moon.y.asin(), 0.016, SIZE);
    case
}

/// The same with half as many pixels across the moon. Directions are rounded to 2^-24, some thousandths of a narrow pixel after a few sums; along
/// the moon's limb, where a hundredth of the corona is left, that is more than the 2 % of [`allowed`](super::allowed).
fn wider(mut case: Case) -> Case {
    case.camera.fov_y_rad *= 2.0;
    case
}

/// Skies that every method draws.
fn shared_skies(method: Method) -> Vec<Case> {
    let day = SkyParams {
        method,
        ..SkyParams::default()
    };
    let at = |time: f32, cover: f32| SkyParams { time, cover, ..day };
    let sunset = SkyParams {
        sunset: 0.7,
        ..at(0.745, 0.6)
    };
    let overcast = SkyParams {
        density: 0.5,
        ..at(0.4, 0.95)
    };
    let late = SkyParams {
        speed: 1.0,
        ..at(0.5, 0.7)
    };
    let paper = |params: SkyParams| SkyParams {
        shading: Shading::Paper,
        ..params
    };
    let mut walked = case("walked", at(0.45, 0.5), 60.0, 50.0, 30.0);
    walked.camera.position_m = Vec3::new(2750.0, 120.0, -1300.0);
    vec![
        case("noon", at(0.5, 0.6), 180.0, 40.0, 12.0),
        case("sunset", sunset, 270.0, 12.0, 100.0),
        case("paper", paper(at(0.4, 0.6)), 180.0, 40.0, 12.0),
        case("paper_sunset", paper(sunset), 270.0, 12.0, 100.0),
        case("paper_overcast", paper(overcast), 20.0, 30.0, 500.0),
        case("twilight", at(0.77, 0.5), 270.0, 10.0, 3.0),
        case("night", at(0.0, 0.3), 180.0, 45.0, 21.5),
        case("overcast", overcast, 20.0, 30.0, 500.0),
        case("shut", at(0.55, 1.0), 140.0, 15.0, 45.0),
        case("below_the_horizon", at(0.35, 0.7), 100.0, -30.0, 0.0),
        case("zenith", at(0.6, 0.5), 0.0, 90.0, 63.9),
        case("late", late, 200.0, 50.0, 1e6),
        walked,
    ]
}

fn packed_skies() -> Vec<Case> {
    let day = SkyParams::default();
    let dense = SkyParams {
        density: 1.0,
        height: 0.0,
        time: 0.6,
        cover: 0.5,
        ..day
    };
    let upper_layer = SkyParams {
        upper_layer: 1.0,
        sunset: 0.5,
        time: 0.3,
        cover: 0.45,
        ..day
    };
    let clear_night = SkyParams {
        time: 0.98,
        cover: 0.0,
        ..day
    };
    let north = Place {
        latitude_deg: 40.0,
        longitude_deg: 0.0,
    };
    let dallas = Place {
        latitude_deg: 32.8,
        longitude_deg: -96.8,
    };
    // A half moon in the south-west, over the dusk in the west.
    let dated = SkyParams {
        date: "2026-01-26T18:15:00Z".parse().ok(),
        place: north,
        cover: 0.4,
        ..day
    };
    // Jupiter, high in the south at midnight.
    let opposition = SkyParams {
        date: "2026-01-10T00:00:00Z".parse().ok(),
        place: north,
        cover: 0.1,
        ..day
    };
    // The southern sky, both halves of its dome, without a moon.
    let southern = SkyParams {
        date: "2026-06-14T12:00:00Z".parse().ok(),
        place: Place {
            latitude_deg: -33.9,
            longitude_deg: 151.2,
        },
        cover: 0.0,
        ..day
    };
    vec![
        moon_case("half_moon", "2026-01-26T18:15:00Z", north),
        moon_case("crescent", "2026-01-20T16:20:00Z", north),
        moon_case("day_moon", "2026-01-26T15:00:00Z", north),
        moon_case("eclipse", "2024-04-08T18:10:00Z", dallas),
        wider(moon_case("totality", "2024-04-08T18:42:30Z", dallas)),
        case("jupiter", opposition, 180.0, 70.0, 0.0),
        case("southern_horizon", southern, 180.0, 20.0, 0.0),
        case("southern_equator", southern, 0.0, 45.0, 0.0),
        case("dated", dated, 230.0, 30.0, 0.0),
        case("figure_2", SkyParams::figure_2(), 120.0, 22.0, 40.0),
        case("figure_4", SkyParams::figure_4(), 255.0, 18.0, 0.0),
        case("dense", dense, 330.0, 60.0, 7.0),
        case("upper_layer", upper_layer, 80.0, 25.0, 50.0),
        case("clear_night_zenith", clear_night, 0.0, 90.0, 63.9),
    ]
}

fn octave_skies() -> Vec<Case> {
    let day = SkyParams {
        method: Method::Octaves,
        ..SkyParams::default()
    };
    let with = |octaves: OctaveParams| SkyParams { octaves, ..day };
    let defaults = OctaveParams::default();
    let storm = SkyParams {
        cover: 0.9,
        density: 0.9,
        time: 0.42,
        ..day
    };
    let dome = |index: usize| {
        let mut domes = [0.0; 3];
        domes[index] = 1.0;
        with(OctaveParams { domes, ..defaults })
    };
    let sharp = with(OctaveParams {
        sharpness: 0.1,
        ..defaults
    });
    let six = with(OctaveParams {
        count: 6,
        ..defaults
    });
    vec![
        case("storm", storm, 160.0, 25.0, 70.0),
        case("low", dome(0), 90.0, 35.0, 8.0),
        case("middle", dome(1), 300.0, 35.0, 8.0),
        case("high", dome(2), 10.0, 35.0, 8.0),
        case("sharp", sharp, 240.0, 50.0, 59.99),
        case("six_octaves", six, 330.0, 40.0, 33.0),
    ]
}

fn fbm_skies() -> Vec<Case> {
    let day = SkyParams {
        method: Method::Fbm,
        ..SkyParams::default()
    };
    let storm = SkyParams {
        cover: 0.9,
        density: 0.9,
        time: 0.42,
        fbm: FbmParams::STORMY,
        ..day
    };
    let sharpness = |sharpness: f32| SkyParams {
        fbm: FbmParams {
            sharpness,
            lit: [1.0, 0.9, 0.6],
            shaded: [0.2, 0.4, 0.7],
        },
        ..day
    };
    vec![
        case("storm", storm, 160.0, 25.0, 70.0),
        case("soft", sharpness(0.0), 90.0, 35.0, 8.0),
        case("sharp", sharpness(0.8), 300.0, 35.0, 1234.5),
    ]
}

fn lit_skies() -> Vec<Case> {
    let day = SkyParams {
        method: Method::Lit,
        ..SkyParams::default()
    };
    let with = |lit: LitParams| SkyParams { lit, ..day };
    let of = |kinds: &[LayerKind]| {
        let layers: Vec<_> = kinds.iter().map(|&kind| LitLayer::of(kind, 1.0)).collect();
        with(LitParams::with_layers(&layers))
    };
    let one = |kind: LayerKind| of(&[kind]);
    let dome = |radius_m: f32, flattening: f32| {
        with(LitParams {
            radius_m,
            flattening,
            ..LitParams::default()
        })
    };
    let light = |k1: f32, k2: f32, m: f32| {
        with(LitParams {
            k1,
            k2,
            m,
            ..LitParams::default()
        })
    };
    let fast = SkyParams {
        speed: 0.0,
        ..with(LitParams {
            formation_interval_s: 1.0,
            ..LitParams::default()
        })
    };
    let at = |params: SkyParams, time: f32| SkyParams { time, ..params };
    let mut climbed = case("climbed", dome(14_000.0, 0.3), 60.0, 50.0, 30.0);
    climbed.camera.position_m = Vec3::new(-5200.0, 900.0, 12_345.0);
    let six = [LayerKind::ALL, LayerKind::ALL].concat();
    vec![
        case(
            "stratocumulus",
            one(LayerKind::Stratocumulus),
            150.0,
            35.0,
            8.0,
        ),
        case("cumulus", one(LayerKind::Cumulus), 200.0, 35.0, 8.0),
        case("cirrus", one(LayerKind::Cirrus), 170.0, 35.0, 8.0),
        case("six_layers", at(of(&six), 0.35), 110.0, 30.0, 25.0),
        case("hemisphere", dome(2000.0, 1.0), 90.0, 20.0, 3.0),
        case("flat", dome(100_000.0, 0.02), 300.0, 15.0, 3.0),
        case("narrow", light(0.0, 1.0, 16.0), 180.0, 60.0, 0.0),
        case("wide", light(1.0, 1.0, 0.5), 180.0, 60.0, 0.0),
        case("none", light(0.0, 0.0, 0.5), 180.0, 60.0, 0.0),
        case("moonlit", at(day, 0.93), 140.0, 45.0, 40.0),
        case("moonrise", at(day, 0.8), 90.0, 12.0, 40.0),
        case("formed", fast, 10.0, 40.0, 1e6 + 0.37),
        climbed,
    ]
}

/// Skies of the other model, before the clouds of a method each.
fn perez_skies() -> Vec<Case> {
    let of = |shape: PerezShape, turbidity: f32, time: f32| SkyParams {
        sky: SkyModel::Perez,
        perez: PerezParams { shape, turbidity },
        time,
        cover: 0.3,
        ..SkyParams::default()
    };
    let preetham = |turbidity: f32, time: f32| of(PerezShape::Preetham, turbidity, time);
    let cie = |number: u8, time: f32| of(PerezShape::Cie(number), 2.5, time);
    let custom = PerezShape::Custom([2.0, -0.3, 20.0, -4.0, 1.0]);
    let with = |method: Method, params: SkyParams| SkyParams { method, ..params };
    let mut shut = preetham(2.5, 0.4);
    shut.cover = 1.0;
    vec![
        case("perez_noon", preetham(2.5, 0.5), 180.0, 40.0, 12.0),
        case("perez_clear", preetham(1.7, 0.4), 300.0, 30.0, 1.0),
        case(
            "perez_haze",
            with(Method::Fbm, preetham(8.0, 0.7)),
            250.0,
            15.0,
            3.0,
        ),
        case("perez_sunset", preetham(3.0, 0.749), 270.0, 12.0, 5.0),
        case(
            "perez_twilight",
            with(Method::Octaves, preetham(2.5, 0.757)),
            270.0,
            15.0,
            5.0,
        ),
        case("perez_night", preetham(2.5, 0.0), 180.0, 45.0, 21.5),
        case("perez_overcast", cie(1, 0.4), 20.0, 60.0, 0.0),
        case("perez_blue", cie(12, 0.3), 90.0, 20.0, 0.0),
        case("perez_turbid", cie(15, 0.6), 200.0, -10.0, 0.0),
        case("perez_custom", of(custom, 5.0, 0.55), 0.0, 90.0, 0.0),
        case("perez_shut", shut, 140.0, 10.0, 0.0),
    ]
}

/// Skies that every method draws, and those of every model of the clear sky.
pub fn common_skies() -> Vec<Case> {
    let shared = Method::DOMES.into_iter().flat_map(shared_skies);
    shared.chain(perez_skies()).collect()
}

/// A day, a sunset and a night with each of the other curves, brighter and darker.
pub fn toned_skies() -> Vec<Case> {
    let others = Tonemap::ALL
        .into_iter()
        .filter(|tonemap| *tonemap != Tonemap::default());
    let three = |tonemap: Tonemap| {
        let of = |name: &str, time: f32, exposure_ev: f32, azimuth: f32| {
            let params = SkyParams {
                time,
                tonemap,
                exposure_ev,
                ..SkyParams::default()
            };
            let name = format!("{}_{name}", tonemap.name());
            case(&name, params, azimuth, 35.0, 12.0)
        };
        [
            of("noon", 0.5, 0.5, 180.0),
            of("sunset", 0.745, -1.0, 270.0),
            of("night", 0.0, 2.0, 100.0),
        ]
    };
    others.flat_map(three).collect()
}

/// Those, and what each method has of its own.
pub fn skies() -> Vec<Case> {
    let own = [packed_skies(), octave_skies(), fbm_skies(), lit_skies()];
    common_skies()
        .into_iter()
        .chain(own.into_iter().flatten())
        .collect()
}
