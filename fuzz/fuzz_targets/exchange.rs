#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    aim_batch_fuzz_targets::exchange(bytes);
});
