//! What goes wrong behind the page's back: a lost device, and errors that a driver tells late.

use std::future::poll_fn;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Poll, Waker};

/// Shared with the device's callbacks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trouble(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    lost: Option<String>,
    waker: Option<Waker>,
    error: Option<String>,
}

impl Trouble {
    /// Listens to a device.
    pub fn watch(device: &wgpu::Device) -> Trouble {
        let trouble = Trouble::default();
        let of_errors = trouble.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            of_errors.with(|state| state.error = Some(error.to_string()));
        }));
        let of_loss = trouble.clone();
        device.set_device_lost_callback(move |reason, message| {
            // Destroyed is what we did ourselves.
            if reason != wgpu::DeviceLostReason::Destroyed {
                of_loss.lose(&message);
            }
        });
        trouble
    }

    /// The device is gone.
    pub fn lose(&self, message: &str) {
        let waker = self.with(|state| {
            state.lost = Some(format!("the graphics device was lost: {message}"));
            state.waker.take()
        });
        if let Some(waker) = waker {
            waker.wake();
        }
    }

    /// Waits until the device is lost and tells why.
    pub async fn lost(self) -> String {
        poll_fn(|context| {
            self.with(|state| match &state.lost {
                Some(message) => Poll::Ready(message.clone()),
                None => {
                    state.waker = Some(context.waker().clone());
                    Poll::Pending
                }
            })
        })
        .await
    }

    /// The error that was told since this was last asked, or why the device is gone.
    pub fn take(&self) -> Option<String> {
        self.with(|state| state.error.take().or_else(|| state.lost.clone()))
    }

    fn with<T>(&self, work: impl FnOnce(&mut State) -> T) -> T {
        work(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}
