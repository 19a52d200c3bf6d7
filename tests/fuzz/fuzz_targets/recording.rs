#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| brinell_fuzz::run("recording", data));
