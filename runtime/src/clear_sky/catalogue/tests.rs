use super::*;
use crate::geometry::camera::{self, Camera};
use welkin_pack::{Format, Shape};

fn record(magnitude: f64, colour_index: f64, variance: u8) -> CatalogueStar {
    CatalogueStar {
        right_ascension_deg: 90.0,
        declination_deg: 30.0,
        magnitude,
        colour_index,
        rate: 64,
        variance,
        phase: 64,
    }
}

fn texture(records: &[CatalogueStar]) -> Texture {
    let mut level = vec![0; 3 * 4 * 64];
    for (i, record) in records.iter().enumerate() {
        for (layer, bytes) in record.encode().into_iter().enumerate() {
            level[4 * (64 * layer + i)..][..4].copy_from_slice(&bytes);
        }
    }
    Texture {
        format: Format::Rgba8Unorm,
        shape: Shape::Array,
        width: 8,
        height: 8,
        layers: 3,
        levels: vec![level],
    }
}

/// A night in which everything is seen, over the pole of the stars.
fn night() -> NightSky {
    NightSky {
        turn: Mat3::from_cols(Vec3::X, Vec3::NEG_Z, Vec3::Y),
        one: 20.0,
        faintest: 20.0,
        air: Air::new(0.04),
        screen: Screen::of([1e-3; 2], 1.0),
        seconds: 0.0,
    }
}

#[test]
fn colours_go_from_blue_to_red_and_the_sun_is_white() {
    // The sun above the air is a little bluer than its light at 60 degrees, which is white.
    let sun = colour(0.65);
    assert!(sun.max_element() / sun.min_element() < 1.25, "{sun}");
    let mut last = f32::INFINITY;
    for step in -4..=20 {
        let colour = colour(0.1 * f64::from(step));
        assert!((luminance(colour) - 1.0).abs() < 1e-5);
        let blueness = colour.z / colour.x;
        assert!(blueness < last, "{step}: {colour}");
        last = blueness;
    }
    // Rigel is bluish, Betelgeuse orange: ratios of a tenth are seen side by side.
    let [rigel, betelgeuse] = [-0.03, 1.85].map(colour);
    assert!(rigel.z > 1.1 * rigel.x, "{rigel}");
    assert!(betelgeuse.x > 1.5 * betelgeuse.z, "{betelgeuse}");
}

#[test]
fn the_air_takes_what_it_takes_of_the_sun() {
    let air = Air::new(0.04);
    // Molecules, ozone and clear aerosol: 0.15 to 0.2 magnitudes at sea level (A. W. J. Cousins, 1976, and what every observatory measures).
    assert!(
        (0.12..0.2).contains(&air.magnitudes(1.0)),
        "{}",
        air.magnitudes(1.0)
    );
    for degrees in [2.0_f32, 5.0, 11.0, 27.0, 61.0] {
        let sine = degrees.to_radians().sin();
        let colour = Colour::daylight();
        let of = |spectrum: &Spectrum| Vec3::from(colour.rgb(spectrum));
        let exact = of(&sun_transmittance(degrees.to_radians(), 0.04)) / of(&[1.0; 8]);
        // Of a low star no blue is left, so that it has no error of its own.
        let off = (air.transmittance(sine) - exact).abs().max_element() / luminance(exact);
        assert!(off < 0.01, "{degrees}: {off}");
    }
    assert!(Air::new(0.24).magnitudes(0.5) > air.magnitudes(0.5) + 0.3);
}

#[test]
fn a_record_becomes_a_star_where_it_stands() {
    let catalogue = Catalogue::new(&texture(&[record(1.0, 0.65, 0), record(2.5, 0.65, 0)]));
    let [bright, faint] = catalogue.stars[..] else {
        panic!("{catalogue:?}");
    };
    // Right ascension 90 degrees is y; half a step of a place is 0.003 degrees.
    let wanted = Vec3::new(0.0, 30.0_f32.to_radians().cos(), 0.5);
    assert!(bright.direction.angle_between(wanted).to_degrees() < 0.003);
    let ratio = luminance(bright.light) / luminance(faint.light);
    assert!((ratio / 10.0_f32.powf(0.6) - 1.0).abs() < 1e-3);
    assert!((luminance(bright.light) / 10.0_f32.powf(-0.4) - 1.0).abs() < 1e-3);
}

#[test]
fn what_an_eye_does_not_see_is_not_drawn_and_no_star_is_lost_before() {
    let records: Vec<_> = (0..40)
        .map(|i| record(f64::from(i) * 0.25 - 1.0, 0.5, 0))
        .collect();
    let catalogue = Catalogue::new(&texture(&records));
    let view = camera::uniforms(&Camera::looking(0.0, 0.5, 1.0, [640, 360]));
    // The turn puts right ascension 90 degrees to the north, as high as its declination.
    for faintest in [0.0, 3.3, 6.4] {
        let night = NightSky {
            faintest,
            ..night()
        };
        let shown: Vec<Spot> = catalogue.spots(&night, &view).collect();
        let dimmed = night.air.magnitudes(0.5);
        let seen = |m: f32| m + dimmed < eye::end(faintest) - 1e-3;
        let wanted = catalogue.stars.iter().filter(|star| seen(star.magnitude));
        assert_eq!(shown.len(), wanted.count(), "{faintest}");
        for (spot, star) in shown.iter().zip(&catalogue.stars) {
            let whole = luminance(star.light * night.air.transmittance(0.5)) * night.one;
            let share = eye::share(faintest, star.magnitude + dimmed);
            // The air lifts the star, by a little less than 2 minutes of arc.
            assert!((luminance(spot.light) - whole * share).abs() < 0.01 * whole);
        }
    }
}

#[test]
fn stars_flicker_more_the_lower_they_are_and_by_their_own_rate() {
    // A phase of a quarter turn begins at the most; 64 64ths of a hertz are a second.
    let at = |sine: f32, seconds: f64| flickering([64, 26, 64], sine, seconds);
    let zenith = at(1.0, 0.0) - 1.0;
    assert!((zenith - 26.0 / 255.0).abs() < 1e-3);
    assert!(
        (at(1.0, 0.5) - 1.0 + zenith).abs() < 1e-3 && (at(1.0, 1e6) - at(1.0, 0.0)).abs() < 1e-3
    );
    let low = at(0.2, 0.0) - 1.0;
    assert!(
        (low / zenith - 4.8_f32.powf(11.0 / 12.0)).abs() < 0.2,
        "{}",
        low / zenith
    );
    assert!(at(0.0, 0.5) > 0.19, "none goes out");
}

#[test]
fn the_plain_time_has_the_sky_of_the_pack_s_own_sun() {
    for noon in [0.3_f32, 1.047, 1.5] {
        for step in 0..24 {
            let time = step as f32 / 24.0;
            let sun = (turn_of_time(time, noon) * glam::DVec3::X).as_vec3();
            let own = Vec3::from(welkin_pack::mapping::sun_direction(time, noon));
            assert!(sun.distance(own) < 1e-5, "{time}: {sun} {own}");
        }
    }
}
