//! Ctrl-C and SIGTERM: a signal leaves a note, and a program's work stops at its next step.

use std::sync::atomic::{AtomicBool, Ordering};

/// What shells report for a program that SIGINT ended: 128 + 2.
pub const EXIT_CODE: u8 = 130;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Why signals cannot be listened for.
#[derive(Debug, thiserror::Error)]
#[error("cannot listen for Ctrl-C: {0}; allow this process one more thread")]
pub struct ListenError(#[from] ctrlc::Error);

/// From now on a signal only leaves a note.
///
/// # Errors
/// The system's reason.
pub fn listen() -> Result<(), ListenError> {
    Ok(ctrlc::set_handler(|| {
        REQUESTED.store(true, Ordering::SeqCst)
    })?)
}

/// Whether someone asked to stop.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}
