//! What one method needs on a device: its pipelines, its off-screen passes, and what is drawn over its sky.

use crate::clouds::{fbm_map, lit_map, octaves_map, shadow};
use crate::device::common::Common;
use crate::device::layouts::Layouts;
use crate::device::pipeline::{Overlay, Variant};
use crate::params::{Method, SkyModel};
use crate::weather::rays;

/// A method on a device.
#[derive(Debug)]
pub(crate) struct Program {
    method: Method,
    module: wgpu::ShaderModule,
    /// Of each sky model, at its place in [`SkyModel::ALL`]; without weather, and with it.
    pipelines: [[Option<[wgpu::RenderPipeline; 4]>; 2]; SkyModel::ALL.len()],
    pub flare: Option<wgpu::RenderPipeline>,
    pub map: OwnMap,
    // What follows is made when it is first asked for.
    shadow: Option<shadow::Pass>,
    pub rays: Option<rays::Pass>,
    pub rain: Option<wgpu::RenderPipeline>,
}

/// The off-screen part of a method.
#[derive(Debug)]
pub(crate) enum OwnMap {
    None,
    Octaves(Box<octaves_map::Pass>),
    Fbm(Box<fbm_map::Pass>),
    Lit(Box<lit_map::Pass>),
}

impl Program {
    /// A program without a sky's pipelines; `octaves` is how many [`Method::Octaves`] sums.
    pub fn new(common: &Common, method: Method, sky: SkyModel, octaves: u32) -> Program {
        let (device, layouts) = (&common.device, &common.layouts);
        let module = common.module(method, sky);
        let flare = || common.overlay(&module, own_layout(layouts, method), &Overlay::FLARE);
        let map = match method {
            Method::Packed | Method::Sprites => OwnMap::None,
            Method::Octaves => {
                OwnMap::Octaves(octaves_map::Pass::new(device, &module, layouts, octaves).into())
            }
            Method::Fbm => {
                OwnMap::Fbm(fbm_map::Pass::new(device, &module, layouts, &common.fbm).into())
            }
            Method::Lit => {
                OwnMap::Lit(lit_map::Pass::new(device, &module, layouts, &common.layers).into())
            }
        };
        let mut models = [const { [const { None }; 2] }; SkyModel::ALL.len()];
        models[sky as usize][0] =
            Some(common.pipelines(&module, own_layout(layouts, method), false));
        Program {
            method,
            pipelines: models,
            flare: common.blends.then(flare),
            map,
            shadow: None,
            rays: None,
            rain: None,
            module,
        }
    }

    /// Makes what is not there yet of a sky model, and the map anew if it is for another number of octaves.
    pub fn fit(&mut self, common: &Common, sky: SkyModel, octaves: u32) {
        self.fit_sky(common, sky, false);
        if let OwnMap::Octaves(pass) = &mut self.map {
            pass.fit(&common.device, &common.layouts, octaves);
        }
    }

    /// Makes the pipelines of a sky model, with weather or without.
    pub fn fit_sky(&mut self, common: &Common, sky: SkyModel, weather: bool) {
        let method = self.method;
        self.pipelines[sky as usize][usize::from(weather)].get_or_insert_with(|| {
            let module = common.module(method, sky);
            common.pipelines(&module, own_layout(&common.layouts, method), weather)
        });
    }

    /// What draws the sky of a frame, if it was made.
    pub fn pipeline(&self, sky: SkyModel, variant: Variant) -> Option<&wgpu::RenderPipeline> {
        let made = self.pipelines[sky as usize][usize::from(variant.weather)].as_ref()?;
        Some(&made[variant.index()])
    }

    /// Records the cloud shadows of the lit method.
    pub fn record_shadow(
        &mut self,
        common: &Common,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
    ) {
        let new = || shadow::Pass::new(&common.device, &self.module, &common.layouts);
        let pass = self.shadow.get_or_insert_with(new);
        if let Some(own) = self.map.group() {
            pass.record(encoder, shared, own);
        }
    }

    /// Records the rays, if the target can show them.
    pub fn record_rays(
        &mut self,
        common: &Common,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
    ) {
        if !common.blends {
            return;
        }
        let (device, layouts) = (&common.device, &common.layouts);
        let new = || {
            let overlay = common.overlay(&self.module, Some(&layouts.texture), &Overlay::RAYS);
            let own = own_layout(layouts, self.method);
            rays::Pass::new(device, &self.module, layouts, own, overlay)
        };
        let pass = self.rays.get_or_insert_with(new);
        pass.record(encoder, shared, self.map.group());
    }

    /// Makes what draws rain, if the target can show it.
    pub fn fit_rain(&mut self, common: &Common) {
        let new = || common.overlay(&self.module, None, &Overlay::RAIN);
        if common.blends {
            self.rain.get_or_insert_with(new);
        }
    }

    /// The cloud shadows, if they were ever asked for.
    pub fn shadow(&self) -> Option<&wgpu::Texture> {
        self.shadow.as_ref().map(shadow::Pass::texture)
    }

    /// Bytes of the textures that it draws.
    pub fn bytes(&self) -> u64 {
        let map = match &self.map {
            OwnMap::None => 0,
            OwnMap::Octaves(pass) => pass.bytes(),
            OwnMap::Fbm(pass) => pass.bytes(),
            OwnMap::Lit(pass) => pass.bytes(),
        };
        let rays = self.rays.as_ref().map_or(0, rays::Pass::bytes);
        map + rays + self.shadow().map_or(0, crate::device::map::texture_bytes)
    }
}

impl OwnMap {
    /// Group 1 of the dome.
    pub fn group(&self) -> Option<&wgpu::BindGroup> {
        match self {
            OwnMap::None => None,
            OwnMap::Octaves(pass) => Some(&pass.map.group),
            OwnMap::Fbm(pass) => Some(&pass.map.group),
            OwnMap::Lit(pass) => Some(&pass.group),
        }
    }

    pub fn texture(&self) -> Option<&wgpu::Texture> {
        match self {
            OwnMap::None => None,
            OwnMap::Octaves(pass) => Some(pass.map.texture()),
            OwnMap::Fbm(pass) => Some(pass.map.texture()),
            OwnMap::Lit(pass) => Some(pass.texture()),
        }
    }
}

/// What the dome of a method reads in group 1.
pub(crate) fn own_layout(layouts: &Layouts, method: Method) -> Option<&wgpu::BindGroupLayout> {
    match method {
        Method::Packed | Method::Sprites => None,
        Method::Octaves | Method::Fbm => Some(&layouts.texture),
        Method::Lit => Some(&layouts.lit),
    }
}
