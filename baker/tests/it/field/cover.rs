//! Ranks promise cover, seeds and streams keep their promises.

use welkin_pack::Field;
use welkin_pack::field::{Cloud, Sprite};

use super::{field, recipe_field};

/// Whether a sprite is over a place, its copies too: over an ellipse with half-axes of 0.4 of its sides, or the disc of the same
/// area where it faces the eye.
fn is_over(sprite: &Sprite, is_flat: bool, [x, z]: [f32; 2], side_m: f32) -> bool {
    let apart = |d: f32| d - side_m * (d / side_m).round();
    let (dx, dz) = (apart(x - sprite.centre_m[0]), apart(z - sprite.centre_m[2]));
    let [a, b] = sprite.size_m.map(|side| 0.4 * side);
    if !is_flat {
        return dx * dx + dz * dz <= a * b;
    }
    let (sin, cos) = (
        libm::sinf(sprite.rotation_rad),
        libm::cosf(sprite.rotation_rad),
    );
    let (u, v) = ((dx * cos - dz * sin) / a, (dx * sin + dz * cos) / b);
    u * u + v * v <= 1.0
}

/// Share of a lattice of places that is below clouds of these ranks.
fn covered(field: &Field, cover: f32) -> f32 {
    let side_m = field.side_m();
    let there: Vec<&Cloud> = field.clouds.iter().filter(|c| c.rank <= cover).collect();
    // Not a divisor of the cells that ranks are counted in.
    let steps = 97;
    let place =
        |i: usize| [i % steps, i / steps].map(|c| (c as f32 + 0.37) / steps as f32 * side_m);
    let places = (0..steps * steps).map(place);
    let found = places.filter(|place| {
        let over = |cloud: &&Cloud| {
            let is_flat = cloud.kind.is_flat();
            cloud
                .sprites
                .iter()
                .any(|s| is_over(s, is_flat, *place, side_m))
        };
        there.iter().any(over)
    });
    found.count() as f32 / (steps * steps) as f32
}

#[test]
fn a_cover_of_c_covers_c_of_the_ground() {
    for (name, covers) in [
        ("", &[0.0, 0.1, 0.3, 0.35, 0.5, 0.7, 0.9, 1.0][..]),
        ("cumulus.toml", &[0.2, 0.4]),
        ("cirrus.toml", &[0.2, 0.6]),
        ("altocumulus.toml", &[0.4]),
    ] {
        let field = if name.is_empty() {
            field("")
        } else {
            recipe_field(name)
        };
        let ranks: Vec<f32> = field.clouds.iter().map(|c| c.rank).collect();
        let step = ranks
            .windows(2)
            .map(|p| p[1] - p[0])
            .fold(ranks[0], f32::max);
        for &cover in covers {
            let found = covered(&field, cover);
            // Clouds come whole; a full sky may miss a hundredth; the lattice of 9409 places sees a share to some thousandths.
            assert!(
                (found - cover).abs() <= 0.5 * step + 0.015,
                "{name} {cover}: {found}"
            );
        }
    }
}

#[test]
fn a_layer_ends_at_its_cover_and_the_next_goes_on() {
    let cumulus = "[[field.clouds]]\nkind = \"cumulus\"\ncover = 0.2\n";
    let alone = field(cumulus);
    let both = field(&format!(
        "{cumulus}[[field.clouds]]\nkind = \"stratus\"\ncover = 0.5\n"
    ));
    let first = alone.clouds.len();
    assert_eq!(both.clouds[..first], alone.clouds);
    let found = covered(&alone, 1.0);
    assert!((0.19..0.225).contains(&found), "{found}");
    assert!(
        both.clouds[first..]
            .iter()
            .all(|c| (0.2..0.55).contains(&c.rank))
    );
    // Where the first layer has covered more than the second asks, the second is empty.
    let none = field(&format!(
        "{cumulus}[[field.clouds]]\nkind = \"stratus\"\ncover = 0.1\n"
    ));
    assert_eq!(none, alone);
}

#[test]
fn a_field_depends_on_its_seed_and_on_nothing_else() {
    assert_eq!(field("seed = 3"), field("seed = 3"));
    assert_ne!(field("seed = 3").clouds, field("seed = 4").clouds);
    let text = "[field]\nsections = 1\nhours = [{ time = 0.5, colour = [1, 1, 1] }]\n";
    let one = field(text);
    assert_eq!((one.sections, one.hours.len()), (1, 1));
    assert_eq!(one.side_m(), 4000.0);
}

#[test]
fn a_model_keeps_the_rank_that_it_is_given() {
    let field = recipe_field("models.toml");
    assert_eq!(field.clouds[0].rank, 0.0);
    assert_eq!(field.clouds[0].boxes.len(), 2);
    assert_eq!(field.clouds[0].boxes[0].size_m, [800.0, 200.0, 500.0]);
    assert!(field.clouds[1..].iter().all(|c| c.rank > 0.0));
    let congestus = field.clouds.iter().filter(|c| c.boxes.len() == 9);
    assert!(congestus.count() >= 6);
}

#[test]
fn an_artists_sheet_keeps_all_its_boxes_where_it_meets_another() {
    let of_box = |x: i32| {
        format!("[[field.models.boxes]]\ncentre_m = [{x}, 100, 0]\nsize_m = [900, 200, 900]\n")
    };
    let boxes: String = (0..4).map(|i| of_box(900 * i)).collect();
    let model = format!("[[field.models]]\nkind = \"stratus\"\ncopies = 20\n{boxes}");
    let field = field(&format!("[field]\nsections = 1\n{model}"));
    assert!(field.clouds.iter().all(|cloud| cloud.boxes.len() == 4));
}
