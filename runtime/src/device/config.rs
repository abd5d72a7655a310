//! What the sky is drawn onto, and what the shader writes there.

use crate::error::SkyError;

/// What the sky is drawn onto.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyConfig {
    /// Format of the colour target. A float format gets raw radiance (linear BT.709, 1 is the white of a
    /// sunlit cloud at noon), the others a tonemapped and encoded picture. Alpha is always 1.
    pub target_format: wgpu::TextureFormat,
    /// Depth attachment of the pass, if it has one. It is tested, never written.
    pub depth: Option<DepthConfig>,
    /// Samples a pixel of the pass, 1 or 4.
    pub sample_count: u32,
}

/// The depth attachment of the pass in which the sky is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthConfig {
    /// Its format.
    pub format: wgpu::TextureFormat,
    /// Whether 0 is far and 1 near.
    pub reversed: bool,
}

/// What the last step writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// Linear radiance, for float targets.
    Radiance,
    /// Linear display light, for targets that the hardware encodes (`*Srgb`).
    Display,
    /// sRGB-encoded display light, for plain unorm targets.
    Encoded,
    /// Opacity of the clouds alone, three times, for targets that take numbers as they are.
    Opacity,
}

impl Output {
    /// Every kind of output.
    pub const ALL: [Output; 4] = [
        Output::Radiance,
        Output::Display,
        Output::Encoded,
        Output::Opacity,
    ];
}

/// Looks at the configuration and chooses what the shader writes.
///
/// # Errors
/// [`SkyError::TargetFormat`], [`SkyError::DepthFormat`], [`SkyError::SampleCount`].
pub(crate) fn output(config: &SkyConfig, features: wgpu::Features) -> Result<Output, SkyError> {
    let format = config.target_format;
    let output = written(format).ok_or(SkyError::TargetFormat { format })?;
    let usages = format.guaranteed_format_features(features).allowed_usages;
    if !usages.contains(wgpu::TextureUsages::RENDER_ATTACHMENT) {
        return Err(SkyError::TargetFormat { format });
    }
    let depth_format = config.depth.map(|d| d.format);
    if let Some(format) = depth_format.filter(|f| !f.has_depth_aspect()) {
        return Err(SkyError::DepthFormat { format });
    }
    for format in [Some(format), depth_format].into_iter().flatten() {
        let guaranteed = format.guaranteed_format_features(features).flags;
        if !guaranteed.sample_count_supported(config.sample_count) {
            return Err(SkyError::SampleCount {
                format,
                found: config.sample_count,
            });
        }
    }
    Ok(output)
}

/// What the shader writes where opacity is asked for.
///
/// # Errors
/// [`SkyError::TargetFormat`] for targets that the hardware encodes, too.
pub(crate) fn opacity(config: &SkyConfig, features: wgpu::Features) -> Result<Output, SkyError> {
    match output(config, features)? {
        Output::Display => Err(SkyError::TargetFormat {
            format: config.target_format,
        }),
        _ => Ok(Output::Opacity),
    }
}

/// What a target wants to be given, if it can show a sky at all.
pub(crate) fn written(format: wgpu::TextureFormat) -> Option<Output> {
    use wgpu::TextureFormat as F;
    match format {
        F::Rgba16Float | F::Rgba32Float | F::Rg11b10Ufloat => Some(Output::Radiance),
        F::Rgba8UnormSrgb | F::Bgra8UnormSrgb => Some(Output::Display),
        F::Rgba8Unorm | F::Bgra8Unorm | F::Rgb10a2Unorm | F::Rgba16Unorm => Some(Output::Encoded),
        _ => None,
    }
}

/// One step of the target's encoding, 0 for one of radiance.
pub fn step(format: wgpu::TextureFormat) -> f32 {
    match format {
        _ if written(format) == Some(Output::Radiance) => 0.0,
        wgpu::TextureFormat::Rgb10a2Unorm => 1.0 / 1023.0,
        wgpu::TextureFormat::Rgba16Unorm => 1.0 / 65535.0,
        _ => 1.0 / 255.0,
    }
}
