//! Frames without a window: draws one into a texture and reads it back.

use welkin_pack::Pack;
use welkin_runtime::{Camera, Sky, SkyConfig, SkyLight, SkyParams};

use crate::frame::{Frame, Pixels, Target};
use crate::gpu::{Gpu, GpuError};
use crate::read_back::Texels;

/// What to look at: the sky's parameters, the camera and the moment.
#[derive(Clone, Debug)]
pub struct View {
    /// Parameters of the sky.
    pub params: SkyParams,
    /// Camera, with the size of the frame.
    pub camera: Camera,
    /// Time since the start of the animation, in seconds.
    pub seconds: f64,
}

/// What was drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The sky.
    pub frame: Frame,
    /// The clouds' shadows on the ground, where the sky has them: rows from north to south, texels from west to east, each the
    /// share of direct light that the clouds let through. See [`welkin_runtime::shadow`].
    pub shadow: Option<Frame>,
}

/// Draws one frame of a pack's sky.
///
/// # Errors
/// See [`GpuError`].
pub fn render(gpu: &Gpu, pack: &Pack, target: Target, view: &View) -> Result<Drawn, GpuError> {
    let mut stage = Stage::new(gpu, pack, target)?;
    Ok(Drawn {
        frame: stage.draw(view)?,
        shadow: stage.shadow()?,
    })
}

/// A sky and the texture that it is drawn into: one frame after the other, with what was uploaded and compiled kept.
#[derive(Debug)]
pub struct Stage<'a> {
    gpu: &'a Gpu,
    sky: Sky,
    target: Target,
    /// Of the size of the last frame.
    texture: Option<wgpu::Texture>,
}

impl<'a> Stage<'a> {
    /// A pack's sky, of which nothing is drawn yet.
    ///
    /// # Errors
    /// [`GpuError::Sky`].
    pub fn new(gpu: &'a Gpu, pack: &Pack, target: Target) -> Result<Stage<'a>, GpuError> {
        Ok(Stage {
            gpu,
            sky: new_sky(gpu, pack, target.texture_format())?,
            target,
            texture: None,
        })
    }

    /// The opacity of a pack's clouds instead of its sky: [`Sky::of_opacity`], in all channels of [`Target::Linear`].
    ///
    /// # Errors
    /// [`GpuError::Sky`].
    pub fn of_opacity(gpu: &'a Gpu, pack: &Pack) -> Result<Stage<'a>, GpuError> {
        let target = Target::Linear;
        let config = config(target.texture_format());
        Ok(Stage {
            gpu,
            sky: Sky::of_opacity(&gpu.device, &gpu.queue, config, pack)?,
            target,
            texture: None,
        })
    }

    /// The light that the view's sky gives to a scene: [`Sky::light`].
    pub fn light(&self, view: &View) -> SkyLight {
        self.sky.light(&view.params, view.seconds)
    }

    /// Forgets the frames before, as [`Sky::reset_history`].
    pub fn reset_history(&mut self) {
        self.sky.reset_history();
    }

    /// The view's parameters with the exposure that is drawn with: [`Sky::exposed`].
    pub fn exposed(&self, view: &View) -> SkyParams {
        self.sky.exposed(&view.params, view.seconds)
    }

    /// Draws a frame.
    ///
    /// # Errors
    /// [`GpuError::FrameSize`], [`GpuError::Device`].
    pub fn draw(&mut self, view: &View) -> Result<Frame, GpuError> {
        self.begin(view)?.wait(self.gpu)?.frame()
    }

    /// Draws a frame, as the bytes of its texture.
    pub(crate) fn draw_bytes(&mut self, view: &View) -> Result<Vec<u8>, GpuError> {
        self.begin(view)?.wait(self.gpu)?.0.texels.bytes()
    }

    /// Begins to draw a frame: all is submitted, and nothing waited for. Another may be begun before it has come back.
    ///
    /// # Errors
    /// [`GpuError::FrameSize`].
    pub fn begin(&mut self, view: &View) -> Result<Begun, GpuError> {
        let (gpu, target) = (self.gpu, self.target);
        let size = view.camera.viewport_px;
        let kept = self.texture.take();
        let texture = match kept.filter(|t| [t.width(), t.height()] == size) {
            Some(texture) => texture,
            None => gpu.target(target, size)?,
        };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.sky.prepare(
            &gpu.queue,
            &mut encoder,
            &view.params,
            &view.camera,
            view.seconds,
        );
        draw_pass(
            &mut encoder,
            &texture.create_view(&Default::default()),
            None,
            |pass| self.sky.draw(pass),
        );
        let texels = Texels::copied(gpu, encoder, &texture, target.bytes_per_pixel());
        self.texture = Some(texture);
        Ok(Begun { target, texels })
    }

    /// The shadows of the frame that was drawn last, if it has any.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn shadow(&self) -> Result<Option<Frame>, GpuError> {
        let shadow = self.sky.shadow();
        let shadow = shadow.map(|shadow| read_shares(self.gpu, shadow.texture));
        shadow.transpose()
    }
}

/// A sky that draws into a target of this format, without depth, one sample a pixel.
///
/// # Errors
/// [`GpuError::Sky`].
pub fn new_sky(
    gpu: &Gpu,
    pack: &Pack,
    target_format: wgpu::TextureFormat,
) -> Result<Sky, GpuError> {
    let config = config(target_format);
    Ok(Sky::new(&gpu.device, &gpu.queue, config, pack)?)
}

fn config(target_format: wgpu::TextureFormat) -> SkyConfig {
    SkyConfig {
        target_format,
        depth: None,
        sample_count: 1,
    }
}

/// Records one render pass that clears `view` and draws.
pub fn draw_pass(
    encoder: &mut wgpu::CommandEncoder,
    view: &wgpu::TextureView,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let clear = wgpu::LoadOp::Clear(wgpu::Color::BLACK);
    draw(&mut begin_pass(encoder, view, clear, timestamp_writes));
}

/// Begins a render pass into `view` alone.
pub fn begin_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    view: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
) -> wgpu::RenderPass<'a> {
    let colour = wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load,
            store: wgpu::StoreOp::Store,
        },
    };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(colour)],
        timestamp_writes,
        ..Default::default()
    })
}

/// A texture of one 8-bit channel on the CPU.
fn read_shares(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Frame, GpuError> {
    Ok(Frame {
        width: texture.width(),
        height: texture.height(),
        pixels: Pixels::Share8(read_texels(gpu, texture, 1)?),
    })
}

/// A texture on the CPU, without the padding that rows have in a buffer.
fn read_texels(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    bytes_per_texel: u32,
) -> Result<Vec<u8>, GpuError> {
    let encoder = gpu.device.create_command_encoder(&Default::default());
    let texels = Texels::copied(gpu, encoder, texture, bytes_per_texel);
    texels.wait(gpu)?;
    texels.bytes()
}

/// A frame that was begun: its pixels are on their way to the CPU.
#[derive(Debug)]
pub struct Begun {
    target: Target,
    texels: Texels,
}

impl Begun {
    /// Waits until the pixels are there.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn wait(self, gpu: &Gpu) -> Result<Back, GpuError> {
        self.texels.wait(gpu)?;
        Ok(Back(self))
    }
}

/// A frame whose pixels are there: any thread may take them.
#[derive(Debug)]
pub struct Back(Begun);

impl Back {
    /// The frame.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn frame(self) -> Result<Frame, GpuError> {
        let [width, height] = self.0.texels.size();
        let pixels = self.0.target.pixels(&self.0.texels.bytes()?);
        Ok(Frame {
            width,
            height,
            pixels,
        })
    }
}

#[cfg(test)]
mod tests {
    use half::f16;

    use super::*;
    use crate::reference::full_screen_pipeline;

    /// Writes the place of every pixel as its colour.
    const PLACES: &str = "
        @vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
            return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
        }
        @fragment fn place(@builtin(position) p: vec4f) -> @location(0) vec4f {
            return vec4f(floor(p.xy), 0.5, 1.0);
        }";

    #[test]
    fn every_pixel_comes_back_in_its_place_however_rows_are_padded() {
        let gpu = Gpu::open(None).unwrap();
        let pipeline = full_screen_pipeline(&gpu, PLACES, Target::Linear.texture_format(), "place");
        // Rows of 256 bytes need no padding, others do.
        for [width, height] in [[32, 5], [33, 4], [1, 1], [3, 70]] {
            let texture = gpu.target(Target::Linear, [width, height]).unwrap();
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            draw_pass(
                &mut encoder,
                &texture.create_view(&Default::default()),
                None,
                |pass| {
                    pass.set_pipeline(&pipeline);
                    pass.draw(0..3, 0..1);
                },
            );
            gpu.queue.submit([encoder.finish()]);
            let bytes = read_texels(&gpu, &texture, Target::Linear.bytes_per_pixel()).unwrap();
            let place =
                |i: u32| [(i % width) as f32, (i / width) as f32, 0.5, 1.0].map(f16::from_f32);
            let expected = (0..width * height).map(place).collect();
            assert_eq!(Target::Linear.pixels(&bytes), Pixels::Linear(expected));
        }
    }
}
