//! What one method needs on a device: its pipelines, its off-screen pass, and what is drawn over its sky.

use crate::device::context::{Context, Dome, Shader};
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
    /// Of each sky model, at its place in [`SkyModel::ALL`]; without weather, and with it.
    pipelines: [[Option<[wgpu::RenderPipeline; 4]>; 2]; SkyModel::ALL.len()],
    pub flare: Option<wgpu::RenderPipeline>,
    /// The off-screen pass of its clouds, if it has one.
    pub map: Option<Box<dyn MapPass>>,
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
        });
        let flare = || context.overlay(&shader, own, &Overlay::FLARE);
        let mut models = [const { [const { None }; 2] }; SkyModel::ALL.len()];
        models[sky as usize][0] = Some(context.pipelines(&shader, own, false));
        MethodPipelines {
            method,
            shading,
            pipelines: models,
            flare: context.blends.then(flare),
            map: method.clouds().map(context, &shader, params),
            #[cfg(feature = "weather")]
            weather: Overlays::default(),
        }
    }

    /// Makes what is not there yet for the parameters.
    pub fn ensure(&mut self, context: &Context, params: &SkyParams) {
        self.ensure_sky(context, params.sky, false);
        if let Some(map) = &mut self.map {
            map.ensure(context, params);
        }
    }

    /// Makes the pipelines of a sky model, with weather or without.
    pub fn ensure_sky(&mut self, context: &Context, sky: SkyModel, weather: bool) {
        let dome = Dome {
            method: self.method,
            shading: self.shading,
            sky,
            weather,
        };
        self.pipelines[sky as usize][usize::from(weather)].get_or_insert_with(|| {
            let own = dome.method.clouds().own_layout(&context.layouts);
            context.pipelines(&Shader::new(dome), own, weather)
        });
    }

    /// What draws the sky of a frame, if it was made.
    pub fn pipeline(&self, sky: SkyModel, variant: Variant) -> Option<&wgpu::RenderPipeline> {
        let made = self.pipelines[sky as usize][usize::from(variant.weather)].as_ref()?;
        Some(&made[variant.index()])
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
