//! Ctrl-C and SIGTERM: the work stops at its next step, and what it had begun is removed on the way out.

use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Result, anyhow, bail};

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

/// An error if someone asked to stop.
pub fn stop_if_requested() -> Result<()> {
    if requested() {
        bail!("interrupted");
    }
    Ok(())
}
