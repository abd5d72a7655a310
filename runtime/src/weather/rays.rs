//! Crepuscular rays: shafts of light and of shade that fan out from the sun through gaps between clouds.
//!
//! # Theory
//! K. Mitchell, "Volumetric Light Scattering as a Post-Process", GPU Gems 3, 2007, chapter 13: the light that haze scatters
//! towards the viewer is a sum over the way from a pixel to the sun, `exposure sum decay^i weight L_i`, of what is seen there of the source:
//! clouds hide it, and their shade lies along that way.
//!
//! # Changes versus the chapter
//! - The sum is not over the screen but over a map about the sun: columns go once around it, rows away from it, by the chord
//!   `2 sin(angle / 2)`. So a ray is a column, nothing ends at the edge of the screen, and rays stay where they are as the view turns.
//! - The source is bright where it is near the sun, and hidden by the method's own `cloud_layer`; the scene does not hide it.
//! - The sum is divided by that of a clear sky, and the mean of its surroundings is taken away. What is left is streaks: brighter ones
//!   lie over the picture as haze in the light, darker ones as haze in the shade. A clear or an overcast sky has none.
//!
//! # Practice
//! Off by default. Three passes of 256x128 RG8 texels: a look at the clouds a texel, then [`TAPS`] reads, then [`AROUND`].
//! Over the screen one read, an arc tangent and a blend, over the scene too, whatever its depth. It wants a target that
//! can be blended with; on another one there are no rays.

use glam::Vec3;

use crate::clear_sky::light::Light;
use crate::clouds::shared::CloudUniforms;
use crate::device::context::{Context, Shader};
use crate::device::map;
use crate::device::pipeline::Overlay;
use crate::geometry::camera::Rays;
use crate::geometry::math::smoothstep;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::SkyParams;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("RAYS_REACH", Value::F32(REACH)),
        ("RAYS_DECAY", Value::F32(DECAY)),
        ("RAYS_SOURCE", Value::F32(SOURCE)),
        ("RAYS_WINDOW", Value::F32(WINDOW)),
        ("RAYS_GAIN", Value::F32(GAIN)),
        ("RAYS_HORIZON", Value::F32(HORIZON)),
        ("RAYS_GROUND", Value::F32(GROUND)),
        ("RAYS_CORE", Value::F32(CORE)),
        ("RAYS_TAPS", Value::Int(TAPS)),
        ("RAYS_AROUND", Value::Int(AROUND)),
        ("RAYS_TEXEL", Value::Vec2(TEXEL_RAD)),
        ("RAYS_SIZE", Value::Vec2([SIZE[0] as f32, SIZE[1] as f32])),
    ],
    structs: &[RayUniforms::WGSL],
    wgsl: include_str!("rays.wgsl"),
};

uniforms! {
    /// Crepuscular rays.
    RayUniforms {
        /// Unit direction towards the sun.
        sun_direction: Vec3,
        /// Opacity of the strongest ray, 0 without rays.
        opacity: f32,
        /// Unit vector across it, along the horizon.
        right: Vec3,
        /// Halvings of the rays by a chord of 1.
        fall: f32,
        /// The third one, away from the horizon.
        up: Vec3,
        /// 1 / a pixel in the middle of the screen, in 1 / radians.
        pixels_per_rad: f32,
        /// Radiance of haze in the light.
        bright: Vec3,
        /// Nothing.
        _pad_0: f32,
        /// Radiance of haze in the shade.
        dark: Vec3,
        /// Nothing.
        _pad_1: f32,
    }
}

/// Columns, once around the sun, and rows.
pub const SIZE: [u32; 2] = [256, 128];
/// The chord at which rays end: 74 degrees from the sun.
pub const REACH: f32 = 1.2;
/// Sides of a texel in radians: around the sun where the map ends, and away from it.
pub const TEXEL_RAD: [f32; 2] = [
    std::f32::consts::TAU * REACH / SIZE[0] as f32,
    REACH / SIZE[1] as f32,
];
/// Reads of the sum on its way to the sun.
pub const TAPS: i32 = 40;
/// What a step of the sum weighs beside the one before it, which is farther from the sun.
pub const DECAY: f32 = 0.99;
/// How fast the source falls with the square of the place in the map: to a half at 13 degrees.
pub const SOURCE: f32 = 30.0;
/// Reads of the surroundings, and how far they reach to both sides, in turns.
pub const AROUND: i32 = 48;
/// See [`AROUND`].
pub const WINDOW: f32 = 0.11;
/// Contrast of the streaks.
pub const GAIN: f32 = 3.0;
/// Sine of the elevation at which the sky counts wholly as a source.
pub const HORIZON: f32 = 0.06;
/// Sine of the depression at which rays before the ground end.
pub const GROUND: f32 = 0.12;
/// Chord about the sun in which rays come up: at its middle they would all meet.
pub const CORE: f32 = 0.12;

/// Halvings of the rays by a chord of 1.
const FALL: f32 = 1.2;
/// Sunlight and skylight that haze in the light scatters, and skylight that haze in the shade does. Chosen by eye, as are the two above.
const BRIGHT: [f32; 2] = [1.6, 0.6];
const DARK: f32 = 0.4;
/// Opacity of the strongest ray.
const OPACITY: f32 = 0.75;
/// Sines of the sun's elevation between which rays come up.
const RISE: [f32; 2] = [-0.09, 0.02];

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg8Unorm;

/// The rays' share of the uniforms. `params` are in range.
pub fn uniforms(
    params: &SkyParams,
    light: &Light,
    clouds: &CloudUniforms,
    screen: &Rays,
    pixel_rad: f32,
) -> RayUniforms {
    let sun = light.sun_direction;
    let risen = if in_reach(sun, screen) && !light.is_moon {
        smoothstep(RISE[0], RISE[1], sun.y)
    } else {
        0.0
    };
    // A sun at the zenith is as far from every horizon.
    let right = sun.cross(Vec3::Y).normalize_or(Vec3::X);
    RayUniforms {
        sun_direction: sun,
        opacity: params.weather.rays * risen * OPACITY,
        right,
        fall: FALL,
        up: right.cross(sun),
        pixels_per_rad: 1.0 / pixel_rad,
        bright: BRIGHT[0] * light.sunlight + BRIGHT[1] * clouds.ambient,
        dark: DARK * clouds.ambient,
        ..Default::default()
    }
}

/// Whether a corner of the screen, or what lies between its corners, is in the reach of the rays.
fn in_reach(sun: Vec3, screen: &Rays) -> bool {
    let axis = screen.forward.normalize();
    let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
    let corner = |(x, y)| screen.forward + screen.right * x + screen.up * y;
    let farthest = corners.map(|at| axis.angle_between(corner(at)));
    let reach_rad = 2.0 * (0.5 * REACH).asin();
    axis.angle_between(sun)
        < farthest
            .into_iter()
            .fold(reach_rad, |most, a| most.max(reach_rad + a))
}

/// The passes on a device.
#[derive(Debug)]
pub(crate) struct Pass {
    /// What each step draws, and that as what the next one reads: the last is read by the overlay.
    steps: [Step; 3],
    /// Over the screen.
    pub overlay: wgpu::RenderPipeline,
}

#[derive(Debug)]
struct Step {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    group: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
}

impl Pass {
    /// `own` is the layout of group 1 of the dome.
    pub fn new(context: &Context, shader: &Shader, own: Option<&wgpu::BindGroupLayout>) -> Pass {
        let (device, layouts) = (&context.device, &context.layouts);
        let step = |entry: &str, own: Option<&wgpu::BindGroupLayout>| {
            let texture = map::target(device, entry, FORMAT, [SIZE[0], SIZE[1], 1], 1);
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            Step {
                group: layouts.texture_group(device, &view),
                pipeline: context.off_screen(shader, entry, own, FORMAT),
                view,
                texture,
            }
        };
        Pass {
            steps: [
                step("fs_rays_mask", own),
                step("fs_rays_sum", Some(&layouts.texture)),
                step("fs_rays_streaks", Some(&layouts.texture)),
            ],
            overlay: context.overlay(shader, Some(&layouts.texture), &Overlay::RAYS),
        }
    }

    /// Records the passes; `own` is group 1 of the dome, if it has one.
    pub fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        own: Option<&wgpu::BindGroup>,
    ) {
        let [mask, sum, streaks] = &self.steps;
        match own {
            Some(own) => map::draw(encoder, &mask.view, &mask.pipeline, [shared, own]),
            None => map::draw(encoder, &mask.view, &mask.pipeline, [shared]),
        }
        map::draw(encoder, &sum.view, &sum.pipeline, [shared, &mask.group]);
        map::draw(
            encoder,
            &streaks.view,
            &streaks.pipeline,
            [shared, &sum.group],
        );
    }

    /// Group 1 of the overlay.
    pub fn group(&self) -> &wgpu::BindGroup {
        &self.steps[2].group
    }

    /// Bytes of its textures.
    pub fn bytes(&self) -> u64 {
        let bytes = self
            .steps
            .iter()
            .map(|step| map::texture_bytes(&step.texture));
        bytes.sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::camera::Camera;

    const SUN: Vec3 = Vec3::new(0.0, 0.6, -0.8);

    fn at(sun_direction: Vec3, azimuth_rad: f32) -> RayUniforms {
        let mut params = SkyParams::default();
        params.weather.rays = 1.0;
        let light = Light {
            sun_direction,
            sunlight: Vec3::ONE,
            ..Light::default()
        };
        let screen = Camera::looking(azimuth_rad, 0.3, 0.8, [64, 48]).rays();
        uniforms(&params, &light, &CloudUniforms::default(), &screen, 1e-3)
    }

    #[test]
    fn the_maps_axes_are_perpendicular_wherever_the_sun_is() {
        for sun in [
            Vec3::Y,
            Vec3::X,
            SUN,
            Vec3::new(0.6, -0.05, -0.8).normalize(),
        ] {
            let rays = at(sun, 0.0);
            let (right, up) = (rays.right, rays.up);
            assert!(right.is_normalized() && up.is_normalized(), "{sun}");
            assert!(right.dot(up).abs() + right.dot(sun).abs() + up.dot(sun).abs() < 1e-5);
            assert!(up.y >= -1e-6 && right.y.abs() < 1e-6, "{sun}: {right} {up}");
        }
    }

    #[test]
    fn they_rise_with_the_sun_and_are_not_drawn_where_they_do_not_reach() {
        let strength = |sine: f32| {
            let sun = Vec3::new(0.0, sine, -(1.0 - sine * sine).sqrt());
            at(sun, 0.0).opacity
        };
        assert_eq!(
            [strength(-0.2), strength(-0.09), strength(0.5)],
            [0.0, 0.0, OPACITY]
        );
        let steps = (-100..100).map(|i| [i, i + 1].map(|i| strength(i as f32 * 1e-3)));
        assert!(steps.clone().all(|[a, b]| b >= a && b - a < 0.02));
        // 53 degrees away from an axis that is 37 degrees up, and its corners are 31 degrees from it.
        assert!(at(SUN, 1.0).opacity > 0.0);
        assert_eq!(at(SUN, std::f32::consts::PI).opacity, 0.0);
        // Whatever a screen shows within reach is drawn.
        for turn in 0..64 {
            let azimuth = turn as f32 / 64.0 * std::f32::consts::TAU;
            let screen = Camera::looking(azimuth, 0.3, 0.8, [64, 48]).rays();
            let points = (0..81).map(|i| ((i % 9) as f32 / 4.0 - 1.0, (i / 9) as f32 / 4.0 - 1.0));
            let mut directions = points
                .map(|(x, y)| (screen.forward + screen.right * x + screen.up * y).normalize());
            if directions.any(|d| d.distance(SUN) < REACH) {
                assert!(at(SUN, azimuth).opacity > 0.0, "{turn}");
            }
        }
    }
}
