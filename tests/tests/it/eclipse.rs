//! Daylight in the eclipse of 8 April 2024, from Dallas: total from 18:40:43 to 18:44:35 UTC, partial from 17:23 to 20:03 (F. Espenak, NASA/TP-2008-214170).

use welkin_runtime::SkyParams;
use welkin_runtime::almanac::Place;
use welkin_runtime::internals::clear_sky::light::Light;
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::internals::pack_data::PackData;
use welkin_tests::pack;

/// The light at a time of that day.
fn at(facts: &PackData, time: &str) -> Light {
    let params = SkyParams {
        date: format!("2024-04-08T{time}Z").parse().ok(),
        place: Place {
            latitude_deg: 32.78,
            longitude_deg: -96.8,
        },
        cover: 0.0,
        ..SkyParams::default()
    };
    assert!(params.date.is_some(), "{time}");
    facts.lit_sky(&params, 0.0).light
}

/// Luminance of the clear sky, as a meter has it.
fn sky_cd_m2(light: &Light) -> f32 {
    luminance(light.skylight) * light.unit_cd_m2
}

#[test]
fn it_begins_and_ends_when_it_did() {
    let facts = PackData::new(pack::default_pack()).expect("the pack has every role");
    for time in ["17:20:00", "20:06:00", "12:00:00"] {
        assert_eq!(at(&facts, time).eclipsed, 0.0, "{time}");
    }
    for time in ["17:27:00", "18:39:30", "18:46:00", "19:58:00"] {
        let eclipsed = at(&facts, time).eclipsed;
        assert!(eclipsed > 0.0 && eclipsed < 1.0, "{time}: {eclipsed}");
    }
    for time in ["18:41:30", "18:43:50"] {
        assert_eq!(at(&facts, time).eclipsed, 1.0, "{time}");
    }
}

#[test]
fn totality_is_as_dark_as_dusk() {
    let facts = PackData::new(pack::default_pack()).expect("the pack has every role");
    let [day, total] = ["17:10:00", "18:42:30"].map(|time| at(&facts, time));
    // Silverman and Mullen 1975: the sky of totality has a thousandth to a hundred thousandth of its light.
    let ratio = sky_cd_m2(&total) / sky_cd_m2(&day);
    assert!((1e-5..1e-3).contains(&ratio), "{ratio}");
    assert_eq!(luminance(total.ground_sunlight), 0.0);
    assert_eq!(luminance(total.sunlight), 0.0);
    // What is shown is darker too, and the brightest stars are out.
    assert!(luminance(total.skylight) < 0.3 * luminance(day.skylight));
    assert!(total.night > 0.0 && total.night < 0.1);
}

#[test]
fn half_a_sun_gives_half_of_the_light_and_what_is_shown_never_leaps() {
    let facts = PackData::new(pack::default_pack()).expect("the pack has every role");
    let day = at(&facts, "17:10:00");
    let mut last = at(&facts, "18:35:00");
    for second in 1..=420 {
        let time = format!("18:{:02}:{:02}", 35 + second / 60, second % 60);
        let now = at(&facts, &time);
        let [before, after] = [&last, &now].map(|light| luminance(light.skylight));
        // A hundredth of the day's light a second is a change that one sees go on.
        assert!(
            (after - before).abs() < 0.01 * luminance(day.skylight),
            "{time}"
        );
        if now.eclipsed < 0.99 {
            // The sun moves by half a degree in two minutes, and the air with it.
            let of = |light: &Light| luminance(light.ground_sunlight) * light.unit_cd_m2;
            let left = of(&now) / of(&day);
            assert!(
                (left / (1.0 - now.eclipsed) - 1.0).abs() < 0.1,
                "{time}: {left}"
            );
        }
        last = now;
    }
}
