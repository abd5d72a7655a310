//! The rules for a texture alone, before it is in any pack.

use super::report::{Outcome, Report};
use super::role::{Claim, check_role};
use super::rule::{LAYOUT, LEVEL_MEAN, MIP_MEAN, Rule, SPRITE_LEVEL, STAR_LIGHT, STAR_RECORD};
use crate::mip;
use crate::role::Role;
use crate::texture::Texture;

/// The rules that only compare stored levels with each other.
const ABOUT_STORED_LEVELS: [Rule; 5] =
    [MIP_MEAN, LEVEL_MEAN, STAR_LIGHT, STAR_RECORD, SPRITE_LEVEL];

/// Checks one texture as [`super::check`] checks those of a pack: whether every channel is what `role` says.
///
/// The rule `layout` says whether format, shape, size and levels are those of the role; if not, it is the only finding. A
/// texture may have level 0 alone: then the levels above are made as a bake makes them, and the rules that compare stored
/// levels with each other are skipped. Rules about files and the manifest are not in the report.
///
/// In a test of a program that makes a galaxy:
///
/// ```
/// use welkin_pack::check::check_texture;
/// use welkin_pack::{Format, Role, Shape, Texture};
///
/// let too_dark = Texture {
///     format: Format::R8Unorm,
///     shape: Shape::D2,
///     width: 128,
///     height: 128,
///     layers: 1,
///     levels: vec![vec![20; 128 * 128]],
/// };
/// let report = check_texture(Role::Galaxy, &too_dark);
/// assert!(!report.is_sound());
/// let lines: Vec<String> = report.problems().map(ToString::to_string).collect();
/// assert!(lines.iter().any(|line| line.contains("galaxy-brightness")), "{lines:#?}");
/// ```
pub fn check_texture(role: Role, texture: &Texture) -> Report {
    let mut report = Report::default();
    let name = role.name();
    let layout = role.verify_texture(name, texture);
    if report.verify(LAYOUT, name, layout).is_none() {
        return report;
    }
    let all = role.spec().mips.count(texture.width, texture.height);
    if texture.levels.len() == all {
        check_role(&mut report, role, texture, Claim::default());
    } else {
        check_role(
            &mut report,
            role,
            &with_levels(role, texture),
            Claim::default(),
        );
        let are_made = |rule: &str| ABOUT_STORED_LEVELS.iter().any(|r| r.id == rule);
        for finding in &mut report.findings {
            if are_made(finding.rule) {
                finding.outcome = Outcome::Skipped;
                (finding.figure, finding.expected) = (None, String::new());
                finding.note = "the texture has level 0 alone".to_string();
            }
        }
    }
    report.sort();
    report
}

/// The texture with the levels that a bake would make of its level 0, which stays as it is.
fn with_levels(role: Role, texture: &Texture) -> Texture {
    let images = (0..texture.layers).map(|layer| texture.image(0, layer));
    let mut levels = mip::levels(role, texture.format, images.collect());
    // Half floats that are not finite stay in it, so that the rules see them.
    levels[0].clone_from(&texture.levels[0]);
    Texture {
        format: texture.format,
        shape: texture.shape,
        width: texture.width,
        height: texture.height,
        layers: texture.layers,
        levels,
    }
}
