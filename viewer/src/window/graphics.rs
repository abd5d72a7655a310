//! The window's device, surface and sky: all that is lost when a device is lost, and made anew from the pack.

use std::sync::Arc;

use anyhow::{Result, anyhow};
use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};
use welkin_controls::Settings;
use welkin_pack::Pack;
use welkin_runtime::Sky;
use welkin_viewer::gpu::{Gpu, GpuError};
use welkin_viewer::headless::{begin_pass, draw_pass, new_sky};
use welkin_viewer::pass_times::{Part, PassTimes};
use welkin_viewer::wanted::Wanted;
use wgpu::CurrentSurfaceTexture::{Lost, Occluded, Outdated, Suboptimal, Success, Timeout};
use winit::event_loop::{EventLoopProxy, OwnedDisplayHandle};
use winit::window::Window;

use super::state::Times;
use super::wake::Wake;

pub struct Graphics {
    pub gpu: Gpu,
    pub window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    sky: Sky,
    painter: Renderer,
    pub egui: egui_winit::State,
    times: Option<PassTimes>,
}

/// What a frame shows over the sky.
struct Panel {
    jobs: Vec<egui::ClippedPrimitive>,
    screen: ScreenDescriptor,
}

impl Graphics {
    /// Opens a device for the window and uploads the pack. The device's losses are told with its number.
    ///
    /// # Errors
    /// No adapter that draws to the window, or none that takes the pack.
    pub fn open(
        window: Arc<Window>,
        (display, wanted): (OwnedDisplayHandle, Option<&Wanted>),
        pack: &Pack,
        ui: egui::Context,
        (number, proxy): (u64, &EventLoopProxy<Wake>),
    ) -> Result<Graphics> {
        let instance = wgpu::Instance::new(
            wgpu::InstanceDescriptor::new_with_display_handle_from_env(Box::new(display)),
        );
        let surface = instance
            .create_surface(window.clone())
            .map_err(|reason| no_surface(&instance, reason))?;
        let (gpu, adapter) = Gpu::open_for(&instance, &surface, wanted)?;
        tell_losses(&gpu.device, number, proxy);
        let config = configuration(&surface, &adapter, &window)
            .ok_or_else(|| anyhow!("{}: cannot draw to this window", gpu.adapter))?;
        surface.configure(&gpu.device, &config);
        let egui = egui_winit::State::new(
            ui,
            egui::ViewportId::ROOT,
            &window,
            Some(window.scale_factor() as f32),
            None,
            Some(gpu.device.limits().max_texture_dimension_2d as usize),
        );
        Ok(Graphics {
            sky: new_sky(&gpu, pack, config.format)?,
            painter: Renderer::new(&gpu.device, config.format, RendererOptions::default()),
            times: PassTimes::new(&gpu),
            gpu,
            window,
            surface,
            config,
            egui,
        })
    }

    /// Shows another pack from the next frame on. The old one stays if this fails.
    ///
    /// # Errors
    /// See [`GpuError`].
    pub fn show(&mut self, pack: &Pack, settings: &Settings) -> Result<(), GpuError> {
        let mut sky = new_sky(&self.gpu, pack, self.config.format)?;
        sky.load(settings.params.method, settings.params.sky);
        self.sky = sky;
        Ok(())
    }

    pub fn size_px(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    pub fn resize(&mut self, [width, height]: [u32; 2]) {
        let most = self.gpu.device.limits().max_texture_dimension_2d;
        (self.config.width, self.config.height) = (width.clamp(1, most), height.clamp(1, most));
        self.surface.configure(&self.gpu.device, &self.config);
    }

    /// Draws a frame of the sky with the panel over it, and takes the times that have come back.
    ///
    /// # Errors
    /// The surface is lost: the graphics must be opened anew.
    pub fn draw(
        &mut self,
        settings: &Settings,
        mut output: egui::FullOutput,
        times: &mut Times,
    ) -> Result<()> {
        self.egui
            .handle_platform_output(&self.window, std::mem::take(&mut output.platform_output));
        // The panel's textures are taken even if no frame is to be had.
        for (id, deltas) in &output.textures_delta.set {
            for delta in deltas {
                self.painter
                    .update_texture(&self.gpu.device, &self.gpu.queue, *id, delta);
            }
        }
        let panel = Panel {
            jobs: self
                .egui
                .egui_ctx()
                .tessellate(std::mem::take(&mut output.shapes), output.pixels_per_point),
            screen: ScreenDescriptor {
                size_in_pixels: self.size_px(),
                pixels_per_point: output.pixels_per_point,
            },
        };
        let frame = match self.surface.get_current_texture() {
            Success(frame) => Some(frame),
            Suboptimal(_) | Outdated => {
                self.surface.configure(&self.gpu.device, &self.config);
                self.window.request_redraw();
                None
            }
            Timeout | Occluded => None,
            Lost => return Err(anyhow!("the window's surface was lost")),
            // Told by the device's own error.
            _ => None,
        };
        if let Some(frame) = frame {
            self.record(settings, &panel, &frame.texture);
            self.window.pre_present_notify();
            self.gpu.queue.present(frame);
        }
        for id in &output.textures_delta.free {
            self.painter.free_texture(id);
        }
        output.textures_delta.clear();
        // Times come back without being waited for.
        self.gpu.device.poll(wgpu::PollType::Poll).ok();
        for arrived in self.times.iter_mut().flat_map(PassTimes::arrived) {
            times.push_passes(arrived);
        }
        Ok(())
    }

    fn record(&mut self, settings: &Settings, panel: &Panel, texture: &wgpu::Texture) {
        let view = texture.create_view(&Default::default());
        let (device, queue) = (&self.gpu.device, &self.gpu.queue);
        let mut encoder = device.create_command_encoder(&Default::default());
        let timed = self.times.as_mut().and_then(|t| t.begin(&mut encoder));
        let camera = settings.camera([self.config.width, self.config.height]);
        let params = settings.frame_params();
        self.sky
            .prepare(queue, &mut encoder, &params, &camera, settings.at_s);
        let times = self.times.as_ref().zip(timed);
        if let Some((times, timed)) = times {
            times.off_screen_ends(timed, &mut encoder);
        }
        let jobs = &panel.jobs;
        let uploads = self
            .painter
            .update_buffers(device, queue, &mut encoder, jobs, &panel.screen);
        let writes = |part| times.map(|(times, timed)| times.writes(timed, part));
        draw_pass(&mut encoder, &view, writes(Part::Sky), |pass| {
            self.sky.draw(pass);
        });
        let over = begin_pass(&mut encoder, &view, wgpu::LoadOp::Load, writes(Part::Panel));
        self.painter
            .render(&mut over.forget_lifetime(), jobs, &panel.screen);
        if let Some((times, timed)) = times {
            times.end(timed, &mut encoder);
        }
        queue.submit(uploads.into_iter().chain([encoder.finish()]));
        if let Some((times, timed)) = self.times.as_mut().zip(timed) {
            times.submitted(timed);
        }
    }
}

/// Where there is no driver at all, that is the reason to tell.
fn no_surface(instance: &wgpu::Instance, reason: wgpu::CreateSurfaceError) -> anyhow::Error {
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    if adapters.is_empty() {
        return GpuError::NoAdapter.into();
    }
    anyhow!("the window takes no picture: {reason}; choose another WGPU_BACKEND")
}

/// Eight bits that the target encodes, so that what is blended over the sky is blended as `welkin-view render` does it; each frame
/// when the screen is ready for it.
fn configuration(
    surface: &wgpu::Surface<'_>,
    adapter: &wgpu::Adapter,
    window: &Window,
) -> Option<wgpu::SurfaceConfiguration> {
    let size = window.inner_size();
    let mut config = surface.get_default_config(adapter, size.width.max(1), size.height.max(1))?;
    let formats = surface.get_capabilities(adapter).formats;
    let encoded = [
        wgpu::TextureFormat::Bgra8UnormSrgb,
        wgpu::TextureFormat::Rgba8UnormSrgb,
    ];
    if let Some(format) = encoded.into_iter().find(|format| formats.contains(format)) {
        config.format = format;
    }
    config.present_mode = wgpu::PresentMode::AutoVsync;
    Some(config)
}

/// What the device says comes to the event loop as words, and never as a panic.
fn tell_losses(device: &wgpu::Device, number: u64, proxy: &EventLoopProxy<Wake>) {
    let lost = proxy.clone();
    // Nobody hears of it once the loop has ended.
    device.set_device_lost_callback(move |_, reason| {
        lost.send_event(Wake::DeviceLost(number, reason)).ok();
    });
    let error = std::sync::Mutex::new(proxy.clone());
    device.on_uncaptured_error(Arc::new(move |told: wgpu::Error| {
        if let Ok(error) = error.lock() {
            error.send_event(Wake::DeviceError(told.to_string())).ok();
        }
    }));
}
