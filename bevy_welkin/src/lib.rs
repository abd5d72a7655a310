//! A moving sky for [Bevy](https://bevy.org), drawn from baked textures by [`welkin_runtime`].
//!
//! On Bevy's own device and in its render schedule: behind the scene, with clouds in depth, for any number of cameras, with multisampling or without, into
//! HDR or display targets. It lights the scene as well: [`WelkinLight`], [`WelkinEnvironment`], [`WelkinAir`] and `WelkinShadows` drive Bevy's own lights
//! and fog.
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_welkin::{DAYLIGHT, GlobalWelkinSky, WelkinAir, WelkinEnvironment, WelkinLight, WelkinPlugin, WelkinView};
//!
//! fn main() {
//!     App::new()
//!         .add_plugins((DefaultPlugins, WelkinPlugin))
//!         .add_systems(Startup, spawn)
//!         .add_systems(Update, |time: Res<Time>, mut sky: ResMut<GlobalWelkinSky>| {
//!             // A day in four minutes.
//!             sky.params.time = (0.3 + time.elapsed_secs() / 240.0).fract();
//!         })
//!         .run();
//! }
//!
//! fn spawn(mut commands: Commands, assets: Res<AssetServer>) {
//!     let pack = assets.load("sky/pack.json");
//!     commands.spawn((
//!         Camera3d::default(),
//!         DAYLIGHT,
//!         WelkinView(pack),
//!         WelkinEnvironment,
//!         WelkinAir,
//!     ));
//!     commands.spawn((DirectionalLight::default(), WelkinLight));
//! }
//! ```
//!
//! # Axes and units
//! Bevy's axes are the sky's: +X east, +Y up, -Z north. A unit of the world is a metre, or [`WelkinSky::metres_per_unit`] of them.
//!
//! A radiance of 1, about the white of a sunlit cloud at noon, stands for [`WelkinSky::unit_cd_m2`], by default [`UNIT_CD_M2`]: at noon the sun of the default
//! pack then gives 108,000 lux to what faces it. Lights are set by the same number, so that sky and scene agree under every [`Exposure`](bevy::camera::Exposure).
//! [`DAYLIGHT`] is one for a day; Bevy's default, EV100 9.7, is for rooms.

mod air;
mod draw;
mod environment;
mod light;
mod pack;
mod render;
mod settings;
#[cfg(feature = "shadows")]
mod shadows;

use bevy::prelude::*;

pub use air::WelkinAir;
pub use environment::WelkinEnvironment;
pub use light::{WelkinLight, WelkinViewLight};
pub use pack::{WelkinPack, WelkinPackError, WelkinPackLoader};
pub use settings::{DAYLIGHT, GlobalWelkinSky, Params, UNIT_CD_M2, WelkinSky, WelkinView};
#[cfg(feature = "shadows")]
pub use shadows::WelkinShadows;
pub use welkin_pack;
pub use welkin_runtime;

/// Draws skies for cameras with a [`WelkinView`], and drives the lights of the scene. Add it after `DefaultPlugins`.
#[derive(Clone, Copy, Debug, Default)]
pub struct WelkinPlugin;

/// What the plugin does in `PostUpdate`, before transforms are propagated.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum WelkinSystems {
    /// Computes the light of each view: [`WelkinViewLight`] is that of this frame after it.
    Light,
    /// Writes it to Bevy's lights, environment maps and fog.
    Drive,
}

impl Plugin for WelkinPlugin {
    fn build(&self, app: &mut App) {
        app.configure_sets(
            PostUpdate,
            (WelkinSystems::Light, WelkinSystems::Drive)
                .chain()
                .before(bevy::transform::TransformSystems::Propagate),
        );
        settings::build(app);
        pack::build(app);
        light::build(app);
        environment::build(app);
        air::build(app);
        #[cfg(feature = "shadows")]
        shadows::build(app);
    }

    // The render world has what is drawn in its schedules by now.
    fn finish(&self, app: &mut App) {
        render::build(app);
        draw::build(app);
        #[cfg(feature = "shadows")]
        shadows::build_render(app);
    }
}
