//! The catalogue of stars: records of three texels, the brightest first.

use super::report::Report;
use super::rule::{CATALOGUE_FLICKER, CATALOGUE_ORDER, CATALOGUE_RECORD};
use crate::role::Role;
use crate::texel::CatalogueStar;
use crate::texture::Texture;

const NAME: &str = Role::Catalogue.name();

pub(super) fn check(report: &mut Report, texture: &Texture) {
    let texels = texture.width as usize * texture.height as usize;
    let record = |i: usize| [0, 1, 2].map(|layer| texel(texture, layer * texels + i));
    let stars = (0..texels)
        .take_while(|&i| record(i)[1][3] == CatalogueStar::IS_STAR)
        .count();
    let stray = (stars..texels).filter(|&i| record(i) != [[0; 4]; 3]);
    report.at_most(CATALOGUE_RECORD, NAME, stray.count() as f64, 0.0);
    report.at_least(
        CATALOGUE_RECORD,
        &format!("{NAME} stars"),
        stars as f64,
        1.0,
    );
    let magnitude = |i: usize| [record(i)[1][0], record(i)[1][1]];
    let out_of_order = (1..stars).filter(|&i| magnitude(i) < magnitude(i - 1));
    report.at_most(CATALOGUE_ORDER, NAME, out_of_order.count() as f64, 0.0);
    let [slowest, fastest] = CatalogueStar::RATES;
    let flickers = |[rate, variance, _, nothing]: [u8; 4]| {
        (slowest..=fastest).contains(&rate) && variance > 0 && nothing == 0
    };
    let still = (0..stars).filter(|&i| !flickers(record(i)[2])).count();
    report.at_most(CATALOGUE_FLICKER, NAME, still as f64, 0.0);
}

fn texel(texture: &Texture, index: usize) -> [u8; 4] {
    std::array::from_fn(|byte| texture.levels[0][4 * index + byte])
}
