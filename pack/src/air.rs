//! The air: what baker and runtime both know of it. Wavelengths, optical depths, phase functions, the light of an hour.
//!
//! # Theory
//! Three layers dim and scatter sunlight: molecules (Rayleigh), ozone (absorbs only) and aerosol. Each has a vertical optical
//! depth at every wavelength and a relative air mass, which says how much longer the way through it is at an elevation:
//! `T = exp(-sum tau_i m_i)` (C. A. Gueymard, "Direct solar transmittance and irradiance predictions with broadband models", Solar
//! Energy 74, 2003, section 2). The aerosol is the continental clean one of M. Hess, P. Koepke, I. Schult, "Optical Properties of
//! Aerosols and Clouds: The Software Package OPAC", BAMS 79, 1998, table 4, water soluble and insoluble particles at 80 % humidity;
//! Mie's theory gives for it at 550 nm an asymmetry of 0.70, a single-scattering albedo of 0.97, and between 440 and 680 nm an
//! extinction that goes with the power -1.26 of the wavelength.
//!
//! # Changes
//! - The phase function of the aerosol is a sum: two lobes forwards ([`AUREOLE_LOBES`], the aureole) and a Rayleigh share
//!   ([`AEROSOL_RAYLEIGH`]), fitted here to Mie's from 0.4 to 180 degrees: 18 % rms, 34 % at worst, the aureole within 20 %.
//! - Refraction is left out but for what the air masses have of it: elevations are those that are seen.
//!
//! # Practice
//! Plain functions of a few exponentials; nothing is kept.

mod colour;
mod daylight;
mod layers;
mod phase;
mod spectrum;

pub use colour::Colour;
pub use daylight::{daylight_lx, skylight_lx, unit_luminance_cd_m2};
pub use layers::{
    AEROSOL_SCALE_KM, CLEAR_AEROSOL_DEPTH, MOLECULE_SCALE_KM, OZONE_KM, SUN_ILLUMINANCE_LX,
    WHITE_ELEVATION_RAD, sun_transmittance,
};
pub use phase::{AEROSOL_ALBEDO, AEROSOL_RAYLEIGH, AUREOLE_LOBES, aureole_phase, rayleigh_phase};
pub use spectrum::{
    AEROSOL_EXPONENT, COUNT, SUN, Spectrum, WAVELENGTHS_NM, aerosol, ozone, rayleigh,
};
