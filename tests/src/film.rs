//! What clouds cover: their opacity, from two skies that differ only behind them.

use welkin_pack::Field;
use welkin_runtime::{Camera, Sky, SkyParams};

use crate::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// The default clouds before a black and before a white picture: what differs shows through them.
#[derive(Debug)]
pub struct Film {
    black: Sky,
    white: Sky,
}

impl Film {
    /// Makes both skies.
    pub fn new() -> Film {
        Film {
            black: gpu::sky(&pack::in_skybox(0.0), FORMAT),
            white: gpu::sky(&pack::in_skybox(1.0), FORMAT),
        }
    }

    /// The same with clouds in space.
    ///
    /// # Panics
    /// If the packs do not take the field.
    pub fn with_field(field: &Field) -> Film {
        let sky = |radiance| {
            let pack = pack::in_skybox(radiance).with_field(field.clone());
            gpu::sky(&pack.expect("the field is sound"), FORMAT)
        };
        Film {
            black: sky(0.0),
            white: sky(1.0),
        }
    }

    /// Opacity of the clouds at every pixel.
    pub fn alpha(&mut self, params: &SkyParams, view: &Camera, seconds: f64) -> Vec<f32> {
        let params = SkyParams {
            flare: 0.0,
            skybox: 1.0,
            ..*params
        };
        let white = gpu::render(&mut self.white, FORMAT, &params, view, seconds);
        let black = gpu::render(&mut self.black, FORMAT, &params, view, seconds);
        let through = white.iter().zip(&black).map(|(w, b)| w[1] - b[1]);
        through.map(|through| 1.0 - through).collect()
    }
}

impl Default for Film {
    fn default() -> Film {
        Film::new()
    }
}
