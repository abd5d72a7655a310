//! What each role asks of its texture, as data.

use super::{ChannelSpec, Filter, Mips, RoleSpec, Wrap};
use crate::limits::MAX_SIDE;
use crate::mapping::FBM_LEAST_CELLS;
use crate::texel::StarTexel;
use crate::{Format, Shape};

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

const fn fractal(name: &'static str, meaning: &'static str) -> ChannelSpec {
    ChannelSpec {
        is_fractal: true,
        ..channel(name, meaning, "1", 1.0)
    }
}

pub(super) const CLOUDS: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm, Format::Rgba16Float],
    shape: Shape::D2,
    size: [512, 512],
    sides: ANY_SIDE,
    layers: [1, 1],
    least_cells: None,
    mips: Mips::All,
    wrap: Wrap::Repeat,
    filter: Filter::Linear,
    channels: &[
        channel("photo", "cloud amount from a photograph", "1", 1.0),
        fractal("noise", "cloud amount from fractal noise"),
        fractal("detail", "finer fractal noise"),
        channel(
            "gradient",
            "sunset tint, from away from the sun (top row) to below it (bottom row)",
            "1",
            1.0,
        ),
    ],
};

pub(super) const STARS: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm],
    shape: Shape::D2,
    size: [256, 256],
    sides: ANY_SIDE,
    layers: [1, 1],
    least_cells: None,
    mips: Mips::All,
    wrap: Wrap::Repeat,
    filter: Filter::Nearest,
    channels: &[
        channel(
            "intensity",
            "mean intensity of the star, 0 where there is none",
            "1",
            1.0,
        ),
        channel("rate", "flicker rate", "Hz", StarTexel::MAX_RATE_HZ),
        channel(
            "variance",
            "flicker amplitude, in the unit of intensity",
            "1",
            1.0,
        ),
        channel("phase", "place in the flicker cycle at time 0", "turn", 1.0),
    ],
};

pub(super) const GALAXY: RoleSpec = RoleSpec {
    formats: &[Format::R8Unorm],
    shape: Shape::D2,
    size: [128, 128],
    sides: ANY_SIDE,
    layers: [1, 1],
    least_cells: None,
    mips: Mips::All,
    wrap: Wrap::Clamp,
    filter: Filter::Linear,
    channels: &[channel("brightness", "brightness of the galaxy", "1", 1.0)],
};

pub(super) const SKY: RoleSpec = RoleSpec {
    formats: &[Format::Rgba16Float],
    shape: Shape::D2,
    size: [128, 64],
    sides: ANY_SIDE,
    layers: [1, 1],
    least_cells: None,
    mips: Mips::One,
    wrap: Wrap::Repeat,
    filter: Filter::Linear,
    channels: &[
        channel(
            "red",
            "radiance of the clear sky, linear BT.709, red",
            "white of a sunlit cloud at noon",
            1.0,
        ),
        channel(
            "green",
            "radiance of the clear sky, linear BT.709, green",
            "white of a sunlit cloud at noon",
            1.0,
        ),
        channel(
            "blue",
            "radiance of the clear sky, linear BT.709, blue",
            "white of a sunlit cloud at noon",
            1.0,
        ),
        channel(
            "night",
            "share of the night sky that shows through, 0 by day",
            "1",
            1.0,
        ),
    ],
};

pub(super) const SUN: RoleSpec = RoleSpec {
    formats: &[Format::Rg8Unorm],
    shape: Shape::D2,
    size: [128, 128],
    // A smaller disc has no middle: texels about it reach to its edge.
    sides: [16, MAX_SIDE],
    layers: [1, 1],
    least_cells: None,
    mips: Mips::All,
    wrap: Wrap::Clamp,
    filter: Filter::Linear,
    channels: &[
        channel(
            "disc",
            "the sun's disc with limb darkening; its edge is half way from centre to side",
            "1",
            1.0,
        ),
        channel("glow", "the glow around the sun, 0 at the sides", "1", 1.0),
    ],
};

pub(super) const OCTAVES: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm],
    shape: Shape::D2,
    size: [32, 32],
    sides: [32, 32],
    layers: [1, 1],
    least_cells: None,
    mips: Mips::One,
    wrap: Wrap::Repeat,
    filter: Filter::Nearest,
    channels: &[
        channel("octave1", "white noise, 32 cells over the tile", "1", 1.0),
        channel(
            "octave2",
            "white noise, 32 cells over half of the tile",
            "1",
            1.0,
        ),
        channel(
            "octave3",
            "white noise, 32 cells over a quarter of the tile",
            "1",
            1.0,
        ),
        channel(
            "octave4",
            "white noise, 32 cells over an eighth of the tile",
            "1",
            1.0,
        ),
    ],
};

pub(super) const FBM: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm],
    shape: Shape::Array,
    size: [256, 256],
    sides: [64, 1024],
    layers: [1, 8],
    least_cells: Some(FBM_LEAST_CELLS),
    mips: Mips::One,
    wrap: Wrap::Repeat,
    filter: Filter::Linear,
    channels: &[
        channel(
            "steps3",
            "the noise three steps towards the sun, east at the bake",
            "1",
            1.0,
        ),
        channel("steps2", "the noise two steps towards the sun", "1", 1.0),
        channel("steps1", "the noise one step towards the sun", "1", 1.0),
        channel(
            "noise",
            "smooth noise, twice as fine from layer to layer",
            "1",
            1.0,
        ),
    ],
};

pub(super) const FLARES: RoleSpec = RoleSpec {
    formats: &[Format::R8Unorm],
    shape: Shape::D2,
    size: [256, 256],
    sides: [64, 1024],
    layers: [1, 1],
    least_cells: None,
    mips: Mips::All,
    wrap: Wrap::Clamp,
    filter: Filter::Linear,
    channels: &[channel(
        "light",
        "light of a lens flare: disc, ring, glow and starburst in 2x2 cells",
        "1",
        1.0,
    )],
};

pub(super) const LAYERS: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm],
    shape: Shape::Array,
    size: [256, 256],
    sides: [64, 1024],
    layers: [3, 3],
    least_cells: None,
    mips: Mips::All,
    wrap: Wrap::Repeat,
    filter: Filter::Linear,
    channels: &[
        ChannelSpec {
            name: "normal_x",
            meaning: "unit normal of the cloud's upper surface, component along +u",
            unit: "1",
            range: [-1.0, 1.0],
            is_fractal: false,
        },
        ChannelSpec {
            name: "normal_y",
            meaning: "unit normal of the cloud's upper surface, component along +v",
            unit: "1",
            range: [-1.0, 1.0],
            is_fractal: false,
        },
        channel("density", "cloud amount", "1", 1.0),
        channel(
            "rank",
            "share of the layer's texels that are thinner",
            "1",
            1.0,
        ),
    ],
};

pub(super) const SPRITES: RoleSpec = RoleSpec {
    formats: &[Format::Rg8Unorm],
    shape: Shape::D2,
    size: [512, 512],
    sides: [128, 2048],
    layers: [1, 1],
    least_cells: None,
    // Cells of 8 texels: smaller ones would be border and little else.
    mips: Mips::To(32),
    wrap: Wrap::Clamp,
    filter: Filter::Linear,
    channels: &[
        channel(
            "grey",
            "shade of the cloud, 0.5 the mean over a sprite; it goes on where the sprite has ended",
            "1",
            1.0,
        ),
        channel(
            "alpha",
            "opacity, 0 along the border of every cell",
            "1",
            1.0,
        ),
    ],
};

pub(super) const SKYBOX: RoleSpec = RoleSpec {
    formats: &[Format::Rgba16Float],
    shape: Shape::Cube,
    size: [256, 256],
    sides: [16, 2048],
    layers: [6, 6],
    least_cells: None,
    mips: Mips::All,
    wrap: Wrap::Clamp,
    filter: Filter::Linear,
    channels: &[
        channel(
            "red",
            "radiance of the picture times its cover, linear BT.709, red",
            "white of a sunlit cloud at noon",
            1.0,
        ),
        channel(
            "green",
            "radiance of the picture times its cover, linear BT.709, green",
            "white of a sunlit cloud at noon",
            1.0,
        ),
        channel(
            "blue",
            "radiance of the picture times its cover, linear BT.709, blue",
            "white of a sunlit cloud at noon",
            1.0,
        ),
        channel(
            "cover",
            "share of the picture, 0 where the computed sky shows through",
            "1",
            1.0,
        ),
    ],
};
