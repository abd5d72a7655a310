//! What the index says of a picture. Keys stand in the order of the fields.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::labels::Told;

/// What every line begins with.
pub const BEGINNING: &[u8] = b"{\"name\":\"";

/// A picture: what it is of, and the files that were made of it.
#[derive(Debug, Serialize)]
pub struct Line {
    /// The job's.
    pub name: String,
    /// Its files by what they are.
    pub files: BTreeMap<String, Made>,
    /// The tar file that they are in, if it is not the folder itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tar: Option<Made>,
    /// Hash of all that the picture follows from, but for the device.
    pub job: String,
    /// Which labels there are.
    pub labels: Vec<String>,
    /// What they say in numbers.
    #[serde(flatten)]
    pub told: Told,
    /// Program and version.
    pub writer: &'static str,
    /// Its pack.
    pub pack: PackTold,
    /// The job's, handed on.
    pub seed: Option<u64>,
    /// The job's, handed on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weather: Option<String>,
    /// `size`, `equirect` or `cubemap`.
    #[serde(flatten)]
    pub size: BTreeMap<&'static str, Value>,
    /// The settings that are not the usual ones, as a job has them, with the cover that was drawn.
    pub settings: BTreeMap<String, Value>,
}

/// A file of a picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Made {
    /// Its name in the folder.
    pub file: String,
    /// BLAKE3 of its bytes.
    pub blake3: String,
}

/// A pack.
#[derive(Debug, Serialize)]
pub struct PackTold {
    /// The last part of its folder's name.
    pub name: String,
    /// The manifest's seal, which stands for all of it.
    pub seal: String,
}

/// What a line says, as far as a later run asks.
#[derive(Deserialize)]
pub struct Known {
    pub name: String,
    pub tar: Option<Made>,
    pub job: String,
    pub labels: Vec<String>,
    pub files: BTreeMap<String, Made>,
}

/// BLAKE3 in hexadecimal digits.
pub fn hash(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}
