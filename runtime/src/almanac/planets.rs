//! The five planets that the eye sees.
//!
//! Places: E. M. Standish, J. G. Williams, "Keplerian Elements for Approximate Positions of the Major Planets", Jet Propulsion Laboratory, table 1, made for 1800 to 2050:
//! 600 seconds of arc for Saturn, 400 for Jupiter, 40 for the others. Magnitudes: J. Meeus, "Astronomical Algorithms", 1998, chapter 41, those of the
//! Astronomical Almanac since 1984; that of Saturn with its rings.

use glam::DVec3;
use libm::{acos, cos, log10, sin};

use super::date::Date;
use super::frames::{about_z, centuries, of_angles, of_ecliptic, precessed, sidereal, to_world};
use super::place::Place;

/// A planet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planet {
    /// Mercury.
    Mercury,
    /// Venus.
    Venus,
    /// Mars.
    Mars,
    /// Jupiter.
    Jupiter,
    /// Saturn.
    Saturn,
}

impl Planet {
    /// All five, from the sun outwards.
    pub const ALL: [Planet; 5] = [
        Planet::Mercury,
        Planet::Venus,
        Planet::Mars,
        Planet::Jupiter,
        Planet::Saturn,
    ];

    /// Its B-V colour. A. Mallama, B. Krobusek, H. Pavlov, "Comprehensive wide-band magnitudes and albedos for the planets", Icarus 282, 2017.
    pub fn colour_index(self) -> f32 {
        match self {
            Planet::Mercury => 0.97,
            Planet::Venus => 0.81,
            Planet::Mars => 1.43,
            Planet::Jupiter => 0.87,
            Planet::Saturn => 1.09,
        }
    }
}

/// A planet as a place sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Airless direction towards it.
    pub direction: DVec3,
    /// Its visual magnitude.
    pub magnitude: f64,
}

/// Semimajor axis (astronomical units), eccentricity, inclination, mean longitude, longitudes of perihelion and node (degrees, ecliptic of J2000), and
/// how much each grows in a century.
type Elements = [[f64; 6]; 2];

/// The earth with the moon.
const EARTH: Elements = [
    [
        1.000_002_61,
        0.016_711_23,
        -0.000_015_31,
        100.464_571_66,
        102.937_681_93,
        0.0,
    ],
    [
        0.000_005_62,
        -0.000_043_92,
        -0.012_946_68,
        35_999.372_449_81,
        0.323_273_64,
        0.0,
    ],
];

fn elements(planet: Planet) -> Elements {
    match planet {
        Planet::Mercury => [
            [
                0.387_099_27,
                0.205_635_93,
                7.004_979_02,
                252.250_323_50,
                77.457_796_28,
                48.330_765_93,
            ],
            [
                0.000_000_37,
                0.000_019_06,
                -0.005_947_49,
                149_472.674_111_75,
                0.160_476_89,
                -0.125_340_81,
            ],
        ],
        Planet::Venus => [
            [
                0.723_335_66,
                0.006_776_72,
                3.394_676_05,
                181.979_099_50,
                131.602_467_18,
                76.679_842_55,
            ],
            [
                0.000_003_90,
                -0.000_041_07,
                -0.000_788_90,
                58_517.815_387_29,
                0.002_683_29,
                -0.277_694_18,
            ],
        ],
        Planet::Mars => [
            [
                1.523_710_34,
                0.093_394_10,
                1.849_691_42,
                -4.553_432_05,
                -23.943_629_59,
                49.559_538_91,
            ],
            [
                0.000_018_47,
                0.000_078_82,
                -0.008_131_31,
                19_140.302_684_99,
                0.444_410_88,
                -0.292_573_43,
            ],
        ],
        Planet::Jupiter => [
            [
                5.202_887_00,
                0.048_386_24,
                1.304_396_95,
                34.396_440_51,
                14.728_479_83,
                100.473_909_09,
            ],
            [
                -0.000_116_07,
                -0.000_132_53,
                -0.001_837_14,
                3_034.746_127_75,
                0.212_526_68,
                0.204_691_06,
            ],
        ],
        Planet::Saturn => [
            [
                9.536_675_94,
                0.053_861_79,
                2.485_991_87,
                49.954_244_23,
                92.598_878_31,
                113.662_424_48,
            ],
            [
                -0.001_250_60,
                -0.000_509_91,
                0.001_936_09,
                1_222.493_622_01,
                -0.418_972_16,
                -0.288_677_94,
            ],
        ],
    }
}

/// Obliquity of the ecliptic of J2000, in degrees, that the elements are of.
const OBLIQUITY_DEG: f64 = 23.439_28;
/// Centuries that light takes for an astronomical unit: 499.004784 seconds.
const LIGHT_CENTURIES: f64 = 499.004_784 / 86_400.0 / 36_525.0;

/// From the sun, in astronomical units along the ecliptic of J2000.
fn heliocentric(t: f64, [start, rate]: Elements) -> DVec3 {
    let mut now = start;
    for (value, rate) in now.iter_mut().zip(rate) {
        *value += rate * t;
    }
    let [axis, eccentricity, inclination, longitude, perihelion, node] = now;
    let mean = (longitude - perihelion).rem_euclid(360.0).to_radians();
    // Kepler's equation by Newton's steps: the largest eccentricity is Mercury's.
    let mut anomaly = mean + eccentricity * sin(mean);
    for _ in 0..6 {
        let off = anomaly - eccentricity * sin(anomaly) - mean;
        anomaly -= off / (1.0 - eccentricity * cos(anomaly));
    }
    let along = axis * (cos(anomaly) - eccentricity);
    let across = axis * (1.0 - eccentricity * eccentricity).sqrt() * sin(anomaly);
    let (turn, node) = ((perihelion - node).to_radians(), node.to_radians());
    let in_orbit = about_z(DVec3::new(along, across, 0.0), turn);
    about_z(of_ecliptic(inclination.to_radians(), in_orbit), node)
}

/// A planet from a place.
pub fn seen(planet: Planet, date: Date, place: Place) -> Seen {
    let t = centuries(date);
    let elements = elements(planet);
    // Earth and planet as they were when its light left: that is aberration too.
    let mut left = t;
    for _ in 0..3 {
        let apart = heliocentric(left, elements) - heliocentric(left, EARTH);
        left = t - LIGHT_CENTURIES * apart.length();
    }
    let (own, earth) = (heliocentric(left, elements), heliocentric(left, EARTH));
    let to_planet = own - earth;
    let equatorial = of_ecliptic(OBLIQUITY_DEG.to_radians(), to_planet.normalize());
    let of_date = precessed(t, equatorial);
    Seen {
        direction: to_world(sidereal(date, place), place, of_date),
        magnitude: magnitude(planet, t, own, earth),
    }
}

fn magnitude(planet: Planet, t: f64, own: DVec3, earth: DVec3) -> f64 {
    let to_planet = own - earth;
    let cosine = own.normalize().dot(to_planet.normalize());
    let i = acos(cosine.clamp(-1.0, 1.0)).to_degrees();
    let distance = 5.0 * log10(own.length() * to_planet.length());
    distance
        + match planet {
            Planet::Mercury => -0.42 + i * (0.0380 + i * (-0.000_273 + i * 0.000_002)),
            Planet::Venus => -4.40 + i * (0.0009 + i * (0.000_239 - i * 0.000_000_65)),
            Planet::Mars => -1.52 + 0.016 * i,
            Planet::Jupiter => -9.40 + 0.005 * i,
            Planet::Saturn => {
                // The elevation of the earth over the plane of the rings (45.1), whose pole follows from their tilt and node.
                let tilt = (28.075_216 - 0.012_998 * t).to_radians();
                let node = (169.508_470 + 1.394_681 * t).to_radians();
                let pole = of_angles(
                    node - std::f64::consts::FRAC_PI_2,
                    std::f64::consts::FRAC_PI_2 - tilt,
                );
                let sine = pole.dot(to_planet.normalize()).abs();
                -8.88 + 0.044 * i - 2.60 * sine + 1.25 * sine * sine
            }
        }
}
