//! Patterns of the plan, photographed and given back.

use super::*;

/// Waves of the plan, 0..1.
fn pattern([right, ahead]: [f64; 2]) -> f64 {
    0.5 + 0.2 * libm::sin(3.0 * right + ahead)
        + 0.2 * libm::cos(2.0 * ahead - right)
        + 0.1 * libm::sin(7.0 * (right + 0.3 * ahead))
}

/// The direction a pinhole looks in, by turning the picture's own axes; the layer is met where it is one unit high.
fn photographed(width: u32, height: u32, fov: f64, angle: f64) -> Image {
    filter::plane(width, height, |x, y| {
        let half = libm::tan(0.5 * fov);
        let [w, h] = [width, height].map(f64::from);
        let ray = [
            half * (2.0 * (f64::from(x) + 0.5) / w - 1.0),
            -half * (2.0 * (f64::from(y) + 0.5) - h) / w,
            1.0,
        ];
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let turned = [
            ray[0],
            ray[1] * cos + ray[2] * sin,
            ray[2] * cos - ray[1] * sin,
        ];
        if turned[1] <= 0.0 {
            return 0.1;
        }
        pattern([turned[0] / turned[1], turned[2] / turned[1]]) as f32
    })
}

fn panorama(width: u32, height: u32, horizon: f64) -> Image {
    filter::plane(width, height, |x, y| {
        let scale = f64::from(width) / TAU;
        let azimuth = (f64::from(x) + 0.5) / scale - 0.5 * TAU;
        let elevation = (horizon - f64::from(y) - 0.5) / scale;
        if elevation <= 0.0 {
            return 0.1;
        }
        let flat = libm::cos(elevation) / libm::sin(elevation);
        pattern([flat * libm::sin(azimuth), flat * libm::cos(azimuth)]) as f32
    })
}

fn worst(plan: &Image, square: &Square) -> f64 {
    let size = f64::from(plan.width);
    let off = |i: usize| {
        let [x, y] = [i as u32 % plan.width, i as u32 / plan.width];
        let uv = [x, y].map(|i| (f64::from(i) + 0.5) / size);
        (f64::from(plan.texels[i]) - pattern(square.at(uv))).abs()
    };
    (0..plan.texels.len()).map(off).fold(0.0, f64::max)
}

#[test]
fn a_place_that_is_seen_shows_itself() {
    let cameras = [
        Camera::pinhole([1200, 800], 1.2, 0.9),
        Camera::pinhole([800, 1200], 0.9, 1.7),
        Camera::equirect([2048, 1024], 0.5),
    ];
    for camera in cameras {
        for place in [[0.3, 1.2], [-0.8, 2.0], [0.1, 0.4]] {
            let again = camera
                .seen(place)
                .and_then(|seen| camera.shown(seen))
                .unwrap();
            for (a, b) in place.iter().zip(again) {
                assert!((a - b).abs() < 1e-9, "{camera:?}: {place:?} {again:?}");
            }
        }
    }
}

#[test]
fn a_pinhole_gives_the_plan_back() {
    // From the angle, the share of the height at which the horizon is.
    for (width, height, fov, angle) in [
        (1200, 800, 1.1, 0.4),
        (900, 1200, 0.9, 0.9),
        (1000, 700, 1.4, 1.5),
    ] {
        let picture = photographed(width, height, fov, angle);
        let focal = 0.5 * f64::from(width) / libm::tan(0.5 * fov);
        let horizon = 0.5 + focal * libm::tan(angle) / f64::from(height);
        let long = 2.0 * libm::atan(0.5 * f64::from(width.max(height)) / focal);
        let camera = Camera::pinhole([width, height], long, horizon);
        let square = largest_square(&camera, [0, 0, width, height]).unwrap();
        assert!(square.side > 0.3, "{square:?}");
        let plan = unprojected(&picture, 0, &camera, &square, 160);
        let worst = worst(&plan, &square);
        // A texel of the plan takes the mean of up to a hundredth of a unit, of waves of one unit.
        assert!(worst < 0.02, "{width}x{height}: {worst}");
    }
}

#[test]
fn a_panorama_gives_the_plan_back_around_the_zenith_and_beside_it() {
    for (height, horizon) in [(512, 0.5), (256, 1.0)] {
        let picture = panorama(1024, height, horizon * f64::from(height));
        let camera = Camera::equirect([1024, height], horizon);
        let square = largest_square(&camera, [0, 0, 1024, height]).unwrap();
        // The corners are at the lowest elevation.
        let farthest = 1.0 / libm::tan(LOWEST_RAD);
        assert!(
            (square.side - farthest * libm::sqrt(2.0)).abs() < 0.4,
            "{square:?}"
        );
        let worst_all = worst(&unprojected(&picture, 0, &camera, &square, 256), &square);
        assert!(worst_all < 0.04, "{worst_all}");
        let part = [600, 20, 150, 160];
        let square = largest_square(&camera, part).unwrap();
        let bounds = square.bounds(&camera, part);
        assert!(
            bounds[0] >= 600 && bounds[0] + bounds[2] <= 750,
            "{bounds:?}"
        );
        assert!(worst(&unprojected(&picture, 0, &camera, &square, 128), &square) < 0.02);
    }
}

/// Stripes of two texels of the picture, far finer than a texel of the plan, become their mean.
#[test]
fn what_is_finer_than_the_plan_is_averaged() {
    let picture = filter::plane(1200, 800, |x, _| (x / 2 % 2) as f32);
    let camera = Camera::pinhole([1200, 800], 1.1, 1.4);
    let square = largest_square(&camera, [0, 0, 1200, 800]).unwrap();
    let plan = unprojected(&picture, 0, &camera, &square, 32);
    assert!(
        plan.mean_and_spread(0).1 < 0.06,
        "{}",
        plan.mean_and_spread(0).1
    );
}

#[test]
fn what_shows_no_sky_has_no_square() {
    let down = Camera::pinhole([600, 400], 1.0, -0.2);
    assert_eq!(largest_square(&down, [0, 0, 600, 400]), None);
    let level = Camera::pinhole([600, 400], 0.2, 0.5);
    assert_eq!(largest_square(&level, [0, 0, 600, 400]), None);
}
