//! The catalogue texture: every star of a catalogue where it stands, the brightest first.
//!
//! Light and colour are the catalogue's. How a star flickers no catalogue tells: rate, amplitude in the zenith and phase are drawn at random, as those of the
//! stars that are not of a catalogue; the air makes them what they are at a height (the runtime's `clear_sky/catalogue.rs`).

use welkin_pack::{CatalogueStar, Image, Role};

use crate::catalogue::{self, Star};
use crate::error::{BakeError, unfit};
use crate::inputs::{Named, Reader};
use crate::notice::{Dropped, Notice};
use crate::settings::CatalogueSource;
use crate::stream::Stream;

/// The catalogue that a recipe means by `built-in`; assets-src/SOURCES.md says whose it is.
#[cfg(feature = "stars")]
const BUILT_IN: Option<&[u8]> = Some(include_bytes!(concat!(
    env!("WELKIN_ASSETS"),
    "/stars/stars.6.json"
)));
/// It may be left out, as the photograph.
#[cfg(not(feature = "stars"))]
const BUILT_IN: Option<&[u8]> = None;

/// BLAKE3 of its bytes, in lower-case hexadecimal.
const BUILT_IN_BLAKE3: &str = "64589e3d24dae5fc64206bd1f911dd983e8ab409dc9261bd2e00ad97031f957d";

/// The name of the built-in catalogue in errors and, without the feature `stars`, among the files in memory.
pub const BUILT_IN_NAME: &str = "built-in catalogue";

/// The bytes of the built-in catalogue, if it is compiled in.
pub fn built_in_catalogue() -> Option<&'static [u8]> {
    BUILT_IN
}

/// The key of the recipe.
const KEY: &str = "stars.catalogue";

/// The longest catalogue, in bytes: a million stars in 128 bytes each.
const MAX_BYTES: u64 = 128 << 20;

/// The least flicker amplitude in the zenith as a share of the light, and the greatest: chosen so that eyes hardly see it there, and that it is strong
/// ten air masses low.
const VARIANCE_SHARES: [f64; 2] = [0.05, 0.15];

/// The file to be read, if there is one.
pub(crate) fn file(source: &CatalogueSource) -> Option<Named> {
    match (source, BUILT_IN) {
        (CatalogueSource::File(file), _) => Some(Named::new(KEY, file, MAX_BYTES)),
        (CatalogueSource::BuiltIn, Some(_)) => None,
        (CatalogueSource::BuiltIn, None) => Some(Named::new(KEY, BUILT_IN_NAME, MAX_BYTES)),
    }
}

/// The three layers of the texture, and what is to be told of stars that it has no room for.
pub(crate) fn images(
    source: &CatalogueSource,
    reader: &Reader,
    seed: u64,
) -> Result<(Vec<Image>, Option<Notice>), BakeError> {
    let mut stars = read(source, reader)?;
    stars.sort_by(|a, b| {
        key(a)
            .partial_cmp(&key(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let [least, most] = Role::Catalogue.spec().sides;
    let room = (most * most) as usize;
    let found = stars.len();
    stars.truncate(room);
    let notice = stars.last().filter(|_| found > room).map(|faintest| {
        Notice::StarsDropped(Dropped {
            found,
            kept: room,
            magnitude: faintest.magnitude,
        })
    });
    let mut side = least;
    while ((side * side) as usize) < stars.len() {
        side *= 2;
    }
    Ok((records(&stars, side, seed), notice))
}

/// The order of the stars: by magnitude, and among equals by place.
fn key(star: &Star) -> [f64; 3] {
    [
        star.magnitude,
        star.right_ascension_deg,
        star.declination_deg,
    ]
}

fn read(source: &CatalogueSource, reader: &Reader) -> Result<Vec<Star>, BakeError> {
    let given = match (source, BUILT_IN) {
        (CatalogueSource::File(_), _) => file(source).map(|named| reader.read(&named)),
        // The pack does not say which catalogue it was made from: there is one.
        (CatalogueSource::BuiltIn, None) => file(source).map(|named| reader.read_only(&named)),
        (CatalogueSource::BuiltIn, Some(_)) => None,
    };
    let given = given.transpose()?;
    let (name, bytes) = match &given {
        Some(picture) => (picture.file.as_str(), picture.bytes.as_slice()),
        None => (BUILT_IN_NAME, BUILT_IN.unwrap_or_default()),
    };
    if *source == CatalogueSource::BuiltIn {
        let found = blake3::hash(bytes).to_hex();
        if found.as_str() != BUILT_IN_BLAKE3 {
            return Err(unfit(BUILT_IN_NAME, "BLAKE3", found, BUILT_IN_BLAKE3));
        }
    }
    Ok(catalogue::read(name, bytes)?)
}

fn records(stars: &[Star], side: u32, seed: u64) -> Vec<Image> {
    let [mut rates, mut variances, mut phases] =
        ["catalogue.rate", "catalogue.variance", "catalogue.phase"]
            .map(|name| Stream::new(seed, name));
    let mut images = vec![Image::new(side, side, 4); 3];
    let [slowest, fastest] = CatalogueStar::RATES;
    let [calmest, wildest] = VARIANCE_SHARES;
    for (i, star) in (0..).zip(stars) {
        let record = CatalogueStar {
            right_ascension_deg: star.right_ascension_deg,
            declination_deg: star.declination_deg,
            magnitude: star.magnitude,
            colour_index: star.shown_colour_index(),
            rate: slowest + (f64::from(fastest - slowest) * rates.unit()) as u8,
            variance: (255.0 * (calmest + (wildest - calmest) * variances.unit())) as u8,
            phase: (phases.bits() >> 56) as u8,
        };
        for (image, bytes) in images.iter_mut().zip(record.encode()) {
            let texel = image.texel_mut(i % side, i / side);
            texel.copy_from_slice(&bytes.map(|byte| f32::from(byte) / 255.0));
        }
    }
    images
}

#[cfg(all(test, feature = "stars"))]
mod tests {
    use super::*;
    use crate::inputs::Inputs;
    use std::collections::BTreeMap;

    fn of(images: &[Image], index: u32) -> CatalogueStar {
        let side = images[0].width;
        let texel = |layer: usize| {
            let texel = images[layer].texel(index % side, index / side);
            std::array::from_fn(|i| (texel[i] * 255.0 + 0.5) as u8)
        };
        CatalogueStar::decode([0, 1, 2].map(texel))
    }

    #[test]
    fn the_built_in_catalogue_is_there_whole_and_sirius_comes_first() {
        let none = BTreeMap::new();
        let reader = Reader::new(Inputs::Memory(&none));
        let (images, notice) = images(&CatalogueSource::BuiltIn, &reader, 7).unwrap();
        assert_eq!(notice, None);
        assert_eq!(images[0].width, 128);
        let stars = images[1].texels.chunks_exact(4).filter(|t| t[3] == 1.0);
        assert_eq!(stars.count(), 5044);
        let sirius = of(&images, 0);
        assert!((sirius.right_ascension_deg - 101.2872).abs() < 0.003);
        assert!((sirius.declination_deg + 16.7161).abs() < 0.003);
        assert!(
            (sirius.magnitude + 1.44).abs() < 2e-4 && (sirius.colour_index - 0.01).abs() < 0.01
        );
        // The sum of light of the records is the catalogue's.
        let light = |m: f64| libm::exp10(-0.4 * m);
        let recorded: f64 = (0..5044).map(|i| light(of(&images, i).magnitude)).sum();
        let own = catalogue::read("b", BUILT_IN.unwrap()).unwrap();
        let catalogued: f64 = own.iter().map(Star::light).sum();
        assert!((recorded / catalogued - 1.0).abs() < 1e-3);
    }

    #[test]
    fn a_catalogue_that_is_too_long_loses_its_faintest_and_that_is_told() {
        let mut text = "ra_deg,dec_deg,mag\n".to_string();
        for i in 0..65_540 {
            let star = format!("{},{},{}\n", i % 360, i % 89, 14.0 - f64::from(i) * 2e-4);
            text += &star;
        }
        let files = BTreeMap::from([("s.csv".to_string(), text.into_bytes())]);
        let reader = Reader::new(Inputs::Memory(&files));
        let source = CatalogueSource::File("s.csv".to_string());
        let (images, notice) = images(&source, &reader, 7).unwrap();
        assert_eq!(images[0].width, 256);
        let told = notice.unwrap().to_string();
        assert_eq!(
            told,
            "stars.catalogue: of 65540 stars the faintest 4 were left out, beyond magnitude 14.00; a pack has room for 65536"
        );
        assert!((of(&images, 65_535).magnitude - 13.9992).abs() < 3e-4);
    }
}
