#!/usr/bin/env bash
# One would expect: jiff's strptime uses everything that it reads, or gives an error.
# What happens: with '%s%.f' the seconds since 1970 are used, and the fraction behind them is read and dropped. With '%s %H:%M' the time of
#   day is read, contradicts the seconds, and is dropped as well.
# Why it matters here: loggers name files and stamp rows with seconds since 1970 and a fraction. A second is 128 samples; at walking
#   pace the head turns by degrees in it. The program reads the fraction itself and refuses patterns that say a time twice.
# Source: https://docs.rs/jiff/latest/jiff/fmt/strtime/ ('%s': a Unix timestamp, in seconds)
# Needs: cargo.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat >"$folder/Cargo.toml" <<'END'
[package]
name = "finding"
version = "0.0.0"
edition = "2021"
[workspace]
[dependencies]
jiff = "=0.2.43"
END
cat >"$folder/src/main.rs" <<'END'
use jiff::fmt::strtime;

fn millis(format: &str, text: &str) -> i64 {
    let parsed = strtime::parse(format, text).expect("it is read");
    parsed.to_timestamp().expect("it is a time").as_millisecond()
}

fn main() {
    println!("jiff 0.2.43");
    let fraction = millis("%s%.f", "1614613210.750000");
    let day = millis("%s %H:%M", "1614613210 23:59");
    let by_date = millis("%Y-%m-%dT%H:%M:%S%.f%z", "2021-03-01T15:40:10.75+0000");
    println!("1614613210.750000 by %s%.f: {fraction}; 1614613210 23:59 by %s %H:%M: {day}; by date and time: {by_date} (ms)");
    if (fraction, day, by_date) != (1_614_613_210_000, 1_614_613_210_000, 1_614_613_210_750) {
        eprintln!("changed: expected that fraction and time of day are dropped beside %s alone");
        std::process::exit(1);
    }
}
END
cargo run --quiet --manifest-path "$folder/Cargo.toml"
echo "as before"
