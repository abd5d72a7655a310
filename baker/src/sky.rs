//! The clear sky: a table of radiance over the sun's elevation, the elevation of view and the azimuth from the sun, for two depths of
//! aerosol.
//!
//! # Theory
//! Sunlight scattered once by air and aerosol is integrated along every line of sight through a spherical atmosphere (E. Bruneton,
//! F. Neyret, "Precomputed Atmospheric Scattering", EGSR 2008, eq. 3-6), with ozone and the earth's shadow, and light scattered more
//! often is taken as isotropic (S. Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020, eq.
//! 5-10), at eight wavelengths. `sky/` holds the physics, [`welkin_pack::air`] the numbers.
//!
//! Stored is luminance over the unit of the hour ([`welkin_pack::air::unit_luminance_cd_m2`]), in linear BT.709.
//!
//! # Changes versus the papers
//! The light that the aureole's phase function is multiplied by is kept apart ([`welkin_pack::mapping::sky_to_texel`] says why), with the colour that it has.
//! A space of three dimensions is enough, since the viewer stands on the ground. The light of the night is added to every layer.
//!
//! # Practice
//! Some 80,000 lines of 28 steps; their steps are prepared once for each elevation of view. Between texels the table is off by 0.4 %
//! rms from the lines by day, 1.3 % at most; by 0.6 % with the sun at 0 to 3 degrees (5 % at most, at the very horizon), 1.3 % in the
//! two degrees below, 2 % down to -6 degrees.

mod atmosphere;
mod geometry;
mod table;

use rayon::prelude::*;
use welkin_pack::air::{Colour, SUN_ILLUMINANCE_LX, unit_luminance_cd_m2};
use welkin_pack::{Image, mapping};

use crate::settings::SkySettings;
use atmosphere::{Atmosphere, Line, Seen, Settings};

/// Share of visible light that the ground reflects: grass, of whose 0.16 to 0.26 (T. R. Oke, "Boundary Layer Climates", 1987, table 1.1)
/// most is infrared.
const GROUND_ALBEDO: f32 = 0.1;

/// Airglow and the other light of a moonless night at the zenith, in cd/m2: 21.8 magnitudes a square arc second (Ch. Leinert and others,
/// "The 1997 reference of diffuse night sky brightness", A&A Suppl. 127, 1998).
const NIGHT_CD_M2: f32 = 2.1e-4;
/// Its colour. It is greenish, but eyes in the dark see blue best (H. W. Jensen, S. Premoze, P. Shirley and others, "Night Rendering", UUCS-00-016,
/// 2000).
const NIGHT_COLOUR: [f32; 3] = [0.62, 1.0, 2.1];
/// How much more of it there is at the horizon, where more of its layer is seen and air takes most of that (P. J. van Rhijn, "On the
/// brightness of the sky at night and the total amount of starlight", 1921).
const NIGHT_RISE: f32 = 1.5;

/// The table's images in the order of [`mapping::SkyLayer`]: linear BT.709 red, green, blue, and nothing.
pub(crate) fn images(settings: &SkySettings) -> Vec<Image> {
    settings
        .aerosol_depths
        .into_iter()
        .flat_map(|depth| Clear::new(depth, settings).images())
        .collect()
}

/// The sky with one depth of aerosol.
struct Clear<'a> {
    atmosphere: Atmosphere,
    colour: Colour,
    settings: &'a SkySettings,
    /// One a row, from horizon to zenith.
    lines: Vec<Line>,
}

impl Clear<'_> {
    fn new(aerosol_depth: f32, settings: &SkySettings) -> Clear<'_> {
        let atmosphere = Atmosphere::new(Settings {
            aerosol_depth,
            ground_albedo: GROUND_ALBEDO,
            ozone: 1.0,
        });
        let size = [settings.width, settings.height];
        let sine = |y: u32| mapping::texel_to_sky([0.0, y as f32], size).0;
        let lines = (0..settings.height)
            .map(|y| atmosphere.line(sine(y)))
            .collect();
        Clear {
            atmosphere,
            colour: Colour::new(),
            settings,
            lines,
        }
    }

    fn images(&self) -> Vec<Image> {
        let suns = self.settings.suns;
        let layers: Vec<[Image; 2]> = (0..suns)
            .into_par_iter()
            .map(|layer| self.layer(mapping::layer_to_sun(layer as f32, suns)))
            .collect();
        layers.into_iter().flatten().collect()
    }

    fn layer(&self, sun_rad: f32) -> [Image; 2] {
        let (width, height) = (self.settings.width, self.settings.height);
        let unit = unit_luminance_cd_m2(sun_rad);
        let scale = SUN_ILLUMINANCE_LX / unit;
        let mut parts = [(); 2].map(|()| Image::new(width, height, 4));
        for (y, line) in (0..height).zip(&self.lines) {
            let low = 1.0 - mapping::texel_to_sky([0.0, y as f32], [width, height]).0;
            let night = NIGHT_CD_M2 / unit * (1.0 + NIGHT_RISE * low * low);
            for x in 0..width {
                let (_, azimuth_cos) = mapping::texel_to_sky([x as f32, 0.0], [width, height]);
                let Seen { radiance, aureole } =
                    self.atmosphere.seen(line, libm::sinf(sun_rad), azimuth_cos);
                for (part, light) in parts.iter_mut().zip([radiance, aureole]) {
                    let rgb = self.colour.rgb(&light).map(|c| c * scale);
                    part.texel_mut(x, y)[..3].copy_from_slice(&rgb);
                }
                let texel = parts[0].texel_mut(x, y);
                for (channel, colour) in texel.iter_mut().zip(NIGHT_COLOUR) {
                    *channel += night * colour;
                }
            }
        }
        parts
    }
}

#[cfg(test)]
mod tests;
