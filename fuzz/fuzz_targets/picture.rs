//! A picture of any format that the baker reads, as a photograph of clouds and as a sky.
#![no_main]

use welkin_baker::fuzzing;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    fuzzing::photo(bytes);
    fuzzing::sky(bytes);
});
