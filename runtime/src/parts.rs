//! The parts of the shader, in the order in which they are joined.

use crate::clear_sky::{flares, galaxy, gradient, light, perez, skybox, stars, sun};
use crate::clouds::{
    fbm, fbm_map, fbm_pack, lit, lit_map, octaves, octaves_map, packed, shadow, shared,
};
use crate::device::map;
use crate::geometry::part::Part;
use crate::geometry::{camera, dome};
use crate::sprites::{pipelines, ring};
use crate::weather::{lightning, rain, rays};
use crate::{frame, tonemap};

/// Every part.
pub const PARTS: [Part; 29] = [
    frame::PART,
    camera::PART,
    dome::PART,
    light::PART,
    perez::PART,
    gradient::PART,
    sun::PART,
    stars::PART,
    galaxy::PART,
    skybox::PART,
    shared::PART,
    packed::PART,
    octaves::PART,
    octaves_map::PART,
    fbm::PART,
    fbm_map::PART,
    fbm_pack::PART,
    lit::PART,
    lit_map::PART,
    pipelines::PART,
    ring::PART,
    shadow::PART,
    lightning::PART,
    map::PART,
    rays::PART,
    rain::PART,
    flares::PART,
    tonemap::PART,
    SKY,
];

/// What a pixel of the sky is put together from.
const SKY: Part = Part {
    constants: &[],
    structs: &[],
    wgsl: include_str!("sky.wgsl"),
};

#[cfg(test)]
mod tests {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    use naga::{Module, TypeInner};

    use super::*;

    use crate::device::config::Output;
    use crate::device::shader::{Build, compose};
    use crate::frame::Uniforms;
    use crate::params::{Method, SkyModel};

    fn parse(build: Build) -> Module {
        let text = compose(build, &PARTS);
        naga::front::wgsl::parse_str(&text)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)))
    }

    fn builds() -> Vec<Build> {
        let mut builds = Vec::new();
        for output in Output::ALL {
            for method in Method::ALL {
                for (reversed_depth, sky, skybox) in [
                    (false, SkyModel::Gradient, false),
                    (true, SkyModel::Perez, true),
                ] {
                    builds.push(Build {
                        output,
                        reversed_depth,
                        method,
                        sky,
                        skybox,
                    });
                }
            }
        }
        builds
    }

    #[test]
    fn every_build_is_valid_without_any_extension() {
        for build in builds() {
            let module = parse(build);
            let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
            validator
                .validate(&module)
                .unwrap_or_else(|e| panic!("{build:?}: {e:?}"));
            let entries: Vec<_> = module
                .entry_points
                .iter()
                .map(|e| e.name.as_str())
                .collect();
            let passes = [
                "fs_octaves_map",
                "fs_fbm_map",
                "fs_fbm_pack",
                "fs_lit_map",
                "fs_lit_level",
                "vs_sprite",
                "vs_ring_sprite",
                "fs_sprite",
                "vs_ring",
                "fs_ring",
                "fs_shadow",
                "vs_map",
                "fs_level",
            ];
            let rays = ["fs_rays_mask", "fs_rays_sum", "fs_rays_streaks", "fs_rays"];
            let sky = [
                ["vs_screen", "vs_dome"].as_slice(),
                &passes,
                &rays,
                &["vs_rain", "fs_rain", "vs_flare", "fs_flare", "fs_sky"],
            ];
            assert_eq!(entries, sky.concat());
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
        for own in PARTS.iter().flat_map(|part| part.structs) {
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
