//! How molecules and aerosol scatter.

use std::f32::consts::PI;

/// Share of the light that aerosol takes and scatters again; the rest it absorbs.
pub const AEROSOL_ALBEDO: f32 = 0.97;

/// The lobes of the aureole: weight and asymmetry of L. G. Henyey, J. L. Greenstein, "Diffuse radiation in the Galaxy", ApJ 93, 1941, eq. 2.
pub const AUREOLE_LOBES: [[f32; 2]; 2] = [[0.0117, 0.982], [0.9483, 0.714]];
/// What the aerosol scatters as molecules do.
pub const AEROSOL_RAYLEIGH: f32 = 0.04;

/// Rayleigh's phase function, by the cosine of the angle of scattering, in 1/sr.
pub fn rayleigh_phase(cosine: f32) -> f32 {
    3.0 / (16.0 * PI) * (1.0 + cosine * cosine)
}

/// The lobes of the aerosol's phase function, in 1/sr. With [`AEROSOL_RAYLEIGH`] of [`rayleigh_phase`] they scatter all light once.
pub fn aureole_phase(cosine: f32) -> f32 {
    let lobe = |[weight, g]: [f32; 2]| {
        let base = 1.0 + g * g - 2.0 * g * cosine;
        weight * (1.0 - g * g) / (4.0 * PI * base * libm::sqrtf(base))
    };
    AUREOLE_LOBES.map(lobe).iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integral of a phase function over the sphere; steps are finest about the forward peak.
    fn whole(phase: impl Fn(f32) -> f32) -> f64 {
        let steps = 200_000;
        let angle = |i: i32| {
            let t = f64::from(i) / f64::from(steps);
            std::f64::consts::PI * t * t
        };
        (0..steps)
            .map(|i| {
                let middle = 0.5 * (angle(i) + angle(i + 1));
                let ring = std::f64::consts::TAU * (libm::cos(angle(i)) - libm::cos(angle(i + 1)));
                f64::from(phase(libm::cos(middle) as f32)) * ring
            })
            .sum()
    }

    #[test]
    fn phase_functions_scatter_all_light_once() {
        // What is left is rounding of 32-bit cosines, which the peak of 1 degree multiplies.
        assert!((whole(rayleigh_phase) - 1.0).abs() < 1e-4);
        let aerosol = |c| aureole_phase(c) + AEROSOL_RAYLEIGH * rayleigh_phase(c);
        assert!((whole(aerosol) - 1.0).abs() < 1e-3, "{}", whole(aerosol));
    }

    #[test]
    fn the_phase_function_is_near_mies() {
        // 4 pi times the phase function of the mixture at 550 nm by Mie's theory, computed with miepython 3.3 from the sizes and
        // indices of Hess and others 1998. The fit's own worst error is 34 %.
        for (degrees, mie) in [
            (1.0_f32, 46.5),
            (2.0, 27.1),
            (5.0, 15.8),
            (10.0, 11.6),
            (30.0, 3.85),
            (60.0, 0.753),
            (90.0, 0.221),
            (120.0, 0.129),
            (150.0, 0.161),
            (180.0, 0.210),
        ] {
            let cosine = libm::cosf(degrees.to_radians());
            let found =
                4.0 * PI * (aureole_phase(cosine) + AEROSOL_RAYLEIGH * rayleigh_phase(cosine));
            assert!(
                (found / mie - 1.0).abs() < 0.5,
                "{degrees}: {found}, Mie {mie}"
            );
        }
    }
}
