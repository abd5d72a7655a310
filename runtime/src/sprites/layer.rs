//! The clouds in space that are drawn over a dome: what a pack has of them, and what draws it once it is asked for.

use glam::Vec3;
use welkin_pack::{Field, Pack, Role};

use super::frame::Frame;
use super::outline::{Outline, outlines};
use super::pass::Pass;
use super::pipelines::Behind;
use crate::device::context::Context;
use crate::error::{SkyError, texture};
use crate::params::{Method, SkyParams};

/// What a pack has of clouds in space.
#[derive(Debug)]
pub(crate) struct Stock {
    field: Option<Field>,
    outlines: Vec<Outline>,
}

impl Stock {
    /// Of a pack.
    ///
    /// # Errors
    /// [`SkyError::MissingTexture`].
    pub fn new(pack: &Pack) -> Result<Stock, SkyError> {
        Ok(Stock {
            field: pack.field().cloned(),
            outlines: outlines(texture(pack, Role::Sprites)?),
        })
    }

    /// Whether it has any.
    pub fn has_field(&self) -> bool {
        self.field.is_some()
    }
}

/// The clouds in space of a view; of a pack without a field it never shows any.
#[derive(Debug, Default)]
pub(crate) struct SpriteLayer {
    pass: Option<Box<Pass>>,
    /// Whether the prepared frame shows them.
    is_shown: bool,
}

impl SpriteLayer {
    /// Makes what draws them, if the parameters want them and pack and target allow them.
    pub fn ensure(&mut self, context: &Context, stock: &Stock, params: &SkyParams) {
        let (Some(field), Some(atlas)) = (&stock.field, context.own_texture(Method::Sprites))
        else {
            return;
        };
        if params.method != Method::Sprites || !context.blends {
            return;
        }
        let new = || {
            let distance_m = params.sprites.distance_m;
            Pass::new(context, atlas, field, &stock.outlines, distance_m)
        };
        let pass = self.pass.get_or_insert_with(|| new().into());
        pass.load(context, Behind::of(params));
    }

    /// Computes a frame and records the pictures of the ring that it draws. Parameters are in range.
    pub fn record(
        &mut self,
        (context, stock): (&Context, &Stock),
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        frame: &Frame<'_>,
    ) {
        self.ensure(context, stock, frame.params);
        let wanted = self
            .pass
            .as_mut()
            .filter(|_| frame.params.method == Method::Sprites);
        self.is_shown = wanted.is_some();
        if let Some(pass) = wanted {
            pass.record(context, queue, encoder, shared, frame);
        }
    }

    /// Draws the shadows of the recorded frame over those of the dome behind, if it has any.
    pub fn cast(
        &self,
        behind: Behind,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        target: &wgpu::TextureView,
    ) {
        if let Some(shown) = self.shown() {
            shown.record_cast(behind, encoder, shared, target);
        }
    }

    /// The fraction of the sun's light that comes through to the viewer.
    pub fn clear_towards_sun(&self, frame: &Frame<'_>, sun: Vec3) -> f32 {
        let shown = self.shown();
        shown.map_or(1.0, |pass| pass.clear_towards_sun(frame, sun))
    }

    /// Draws the recorded frame over the sky.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, behind: Behind) {
        if let Some(shown) = self.shown() {
            shown.draw(pass, behind);
        }
    }

    /// Forgets what it knows of earlier frames: the next one is as that of a new sky.
    pub fn reset_history(&mut self) {
        if let Some(pass) = &mut self.pass {
            pass.reset_history();
        }
    }

    /// Sprites that the recorded frame draws, on the screen and into the ring.
    pub fn drawn(&self) -> [u64; 2] {
        self.shown().map_or([0; 2], Pass::drawn)
    }

    /// Bytes of the ring's pictures.
    pub fn ring_bytes(&self) -> u64 {
        self.pass.as_ref().map_or(0, |pass| pass.ring_bytes())
    }

    /// Bytes of the textures that are drawn.
    pub fn bytes(&self) -> u64 {
        self.pass.as_ref().map_or(0, |pass| pass.bytes())
    }

    fn shown(&self) -> Option<&Pass> {
        self.pass.as_deref().filter(|_| self.is_shown)
    }
}
