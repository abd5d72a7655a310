//! An artist's model, glTF in one file.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    welkin_baker::fuzzing::model(bytes);
});
