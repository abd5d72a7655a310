//! What a bake tells without failing.

use std::fmt;

/// What was done to somebody's picture, and what would keep it as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Notice {
    /// The skybox is brighter than a half float holds, and was cut there.
    SkyboxClipped(Clipped),
    /// A catalogue has more stars than a pack has room for.
    StarsDropped(Dropped),
}

/// Stars that were left out, the faintest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dropped {
    /// Stars of the catalogue.
    pub found: usize,
    /// Those that the pack has.
    pub kept: usize,
    /// Magnitude of the faintest that was kept.
    pub magnitude: f64,
}

/// The light of a skybox that a half float does not hold: more than 65504 (IEEE 754-2019, binary16).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clipped {
    /// Texels of the faces that were cut.
    pub texels: usize,
    /// Share of the light of the whole picture, as luminance over the solid angle, that was cut, 0..1.
    pub share: f32,
    /// The largest radiance that was cut, as it was after the gain; 0 if none was.
    pub brightest: f32,
    /// The gain that was used.
    pub gain: f32,
    /// The largest gain that keeps all of it, if the recipe may have one so small.
    pub keeping_gain: Option<f32>,
    /// Texels of the picture whose light nobody knows: infinity, which counted as 65504 before the gain.
    pub infinite: usize,
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Notice::SkyboxClipped(clipped) => clipped.fmt(f),
            Notice::StarsDropped(Dropped {
                found,
                kept,
                magnitude,
            }) => write!(
                f,
                "stars.catalogue: of {found} stars the faintest {} were left out, beyond magnitude {magnitude:.2}; a pack has room for {kept}",
                found - kept
            ),
        }
    }
}

impl fmt::Display for Clipped {
    /// One line for whoever wrote the recipe.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Clipped {
            texels,
            share,
            brightest,
            gain,
            keeping_gain,
            infinite,
        } = *self;
        if texels > 0 {
            write!(
                f,
                "skybox: {texels} texels are brighter than the 65504 that a half float holds, up to {brightest:.0} with `skybox.gain = {gain}`: \
                 {:.3} % of the light was cut; ",
                100.0 * share
            )?;
            match keeping_gain {
                Some(gain) => write!(f, "`skybox.gain = {gain}` keeps all of it")?,
                None => write!(f, "no gain keeps all of it, so make the picture darker")?,
            }
        }
        if infinite > 0 {
            let also = if texels > 0 { "; " } else { "skybox: " };
            write!(
                f,
                "{also}{infinite} texels of the picture are infinite and count as 65504; save it with 32 bits a channel to keep their light"
            )?;
        }
        Ok(())
    }
}
