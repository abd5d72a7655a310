//! The shader's text, put together from one WGSL file a pass and the constants that Rust knows.

use std::fmt::Write;

use glam::Vec3;
use welkin_pack::mapping::{STAR_TILE_SIDE, STAR_TILE_START};

use crate::sprites::instances;
use crate::{
    Method, SkyModel, clouds, dome, fbm, fbm_map, galaxy, light, lightning, lit, lit_map, octaves,
    octaves_map, packed, perez, rain, rays, sky, sprites, stars, sun, tonemap,
};

/// The WGSL files in the order in which they are joined.
const PARTS: [&str; 28] = [
    include_str!("../shaders/uniforms.wgsl"),
    include_str!("../shaders/camera.wgsl"),
    include_str!("../shaders/dome.wgsl"),
    include_str!("../shaders/perez.wgsl"),
    include_str!("../shaders/sky.wgsl"),
    include_str!("../shaders/sun.wgsl"),
    include_str!("../shaders/stars.wgsl"),
    include_str!("../shaders/galaxy.wgsl"),
    include_str!("../shaders/skybox.wgsl"),
    include_str!("../shaders/clouds.wgsl"),
    include_str!("../shaders/packed.wgsl"),
    include_str!("../shaders/octaves.wgsl"),
    include_str!("../shaders/octaves_map.wgsl"),
    include_str!("../shaders/fbm.wgsl"),
    include_str!("../shaders/fbm_map.wgsl"),
    include_str!("../shaders/fbm_pack.wgsl"),
    include_str!("../shaders/lit.wgsl"),
    include_str!("../shaders/lit_map.wgsl"),
    include_str!("../shaders/sprites.wgsl"),
    include_str!("../shaders/ring.wgsl"),
    include_str!("../shaders/shadow.wgsl"),
    include_str!("../shaders/lightning.wgsl"),
    include_str!("../shaders/map.wgsl"),
    include_str!("../shaders/rays.wgsl"),
    include_str!("../shaders/rain.wgsl"),
    include_str!("../shaders/flares.wgsl"),
    include_str!("../shaders/tonemap.wgsl"),
    include_str!("../shaders/renderer.wgsl"),
];

/// What the last step writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// Linear radiance, for float targets.
    Radiance,
    /// Linear display light, for targets that the hardware encodes (`*Srgb`).
    Display,
    /// sRGB-encoded display light, for plain unorm targets.
    Encoded,
}

impl Output {
    /// Every kind of output.
    pub const ALL: [Output; 3] = [Output::Radiance, Output::Display, Output::Encoded];
}

/// What is compiled into a shader, beside what its pipelines choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Build {
    /// What the last step writes.
    pub output: Output,
    /// Whether depth is 1 or (reversed) 0 far away.
    pub reversed_depth: bool,
    /// Which method's clouds `cloud_layer` gives.
    pub method: Method,
    /// How `sky_radiance` computes the clear sky.
    pub sky: SkyModel,
    /// Whether the pack has a skybox.
    pub skybox: bool,
}

/// The whole shader.
pub fn compose(build: Build) -> String {
    let mut text = constants(build);
    for part in PARTS {
        text.push('\n');
        text.push_str(part);
    }
    let method = build.method.name();
    let _ = write!(
        text,
        "\n// Radiance and opacity of the clouds along a unit direction above the horizon, for a pixel that is so much narrower\n\
         // than one in the middle of the screen.\n\
         fn cloud_layer(direction: vec3f, narrowing: f32) -> vec4f {{\n    return {method}_layer(direction, narrowing);\n}}\n"
    );
    text
}

fn constants(build: Build) -> String {
    let mut text = String::from("// Generated from the constants in Rust.\n");
    for (index, name) in ["OUTPUT_RADIANCE", "OUTPUT_DISPLAY", "OUTPUT_ENCODED"]
        .iter()
        .enumerate()
    {
        let _ = writeln!(text, "const {name} = {index}u;");
    }
    let _ = writeln!(text, "const OUTPUT = {}u;", build.output as u32);
    let _ = writeln!(text, "const SKYBOX = {};", build.skybox);
    let _ = writeln!(text, "const PEREZ = {};", build.sky == SkyModel::Perez);
    // Packed clouds are hardly ever opaque, and behind sprites there are none: to ask costs more than it saves.
    let _ = writeln!(
        text,
        "const ASK_OPAQUE = {};",
        !matches!(build.method, Method::Packed | Method::Sprites)
    );
    let numbers = [
        ("FAR_DEPTH", if build.reversed_depth { 0.0 } else { 1.0 }),
        ("PI", std::f32::consts::PI),
        ("TAU", std::f32::consts::TAU),
        ("SQRT_2", std::f32::consts::SQRT_2),
        ("CLOUD_SPHERE_RADIUS", dome::CLOUD_SPHERE_RADIUS),
        ("GROUND_FLOOR", sky::GROUND_FLOOR),
        ("GROUND_FALL", sky::GROUND_FALL),
        ("PEREZ_LEAST_COSINE", perez::LEAST_COSINE),
        ("PEREZ_TO_DAYLIGHT", perez::TO_DAYLIGHT),
        ("SUN_HORIZON", sun::HORIZON),
        ("STAR_TILE_SIDE", STAR_TILE_SIDE),
        ("STAR_RATE_STEPS", 255.0),
        ("STAR_GALAXY_BOOST", stars::GALAXY_BOOST),
        ("EXTINCTION", galaxy::EXTINCTION),
        ("CLOUD_CORE", clouds::CORE),
        ("PACKED_EDGE", packed::EDGE),
        ("PACKED_FOLD", packed::FOLD),
        ("UPPER_OPACITY", packed::UPPER_OPACITY),
        ("UPPER_THRESHOLD", packed::UPPER_THRESHOLD),
        ("OCTAVE_FINER", octaves::FINER),
        ("OCTAVE_ROUGH_GREY", octaves::ROUGH_GREY),
        ("OCTAVE_FINER_LEVEL", octaves::FINER.log2()),
        ("OCTAVE_EDGE", octaves::EDGE),
        ("OCTAVE_THIN", octaves::THIN),
        ("OCTAVE_MIDDLE_OPACITY", octaves::MIDDLE_OPACITY),
        ("OCTAVE_HIGH_OPACITY", octaves::HIGH_OPACITY),
        ("OCTAVE_NOISE_SIDE", octaves_map::NOISE_SIDE as f32),
        ("NORMAL_SLOPE", octaves_map::NORMAL_SLOPE),
        ("NORMAL_BEND", octaves_map::NORMAL_BEND),
        ("FBM_FINER", fbm::FINER),
        ("FBM_FINER_LEVEL", fbm::FINER.log2()),
        ("FBM_ROUGH_SHADE", fbm::ROUGH_SHADE),
        ("FBM_ABSORPTION", fbm_map::ABSORPTION),
        ("FBM_FULL", fbm::FULL),
        ("LIT_FINER", lit::FINER),
        ("LIT_FINER_LEVEL", lit::FINER.log2()),
        ("LIT_FINER_RELIEF", lit::FINER_RELIEF),
        ("LIT_SHADED_BY_LAYER", lit::SHADED_BY_LAYER),
        ("LIT_LEAST_STRETCH", lit::LEAST_STRETCH),
        ("LIT_LEAST_UP", lit_map::LEAST_UP),
        ("LIT_BLUR_LEVEL", lit::BLUR_LEVEL),
        ("LIT_LONGEST_WAY", lit::LONGEST_WAY),
        ("SPRITE_RIM_OPAQUE", sprites::RIM_OPAQUE),
        ("SPRITE_MOST_HALF_SIZE", instances::MOST_HALF_SIZE_M),
        ("SPRITE_MOST_AWAY", instances::MOST_AWAY_M),
        ("SPRITE_FIRST_STAGE", sprites::formation::FIRST_STAGE),
        ("SPRITE_LOCK", sprites::locks::LOCK),
        ("SPRITE_NEAR", sprites::locks::NEAR),
        ("RING_COS", sprites::ring::COSINE),
        ("RING_HALF_SIDE", sprites::ring::HALF_SIDE),
        ("RING_BRIGHTEST", sprites::ring::BRIGHTEST),
        ("LIGHTNING_CORE", lightning::CORE),
        ("LIGHTNING_THIN", lightning::THIN),
        ("RAYS_REACH", rays::REACH),
        ("RAYS_DECAY", rays::DECAY),
        ("RAYS_SOURCE", rays::SOURCE),
        ("RAYS_WINDOW", rays::WINDOW),
        ("RAYS_GAIN", rays::GAIN),
        ("RAYS_HORIZON", rays::HORIZON),
        ("RAYS_GROUND", rays::GROUND),
        ("RAYS_CORE", rays::CORE),
        ("RAIN_HEIGHT", rain::HEIGHT_M as f32),
        ("RAIN_FADE", rain::FADE),
        ("RAIN_HAZE_ABOVE", rain::HAZE_ABOVE),
        ("RAIN_HAZE_FALL", rain::HAZE_FALL),
        ("TONE_SHOULDER", tonemap::SHOULDER),
        ("GALAXY_GRAIN_SCALE", galaxy::GRAIN_SCALE),
        ("TONE_KNEE", tonemap::KNEE),
    ];
    for (name, value) in numbers {
        let _ = writeln!(text, "const {name}: f32 = {value:?};");
    }
    let _ = writeln!(
        text,
        "const OCTAVE_RELIEF_COUNT = {};",
        octaves_map::RELIEF_COUNT
    );
    for (name, value) in [("RAYS_TAPS", rays::TAPS), ("RAYS_AROUND", rays::AROUND)] {
        let _ = writeln!(text, "const {name} = {value};");
    }
    let [near, middle, _] = rain::SLOTS;
    for (name, value) in [
        ("RAIN_COLUMNS", rain::COLUMNS),
        ("RAIN_SLOTS", rain::DROPS_A_COLUMN),
        ("RAIN_MIDDLE", near),
        ("RAIN_FAR", near + middle),
    ] {
        let _ = writeln!(text, "const {name} = {value}u;");
    }
    let _ = writeln!(text, "const SPRITES_A_ROW = {}u;", instances::A_ROW);
    let _ = writeln!(
        text,
        "const LIT_LAYERS_AN_ITERATION = {};",
        crate::params::LAYERS_AN_ITERATION
    );
    for (name, [x, y]) in [
        ("STAR_START", STAR_TILE_START),
        ("OCTAVE_FINER_START", octaves::FINER_START),
        ("FBM_FINER_START", fbm::FINER_START),
        ("LIT_FINER_START", lit::FINER_START),
        ("LIT_AMBIENT", lit::AMBIENT),
        ("LIGHTNING_SPREAD", lightning::SPREAD),
        ("RAYS_TEXEL", rays::TEXEL_RAD),
        ("RAYS_SIZE", rays::SIZE.map(|side| side as f32)),
        ("LIT_WEIGHTS", lit_map::WEIGHTS),
    ] {
        let _ = writeln!(text, "const {name} = vec2f({x:?}, {y:?});");
    }
    for (name, [x, y, z, w]) in [("FBM_DEPTHS", fbm_map::DEPTHS), ("PEREZ_ACOS", perez::ACOS)] {
        let _ = writeln!(text, "const {name} = vec4f({x:?}, {y:?}, {z:?}, {w:?});");
    }
    let [rgb_x, rgb_y, rgb_z] = perez::RGB_OF_XYZ;
    for (name, colour) in [
        ("LUMINANCE", light::LUMINANCE),
        ("LIT_BLUR", lit::BLUR.into()),
        ("STAR_WARM", stars::WARM),
        ("STAR_COLD", stars::COLD),
        ("PEREZ_DAYLIGHT", perez::DAYLIGHT.into()),
        ("PEREZ_RGB_X", rgb_x),
        ("PEREZ_RGB_Y", rgb_y),
        ("PEREZ_RGB_Z", rgb_z),
    ] {
        let Vec3 { x, y, z } = colour;
        let _ = writeln!(text, "const {name} = vec3f({x:?}, {y:?}, {z:?});");
    }
    text
}

#[cfg(test)]
mod tests {
    use std::mem::{offset_of, size_of};

    use naga::valid::{Capabilities, ValidationFlags, Validator};
    use naga::{Module, TypeInner};

    use super::*;
    use crate::uniforms::*;

    fn parse(build: Build) -> Module {
        let text = compose(build);
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
