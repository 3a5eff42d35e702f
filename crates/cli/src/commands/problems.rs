//! Problems for people: those of one kind together.

use std::fmt::Write as _;

use model::Problem;

/// Problems with one stage and code, each with what stands before it; never empty.
pub type Kind<'a> = Vec<(String, &'a Problem)>;

/// Problems of one kind together, in the order of the first of each.
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

/// Appends the first problem of a kind and how many more there are, every line after `indent`.
pub fn describe(text: &mut String, indent: &str, kind: &Kind<'_>) {
    let Some((label, problem)) = kind.first() else { return };
    let Problem { stage, code, place, fact, remedy, .. } = problem;
    let _ = writeln!(text, "{indent}{label} [{stage}] {code}: {place}\n{indent}    {fact}");
    if kind.len() > 1 {
        let _ = writeln!(text, "{indent}    and {} more of this kind", kind.len() - 1);
    }
    let _ = writeln!(text, "{indent}    -> {remedy}");
}
