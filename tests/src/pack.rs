//! Packs for tests: the default one, and changed ones.

use std::ops::ControlFlow;
use std::sync::OnceLock;

use welkin_baker::Resolved;
use welkin_pack::{Image, Pack, PackInfo, Role, Source};

/// The default recipe's pack, baked once a test program.
///
/// # Panics
/// If it cannot be baked: no test can go on without it.
pub fn default_pack() -> &'static Pack {
    static PACK: OnceLock<Pack> = OnceLock::new();
    PACK.get_or_init(|| {
        welkin_baker::bake(&resolved(), None, &|_| ControlFlow::Continue(()))
            .expect("the default pack bakes")
    })
}

fn resolved() -> Resolved {
    welkin_baker::Recipe::default()
        .resolve(None)
        .expect("the default recipe resolves")
}

/// The default pack with other images and another sun: `change` gets the linear image of each role.
///
/// # Panics
/// If the changed images are no pack any more.
pub fn changed_pack(noon_elevation_rad: Option<f32>, change: impl Fn(Role, &mut Image)) -> Pack {
    static SOURCES: OnceLock<Vec<Source>> = OnceLock::new();
    let sources = SOURCES.get_or_init(|| {
        welkin_baker::sources(&resolved(), None, &|_| ControlFlow::Continue(()))
            .expect("the default images are made")
    });
    let mut sources = sources.clone();
    sources
        .iter_mut()
        .for_each(|source| change(source.role, &mut source.image));
    let usual = default_pack().manifest();
    let info = PackInfo {
        name: "changed".to_string(),
        seed: usual.seed,
        baker: "welkin-tests".to_string(),
        recipe: String::new(),
        inputs: Vec::new(),
        noon_elevation_rad: noon_elevation_rad.unwrap_or(usual.noon_elevation_rad),
    };
    Pack::build(info, sources).expect("the changed pack is sound")
}

/// A pack whose sky is black and always night, without a galaxy: nothing but the stars is left.
pub fn stars_alone() -> Pack {
    changed_pack(None, |role, image| match role {
        Role::Sky => image
            .texels
            .chunks_exact_mut(4)
            .for_each(|texel| texel.copy_from_slice(&[0.0, 0.0, 0.0, 1.0])),
        Role::Galaxy => image.texels.fill(0.0),
        _ => {}
    })
}
