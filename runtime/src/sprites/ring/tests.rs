//! The ring from the first picture to the cross-fade: stale, rebuilt one picture a frame, swapped.

use glam::{Vec3, Vec4};

use super::*;
use crate::sprites::station::BYTES;

fn station(place_m: DVec3) -> Station {
    Station {
        place_m,
        radius_m: 10_000.0,
        distance_m: 30_000.0,
        heights_m: [900.0, 2500.0],
        sun: Vec3::Y,
        look: [0.5; 11],
    }
}

/// Goes on until it rests; gives the pictures that were drawn and the frames that it took.
fn finish(ring: &mut Ring, now: Station) -> (Vec<usize>, u32) {
    let (mut drawn, mut frames) = (Vec::new(), 0);
    loop {
        frames += 1;
        match ring.step(now) {
            Step::Part([picture, _]) => drawn.push(picture),
            Step::Swap => return (drawn, frames),
            Step::Keep | Step::All => assert!(frames < 100, "it never rests"),
        }
    }
}

#[test]
fn all_eight_are_made_anew_beyond_15_percent_sideways_2_percent_up_or_a_degree_of_sun() {
    let here = DVec3::new(100.0, 1000.0, 100.0);
    let moved = |x: f64, y: f64| station(here + DVec3::new(x, y, 0.0));
    let turned = |degrees: f32| Station {
        sun: Vec3::new(degrees.to_radians().sin(), degrees.to_radians().cos(), 0.0),
        ..station(here)
    };
    let used = station(here);
    for (now, stale) in [
        (moved(1499.0, 0.0), false),
        (moved(1501.0, 0.0), true),
        (moved(0.0, 199.0), false),
        (moved(0.0, -201.0), true),
        (turned(0.9), false),
        (turned(1.1), true),
    ] {
        assert_eq!(used.is_stale(&now), stale, "{now:?}");
        let mut ring = Ring::new(used);
        let first = ring.step(now);
        assert_eq!(
            first,
            if stale {
                Step::Part([0, 0])
            } else {
                Step::Keep
            }
        );
    }
}

#[test]
fn one_picture_a_frame_then_a_fade_whose_shares_are_one_together() {
    let mut ring = Ring::new(station(DVec3::ZERO));
    let now = station(DVec3::new(2000.0, 0.0, 0.0));
    let (mut drawn, mut last) = (Vec::new(), 0.0);
    loop {
        match ring.step(now) {
            Step::Part([picture, 0]) => {
                drawn.push(picture);
                assert_eq!(ring.shares(), [1.0, 0.0], "not before all are there");
            }
            Step::Swap => break,
            Step::Keep => {}
            other => panic!("{other:?}"),
        }
        let [old, new] = ring.shares();
        assert!((old + new - 1.0).abs() < 1e-6 && new >= last);
        last = new;
    }
    assert_eq!(drawn, [0, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(ring.step(now), Step::Keep);
    assert_eq!((ring.current(), ring.next()), (&now, None));
    assert_eq!(ring.shares(), [1.0, 0.0]);
}

#[test]
fn every_block_is_there_once_whatever_the_ring_does() {
    let mut ring = Ring::new(station(DVec3::ZERO));
    let now = station(DVec3::new(4000.0, 0.0, 3000.0));
    for _ in 0..30 {
        ring.step(now);
        let [old, new] = ring.shares();
        for east in -6..6 {
            for south in -6..6 {
                let block = BlockId { east, south };
                let in_ring =
                    |station: &Station, share| if station.holds(block) { share } else { 0.0 };
                let pictured = in_ring(ring.current(), old)
                    + ring.next().map_or(0.0, |next| in_ring(next, new));
                let sum = pictured + ring.share_of_sprites(block);
                assert!((sum - 1.0).abs() < 1e-6, "{block:?}: {sum}");
            }
        }
    }
}

#[test]
fn from_10000_feet_above_the_clouds_there_is_no_ring() {
    let at = |height: f64| station(DVec3::new(0.0, height, 0.0));
    assert!(at(0.0).is_on() && at(5500.0).is_on());
    assert!(!at(5549.0).is_on(), "2500 m and 10,000 feet");
    let off = Station {
        radius_m: 0.0,
        ..at(0.0)
    };
    assert!(!off.is_on() && !off.holds(BlockId { east: 9, south: 9 }));
    // Climbing out, the ring fades without a new one being drawn.
    let mut ring = Ring::new(at(5500.0));
    let (drawn, frames) = finish(&mut ring, at(5600.0));
    assert_eq!((drawn.len(), frames), (0, FADE_FRAMES + 2));
    assert!(!ring.current().is_on());
}

#[test]
fn a_jump_makes_a_ring_at_once() {
    let mut ring = Ring::new(station(DVec3::ZERO));
    let far = station(DVec3::new(50_000.0, 0.0, 0.0));
    assert_eq!(ring.step(far), Step::All);
    assert_eq!(ring.step(far), Step::Keep);
    assert_eq!(ring.current(), &far);
}

/// The eight pictures hold every place that a cloud beyond the radius can have.
#[test]
fn every_cloud_of_the_ring_is_in_a_picture() {
    for height in [0.0, 1200.0, 5000.0] {
        let station = station(DVec3::new(1234.0, height, -777.0));
        for step in 0..2000 {
            let azimuth = f64::from(step) * 0.618_034 * std::f64::consts::TAU;
            let distance = 10_000.0 - 2829.0 + 32.0 + f64::from(step * 7 % 20_000);
            let up = 900.0 + f64::from(step * 13 % 1601);
            let place = DVec3::new(azimuth.sin(), 0.0, -azimuth.cos()) * distance
                + DVec3::Y * (up - height);
            let picture = (azimuth / std::f64::consts::TAU * 8.0).round() as usize % PICTURES;
            let view = station.view(picture, 128.0, 0.0);
            let along = |row: Vec4| row.truncate().dot(place.as_vec3());
            let w = along(view.clip_w);
            let (x, y) = (along(view.clip_x) / w, along(view.clip_y) / w);
            // Where its own side ends, two texels of 256 are left.
            assert!(x.abs() <= 254.0 / 256.0 + 1e-4, "{azimuth}: {x}");
            assert!(y.abs() <= 1.0 + 1e-4, "{height} {place}: {y}");
        }
    }
}

#[test]
fn a_picture_of_many_blocks_takes_several_frames() {
    let far = |x: f64| Station {
        distance_m: 60_000.0,
        ..station(DVec3::new(x, 0.0, 0.0))
    };
    assert_eq!((station(DVec3::ZERO).parts(), far(0.0).parts()), (1, 2));
    let mut ring = Ring::new(far(0.0));
    let (drawn, frames) = finish(&mut ring, far(2000.0));
    let twice: Vec<usize> = (0..PICTURES).flat_map(|picture| [picture; 2]).collect();
    assert_eq!(drawn, twice);
    assert_eq!(frames, 2 * PICTURES as u32 + FADE_FRAMES + 1);
}

#[test]
fn it_has_the_articles_size() {
    assert_eq!(BYTES, 8 * 256 * 256 * 4);
    assert_eq!(BYTES, 2 << 20);
}
