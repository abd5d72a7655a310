//! Ctrl-C and SIGTERM: the work stops at its next step, and what it had begun is removed on the way out.

use std::panic::resume_unwind;
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread::Builder;
use std::time::Duration;

use anyhow::{Context, Result, anyhow, bail};

pub use welkin_pack::interrupt::{EXIT_CODE, listen, requested};

/// As much as the main thread has on Linux.
const STACK_BYTES: usize = 8 << 20;

/// An error if someone asked to stop.
pub fn stop_if_requested() -> Result<()> {
    if requested() {
        bail!("interrupted");
    }
    Ok(())
}

/// Does what may wait for ever, such as reading a pipe that nobody writes to: in a thread of its own, which is left alone when someone
/// asks to stop. So it must not write files.
pub fn unless_requested<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Result<T> {
    const PAUSE: Duration = Duration::from_millis(20);
    let (sender, receiver) = sync_channel(1);
    let thread = Builder::new()
        .stack_size(STACK_BYTES)
        .spawn(move || drop(sender.send(work())))
        .context("cannot start a thread; allow this process one more")?;
    loop {
        match receiver.recv_timeout(PAUSE) {
            Ok(done) => return Ok(done),
            Err(RecvTimeoutError::Timeout) => stop_if_requested()?,
            Err(RecvTimeoutError::Disconnected) => {
                return match thread.join() {
                    Err(panic) => resume_unwind(panic),
                    Ok(()) => Err(anyhow!("a thread ended without a result")),
                };
            }
        }
    }
}
