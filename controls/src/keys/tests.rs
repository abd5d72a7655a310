use proptest::prelude::*;
use welkin_runtime::params::Slot;

use super::*;

/// A text that a key takes, by two numbers from 0 to 1.
fn a_text(key: &Key, a: f64, b: f64) -> String {
    let between = |[low, high]: [f64; 2], share: f64| (low + (high - low) * share) as f32;
    match key.input {
        Input::Slider {
            whole: true, high, ..
        } => between([1.0, high], a).round().to_string(),
        // Below its least, a ring is none.
        Input::Slider { high, .. } if key.name == "ring" => {
            let radius_m = between([4_000.0, high], a);
            if b < 0.3 {
                "0".to_string()
            } else {
                radius_m.to_string()
            }
        }
        Input::Slider { low, high, .. } => between([low, high], a).to_string(),
        Input::Switch => (a < 0.5).to_string(),
        Input::Choice { choices, .. } => {
            choices[(a * choices.len() as f64) as usize % choices.len()].to_string()
        }
        Input::Numbers { optional: true, .. } if b < 0.5 => "none".to_string(),
        Input::Numbers { ranges, .. } => {
            let numbers = ranges.iter().zip([a, b, a, b, a]);
            let texts = numbers.map(|(range, share)| between(*range, share).to_string());
            texts.collect::<Vec<_>>().join(",")
        }
        Input::Colour => format!("{},{},0.5", a as f32, b as f32),
        Input::Layers => format!(
            "cumulus:{}:1,cirrus:{}:{}",
            (0.1 + a * 0.9) as f32,
            (0.1 + b * 0.9) as f32,
            (1.5 + a) as f32
        ),
        Input::Text { .. } if b < 0.5 => "none".to_string(),
        Input::Text { .. } if key.name == "date" => format!(
            "{}-0{}-{}T{}:30:00Z",
            1900 + (a * 200.0) as u32 % 200,
            1 + (a * 1e3) as u32 % 9,
            10 + (b * 1e3) as u32 % 19,
            10 + (b * 1e5) as u32 % 14
        ),
        Input::Text { .. } => format!("{},-2,{},0.5", (a * 8.0) as f32, b * 1e3),
    }
}

/// Settings that all differ from the usual ones, by numbers from 0 to 1.
fn a_sky() -> impl Strategy<Value = Settings> {
    proptest::collection::vec((0.0..1.0_f64, 0.0..1.0_f64), KEYS.len()).prop_map(|shares| {
        let texts: Vec<_> = KEYS
            .iter()
            .zip(shares)
            .map(|(key, (a, b))| (key.name, a_text(key, a, b)))
            .collect();
        Settings::from_pairs(texts.iter().map(|(name, text)| (*name, text.as_str())))
            .expect("every text is of its range")
    })
}

proptest! {
    #[test]
    fn settings_come_back_from_a_link(settings in a_sky()) {
        let changes = settings.changes();
        let pairs = changes.iter().rev().map(|(name, text)| (*name, text.as_str()));
        let back = Settings::from_pairs(pairs).expect("own text is read");
        prop_assert_eq!(back.changes(), changes);
        // A place of lightning is told to the metre; all else comes back exactly.
        let mut exact = back;
        exact.params.weather.lightning = settings.params.weather.lightning;
        prop_assert_eq!(exact, settings);
    }

    #[test]
    #[cfg(feature = "toml")]
    fn settings_come_back_from_toml(settings in a_sky()) {
        let back = Settings::from_toml(&settings.to_toml()).expect("own text is read");
        prop_assert_eq!(back.changes(), settings.changes());
    }

    #[test]
    fn what_a_key_takes_the_sky_takes(settings in a_sky()) {
        prop_assert_eq!(settings.params.check(), Ok(()));
    }
}

#[test]
fn names_are_unlike_each_other() {
    for (index, key) in KEYS.iter().enumerate() {
        assert!(KEYS[..index].iter().all(|other| other.name != key.name));
        assert_eq!(super::key(key.name).unwrap().label, key.label);
    }
}

#[test]
fn the_papers_six_come_first_with_its_names() {
    let names = ["Cover", "Height", "Density", "Sunset", "Speed", "Time"];
    assert_eq!([0, 1, 2, 3, 4, 5].map(|i| KEYS[i].label), names);
}

#[test]
fn sliders_end_where_the_sky_ends() {
    for setting in SETTINGS {
        let (key, Input::Slider { low, high, .. }) = (Key::Sky(setting), setting.words.input)
        else {
            continue;
        };
        for (end, beyond) in [(low, low - 1.0), (high, high * 1.001 + 0.1)] {
            let mut settings = Settings::default();
            key.set(&mut settings, &(end as f32).to_string()).unwrap();
            assert_eq!(settings.params.check(), Ok(()));
            let params = &mut settings.params;
            match &setting.slot {
                Slot::Count { place, .. } => *place(params) = beyond.ceil() as u32,
                _ => *(setting.numbers()[0].place)(params) = beyond as f32,
            }
            assert!(params.check().is_err(), "{}: {beyond}", key.name);
            assert!(key.set(&mut settings, &beyond.to_string()).is_err());
        }
    }
}

#[test]
fn no_text_is_taken_that_means_nothing() {
    for key in KEYS {
        for text in ["", "what", "nan", "1e99", "-"] {
            let mut settings = Settings::default();
            let error = key.set(&mut settings, text).unwrap_err();
            assert!(error.to_string().contains("expected"), "{error}");
            assert_eq!(settings, Settings::default());
        }
    }
}

#[test]
fn a_palette_does_not_undo_the_colours_that_come_with_it() {
    let pairs = [("lit", "0.1,0.2,0.3"), ("palette", "stormy")];
    let settings = Settings::from_pairs(pairs).unwrap();
    assert_eq!(settings.params.fbm.lit, [0.1, 0.2, 0.3]);
    assert_eq!(
        settings.params.fbm.shaded,
        welkin_runtime::params::FbmParams::STORMY.shaded
    );
}
