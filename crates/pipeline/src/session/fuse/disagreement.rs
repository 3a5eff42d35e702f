//! Problems of fused sizes whose shares do not agree.

use std::collections::BTreeMap;

use model::{Level, Method, Problem, ProblemCode, Quantity, ResultRow, Severity, Stage, Verdict};

/// A note for each object, rater and quantity whose fused sizes are inconsistent, which names what is off. Where the study asks
/// for the best method, the size by that one decides.
pub(in crate::session) fn problems(session: &str, fused: &[ResultRow]) -> Vec<Problem> {
    let mut by_size: BTreeMap<(&str, &str, Quantity), &ResultRow> = BTreeMap::new();
    let has_best = fused.iter().any(|row| row.method == Method::Best);
    for row in fused {
        let counts = !has_best || row.method == Method::Best;
        if counts && row.consistency == Some(Verdict::Inconsistent) {
            by_size.entry((&row.object, &row.rater, row.quantity)).or_insert(row);
        }
    }
    by_size.into_values().filter_map(|row| problem(session, row)).collect()
}

fn problem(session: &str, row: &ResultRow) -> Option<Problem> {
    let ResultRow { object, rater, quantity, method, .. } = row;
    let (things, by) = match row.level {
        Level::Consensus => ("raters", "all raters".to_owned()),
        _ => ("images", rater.clone()),
    };
    let off: Vec<&str> =
        row.flags.split(',').filter_map(|flag| Some(flag.strip_prefix("outlier")?.split_once(':')?.1)).collect();
    let off = if off.is_empty() { "none alone is off".to_owned() } else { format!("off: {}", off.join(", ")) };
    Some(Problem {
        severity: Severity::Note,
        stage: Stage::Measure,
        code: ProblemCode::SizesDisagree,
        place: format!("cards/{session}"),
        fact: format!(
            "{quantity} of '{object}' by {by}, method {method}: {:.1} \u{b1} {:.1} mm, but {} {things} have a spread of {:.1} mm \
             (chi-square {:.1} with {} degrees of freedom); {off}",
            row.predicted_mm?,
            row.sigma_mm?,
            row.chi_squared_degrees? + 1,
            row.spread_mm?,
            row.chi_squared?,
            row.chi_squared_degrees?
        ),
        remedy: ProblemCode::SizesDisagree.remedy().to_owned(),
    })
}
