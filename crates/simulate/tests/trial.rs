//! Tests of the simulated bench of docs/accuracy.md.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_simulate::trial::{Level, Line, Options, Score, Subject, run, score};
use model::{InputSigma, Method, Quantity};

/// Least number of claimed sizes of a line whose coverage is tested. Sessions that share a device are a single draw, so the
/// coverage of fewer sizes says little.
const FEWEST_CLAIMED: usize = 400;

#[test]
fn intervals_cover_and_the_new_methods_are_better() {
    let trials = run(&Options::default());
    assert!(trials.len() > 2000);
    let score = score(&trials);
    documented(&score);
    let mut seen = 0;
    for line in score.lines.iter().filter(|line| line.claimed >= FEWEST_CLAIMED) {
        assert!((0.93..=0.97).contains(&line.within_2), "95 %: {line:?}");
        assert!((0.64..=0.73).contains(&line.within_1), "68 %: {line:?}");
        seen += 1;
    }
    assert!(seen > 30, "{seen}");

    let bowls = [Subject::UprightBowl, Subject::SlopedBowl, Subject::CurvedBowl];
    let heights = |subjects: &[Subject], method: Method| {
        let of = |subject: &Subject| score.line(Level::Image, Quantity::Height, Some(*subject), method).unwrap();
        let squares: f64 = subjects.iter().map(|s| of(s).rmse_pct.powi(2)).sum();
        (squares / f64::from(u32::try_from(subjects.len()).unwrap())).sqrt()
    };
    assert!(heights(&bowls, Method::Paper) > 5.0 * heights(&bowls, Method::Coaxial));
    assert!(heights(&bowls[1..], Method::Paper) > 5.0 * heights(&bowls[1..], Method::Coaxial));

    for best in score.lines.iter().filter(|line| line.method == Method::Best && line.subject.is_some()) {
        let same = |line: &&Line| {
            (line.subject, line.quantity, line.level) == (best.subject, best.quantity, best.level)
                && line.method != Method::Best
                && line.n >= best.n
        };
        let surest = score.lines.iter().filter(same).map(|line| line.rmse_pct).fold(f64::INFINITY, f64::min);
        assert!(best.rmse_pct <= 1.1 * surest, "{best:?} against {surest}");
    }
}

/// Checks that every line of the document's table is one of the score.
fn documented(score: &Score) {
    let document = include_str!("../../../docs/accuracy.md");
    let lines = document.lines().filter(|line| line.starts_with("| image |") || line.starts_with("| session |"));
    let found = score.markdown();
    for line in lines.clone() {
        assert!(found.contains(line), "docs/accuracy.md has, and the bench does not give: {line}");
    }
    assert!(lines.count() > 50);
}

#[test]
fn the_same_options_give_the_same_sizes() {
    let options = Options { sessions: 3, images: 2, ..Options::default() };
    assert_eq!(run(&options), run(&options));
    assert_ne!(run(&options), run(&Options { seed: 2, ..options }));
}

/// Without errors of devices and raters the exact methods are exact, apart from the rounding of the range to millimetres.
#[test]
fn without_errors_sizes_are_right() {
    let trials = run(&Options { sessions: 30, images: 2, sigma: InputSigma::NONE, seed: 5 });
    let mut seen = 0;
    for trial in &trials {
        let upright = matches!(trial.subject, Subject::Box | Subject::UprightBowl);
        let plate = matches!(trial.subject, Subject::RoundPlate | Subject::SquarePlate);
        let exact = match trial.method {
            Method::Coaxial => true,
            Method::Ray => upright || plate,
            // Two pitches that are near each other magnify that rounding; crates/model/tests/fusion.rs tests the exactness of `joint`.
            Method::Paper | Method::Joint | Method::Best => false,
        };
        if exact {
            seen += 1;
            let error = (trial.predicted_mm / trial.true_mm - 1.0).abs();
            assert!(error < 0.75 / 250.0, "{trial:?}");
        }
    }
    assert!(seen > 300);
}
