// What the passes share: the uniforms of frame.rs, what a frame needs, samplers and textures.

// What a frame needs is compiled in, since some devices run both sides of a branch (device/pipeline.rs).
override NIGHT: bool = true;
override UPPER_LAYER: bool = true;
// Whether the sky is the dome's mesh and not a triangle over the screen.
override DOME_MESH: bool = false;

@group(0) @binding(0) var<uniform> uniforms: Uniforms;
@group(0) @binding(1) var repeat_sampler: sampler;
@group(0) @binding(2) var clamp_sampler: sampler;
@group(0) @binding(3) var clouds_texture: texture_2d<f32>;
@group(0) @binding(4) var stars_texture: texture_2d<f32>;
@group(0) @binding(5) var galaxy_texture: texture_2d<f32>;
@group(0) @binding(6) var sky_texture: texture_2d<f32>;
@group(0) @binding(7) var sun_texture: texture_2d<f32>;
@group(0) @binding(8) var flares_texture: texture_2d<f32>;
@group(0) @binding(9) var skybox_texture: texture_cube<f32>;
@group(0) @binding(10) var catalogue_texture: texture_2d<f32>;

// What a method adds: to the dome its map; to an off-screen pass the texture that it reads.
@group(1) @binding(0) var map_texture: texture_2d<f32>;
@group(1) @binding(1) var layers_texture: texture_2d_array<f32>;
@group(1) @binding(2) var lit_map_texture: texture_2d_array<f32>;
