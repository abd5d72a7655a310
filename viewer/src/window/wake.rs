//! What other threads and the device tell the event loop.

use std::path::PathBuf;

use welkin_pack::Pack;

/// A message to the event loop.
#[derive(Debug)]
pub enum Wake {
    /// A bake goes on: what begins now, and which share is behind it.
    Baking(&'static str, f32),
    /// A bake has ended: a sound pack, or why there is none.
    Baked(Box<Result<Baked, String>>),
    /// The watched recipe or a file that it names was saved.
    RecipeSaved,
    /// The device of this number is gone.
    DeviceLost(u64, String),
    /// The device refused something.
    DeviceError(String),
}

/// What was made.
#[derive(Debug)]
pub struct Baked {
    pub pack: Pack,
    /// The folder that it was written to.
    pub saved_to: Option<PathBuf>,
    /// What the bake tells, and what `welkin check` warns of.
    pub warnings: Vec<String>,
}
