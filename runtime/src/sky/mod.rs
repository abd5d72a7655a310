//! The sky on a device: what is made once, what is written each frame, what is drawn.
//!
//! # Practice
//! [`Sky`] owns the pack's textures, some three megabytes, and one uniform buffer. What only one method needs, its pipelines
//! and its map, is made when that method is first prepared or [`Sky::load`]ed, and kept. Draw after the opaque scene:
//! pixels that the scene covers then cost nothing.

pub mod air;
mod evaluate;
mod light;
mod method_pipelines;

pub use self::light::{Luminary, SkyLight};
use welkin_pack::{Pack, Role};
use wgpu::util::DeviceExt;

use crate::clear_sky::flares;
use crate::clear_sky::table::SkyView;
use crate::clear_sky::view_texture::ViewTexture;
#[cfg(feature = "lit")]
use crate::clouds::lit::shadow::{self, Shadow};
use crate::device::config::{SkyConfig, output, step};
use crate::device::context::Context;
use crate::device::layouts::Layouts;
use crate::device::pipeline::Variant;
use crate::device::shader::Build;
use crate::device::upload::{shared_group, upload};
use crate::error::SkyError;
use crate::frame::Uniforms;
use crate::geometry::camera::Camera;
use crate::geometry::dome;
use crate::geometry::math::finite;
use crate::methods::interface::MapFrame;
use crate::pack_data::PackData;
use crate::params::{Method, SkyModel, SkyParams};
use crate::parts;
use crate::sky::method_pipelines::MethodPipelines;
#[cfg(feature = "sprites")]
use crate::sprites::{self, layer::SpriteLayer};
#[cfg(feature = "weather")]
use crate::weather::overlays::{self, Shown};

/// A sky on a device.
#[derive(Debug)]
pub struct Sky {
    context: Context,
    shared: wgpu::BindGroup,
    buffer: wgpu::Buffer,
    view: ViewTexture,
    /// Bytes that each method's own textures of the pack have, at its place in [`Method::ALL`].
    pack_bytes: [u64; Method::ALL.len()],
    pack_data: PackData,
    step: f32,
    dome: Option<DomeBuffers>,
    pipelines: [Option<MethodPipelines>; Method::ALL.len()],
    #[cfg(feature = "sprites")]
    sprites: SpriteLayer,
    prepared: Option<Prepared>,
}

/// What the prepared frame draws with.
#[derive(Clone, Copy, Debug)]
struct Prepared {
    method: Method,
    sky: SkyModel,
    variant: Variant,
    flare: bool,
    #[cfg(feature = "weather")]
    weather: Shown,
    #[cfg(feature = "lit")]
    shadow: Option<shadow::Area>,
}

/// The dome's mesh on the device.
#[derive(Debug)]
struct DomeBuffers {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    count: u32,
}

impl Sky {
    /// Uploads the textures of a pack and builds the pipelines. The sky is drawn as one triangle over the screen.
    ///
    /// # Errors
    /// See [`SkyError`]; the device is not touched before the configuration has been looked at.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
    ) -> Result<Sky, SkyError> {
        Sky::build(device, queue, config, pack, None)
    }

    /// As [`Sky::new`], drawn on the papers' dome mesh with a vertex every `step_deg` degrees: the same
    /// picture above the horizon, and nothing below it. See [`dome::mesh`].
    ///
    /// # Errors
    /// As [`Sky::new`].
    #[doc(hidden)]
    pub fn with_dome_mesh(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
        step_deg: f32,
    ) -> Result<Sky, SkyError> {
        Sky::build(device, queue, config, pack, Some(step_deg))
    }

    fn build(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
        dome_step_deg: Option<f32>,
    ) -> Result<Sky, SkyError> {
        let pack_data = PackData::new(pack)?;
        let features = device.features();
        let build = Build {
            output: output(&config, features)?,
            reversed_depth: config.depth.is_some_and(|d| d.reversed),
            skybox: pack_data.skybox.is_some(),
        };
        let layouts = Layouts::new(device, size_of::<Uniforms>() as u64);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("sky uniforms"),
            size: size_of::<Uniforms>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bytes = |role: Role| {
            let levels = pack.texture(role).map(|texture| &texture.levels);
            levels.map_or(0, |levels| {
                levels.iter().map(|level| level.len() as u64).sum()
            })
        };
        let mut own = [const { None }; Method::ALL.len()];
        for method in Method::ALL {
            let clouds = method.clouds();
            if clouds.uploads() {
                own[method as usize] = Some(upload(device, queue, pack, clouds.role())?);
            }
        }
        let usable = config.target_format.guaranteed_format_features(features);
        let context = Context {
            own,
            clouds_texels: pack_data.clouds_texels,
            mesh: dome_step_deg.is_some(),
            blends: usable
                .flags
                .contains(wgpu::TextureFormatFeatureFlags::BLENDABLE),
            device: device.clone(),
            config,
            build,
            compose: parts::text,
            layouts,
        };
        let view = ViewTexture::new(device, SkyView::image_size(&pack_data.sky));
        Ok(Sky {
            shared: shared_group(
                device,
                queue,
                pack,
                &context.layouts,
                &buffer,
                &view.texture,
            )?,
            view,
            pack_bytes: Method::ALL.map(|method| bytes(method.clouds().role())),
            step: step(config.target_format),
            dome: dome_step_deg.map(|step| dome_buffers(device, step)),
            pipelines: [const { None }; Method::ALL.len()],
            #[cfg(feature = "sprites")]
            sprites: SpriteLayer::new(pack)?,
            prepared: None,
            context,
            buffer,
            pack_data,
        })
    }

    /// Compiles the shader of a method with a sky model and makes the method's map, so that their first frame need not.
    /// For [`Method::Sprites`] that is what draws the sprites over a clear dome.
    pub fn load(&mut self, method: Method, sky: SkyModel) {
        let params = SkyParams {
            method,
            sky,
            ..SkyParams::default()
        };
        #[cfg(feature = "sprites")]
        self.sprites.ensure(&self.context, &params);
        ensured(&mut self.pipelines, &self.context, &params.dome());
    }

    /// Whether the pack has what a method draws from.
    ///
    /// # Errors
    /// [`SkyError::MissingField`] for [`Method::Sprites`] with a pack that has no clouds in space: it then draws the dome alone.
    pub fn supports(&self, method: Method) -> Result<(), SkyError> {
        match method {
            #[cfg(feature = "sprites")]
            Method::Sprites if !self.sprites.has_field() => Err(SkyError::MissingField),
            _ => Ok(()),
        }
    }

    /// Forgets what [`Method::Sprites`] keeps of earlier frames, its ring of impostors and the facing of sprites near the viewer: the next
    /// frame is drawn as a new sky would draw it. No other method keeps anything.
    pub fn reset_history(&mut self) {
        #[cfg(feature = "sprites")]
        self.sprites.reset_history();
    }

    /// Sprites that the prepared frame draws: on the screen, and into the ring of impostors.
    #[cfg(feature = "sprites")]
    pub fn sprites_drawn(&self) -> [u64; 2] {
        self.sprites.drawn()
    }

    /// Bytes of the ring of impostors: 2 MiB, and 4 MiB while it changes.
    #[cfg(feature = "sprites")]
    pub fn ring_bytes(&self) -> u64 {
        self.sprites.ring_bytes()
    }

    /// Computes a frame: writes its uniforms and records the off-screen passes of its method into `encoder`, before the
    /// pass in which the sky is drawn. `seconds` moves clouds and stars; any value will do.
    ///
    /// Nothing of a picture is remembered from frame to frame: the same arguments give the same picture, but with
    /// [`Method::Sprites`], see [`Sky::reset_history`]. Submit the encoder before the next frame is prepared.
    pub fn prepare(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
    ) {
        let clamped = params.clamped();
        let data = &self.pack_data;
        let moment = (data.moment(&clamped, seconds), [clamped.haze, clamped.moon]);
        let lit = self
            .view
            .lit(queue, moment, |moment| data.lit_sky_at(moment));
        let clamped = data.exposed(lit, clamped, seconds);
        let params = clamped.dome();
        let uniforms = data.uniforms_under(lit, &clamped, camera, seconds, self.step);
        let seconds = finite(seconds);
        #[cfg(feature = "sprites")]
        let uniforms = self.record_sprites(queue, encoder, &clamped, camera, seconds, uniforms);
        queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(&uniforms));
        let own = ensured(&mut self.pipelines, &self.context, &params);
        if let Some(map) = &mut own.map {
            let frame = MapFrame {
                params: &params,
                seconds,
                uniforms: &uniforms,
                pack: &self.pack_data,
            };
            map.record(queue, encoder, &self.shared, &frame);
        }
        let variant = Variant::of(&uniforms);
        #[cfg(feature = "weather")]
        let weather = overlays::shown(&uniforms.rays, &uniforms.rain);
        #[cfg(feature = "weather")]
        own.record_weather(&self.context, weather, encoder, &self.shared);
        // A flash that is told is made ready for before it begins.
        #[cfg(feature = "weather")]
        if variant.weather || params.weather.lightning.strength > 0.0 {
            own.ensure_sky(&self.context, params.sky, true);
        }
        self.prepared = Some(Prepared {
            method: params.method,
            sky: params.sky,
            variant,
            flare: uniforms.flares.strength > 0.0,
            #[cfg(feature = "weather")]
            weather,
            #[cfg(feature = "lit")]
            shadow: shadow::Area::of(&params, camera.position_m().as_dvec3()),
        });
    }

    /// Records what sprites draw off screen, and gives uniforms with the flare that they leave.
    #[cfg(feature = "sprites")]
    fn record_sprites(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
        mut uniforms: Uniforms,
    ) -> Uniforms {
        let frame = sprites::frame::Frame {
            params,
            camera,
            seconds,
            screen: &{ uniforms.camera },
            look: &{ uniforms.sprites },
        };
        let (context, shared) = (&self.context, &self.shared);
        self.sprites.record(context, queue, encoder, shared, &frame);
        if uniforms.flares.strength > 0.0 {
            let sun = uniforms.sky.sun_direction;
            uniforms.flares.strength *= self.sprites.clear_towards_sun(&frame, sun);
        }
        uniforms
    }

    /// The light that this sky gives to a scene: sun, moon and ambient light, horizon and exposure. The device is not asked, and no frame need be
    /// prepared.
    ///
    /// Clouds count by their mean at these parameters; rain, lightning, rays, a skybox and stars do not.
    pub fn light(&self, params: &SkyParams, seconds: f64) -> SkyLight {
        self.pack_data.light(params, seconds)
    }

    /// Parameters with the exposure that is drawn with: what [`SkyParams::auto_exposure`] finds, if it is on.
    pub fn exposed(&self, params: &SkyParams, seconds: f64) -> SkyParams {
        let clamped = params.clamped();
        let lit = self.pack_data.lit_sky(&clamped, seconds);
        self.pack_data.exposed(&lit, clamped, seconds)
    }

    /// Draws the prepared frame into a pass whose attachments are as the configuration said.
    ///
    /// Before the first [`Sky::prepare`] there is nothing to draw.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some((prepared, own)) = self.current() else {
            return;
        };
        let Some(pipeline) = own.pipeline(prepared.sky, prepared.variant) else {
            return;
        };
        pass.set_bind_group(0, &self.shared, &[]);
        if let Some(map) = &own.map {
            pass.set_bind_group(1, map.group(), &[]);
        }
        pass.set_pipeline(pipeline);
        match &self.dome {
            None => pass.draw(0..3, 0..1),
            Some(dome) => {
                pass.set_vertex_buffer(0, dome.vertices.slice(..));
                pass.set_index_buffer(dome.indices.slice(..), wgpu::IndexFormat::Uint16);
                pass.draw_indexed(0..dome.count, 0, 0..1);
            }
        }
        // What lies over the sky, from the farthest to the nearest.
        #[cfg(feature = "sprites")]
        self.sprites.draw(pass, prepared.sky);
        #[cfg(feature = "weather")]
        own.weather.draw(pass, prepared.weather);
        if let Some(flare) = own.flare.as_ref().filter(|_| prepared.flare) {
            pass.set_pipeline(flare);
            if let Some(map) = &own.map {
                pass.set_bind_group(1, map.group(), &[]);
            }
            pass.draw(0..4, 0..flares::COUNT);
        }
    }

    /// The cloud map of the prepared frame, if its method draws one: it tiles, and level 0 is as fine as it gets.
    ///
    /// Its red channel is the amount of cloud ([`Method::Octaves`], before cover) or the shade ([`Method::Fbm`], with
    /// the cover in alpha). That of [`Method::Lit`] is an array, a layer each (see [`crate::clouds::lit::map`]); its last one is empty.
    pub fn cloud_map(&self) -> Option<&wgpu::Texture> {
        let (_, own) = self.current()?;
        own.map.as_ref().map(|map| map.texture())
    }

    /// The shadows that the clouds of the prepared frame throw on the ground: see [`crate::shadow`].
    ///
    /// None without [`Method::Lit`], and where [`SkyParams::shadow_extent_m`] is 0.
    #[cfg(feature = "lit")]
    pub fn shadow(&self) -> Option<Shadow<'_>> {
        let (prepared, own) = self.current()?;
        let area = prepared.shadow?;
        Some(Shadow {
            texture: own.map.as_ref()?.shadow()?,
            centre_m: area.centre_m.as_vec2().to_array(),
            extent_m: area.extent_m as f32,
        })
    }

    /// Bytes of the textures that only this method reads: its own of the pack and, once they are made, those that it draws.
    pub fn memory_bytes(&self, method: Method) -> u64 {
        let own = self.pipelines[method as usize].as_ref();
        let drawn = own.map_or(0, MethodPipelines::bytes);
        #[cfg(feature = "sprites")]
        let drawn = match method {
            Method::Sprites => drawn + self.sprites.bytes(),
            _ => drawn,
        };
        self.pack_bytes[method as usize] + drawn
    }

    fn current(&self) -> Option<(Prepared, &MethodPipelines)> {
        let prepared = self.prepared?;
        Some((prepared, self.pipelines[prepared.method as usize].as_ref()?))
    }
}

/// The pipelines of the parameters' method, with what they need.
fn ensured<'a>(
    pipelines: &'a mut [Option<MethodPipelines>; Method::ALL.len()],
    context: &Context,
    params: &SkyParams,
) -> &'a mut MethodPipelines {
    let own = &mut pipelines[params.method as usize];
    if own
        .as_ref()
        .is_some_and(|own| own.shading != params.shading)
    {
        *own = None;
    }
    let own = own.get_or_insert_with(|| MethodPipelines::new(context, params));
    own.ensure(context, params);
    own
}

fn dome_buffers(device: &wgpu::Device, step_deg: f32) -> DomeBuffers {
    let mesh = dome::mesh(step_deg);
    let buffer = |contents: &[u8], usage: wgpu::BufferUsages| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("dome"),
            contents,
            usage,
        })
    };
    DomeBuffers {
        vertices: buffer(
            bytemuck::cast_slice(&mesh.vertices),
            wgpu::BufferUsages::VERTEX,
        ),
        indices: buffer(
            bytemuck::cast_slice(&mesh.indices),
            wgpu::BufferUsages::INDEX,
        ),
        count: mesh.indices.len() as u32,
    }
}
