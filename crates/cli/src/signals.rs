//! SIGINT and SIGTERM: the first one asks the program to stop, the second one ends it at once.

use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use pipeline::Stop;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::exit::code_of_signal;

/// Makes signals ask `stop` to stop, from now on. Fails where the system refuses to call us.
pub fn watch(stop: &Stop) -> io::Result<()> {
    let again = Arc::new(AtomicBool::new(false));
    for (signal, number) in [(SIGINT, 2), (SIGTERM, 15)] {
        // In this order: the first signal finds `again` unset, and sets it.
        flag::register_conditional_shutdown(signal, i32::from(code_of_signal(number)), Arc::clone(&again))?;
        flag::register(signal, Arc::clone(&again))?;
        flag::register_usize(signal, stop.signal_slot(), number)?;
    }
    // A file that passes the limit on its size then fails like any other write, and does not end the program.
    #[cfg(unix)]
    flag::register(signal_hook::consts::SIGXFSZ, Arc::new(AtomicBool::new(false)))?;
    Ok(())
}
