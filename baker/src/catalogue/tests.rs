use std::fmt::Write;

use super::*;

const REAL: &[u8] = include_bytes!(concat!(env!("WELKIN_ASSETS"), "/stars/stars.6.json"));

fn told(text: &str) -> String {
    read("s.cat", text.as_bytes()).unwrap_err().to_string()
}

fn stars(text: &str) -> Vec<Star> {
    read("s.cat", text.as_bytes()).unwrap_or_else(|e| panic!("{e}"))
}

/// A line of the Bright Star Catalogue: number, place, magnitude and B-V in their bytes.
fn bsc(number: &str, place: &str, magnitude: &str, index: &str) -> String {
    let mut line = format!("{number:>4}{:71}{place}", "");
    let _ = write!(line, "{:12}{magnitude:>5}{:2}{index:>5}", "", "");
    line
}

#[test]
fn the_catalogue_of_the_project_has_the_stars_that_it_says() {
    let stars = read("stars.6.json", REAL).unwrap();
    assert_eq!(stars.len(), 5044);
    assert_eq!(stars.iter().filter(|s| s.colour_index.is_none()).count(), 2);
    assert!(stars.iter().all(|s| s.magnitude <= 6.0));
    // The brightest is Sirius, where the almanac has it.
    let brightest = stars
        .iter()
        .min_by(|a, b| a.magnitude.total_cmp(&b.magnitude));
    let sirius = brightest.unwrap();
    assert!((sirius.right_ascension_deg - 101.2872).abs() < 1e-9);
    assert!((sirius.declination_deg + 16.7161).abs() < 1e-9);
    assert_eq!(
        (sirius.magnitude, sirius.colour_index),
        (-1.44, Some(0.009))
    );
    // West of Greenwich is told as negative there: Vega at 279 degrees.
    let vega = stars
        .iter()
        .find(|s| (s.right_ascension_deg - 279.2347).abs() < 1e-6);
    assert_eq!(vega.unwrap().magnitude, 0.03);
}

#[test]
fn every_layout_has_the_same_star() {
    let hyg = "id,hip,proper,ra,dec,dist,mag,absmag,spect,ci\n0,,Sol,0,0,0,-26.7,4.85,G2V,0.656\n91262,91262,\"Vega, alpha\",18.61564,38.78369,7.67,0.03,0.6,A0V,-0.001\n";
    let own = "name;dec_deg;ra_deg;bv;mag\nVega;38.78369;279.2346;-0.001;0.03\n";
    let tabs = "# of mine\nRA_hours\tDec_deg\tVmag\tB-V\n18.61564\t38.78369\t0.03\t-0.001\n\n";
    let json = r#"{"type":"FeatureCollection","features":[{"id":91262,"properties":{"mag":0.03,"bv":"-0.001"},"geometry":{"type":"Point","coordinates":[-80.7654,38.78369]}}]}"#;
    let bright = format!(
        "{}\n{}\n",
        bsc("  92", "               ", "", ""),
        bsc("7001", "183656.3+384701", " 0.03", "-0.00")
    );
    for (name, text) in [
        ("hyg", hyg),
        ("own", own),
        ("tabs", tabs),
        ("json", json),
        ("bsc", &bright),
    ] {
        let found = stars(text);
        assert_eq!(found.len(), 1, "{name}: neither the sun nor a nova");
        let vega = found[0];
        // The coarsest tells tenths of a second of time: 1.5 seconds of arc.
        assert!(
            (vega.right_ascension_deg - 279.2346).abs() < 5e-4,
            "{name}: {vega:?}"
        );
        assert!(
            (vega.declination_deg - 38.78369).abs() < 5e-4,
            "{name}: {vega:?}"
        );
        assert!((vega.magnitude - 0.03).abs() < 1e-9, "{name}");
        assert!(vega.colour_index.unwrap().abs() < 0.0011, "{name}");
    }
    let marked = format!("\u{feff}{own}");
    assert_eq!(stars(&marked), stars(own));
}

#[test]
fn a_star_without_a_colour_is_one() {
    let found = stars("ra_deg,dec_deg,mag,bv\n10,20,3,\n");
    assert_eq!(found[0].colour_index, None);
    assert_eq!(stars("ra_deg,dec_deg,mag\n10,20,3\n"), found);
    assert_eq!(
        found[0].temperature_k(),
        stars("ra_deg,dec_deg,mag,bv\n10,20,3,0.65\n")[0].temperature_k()
    );
}

#[test]
fn what_is_wrong_is_told_with_file_place_column_found_and_expected() {
    for (text, wanted) in [
        (
            "ra_deg,dec_deg,mag\n10,95,3\n",
            "s.cat: line 2, column declination: found \"95\", expected a number from -90 to 90",
        ),
        (
            "ra_hours,dec_deg,mag\n1,2,3\n25,5,3\n",
            "s.cat: line 3, column right ascension: found \"25\", expected a number from -24 to 24",
        ),
        (
            "ra_deg,dec_deg,mag\n10,5\n",
            "s.cat: line 2, column magnitude: found nothing, expected a number from -30 to 35",
        ),
        (
            "ra_deg,dec_deg,mag\n10,5,NaN\n",
            "s.cat: line 2, column magnitude: found \"NaN\", expected a number from -30 to 35",
        ),
        (
            "ra_deg,dec_deg,mag,bv\n10,5,3,blue\n",
            "s.cat: line 2, column B-V: found \"blue\", expected a number from -1 to 10",
        ),
        (
            "dec_deg,mag\n5,3\n",
            "s.cat: column right ascension is missing; found dec_deg, mag, expected ra_deg or ra_hours, or ra, dec, mag and ci as HYG has them",
        ),
        // Hours or degrees? A right ascension without a unit is HYG's alone.
        (
            "ra,dec_deg,mag\n10,5,3\n",
            "s.cat: column right ascension is missing; found ra, dec_deg, mag, expected ra_deg or ra_hours, or ra, dec, mag and ci as HYG has them",
        ),
        (
            "ra_deg,mag\n5,3\n",
            "s.cat: column declination is missing; found ra_deg, mag, expected dec_deg",
        ),
        (
            "ra_deg,dec_deg\n5,3\n",
            "s.cat: column magnitude is missing; found ra_deg, dec_deg, expected mag, vmag or magnitude",
        ),
        ("", "s.cat: found 0 stars, expected 1 to 1000000"),
        (
            "ra_deg,dec_deg,mag\n",
            "s.cat: found 0 stars, expected 1 to 1000000",
        ),
        (
            r#"{"features":[]}"#,
            "s.cat: found 0 stars, expected 1 to 1000000",
        ),
        (
            r#"{"features":[{"properties":{"mag":1},"geometry":{"coordinates":[1]}}]}"#,
            "s.cat: feature 1, column coordinates[1]: found nothing, expected a number from -90 to 90",
        ),
        (
            r#"{"features":[{"properties":{"mag":"one"},"geometry":{"coordinates":[1,2]}}]}"#,
            "s.cat: feature 1, column mag: found \"one\", expected a number from -30 to 35",
        ),
        (
            r#"{"features":[{"properties":{"mag":1,"bv":[1]},"geometry":{"coordinates":[1,2]}}]}"#,
            "s.cat: feature 1, column bv: found \"[1]\", expected a number from -1 to 10",
        ),
    ] {
        assert_eq!(told(text), wanted);
    }
    let layout = "expected a catalogue of stars: GeoJSON with points, a table with a line of column names, or the Bright Star Catalogue";
    for text in ["stars!", "{\"features\":", "{}", "{\"features\":{}}"] {
        let error = told(text);
        assert!(
            error.starts_with("s.cat: found ") && error.ends_with(layout),
            "{error}"
        );
    }
    assert!(
        read("s.cat", b"ra_deg,\xff")
            .unwrap_err()
            .to_string()
            .contains("no UTF-8 at 7")
    );
}

#[test]
fn lines_of_the_bright_star_catalogue_are_told_by_their_bytes() {
    for (place, magnitude, wanted) in [
        (
            "2x3656.3+384701",
            " 0.03",
            "column RAh, bytes 76-77: found \"2x\", expected a number from 0 to 23",
        ),
        (
            "183656.3 384701",
            " 0.03",
            "column DE-, byte 84: found \" \", expected + or -",
        ),
        (
            "183656.3+914701",
            " 0.03",
            "column DEd, bytes 85-86: found \"91\", expected a number from 0 to 90",
        ),
        (
            "183656.3+384701",
            "",
            "column Vmag, bytes 103-107: found nothing, expected a number from -30 to 35",
        ),
    ] {
        let error = told(&bsc("7001", place, magnitude, "-0.00"));
        assert_eq!(error, format!("s.cat: line 1, {wanted}"));
    }
    // A letter of several bytes across a column is no reason to stop.
    let odd = bsc("7001", "183656.3+38470\u{e9}", " 0.03", "-0.00");
    assert!(told(&odd).contains("column DEs"));
}

#[test]
fn light_is_pogson_s_and_temperature_that_of_known_stars() {
    let star = |magnitude: f64, index: f64| Star {
        right_ascension_deg: 0.0,
        declination_deg: 0.0,
        magnitude,
        colour_index: Some(index),
    };
    // Five magnitudes are a hundred times, over all that the eye sees.
    assert!((star(-1.0, 0.0).light() / star(4.0, 0.0).light() - 100.0).abs() < 1e-9);
    // The sun 5772 K (IAU 2015), Vega 9600, Arcturus 4290, Betelgeuse 3600, Rigel 12100: measured ones, which a black body's colour meets within a sixth.
    for (index, kelvin) in [
        (0.653, 5772.0),
        (0.0, 9600.0),
        (1.23, 4290.0),
        (1.85, 3600.0),
        (-0.03, 12_100.0),
    ] {
        let found = star(0.0, index).temperature_k();
        assert!((found / kelvin - 1.0_f64).abs() < 0.17, "{index}: {found}");
    }
    for index in [-1.0, -0.5, 10.0] {
        assert!((2000.0..=30_000.0).contains(&star(0.0, index).temperature_k()));
    }
}
