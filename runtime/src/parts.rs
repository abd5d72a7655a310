//! The parts of the shader, in the order in which they are joined.

#[cfg(feature = "perez")]
use crate::clear_sky::perez;
use crate::clear_sky::{flares, galaxy, gradient, light, skybox, stars, sun};
use crate::clouds::shared;
use crate::device::common::Dome;
use crate::device::map;
use crate::device::shader::{Build, compose};
use crate::geometry::part::{Part, Value};
use crate::geometry::{camera, dome};
use crate::params::SkyModel;
#[cfg(feature = "weather")]
use crate::weather::{self, lightning, rain, rays};
use crate::{frame, tonemap};

/// What every dome needs.
const COMMON: [Part; 14] = [
    frame::PART,
    camera::PART,
    dome::PART,
    light::PART,
    gradient::PART,
    sun::PART,
    stars::PART,
    galaxy::PART,
    skybox::PART,
    shared::PART,
    map::PART,
    flares::PART,
    tonemap::PART,
    SKY,
];

/// What a dome with weather needs.
#[cfg(feature = "weather")]
const WEATHER: &[Part] = &[lightning::PART, rays::PART, rain::PART, weather::PART];
#[cfg(not(feature = "weather"))]
const WEATHER: &[Part] = &[];

/// The text of the shader of a dome: the parts that it needs, and no other.
pub fn text(build: Build, dome: Dome) -> String {
    let clouds = dome.method.clouds();
    let sky: &[Part] = match dome.sky {
        SkyModel::Gradient => &[],
        #[cfg(feature = "perez")]
        SkyModel::Perez => &[perez::PART],
    };
    let (weather_parts, weather) = match dome.weather && !WEATHER.is_empty() {
        true => (WEATHER, "weather_over(radiance, direction, clouds)"),
        false => (&[][..], "radiance"),
    };
    let parts = COMMON.iter().chain(clouds.parts());
    let parts = parts.chain(sky).chain(weather_parts);
    let (method, sky) = (dome.method.name(), dome.sky.name());
    let calls = [
        // Radiance and opacity of the clouds along a unit direction above the horizon, for a pixel that is so much narrower than one in
        // the middle of the screen.
        (
            "cloud_layer(direction: vec3f, narrowing: f32) -> vec4f",
            format!("{method}_layer(direction, narrowing)"),
        ),
        (
            "clear_sky_light(direction: vec3f) -> vec3f",
            format!("{sky}_light(direction)"),
        ),
        // Radiance of a pixel with what weather adds to it; its clouds are known.
        (
            "weather(radiance: vec3f, direction: vec3f, clouds: vec4f) -> vec3f",
            weather.to_string(),
        ),
    ];
    let own = [("ASK_OPAQUE", Value::Bool(clouds.is_often_opaque()))];
    compose(build, &own, parts, &calls)
}

/// What a pixel of the sky is put together from.
const SKY: Part = Part {
    constants: &[],
    wgsl: include_str!("sky.wgsl"),
};

#[cfg(test)]
mod tests {
    use std::mem::{offset_of, size_of};

    use naga::valid::{Capabilities, ValidationFlags, Validator};
    use naga::{Module, TypeInner};

    use super::*;

    use crate::clear_sky::flares::FlareUniforms;
    use crate::clear_sky::galaxy::GalaxyUniforms;
    use crate::clear_sky::gradient::SkyUniforms;
    use crate::clear_sky::perez::PerezUniforms;
    use crate::clear_sky::skybox::SkyboxUniforms;
    use crate::clear_sky::stars::StarUniforms;
    use crate::clear_sky::sun::SunUniforms;
    use crate::clouds::fbm::FbmUniforms;
    use crate::clouds::lit::shadow::ShadowUniforms;
    use crate::clouds::lit::{LitLayerUniforms, LitUniforms};
    use crate::clouds::octaves::{OctaveDome, OctaveUniforms};
    use crate::clouds::packed::PackedUniforms;
    use crate::clouds::shared::CloudUniforms;
    use crate::device::config::Output;
    use crate::frame::Uniforms;
    use crate::geometry::camera::CameraUniforms;
    use crate::params::Method;
    use crate::sprites::SpriteUniforms;
    use crate::sprites::pipelines::SpriteBlock;
    use crate::sprites::ring::{RingSet, RingUniforms, SpriteView};
    use crate::tonemap::TonemapUniforms;
    use crate::weather::lightning::LightningUniforms;
    use crate::weather::rain::RainUniforms;
    use crate::weather::rays::RayUniforms;

    fn parse((build, dome): (Build, Dome)) -> Module {
        let text = text(build, dome);
        naga::front::wgsl::parse_str(&text)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)))
    }

    fn builds() -> Vec<(Build, Dome)> {
        let mut builds = Vec::new();
        for output in Output::ALL {
            for method in Method::ALL {
                for (reversed_depth, skybox, weather) in [(false, false, false), (true, true, true)]
                {
                    for sky in SkyModel::ALL {
                        let build = Build {
                            output,
                            reversed_depth,
                            skybox,
                        };
                        let dome = Dome {
                            method,
                            sky,
                            weather,
                        };
                        builds.push((build, dome));
                    }
                }
            }
        }
        builds
    }

    /// The entry points that only a method has.
    fn own_entries(method: Method) -> &'static [&'static str] {
        match method.name() {
            "octaves" => &["fs_octaves_map"],
            "fbm" => &["fs_fbm_map", "fs_fbm_pack"],
            "lit" => &["fs_lit_map", "fs_lit_level", "fs_shadow"],
            "sprites" => &[
                "vs_sprite",
                "vs_ring_sprite",
                "fs_sprite",
                "vs_ring",
                "fs_ring",
            ],
            _ => &[],
        }
    }

    #[test]
    fn every_build_is_valid_without_any_extension_and_has_what_it_needs() {
        for build in builds() {
            let module = parse(build);
            let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
            validator
                .validate(&module)
                .unwrap_or_else(|e| panic!("{build:?}: {e:?}"));
            let mut entries: Vec<_> = module
                .entry_points
                .iter()
                .map(|e| e.name.as_str())
                .collect();
            let common = [
                "vs_screen",
                "vs_dome",
                "vs_map",
                "fs_level",
                "vs_flare",
                "fs_flare",
                "fs_sky",
            ];
            let weather = [
                "fs_rays_mask",
                "fs_rays_sum",
                "fs_rays_streaks",
                "fs_rays",
                "vs_rain",
                "fs_rain",
            ];
            let has_weather = cfg!(feature = "weather") && build.1.weather;
            let weather = if has_weather { &weather[..] } else { &[] };
            let mut expected = [&common, own_entries(build.1.method), weather].concat();
            entries.sort_unstable();
            expected.sort_unstable();
            assert_eq!(entries, expected, "{build:?}");
        }
    }

    #[test]
    fn every_entry_point_translates_to_webgl2() {
        use naga::back::{PipelineConstants, glsl, pipeline_constants::process_overrides};
        use naga::proc::BoundsCheckPolicies;

        let webgl2 = glsl::Options {
            version: glsl::Version::Embedded {
                version: 300,
                is_webgl: true,
            },
            ..Default::default()
        };
        for build in builds() {
            let module = parse(build);
            let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
            let info = validator.validate(&module).expect("valid");
            for entry in &module.entry_points {
                let named = Some((entry.stage, entry.name.as_str()));
                let constants = PipelineConstants::default();
                let (module, info) = process_overrides(&module, &info, named, &constants)
                    .expect("overrides have defaults");
                let options = glsl::PipelineOptions {
                    shader_stage: entry.stage,
                    entry_point: entry.name.clone(),
                    multiview: None,
                };
                let mut text = String::new();
                let policies = BoundsCheckPolicies::default();
                glsl::Writer::new(&mut text, &module, &info, &webgl2, &options, policies)
                    .and_then(|mut writer| writer.write())
                    .unwrap_or_else(|e| panic!("{build:?} {}: {e}", entry.name));
            }
        }
    }

    /// Offsets and size of a WGSL struct.
    fn layout(module: &Module, name: &str) -> (Vec<(String, u32)>, u32) {
        let (_, ty) = module
            .types
            .iter()
            .find(|(_, t)| t.name.as_deref() == Some(name))
            .expect(name);
        let TypeInner::Struct { members, span } = &ty.inner else {
            panic!("{name} is no struct")
        };
        (
            members
                .iter()
                .map(|m| (m.name.clone().unwrap_or_default(), m.offset))
                .collect(),
            *span,
        )
    }

    macro_rules! assert_same_layout {
        ($module:expr, $name:ident, $($field:ident),+) => {
            let rust = vec![$((stringify!($field).to_string(), offset_of!($name, $field) as u32)),+];
            assert_eq!(layout($module, stringify!($name)), (rust, size_of::<$name>() as u32), stringify!($name));
        };
    }

    #[test]
    fn rust_and_wgsl_agree_on_the_layout_of_every_struct() {
        let module = &parse(builds()[0]);
        assert_same_layout!(
            module,
            CameraUniforms,
            right,
            up,
            forward,
            clip_x,
            clip_y,
            clip_w
        );
        assert_same_layout!(
            module,
            SkyUniforms,
            gradient,
            sun,
            wide,
            narrow,
            band,
            overcast
        );
        assert_same_layout!(module, PerezUniforms, sun, a, b, c, d, e, base, zenith);
        assert_same_layout!(module, SunUniforms, right, up, disc, glow, towards);
        assert_same_layout!(module, StarUniforms, field, spread);
        assert_same_layout!(module, GalaxyUniforms, light, grain);
        assert_same_layout!(module, SkyboxUniforms, mix);
        assert_same_layout!(module, CloudUniforms, gradient, sunlight, ambient, tint);
        assert_same_layout!(
            module,
            PackedUniforms,
            photo,
            noise,
            detail,
            upper,
            levels,
            shape
        );
        assert_same_layout!(module, OctaveDome, axes, place);
        assert_same_layout!(
            module,
            OctaveUniforms,
            low,
            middle,
            high,
            shape,
            sun,
            cells_a,
            cells_b,
            map
        );
        assert_same_layout!(
            module,
            FbmUniforms,
            axes,
            place,
            remap,
            lit,
            shaded,
            step,
            offsets_a,
            offsets_b,
            offsets_c,
            offsets_d,
            weights_a,
            weights_b
        );
        assert_same_layout!(module, LitLayerUniforms, axes, place, shape, sun, facing);
        assert_same_layout!(
            module,
            LitUniforms,
            dome,
            light,
            towards,
            source,
            ambient,
            layers
        );
        assert_same_layout!(
            module,
            SpriteUniforms,
            sun,
            colour,
            ambient,
            air,
            fade,
            flash,
            flash_place
        );
        assert_same_layout!(module, SpriteView, clip_x, clip_y, clip_z, clip_w, viewer);
        assert_same_layout!(module, SpriteBlock, origin, slot);
        assert_same_layout!(module, RingSet, place, span);
        assert_same_layout!(module, RingUniforms, used, next, walls, sides);
        assert_same_layout!(module, ShadowUniforms, layers);
        assert_same_layout!(module, LightningUniforms, place, light);
        assert_same_layout!(module, RayUniforms, sun, right, up, bright, dark);
        assert_same_layout!(
            module,
            RainUniforms,
            right,
            up,
            forward,
            sight,
            streak,
            haze,
            places,
            sizes
        );
        assert_same_layout!(module, FlareUniforms, light, places, colours, cells);
        assert_same_layout!(module, TonemapUniforms, display);
        assert_same_layout!(
            module, Uniforms, camera, sky, perez, sun, stars, galaxy, skybox, clouds, packed,
            octaves, fbm, lit, sprites, shadow, lightning, rays, rain, flares, tonemap
        );
        assert_eq!(
            size_of::<Uniforms>() % 16,
            0,
            "WebGL2 wants uniform blocks in units of 16 bytes"
        );
    }
}
