//! A catalogue of stars, of whatever layout it looks like.
#![no_main]

use welkin_baker::catalogue;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    drop(catalogue::read("fuzz.csv", bytes));
});
