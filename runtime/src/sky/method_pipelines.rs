//! What one method needs on a device: its pipelines, its off-screen pass, and what is drawn over its sky.

use crate::clouds::shadow;
use crate::device::context::{Context, Dome, Shader};
use crate::device::map::draw;
use crate::device::pipeline::{Overlay, Variant};
use crate::methods::interface::MapPass;
use crate::params::{Method, Shading, SkyModel, SkyParams};
#[cfg(feature = "weather")]
use crate::weather::overlays::{Overlays, Shown};

/// A method on a device.
#[derive(Debug)]
pub(crate) struct MethodPipelines {
    method: Method,
    /// Of its clouds.
    pub shading: Shading,
    /// Of each sky model, at its place in [`SkyModel::ALL`], and of each [`Variant::shader`].
    pipelines: [[Option<[wgpu::RenderPipeline; 4]>; 4]; SkyModel::ALL.len()],
    pub flare: Option<wgpu::RenderPipeline>,
    /// The off-screen pass of its clouds, if it has one.
    pub map: Option<Box<dyn MapPass>>,
    /// Of its shadows on the ground, once they were asked for.
    shadow: Option<wgpu::RenderPipeline>,
    #[cfg(feature = "weather")]
    pub weather: Overlays,
}

impl MethodPipelines {
    /// What the method of the parameters needs, for their sky model.
    pub fn new(context: &Context, params: &SkyParams) -> MethodPipelines {
        let (method, sky, shading) = (params.method, params.sky, params.shading);
        let own = method.clouds().own_layout(&context.layouts);
        let shader = Shader::new(Dome {
            method,
            shading,
            sky,
            weather: false,
            sea: false,
        });
        let flare = || context.overlay(&shader, own, &Overlay::FLARE);
        MethodPipelines {
            method,
            shading,
            pipelines: [const { [const { None }; 4] }; SkyModel::ALL.len()],
            flare: context.blends.then(flare),
            map: method.clouds().map(context, &shader, params),
            shadow: None,
            #[cfg(feature = "weather")]
            weather: Overlays::default(),
        }
    }

    /// Makes what is not there yet for the parameters.
    pub fn ensure(&mut self, context: &Context, params: &SkyParams) {
        self.ensure_sky(context, params.sky, false, params.sea);
        if let Some(map) = &mut self.map {
            map.ensure(context, params);
        }
    }

    /// Makes the pipelines of a sky model, with weather or without, and with a sea or without.
    pub fn ensure_sky(&mut self, context: &Context, sky: SkyModel, weather: bool, sea: bool) {
        let dome = Dome {
            method: self.method,
            shading: self.shading,
            sky,
            weather,
            sea,
        };
        let shader = usize::from(weather) + 2 * usize::from(sea);
        self.pipelines[sky as usize][shader].get_or_insert_with(|| {
            let own = dome.method.clouds().own_layout(&context.layouts);
            context.pipelines(&Shader::new(dome), own)
        });
    }

    /// What draws the sky of a frame, if it was made.
    pub fn pipeline(&self, sky: SkyModel, variant: Variant) -> Option<&wgpu::RenderPipeline> {
        let made = self.pipelines[sky as usize][variant.shader()].as_ref()?;
        Some(&made[variant.index()])
    }

    /// Records the shadows of its clouds on the ground. The map of the frame was recorded.
    pub fn record_shadow(
        &mut self,
        context: &Context,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        target: &wgpu::TextureView,
    ) {
        let dome = Dome {
            method: self.method,
            shading: self.shading,
            sky: SkyModel::default(),
            weather: false,
            sea: false,
        };
        let own = self.method.clouds().own_layout(&context.layouts);
        let new = || context.off_screen(&Shader::new(dome), "fs_shadow", own, shadow::FORMAT);
        let pipeline = self.shadow.get_or_insert_with(new);
        match &self.map {
            Some(map) => draw(encoder, target, pipeline, [shared, map.group()]),
            None => draw(encoder, target, pipeline, [shared]),
        }
    }

    /// Records rays and rain.
    #[cfg(feature = "weather")]
    pub fn record_weather(
        &mut self,
        context: &Context,
        shown: Shown,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
    ) {
        let layout = self.method.clouds().own_layout(&context.layouts);
        let own = layout.zip(self.map.as_ref().map(|map| map.group()));
        let clouds = (self.method, self.shading);
        self.weather
            .record(context, clouds, shown, encoder, shared, own);
    }

    /// Bytes of the textures that it draws.
    pub fn bytes(&self) -> u64 {
        let map = self.map.as_ref().map_or(0, |map| map.bytes());
        #[cfg(feature = "weather")]
        let map = map + self.weather.bytes();
        map
    }
}
