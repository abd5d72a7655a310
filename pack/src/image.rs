//! The linear float image: what a bake makes, before it is quantised.

/// A linear image of 32-bit floats.
///
/// Texel `(x, y)` has its centre at `u = (x + 0.5) / width`, `v = (y + 0.5) / height`; x grows to the
/// right, y downwards. Channels of a texel lie side by side, rows follow each other from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Texels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Channels a texel.
    pub channels: usize,
    /// `width * height * channels` values.
    pub texels: Vec<f32>,
}

impl Image {
    /// An image of zeros.
    pub fn new(width: u32, height: u32, channels: usize) -> Image {
        Image {
            width,
            height,
            channels,
            texels: vec![0.0; width as usize * height as usize * channels],
        }
    }

    /// Index of channel 0 of texel `(x, y)`.
    pub fn index(&self, x: u32, y: u32) -> usize {
        (y as usize * self.width as usize + x as usize) * self.channels
    }

    /// The channels of texel `(x, y)`.
    pub fn texel(&self, x: u32, y: u32) -> &[f32] {
        let i = self.index(x, y);
        &self.texels[i..i + self.channels]
    }

    /// The channels of texel `(x, y)`, to write.
    pub fn texel_mut(&mut self, x: u32, y: u32) -> &mut [f32] {
        let i = self.index(x, y);
        &mut self.texels[i..i + self.channels]
    }

    /// One channel alone, row by row.
    pub fn channel(&self, channel: usize) -> impl Iterator<Item = f32> + Clone + '_ {
        self.texels
            .iter()
            .skip(channel)
            .step_by(self.channels)
            .copied()
    }

    /// Mean and standard deviation of one channel, summed in row order in 64 bits.
    pub fn mean_and_spread(&self, channel: usize) -> (f32, f32) {
        mean_and_spread(self.channel(channel))
    }
}

/// Mean and standard deviation of numbers, summed in their order in 64 bits.
pub(crate) fn mean_and_spread(values: impl Iterator<Item = f32> + Clone) -> (f32, f32) {
    let values = values.map(f64::from);
    let (sum, count) = values
        .clone()
        .fold((0.0, 0.0), |(sum, n), v| (sum + v, n + 1.0));
    let mean = sum / count;
    let variance = values.map(|v| (v - mean) * (v - mean)).sum::<f64>() / count;
    (mean as f32, libm::sqrt(variance) as f32)
}
