//! Layers of the lit method: what covers, what moves, what light does.

use glam::DVec3;
use welkin_pack::LayerKind;

use super::cut::{COVERED, SIDED};
use super::*;
use crate::params::LitParams;

const SUN: Vec3 = Vec3::new(0.6, 0.8, 0.0);

fn at(params: &SkyParams, seconds: f64, place_m: DVec3) -> LitUniforms {
    let view = CloudView {
        texels: 512,
        pixel_rad: 1e-3,
        seconds,
        place_m,
    };
    uniforms(params, &view, SUN, &CloudUniforms::default(), Vec2::ONE)
}

#[test]
fn rays_meet_the_ellipsoid() {
    for flattening in [0.02, 0.1, 0.5, 1.0] {
        for (azimuth, elevation) in [(0.0, 0.0), (1.0, 0.01), (2.0, 0.4), (5.0, 1.57)] {
            let direction = Vec3::from(welkin_pack::mapping::direction_from_angles(
                azimuth, elevation,
            ));
            let hit = intersect(flattening, direction);
            let p = hit.position;
            let across = flattening * flattening * (p.x * p.x + p.z * p.z);
            assert!((across + p.y * p.y - 1.0).abs() < 1e-5, "{flattening} {p}");
            assert!((0.0..=1.0 + 1e-6).contains(&hit.cos_incidence));
        }
        assert!((intersect(flattening, Vec3::Y).distance - 1.0).abs() < 1e-6);
        let rim = intersect(flattening, Vec3::X).distance;
        assert!((rim * flattening - 1.0).abs() < 1e-5);
    }
    assert!((intersect(1.0, Vec3::new(0.6, 0.8, 0.0)).cos_incidence - 1.0).abs() < 1e-6);
}

#[test]
fn layers_together_cover_the_cover() {
    for cover in [0.0, 0.125, 0.5, 0.9, 1.0] {
        let params = SkyParams {
            cover,
            ..SkyParams::default()
        };
        let open: f32 = params
            .lit
            .layers
            .iter()
            .map(|layer| 1.0 - layer_cover(&params, layer))
            .product();
        assert!((1.0 - open - cover).abs() < 1e-6, "{cover}");
    }
}

#[test]
fn the_cut_leaves_the_cover_opaque_enough() {
    for (cover, steepness, opacity) in [(0.25, 5.0, 1.0), (0.6, 7.0, 1.0), (0.5, 1.7, 0.7)] {
        // The thinnest place that the cover takes.
        let thickness = 1.0 - cover - cut(cover, steepness, opacity);
        let alpha = opacity * smoothstep(0.0, 1.0, steepness * thickness);
        assert!((alpha - COVERED).abs() < 1e-4, "{alpha}");
    }
    assert_eq!(cut(0.0, 9.0, 1.0), 1.0);
    assert!(
        cut(1.0, 9.0, 1.0) - shut(1.0) < -0.3,
        "an overcast has no holes"
    );
    assert_eq!(shut(0.875), 0.0, "seven oktas are seven");
}

#[test]
fn layers_without_a_share_are_left_out() {
    let mut params = SkyParams::default();
    assert_eq!(at(&params, 0.0, DVec3::ZERO).count, 3.0);
    params.lit = LitParams::with_layers(&[LitLayer::of(LayerKind::Cirrus, 1.0)]);
    let lit = at(&params, 0.0, DVec3::ZERO);
    assert_eq!((lit.count, lit.layers[0].kind), (1.0, 2.0));
    params.cover = 0.0;
    assert_eq!(at(&params, 0.0, DVec3::ZERO).count, 0.0);
}

/// From offsets in the texture back to metres.
fn moved_m(before: &LitUniforms, after: &LitUniforms, index: usize, height_m: f64) -> DVec2 {
    let (before, after) = (before.layers[index], after.layers[index]);
    let axes = DMat2::from_cols(before.east_axis.as_dvec2(), before.south_axis.as_dvec2());
    let apart = (after.offset - before.offset).as_dvec2();
    axes.inverse() * (apart - apart.round()) * height_m
}

#[test]
fn every_layer_moves_by_itself_and_a_walk_moves_them_alike() {
    let windy = SkyParams {
        speed: 1.0,
        ..SkyParams::default()
    };
    let start = at(&windy, 0.0, DVec3::ZERO);
    let later = at(&windy, 10.0, DVec3::ZERO);
    let walked = at(&windy, 0.0, DVec3::new(300.0, 0.0, -200.0));
    for (index, layer) in windy.lit.layers.iter().enumerate().take(3) {
        let height_m = f64::from(windy.lit.radius_m * windy.lit.flattening * layer.height);
        // What stands over the viewer was upwind before. Offsets are 32-bit floats of tiles of kilometres.
        let blown = moved_m(&start, &later, index, height_m);
        let [east, south] = layer.velocity_m_s.map(f64::from);
        let way = DVec2::new(east, south) * -10.0;
        assert!((blown - way).length() < 0.02, "{index}: {blown} {way}");
        let walk = moved_m(&start, &walked, index, height_m);
        assert!((walk - DVec2::new(300.0, -200.0)).length() < 0.02, "{walk}");
    }
    let still = SkyParams {
        speed: 0.0,
        ..windy
    };
    let (before, after) = (at(&still, 0.0, DVec3::ZERO), at(&still, 60.0, DVec3::ZERO));
    assert_eq!(before.layers[0].offset, after.layers[0].offset);
    assert_ne!(
        before.layers[0].second_offset,
        after.layers[0].second_offset
    );
}

#[test]
fn bases_and_their_sides_cover_the_cover() {
    for sided in [0.0, SIDED] {
        for share in [0.0, 0.2, 0.6, 1.0] {
            let base = base_share(sided, share);
            assert!((base + sided * base * (1.0 - base) - share).abs() < 1e-6);
        }
    }
}
