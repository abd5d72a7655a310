#!/usr/bin/env python3
"""Sun, moon, planets and stars over random places and dates by astropy: runtime/tests/data/almanac.csv and almanac-stars.csv.

    python3 -m venv /tmp/astropy && /tmp/astropy/bin/pip install astropy==8.0.2
    /tmp/astropy/bin/python scripts/almanac.py runtime/tests/data

Positions are airless unless said otherwise, with astropy's built-in ephemeris (ERFA: epv00, moon98, plan94) and the earth's rotation by the table that comes with
astropy, which before 1962 and in the future is taken to follow UTC: half a second of time at most is 0.002 degrees. Azimuths go from north to
east. Of the moon there is also the lit share of its disc. Stars are where they were in J2000, by the catalogue of d3-celestial (Hipparcos); also with the air of
1010 hPa and 10 degrees Celsius.
"""

import sys
import warnings

import numpy as np
from astropy import units as u
from astropy.coordinates import AltAz, EarthLocation, SkyCoord, get_body, solar_system_ephemeris
from astropy.time import Time
from astropy.utils import iers

COUNT = 1000
BODIES = ["sun", "moon", "mercury", "venus", "mars", "jupiter", "saturn"]

# Hipparcos number, name, right ascension and declination of J2000 in degrees.
STARS = [
    (11767, "Polaris", 37.9545, 89.2641),
    (24436, "Rigel", 78.6345, -8.2016),
    (27989, "Betelgeuse", 88.7929, 7.4071),
    (30438, "Canopus", 95.988, -52.6957),
    (32349, "Sirius", 101.2872, -16.7161),
    (54061, "Dubhe", 165.932, 61.751),
    (60718, "Acrux", 186.6496, -63.0991),
    (69673, "Arcturus", 213.9153, 19.1824),
    (80763, "Antares", 247.3519, -26.432),
    (91262, "Vega", 279.2347, 38.7837),
]
MOMENTS = [
    ("1969-07-20T20:17:40", 28.6, -80.6),
    ("2000-01-01T00:00:00", -33.9, 151.2),
    ("2026-12-21T17:00:00", 59.9, 30.3),
]


def places(random):
    """Latitudes and longitudes, even over the sphere; the first are poles, date line and equator."""
    latitudes = np.degrees(np.arcsin(random.uniform(-1, 1, COUNT)))
    longitudes = random.uniform(-180, 180, COUNT)
    latitudes[:6] = [90, -90, 0, 0, 89.99, -45]
    longitudes[:6] = [0, 17, 180, -180, 0, 179.99]
    return np.round(latitudes, 3), np.round(longitudes, 3)


def at(time, latitude, longitude, pressure=0 * u.hPa):
    location = EarthLocation.from_geodetic(longitude * u.deg, latitude * u.deg, 0 * u.m)
    return location, AltAz(
        obstime=time, location=location, pressure=pressure, temperature=10 * u.deg_C, obswl=0.55 * u.um
    )


def main(folder):
    warnings.simplefilter("ignore")
    iers.conf.auto_download = False
    iers.conf.auto_max_age = None
    iers.conf.iers_degraded_accuracy = "ignore"
    solar_system_ephemeris.set("builtin")
    random = np.random.default_rng(17)
    latitudes, longitudes = places(random)
    seconds = np.round(random.uniform(0, 101 * 365.25 * 86400 - 86400, COUNT))
    times = Time("1950-01-01T00:00:00", scale="utc") + 0 * u.s
    times = Time(times.unix + seconds, format="unix")
    location, frame = at(times, latitudes, longitudes)
    columns = {}
    seen = {}
    for body in BODIES:
        coordinates = get_body(body, times, location)
        seen[body] = coordinates
        horizontal = coordinates.transform_to(frame)
        columns[body] = (horizontal.az.deg, horizontal.alt.deg)
    elongation = seen["moon"].separation(seen["sun"])
    sun_km, moon_km = seen["sun"].distance.to_value(u.km), seen["moon"].distance.to_value(u.km)
    phase = np.arctan2(sun_km * np.sin(elongation), moon_km - sun_km * np.cos(elongation))
    lit = (1 + np.cos(phase.to_value(u.rad))) / 2
    with open(f"{folder}/almanac.csv", "w", encoding="ascii") as out:
        out.write("# Made by scripts/almanac.py: degrees, airless.\n")
        names = [f"{body}_{angle}" for body in BODIES for angle in ("azimuth", "elevation")]
        out.write(",".join(["date", "latitude", "longitude", *names, "moon_lit"]) + "\n")
        for i, time in enumerate(times.isot):
            numbers = [columns[body][angle][i] for body in BODIES for angle in (0, 1)]
            values = [f"{number:.4f}" for number in numbers] + [f"{lit[i]:.4f}"]
            out.write(",".join([time[:19] + "Z", f"{latitudes[i]:.3f}", f"{longitudes[i]:.3f}", *values]) + "\n")
    with open(f"{folder}/almanac-stars.csv", "w", encoding="ascii") as out:
        out.write("# Made by scripts/almanac.py: degrees, airless and with the air of 1010 hPa and 10 degrees Celsius.\n")
        out.write("date,latitude,longitude,star,right_ascension,declination,azimuth,elevation,seen_elevation\n")
        for moment, latitude, longitude in MOMENTS:
            for _, name, ascension, declination in STARS:
                star = SkyCoord(ascension * u.deg, declination * u.deg, frame="icrs")
                _, airless = at(Time(moment), latitude, longitude)
                _, air = at(Time(moment), latitude, longitude, 1010 * u.hPa)
                place, lifted = star.transform_to(airless), star.transform_to(air)
                numbers = [ascension, declination, place.az.deg, place.alt.deg, lifted.alt.deg]
                values = ",".join(f"{number:.4f}" for number in numbers[:2]) + f",{numbers[2]:.4f},{numbers[3]:.4f},{numbers[4]:.4f}"
                out.write(f"{moment}Z,{latitude},{longitude},{name},{values}\n")


if __name__ == "__main__":
    main(sys.argv[1])
