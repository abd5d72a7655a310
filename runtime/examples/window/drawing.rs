//! The window's device, and a frame: hills, the sky behind them, a tone curve over both.

use std::sync::Arc;

use welkin_runtime::glam::camera::rh::{proj::directx as projection, view};
use welkin_runtime::glam::{Mat4, Quat, Vec3};
use welkin_runtime::{Camera, Sky, SkyParams, wgpu};
use winit::dpi::LogicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

use crate::scene;

pub struct Drawing {
    pub window: Arc<Window>,
    device: wgpu::Device,
    queue: wgpu::Queue,
    surface: wgpu::Surface<'static>,
    surface_config: wgpu::SurfaceConfiguration,
    sky: Sky,
    hills: scene::Hills,
    tone: scene::Tone,
    /// Radiance and depth.
    targets: [wgpu::TextureView; 2],
}

fn targets(device: &wgpu::Device, size_px: [u32; 2]) -> [wgpu::TextureView; 2] {
    let size_px = size_px.map(|side| side.max(1));
    [scene::RADIANCE, scene::DEPTH].map(|format| scene::target(device, format, size_px, 1).1)
}

impl Drawing {
    pub fn new(event_loop: &ActiveEventLoop) -> scene::Result<Drawing> {
        let attributes = Window::default_attributes()
            .with_title(
                "Hills under the sky: arrows turn hours and bring clouds, 1 to 5 choose the method",
            )
            .with_inner_size(LogicalSize::new(1280, 720));
        let window = Arc::new(event_loop.create_window(attributes)?);
        let display = Box::new(event_loop.owned_display_handle());
        let instance = wgpu::Instance::new(
            wgpu::InstanceDescriptor::new_with_display_handle_from_env(display),
        );
        let surface = instance.create_surface(window.clone())?;
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions {
            compatible_surface: Some(&surface),
            ..Default::default()
        }))?;
        let (device, queue) = scene::open(&adapter)?;
        let [width, height]: [u32; 2] = window.inner_size().into();
        let mut surface_config = surface
            .get_default_config(&adapter, width.max(1), height.max(1))
            .ok_or("the adapter does not draw to this window")?;
        surface_config.present_mode = wgpu::PresentMode::AutoVsync;
        // The tone curve gives linear light: the target has to encode it.
        let formats = surface.get_capabilities(&adapter).formats;
        let encoding = formats.iter().find(|format| format.is_srgb());
        surface_config.format = *encoding.ok_or("the window has no sRGB format")?;
        surface.configure(&device, &surface_config);
        let config = scene::radiance_config(1);
        Ok(Drawing {
            sky: Sky::new(&device, &queue, config, &scene::pack()?)?,
            hills: scene::Hills::new(&device, &config),
            tone: scene::Tone::new(&device, surface_config.format),
            targets: targets(&device, [width, height]),
            window,
            device,
            queue,
            surface,
            surface_config,
        })
    }

    pub fn resize(&mut self, [width, height]: [u32; 2]) {
        // A window that is minimised has no size: it keeps the one that it had.
        if width > 0 && height > 0 {
            (self.surface_config.width, self.surface_config.height) = (width, height);
            self.surface.configure(&self.device, &self.surface_config);
            self.targets = targets(&self.device, [width, height]);
        }
    }

    /// Draws a frame.
    ///
    /// # Errors
    /// The surface or the device is gone; a program would open both anew.
    pub fn draw(
        &mut self,
        params: &SkyParams,
        [azimuth, elevation]: [f32; 2],
        seconds: f64,
    ) -> scene::Result<()> {
        use wgpu::CurrentSurfaceTexture::{Occluded, Outdated, Suboptimal, Success, Timeout};
        let (device, queue) = (&self.device, &self.queue);
        let frame = match self.surface.get_current_texture() {
            Success(frame) | Suboptimal(frame) => frame,
            Outdated => {
                self.surface.configure(device, &self.surface_config);
                return Ok(());
            }
            // Nobody sees it, or the screen is not ready: the next one will do.
            Timeout | Occluded => return Ok(()),
            _ => return Err("the window's surface was lost".into()),
        };
        let size_px = [self.surface_config.width, self.surface_config.height];
        let eye = Vec3::new(0.0, 40.0, 0.0);
        let turn = Quat::from_rotation_y(-azimuth) * Quat::from_rotation_x(elevation);
        let from_world: Mat4 = view::look_to_mat4(eye, turn * Vec3::NEG_Z, turn * Vec3::Y);
        let aspect = size_px[0] as f32 / size_px[1] as f32;
        let lens = projection::perspective_infinite_reverse(1.0, aspect, 0.1);
        let camera = Camera::from_matrices(from_world, lens, size_px);

        let [radiance, depth] = &self.targets;
        let mut encoder = device.create_command_encoder(&Default::default());
        self.sky
            .prepare(queue, &mut encoder, params, &camera, seconds);
        let light = self.sky.light(params, seconds);
        let clip_from_world = lens * from_world;
        let shadow = self.sky.shadow();
        let seen = self
            .hills
            .view(device, clip_from_world, eye, &light, shadow);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[scene::colour(radiance, None)],
            depth_stencil_attachment: scene::far(depth),
            ..Default::default()
        });
        self.hills.draw(&mut pass, &seen);
        self.sky.draw(&mut pass);
        drop(pass);
        let shown = frame.texture.create_view(&Default::default());
        self.tone
            .draw(device, &mut encoder, radiance, &shown, light.exposure);
        queue.submit([encoder.finish()]);
        self.window.pre_present_notify();
        queue.present(frame);
        Ok(())
    }
}
