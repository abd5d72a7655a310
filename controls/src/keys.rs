//! Every setting: one table.

mod make;

use welkin_runtime::Method;
use welkin_runtime::params::SkyModel;
use welkin_runtime::params::{CUSTOM, TURBIDITY};
use welkin_runtime::params::{FORMATION_INTERVAL_S, MAX_OCTAVES};

use crate::key::{Group, Input, Key, Slot};
use crate::lightning::LIGHTNING_FORM;
use crate::settings::{SettingError, Settings};
use crate::text;
use make::{count, number, place, switch, text, unit};

const OCTAVES: &[Method] = &[Method::Octaves];
const FBM: &[Method] = &[Method::Fbm];
const LIT: &[Method] = &[Method::Lit];
const SPRITES: &[Method] = &[Method::Sprites];

/// The six of Roden and Parberry, by their names, then what else there is. A setting stands before those that it would undo.
pub const KEYS: &[Key] = &[
    unit(
        "cover",
        "Cover",
        "Cloud cover: 0 none, 1 all",
        Group::Sky,
        |s| &mut s.params.cover,
    ),
    unit(
        "height",
        "Height",
        "Height of the clouds: 0 low, 1 high",
        Group::Sky,
        |s| &mut s.params.height,
    ),
    unit(
        "density",
        "Density",
        "Density of the clouds: 0 thin and bumpy, 1 thick, smooth and dark",
        Group::Sky,
        |s| &mut s.params.density,
    ),
    unit(
        "sunset",
        "Sunset",
        "Amount of red on the clouds of a sunset",
        Group::Sky,
        |s| &mut s.params.sunset,
    ),
    unit("speed", "Speed", "Speed of the clouds", Group::Sky, |s| {
        &mut s.params.speed
    }),
    unit(
        "time",
        "Time",
        "Time of day: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset",
        Group::Sky,
        |s| &mut s.params.time,
    ),
    text(
        "method",
        "Method",
        "How the clouds are made",
        Group::Clouds,
        Input::Choice {
            choices: &text::METHODS,
        },
        text::method,
        text::set_method,
    ),
    unit(
        "upper",
        "Upper layer",
        "Amount of a thin upper layer, 0 (none) to 1",
        Group::Clouds,
        |s| &mut s.params.upper_layer,
    )
    .of(&[Method::Packed, Method::Sprites]),
    count(
        "octaves",
        "Octaves",
        "How many octaves are summed",
        MAX_OCTAVES,
        |s| &mut s.params.octaves.count,
    )
    .of(OCTAVES),
    unit(
        "octaves-sharpness",
        "Sharpness",
        "How sharply clouds end",
        Group::Clouds,
        |s| &mut s.params.octaves.sharpness,
    )
    .option("sharpness")
    .of(OCTAVES),
    number(
        "octaves-interval",
        "Formation",
        "Seconds in which clouds form anew",
        Group::Clouds,
        [
            FORMATION_INTERVAL_S[0] as f64,
            FORMATION_INTERVAL_S[1] as f64,
        ],
        "seconds",
        |s| &mut s.params.octaves.formation_interval_s,
    )
    .logarithmic()
    .option("formation-interval")
    .of(OCTAVES),
    text(
        "domes",
        "Domes",
        "Cover of each dome as a share of the cover; 0 leaves it out",
        Group::Clouds,
        Input::Numbers {
            names: &["Low", "Middle", "High"],
            ranges: &[[0.0, 1.0]; 3],
            optional: false,
        },
        text::domes,
        text::set_domes,
    )
    .of(OCTAVES),
    text(
        "palette",
        "Palette",
        "Colours of the clouds",
        Group::Clouds,
        Input::Choice {
            choices: &text::PALETTES,
        },
        text::palette_name,
        text::set_palette,
    )
    .of(FBM),
    unit(
        "fbm-sharpness",
        "Sharpness",
        "How sharply clouds end",
        Group::Clouds,
        |s| &mut s.params.fbm.sharpness,
    )
    .option("sharpness")
    .of(FBM),
    text(
        "lit",
        "Lit",
        "Reflectance where the light comes through, linear",
        Group::Clouds,
        Input::Colour,
        text::lit_colour,
        text::set_lit_colour,
    )
    .of(FBM),
    text(
        "shaded",
        "Shaded",
        "Reflectance where clouds shade themselves, linear",
        Group::Clouds,
        Input::Colour,
        text::shaded_colour,
        text::set_shaded_colour,
    )
    .of(FBM),
    text(
        "layers",
        "Layers",
        "Layers of clouds, KIND:SHARE:HEIGHT between commas",
        Group::Clouds,
        Input::Layers,
        text::layers,
        text::set_layers,
    )
    .of(LIT),
    number(
        "dome-radius",
        "Dome radius",
        "Radius of the dome's rim",
        Group::Clouds,
        [1e3, 1e6],
        "metres",
        |s| &mut s.params.lit.radius_m,
    )
    .logarithmic()
    .of(LIT),
    number(
        "flattening",
        "Flattening",
        "Height of the dome over its radius, 1 for a hemisphere",
        Group::Clouds,
        [0.02, 1.0],
        "",
        |s| &mut s.params.lit.flattening,
    )
    .of(LIT),
    unit(
        "k1",
        "All around (k1)",
        "Light that clouds scatter to all sides",
        Group::Clouds,
        |s| &mut s.params.lit.k1,
    )
    .of(LIT),
    unit(
        "k2",
        "Forwards (k2)",
        "Light that they scatter forwards, which shines around the sun",
        Group::Clouds,
        |s| &mut s.params.lit.k2,
    )
    .of(LIT),
    number(
        "m",
        "Narrowness (m)",
        "How narrow the shine around the sun is and how fast shade deepens",
        Group::Clouds,
        [0.5, 16.0],
        "",
        |s| &mut s.params.lit.m,
    )
    .of(LIT),
    unit(
        "moon",
        "Moon",
        "Strength of the full moon's light on clouds",
        Group::Clouds,
        |s| &mut s.params.lit.moon,
    )
    .of(LIT),
    number(
        "lit-interval",
        "Formation",
        "Seconds in which clouds form anew",
        Group::Clouds,
        [1.0, 86_400.0],
        "seconds",
        |s| &mut s.params.lit.formation_interval_s,
    )
    .logarithmic()
    .option("formation-interval")
    .of(LIT),
    text(
        "behind",
        "Behind",
        "Method of the dome behind the sprites; sprites is a clear one",
        Group::Clouds,
        Input::Choice {
            choices: &text::METHODS,
        },
        text::behind,
        text::set_behind,
    )
    .of(SPRITES),
    unit(
        "behind-cover",
        "Cover behind",
        "Cover of that dome",
        Group::Clouds,
        |s| &mut s.params.sprites.behind_cover,
    )
    .of(SPRITES),
    number(
        "sight",
        "Sight",
        "How far clouds are seen",
        Group::Clouds,
        [8_000.0, 60_000.0],
        "metres",
        |s| &mut s.params.sprites.distance_m,
    )
    .of(SPRITES),
    text(
        "ring",
        "Ring",
        "Radius of the ring of impostors in metres, 4000 to 60000; 0 for no ring",
        Group::Clouds,
        Input::Slider {
            low: 0.0,
            high: 60_000.0,
            unit: "metres",
            logarithmic: false,
            whole: false,
        },
        text::ring,
        text::set_ring,
    )
    .of(SPRITES),
    number(
        "billboards",
        "Billboards",
        "Distance beyond which a cloud is one billboard",
        Group::Clouds,
        [2_000.0, 60_000.0],
        "metres",
        |s| &mut s.params.sprites.billboards_beyond_m,
    )
    .of(SPRITES),
    unit(
        "formation",
        "Formed",
        "The most that clouds have formed, 0 (nothing) to 1 (whole)",
        Group::Clouds,
        |s| &mut s.params.sprites.formation,
    )
    .of(SPRITES),
    text(
        "sky",
        "Sky model",
        "How the clear sky is computed",
        Group::Air,
        Input::Choice {
            choices: &text::MODELS,
        },
        text::model,
        text::set_model,
    ),
    number(
        "turbidity",
        "Turbidity",
        "Haze in the air, from clear to thick",
        Group::Air,
        [TURBIDITY[0] as f64, TURBIDITY[1] as f64],
        "",
        |s| &mut s.params.perez.turbidity,
    )
    .when(text::has_haze),
    text(
        "cie",
        "Standard sky",
        "Luminance of a standard sky of ISO 15469, 1 (overcast) to 12 (clear) to 15",
        Group::Air,
        Input::Choice {
            choices: &text::CIE,
        },
        text::cie,
        text::set_cie,
    )
    .when(is_perez),
    text(
        "perez",
        "Perez",
        "Luminance by five numbers of one's own",
        Group::Air,
        Input::Numbers {
            names: &["A", "B", "C", "D", "E"],
            ranges: &PEREZ,
            optional: true,
        },
        text::perez,
        text::set_perez,
    )
    .when(is_perez),
    switch("sun", "Sun", "The sun's disc and glow", "no-sun", |s| {
        &mut s.params.sun
    }),
    switch("stars", "Stars", "Stars and galaxy", "no-stars", |s| {
        &mut s.params.stars
    }),
    unit(
        "flare",
        "Lens flare",
        "Strength of the lens flare, 0 is off",
        Group::Light,
        |s| &mut s.params.flare,
    ),
    switch(
        "starburst",
        "Starburst",
        "Whether the flare's picture of the sun is a starburst instead of a disc",
        "starburst",
        |s| &mut s.params.starburst,
    )
    .when(has_flare),
    unit(
        "skybox",
        "Skybox",
        "How far the pack's skybox, if it has one, takes the place of the computed sky",
        Group::Light,
        |s| &mut s.params.skybox,
    ),
    unit(
        "rays",
        "Rays",
        "Strength of the sun's rays between the clouds",
        Group::Weather,
        |s| &mut s.params.weather.rays,
    ),
    unit(
        "rain",
        "Rain",
        "Strength of the rain",
        Group::Weather,
        |s| &mut s.params.weather.rain,
    ),
    number(
        "flashes",
        "Lightning",
        "Flashes of lightning a minute",
        Group::Weather,
        [0.0, 30.0],
        "a minute",
        |s| &mut s.flashes_per_min,
    )
    .no_option(),
    Key {
        slot: Slot::Seconds(|s| &mut s.at_s),
        ..number(
            "at",
            "Moment",
            "Moment of the animation",
            Group::Time,
            [0.0, crate::values::LAST_SECOND],
            "seconds",
            |s| &mut s.rate,
        )
        .logarithmic()
    },
    number(
        "rate",
        "Rate",
        "Seconds of the animation that go by in a second",
        Group::Time,
        [0.0, 1000.0],
        "",
        |s| &mut s.rate,
    )
    .logarithmic()
    .no_option(),
    number(
        "day-length",
        "Day length",
        "Seconds that a day takes; 0 and the time of day stays",
        Group::Time,
        [0.0, 86_400.0],
        "seconds",
        |s| &mut s.day_length_s,
    )
    .logarithmic()
    .no_option(),
    // After the moment, from which a flash without a start begins.
    text(
        "lightning",
        "Flash",
        "One flash: kilometres to the east and to the south, second at which it begins, strength",
        Group::Weather,
        Input::Text {
            form: LIGHTNING_FORM,
        },
        text::flash,
        text::set_flash,
    ),
    number(
        "azimuth",
        "Azimuth",
        "Azimuth of the view, from north (0) towards east (90)",
        Group::Camera,
        [-360.0, 360.0],
        "degrees",
        |s| &mut s.view.azimuth_deg,
    ),
    number(
        "elevation",
        "Elevation",
        "Elevation of the view: 0 is the horizon, 90 the zenith",
        Group::Camera,
        [-90.0, 90.0],
        "degrees",
        |s| &mut s.view.elevation_deg,
    ),
    number(
        "fov",
        "Field of view",
        "Vertical field of view",
        Group::Camera,
        [1.0, 150.0],
        "degrees",
        |s| &mut s.view.fov_deg,
    ),
    place(
        "east",
        "East",
        "Where the viewer stands, to the east",
        |s| &mut s.view.east_m,
    ),
    place(
        "north",
        "North",
        "Where the viewer stands, to the north",
        |s| &mut s.view.north_m,
    ),
    place("up", "Up", "Where the viewer stands, up", |s| {
        &mut s.view.up_m
    }),
];

const PEREZ: [[f64; 2]; 5] = {
    let mut ranges = [[0.0; 2]; 5];
    let mut i = 0;
    while i < 5 {
        ranges[i] = [CUSTOM[i][0] as f64, CUSTOM[i][1] as f64];
        i += 1;
    }
    ranges
};

fn has_flare(settings: &Settings) -> bool {
    settings.params.flare > 0.0
}

fn is_perez(settings: &Settings) -> bool {
    settings.params.sky == SkyModel::Perez
}

/// The setting of this name.
///
/// # Errors
/// [`SettingError::Unknown`].
pub fn key(name: &str) -> Result<&'static Key, SettingError> {
    let nearest = || {
        let distance = |key: &&Key| edits(name, key.name);
        KEYS.iter().min_by_key(distance).map_or("", |key| key.name)
    };
    KEYS.iter()
        .find(|key| key.name == name)
        .ok_or_else(|| SettingError::Unknown {
            key: name.to_string(),
            nearest: nearest(),
        })
}

/// Letters that must be put in, taken out or changed to make one word of the other.
fn edits(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.chars().enumerate() {
            let changed = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[row.len() - 1]
}

#[cfg(test)]
mod tests;
