//! Two programs that take turns.

use std::time::Instant;

const TURNS: usize = 7;

/// Runs both by turns and prints seconds (least, median, most) of each, and the ratio of each pair.
pub fn compare(title: &str, (ours, run_ours): (&str, &mut dyn FnMut()), (peer, run_peer): (&str, &mut dyn FnMut())) {
    run_ours();
    run_peer();
    let mut pairs = Vec::new();
    for _ in 0..TURNS {
        pairs.push((seconds(run_ours), seconds(run_peer)));
    }
    println!("\n{title}");
    print_line(ours, pairs.iter().map(|(ours, _)| *ours).collect());
    print_line(peer, pairs.iter().map(|(_, peer)| *peer).collect());
    print_line("ratio", pairs.iter().map(|(ours, peer)| ours / peer).collect());
}

/// Prints least, median and most.
pub fn print_line(name: &str, mut values: Vec<f64>) {
    values.sort_by(f64::total_cmp);
    let (least, median, most) = (values[0], values[values.len() / 2], values[values.len() - 1]);
    println!("  {name:<40} {least:9.4} {median:9.4} {most:9.4}");
}

pub fn seconds(run: &mut dyn FnMut()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_secs_f64()
}
