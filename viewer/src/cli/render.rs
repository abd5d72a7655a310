//! The options of `welkin-view render`.

use std::path::PathBuf;

use clap::{ArgMatches, Args, ValueEnum};
use welkin_controls::Viewpoint;
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_viewer::headless::View;

use super::clear_sky::ClearSkyArgs;
use super::clouds::{CloudArgs, OWNERS};
use super::export::{ExportArgs, Shot};
use super::lit::{self, LitArgs};
use super::sprites::{self, SpriteArgs};
use super::values::{azimuth_deg, elevation_deg, fov_deg, oktas, place_m, seconds, size, unit};
use super::weather::WeatherArgs;
use super::{belongs, is_given};

#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Folder of the pack
    pub pack: PathBuf,
    /// Picture to write; its name ends in .png, .exr or .hdr. A file of that name is replaced. With --cubemap a .ktx2 or a folder,
    /// with --frames a folder
    #[arg(short, long, value_name = "FRAME.png|.exr|.hdr")]
    pub output: PathBuf,
    /// Pixels, width by height
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    /// How the clouds are made
    #[arg(long, value_enum, default_value_t = MethodName::Packed)]
    pub method: MethodName,
    /// Moment of the animation, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = seconds, allow_hyphen_values = true)]
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
    pub lit: LitArgs,
    #[command(flatten)]
    pub sprites: SpriteArgs,
    #[command(flatten)]
    pub weather: WeatherArgs,
    #[command(flatten)]
    pub camera: CameraArgs,
    #[command(flatten)]
    pub export: ExportArgs,
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
    /// Mukhina and Bezgodov: layers of three kinds, lit by sun and moon
    Lit,
    /// Wang: clouds in space, made of sprites
    Sprites,
}

impl From<MethodName> for Method {
    fn from(name: MethodName) -> Method {
        match name {
            MethodName::Packed => Method::Packed,
            MethodName::Octaves => Method::Octaves,
            MethodName::Fbm => Method::Fbm,
            MethodName::Lit => Method::Lit,
            MethodName::Sprites => Method::Sprites,
        }
    }
}

/// The six parameters of Roden and Parberry. All go from 0 to 1.
#[derive(Debug, Args)]
#[command(next_help_heading = "Sky, each from 0 to 1")]
pub struct SkyArgs {
    /// Cloud cover: 0 none, 1 all
    #[arg(long, value_name = "C", default_value_t = SkyParams::default().cover, value_parser = unit, allow_hyphen_values = true)]
    pub cover: f32,
    /// The cover that shows so many eighths of cloud on average, 0 to 8: 0 none, 8 all
    #[arg(long, value_name = "N", conflicts_with = "cover", value_parser = oktas, allow_hyphen_values = true)]
    pub oktas: Option<f32>,
    /// Height of the clouds: 0 low, 1 high
    #[arg(long, value_name = "H", default_value_t = SkyParams::default().height, value_parser = unit, allow_hyphen_values = true)]
    pub height: f32,
    /// Density of the clouds: 0 thin and bumpy, 1 thick, smooth and dark
    #[arg(long, value_name = "D", default_value_t = SkyParams::default().density, value_parser = unit, allow_hyphen_values = true)]
    pub density: f32,
    /// Amount of red on the clouds of a sunset
    #[arg(long, value_name = "S", default_value_t = SkyParams::default().sunset, value_parser = unit, allow_hyphen_values = true)]
    pub sunset: f32,
    /// Speed of the clouds
    #[arg(long, value_name = "S", default_value_t = SkyParams::default().speed, value_parser = unit, allow_hyphen_values = true)]
    pub speed: f32,
    /// Time of day: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset
    #[arg(long, value_name = "T", default_value_t = SkyParams::default().time, value_parser = unit, allow_hyphen_values = true)]
    pub time: f32,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Sun, stars and background")]
pub struct LightArgs {
    /// Strength of the lens flare, 0 (off) to 1
    #[arg(long, value_name = "F", default_value_t = SkyParams::default().flare, value_parser = unit, allow_hyphen_values = true)]
    pub flare: f32,
    /// Draw the flare's picture of the sun as a starburst, not as a disc
    #[arg(long)]
    pub starburst: bool,
    #[arg(long, value_name = "S", value_parser = unit, allow_hyphen_values = true, help = skybox_help())]
    pub skybox: Option<f32>,
    /// Leave out the sun's disc and glow
    #[arg(long)]
    pub no_sun: bool,
    /// Leave out stars and galaxy
    #[arg(long)]
    pub no_stars: bool,
}

fn skybox_help() -> String {
    let usual = SkyParams::default().skybox;
    format!(
        "How far the pack's skybox takes the place of the computed sky, 0 to 1 [default: {usual}, where the pack has one]"
    )
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraArgs {
    /// Azimuth of the view, from north (0) towards east (90), -360 to 360 [default: 180; 0 with --equirect]
    #[arg(long, value_name = "DEG", value_parser = azimuth_deg, allow_hyphen_values = true)]
    pub azimuth: Option<f32>,
    /// Elevation of the view, -90 to 90: 0 is the horizon, 90 the zenith
    #[arg(long, value_name = "DEG", default_value_t = Viewpoint::default().elevation_deg, value_parser = elevation_deg, allow_hyphen_values = true)]
    pub elevation: f32,
    /// Vertical field of view, 1 to 150
    #[arg(long, value_name = "DEG", default_value_t = Viewpoint::default().fov_deg, value_parser = fov_deg, allow_hyphen_values = true)]
    pub fov: f32,
    /// Where the viewer stands, metres to the east, -1000000 to 1000000
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = place_m, allow_hyphen_values = true)]
    pub east: f32,
    /// Metres to the north, of the same range
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = place_m, allow_hyphen_values = true)]
    pub north: f32,
    /// Metres up, of the same range
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = place_m, allow_hyphen_values = true)]
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

    /// What becomes of it.
    ///
    /// # Errors
    /// That the name of the output does not suit it.
    pub fn shot(&self) -> Result<Shot, String> {
        self.export.shot(&self.output)
    }

    fn params(&self) -> SkyParams {
        let method = Method::from(self.method);
        // Its range is not the same for every method that has it.
        let interval = |of| self.clouds.formation_interval.filter(|_| of == method);
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
            method,
            octaves: self.clouds.octave_params(interval(Method::Octaves)),
            fbm: self.clouds.fbm_params(),
            lit: self.lit.params(interval(Method::Lit)),
            sprites: self.sprites.params(),
            weather: self.weather.params(self.at),
            shadow_extent_m: self.lit.shadow_extent_m(),
            sun: !self.light.no_sun,
            stars: !self.light.no_stars,
            flare: self.light.flare,
            starburst: self.light.starburst,
            skybox: self.light.skybox.unwrap_or(SkyParams::default().skybox),
            ..SkyParams::default()
        }
    }

    /// An option that the method would not look at is a mistake, and told.
    ///
    /// # Errors
    /// Which option it is, and whose; or that its value is not for this method.
    pub fn refuse_others(&self, given: &ArgMatches) -> Result<(), String> {
        self.clear_sky.refuse_others(given)?;
        let (rain, flare) = (self.weather.rain, self.light.flare);
        self.export.refuse_others(given, rain, flare)?;
        if self.export.is_used() {
            self.shot()?;
        }
        let method = Method::from(self.method);
        let stray =
            owners().find(|(option, owners)| is_given(given, option) && !owners.contains(&method));
        let Some((option, owners)) = stray else {
            return self.check_interval();
        };
        let owners = owners.iter().map(|m| m.name()).collect::<Vec<_>>();
        Err(belongs(
            &option.replace('_', "-"),
            &format!("--method {}", owners.join(" or ")),
            &format!("--method {}", method.name()),
            "change the method",
        ))
    }

    /// All other values are in their ranges when they have been read.
    fn check_interval(&self) -> Result<(), String> {
        self.params().check().map_err(|error| {
            format!(
                "--formation-interval is {}, with --method {} expected {} seconds",
                error.found,
                Method::from(self.method).name(),
                error.expected
            )
        })
    }
}

/// The options that some methods know and others do not, and the methods that know them.
fn owners() -> impl Iterator<Item = (&'static str, &'static [Method])> {
    let (lit, sprites): (&[Method], &[Method]) = (&[Method::Lit], &[Method::Sprites]);
    OWNERS
        .into_iter()
        .chain(lit::OPTIONS.map(|option| (option, lit)))
        .chain(sprites::OPTIONS.map(|option| (option, sprites)))
}

impl CameraArgs {
    fn camera(&self, size: [u32; 2]) -> Camera {
        self.viewpoint().camera(size)
    }

    fn viewpoint(&self) -> Viewpoint {
        Viewpoint {
            azimuth_deg: self.azimuth.unwrap_or(Viewpoint::default().azimuth_deg),
            elevation_deg: self.elevation,
            fov_deg: self.fov,
            east_m: self.east,
            north_m: self.north,
            up_m: self.up,
        }
    }
}

#[cfg(test)]
mod tests;
