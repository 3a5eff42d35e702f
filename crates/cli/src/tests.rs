//! Tests of the command line as clap sees it.

use clap::CommandFactory;

use crate::args::Args;

#[test]
fn the_command_line_is_well_formed() {
    Args::command().debug_assert();
}

/// `run` has too many flags for a single list.
#[test]
fn every_flag_of_run_stands_in_a_group_of_its_help() {
    let mut command = Args::command();
    command.build();
    let run = command.find_subcommand("run").unwrap();
    let flags = run.get_arguments().filter(|argument| !argument.is_positional());
    let outside: Vec<&str> =
        flags.filter(|flag| flag.get_help_heading().is_none()).map(|flag| flag.get_id().as_str()).collect();
    assert_eq!(outside, ["help", "version"]);
}
