//! A manifest, with no other file beside it.
#![no_main]

use std::collections::BTreeMap;

use welkin_pack::Pack;
use welkin_pack::check::check_memory;
use welkin_pack::manifest::MANIFEST_FILE;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let files = BTreeMap::from([(MANIFEST_FILE.to_string(), bytes.to_vec())]);
    drop(Pack::from_memory("fuzz", &files));
    drop(check_memory("fuzz", &files));
});
