//! A KTX2 file.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    drop(welkin_pack::ktx::decode("fuzz.ktx2", bytes));
});
