//! A field of clouds, binary glTF.
#![no_main]

use welkin_pack::Field;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    drop(Field::from_glb("fuzz.glb", bytes));
});
