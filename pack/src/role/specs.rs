//! What each role asks of its texture, as data.

use super::spec::{ChannelSpec, Filter, Mips, RoleSpec, Wrap};
use crate::format::{Format, Shape};
use crate::limits::MAX_SIDE;
use crate::mapping::{FBM_LEAST_CELLS, SKY_HAZES, SKY_PARTS};
use crate::texel::StarTexel;

/// Sides of a texture that may be as small or large as anyone likes.
const ANY_SIDE: [u32; 2] = [4, MAX_SIDE];

const fn channel(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    max: f32,
) -> ChannelSpec {
    ChannelSpec {
        name,
        meaning,
        unit,
        range: [0.0, max],
        is_fractal: false,
    }
}

/// From nothing to all.
const fn share(name: &'static str, meaning: &'static str) -> ChannelSpec {
    channel(name, meaning, "1", 1.0)
}

const fn radiance(name: &'static str, meaning: &'static str) -> ChannelSpec {
    channel(name, meaning, "white of a sunlit cloud at noon", 1.0)
}

/// Of the table of the clear sky, whose unit changes with the hour.
const fn light(name: &'static str, meaning: &'static str) -> ChannelSpec {
    channel(
        name,
        meaning,
        "unit of the sun's elevation, 32000 cd/m2 at 60 degrees",
        1.0,
    )
}

/// A component of a unit vector.
const fn normal(name: &'static str, meaning: &'static str) -> ChannelSpec {
    ChannelSpec {
        range: [-1.0, 1.0],
        ..share(name, meaning)
    }
}

const fn fractal(name: &'static str, meaning: &'static str) -> ChannelSpec {
    ChannelSpec {
        is_fractal: true,
        ..share(name, meaning)
    }
}

/// One picture that tiles, filtered, with all its levels: what the others differ from.
const TILE: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm],
    shape: Shape::D2,
    size: [256, 256],
    sides: ANY_SIDE,
    layers: [1, 1],
    layers_multiple: 1,
    least_cells: None,
    mips: Mips::All,
    wrap: Wrap::Repeat,
    filter: Filter::Linear,
    channels: &[],
};

pub(super) const CLOUDS: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm, Format::Rgba16Float],
    size: [512, 512],
    channels: &[
        share("photo", "cloud amount from a photograph"),
        fractal("noise", "cloud amount from fractal noise"),
        fractal("detail", "finer fractal noise"),
        share(
            "gradient",
            "sunset tint, from away from the sun (top row) to below it (bottom row)",
        ),
    ],
    ..TILE
};

pub(super) const STARS: RoleSpec = RoleSpec {
    filter: Filter::Nearest,
    channels: &[
        share(
            "intensity",
            "mean intensity of the star, 0 where there is none",
        ),
        channel("rate", "flicker rate", "Hz", StarTexel::MAX_RATE_HZ),
        share("variance", "flicker amplitude, in the unit of intensity"),
        channel("phase", "place in the flicker cycle at time 0", "turn", 1.0),
    ],
    ..TILE
};

pub(super) const GALAXY: RoleSpec = RoleSpec {
    formats: &[Format::R8Unorm],
    size: [128, 128],
    wrap: Wrap::Clamp,
    channels: &[share("brightness", "brightness of the galaxy")],
    ..TILE
};

pub(super) const SKY: RoleSpec = RoleSpec {
    formats: &[Format::Rgba16Float],
    shape: Shape::Array,
    size: [16, 32],
    sides: [8, 64],
    // Two parts of two hazes for 16 to 64 suns.
    layers: [64, 256],
    layers_multiple: SKY_HAZES * SKY_PARTS,
    mips: Mips::One,
    wrap: Wrap::Clamp,
    channels: &[
        light("red", "light of the clear sky, linear BT.709, red"),
        light("green", "light of the clear sky, linear BT.709, green"),
        light("blue", "light of the clear sky, linear BT.709, blue"),
        share("padding", "nothing"),
    ],
    ..TILE
};

pub(super) const SUN: RoleSpec = RoleSpec {
    formats: &[Format::Rg8Unorm],
    size: [128, 128],
    // A smaller disc has no middle: texels about it reach to its edge.
    sides: [16, MAX_SIDE],
    wrap: Wrap::Clamp,
    channels: &[
        share(
            "disc",
            "the sun's disc with limb darkening; its edge is half way from centre to side",
        ),
        share("glow", "the glow around the sun, 0 at the sides"),
    ],
    ..TILE
};

pub(super) const OCTAVES: RoleSpec = RoleSpec {
    size: [32, 32],
    sides: [32, 32],
    mips: Mips::One,
    filter: Filter::Nearest,
    channels: &[
        share("octave1", "white noise, 32 cells over the tile"),
        share("octave2", "white noise, 32 cells over half of the tile"),
        share(
            "octave3",
            "white noise, 32 cells over a quarter of the tile",
        ),
        share(
            "octave4",
            "white noise, 32 cells over an eighth of the tile",
        ),
    ],
    ..TILE
};

pub(super) const FBM: RoleSpec = RoleSpec {
    shape: Shape::Array,
    sides: [64, 1024],
    layers: [1, 8],
    least_cells: Some(FBM_LEAST_CELLS),
    mips: Mips::One,
    channels: &[
        share(
            "steps3",
            "the noise three steps towards the sun, east at the bake",
        ),
        share("steps2", "the noise two steps towards the sun"),
        share("steps1", "the noise one step towards the sun"),
        share("noise", "smooth noise, twice as fine from layer to layer"),
    ],
    ..TILE
};

pub(super) const FLARES: RoleSpec = RoleSpec {
    formats: &[Format::R8Unorm],
    sides: [64, 1024],
    wrap: Wrap::Clamp,
    channels: &[share(
        "light",
        "light of a lens flare: disc, ring, glow and starburst in 2x2 cells",
    )],
    ..TILE
};

pub(super) const LAYERS: RoleSpec = RoleSpec {
    shape: Shape::Array,
    sides: [64, 1024],
    layers: [3, 3],
    channels: &[
        normal(
            "normal_x",
            "unit normal of the cloud's upper surface, component along +u",
        ),
        normal(
            "normal_y",
            "unit normal of the cloud's upper surface, component along +v",
        ),
        share("density", "cloud amount"),
        share("rank", "share of the layer's texels that are thinner"),
    ],
    ..TILE
};

pub(super) const SPRITES: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm],
    size: [512, 512],
    sides: [128, 2048],
    // Cells of 8 texels: smaller ones would be border and little else.
    mips: Mips::To(32),
    wrap: Wrap::Clamp,
    channels: &[
        share(
            "grey",
            "light from the viewer's side, 0.5 the mean over a sprite; it goes on where the sprite has ended",
        ),
        share("alpha", "opacity, 0 along the border of every cell"),
        share(
            "right",
            "light from the right against that from the left, 0.5 as much; it goes on like grey",
        ),
        share(
            "top",
            "light from the top against that from the bottom, 0.5 as much; it goes on like grey",
        ),
    ],
    ..TILE
};

pub(super) const CATALOGUE: RoleSpec = RoleSpec {
    shape: Shape::Array,
    size: [128, 128],
    sides: [8, 256],
    // Place, light, flicker.
    layers: [3, 3],
    mips: Mips::One,
    wrap: Wrap::Clamp,
    filter: Filter::Nearest,
    channels: &[
        share(
            "first",
            "right ascension in turns, coarse; magnitude, coarse; flicker rate in 255ths of 255/64 Hz",
        ),
        share(
            "second",
            "right ascension, fine; magnitude, fine; flicker amplitude in the zenith as a share of the light",
        ),
        share(
            "third",
            "declination from pole to pole, coarse; B-V; place in the flicker cycle at time 0",
        ),
        share(
            "fourth",
            "declination, fine; 1 where there is a star; nothing",
        ),
    ],
    ..TILE
};

pub(super) const SKYBOX: RoleSpec = RoleSpec {
    formats: &[Format::Rgba16Float],
    shape: Shape::Cube,
    sides: [16, 2048],
    layers: [6, 6],
    wrap: Wrap::Clamp,
    channels: &[
        radiance(
            "red",
            "radiance of the picture times its cover, linear BT.709, red",
        ),
        radiance(
            "green",
            "radiance of the picture times its cover, linear BT.709, green",
        ),
        radiance(
            "blue",
            "radiance of the picture times its cover, linear BT.709, blue",
        ),
        share(
            "cover",
            "share of the picture, 0 where the computed sky shows through",
        ),
    ],
    ..TILE
};
