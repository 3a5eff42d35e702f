//! The command `calibrate` learns from a bench with known sizes what a run then reads from calibration.toml.

use std::cell::Cell;

use model::calibrate::empirical::{self, Empirical, Row};
use model::calibrate::physical::{self, BenchSize, Physical};
use model::calibrate::protractor::protractor;
use model::{InputSigma, Kind, LEARNED, Level, Method, Quantity, ResultRow, SessionStatus, Source, Stage};

use crate::calibration::PhysicalEntry;
use crate::calibration::{CalibrationFile, ProtractorEntry, empirical_entry, inputs_with, physical_entry};
use crate::parallel::unless_panicking;
use crate::reporter::Reporter;
use crate::session::{SessionOptions, SessionOutput, failed, run_session};
use crate::signals::RangeCone;
use crate::study::{Study, StudySpec};
use crate::survey::{Survey, SurveyError, SurveyOptions};

/// Changes the settings of a study for its calibration: every method that calibrates or is calibrated, and both readings of
/// the range.
pub fn adjust(spec: &mut StudySpec) {
    spec.measure.methods = vec![Method::Paper, Method::Ray, Method::Coaxial];
    spec.signals.range_cone = RangeCone::TiltedPlane;
}

/// Learns a calibration from a study with true sizes, which must have been loaded with [`adjust`]. Sessions that declare a
/// setup are used; all of them where none does.
///
/// # Errors
/// [`SurveyError`] for what concerns the calibration as a whole. What the data do not determine is in the file's notes.
pub fn calibrate(
    study: &Study,
    options: &SurveyOptions,
    reporter: &dyn Reporter,
) -> Result<(CalibrationFile, Vec<SessionStatus>), SurveyError> {
    let survey = Survey::new(options)?;
    let session_options = SessionOptions { is_bench: true, ..survey.options.clone() };
    let outputs = survey.for_each_session(study, options.jobs, reporter, |dir| {
        let road = || run_session(study, dir, &session_options, reporter);
        let output = unless_panicking(dir, &Cell::new(Stage::Study), road);
        let output = output.unwrap_or_else(|problem| failed(study, dir, problem));
        reporter.done(&output.status);
        output
    })?;
    let declared = outputs.iter().any(|output| output.bench.declared);
    let used: Vec<&SessionOutput> = outputs.iter().filter(|output| output.bench.declared || !declared).collect();
    let mut file = CalibrationFile::empty(&options.program, &study.spec.name);
    add_physical(&mut file, &used, &study.spec.uncertainty.inputs());
    add_empirical(&mut file, &used);
    let angles: Vec<(f64, f64)> = used.iter().flat_map(|output| output.bench.angles_deg.iter().copied()).collect();
    file.protractor = protractor(&angles).map(ProtractorEntry::from);
    if file.protractor.is_none() {
        file.notes.push("no protractor: setup_pitch_deg of session.toml is missing, or the same everywhere".to_owned());
    }
    Ok((file, outputs.into_iter().map(|output| output.status).collect()))
}

fn add_physical(file: &mut CalibrationFile, used: &[&SessionOutput], prior: &InputSigma) {
    let all_sizes = |sizes: fn(&SessionOutput) -> &Vec<BenchSize>| -> Vec<BenchSize> {
        used.iter().flat_map(|output| sizes(output).iter().cloned()).collect()
    };
    let (plain, cone) = (all_sizes(|o| &o.bench.sizes), all_sizes(|o| &o.bench.cone_sizes));
    let fitted = match physical::calibrate(&plain, prior) {
        Ok(fitted) => fitted,
        Err(error) => return file.notes.push(format!("no physical corrections: {error}")),
    };
    let with_cone = physical::calibrate(&cone, prior).ok().filter(|_| cone.len() == plain.len());
    let judged = |fitted: &Physical| fitted.without_setup.after_rmse_pct.unwrap_or(f64::INFINITY);
    let takes_cone = with_cone.as_ref().is_some_and(|with_cone| judged(with_cone) < judged(&fitted));
    if let Some(with_cone) = &with_cone {
        file.notes.push(format!(
            "range cone: {:.2} % RMSE of setups left out with it, {:.2} % without",
            judged(with_cone),
            judged(&fitted)
        ));
    }
    let range_cone = if takes_cone { RangeCone::TiltedPlane } else { RangeCone::Off };
    let taken = with_cone.filter(|_| takes_cone).unwrap_or(fitted);
    file.notes.extend((0..LEARNED.len()).filter(|&i| !taken.determined[i]).map(|i| refusal(&taken, i, prior)));
    let mut entry = physical_entry(&taken, range_cone, prior);
    entry.unexplained_pct = unexplained_pct(&entry, if takes_cone { &cone } else { &plain });
    if entry.unexplained_pct > 0.0 {
        file.notes.push(format!(
            "unexplained: setups left out are off by {:.2} % more than corrected sizes claim; sigma_mm holds it",
            entry.unexplained_pct
        ));
    }
    file.physical = Some(entry);
}

/// The error, in per cent, of setups left out of the fit, beyond what corrected sizes claim.
fn unexplained_pct(entry: &PhysicalEntry, sizes: &[BenchSize]) -> f64 {
    let Some(off_pct) = entry.without_setup.after_rmse_pct else { return 0.0 };
    let correction = entry.correction();
    let claimed = |size: &BenchSize| size.claimed_pct(&correction, &inputs_with(entry, size.inputs));
    let variances: Vec<f64> = sizes.iter().filter_map(claimed).map(|pct| pct * pct).collect();
    #[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
    let mean = variances.iter().sum::<f64>() / variances.len().max(1) as f64;
    (off_pct * off_pct - mean).max(0.0).sqrt()
}

/// The note on a parameter that is not determined, in units for people.
fn refusal(fitted: &Physical, parameter: usize, prior: &InputSigma) -> String {
    let source = LEARNED[parameter];
    let (per, unit) = match source {
        Source::Mount => (1.0_f64.to_radians(), "degrees"),
        Source::RangeOffset => (1.0, "mm"),
        _ => (0.01, "%"),
    };
    let from_data = fitted.sd[parameter].map_or("nothing".to_owned(), |sd| format!("an SD of {:.2} {unit}", sd / per));
    let known = physical::prior_sd(prior, source) / per;
    format!(
        "{source} is not determined: the data tell {from_data}, {known:.2} {unit} is known beforehand; it is left at zero"
    )
}

/// Fits a line to the rows of each sort: kind of container, heights or mouths.
fn add_empirical(file: &mut CalibrationFile, used: &[&SessionOutput]) {
    let rows: Vec<&ResultRow> = used.iter().flat_map(|output| &output.results).collect();
    for kind in Kind::ALL {
        for is_height in [false, true] {
            let fits = |row: &&&ResultRow| {
                row.level == Level::Frame
                    && row.method == Method::Paper
                    && row.kind == *kind
                    && (row.quantity == Quantity::Height) == is_height
            };
            let of_sort: Vec<Row> = rows.iter().filter(fits).filter_map(|row| table_row(row)).collect();
            let what = format!("{kind} {}", if is_height { "heights" } else { "mouths" });
            if of_sort.is_empty() {
                continue;
            }
            match empirical::calibrate(&of_sort) {
                Ok(fitted) => {
                    let mended = mended(&of_sort, &fitted);
                    file.notes.extend(fitted.slips.iter().map(|slip| slip_note(&of_sort[slip.row], slip.factor)));
                    file.empirical.push(empirical_entry(*kind, is_height, &of_sort, &fitted, mended.as_ref()));
                }
                Err(error) => file.notes.push(format!("no line for {what}: {error}")),
            }
        }
    }
}

fn mended(rows: &[Row], fitted: &Empirical) -> Option<Empirical> {
    (!fitted.slips.is_empty()).then(|| empirical::calibrate(&empirical::mended(rows, &fitted.slips)).ok()).flatten()
}

fn slip_note(row: &Row, factor: f64) -> String {
    format!(
        "'{}' in {}: {:.1} mm for {:.1} mm; {:.1} mm would fit its neighbours: a slip of the decimal point is likely",
        row.object,
        row.setup,
        row.predicted_mm,
        row.true_mm,
        row.predicted_mm * factor
    )
}

fn table_row(row: &ResultRow) -> Option<Row> {
    Some(Row {
        object: row.object.clone(),
        setup: row.session.clone(),
        pitch_rad: row.pitch_deg?.to_radians(),
        predicted_mm: row.predicted_mm?,
        true_mm: row.truth_mm?,
    })
}
