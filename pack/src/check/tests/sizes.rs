//! Every size that a manifest may name, with texels that say nothing: rules divide, take logarithms and count cells, and
//! none may trip over a size.

use crate::check::report::Report;
use crate::check::{Claim, check_role};
use crate::format::Format;
use crate::role::Role;
use crate::texture::Texture;

/// Powers of two from one side to another.
fn sides([least, most]: [u32; 2]) -> impl Iterator<Item = u32> + Clone {
    std::iter::successors(Some(least), |side| Some(side * 2)).take_while(move |side| *side <= most)
}

/// Every legal width, height and number of layers of a role, no side larger than `most`. Of a hundred numbers of layers the ends and one between.
fn layouts(role: Role, most: u32) -> Vec<[u32; 3]> {
    let spec = role.spec();
    let [least_side, most_side] = spec.sides;
    let sides = sides([least_side, most_side.min(most)]);
    let [fewest, most_layers] = spec.layers;
    let step = match most_layers - fewest {
        0..100 => 1,
        many => many / 2,
    };
    let layers = || (fewest..=most_layers).step_by(step as usize);
    let sizes = sides
        .clone()
        .flat_map(|w| sides.clone().map(move |h| [w, h]));
    let layouts = sizes.flat_map(|[w, h]| layers().map(move |layers| [w, h, layers]));
    layouts
        .filter(|layout| spec.verify_size("t", "", *layout).is_ok())
        .collect()
}

/// Texels that repeat these bytes.
fn texture(role: Role, format: Format, [width, height, layers]: [u32; 3], bytes: &[u8]) -> Texture {
    let spec = role.spec();
    let mut texture = Texture {
        format,
        shape: spec.shape,
        width,
        height,
        layers,
        levels: Vec::new(),
    };
    for level in 0..spec.mips.count(width, height) {
        let repeated = bytes.iter().copied().cycle();
        let level = repeated.take(texture.level_bytes(level)).collect();
        texture.levels.push(level);
    }
    texture
}

fn check_all(most: u32) {
    // Nothing, the most, half floats of 1, of infinity and of no number, and stripes.
    let patterns: [&[u8]; 6] = [
        &[0],
        &[255],
        &[0x00, 0x3c],
        &[0x00, 0x7c],
        &[0x01, 0x7e],
        &[0, 255, 7, 128, 255, 0, 99],
    ];
    for role in Role::ALL {
        let layouts = layouts(role, most);
        assert!(!layouts.is_empty(), "{role:?}");
        for layout in layouts {
            for format in role.spec().formats {
                for pattern in patterns {
                    let mut report = Report::default();
                    let texture = texture(role, *format, layout, pattern);
                    check_role(&mut report, role, &texture, Claim::default());
                    let told = !report.findings.is_empty();
                    assert!(told, "{role:?} {layout:?}: nothing was looked at");
                    // A picture of a clear or of an even sky is one.
                    let may_be = role == Role::Skybox && pattern[pattern.len() - 1] < 0x40;
                    let is_sound = report.is_sound();
                    assert!(!is_sound || may_be, "{role:?} {layout:?} {pattern:?}");
                }
            }
        }
    }
}

/// Sides up to 128, or with WELKIN_LONG=1 up to 1024, which takes minutes in a release build:
/// `WELKIN_LONG=1 cargo test --release -p welkin-pack --features write sizes`.
#[test]
fn no_legal_size_makes_a_rule_panic_or_pass_what_says_nothing() {
    let is_long = std::env::var_os("WELKIN_LONG").is_some();
    check_all(if is_long { 1024 } else { 128 });
}

/// The rules of the fbm are not asked about such a layout, since it is refused before; they end all the same.
#[test]
fn octaves_finer_than_texels_do_not_divide_by_zero() {
    for (side, layers) in [(64, 7), (64, 8), (128, 8), (32, 12)] {
        for pattern in [&[0_u8][..], &[0, 255, 7, 128, 255, 0, 99]] {
            let mut report = Report::default();
            let format = Format::Rgba8Unorm;
            let texture = texture(Role::Fbm, format, [side, side, layers], pattern);
            check_role(&mut report, Role::Fbm, &texture, Claim::default());
            assert!(!report.is_sound());
        }
    }
}
