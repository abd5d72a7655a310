//! A canvas with a device behind it.
//!
//! The picture goes through an sRGB view, so that sprites, rain and flares are blended as in the native programs' frames. WebGPU
//! lends such a view of a canvas that is not sRGB itself, WebGL2 has such a canvas.

use web_sys::HtmlCanvasElement;

/// What to draw with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Backend {
    WebGpu,
    WebGl2,
}

impl Backend {
    /// The name in the JavaScript interface.
    pub const fn name(self) -> &'static str {
        match self {
            Backend::WebGpu => "webgpu",
            Backend::WebGl2 => "webgl2",
        }
    }

    const fn wgpu(self) -> wgpu::Backends {
        match self {
            Backend::WebGpu => wgpu::Backends::BROWSER_WEBGPU,
            Backend::WebGl2 => wgpu::Backends::GL,
        }
    }
}

/// An open canvas.
#[derive(Debug)]
pub(crate) struct Canvas {
    pub backend: Backend,
    pub adapter: wgpu::AdapterInfo,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    view_format: wgpu::TextureFormat,
}

impl Canvas {
    /// Opens a canvas with `auto`, `webgpu` or `webgl2`. `auto` is WebGPU where it gives an adapter, else WebGL2.
    ///
    /// A canvas gives one kind of context in its life, so it is not touched before a device of that kind is there.
    pub async fn open(element: HtmlCanvasElement, wanted: &str) -> Result<Canvas, String> {
        match wanted {
            "webgpu" => Canvas::open_with(element, Backend::WebGpu).await,
            "webgl2" => Canvas::open_with(element, Backend::WebGl2).await,
            "auto" => match Canvas::open_with(element.clone(), Backend::WebGpu).await {
                Ok(canvas) => Ok(canvas),
                Err(_) => Canvas::open_with(element, Backend::WebGl2).await,
            },
            _ => Err(format!(
                "backend is \"{wanted}\", expected auto, webgpu or webgl2"
            )),
        }
    }

    async fn open_with(element: HtmlCanvasElement, backend: Backend) -> Result<Canvas, String> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = backend.wgpu();
        let instance = wgpu::Instance::new(descriptor);
        let size = [element.width(), element.height()];
        let surface = || {
            let target = wgpu::SurfaceTarget::Canvas(element.clone());
            let surface = instance.create_surface(target);
            surface.map_err(|e| format!("{}: cannot draw to the canvas: {e}", backend.name()))
        };
        // WebGL2 has no adapter without a canvas.
        let mut made = None;
        if backend == Backend::WebGl2 {
            made = Some(surface()?);
        }
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: made.as_ref(),
            ..Default::default()
        };
        let adapter = instance.request_adapter(&options).await.map_err(|_| {
            let name = backend.name();
            format!("{name}: this browser gives no graphics adapter; update it, or turn on hardware acceleration")
        })?;
        let limits = wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits());
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("welkin"),
            required_limits: limits,
            ..Default::default()
        };
        let (device, queue) = adapter
            .request_device(&descriptor)
            .await
            .map_err(|e| format!("{}: the adapter gives no device: {e}", backend.name()))?;
        let surface = match made {
            Some(surface) => surface,
            None => surface()?,
        };
        let (config, view_format) = configuration(&surface, &adapter, size)
            .ok_or_else(|| format!("{}: the canvas has no format of 8 bits", backend.name()))?;
        let mut canvas = Canvas {
            backend,
            adapter: adapter.get_info(),
            device,
            queue,
            surface,
            config,
            view_format,
        };
        canvas.resize(size);
        Ok(canvas)
    }

    /// The format that is drawn into.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.view_format
    }

    /// Pixels a row, and rows.
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// The most pixels a side.
    pub fn max_side(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }

    /// Gives the canvas so many pixels, 1 to [`Canvas::max_side`] a side.
    pub fn resize(&mut self, size: [u32; 2]) {
        let most = self.max_side();
        let [width, height] = size.map(|side| side.clamp(1, most));
        (self.config.width, self.config.height) = (width, height);
        self.surface.configure(&self.device, &self.config);
    }

    /// The texture of the next frame with its view; none while the browser has none to give.
    pub fn next(&self) -> Result<Option<(wgpu::SurfaceTexture, wgpu::TextureView)>, String> {
        use wgpu::CurrentSurfaceTexture as Current;
        let mut current = self.surface.get_current_texture();
        if matches!(current, Current::Outdated | Current::Lost) {
            self.surface.configure(&self.device, &self.config);
            current = self.surface.get_current_texture();
        }
        match current {
            Current::Success(texture) | Current::Suboptimal(texture) => {
                let view = texture.texture.create_view(&wgpu::TextureViewDescriptor {
                    format: Some(self.view_format),
                    ..Default::default()
                });
                Ok(Some((texture, view)))
            }
            Current::Timeout | Current::Occluded => Ok(None),
            Current::Outdated | Current::Lost | Current::Validation => {
                Err("the canvas gives no picture to draw into".to_string())
            }
        }
    }
}

/// An opaque canvas, and the sRGB format in which it is drawn.
fn configuration(
    surface: &wgpu::Surface<'_>,
    adapter: &wgpu::Adapter,
    [width, height]: [u32; 2],
) -> Option<(wgpu::SurfaceConfiguration, wgpu::TextureFormat)> {
    let formats = surface.get_capabilities(adapter).formats;
    let format = formats
        .iter()
        .find(|format| format.is_srgb())
        .or_else(|| formats.iter().find(|f| f.add_srgb_suffix().is_srgb()))?;
    let view_format = format.add_srgb_suffix();
    let mut config = surface.get_default_config(adapter, width.max(1), height.max(1))?;
    config.format = *format;
    config.alpha_mode = wgpu::CompositeAlphaMode::Opaque;
    config.view_formats = if view_format == *format {
        Vec::new()
    } else {
        vec![view_format]
    };
    Some((config, view_format))
}
