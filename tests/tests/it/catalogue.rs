//! How many stars of a catalogue an eye sees, by the hour, the moon and the haze.

use welkin_runtime::almanac::Place;
use welkin_runtime::internals::geometry::camera;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, SkyParams};
use welkin_tests::{catalogue, pack};

/// A place in the middle of the north, under a sky without clouds.
fn at(date: &str) -> SkyParams {
    SkyParams {
        date: Some(date.parse().expect("a date")),
        place: Place {
            latitude_deg: 51.5,
            longitude_deg: 0.0,
        },
        cover: 0.0,
        ..SkyParams::default()
    }
}

/// Stars above the horizon that are drawn, wherever one looks: those of a view to the zenith, as wide as views go.
fn count(params: &SkyParams) -> usize {
    let facts = PackData::new(pack::catalogued()).expect("the pack has every role");
    let view = Camera::looking(0.0, std::f32::consts::FRAC_PI_2, 3.1, [1024, 1024]);
    let lit = facts.lit_sky(params, 0.0);
    let Some(night) = facts.night_sky(&lit, params, &view, 0.0) else {
        return 0;
    };
    let all = facts.catalogue.as_ref().expect("there is a catalogue");
    all.spots(&night, &camera::uniforms(&view)).count()
}

#[test]
fn a_dark_night_shows_thousands_a_full_moon_hundreds_and_dusk_a_few() {
    // Without a moon, in the new moon's night; every hemisphere has some 2,500 of 5,044 stars, and the air takes those near the horizon.
    let dark = count(&at("2026-01-18T23:00:00Z"));
    assert!((1500..2500).contains(&dark), "{dark}");
    // The moon of 3 January, full, stands high in the south at midnight. To magnitude 4.3 there are some 700 stars on the whole sphere.
    let moonlit = count(&at("2026-01-03T00:30:00Z"));
    assert!((100..450).contains(&moonlit), "{moonlit}");
    // The sun 7 degrees down.
    let dusk = count(&at("2026-01-18T17:05:00Z"));
    assert!((1..40).contains(&dusk), "{dusk}");
    let hazy = SkyParams {
        haze: 1.0,
        ..at("2026-01-18T23:00:00Z")
    };
    let hazy = count(&hazy);
    assert!(hazy < dark - dark / 10, "{hazy} of {dark}");
    assert_eq!(count(&at("2026-01-18T12:00:00Z")), 0, "by day");
    let off = SkyParams {
        stars: false,
        ..at("2026-01-18T23:00:00Z")
    };
    assert_eq!(count(&off), 0);
}

#[test]
fn a_dark_night_dims_no_star_of_the_catalogue_that_stands_high() {
    let params = at("2026-01-18T23:00:00Z");
    let facts = PackData::new(pack::catalogued()).expect("the pack has every role");
    let view = Camera::looking(0.0, 1.0, 1.0, [64, 64]);
    let night = facts
        .night_sky(&facts.lit_sky(&params, 0.0), &params, &view, 0.0)
        .expect("it is night");
    let high = pack::catalogue_records(pack::catalogued());
    let high: Vec<_> = high
        .iter()
        .filter(|star| catalogue::seen(star, &night).y > 0.5)
        .collect();
    assert!(high.len() > 1000);
    for star in high {
        let sine = catalogue::seen(star, &night).y as f32;
        let magnitude = star.magnitude as f32 + night.air.magnitudes(sine);
        let share = welkin_runtime::internals::clear_sky::eye::share(night.faintest, magnitude);
        assert!(share > 0.97, "{star:?}: {share}");
    }
}
