//! What can be set: the sky, and which cameras see it.

use bevy::camera::Exposure;
use bevy::prelude::*;
use serde::{Deserialize, Serialize};
use welkin_runtime::{Axes, SkyParams};

use crate::pack::WelkinPack;

/// Luminance in cd/m2 that a radiance of 1 stands for by default: that of the default pack with the sun at 60 degrees, see
/// [`SkyLight::unit_cd_m2`](welkin_runtime::SkyLight::unit_cd_m2).
pub const UNIT_CD_M2: f32 = 32_000.0;

/// The exposure for a day, EV100 13.3: a radiance of 1 is 2.6 in the target, which is the runtime's own default. Bevy's example of an atmosphere has 13.
pub const DAYLIGHT: Exposure = Exposure { ev100: 13.3 };

/// What the sky of one camera shall look like: a component of that camera, in place of [`GlobalWelkinSky`].
#[derive(Component, Clone, Copy, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Component, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct WelkinSky {
    /// Clouds, hour, weather and all else that is of the sky.
    ///
    /// Its exposure is not looked at: that of the camera is. Neither is its tone curve, where the camera's own [`Tonemapping`](bevy::core_pipeline::tonemapping::Tonemapping)
    /// is known to both.
    pub params: Params,
    /// Luminance in cd/m2 that a radiance of 1 stands for, over 0. With one number for all hours, nights are as dark as an eye that adapts sees
    /// them. For physical luminance write [`SkyLight::unit_cd_m2`](welkin_runtime::SkyLight::unit_cd_m2) of [`WelkinViewLight`](crate::WelkinViewLight)
    /// here each frame, and let the camera adapt.
    pub unit_cd_m2: f32,
    /// Metres that a unit of the world is long, over 0. The ground is at a height of 0.
    pub metres_per_unit: f32,
    /// Seconds that are added to those of [`Time`], by which clouds move and stars turn: any number, such as the one of a saved game.
    pub seconds: f64,
}

impl Default for WelkinSky {
    fn default() -> WelkinSky {
        WelkinSky {
            params: Params::default(),
            unit_cd_m2: UNIT_CD_M2,
            metres_per_unit: 1.0,
            seconds: 0.0,
        }
    }
}

impl WelkinSky {
    /// Axes and unit of the world; what is no length counts as a metre.
    pub(crate) fn axes(&self) -> Axes {
        let [up, north] = [Vec3::Y, Vec3::NEG_Z].map(sky_vec3);
        Axes::new(up, north, self.metres_per_unit).unwrap_or(Axes::Y_UP)
    }

    /// The number of seconds that is drawn.
    pub(crate) fn at(&self, time: &Time) -> f64 {
        self.seconds + time.elapsed_secs_f64()
    }

    /// cd/m2 of a radiance of 1; what is no positive number counts as the default.
    pub(crate) fn unit(&self) -> f32 {
        match self.unit_cd_m2.is_finite() && self.unit_cd_m2 > 0.0 {
            true => self.unit_cd_m2,
            false => UNIT_CD_M2,
        }
    }
}

/// What the sky of every camera shall look like that has no [`WelkinSky`] of its own.
#[derive(
    Resource,
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Deref,
    DerefMut,
    Reflect,
    Serialize,
    Deserialize,
)]
#[reflect(Resource, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct GlobalWelkinSky(pub WelkinSky);

/// The parameters of [`welkin_runtime`], opaque for reflection: it reads and writes them whole, by serde.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Deref, DerefMut, Reflect, Serialize, Deserialize,
)]
#[reflect(opaque)]
#[reflect(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Params(pub SkyParams);

impl From<SkyParams> for Params {
    fn from(params: SkyParams) -> Params {
        Params(params)
    }
}

/// A camera that sees the sky of a pack. Its projection is a perspective; an orthographic one sees none.
///
/// Give it an [`Exposure`] for daylight, such as [`DAYLIGHT`]: that of Bevy's cameras by default is a room's, in which every sky is white.
///
/// With [`AtmosphereSettings`](bevy::pbr::AtmosphereSettings) on the same camera, Bevy draws the clear sky, and this one clouds, stars and moon over it.
#[derive(Component, Clone, Debug, Reflect)]
#[reflect(Component, Clone, Debug)]
pub struct WelkinView(pub Handle<WelkinPack>);

/// A vector of Bevy's as one of the sky's, which are of another version of glam.
pub(crate) fn sky_vec3(vector: Vec3) -> welkin_runtime::glam::Vec3 {
    vector.to_array().into()
}

/// And back.
pub(crate) fn bevy_vec3(vector: welkin_runtime::glam::Vec3) -> Vec3 {
    vector.to_array().into()
}

pub(crate) fn build(app: &mut App) {
    app.init_resource::<GlobalWelkinSky>()
        .register_type::<GlobalWelkinSky>()
        .register_type::<WelkinSky>()
        .register_type::<WelkinView>();
}
