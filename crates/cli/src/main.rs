//! The binary `aim-batch`.
fn main() {}
