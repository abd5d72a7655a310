//! Cover by oktas.

use anyhow::{Result, ensure};
use welkin_runtime::{Oktas, SkyParams};

/// What calibration keeps: docs/cover.md.
const MOST_OFF_OKTAS: f32 = 0.5;

/// The cover that shows so many oktas; an error if no cover does.
pub fn cover_for_oktas(calibration: &Oktas, params: &SkyParams, oktas: f32) -> Result<f32> {
    let cover = calibration.cover(params, oktas);
    let shown = calibration.shown(&SkyParams { cover, ..*params });
    ensure!(
        (shown - oktas).abs() <= MOST_OFF_OKTAS,
        "--oktas {oktas}: with the other options, --method {} shows {} {shown:.1} oktas; ask for that, or change its options",
        params.method.name(),
        if shown < oktas { "at most" } else { "at least" },
    );
    Ok(cover)
}
