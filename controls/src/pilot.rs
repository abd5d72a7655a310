//! Looking and flying: what mouse and keys do to the viewpoint.

use glam::Vec3;

use crate::settings::{Settings, Viewpoint};

/// Eyes of a person who stands, in metres.
const LEAST_UP_M: f32 = 1.7;
/// Where the air is too thin for clouds, in metres.
const MOST_UP_M: f32 = 20_000.0;
/// Degrees a second that keys turn the view at a field of view of 60 degrees.
const TURN_DEG_S: f32 = 45.0;
/// The slowest and the fastest flight, in metres a second.
const SPEED_M_S: [f32; 2] = [5.0, 2_000.0];
/// Speed with the key for haste.
const HASTE: f32 = 5.0;

/// Keys that are held, each as -1, 0 or 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Keys {
    /// Turns to the right.
    pub turn_right: f32,
    /// Looks up.
    pub turn_up: f32,
    /// Flies forward.
    pub forward: f32,
    /// Flies to the right.
    pub right: f32,
    /// Flies up.
    pub up: f32,
    /// Faster.
    pub haste: bool,
}

/// Moves the viewpoint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pilot {
    /// Whether keys move the viewer; if not, they only turn.
    pub flying: bool,
    /// Speed in metres a second.
    pub speed_m_s: f32,
}

impl Default for Pilot {
    fn default() -> Pilot {
        Pilot {
            flying: false,
            speed_m_s: 100.0,
        }
    }
}

impl Pilot {
    /// A drag by so many pixels on a picture of this height: what is under the pointer stays under it, near the middle.
    pub fn drag(view: &mut Viewpoint, [right_px, down_px]: [f32; 2], height_px: f32) {
        let deg_a_px = view.fov_deg / height_px.max(1.0);
        // Towards the zenith, a step on the screen is more degrees of azimuth.
        let widening = view.elevation_deg.to_radians().cos().max(0.2);
        turn(view, -right_px * deg_a_px / widening, down_px * deg_a_px);
    }

    /// A turn of the wheel, in notches away from the person: a narrower view.
    pub fn zoom(view: &mut Viewpoint, notches: f32) {
        view.fov_deg = (view.fov_deg * 0.9_f32.powf(notches)).clamp(1.0, 150.0);
    }

    /// A turn of the wheel while flying: faster by a quarter a notch.
    pub fn accelerate(&mut self, notches: f32) {
        let [slow, fast] = SPEED_M_S;
        self.speed_m_s = (self.speed_m_s * 1.25_f32.powf(notches)).clamp(slow, fast);
    }

    /// Keys held for `seconds`.
    pub fn advance(&self, settings: &mut Settings, keys: Keys, seconds: f32) {
        let view = &mut settings.view;
        let turned_deg = TURN_DEG_S * view.fov_deg / 60.0 * seconds;
        turn(
            view,
            keys.turn_right * turned_deg,
            keys.turn_up * turned_deg,
        );
        if self.flying {
            let haste = if keys.haste { HASTE } else { 1.0 };
            self.fly(view, keys, haste * self.speed_m_s * seconds);
        }
    }

    fn fly(&self, view: &mut Viewpoint, keys: Keys, way_m: f32) {
        let (sin_azimuth, cos_azimuth) = view.azimuth_deg.to_radians().sin_cos();
        let (sin_elevation, cos_elevation) = view.elevation_deg.to_radians().sin_cos();
        // East, up, north.
        let forward = Vec3::new(
            sin_azimuth * cos_elevation,
            sin_elevation,
            cos_azimuth * cos_elevation,
        );
        let right = Vec3::new(cos_azimuth, 0.0, -sin_azimuth);
        let along = forward * keys.forward + right * keys.right + Vec3::Y * keys.up;
        let [east, up, north] = (along.normalize_or_zero() * way_m).to_array();
        let range = |place_m: f32| place_m.clamp(-1e6, 1e6);
        view.east_m = range(view.east_m + east);
        view.north_m = range(view.north_m + north);
        view.up_m = (view.up_m + up).clamp(LEAST_UP_M, MOST_UP_M);
    }
}

fn turn(view: &mut Viewpoint, right_deg: f32, up_deg: f32) {
    view.azimuth_deg = (view.azimuth_deg + right_deg).rem_euclid(360.0);
    view.elevation_deg = (view.elevation_deg + up_deg).clamp(-90.0, 90.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_flies_where_one_looks() {
        let pilot = Pilot {
            flying: true,
            ..Pilot::default()
        };
        let ahead = Keys {
            forward: 1.0,
            ..Keys::default()
        };
        let mut settings = Settings::default();
        settings.view.azimuth_deg = 90.0;
        settings.view.elevation_deg = 30.0;
        pilot.advance(&mut settings, ahead, 10.0);
        let view = settings.view;
        // A kilometre: its cosine and its sine of 30 degrees.
        assert!((view.east_m - 866.025).abs() < 0.01 && view.north_m.abs() < 0.01);
        assert!((view.up_m - 500.0).abs() < 0.01);
        // The camera agrees.
        let forward = settings.camera([2, 1]).rays().forward;
        let way = settings.camera([2, 1]).position_m() / 1000.0;
        assert!(way.abs_diff_eq(forward, 1e-4), "{way} {forward}");
    }

    #[test]
    fn without_flying_keys_only_turn() {
        let keys = Keys {
            turn_right: 1.0,
            turn_up: -1.0,
            forward: 1.0,
            ..Keys::default()
        };
        let mut settings = Settings::default();
        Pilot::default().advance(&mut settings, keys, 1.0);
        let view = settings.view;
        assert_eq!([view.azimuth_deg, view.elevation_deg], [225.0, -20.0]);
        assert_eq!([view.east_m, view.up_m, view.north_m], [0.0; 3]);
    }

    #[test]
    fn what_is_dragged_stays_under_the_pointer() {
        let mut view = Viewpoint {
            elevation_deg: 0.0,
            ..Viewpoint::default()
        };
        Pilot::drag(&mut view, [10.0, 10.0], 600.0);
        assert_eq!([view.azimuth_deg, view.elevation_deg], [179.0, 1.0]);
    }

    #[test]
    fn every_range_holds() {
        let mut settings = Settings::default();
        let pilot = Pilot {
            flying: true,
            speed_m_s: 2_000.0,
        };
        let down = Keys {
            turn_up: 1.0,
            up: -1.0,
            haste: true,
            ..Keys::default()
        };
        pilot.advance(&mut settings, down, 1e4);
        assert_eq!(settings.view.elevation_deg, 90.0);
        assert_eq!(settings.view.up_m, LEAST_UP_M);
        Pilot::zoom(&mut settings.view, 1e3);
        assert_eq!(settings.view.fov_deg, 1.0);
    }
}
