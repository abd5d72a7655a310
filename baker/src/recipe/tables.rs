//! The tables of a recipe as they are written.

use serde::Deserialize;
use toml::{Spanned, Value};

/// A value that may be left out, with its place in the text.
pub(crate) type Entry = Option<Spanned<Value>>;

/// Tables with these keys, every one of which may be left out; a key without a type has one value.
macro_rules! tables {
    (@type) => { Entry };
    (@type $type:ty) => { $type };
    ($($name:ident { $($key:ident $(: $type:ty)?),+ $(,)? })+) => {$(
        #[derive(Clone, Debug, Default, Deserialize)]
        #[serde(deny_unknown_fields, default, expecting = "a table")]
        pub(crate) struct $name {
            $(pub $key: tables!(@type $($type)?),)+
        }
    )+};
}

tables! {
    Tables {
        name, seed, clouds: Clouds, stars: Stars, galaxy: Galaxy, sky: Sky, sun: Sun, fbm: Fbm,
        flares: Flares, layers: Layers, sprites: Sprites, skybox: Option<Spanned<Skybox>>,
        field: Option<Spanned<FieldTable>>,
    }
    Clouds { size, format, photo: Photo, noise: Fractal, detail: Fractal, gradient: Gradient }
    Photo {
        file, mean, mask, as_is, invert, levels, flatten, sharpness, region, projection, fov_deg, horizon,
        seam,
    }
    Fractal { cells, octaves, gain, mean }
    Gradient { power }
    Stars { size, count, magnitudes, brightest, catalogue }
    Galaxy { size, tilt_deg, azimuth_deg, dust }
    Sky { width, height, suns, haze, most_haze }
    Sun { size, noon_elevation_deg }
    Fbm { size, octaves, cells }
    Flares { size }
    Layers { size, stratocumulus: Layer, cumulus: Layer, cirrus: Layer }
    Layer { cells, octaves, gain, relief }
    Sprites {
        size, file, pictures: Option<Spanned<Vec<Spanned<Value>>>>, contrast, detail, softness,
    }
    Skybox { file, faces: Option<Spanned<Faces>>, size, gain, azimuth_deg }
    Faces { east, west, up, down, south, north }
    FieldTable {
        sections, most_sprites, clouds: Option<Vec<Spanned<CloudLayer>>>,
        models: Option<Vec<Spanned<Model>>>, hours: Option<Vec<Spanned<HourTable>>>,
    }
    CloudLayer { kind, cover, base_m, top_m, density, cull, levels }
    Model { kind, file, boxes: Option<Vec<Spanned<BoxTable>>>, copies, base_m, rank, levels }
    BoxTable {
        centre_m, size_m, sprites, width_m, height_m, category, rotation_deg, group, flat_bottom,
        cull,
    }
    HourTable { time, ambient, colour, least, most }
}
