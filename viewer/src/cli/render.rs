//! The options of `welkin-view render`.

use std::path::PathBuf;

use clap::{ArgMatches, Args, ValueEnum};
use welkin_runtime::{Camera, FbmParams, Method, OctaveParams, SkyParams};
use welkin_viewer::headless::View;

use super::clear_sky::ClearSkyArgs;
use super::values::{
    azimuth_deg, elevation_deg, formation_interval_s, fov_deg, octaves, oktas, place_m, seconds,
    size, three_units, unit,
};
use super::{belongs, is_given};

#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Folder of the pack
    pub pack: PathBuf,
    /// Picture to write; its name ends in .png or .exr. A file of that name is replaced
    #[arg(short, long, value_name = "FRAME.png|.exr")]
    pub output: PathBuf,
    /// Pixels, width by height
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    /// How the clouds are made
    #[arg(long, value_enum, default_value_t = MethodName::Packed)]
    pub method: MethodName,
    /// Moment of the animation, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = seconds, allow_negative_numbers = true)]
    pub at: f64,
    #[command(flatten)]
    pub sky: SkyArgs,
    #[command(flatten)]
    pub clear_sky: ClearSkyArgs,
    #[command(flatten)]
    pub light: LightArgs,
    #[command(flatten)]
    pub clouds: CloudArgs,
    #[command(flatten)]
    pub camera: CameraArgs,
}

/// How the clouds are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// Roden and Parberry: one packed cloud texture
    Packed,
    /// USC: octaves of white noise that form anew, on three domes
    Octaves,
    /// Quilez: octaves of smooth noise that drift, lit by a short march towards the sun
    Fbm,
}

impl From<MethodName> for Method {
    fn from(name: MethodName) -> Method {
        match name {
            MethodName::Packed => Method::Packed,
            MethodName::Octaves => Method::Octaves,
            MethodName::Fbm => Method::Fbm,
        }
    }
}

/// The six parameters of Roden and Parberry. All go from 0 to 1.
#[derive(Debug, Args)]
#[command(next_help_heading = "Sky, each from 0 to 1")]
pub struct SkyArgs {
    /// Cloud cover: 0 none, 1 all
    #[arg(long, value_name = "C", default_value_t = SkyParams::default().cover, value_parser = unit, allow_negative_numbers = true)]
    pub cover: f32,
    /// The cover that shows so many eighths of cloud on average, 0 to 8: 0 none, 8 all
    #[arg(long, value_name = "N", conflicts_with = "cover", value_parser = oktas, allow_negative_numbers = true)]
    pub oktas: Option<f32>,
    /// Height of the clouds: 0 low, 1 high
    #[arg(long, value_name = "H", default_value_t = SkyParams::default().height, value_parser = unit, allow_negative_numbers = true)]
    pub height: f32,
    /// Density of the clouds: 0 thin and bumpy, 1 thick, smooth and dark
    #[arg(long, value_name = "D", default_value_t = SkyParams::default().density, value_parser = unit, allow_negative_numbers = true)]
    pub density: f32,
    /// Amount of red on the clouds of a sunset
    #[arg(long, value_name = "S", default_value_t = SkyParams::default().sunset, value_parser = unit, allow_negative_numbers = true)]
    pub sunset: f32,
    /// Speed of the clouds
    #[arg(long, value_name = "S", default_value_t = SkyParams::default().speed, value_parser = unit, allow_negative_numbers = true)]
    pub speed: f32,
    /// Time of day: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset
    #[arg(long, value_name = "T", default_value_t = SkyParams::default().time, value_parser = unit, allow_negative_numbers = true)]
    pub time: f32,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Sun, stars and background")]
pub struct LightArgs {
    /// Strength of the lens flare, 0 (off) to 1
    #[arg(long, value_name = "F", default_value_t = SkyParams::default().flare, value_parser = unit, allow_negative_numbers = true)]
    pub flare: f32,
    #[arg(long, value_name = "S", value_parser = unit, allow_negative_numbers = true, help = skybox_help())]
    pub skybox: Option<f32>,
    /// Leave out the sun's disc and glow
    #[arg(long)]
    pub no_sun: bool,
    /// Leave out stars and galaxy
    #[arg(long)]
    pub no_stars: bool,
}

/// What some methods know and others do not: see [`OWNERS`].
#[derive(Debug, Args)]
#[command(next_help_heading = "Clouds of one method")]
pub struct CloudArgs {
    /// packed: amount of a thin upper layer, 0 (none) to 1
    #[arg(long, value_name = "U", default_value_t = SkyParams::default().upper_layer, value_parser = unit, allow_negative_numbers = true)]
    pub upper: f32,
    /// octaves: how many are summed, 1 to 8
    #[arg(long, value_name = "N", default_value_t = OctaveParams::default().count, value_parser = octaves, allow_negative_numbers = true)]
    pub octaves: u32,
    /// octaves: seconds in which clouds form anew, 0.1 to 86400
    #[arg(long, value_name = "SECONDS", default_value_t = OctaveParams::default().formation_interval_s, value_parser = formation_interval_s, allow_negative_numbers = true)]
    pub formation_interval: f32,
    #[arg(long, value_name = "LOW,MIDDLE,HIGH", value_parser = three_units, allow_hyphen_values = true, help = domes_help())]
    pub domes: Option<[f32; 3]>,
    #[arg(long, value_name = "S", value_parser = unit, allow_negative_numbers = true, help = sharpness_help())]
    pub sharpness: Option<f32>,
    /// fbm: colours of the clouds
    #[arg(long, value_enum, default_value_t = Palette::Fair)]
    pub palette: Palette,
    /// fbm: reflectance where the light comes through, linear, each 0 to 1 [default: the palette's]
    #[arg(long, value_name = "R,G,B", value_parser = three_units, allow_hyphen_values = true)]
    pub lit: Option<[f32; 3]>,
    /// fbm: reflectance where clouds shade themselves, linear, each 0 to 1 [default: the palette's]
    #[arg(long, value_name = "R,G,B", value_parser = three_units, allow_hyphen_values = true)]
    pub shaded: Option<[f32; 3]>,
}

fn skybox_help() -> String {
    let usual = SkyParams::default().skybox;
    format!(
        "How far the pack's skybox takes the place of the computed sky, 0 to 1 [default: {usual}, where the pack has one]"
    )
}

fn domes_help() -> String {
    let [low, middle, high] = OctaveParams::default().domes;
    format!(
        "octaves: cover of each dome as a share of --cover, 0 to 1; 0 leaves it out [default: {low},{middle},{high}]"
    )
}

fn sharpness_help() -> String {
    let [octaves, fair, stormy] = [
        OctaveParams::default().sharpness,
        FbmParams::FAIR.sharpness,
        FbmParams::STORMY.sharpness,
    ];
    format!(
        "octaves, fbm: how sharply clouds end, 0 to 1 \
         [default: {octaves} for octaves, {fair} for fbm, {stormy} with the stormy palette]"
    )
}

/// Colours of [`Method::Fbm`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Palette {
    /// White clouds with grey undersides
    Fair,
    /// Two dark greys
    Stormy,
}

/// The options of [`CloudArgs`], and the methods that know them.
const OWNERS: [(&str, &[Method]); 8] = [
    ("upper", &[Method::Packed]),
    ("octaves", &[Method::Octaves]),
    ("formation_interval", &[Method::Octaves]),
    ("domes", &[Method::Octaves]),
    ("sharpness", &[Method::Octaves, Method::Fbm]),
    ("palette", &[Method::Fbm]),
    ("lit", &[Method::Fbm]),
    ("shaded", &[Method::Fbm]),
];

#[derive(Debug, Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraArgs {
    /// Azimuth of the view, from north (0) towards east (90), -360 to 360
    #[arg(long, value_name = "DEG", default_value_t = 180.0, value_parser = azimuth_deg, allow_negative_numbers = true)]
    pub azimuth: f32,
    /// Elevation of the view, -90 to 90: 0 is the horizon, 90 the zenith
    #[arg(long, value_name = "DEG", default_value_t = 25.0, value_parser = elevation_deg, allow_negative_numbers = true)]
    pub elevation: f32,
    /// Vertical field of view, 1 to 150
    #[arg(long, value_name = "DEG", default_value_t = 60.0, value_parser = fov_deg, allow_negative_numbers = true)]
    pub fov: f32,
    /// Where the viewer stands, metres to the east, -1000000 to 1000000
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = place_m, allow_negative_numbers = true)]
    pub east: f32,
    /// Metres to the north, of the same range
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = place_m, allow_negative_numbers = true)]
    pub north: f32,
    /// Metres up, of the same range
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = place_m, allow_negative_numbers = true)]
    pub up: f32,
}

impl RenderArgs {
    /// What these options look at.
    pub fn view(&self) -> View {
        View {
            params: self.params(),
            camera: self.camera.camera(self.size),
            seconds: self.at,
        }
    }

    fn params(&self) -> SkyParams {
        SkyParams {
            cover: self.sky.cover,
            height: self.sky.height,
            density: self.sky.density,
            sunset: self.sky.sunset,
            speed: self.sky.speed,
            time: self.sky.time,
            sky: self.clear_sky.sky.into(),
            perez: self.clear_sky.perez_params(),
            upper_layer: self.clouds.upper,
            method: self.method.into(),
            octaves: self.clouds.octave_params(),
            fbm: self.clouds.fbm_params(),
            sun: !self.light.no_sun,
            stars: !self.light.no_stars,
            flare: self.light.flare,
            skybox: self.light.skybox.unwrap_or(SkyParams::default().skybox),
            ..SkyParams::default()
        }
    }

    /// An option that the method would not look at is a mistake, and told.
    ///
    /// # Errors
    /// Which option it is, and whose.
    pub fn refuse_others(&self, given: &ArgMatches) -> Result<(), String> {
        self.clear_sky.refuse_others(given)?;
        let method = Method::from(self.method);
        let stray = OWNERS
            .iter()
            .find(|(option, owners)| is_given(given, option) && !owners.contains(&method));
        let Some((option, owners)) = stray else {
            return Ok(());
        };
        let owners = owners.iter().map(|m| m.name()).collect::<Vec<_>>();
        Err(belongs(
            &option.replace('_', "-"),
            &format!("--method {}", owners.join(" or ")),
            &format!("--method {}", method.name()),
            "change the method",
        ))
    }
}

impl CloudArgs {
    fn octave_params(&self) -> OctaveParams {
        let usual = OctaveParams::default();
        OctaveParams {
            count: self.octaves,
            sharpness: self.sharpness.unwrap_or(usual.sharpness),
            formation_interval_s: self.formation_interval,
            domes: self.domes.unwrap_or(usual.domes),
        }
    }

    fn fbm_params(&self) -> FbmParams {
        let usual = match self.palette {
            Palette::Fair => FbmParams::FAIR,
            Palette::Stormy => FbmParams::STORMY,
        };
        FbmParams {
            sharpness: self.sharpness.unwrap_or(usual.sharpness),
            lit: self.lit.unwrap_or(usual.lit),
            shaded: self.shaded.unwrap_or(usual.shaded),
        }
    }
}

impl CameraArgs {
    fn camera(&self, size: [u32; 2]) -> Camera {
        let [azimuth_rad, elevation_rad, fov_rad] =
            [self.azimuth, self.elevation, self.fov].map(f32::to_radians);
        Camera {
            // North is -Z.
            position_m: [self.east, self.up, -self.north].into(),
            ..Camera::looking(azimuth_rad, elevation_rad, fov_rad, size)
        }
    }
}

#[cfg(test)]
mod tests;
