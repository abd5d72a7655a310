//! Every setting of the sky: one table. Ranges, names, options, helps, and what weathers blend come from it.

use super::layers::LAYERS_FORM;
use super::lit::{LAYER_HEIGHT, MAX_LAYERS, SHARE, VELOCITY_M_S};
use super::method::Method;
use super::octaves::{FORMATION_INTERVAL_S, MAX_OCTAVES};
use super::perez::{CUSTOM, TURBIDITY};
use super::row::{UNIT, count, number, switch, text, three};
use super::setting::{DefaultSaid, Group, Input, Number, Setting};
use super::sky::{EXPOSURE_EV, MAX_EXPOSURE, SkyParams};
use super::sprites::MOST_DISTANCE_M;
use super::text;
use super::weather::{FLASH_PLACE_M, FLASH_STRENGTH};

/// Those without a map: what they draw has the thin upper layer.
const PLAIN: &[Method] = &[
    Method::Packed,
    #[cfg(feature = "sprites")]
    Method::Sprites,
];
/// Those with noise of their own: every dome but the first, `packed`.
const MAPPED: &[Method] = match Method::DOMES.split_first() {
    Some((_, others)) => others,
    None => &[],
};
const OCTAVES: &[Method] = &[
    #[cfg(feature = "octaves")]
    Method::Octaves,
];
const FBM: &[Method] = &[
    #[cfg(feature = "fbm")]
    Method::Fbm,
];
const LIT: &[Method] = &[
    #[cfg(feature = "lit")]
    Method::Lit,
];
const SPRITES: &[Method] = &[
    #[cfg(feature = "sprites")]
    Method::Sprites,
];

/// A field, its range and its name in errors, by its path.
macro_rules! at {
    ($first:ident $(. $rest:ident)* $([$index:literal])*, $range:expr) => {
        Number {
            field: concat!(stringify!($first) $(, ".", stringify!($rest))* $(, "[", $index, "]")*),
            range: $range,
            place: |params: &mut SkyParams| &mut params.$first $(.$rest)* $([$index])*,
        }
    };
}

/// A plain number: its path and its range.
macro_rules! plain {
    ($($path:ident).+, $range:expr) => { number(at!($($path).+, $range)) };
}

/// Three numbers from 0 to 1 in a field.
macro_rules! three {
    ($($path:ident).+, $input:expr) => {
        three($input, [at!($($path).+[0], UNIT), at!($($path).+[1], UNIT), at!($($path).+[2], UNIT)])
    };
}

/// The six of Roden and Parberry, by their names, then what else there is. A setting stands before those that it would undo.
pub const SETTINGS: &[Setting] = settings! {
    Sky {
        "cover" "Cover" "Cloud cover: 0 none, 1 all"
            = plain!(cover, UNIT).value("C").range_said().blends();
        "height" "Height" "Height of the clouds: 0 low, 1 high"
            = plain!(height, UNIT).value("H").range_said().blends();
        "density" "Density" "Density of the clouds: 0 thin and bumpy, 1 thick, smooth and dark"
            = plain!(density, UNIT).value("D").range_said().blends();
        "sunset" "Sunset" "Amount of red on the clouds of a sunset"
            = plain!(sunset, UNIT).value("S").range_said().blends();
        "speed" "Speed" "Speed of the clouds"
            = plain!(speed, UNIT).value("S").range_said().blends();
        "time" "Time" "Time of day: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset"
            = plain!(time, UNIT).value("T").range_said().blends().when(text::has_no_date);
    }
    Clouds {
        "method" "Method" "How the clouds are made"
            = text(choice(&text::METHODS), text::method, text::set_method);
        "shading" "Shading" "How clouds are shaded"
            = text(choice(&text::SHADINGS), text::shading, text::set_shading);
        "upper" "Upper layer" "Amount of a thin upper layer, 0 (none) to 1"
            = plain!(upper_layer, UNIT).of(PLAIN).value("U").range_said().blends();
        "photo" "Photograph" "How much of the clouds' large shapes is the photograph's, 0 (as published) to 1"
            = plain!(photo, UNIT).of(MAPPED).value("P").range_said().blends();
        "octaves" "Octaves" "How many octaves are summed"
            = count("octaves.count", MAX_OCTAVES, |params: &mut SkyParams| &mut params.octaves.count)
                .of(OCTAVES).value("N").command_help("How many are summed, 1 to 8");
        "octaves-sharpness" "Sharpness" "How sharply clouds end"
            = plain!(octaves.sharpness, UNIT).of(OCTAVES).shared("sharpness").value("S");
        "octaves-interval" "Formation" "Seconds in which clouds form anew"
            = plain!(octaves.formation_interval_s, FORMATION_INTERVAL_S).unit("seconds", " seconds").logarithmic()
                .of(OCTAVES).shared("formation-interval").value("SECONDS");
        "domes" "Domes" "Cover of each dome as a share of the cover; 0 leaves it out"
            = three!(octaves.domes, DOMES).of(OCTAVES).value("LOW,MIDDLE,HIGH").default_said(INLINE)
                .command_help("Cover of each dome as a share of --cover, 0 to 1; 0 leaves it out");
        "palette" "Palette" "Colours of the clouds"
            = text(choice(&text::PALETTE_NAMES), text::palette, text::set_palette).of(FBM);
        "fbm-sharpness" "Sharpness" "How sharply clouds end"
            = plain!(fbm.sharpness, UNIT).of(FBM).shared("sharpness").value("S").blends()
                .default_said(DefaultSaid::Words("{}, 0.25 with the stormy palette"));
        "lit" "Lit" "Reflectance where the light comes through, linear, each 0 to 1"
            = three!(fbm.lit, Input::Colour).of(FBM).value("R,G,B").range_said().default_said(PALETTE_S).blends();
        "shaded" "Shaded" "Reflectance where clouds shade themselves, linear, each 0 to 1"
            = three!(fbm.shaded, Input::Colour).of(FBM).value("R,G,B").range_said().default_said(PALETTE_S).blends();
        "layers" "Layers" "Layers of clouds, KIND:SHARE:HEIGHT between commas"
            = text(Input::Layers, text::layers, text::set_layers).holding(&LAYERS)
                .of(LIT).value(LAYERS_FORM).default_said(INLINE);
        "dome-radius" "Dome radius" "Radius of the dome's rim in metres"
            = plain!(lit.radius_m, [1e3, 1e6]).unit("metres", " metres").logarithmic().of(LIT).value("M");
        "flattening" "Flattening" "Height of the dome over its radius, 0.02 (flat) to 1 (a hemisphere)"
            = plain!(lit.flattening, [0.02, 1.0]).aside(": the dome's height over its radius, 1 for a hemisphere")
                .of(LIT).value("F").range_said();
        "k1" "All around (k1)" "Light that clouds scatter to all sides"
            = plain!(lit.k1, UNIT).of(LIT).value("K");
        "k2" "Forwards (k2)" "Light that they scatter forwards, which shines around the sun"
            = plain!(lit.k2, UNIT).of(LIT).value("K");
        "m" "Narrowness (m)" "How narrow the shine around the sun is and how fast shade deepens"
            = plain!(lit.m, [0.5, 16.0]).of(LIT).value("M");
        "lit-interval" "Formation" "Seconds in which clouds form anew"
            = plain!(lit.formation_interval_s, [1.0, 86_400.0]).unit("seconds", " seconds").logarithmic()
                .of(LIT).shared("formation-interval").value("SECONDS");
        "behind" "Behind" "Method of the dome behind the sprites; sprites is a clear one, with the thin upper layer alone"
            = text(choice(&text::METHODS), text::behind, text::set_behind).of(SPRITES);
        "behind-cover" "Cover behind" "Cover of that dome"
            = plain!(sprites.behind_cover, UNIT).of(SPRITES).value("C");
        "sight" "Sight" "How far clouds are seen, in metres"
            = plain!(sprites.distance_m, [8000.0, MOST_DISTANCE_M]).unit("metres", " metres").of(SPRITES).value("M");
        "ring" "Ring" "Radius of the ring of impostors in metres, 4000 to 60000: clouds beyond it are pictures; 0 for no ring"
            = text(number(RING).words.input, text::ring, text::set_ring).unit("metres", "").holding(&[RING])
                .of(SPRITES).value("M").range_said();
        "billboards" "Billboards" "Distance beyond which a cloud is one billboard, in metres"
            = plain!(sprites.billboards_beyond_m, [2000.0, MOST_DISTANCE_M]).unit("metres", " metres").of(SPRITES).value("M");
        "hours" "Hours of the field" "Whether sprites are lit by the field's table of hours, as painted, not by the sky"
            = switch("hours", |params: &mut SkyParams| &mut params.sprites.hours).of(SPRITES)
                .command_help("Light sprites by the field's table of hours, as painted, not by the sky");
        "formation" "Formed" "The most that clouds have formed, 0 (nothing) to 1 (whole)"
            = plain!(sprites.formation, UNIT).of(SPRITES).value("F").range_said();
    }
    Air {
        "sky" "Sky model" "How the clear sky is computed"
            = text(choice(&text::MODELS), text::model, text::set_model);
        "haze" "Haze" "Haze in the air: 0 as the pack's clear air, 1 as its hazy air"
            = plain!(haze, UNIT).value("H").range_said().blends();
        "ground" "Ground" "Share of light that the ground reflects, linear, each 0 to 1"
            = three!(ground, Input::Colour).value("R,G,B").range_said().default_said(INLINE).blends();
        "sea" "Sea" "Whether a sea lies below the horizon, in place of the ground"
            = switch("sea", |params: &mut SkyParams| &mut params.sea).command_help("Let a sea lie below the horizon, in place of the ground");
        "waves" "Waves" "How rough the sea is, 0 (calm) to 1 (a wind of 15 m/s)"
            = plain!(waves, UNIT).when(text::has_sea).value("W").range_said().blends();
        "turbidity" "Turbidity" "Haze in the air, 1.7 (clear) to 10 (thick)"
            = plain!(perez.turbidity, TURBIDITY).when(text::has_haze).value("T").range_said();
        "cie" "Standard sky" "Luminance of a standard sky of ISO 15469, 1 (overcast) to 12 (clear) to 15"
            = text(Input::Choice { choices: &text::CIE, meanings: &[] }, text::cie, text::set_cie)
                .optional(text::clear_cie).when(text::is_perez).value("N").default_said(BY_TURBIDITY);
        "perez" "Perez" "Luminance by five numbers of one's own"
            = text(PEREZ, text::perez, text::set_perez)
                .optional(text::clear_perez).when(text::is_perez).value("A,B,C,D,E").default_said(BY_TURBIDITY);
    }
    Light {
        "sun" "Sun" "The sun's disc"
            = switch("no-sun", |params: &mut SkyParams| &mut params.sun)
                .command_help("Leave out the sun's disc, as a map beside a sun lamp wants it");
        "moon" "Moon" "Strength of the moon's light, 1 as it is"
            = plain!(moon, UNIT).value("S");
        "stars" "Stars" "Stars and galaxy"
            = switch("no-stars", |params: &mut SkyParams| &mut params.stars).command_help("Leave out stars and galaxy");
        "flare" "Lens flare" "Strength of the lens flare, 0 (off) to 1"
            = plain!(flare, UNIT).value("F").range_said();
        "starburst" "Starburst" "Whether the flare's picture of the sun is a starburst instead of a disc"
            = switch("starburst", |params: &mut SkyParams| &mut params.starburst).when(text::has_flare)
                .command_help("Draw the flare's picture of the sun as a starburst, not as a disc");
        "skybox" "Skybox" "How far the pack's skybox takes the place of the computed sky"
            = plain!(skybox, UNIT).value("S").default_said(DefaultSaid::Words("{}, where the pack has one"));
    }
    Weather {
        "rays" "Rays" "Strength of the sun's rays between the clouds, 0 (off) to 1"
            = plain!(weather.rays, UNIT).value("R").range_said().blends();
        "rain" "Rain" "Strength of the rain, 0 (off) to 1"
            = plain!(weather.rain, UNIT).value("R").range_said().blends();
    }
    Time {
        "date" "Date" "Moment of universal time, which takes the place of the time of day"
            = text(Input::Text { form: DATE_FORM }, text::date, text::set_date).optional(text::clear_date)
                .value(DATE_FORM).default_said(DefaultSaid::Nothing).command_help(DATE_HELP);
        "lat" "Latitude" "Latitude of the place, north positive"
            = plain!(place.latitude_deg, [-90.0, 90.0]).unit("degrees", " degrees").value("DEG").when(text::has_date);
        "lon" "Longitude" "Longitude of the place, east positive"
            = plain!(place.longitude_deg, [-180.0, 180.0]).unit("degrees", " degrees").value("DEG").when(text::has_date);
    }
    Camera {
        "exposure-ev" "Exposure" "Exposure of the picture in stops: each is twice as bright"
            = plain!(exposure_ev, EXPOSURE_EV).unit("stops", " stops").value("EV");
        "auto-exposure" "Automatic exposure" "Whether the exposure follows the light of the sky, as a camera's does"
            = switch("auto-exposure", |params: &mut SkyParams| &mut params.auto_exposure)
                .command_help("Expose as a camera would, by the light of the sky");
        "tonemap" "Tone curve" "How radiance becomes colour on a display"
            = text(choice(&text::TONEMAPS), text::tonemap, text::set_tonemap);
    }
};

/// Numbers that no setting has: an application gives them alone, or a setting that knows more than the sky.
pub const OTHERS: &[Number] = &[
    at!(exposure, [0.0, MAX_EXPOSURE]),
    at!(shadow_extent_m, [0.0, 1e6]),
    at!(weather.lightning.strength, FLASH_STRENGTH),
    at!(weather.lightning.place_m[0], FLASH_PLACE_M),
    at!(weather.lightning.place_m[1], FLASH_PLACE_M),
];

/// The numbers of the layers of [`Method::Lit`].
macro_rules! layers {
    ($($index:literal)*) => {
        [$(
            layers!($index, ".share", share, SHARE),
            layers!($index, ".height", height, LAYER_HEIGHT),
            layers!($index, ".velocity_m_s[0]", velocity_m_s[0], VELOCITY_M_S),
            layers!($index, ".velocity_m_s[1]", velocity_m_s[1], VELOCITY_M_S),
        )*]
    };
    ($index:literal, $name:literal, $field:ident $([$axis:literal])?, $range:expr) => {
        Number {
            field: concat!("lit.layers[", $index, "]", $name),
            range: $range,
            place: |params: &mut SkyParams| &mut params.lit.layers[$index].$field $([$axis])?,
        }
    };
}

static LAYERS: [Number; 4 * MAX_LAYERS] = layers!(0 1 2 3 4 5);

const RING: Number = at!(sprites.ring_radius_m, [0.0, MOST_DISTANCE_M]);

const DOMES: Input = Input::Numbers {
    names: &["Low", "Middle", "High"],
    ranges: &[[0.0, 1.0]; 3],
    optional: false,
};

const PEREZ: Input = Input::Numbers {
    names: &["A", "B", "C", "D", "E"],
    ranges: &{
        let mut ranges = [[0.0; 2]; 5];
        let mut i = 0;
        while i < 5 {
            ranges[i] = [CUSTOM[i][0] as f64, CUSTOM[i][1] as f64];
            i += 1;
        }
        ranges
    },
    optional: true,
};

const fn choice<const N: usize>([choices, meanings]: &'static [[&'static str; N]; 2]) -> Input {
    Input::Choice { choices, meanings }
}

/// How a date is written.
const DATE_FORM: &str = "YYYY-MM-DDTHH:MM:SSZ";

/// A date at the command line.
const DATE_HELP: &str = "The sky of a moment of universal time, 1900 to 2099, instead of --time, at the place of --lat and --lon; seconds and zone may be \
    left out, and a zone may be +03:00";

/// Beside the sentence and not on a line of its own, as every default of several numbers.
const INLINE: DefaultSaid = DefaultSaid::Words("{}");
const PALETTE_S: DefaultSaid = DefaultSaid::Words("the palette's");
const BY_TURBIDITY: DefaultSaid = DefaultSaid::Words("by the turbidity");
