//! Sizes that no pack exceeds: a reader refuses more before it allocates for it.

/// Largest width and height of a texture, in texels: what wgpu's default limits allow.
pub const MAX_SIDE: u32 = 8192;

/// Largest number of layers of an array, as wgpu's default limits allow.
pub const MAX_LAYERS: u32 = 256;

/// Largest texture, all levels decoded, in bytes: 256 MiB.
pub const MAX_TEXTURE_BYTES: u64 = 256 << 20;

/// Largest file of a texture, in bytes: 256 MiB.
pub const MAX_FILE_BYTES: u64 = 256 << 20;

/// Largest manifest, in bytes: 1 MiB.
pub const MAX_MANIFEST_BYTES: u64 = 1 << 20;

/// Largest file of a field of clouds, in bytes: 16 MiB.
pub const MAX_FIELD_BYTES: u64 = 16 << 20;

/// Most sections along a side of a field.
pub const MAX_SECTIONS: u32 = 8;

/// Most clouds in a field.
pub const MAX_CLOUDS: usize = 4096;

/// Most shading groups of a cloud.
pub const MAX_GROUPS: usize = 256;

/// Most boxes in a field.
pub const MAX_BOXES: usize = 16_384;

/// Most sprites in a field.
pub const MAX_SPRITES: usize = 65_536;

/// Most entries of a table of light.
pub const MAX_HOURS: usize = 96;
