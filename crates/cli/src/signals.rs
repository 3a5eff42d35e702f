//! SIGINT and SIGTERM: the first asks to stop, the second ends the program at once.

use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use pipeline::Stop;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Makes signals ask `stop` to stop, from now on.
pub fn watch(stop: &Stop) -> io::Result<()> {
    let again = Arc::new(AtomicBool::new(false));
    for (signal, number) in [(SIGINT, 2), (SIGTERM, 15)] {
        // In this order: the first signal finds `again` unset, and sets it.
        flag::register_conditional_shutdown(signal, exit_code(number), Arc::clone(&again))?;
        flag::register(signal, Arc::clone(&again))?;
        flag::register_usize(signal, stop.signal_slot(), usize::from(number))?;
    }
    Ok(())
}

/// Exit code of a program that a signal ended, as shells give it.
fn exit_code(signal: u8) -> i32 {
    128 + i32::from(signal)
}
