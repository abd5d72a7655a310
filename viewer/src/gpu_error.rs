//! Why nothing could be drawn.

use welkin_runtime::SkyError;

use crate::wanted::Wanted;

const INSTALL: &str = "install a driver for the GPU, or Mesa's software Vulkan \
     (on Debian and Ubuntu: apt-get install mesa-vulkan-drivers libvulkan1)";

/// Why nothing could be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// There is no adapter at all.
    #[error("no graphics adapter was found; {INSTALL}")]
    NoAdapter,
    /// No adapter is the one that was asked for.
    #[error(
        "no graphics adapter has \"{wanted}\" in its name, found {found}; change or unset WGPU_ADAPTER_NAME"
    )]
    NoSuchName {
        /// Value of `WGPU_ADAPTER_NAME`.
        wanted: String,
        /// Names of the adapters that there are.
        found: String,
    },
    /// No adapter has the number or the bus id that was asked for.
    #[error("no graphics adapter is {wanted}; `welkin-view gpus` lists the {count} that there are")]
    NoSuchAdapter {
        /// What was asked for.
        wanted: Wanted,
        /// How many there are.
        count: usize,
    },
    /// The adapter would not give a device.
    #[error("{adapter}: gives no device with the limits of WebGL2: {reason}; {INSTALL}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// Its reason.
        reason: String,
    },
    /// The frame is larger than this device can draw or give back.
    #[error(
        "the frame is {width}x{height} pixels, expected 1 to {max_side} a side and {max_pixels} in all \
         on {adapter}; choose another --size"
    )]
    FrameSize {
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Most pixels a side.
        max_side: u32,
        /// Most pixels in all.
        max_pixels: u64,
        /// Name of the adapter.
        adapter: String,
    },
    /// The device stopped working while it drew.
    #[error(
        "{adapter}: failed while drawing: {reason}; update its driver, or try another one with WGPU_ADAPTER_NAME"
    )]
    Device {
        /// Name of the adapter.
        adapter: String,
        /// Its reason.
        reason: String,
    },
    /// The pack cannot be drawn on this device.
    #[error(transparent)]
    Sky(#[from] SkyError),
}
