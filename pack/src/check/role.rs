//! The rules about the texels of each role.

use super::report::Report;
use super::{
    catalogue, clouds, fbm, finite, flares, galaxy, layers, mips, octaves, sky, skybox, sprites,
    stars, sun,
};
use crate::manifest::{Manifest, TextureEntry};
use crate::role::Role;
use crate::texture::Texture;

/// What a manifest says that rules rely on; nothing of a texture that is in no pack.
#[derive(Clone, Copy, Default)]
pub(super) struct Claim<'a> {
    /// The texture's entry.
    pub entry: Option<&'a TextureEntry>,
}

impl Claim<'_> {
    pub(super) fn new(manifest: &Manifest, role: Role) -> Claim<'_> {
        Claim {
            entry: manifest.texture(role),
        }
    }
}

/// The rules about the texels of a role. The texture is laid out as the role asks, with all levels.
pub(super) fn check_role(report: &mut Report, role: Role, texture: &Texture, claim: Claim) {
    if !finite::check(report, role, texture) {
        // No figure of what is not a number means anything.
        return;
    }
    mips::check(report, role, texture);
    match role {
        Role::Clouds => clouds::check(report, texture, claim.entry),
        Role::Stars => stars::check(report, texture),
        Role::Galaxy => galaxy::check(report, texture),
        Role::Sky => sky::check(report, texture),
        Role::Sun => sun::check(report, texture),
        Role::Octaves => octaves::check(report, texture),
        Role::Fbm => fbm::check(report, texture),
        Role::Flares => flares::check(report, texture),
        Role::Layers => layers::check(report, texture),
        Role::Sprites => sprites::check(report, texture),
        Role::Skybox => skybox::check(report, texture),
        Role::Catalogue => catalogue::check(report, texture),
    }
}
