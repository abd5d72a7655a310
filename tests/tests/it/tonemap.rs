//! Tone curves: their closed forms, what is true of every curve, and the hue of a clear sky, which must not turn violet.

use glam::{DMat3, DVec2, DVec3, Vec3};
use welkin_runtime::SkyParams;
use welkin_runtime::internals::tonemap::{agx, displayed, filmic, neutral, srgb_encoded};
use welkin_runtime::params::{EXPOSURE_EV, MAX_EXPOSURE, Tonemap};

/// The brightest that a half float holds.
const HALF_MAX: f32 = 65_504.0;

fn grey(radiance: f32, tonemap: Tonemap) -> Vec3 {
    displayed(Vec3::splat(radiance), tonemap)
}

#[test]
fn greys_rise_from_black_to_white_and_stay_grey() {
    for tonemap in Tonemap::ALL {
        // Sixteenths of a stop, from the least that a half float holds to its greatest with the greatest exposure.
        let stops = (-24 * 16..=40 * 16).map(|i| i as f32 / 16.0);
        let shown: Vec<Vec3> = stops.map(|stops| grey(stops.exp2(), tonemap)).collect();
        for (i, colour) in shown.iter().enumerate() {
            assert!(colour.x == colour.y && colour.y == colour.z, "{colour}");
            assert!(i == 0 || colour.x >= shown[i - 1].x, "{tonemap:?} {i}");
        }
        assert!(grey(0.0, tonemap).x < 1e-9);
        // White to the rounding of a byte.
        assert!(srgb_encoded(shown[shown.len() - 1]).x > 1.0 - 0.5 / 255.0);
    }
}

/// Half a stop is a notch of a camera's dial; the look with more contrast takes a little more.
#[test]
fn middle_grey_is_about_where_it_was() {
    for tonemap in Tonemap::ALL {
        let stops = (grey(0.18, tonemap).x / 0.18).log2();
        let most = match tonemap {
            Tonemap::AgxPunchy => 0.55,
            _ => 0.5,
        };
        assert!(stops.abs() < most, "{tonemap:?} {stops}");
    }
}

#[test]
fn whatever_comes_in_a_display_can_show_what_comes_out() {
    let most = HALF_MAX * MAX_EXPOSURE * EXPOSURE_EV[1].exp2();
    let values = [
        -HALF_MAX, -1.0, -1e-3, 0.0, 6e-8, 1e-3, 0.08, 0.18, 0.76, 1.0, 10.0, HALF_MAX, most,
    ];
    for tonemap in Tonemap::ALL {
        for r in values {
            for g in values {
                for b in values {
                    let shown = displayed(Vec3::new(r, g, b), tonemap);
                    let is_shown = |c: f32| (0.0..=1.0).contains(&c);
                    let all = shown.to_array().into_iter().all(is_shown);
                    assert!(all, "{tonemap:?} {r} {g} {b}: {shown}");
                }
            }
        }
    }
}

#[test]
fn exposure_is_a_factor_and_stops_on_top() {
    let params = SkyParams {
        exposure: 3.0,
        exposure_ev: -2.0,
        ..SkyParams::default()
    };
    assert_eq!(params.exposure_factor(), 0.75);
    let defaults = SkyParams::default();
    assert_eq!(defaults.exposure_factor(), defaults.exposure);
}

#[test]
fn the_filmic_curve_keeps_its_promises() {
    let at = |x: f32| grey(x, Tonemap::Filmic).x;
    assert!((at(1e-4) / 1e-4 - 1.0).abs() < 1e-3, "slope 1 in the dark");
    let white = srgb_encoded(Vec3::splat(at(1.0))).x;
    assert!((0.92..0.95).contains(&white), "sunlit white is near white");
    let end = 1.0 / (1.0 - filmic::KNEE);
    assert!(at(end * 0.999) < 1.0 && at(end * 1.001) == 1.0);
    // Hable's form, with its six numbers: E is 0, C B and D F are 1.
    let [a, b, c, d, f] = [0.5, 0.244, 1.0 / 0.244, 2.0, 0.5];
    for x in [0.01_f32, 0.18, 0.5, 1.0, 1.3] {
        let hable = (x * (a * x + c * b)) / (x * (a * x + b) + d * f);
        assert!((at(x) - hable).abs() < 1e-6, "{x}");
    }
}

/// The specification's first note, without F90: up to 0.8 a colour comes out as it is.
#[test]
fn neutral_leaves_colours_below_its_start_alone() {
    let values = [0.0, 0.01, 0.08, 0.25, 0.5, 0.79, 0.8];
    for r in values {
        for g in values {
            for b in values {
                let colour = Vec3::new(r, g, b);
                assert_eq!(displayed(colour, Tonemap::Neutral), colour);
            }
        }
    }
}

/// By the published equations with an F90 of 0, with a pencil.
#[test]
fn neutral_compresses_as_specified() {
    // p 1, p_n 1 - 0.04 / 0.4: white stays white.
    let white = displayed(Vec3::ONE, Tonemap::Neutral);
    assert!((white - 0.9).abs().max_element() < 1e-5);
    // p 10, p_n 1 - 0.04 / 9.4 = 0.995745, g 1 / (0.15 * 9.004255 + 1) = 0.425416.
    let red = displayed(Vec3::new(10.0, 0.0, 0.0), Tonemap::Neutral);
    let wanted = Vec3::new(0.995_745, 0.572_139, 0.572_139);
    assert!((red - wanted).abs().max_element() < 1e-5, "{red}");
    assert_eq!(neutral::START, 0.8);
}

/// Columns of Wrensch's matrices.
const WRENSCH: [[[f64; 3]; 3]; 2] = [
    [
        [0.842479062253094, 0.0423282422610123, 0.0423756549057051],
        [0.0784335999999992, 0.878468636469772, 0.0784336],
        [0.0792237451477643, 0.0791661274605434, 0.879142973793104],
    ],
    [
        [1.19687900512017, -0.0528968517574562, -0.0529716355144438],
        [-0.0980208811401368, 1.15190312990417, -0.0980434501171241],
        [-0.0990297440797205, -0.0989611768448433, 1.15107367264116],
    ],
];

/// Sobotka's sigmoid: of slope 2 at its pivot, (20 / 33, 1 / 2), with a toe of power 3 and a shoulder of power 3.25, from (0, 0) to (1, 1).
fn sigmoid(x: f64) -> f64 {
    let pivot = 20.0 / 33.0;
    let (power, width) = if x < pivot {
        (3.0, pivot)
    } else {
        (3.25, 1.0 - pivot)
    };
    // So that the end is met, half up or down.
    let scale = ((2.0 * width / 0.5_f64).powf(power) - 1.0) / width.powf(power);
    let away = x - pivot;
    0.5 + 2.0 * away / (1.0 + scale * away.abs().powf(power)).powf(1.0 / power)
}

/// The polynomial strays by a byte at most, which undoing the inset makes one and a half; the printed matrices by half a byte.
#[test]
fn agx_is_sobotkas_with_the_matrices_of_wrensch() {
    let [inset, outset] = WRENSCH.map(|columns| DMat3::from_cols_array_2d(&columns));
    let published = |radiance: DVec3| {
        let stops = (inset * radiance).map(f64::log2);
        let x = (stops.clamp(DVec3::splat(-12.47393), DVec3::splat(4.026069)) + 12.47393) / 16.5;
        let shown = outset * x.map(sigmoid);
        shown.map(|x| x.clamp(0.0, 1.0).powf(2.2))
    };
    let values = [0.002, 0.05, 0.18, 0.5, 1.0, 3.0, 12.0];
    for r in values {
        for g in values {
            for b in values {
                let radiance = DVec3::new(r, g, b);
                let own = displayed(radiance.as_vec3(), Tonemap::Agx);
                let off = srgb_encoded(own) - srgb_encoded(published(radiance).as_vec3());
                assert!(off.abs().max_element() < 2.0 / 255.0, "{radiance} {off}");
            }
        }
    }
}

#[test]
fn the_polynomial_is_as_near_to_the_sigmoid_as_wrensch_says() {
    assert!(sigmoid(0.0).abs() < 1e-9 && (sigmoid(1.0) - 1.0).abs() < 1e-9);
    let steps = 10_000;
    let square = |i: i32| {
        let x = (f64::from(i) + 0.5) / f64::from(steps);
        (f64::from(agx::sigmoid(x as f32)) - sigmoid(x)).powi(2)
    };
    let mean = (0..steps).map(square).sum::<f64>() / f64::from(steps);
    // His 3.6705141e-6, to the 1 % that samples make.
    assert!((mean / 3.670_514_1e-6 - 1.0).abs() < 0.01, "{mean:e}");
}

#[test]
fn the_polynomials_are_the_powers() {
    for i in 0..=10_000 {
        let x = i as f32 / 10_000.0;
        let powered = agx::sigmoid(x).max(0.0).powf(agx::PUNCHY_POWER);
        let off = agx::contrast(x) - powered;
        assert!(off.abs() < 0.22 / 255.0, "{x}: {off}");
        let [own, exact] =
            [agx::powered(x), x.powf(agx::GAMMA)].map(|c| srgb_encoded(Vec3::splat(c)).x);
        assert!((own - exact).abs() < 0.15 / 255.0, "{x}: {own} {exact}");
    }
}

/// Linear BT.709 to CIE XYZ, rows: IEC 61966-2-1, 1999.
const XYZ_OF_RGB: [[f64; 3]; 3] = [
    [0.4124, 0.3576, 0.1805],
    [0.2126, 0.7152, 0.0722],
    [0.0193, 0.1192, 0.9505],
];

fn xyz_of_rgb() -> DMat3 {
    DMat3::from_cols_array_2d(&XYZ_OF_RGB).transpose()
}

/// CIE 1976 u', v'.
fn chromaticity(rgb: DVec3) -> DVec2 {
    let xyz = xyz_of_rgb() * rgb;
    DVec2::new(4.0 * xyz.x, 9.0 * xyz.y) / (xyz.x + 15.0 * xyz.y + 3.0 * xyz.z)
}

/// Of luminance 1.
fn colour_of(chromaticity: DVec2) -> DVec3 {
    let DVec2 { x: u, y: v } = chromaticity;
    let xyz = DVec3::new(9.0 * u, 4.0 * v, 12.0 - 3.0 * u - 20.0 * v) / (4.0 * v);
    xyz_of_rgb().inverse() * xyz
}

/// Clear skies by photographs, with the sun 28 degrees high: at 45, 30 and 4 degrees opposite it.
fn blues() -> [DVec3; 3] {
    [[0.170, 0.364], [0.172, 0.375], [0.177, 0.423]].map(|uv| colour_of(uv.into()))
}

/// A colour shown with the exposure that gives it this luminance on the display.
fn at_luminance(blue: DVec3, luminance: f64, curve: &dyn Fn(Vec3) -> Vec3) -> DVec3 {
    let show = |stops: f64| curve((blue * stops.exp2()).as_vec3()).as_dvec3();
    let (mut dark, mut bright) = (-16.0, 16.0);
    for _ in 0..60 {
        let middle = 0.5 * (dark + bright);
        let shown = (xyz_of_rgb() * show(middle)).y;
        *(if shown < luminance {
            &mut dark
        } else {
            &mut bright
        }) = middle;
    }
    show(bright)
}

const LUMINANCES: [f64; 6] = [0.2, 0.3, 0.4, 0.55, 0.7, 0.9];

/// A standard deviation of colour matching, as a distance in u', v': CIE TN 001:2014, "Chromaticity Difference Specification for Light Sources".
/// MacAdam's just noticeable difference is three of them.
const STEP: f64 = 0.0011;

/// How far a curve moves clear skies across the line of their own hue, in u', v': towards cyan is negative, towards violet positive.
fn across(curve: &dyn Fn(Vec3) -> Vec3) -> [f64; 2] {
    let white = chromaticity(DVec3::ONE);
    let (mut least, mut most) = (0.0_f64, 0.0_f64);
    for blue in blues() {
        let hue = (chromaticity(blue) - white).normalize();
        for luminance in LUMINANCES {
            let shown = chromaticity(at_luminance(blue, luminance, curve)) - white;
            let moved = hue.perp_dot(shown);
            (least, most) = (least.min(moved), most.max(moved));
        }
    }
    [least, most]
}

fn of(tonemap: Tonemap) -> impl Fn(Vec3) -> Vec3 {
    move |radiance| displayed(radiance, tonemap)
}

/// Constant hue is a straight line through white, so nothing is left but rounding.
#[test]
fn neutral_keeps_the_hue_of_a_clear_sky() {
    let [cyan, violet] = across(&of(Tonemap::Neutral));
    assert!(cyan > -0.1 * STEP && violet < 0.1 * STEP, "{cyan} {violet}");
}

#[test]
fn no_curve_turns_a_clear_sky_towards_violet() {
    for tonemap in Tonemap::ALL {
        let [cyan, violet] = across(&of(tonemap));
        println!("{tonemap:?}: {cyan:.5} {violet:.5}");
        assert!(violet < STEP, "{tonemap:?}: {violet}");
    }
}

/// Curves that bend each channel by itself turn bright blues towards cyan, by more than is noticed.
#[test]
fn clipped_and_filmic_skies_turn_towards_cyan() {
    for tonemap in [Tonemap::Filmic, Tonemap::None] {
        let [cyan, _] = across(&of(tonemap));
        assert!(cyan < -3.0 * STEP, "{tonemap:?}: {cyan}");
    }
}

/// The comparison can fail: more contrast for each channel is what makes a sky violet.
#[test]
fn a_curve_of_much_contrast_is_told() {
    let [_, violet] = across(&|radiance| radiance.max(Vec3::ZERO).powf(1.5).min(Vec3::ONE));
    assert!(violet > 3.0 * STEP, "{violet}");
}

/// B. Ottosson, "A perceptual color space for image processing", 2020: a and b of Oklab.
fn oklab(rgb: DVec3) -> DVec2 {
    let cones = DMat3::from_cols_array_2d(&[
        [0.412_221_470_8, 0.536_332_536_3, 0.051_445_992_9],
        [0.211_903_498_2, 0.680_699_545_1, 0.107_396_956_6],
        [0.088_302_461_9, 0.281_718_837_6, 0.629_978_700_5],
    ])
    .transpose()
        * rgb;
    let cones = cones.map(f64::cbrt);
    DVec2::new(
        cones.dot(DVec3::new(
            1.977_998_495_1,
            -2.428_592_205_0,
            0.450_593_709_9,
        )),
        cones.dot(DVec3::new(
            0.025_904_037_1,
            0.782_771_766_2,
            -0.808_675_766_0,
        )),
    )
}

/// The eye sees white in blue as a turn towards violet (W. Abney, 1909), which u', v' do not tell. 0.02 is a just noticeable difference:
/// CSS Color Module Level 4, section 13.2.
#[test]
fn no_curve_makes_a_clear_sky_look_violet() {
    const NOTICED: f64 = 0.02;
    for tonemap in Tonemap::ALL {
        for blue in blues() {
            let hue = oklab(blue).normalize();
            for luminance in LUMINANCES {
                let shown = oklab(at_luminance(blue, luminance, &of(tonemap)));
                let violet = hue.perp_dot(shown);
                assert!(violet < NOTICED, "{tonemap:?} {luminance}: {violet}");
            }
        }
    }
}
