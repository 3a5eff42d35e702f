//! Problems as text for people: those of one kind together.

use std::fmt::Write as _;

use model::Problem;

/// Problems with the same stage and code, each with the label that stands before it. It is never empty.
pub type Kind<'a> = Vec<(String, &'a Problem)>;

/// The problems, grouped by kind, in the order of the first one of each kind.
pub fn kinds<'a>(problems: impl Iterator<Item = (String, &'a Problem)>) -> Vec<Kind<'a>> {
    let mut kinds: Vec<Kind<'a>> = Vec::new();
    for (label, problem) in problems {
        match kinds.iter_mut().find(|kind| (kind[0].1.stage, &kind[0].1.code) == (problem.stage, &problem.code)) {
            Some(kind) => kind.push((label, problem)),
            None => kinds.push(vec![(label, problem)]),
        }
    }
    kinds
}

/// Appends the first problem of a kind, and the number of the others. Every line begins with `indent`.
pub fn describe(text: &mut String, indent: &str, kind: &Kind<'_>) {
    let Some((label, problem)) = kind.first() else { return };
    let Problem { stage, code, place, fact, remedy, .. } = problem;
    let _ = writeln!(text, "{indent}{label} [{stage}] {code}: {place}\n{indent}    {fact}");
    if kind.len() > 1 {
        let _ = writeln!(text, "{indent}    and {} more of this kind", kind.len() - 1);
    }
    let _ = writeln!(text, "{indent}    -> {remedy}");
}
