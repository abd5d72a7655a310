//! The noise and detail channels: periodic fractal noise.

use welkin_pack::Image;
use welkin_pack::manifest::FractalNoise;

use crate::filter;
use crate::fractal::{Fractal, Octaves};
use crate::stream::Stream;

/// Share of the texels that is clipped to 0.
const CLIPPED: f32 = 0.002;

/// Where outliers are bent in, in standard deviations.
const OUTLIER: f32 = 4.0;

/// Spread below which noise is flat. One octave of one cell has two lattice points; where the gradients of both cancel, as
/// of one seed in a hundred, nothing is left, and it is drawn again. Other noise has 0.06 or more.
const FLAT: f32 = 1e-3;

/// A channel of `size` texels a side that tiles, with the settings' mean. `name` is its random stream.
pub(crate) fn channel(settings: &FractalNoise, size: u32, seed: u64, name: &str) -> Image {
    let cells = [f64::from(settings.cells); 2];
    let octaves = Octaves::new(settings.octaves, settings.gain);
    let mut stream = Stream::new(seed, name);
    let mut channel = loop {
        let fractal = Fractal::new(cells, octaves, size, &mut stream);
        let drawn = filter::tile(size, |point| fractal.at(point));
        if drawn.mean_and_spread(0).1 > FLAT {
            break drawn;
        }
    };
    filter::calibrate(&mut channel, CLIPPED, OUTLIER, settings.mean);
    channel
}
