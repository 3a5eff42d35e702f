//! The rims that were found, as tables.

use model::Kind;

use crate::{Case, Found, Judged, LEAST_CONFIDENCE, Report};

/// The selection's window of pitch.
const WINDOW_DEG: (f64, f64) = (47.5, 62.5);

/// Which cases a line of a table counts.
type Keep = fn(&Case) -> bool;

/// Found and missed, errors, false rims.
pub fn summary(name: &str, reports: &[Report]) -> String {
    let cases: Vec<&Case> = reports.iter().flat_map(|report| &report.cases).filter(|case| case.in_view).collect();
    let mut text = format!("{name}: {} pictures, {} round containers in view\n", reports.len(), cases.len());
    let rows: [(&str, Keep); 5] = [
        ("all", |_| true),
        ("pitch in the window", |c| (WINDOW_DEG.0..WINDOW_DEG.1).contains(&c.pitch_deg)),
        ("at 55 degrees (50 to 60)", |c| (50.0..60.0).contains(&c.pitch_deg)),
        ("plates", |c| c.kind == Kind::Plate),
        ("bowls", |c| c.kind == Kind::Bowl),
    ];
    for (label, keep) in rows {
        let kept: Vec<&&Case> = cases.iter().filter(|case| keep(case)).collect();
        text += &line(label, &kept);
    }
    let mut objects: Vec<&str> = cases.iter().map(|case| &*case.object).collect();
    objects.sort_unstable();
    objects.dedup();
    for object in objects {
        text += &line(object, &cases.iter().filter(|case| *case.object == *object).collect::<Vec<_>>());
    }
    let bowls = |shows: bool| -> Vec<&Case> {
        cases.iter().copied().filter(|case| case.kind == Kind::Bowl && case.shows_foot == shows).collect()
    };
    text += &heights("bowls whose foot shows", &bowls(true));
    text += &heights("bowls whose foot is hidden", &bowls(false));
    text += &heights("plates", &cases.iter().copied().filter(|case| case.kind == Kind::Plate).collect::<Vec<_>>());
    let is_false = |rim: &Judged| rim.confidence >= LEAST_CONFIDENCE && !rim.is_right && !rim.is_cup;
    let false_in = |report: &&Report| report.rims.iter().any(is_false);
    let bare: Vec<&Report> = reports.iter().filter(|report| report.is_bare).collect();
    text += &format!(
        "  false rims of 90 mm and more: in {} of {} pictures without a container, in {} of {} with; drinking glasses found {}, \
         kept by a run {}\n",
        bare.iter().filter(|r| false_in(r)).count(),
        bare.len(),
        reports.iter().filter(|r| !r.is_bare).filter(false_in).count(),
        reports.len() - bare.len(),
        reports.iter().map(|r| r.glasses[0]).sum::<usize>(),
        reports.iter().map(|r| r.glasses[1]).sum::<usize>(),
    );
    text
}

fn line(label: &str, cases: &[&&Case]) -> String {
    let found: Vec<Found> = cases.iter().filter_map(|case| case.found).collect();
    let quantiles = |values: Vec<f64>| match (quantile(&values, 0.5), quantile(&values, 0.95)) {
        (Some(median), Some(q95)) => format!("{:.2} / {:.2} %", 100.0 * median, 100.0 * q95),
        _ => "-".to_owned(),
    };
    let of = |size: &dyn Fn(&Found) -> f64| quantiles(found.iter().map(|f| size(f).abs()).collect());
    let diameters: Vec<f64> = found.iter().map(|f| f.diameter).collect();
    let signed = quantile(&diameters, 0.5).map_or_else(|| "-".to_owned(), |median| format!("{:+.2} %", 100.0 * median));
    let heights = found.iter().filter(|f| f.is_height_seen).map(|f| f.height.abs()).collect();
    format!(
        "  {label:26} found {:3} of {:3}  |diameter| median / q95: {} (level given; signed median {}), {} (nothing given)  |rim height|: {}\n",
        found.len(),
        cases.len(),
        of(&|f| f.diameter),
        signed,
        of(&|f| f.diameter_alone),
        quantiles(heights),
    )
}

/// Heights of rims, whatever they come from, and whether their uncertainties are honest.
fn heights(label: &str, cases: &[&Case]) -> String {
    let found: Vec<Found> = cases.iter().filter_map(|case| case.found).collect();
    let errors: Vec<f64> = found.iter().map(|f| f.height.abs()).collect();
    let (Some(median), Some(q95)) = (quantile(&errors, 0.5), quantile(&errors, 0.95)) else { return String::new() };
    let within = |sigmas: f64| found.iter().filter(|f| f.height_sigmas.abs() <= sigmas).count();
    format!(
        "  rim height of {label}: {} found, median / q95 {:.1} / {:.1} %; {} within one standard uncertainty, {} within two\n",
        found.len(),
        100.0 * median,
        100.0 * q95,
        within(1.0),
        within(2.0),
    )
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "an index")]
fn quantile(values: &[f64], p: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get((p * (sorted.len().checked_sub(1)?) as f64).round() as usize).copied()
}

/// Of the rims in each band of confidence, how many are right, and how many should be.
pub fn reliability(rims: &[Judged]) -> String {
    let bands = [0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 1.01];
    let rows = bands.windows(2).map(|band| {
        let inside: Vec<&Judged> = rims.iter().filter(|rim| (band[0]..band[1]).contains(&rim.confidence)).collect();
        let right = inside.iter().filter(|rim| rim.is_right).count();
        let expected: f64 = inside.iter().map(|rim| rim.confidence).sum();
        format!(
            "  {:.2} to {:.2}: {right} of {} right, {expected:.1} expected\n",
            band[0],
            band[1].min(1.0),
            inside.len()
        )
    });
    std::iter::once("confidence\n".to_owned()).chain(rows).collect()
}
