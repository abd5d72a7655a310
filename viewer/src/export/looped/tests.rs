use half::f16;
use welkin_runtime::SkyParams;

use super::*;

const SIDE: u32 = 48;

/// Directions all round, each with its share of the sphere.
fn all_round() -> Vec<(Vec3, f32)> {
    let (width, height) = (256, 128);
    let rows = (0..height).flat_map(|y| [y; 256]);
    let weight = |y: u32| ((y as f32 + 0.5) / height as f32 * std::f32::consts::PI).sin();
    let all = of_equirect(width, 0.0).into_iter().zip(rows.map(weight));
    let sum: f32 = all.clone().map(|(_, weight)| weight).sum();
    all.map(|(direction, weight)| (direction, weight / sum))
        .collect()
}

fn change(progress: f32) -> Change {
    Change {
        earlier_s: 7.0,
        progress,
    }
}

#[test]
fn every_direction_has_changed_at_the_end_and_none_at_the_beginning() {
    for (direction, _) in all_round() {
        assert_eq!(change(0.0).share(direction), 0.0);
        assert_eq!(change(1.0).share(direction), 1.0);
    }
}

#[test]
fn the_sky_changes_over_bit_by_bit_and_most_of_it_is_that_of_one_moment() {
    let all = all_round();
    let mean = |of: &dyn Fn(f32) -> f32, progress: f32| -> f32 {
        let change = change(progress);
        all.iter()
            .map(|(d, weight)| weight * of(change.share(*d)))
            .sum()
    };
    for step in 0..=20 {
        let progress = step as f32 / 20.0;
        // Directions begin about evenly, and are half way after half of their fade.
        let expected = ((progress - 0.5 * FADE) / (1.0 - FADE)).clamp(0.0, 1.0);
        let changed = mean(&|share| share, progress);
        assert!((changed - expected).abs() < 0.1, "{progress}: {changed}");
        // What a mixture lacks of the variance of two moments: all over a picture that fades at once, it is half of it.
        let lost = mean(&|share| 2.0 * share * (1.0 - share), progress);
        assert!(lost < 0.15, "{progress}: {lost}");
    }
}

#[test]
fn edges_are_soft() {
    // A smooth step is 1.5 times as steep in its middle as on average: where a degree is less than half of it, it is 3 degrees wide at least.
    let degree = 1.0_f32.to_radians();
    for (direction, _) in all_round() {
        let further = (direction + degree * direction.any_orthonormal_vector()).normalize();
        for step in 1..10 {
            let change = change(step as f32 / 10.0);
            let apart = (change.share(direction) - change.share(further)).abs();
            assert!(apart < 0.5, "{direction}: {apart}");
        }
    }
}

#[test]
fn a_direction_is_the_same_in_every_picture() {
    let east = Camera::looking(
        0.5 * std::f32::consts::PI,
        0.0,
        0.5 * std::f32::consts::PI,
        [SIDE; 2],
    );
    let faces = of_cubemap(SIDE);
    for (pixel, texel) in of_camera(&east)
        .iter()
        .zip(&faces[..(SIDE * SIDE) as usize])
    {
        assert!(pixel.abs_diff_eq(*texel, 1e-5), "{pixel} {texel}");
    }
    let panorama = of_equirect(4, 0.0);
    let expected = Vec3::new(0.5, std::f32::consts::FRAC_1_SQRT_2, -0.5);
    assert!(panorama[2].abs_diff_eq(expected, 1e-5), "{}", panorama[2]);
}

fn view() -> View {
    View {
        params: SkyParams::default(),
        camera: Camera::looking(0.0, 0.5, 1.0, [32, 32]),
        seconds: 67.0,
    }
}

/// The moments that a frame of a loop draws.
fn moments(change: Option<Change>) -> Vec<f64> {
    let mut drawn = Vec::new();
    let view = view();
    let draw_one = |view: &View| -> Result<f64, ()> {
        drawn.push(view.seconds);
        Ok(view.seconds)
    };
    draw(
        &view,
        change.as_ref(),
        || of_camera(&view.camera),
        draw_one,
        |_, _, _| {},
    )
    .unwrap();
    drawn
}

#[test]
fn the_frame_after_the_last_one_is_the_sky_at_the_beginning_alone() {
    assert_eq!(moments(None), [67.0]);
    assert_eq!(moments(Some(change(0.5))), [67.0, 7.0]);
    assert_eq!(moments(Some(change(1.0))), [7.0]);
}

#[test]
fn pictures_are_mixed_as_light_and_what_is_of_one_moment_stays() {
    let picture = |bytes: [u8; 4]| Frame {
        width: 4,
        height: 1,
        pixels: Pixels::Srgb8(bytes.map(|b| [b, b, b, 255]).to_vec()),
    };
    let mut frame = picture([0, 10, 200, 90]);
    mix_frames(
        &mut frame,
        &picture([255, 20, 100, 90]),
        &[0.5, 0.0, 1.0, 0.3],
    );
    // Half of the light of white: 1.055 * 0.5^(1/2.4) - 0.055 is 0.735.
    assert_eq!(frame, picture([188, 10, 100, 90]));
    let radiance = |values: [f32; 2]| Frame {
        width: 2,
        height: 1,
        pixels: Pixels::Linear(values.map(|v| [f16::from_f32(v); 4]).to_vec()),
    };
    let mut frame = radiance([1.0, 4.0]);
    mix_frames(&mut frame, &radiance([3.0, 1000.0]), &[0.25, 0.5]);
    assert_eq!(frame, radiance([1.5, 502.0]));
}

#[test]
fn faces_are_mixed_each_by_its_own_directions() {
    let map = |value: f32| Cubemap {
        side: 1,
        faces: (0..6)
            .map(|_| welkin_pack::Image {
                width: 1,
                height: 1,
                channels: 3,
                texels: vec![value; 3],
            })
            .collect(),
    };
    let mut mixed = map(1.0);
    mix_cubemaps(&mut mixed, &map(3.0), &[0.0, 0.25, 0.5, 0.75, 1.0, 0.5]);
    let found: Vec<f32> = mixed.faces.iter().map(|face| face.texels[2]).collect();
    assert_eq!(found, [1.0, 1.5, 2.0, 2.5, 3.0, 2.0]);
}
