//! The command line as clap sees it.

use clap::CommandFactory;

use crate::args::Args;

#[test]
fn the_command_line_is_well_formed() {
    Args::command().debug_assert();
}
