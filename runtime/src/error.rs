//! What can go wrong when a sky is made ready for a device.

use welkin_pack::{Pack, Role, Texture};

/// Why a [`crate::Sky`] could not be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SkyError {
    /// The pack lacks a texture that this method draws from.
    #[error("the pack has no texture with the role \"{}\"; bake it again with a recipe that makes it", .role.name())]
    MissingTexture {
        /// The missing role.
        role: Role,
    },
    /// The pack has no clouds in space.
    #[error(
        "the pack has no field of clouds for the method \"sprites\"; bake it again with a recipe that makes one"
    )]
    MissingField,
    /// A texture is larger than the device can hold.
    #[error(
        "the texture \"{}\" is {width}x{height} texels, this device takes at most {limit} a side; \
         bake the pack with a smaller size", .role.name()
    )]
    TextureTooLarge {
        /// Role of the texture.
        role: Role,
        /// Texels a row.
        width: u32,
        /// Rows.
        height: u32,
        /// The device's `max_texture_dimension_2d`.
        limit: u32,
    },
    /// The target's format holds neither a colour nor radiance.
    #[error(
        "the target format {format:?} cannot show a sky on this device; use Rgba8Unorm, Bgra8Unorm (with or without Srgb), \
         Rgb10a2Unorm or Rgba16Float"
    )]
    TargetFormat {
        /// The format asked for.
        format: wgpu::TextureFormat,
    },
    /// Over a sky that the application drew, only radiance can be laid, with blending.
    #[error(
        "the target format {format:?} cannot have clouds and stars laid over it on this device; use Rgba16Float or Rg11b10Ufloat"
    )]
    OverFormat {
        /// The format asked for.
        format: wgpu::TextureFormat,
    },
    /// The depth format has no depth.
    #[error("the depth format {format:?} has no depth; use one whose name starts with Depth")]
    DepthFormat {
        /// The format asked for.
        format: wgpu::TextureFormat,
    },
    /// The target cannot be drawn with that many samples a pixel.
    #[error(
        "{found} samples a pixel of {format:?} are asked for, WebGPU guarantees 1 or 4; set sample_count to one of them"
    )]
    SampleCount {
        /// The format of the target or of the depth.
        format: wgpu::TextureFormat,
        /// The count asked for.
        found: u32,
    },
}

/// The texture of a role.
pub(crate) fn texture(pack: &Pack, role: Role) -> Result<&Texture, SkyError> {
    pack.texture(role).ok_or(SkyError::MissingTexture { role })
}
