//! What one camera sees of a sky: its uniforms, what is drawn off screen for it, and its prepared frame.

use super::common::{Common, DomeBuffers};
use super::method_pipelines::MethodPipelines;
use crate::clear_sky::catalogue_texture::CatalogueTexture;
use crate::clear_sky::flares;
use crate::clear_sky::table::SkyView;
use crate::clear_sky::view_texture::ViewTexture;
use crate::clouds::shadow::{self, Shadow};
use crate::device::config::Output;
use crate::device::context::Context;
use crate::device::pipeline::Variant;
use crate::frame::Uniforms;
use crate::geometry::camera::Camera;
use crate::geometry::math::finite;
use crate::methods::interface::MapFrame;
use crate::params::{Method, SkyModel, SkyParams, WeatherParams};
use crate::sky::light::SkyLight;
#[cfg(feature = "sprites")]
use crate::sprites::{self, layer::SpriteLayer, pipelines::Behind};
#[cfg(feature = "weather")]
use crate::weather::overlays::{self, Shown};

/// What one camera sees of a sky: made by [`Sky::view`](super::Sky::view).
///
/// A [`Sky`](super::Sky) has one of its own, which [`Sky::prepare`](super::Sky::prepare) and [`Sky::draw`](super::Sky::draw) use. Split screens, mirrors and the faces of a cube each want
/// one more: all may then be prepared in one encoder, in any order, each with its own parameters and seconds, and drawn in one submission, even
/// in one pass. The pack's textures and the pipelines are the sky's; a view has its uniforms, the maps of the methods it has shown (up to
/// 6 MB) and what [`Method::Sprites`] keeps of its earlier frames.
#[derive(Debug)]
pub struct View {
    shared: wgpu::BindGroup,
    uniforms: wgpu::Buffer,
    sky: ViewTexture,
    catalogue: CatalogueTexture,
    dome: Option<DomeBuffers>,
    pipelines: [Option<MethodPipelines>; Method::ALL.len()],
    #[cfg(feature = "sprites")]
    sprites: SpriteLayer,
    /// Made when shadows are first asked for.
    shadow: Option<shadow::Target>,
    scale: f32,
    prepared: Option<Prepared>,
}

/// What the prepared frame draws with.
#[derive(Clone, Copy, Debug)]
struct Prepared {
    method: Method,
    sky: SkyModel,
    #[cfg(feature = "sprites")]
    behind: Behind,
    variant: Variant,
    flare: bool,
    #[cfg(feature = "weather")]
    weather: Shown,
    shadow: Option<shadow::Area>,
}

impl View {
    pub(super) fn new(common: &Common) -> View {
        let (device, layouts) = (&common.context.device, &common.context.layouts);
        let uniforms = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("sky uniforms"),
            size: size_of::<Uniforms>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let sky = ViewTexture::new(device, SkyView::image_size(&common.pack_data.sky));
        let catalogue = CatalogueTexture::new(device, common.pack_data.catalogue.is_some());
        let textures = &common.textures;
        View {
            shared: textures.group(
                device,
                layouts,
                &uniforms,
                [&sky.texture, &catalogue.texture],
            ),
            dome: common.dome.clone(),
            pipelines: [const { None }; Method::ALL.len()],
            #[cfg(feature = "sprites")]
            sprites: SpriteLayer::default(),
            shadow: None,
            scale: 1.0,
            prepared: None,
            uniforms,
            sky,
            catalogue,
        }
    }

    /// Makes what a method needs with a sky model.
    pub(super) fn load(&mut self, common: &Common, method: Method, sky: SkyModel) {
        let params = SkyParams {
            method,
            sky,
            ..SkyParams::default()
        };
        let context = &common.context;
        #[cfg(feature = "sprites")]
        self.sprites.ensure(context, &common.stock, &params);
        ensured(&mut self.pipelines, context, &params.dome());
    }

    /// Computes a frame: see [`Sky::prepare`](super::Sky::prepare).
    pub(super) fn record(
        &mut self,
        common: &Common,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
    ) {
        let clamped = drawn(params.clamped(), common.context.build.output);
        let data = &common.pack_data;
        let moment = (data.moment(&clamped, seconds), [clamped.haze, clamped.moon]);
        let lit = self
            .sky
            .lit(queue, moment, |moment| data.lit_sky_at(moment));
        let clamped = data.exposed(lit, clamped, seconds);
        let params = clamped.dome();
        let mut uniforms = data.uniforms_under(lit, &clamped, camera, seconds, common.step);
        let seconds = finite(seconds);
        if let Some(texels) =
            data.star_texels(lit, &clamped, (camera, &{ uniforms.camera }), seconds)
        {
            self.catalogue.write(queue, &texels);
        }
        #[cfg(feature = "sprites")]
        {
            let frame = sprites::frame::Frame {
                params: &clamped,
                camera,
                seconds,
                screen: &{ uniforms.camera },
                look: &{ uniforms.sprites },
            };
            let from = (&common.context, &common.stock);
            let shared = &self.shared;
            self.sprites.record(from, queue, encoder, shared, &frame);
            // They leave the flare what comes through them.
            if uniforms.flares.strength > 0.0 {
                let sun = uniforms.sky.sun_direction;
                uniforms.flares.strength *= self.sprites.clear_towards_sun(&frame, sun);
            }
        }
        if common.context.build.output == Output::Radiance {
            uniforms.tonemap.exposure = self.scale;
        }
        queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&uniforms));
        let own = ensured(&mut self.pipelines, &common.context, &params);
        if let Some(map) = &mut own.map {
            let frame = MapFrame {
                params: &params,
                seconds,
                uniforms: &uniforms,
                pack: &common.pack_data,
            };
            map.record(queue, encoder, &self.shared, &frame);
        }
        let area = shadow::Area::of(&params, camera.position_m().as_dvec3());
        if area.is_some() {
            let new = || shadow::Target::new(&common.context.device);
            let target = self.shadow.get_or_insert_with(new);
            own.record_shadow(&common.context, encoder, &self.shared, &target.view);
            #[cfg(feature = "sprites")]
            self.sprites
                .cast(Behind::of(&params), encoder, &self.shared, &target.view);
        }
        let variant = Variant::of(&uniforms, params.sea);
        #[cfg(feature = "weather")]
        let weather = overlays::shown(&uniforms.rays, &uniforms.rain);
        #[cfg(feature = "weather")]
        own.record_weather(&common.context, weather, encoder, &self.shared);
        // A flash that is told is made ready for before it begins.
        #[cfg(feature = "weather")]
        if variant.weather || params.weather.lightning.strength > 0.0 {
            own.ensure_sky(&common.context, params.sky, true, params.sea);
        }
        self.prepared = Some(Prepared {
            method: params.method,
            sky: params.sky,
            #[cfg(feature = "sprites")]
            behind: Behind::of(&params),
            variant,
            flare: uniforms.flares.strength > 0.0,
            #[cfg(feature = "weather")]
            weather,
            shadow: area,
        });
    }

    /// See [`Sky::light`](super::Sky::light).
    pub(super) fn light(&self, common: &Common, params: &SkyParams, seconds: f64) -> SkyLight {
        let (data, clamped) = (&common.pack_data, params.clamped());
        let moment = (data.moment(&clamped, seconds), [clamped.haze, clamped.moon]);
        match self.sky.kept(&moment) {
            Some(lit) => data.light_under(lit, &clamped, seconds),
            None => data.light_under(&data.lit_sky_at(&moment), &clamped, seconds),
        }
    }

    /// Draws the prepared frame into a pass whose attachments are as the configuration said.
    ///
    /// Before the first frame was prepared there is nothing to draw.
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
        self.sprites.draw(pass, prepared.behind);
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

    /// See [`Sky::reset_history`](super::Sky::reset_history).
    pub fn reset_history(&mut self) {
        #[cfg(feature = "sprites")]
        self.sprites.reset_history();
    }

    /// Sets the factor on the radiance that a float target gets, from the next frame that is prepared on; 1 until then. It is for renderers that
    /// expose what they light before they write it, and what it makes is at most the largest half float. What is no positive number counts as 1.
    pub fn set_scale(&mut self, scale: f32) {
        self.scale = match scale.is_finite() && scale > 0.0 {
            true => scale,
            false => 1.0,
        };
    }

    /// See [`Sky::sprites_drawn`](super::Sky::sprites_drawn).
    #[cfg(feature = "sprites")]
    pub fn sprites_drawn(&self) -> [u64; 2] {
        self.sprites.drawn()
    }

    /// See [`Sky::ring_bytes`](super::Sky::ring_bytes).
    #[cfg(feature = "sprites")]
    pub fn ring_bytes(&self) -> u64 {
        self.sprites.ring_bytes()
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
    /// None where [`SkyParams::shadow_extent_m`] is 0.
    pub fn shadow(&self) -> Option<Shadow<'_>> {
        let area = self.prepared?.shadow?;
        Some(Shadow {
            texture: &self.shadow.as_ref()?.texture,
            centre_m: area.centre_m.as_vec2().to_array(),
            extent_m: area.extent_m as f32,
        })
    }

    /// Bytes of what it draws off screen for a method.
    pub fn memory_bytes(&self, method: Method) -> u64 {
        let own = self.pipelines[method as usize].as_ref();
        let drawn = own.map_or(0, MethodPipelines::bytes);
        #[cfg(feature = "sprites")]
        let drawn = match method {
            Method::Sprites => drawn + self.sprites.bytes(),
            _ => drawn,
        };
        drawn
    }

    fn current(&self) -> Option<(Prepared, &MethodPipelines)> {
        let prepared = self.prepared?;
        Some((prepared, self.pipelines[prepared.method as usize].as_ref()?))
    }
}

/// Parameters without what a picture of opacity has nothing of.
fn drawn(params: SkyParams, output: Output) -> SkyParams {
    match output {
        Output::Radiance | Output::Display | Output::Encoded => params,
        Output::Opacity => SkyParams {
            flare: 0.0,
            weather: WeatherParams::default(),
            ..params
        },
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
