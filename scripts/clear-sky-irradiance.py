#!/usr/bin/env python3
"""Direct and diffuse irradiance under clear skies by the models of pvlib: baker/tests/data/clear-sky-irradiance.csv.

    python3 -m venv /tmp/pvlib && /tmp/pvlib/bin/pip install pvlib==0.16.1
    /tmp/pvlib/bin/python scripts/clear-sky-irradiance.py > baker/tests/data/clear-sky-irradiance.csv

Models, all at sea level, with the sun at its mean distance:

- spectrl2: R. Bird, C. Riordan, "Simple solar spectral model for direct and diffuse irradiance on horizontal and tilted planes at the
  earth's surface for cloudless atmospheres", SERI/TR-215-2436, 1984. The only one by wavelength: its rows also give the light that
  an eye sees, which a renderer is compared with. Of the broadband light more than half is infrared, where the sky is dark.
- bird: R. Bird, R. Hulstrom, "A simplified clear sky model for direct and diffuse insolation on horizontal surfaces", SERI/TR-642-761, 1981.
- simplified_solis: P. Ineichen, "A broadband simplified version of the Solis clear sky model", Solar Energy 82, 2008.
- ineichen: P. Ineichen, R. Perez, "A new airmass independent formulation for the Linke turbidity coefficient", Solar Energy 73, 2002;
  turbidity by F. Kasten, "The Linke turbidity factor based on improved values of the integral Rayleigh optical thickness", Solar Energy 56, 1996.
"""

import sys

import numpy as np
import pvlib
from pvlib import atmosphere, clearsky, spectrum

ELEVATIONS_DEG = [60, 30, 20, 10, 5, 3]
AOD500 = [0.1, 0.2, 0.4]
ALBEDOS = [0.1, 0.3]
ANGSTROM = 1.14  # of rural aerosol (Bird and Riordan 1984)
SINGLE_SCATTERING_400 = 0.945  # the same
ASYMMETRY = 0.65  # the same
FORWARD_SHARE = 0.84  # of the light that aerosol scatters (Bird and Hulstrom 1981); pvlib calls it asymmetry
OZONE_ATM_CM = 0.3
WATER_CM = 1.5
PRESSURE_PA = 101325.0
EXTRA_W_M2 = 1361.0  # G. Kopp, J. Lean, "A new, lower value of total solar irradiance", 2011
LUMENS_PER_WATT = 683.0
BANDS_NM = [440, 550, 680]
BAND_HALF_WIDTH_NM = 20
DAY = 94  # 4 April: the sun at its mean distance within 0.1 %; what is left is divided out

# V(lambda), CIE 018:2019, 380 to 780 nm by 10.
V = [
    0.000039, 0.000120, 0.000396, 0.001210, 0.004000, 0.011600, 0.023000, 0.038000, 0.060000, 0.090980, 0.139020,
    0.208020, 0.323000, 0.503000, 0.710000, 0.862000, 0.954000, 0.994950, 0.995000, 0.952000, 0.870000, 0.757000,
    0.631000, 0.503000, 0.381000, 0.265000, 0.175000, 0.107000, 0.061000, 0.032000, 0.017000, 0.008210, 0.004102,
    0.002091, 0.001047, 0.000520, 0.000249, 0.000120, 0.000060, 0.000030, 0.000015,
]  # fmt: skip
VISIBLE_NM = np.arange(380, 781)
EYE = np.interp(VISIBLE_NM, np.arange(380, 781, 10), V)

COLUMNS = ["model", "aod500", "albedo", "elevation_deg", "dni_w_m2", "dhi_w_m2", "ratio"]
COLUMNS += ["dni_lx", "dhi_lx", "ratio_visible"] + [f"ratio_{band}" for band in BANDS_NM]


def aod(aod500, wavelength_nm):
    return atmosphere.angstrom_aod_at_lambda(aod500, 500, ANGSTROM, wavelength_nm)


def bird(elevation_deg, aod500, albedo):
    zenith = 90.0 - elevation_deg
    return clearsky.bird(
        zenith,
        atmosphere.get_relative_airmass(zenith, "kasten1966"),
        aod(aod500, 380),
        aod500,
        WATER_CM,
        OZONE_ATM_CM,
        PRESSURE_PA,
        EXTRA_W_M2,
        FORWARD_SHARE,
        albedo,
    )


def simplified_solis(elevation_deg, aod500):
    return clearsky.simplified_solis(elevation_deg, aod(aod500, 700), WATER_CM, PRESSURE_PA, EXTRA_W_M2)


def ineichen(elevation_deg, aod500):
    # Linke's turbidity is told for an air mass of 2; the model takes it from there.
    turbidity = atmosphere.kasten96_lt(2.0, WATER_CM, atmosphere.bird_hulstrom80_aod_bb(aod(aod500, 380), aod500))
    zenith = 90.0 - elevation_deg
    airmass = atmosphere.get_relative_airmass(zenith, "kastenyoung1989")
    return clearsky.ineichen(zenith, airmass, turbidity, 0, EXTRA_W_M2)


def spectrl2(elevation_deg, aod500, albedo):
    """Wavelengths, direct normal and diffuse horizontal irradiance in W/m^2/nm."""
    zenith = 90.0 - elevation_deg
    found = spectrum.spectrl2(
        apparent_zenith=zenith,
        aoi=zenith,
        surface_tilt=0,
        ground_albedo=albedo,
        surface_pressure=PRESSURE_PA,
        relative_airmass=atmosphere.get_relative_airmass(zenith, "kastenyoung1989"),
        precipitable_water=WATER_CM,
        ozone=OZONE_ATM_CM,
        aerosol_turbidity_500nm=aod500,
        dayofyear=DAY,
        scattering_albedo_400nm=SINGLE_SCATTERING_400,
        alpha=ANGSTROM,
        aerosol_asymmetry_factor=ASYMMETRY,
    )
    distance = pvlib.irradiance.get_extra_radiation(DAY, 1.0)
    return found["wavelength"].ravel(), found["dni"].ravel() / distance, found["dhi"].ravel() / distance


def seen(wavelength_nm, irradiance):
    """Illuminance in lux."""
    return LUMENS_PER_WATT * np.trapezoid(EYE * np.interp(VISIBLE_NM, wavelength_nm, irradiance), VISIBLE_NM)


def in_band(wavelength_nm, irradiance, band_nm):
    within = np.arange(band_nm - BAND_HALF_WIDTH_NM, band_nm + BAND_HALF_WIDTH_NM + 1)
    return np.trapezoid(np.interp(within, wavelength_nm, irradiance), within)


def row(model, aod500, albedo, elevation_deg, dni, dhi, rest=()):
    high = np.sin(np.radians(elevation_deg))
    head = [model, f"{aod500}", albedo, f"{elevation_deg}", f"{dni:.1f}", f"{dhi:.1f}", f"{dni * high / dhi:.3f}"]
    return head + list(rest) + [""] * (len(COLUMNS) - len(head) - len(rest))


def rows():
    for aod500 in AOD500:
        for albedo in ALBEDOS:
            for elevation in ELEVATIONS_DEG:
                nm, dni, dhi = spectrl2(elevation, aod500, albedo)
                high = np.sin(np.radians(elevation))
                sun, sky = seen(nm, dni), seen(nm, dhi)
                rest = [f"{sun:.0f}", f"{sky:.0f}", f"{sun * high / sky:.3f}"]
                rest += [f"{in_band(nm, dni, band) * high / in_band(nm, dhi, band):.3f}" for band in BANDS_NM]
                total = np.trapezoid(dni, nm), np.trapezoid(dhi, nm)
                yield row("spectrl2", aod500, f"{albedo}", elevation, *total, rest)
        for albedo in ALBEDOS:
            for elevation in ELEVATIONS_DEG:
                found = bird(elevation, aod500, albedo)
                yield row("bird", aod500, f"{albedo}", elevation, found["dni"], found["dhi"])
        for name, model in [("simplified_solis", simplified_solis), ("ineichen", ineichen)]:
            for elevation in ELEVATIONS_DEG:
                found = model(elevation, aod500)
                yield row(name, aod500, "", elevation, found["dni"], found["dhi"])


HEADER = f"""\
# Direct normal (dni) and diffuse horizontal (dhi) irradiance under clear skies, by the models of pvlib {pvlib.__version__} (BSD-3-Clause).
# Made by scripts/clear-sky-irradiance.py, where the models are cited.
# Atmosphere: sea level, {PRESSURE_PA:.0f} Pa; ozone {OZONE_ATM_CM * 1000:.0f} DU; water {WATER_CM} cm; aerosol of optical depth aod500 at 500 nm,
# Angstrom exponent {ANGSTROM}, in spectrl2 of single-scattering albedo {SINGLE_SCATTERING_400} at 400 nm and asymmetry {ASYMMETRY}, in bird of
# forward share {FORWARD_SHARE}; Lambertian ground (albedo empty: the model has none).
# Sun: elevation_deg is the apparent one, mean distance, {EXTRA_W_M2:.0f} W/m^2 (spectrl2: its own spectrum). dni is light that nothing scattered.
# ratio: dni * sin(elevation) / dhi, 300 to 4000 nm. dni_lx, dhi_lx: the same light weighed by V(lambda), {LUMENS_PER_WATT:.0f} lm/W; ratio_visible: their
# ratio on the horizontal; ratio_{BANDS_NM[0]}, ...: that of the light within {BAND_HALF_WIDTH_NM} nm of a wavelength.
"""


def main():
    sys.stdout.write(HEADER)
    for line in [COLUMNS, *rows()]:
        sys.stdout.write(",".join(line) + "\n")


if __name__ == "__main__":
    main()
