//! Twin of perez.wgsl, and skies to look at it under.

use std::f32::consts::{FRAC_PI_2, TAU};

use glam::Vec3;
use welkin_pack::Pack;
use welkin_runtime::internals::clear_sky::perez::PerezUniforms;
use welkin_runtime::internals::clear_sky::perez::{
    DAYLIGHT, LEAST_COSINE, RGB_OF_XYZ, TO_DAYLIGHT, acos,
};
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::params::{PerezParams, PerezShape, SkyModel};
use welkin_runtime::{Camera, SkyParams};

use crate::pack;

/// Luminance and the published chromaticities x and y along a unit direction.
pub fn colour(perez: &PerezUniforms, direction: Vec3) -> Vec3 {
    let cosine = direction.dot(perez.sun_direction).clamp(-1.0, 1.0);
    let exp2 = |v: Vec3| Vec3::from(v.to_array().map(libm::exp2f));
    let gradation =
        1.0 + perez.a.truncate() * exp2(perez.b.truncate() / direction.y.max(LEAST_COSINE));
    let aureole = perez.c.truncate() * exp2(perez.d.truncate() * acos(cosine));
    let indicatrix = perez.base.truncate() + aureole + perez.e.truncate() * (cosine * cosine);
    perez.zenith.truncate() * gradation * indicatrix
}

/// Linear BT.709 of a luminance with the published chromaticities x and y, before what is negative is cut off.
pub fn linear(colour: Vec3) -> Vec3 {
    let Vec3 {
        x: luminance,
        y: x,
        z: y,
    } = colour;
    let [constant, factor, of_square] = DAYLIGHT;
    let daylight = constant + factor * x + of_square * x * x;
    let y = y + TO_DAYLIGHT * (daylight - y);
    let [of_x, of_y, of_z] = RGB_OF_XYZ;
    (of_x * x + of_y * y + of_z * (1.0 - x - y)) * (luminance / y)
}

/// Radiance of the clear sky along a unit direction, whose gradient alone is `gradient`.
pub fn light(perez: &PerezUniforms, direction: Vec3, gradient: Vec3) -> Vec3 {
    let share = perez.weight;
    if share == 0.0 {
        return gradient;
    }
    let light = linear(colour(perez, direction)).max(Vec3::ZERO);
    gradient.lerp(light, share)
}

/// A pack whose sun culminates in the zenith, so that one half day takes it to the nadir.
pub fn overhead() -> Pack {
    pack::changed_pack(Some(FRAC_PI_2), |_, _| {})
}

/// The frame's constants of a cloudless Perez sky. With the sun that rises to the zenith, it stands `360 (0.5 - time)`
/// degrees from it.
pub fn uniforms(facts: &PackData, shape: PerezShape, turbidity: f32, time: f32) -> Uniforms {
    let params = SkyParams {
        sky: SkyModel::Perez,
        perez: PerezParams { shape, turbidity },
        cover: 0.0,
        time,
        ..SkyParams::default()
    };
    assert_eq!(params.check(), Ok(()));
    let camera = Camera::looking(0.0, 0.0, 1.0, [64, 48]);
    facts.uniforms(&params, &camera, 0.0, 0.0)
}

/// The time at which the sun of [`overhead`] stands at that elevation, in the afternoon.
pub fn time_of(elevation_deg: f32) -> f32 {
    0.75 - elevation_deg / 360.0
}

/// Azimuth from north towards east.
pub fn direction(azimuth_rad: f32, sin_elevation: f32) -> Vec3 {
    let across = (1.0 - sin_elevation * sin_elevation).sqrt();
    Vec3::new(
        across * azimuth_rad.sin(),
        sin_elevation,
        -across * azimuth_rad.cos(),
    )
}

/// Directions all over the hemisphere, each for the same solid angle.
pub fn hemisphere(rings: u32, sectors: u32) -> impl Iterator<Item = Vec3> {
    let middle = |index: u32, count: u32| (index as f32 + 0.5) / count as f32;
    (0..rings).flat_map(move |ring| {
        (0..sectors).map(move |s| direction(TAU * middle(s, sectors), middle(ring, rings)))
    })
}
