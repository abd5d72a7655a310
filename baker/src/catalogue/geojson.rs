//! GeoJSON (RFC 7946) as d3-celestial has it: a feature a star.

use serde::Deserialize;
use serde_json::Value;

use super::error::CatalogueError;
use super::numbers::{MAGNITUDES, Place, star};
use super::star::Star;

#[derive(Deserialize)]
struct Collection {
    features: Vec<Feature>,
}

#[derive(Deserialize)]
struct Feature {
    #[serde(default)]
    properties: Value,
    #[serde(default)]
    geometry: Value,
}

pub fn read(file: &str, text: &str) -> Result<Vec<Star>, CatalogueError> {
    let collection: Collection =
        serde_json::from_str(text).map_err(|error| CatalogueError::Layout {
            file: file.to_string(),
            found: format!("JSON that is no collection of features: {error}"),
        })?;
    let mut stars = Vec::with_capacity(collection.features.len());
    for (index, feature) in collection.features.iter().enumerate() {
        let place = Place {
            file,
            unit: "feature",
            number: index + 1,
        };
        let coordinates = &feature.geometry["coordinates"];
        let ascension = place.number("coordinates[0]", &words(&coordinates[0]), -360.0..=360.0)?;
        let declination = place.number("coordinates[1]", &words(&coordinates[1]), -90.0..=90.0)?;
        let magnitude = place.number("mag", &words(&feature.properties["mag"]), MAGNITUDES)?;
        let index = place.colour_index("bv", &words(&feature.properties["bv"]))?;
        stars.extend(star(ascension, declination, magnitude, index));
    }
    Ok(stars)
}

/// A number, or a text with one in it; what is not there is empty.
fn words(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
