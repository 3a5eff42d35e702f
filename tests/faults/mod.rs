//! Faults around a run: it is killed, stopped, run twice, out of space, its files change or break. Nothing is lost,
//! nothing is half-written, and the next run gives what an undisturbed one would have given, to the byte.

mod bench;
mod changes;
mod determinism;
mod kills;
mod moving_cards;
mod panics;
mod places;
mod progress;
mod system;
mod two_runs;
mod work_folder;

use bench::Bench;
