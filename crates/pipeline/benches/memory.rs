//! Peak memory by the length of the session.

use std::path::Path;
use std::process::Command;

use ingest::{NoProgress, ingest_session};

use crate::{card, week};

/// First argument of the process whose memory is measured.
pub const CHILD: &str = "child-for-memory";

/// Ingest and signals of sessions of 1 h, 8 h and 7 days, each in a process of its own.
pub fn run() {
    println!("\nPeak memory of ingest and of signals, MB (an empty process included)");
    for (name, seconds) in [("1 h", 3600), ("8 h", 8 * 3600), ("7 days", 7 * 24 * 3600)] {
        let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
        let from = folder.path().join("card");
        card::sensors(&from, seconds);
        card::images(&from, 60);
        let mcap = folder.path().join("out.mcap");
        let peak = |what: &str| {
            let mut child = Command::new(std::env::current_exe().unwrap());
            let child = child.arg(CHILD).arg(what).args([&from, &mcap]).arg(seconds.to_string());
            let output = child.output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            String::from_utf8(output.stdout).unwrap().trim().parse::<f64>().unwrap() / 1024.0
        };
        let (ingest_mb, signals_mb) = (peak("ingest"), peak("signals"));
        println!("  {name:<8} ingest {ingest_mb:7.1}   signals {signals_mb:7.1}");
    }
}

/// In the process that is measured.
pub fn child(arguments: &[String]) {
    let [what, from, mcap, seconds] = arguments else { panic!("expected WHAT CARD MCAP SECONDS") };
    if what == "ingest" {
        ingest_session(&card::source(Path::new(from)), Path::new(mcap), &NoProgress).unwrap();
    } else {
        week::pitch_at_images(Path::new(mcap), seconds.parse().unwrap());
    }
    // The peak of the resident set, as Linux keeps it.
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let peak_kb = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    println!("{}", peak_kb.unwrap().trim().trim_end_matches("kB").trim());
}
