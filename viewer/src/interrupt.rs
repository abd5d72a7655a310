//! Ctrl-C and SIGTERM while a sequence is drawn: it stops between two frames, and leaves whole ones.

use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Result, anyhow};

/// What shells report for a program that SIGINT ended: 128 + 2.
pub const EXIT_CODE: u8 = 130;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// From now on a signal only leaves a note.
pub fn listen() -> Result<()> {
    ctrlc::set_handler(|| REQUESTED.store(true, Ordering::SeqCst))
        .map_err(|e| anyhow!("cannot listen for Ctrl-C: {e}; allow this process one more thread"))
}

/// Whether someone asked to stop.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}
