//! The rules of `welkin check`: an id, a severity and a sentence each. docs/checks.md explains them.

use serde::{Deserialize, Serialize};

/// How bad a broken rule is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The pack is not sound.
    Error,
    /// The pack draws, but will hardly look as meant.
    Warning,
}

/// A rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    /// Name, stable across versions.
    pub id: &'static str,
    /// How bad it is when broken.
    pub severity: Severity,
    /// What it asks, in one sentence.
    pub asks: &'static str,
}

const fn error(id: &'static str, asks: &'static str) -> Rule {
    Rule {
        id,
        severity: Severity::Error,
        asks,
    }
}

const fn warning(id: &'static str, asks: &'static str) -> Rule {
    Rule {
        id,
        severity: Severity::Warning,
        asks,
    }
}

macro_rules! rules {
    ($($name:ident = $rule:expr;)*) => {
        $(pub(super) const $name: Rule = $rule;)*
        /// Every rule, in the order in which a report lists them.
        pub const RULES: &[Rule] = &[$($name),*];
    };
}

rules! {
    SEAL = error("seal", "The manifest is the one that the baker wrote.");
    MANIFEST = error("manifest", "Every entry of the manifest names what its role asks: file, format, shape, channels.");
    ROLES = error("roles", "Every role has a texture, but for `skybox` and `catalogue`.");
    FILE_HASH = error("file-hash", "Every file has the size and the hash that the manifest gives.");
    CONTAINER = error("container", "Every file is a KTX2 file that decodes whole.");
    LAYOUT = error("layout", "Format, shape, size and levels of a file are those of the manifest and of the role.");
    TEXEL_HASH = error("texel-hash", "The decoded texels have the hash that the manifest gives.");
    STATISTICS = error("statistics", "Mean and spread of every channel are those of the manifest.");
    FINITE = error("finite", "Every value that a half float stores is a finite number, on every level.");
    MIP_MEAN = error("mip-mean", "Every level has the mean of level 0.");
    LEVEL_MEAN = error("level-mean", "Every texel of a level is the mean of the texels above it.");
    SEAM = error("seam", "Across the edges a tiling channel changes no more than inside, on both axes.");
    SMOOTH = error("smooth", "Cloud channels are smooth at the texel.");
    CLOUD_SPREAD = error("cloud-spread", "Cloud channels are neither flat nor black and white.");
    CLOUD_COVER = error("cloud-cover", "The sky is open at little cover and shut at full cover.");
    CLOUD_CLEAR = error("cloud-clear", "A share of every cloud channel is quite clear, and its thickest place is 1.");
    CLOUD_WAVES = error("cloud-waves", "Cloud channels are made of many waves, as noise and photographs are, and not of stripes.");
    CLOUD_BAND = error("cloud-band", "Noise and detail have their energy where the octaves of the manifest have it.");
    CLOUD_MEAN = error("cloud-mean", "Noise and detail have the mean that they were brought to.");
    CLOUD_APART = error("cloud-apart", "No cloud channel is a copy of another, by whatever curve, nor its inverse.");
    GRADIENT_MONOTONE = error("gradient-monotone", "The sunset gradient never falls, row by row, and is the same along a row.");
    GRADIENT_STEP = error("gradient-step", "The sunset gradient has no step over 1/128.");
    GRADIENT_ENDS = error("gradient-ends", "The sunset gradient reaches from 0 to 1 on every level.");
    STAR_SHARE = error("star-share", "The star texture is mostly black, but not empty.");
    STAR_EMPTY = error("star-empty", "Rate, variance and phase are zero where there is no star.");
    STAR_CLIP = error("star-clip", "No star flickers below 0 or above 1, on any level.");
    STAR_LIGHT = error("star-light", "Every texel of a level has the light of the stars under it.");
    STAR_RECORD = error("star-record", "Every texel of a level has rate and phase of a star under it, and is empty where there is none.");
    STAR_FLICKER = error("star-flicker", "Stars flicker, on every level by as much as on level 0.");
    STAR_RATE = error("star-rate", "The flicker rates of the stars are spread evenly over their range.");
    STAR_BRIGHTEST = error("star-brightest", "The brightest star is as bright as the brightest of so many should be.");
    STAR_PHASE = error("star-phase", "The phases of the stars are spread evenly over the turn.");
    STAR_LATTICE = error("star-lattice", "The stars do not lie on a lattice.");
    STAR_CLUSTER = error("star-cluster", "The stars are not clustered.");
    GALAXY_BRIGHTNESS = error("galaxy-brightness", "The galaxy is there, and does not fill the sky.");
    GALAXY_BAND = error("galaxy-band", "The light of the galaxy lies along a great circle.");
    SKY_RANGE = error("sky-range", "Light is finite and not negative, and the fourth channel 0.");
    SKY_ZENITH = error("sky-zenith", "The zenith looks the same from every azimuth.");
    SKY_SMOOTH = error("sky-smooth", "The sky changes without jumps from texel to texel.");
    SKY_SUN = error("sky-sun", "While the sun is up, the sky at its elevation is brightest towards it.");
    SKY_LIGHT = error("sky-light", "The sky gives the light of the hour, or the part of it that the sun leaves to it.");
    SKY_COLOUR = error("sky-colour", "The zenith by day is blue: more green than red, and more blue than green.");
    SKY_DUSK = error("sky-dusk", "The sky is brightest at the horizon: by day, and in twilight on the side of the sun.");
    SKY_HAZE = error("sky-haze", "Haze makes the aureole brighter.");
    SUN_DISC = error("sun-disc", "The sun's disc is bright in its middle and gone outside its edge.");
    SUN_ROUND = error("sun-round", "Disc and glow are round, and nowhere brighter farther out.");
    SUN_BORDER = error("sun-border", "Disc and glow are zero along the sides of the square.");
    NOISE_FLAT = error("noise-flat", "Every value is equally often in a channel of the octaves.");
    NOISE_WHITE = error("noise-white", "The octaves' noise is white: no wave stands out, and no band of waves.");
    OCTAVE_BAND = error("octave-band", "Every layer of the fbm noise has its energy in the band of its octave.");
    OCTAVE_EVEN = error("octave-even", "The lattice values of every layer of the fbm noise are spread evenly over 0..1.");
    DISPLACED = error("displaced", "The displaced channels of the fbm noise are the noise, displaced.");
    FLARE_CELLS = error("flare-cells", "Every cell of the flares has light, and none along its border.");
    FLARE_SHAPE = error("flare-shape", "Every cell of the flares shows what belongs there: disc, ring, glow, starburst.");
    LAYER_MEAN = error("layer-mean", "Every layer has the mean density of its kind.");
    NORMAL_UNIT = error("normal-unit", "Every normal of the layers is a unit vector that points upwards, on every level.");
    NORMAL_SLOPE = error("normal-slope", "The normals of the layers are those of a surface as high as their density.");
    RANK_FLAT = error("rank-flat", "Every rank is equally often in a layer.");
    RANK_ORDER = error("rank-order", "The rank never falls as the density rises.");
    SPRITE_BORDER = error("sprite-border", "No cell of the sprites is opaque along its border, on any level.");
    SPRITE_LEVEL = error("sprite-level", "Every level of the sprites is the mean of the texels above, cell by cell.");
    SPRITE_CELLS = error("sprite-cells", "Every cell of the sprites shows something, and none is full.");
    SPRITE_GREY = warning("sprite-grey", "The grey of every sprite has the mean 0.5.");
    SPRITE_CORE = warning("sprite-core", "Puffs of the sprites have a solid core.");
    SPRITE_FLAT = warning("sprite-flat", "The flat-bottomed sprite has a flat bottom.");
    SPRITE_FOG = warning("sprite-fog", "Foggy sprites are smoother than puffs.");
    SKYBOX_RANGE = error("skybox-range", "Radiance is finite and not negative, and the cover between 0 and 1.");
    SKYBOX_SEAM = warning("skybox-seam", "Across the 12 edges of the cube the picture changes no more than beside them.");
    SKYBOX_CLIP = warning("skybox-clip", "No texel of the skybox is as bright as a half float can be: light was cut there.");
    CATALOGUE_RECORD = error("catalogue-record", "Every star of the catalogue is marked as one, there is one at least, and nothing follows them.");
    CATALOGUE_ORDER = error("catalogue-order", "No star of the catalogue is brighter than the one before it.");
    CATALOGUE_FLICKER = error("catalogue-flicker", "Every star of the catalogue flickers, and none faster or slower than stars do.");
    FIELD_FILE = error("field-file", "The field of clouds is a glTF file as the format describes it, with the counts of the manifest.");
    FIELD_RANGE = error("field-range", "Every number of the field is finite and in its range.");
    FIELD_INDEX = error("field-index", "Every sprite names a picture of the sheet and a box of its cloud, and every box a shading group.");
    FIELD_BOXES = error("field-boxes", "The centre of every sprite is in its box.");
    FIELD_CULL = error("field-cull", "No two sprites of a cloud are nearer than the smaller cull distance of their boxes.");
    FIELD_RANK = error("field-rank", "The clouds are in the order of their ranks, which are between 0 and 1.");
    FIELD_HOURS = error("field-hours", "The light of the clouds is in the order of time, and its numbers in range.");
    FIELD_SPREAD = error("field-spread", "The ranks of the clouds differ, so that they come one after another.");
    FIELD_EXPOSURE = error("field-exposure", "Each sprite has the light that the clouds around it leave.");
    FIELD_SIZE = error("field-size", "No sprite is far larger than its cloud.");
    FIELD_LIGHT = error("field-light", "There is an hour with light on the clouds.");
    FIELD_COUNTS = warning("field-counts", "Clouds have 5 to 400 sprites, boxes 1 to 100, and sections 20 to 200 boxes.");
}
