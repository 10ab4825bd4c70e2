#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stillbeam_fuzz::scene(bytes));
