//! The parts of the shader, in the order in which they are joined.

#[cfg(feature = "perez")]
use crate::clear_sky::perez;
use crate::clear_sky::{
    catalogue, flares, galaxy, ground, light, moon, planets, sea, skybox, stars, sun, table,
};
use crate::clouds::{shadow, shared};
use crate::device::context::Dome;
use crate::device::map;
use crate::device::shader::{Build, compose};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::Struct;
use crate::geometry::{camera, dome};
use crate::params::{Method, Shading, SkyModel};
#[cfg(feature = "weather")]
use crate::weather::{self, lightning, rain, rainbow, rays};
use crate::{frame, tonemap};

/// What every dome needs.
const COMMON: [Part; 19] = [
    frame::PART,
    camera::PART,
    dome::PART,
    light::PART,
    table::PART,
    ground::PART,
    sun::PART,
    moon::PART,
    stars::PART,
    catalogue::PART,
    galaxy::PART,
    planets::PART,
    skybox::PART,
    shared::PART,
    shadow::PART,
    map::PART,
    flares::PART,
    tonemap::PART,
    SKY,
];

/// What a dome with weather needs.
#[cfg(feature = "weather")]
const WEATHER: &[Part] = &[
    lightning::PART,
    rays::PART,
    rain::PART,
    rainbow::PART,
    weather::PART,
];
#[cfg(not(feature = "weather"))]
const WEATHER: &[Part] = &[];

/// What a sky model needs.
fn sky_parts(sky: SkyModel) -> &'static [Part] {
    match sky {
        SkyModel::Table => &[],
        #[cfg(feature = "perez")]
        SkyModel::Perez => &[perez::PART],
    }
}

/// What a dome over a sea needs.
const SEA: &[Part] = &[sea::PART];

/// The structs of all parts, each once: two methods may need the same part.
fn structs() -> Vec<&'static Struct> {
    let mut structs: Vec<&Struct> = Vec::new();
    for own in every().flat_map(|part| part.structs) {
        if structs.iter().all(|other| other.name != own.name) {
            structs.push(own);
        }
    }
    structs
}

/// Every part.
fn every() -> impl Iterator<Item = &'static Part> {
    let methods = Method::ALL.into_iter().flat_map(|m| m.clouds().parts());
    let skies = SkyModel::ALL.into_iter().flat_map(sky_parts);
    COMMON
        .iter()
        .chain(methods)
        .chain(skies)
        .chain(WEATHER)
        .chain(SEA)
}

/// The text of the shader of a dome: the parts that it needs. Structs are those of all parts, since the uniforms have them.
pub fn text(build: Build, dome: Dome) -> String {
    let clouds = dome.method.clouds();
    let sky_parts = sky_parts(dome.sky);
    let (weather_parts, weather) = match dome.weather && !WEATHER.is_empty() {
        true => (WEATHER, "weather_over(radiance, direction, clouds)"),
        false => (&[][..], "radiance"),
    };
    let (sea_parts, below) = match dome.sea {
        true => (SEA, "sea_seen(horizon, direction)"),
        false => (&[][..], "ground_seen(horizon, direction)"),
    };
    let parts = COMMON.iter().chain(clouds.parts());
    let parts = parts.chain(sky_parts).chain(weather_parts).chain(sea_parts);
    let (method, sky) = (dome.method.name(), dome.sky.name());
    let calls = [
        // Radiance and opacity of the clouds along a unit direction above the horizon, for a pixel that is so much narrower than one in
        // the middle of the screen.
        (
            "cloud_layer(direction: vec3f, narrowing: f32) -> vec4f",
            format!("{method}_layer(direction, narrowing)"),
        ),
        // Share of the light of sun or moon that the clouds hide from the middle of a texel of the shadows.
        (
            "cloud_hidden(texel: vec2f) -> f32",
            format!("{method}_hidden(texel)"),
        ),
        (
            "clear_sky_light(direction: vec3f) -> vec3f",
            format!("{sky}_light(direction)"),
        ),
        // What is seen along a direction below the horizon, where the sky's radiance is `horizon`.
        (
            "below_horizon(horizon: vec3f, direction: vec3f) -> vec3f",
            below.to_string(),
        ),
        // Radiance of a pixel with what weather adds to it; its clouds are known.
        (
            "weather(radiance: vec3f, direction: vec3f, clouds: vec4f) -> vec3f",
            weather.to_string(),
        ),
    ];
    let own = [
        ("ASK_OPAQUE", Value::Bool(clouds.is_often_opaque())),
        ("SCATTERED", Value::Bool(dome.shading == Shading::Scattered)),
    ];
    compose(build, &own, structs(), parts, &calls)
}

/// What a pixel of the sky is put together from.
const SKY: Part = Part {
    constants: &[],
    structs: &[],
    wgsl: include_str!("sky/sky.wgsl"),
};

#[cfg(test)]
mod tests {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    use naga::{Module, TypeInner};

    use super::*;

    use crate::device::config::Output;
    use crate::frame::Uniforms;

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
                            // Each alone and both together are parsed as well as neither.
                            catalogue: skybox != (sky == SkyModel::Table),
                            over: skybox,
                        };
                        for shading in Shading::ALL {
                            let dome = Dome {
                                method,
                                shading,
                                sky,
                                weather,
                                sea: skybox,
                            };
                            builds.push((build, dome));
                        }
                    }
                }
            }
        }
        builds
    }

    /// The entry points that only a method has.
    fn own_entries(method: Method) -> &'static [&'static str] {
        match method.name() {
            "packed" => &["fs_packed_map"],
            "octaves" => &["fs_octaves_map"],
            "fbm" => &["fs_fbm_map", "fs_fbm_pack"],
            "lit" => &["fs_lit_map", "fs_lit_level"],
            "sprites" => &[
                "vs_sprite",
                "vs_ring_sprite",
                "fs_sprite",
                "vs_ring",
                "fs_ring",
                "vs_sprite_cast",
                "fs_sprite_cast",
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
                "fs_shadow",
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

    #[test]
    fn rust_and_wgsl_agree_on_the_layout_of_every_struct() {
        let module = &parse(builds()[0]);
        for own in structs() {
            let members = own.members.iter();
            let rust = members.map(|m| (m.name.to_string(), m.offset as u32));
            let rust = (rust.collect(), own.size as u32);
            assert_eq!(layout(module, own.name), rust, "{}", own.name);
        }
        assert_eq!(
            size_of::<Uniforms>() % 16,
            0,
            "WebGL2 wants uniform blocks in units of 16 bytes"
        );
    }
}
