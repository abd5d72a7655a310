//! The moon: where it is, how far, how much of it is lit.
//!
//! J. Meeus, "Astronomical Algorithms", second edition, 1998, chapter 47, which shortens J. Chapront's ELP-2000/82: those terms of its tables that are more than
//! 0.002 degrees or 5 kilometres.

use glam::DVec3;
use libm::{cos, sin};
use welkin_pack::starlight::light_of_magnitude;

use super::date::Date;
use super::frames::{
    centuries, mean_obliquity, nutation, observer_km, of_angles, of_ecliptic, to_world,
};
use super::place::Place;
use super::sun;

/// The moon as a place sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moon {
    /// Airless direction towards it.
    pub direction: DVec3,
    /// Airless direction towards the sun from the moon: it lights that side of it.
    pub sunwards: DVec3,
    /// Its distance in kilometres.
    pub distance_km: f64,
    /// The angle between sun and viewer as the moon sees them, in radians: 0 when it is full.
    pub phase_rad: f64,
}

/// Kilometres of its mean radius. B. A. Archinal and others, "Report of the IAU Working Group on Cartographic Coordinates: 2015", 2018.
pub const RADIUS_KM: f64 = 1737.4;

/// Its mean distance in kilometres (chapter 47).
pub const MEAN_DISTANCE_KM: f64 = 385_000.56;

impl Moon {
    /// The share of its disc that is lit (48.1).
    pub fn lit_share(&self) -> f64 {
        0.5 * (1.0 + cos(self.phase_rad))
    }

    /// Half of its angular size, in radians.
    pub fn radius_rad(&self) -> f64 {
        libm::asin(RADIUS_KM / self.distance_km)
    }

    /// Its light over that of the full moon at its mean distance, without the last degrees' surge.
    ///
    /// K. Krisciunas, B. E. Schaefer, "A model of the brightness of moonlight", Publications of the Astronomical Society of the Pacific 103, 1991, (9).
    pub fn light(&self) -> f64 {
        let angle_deg = self.phase_rad.to_degrees();
        let magnitudes = 0.026 * angle_deg + 4e-9 * angle_deg.powi(4);
        light_of_magnitude(magnitudes) * (MEAN_DISTANCE_KM / self.distance_km).powi(2)
    }
}

/// The moon from a place.
pub fn seen(date: Date, place: Place) -> Moon {
    let sidereal = sun::apparent_sidereal(date, place);
    let here_km = observer_km(sidereal, place);
    let moon_km = geocentric_km(date) - here_km;
    let from_moon_km = sun::geocentric_km(date) - here_km - moon_km;
    let cosine = from_moon_km.normalize().dot(-moon_km.normalize());
    Moon {
        direction: to_world(sidereal, place, moon_km.normalize()),
        sunwards: to_world(sidereal, place, from_moon_km.normalize()),
        distance_km: moon_km.length(),
        phase_rad: libm::acos(cosine.clamp(-1.0, 1.0)),
    }
}

/// A term of longitude and distance: how often D, M, M' and F go into its angle, millionths of a degree, metres.
type LongTerm = ([f64; 4], f64, f64);

/// Table 47.A.
const LONGITUDE_AND_DISTANCE: [LongTerm; 35] = [
    ([0.0, 0.0, 1.0, 0.0], 6_288_774.0, -20_905_355.0),
    ([2.0, 0.0, -1.0, 0.0], 1_274_027.0, -3_699_111.0),
    ([2.0, 0.0, 0.0, 0.0], 658_314.0, -2_955_968.0),
    ([0.0, 0.0, 2.0, 0.0], 213_618.0, -569_925.0),
    ([0.0, 1.0, 0.0, 0.0], -185_116.0, 48_888.0),
    ([0.0, 0.0, 0.0, 2.0], -114_332.0, -3149.0),
    ([2.0, 0.0, -2.0, 0.0], 58_793.0, 246_158.0),
    ([2.0, -1.0, -1.0, 0.0], 57_066.0, -152_138.0),
    ([2.0, 0.0, 1.0, 0.0], 53_322.0, -170_733.0),
    ([2.0, -1.0, 0.0, 0.0], 45_758.0, -204_586.0),
    ([0.0, 1.0, -1.0, 0.0], -40_923.0, -129_620.0),
    ([1.0, 0.0, 0.0, 0.0], -34_720.0, 108_743.0),
    ([0.0, 1.0, 1.0, 0.0], -30_383.0, 104_755.0),
    ([2.0, 0.0, 0.0, -2.0], 15_327.0, 10_321.0),
    ([0.0, 0.0, 1.0, 2.0], -12_528.0, 0.0),
    ([0.0, 0.0, 1.0, -2.0], 10_980.0, 79_661.0),
    ([4.0, 0.0, -1.0, 0.0], 10_675.0, -34_782.0),
    ([0.0, 0.0, 3.0, 0.0], 10_034.0, -23_210.0),
    ([4.0, 0.0, -2.0, 0.0], 8548.0, -21_636.0),
    ([2.0, 1.0, -1.0, 0.0], -7888.0, 24_208.0),
    ([2.0, 1.0, 0.0, 0.0], -6766.0, 30_824.0),
    ([1.0, 0.0, -1.0, 0.0], -5163.0, -8379.0),
    ([1.0, 1.0, 0.0, 0.0], 4987.0, -16_675.0),
    ([2.0, -1.0, 1.0, 0.0], 4036.0, -12_831.0),
    ([2.0, 0.0, 2.0, 0.0], 3994.0, -10_445.0),
    ([4.0, 0.0, 0.0, 0.0], 3861.0, -11_650.0),
    ([2.0, 0.0, -3.0, 0.0], 3665.0, 14_403.0),
    ([0.0, 1.0, -2.0, 0.0], -2689.0, -7003.0),
    ([2.0, 0.0, -1.0, 2.0], -2602.0, 0.0),
    ([2.0, -1.0, -2.0, 0.0], 2390.0, 10_056.0),
    ([1.0, 0.0, 1.0, 0.0], -2348.0, 6322.0),
    ([2.0, -2.0, 0.0, 0.0], 2236.0, -9884.0),
    ([0.0, 1.0, 2.0, 0.0], -2120.0, 5751.0),
    ([0.0, 2.0, 0.0, 0.0], -2069.0, 0.0),
    ([2.0, -2.0, -1.0, 0.0], 2048.0, -4950.0),
];

/// Table 47.B.
const LATITUDE: [([f64; 4], f64); 18] = [
    ([0.0, 0.0, 0.0, 1.0], 5_128_122.0),
    ([0.0, 0.0, 1.0, 1.0], 280_602.0),
    ([0.0, 0.0, 1.0, -1.0], 277_693.0),
    ([2.0, 0.0, 0.0, -1.0], 173_237.0),
    ([2.0, 0.0, -1.0, 1.0], 55_413.0),
    ([2.0, 0.0, -1.0, -1.0], 46_271.0),
    ([2.0, 0.0, 0.0, 1.0], 32_573.0),
    ([0.0, 0.0, 2.0, 1.0], 17_198.0),
    ([2.0, 0.0, 1.0, -1.0], 9266.0),
    ([0.0, 0.0, 2.0, -1.0], 8822.0),
    ([2.0, -1.0, 0.0, -1.0], 8216.0),
    ([2.0, 0.0, -2.0, -1.0], 4324.0),
    ([2.0, 0.0, 1.0, 1.0], 4200.0),
    ([2.0, 1.0, 0.0, -1.0], -3359.0),
    ([2.0, -1.0, -1.0, 1.0], 2463.0),
    ([2.0, -1.0, 0.0, 1.0], 2211.0),
    ([2.0, -1.0, -1.0, -1.0], 2065.0),
    ([0.0, 1.0, -1.0, -1.0], -1870.0),
];

/// Where the moon is, in kilometres from the earth's centre, along the true equator of the date.
pub fn geocentric_km(date: Date) -> DVec3 {
    let t = centuries(date);
    // (47.1) to (47.6).
    let angle = |a: f64, b: f64, c: f64, d: f64| (a + t * (b + t * (c + t * d))).to_radians();
    let mean = angle(
        218.316_447_7,
        481_267.881_234_21,
        -0.001_578_6,
        1.0 / 538_841.0,
    );
    let elongation = angle(
        297.850_192_1,
        445_267.111_403_4,
        -0.001_881_9,
        1.0 / 545_868.0,
    );
    let sun = angle(357.529_109_2, 35_999.050_290_9, -0.000_153_6, 0.0);
    let moon = angle(
        134.963_396_4,
        477_198.867_505_5,
        0.008_741_4,
        1.0 / 69_699.0,
    );
    let node = angle(93.272_095_0, 483_202.017_523_3, -0.003_653_9, 0.0);
    let fading = 1.0 - t * (0.002_516 + 0.000_007_4 * t);
    let of = |times: &[f64; 4]| {
        let [d, m, own, f] = *times;
        let share = fading.powi(m.abs() as i32);
        (d * elongation + m * sun + own * moon + f * node, share)
    };
    let [venus, jupiter, third] = [
        angle(119.75, 131.849, 0.0, 0.0),
        angle(53.09, 479_264.290, 0.0, 0.0),
        angle(313.45, 481_266.484, 0.0, 0.0),
    ];
    let mut longitude = 3958.0 * sin(venus) + 1962.0 * sin(mean - node) + 318.0 * sin(jupiter);
    let mut distance_m = 0.0;
    for (times, sine, cosine) in &LONGITUDE_AND_DISTANCE {
        let (angle, share) = of(times);
        longitude += sine * share * sin(angle);
        distance_m += cosine * share * cos(angle);
    }
    let mut latitude = -2235.0 * sin(mean) + 382.0 * sin(third);
    for (times, sine) in &LATITUDE {
        let (angle, share) = of(times);
        latitude += sine * share * sin(angle);
    }
    let [in_longitude, in_obliquity] = nutation(t);
    let ecliptic = of_angles(
        mean + (1e-6 * longitude).to_radians() + in_longitude,
        (1e-6 * latitude).to_radians(),
    );
    let equatorial = of_ecliptic(mean_obliquity(t) + in_obliquity, ecliptic);
    equatorial * (MEAN_DISTANCE_KM + 1e-3 * distance_m)
}
