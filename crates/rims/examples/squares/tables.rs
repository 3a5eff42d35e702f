//! The rectangles that were found, as tables.

use aim_batch_rims::SQUARE_FEATURES;

/// A rectangle is found from this confidence on.
pub const LEAST_CONFIDENCE: f64 = 0.5;
/// The selection's window of pitch.
const WINDOW_DEG: (f64, f64) = (47.5, 62.5);

/// Errors of one size.
#[derive(Clone, Copy)]
pub struct SizeError {
    /// As a share, with the level of the rim given.
    pub given: f64,
    /// The same with nothing given.
    pub alone: f64,
    /// That in standard uncertainties.
    pub sigmas: f64,
}

/// A rectangular plate that lies in a picture as a whole, and what was found of it: width, length.
pub struct Case {
    pub pitch_deg: f64,
    pub errors: Option<[SizeError; 2]>,
}

/// A rectangle found.
pub struct Judged {
    pub confidence: f64,
    pub features: [f64; SQUARE_FEATURES],
    pub is_right: bool,
}

/// The rectangles that were found in one picture.
pub struct Report {
    pub name: String,
    pub cases: Vec<Case>,
    pub rims: Vec<Judged>,
    /// No plate and no box that is square or rectangular.
    pub is_bare: bool,
}

impl Judged {
    pub fn csv(&self, picture: &str) -> String {
        let features: Vec<String> = self.features.iter().map(|feature| format!("{feature:.5}")).collect();
        format!("{picture},{:.5},{},{}\n", self.confidence, u8::from(self.is_right), features.join(","))
    }
}

/// Found and missed, errors, false rectangles.
pub fn summary(set: &str, reports: &[Report]) -> String {
    let cases: Vec<&Case> = reports.iter().flat_map(|report| &report.cases).collect();
    let in_window = |case: &&&Case| (WINDOW_DEG.0..WINDOW_DEG.1).contains(&case.pitch_deg);
    let found = |cases: &mut dyn Iterator<Item = &&Case>| cases.filter(|case| case.errors.is_some()).count();
    let mut text = format!(
        "{set}: {} pictures; rectangular plates found {} of {}, with the pitch in the window {} of {}\n",
        reports.len(),
        found(&mut cases.iter()),
        cases.len(),
        found(&mut cases.iter().filter(in_window)),
        cases.iter().filter(in_window).count(),
    );
    let errors: Vec<SizeError> = cases.iter().filter_map(|case| case.errors).flatten().collect();
    if !errors.is_empty() {
        let within = |sigmas: f64| errors.iter().filter(|error| error.sigmas.abs() <= sigmas).count();
        text += &format!(
            "  sides, median / q95 of absolute errors: {} (level given), {} (nothing given); {} and {} of {} within one and two \
             standard uncertainties\n",
            quantiles(errors.iter().map(|error| error.given.abs()).collect()),
            quantiles(errors.iter().map(|error| error.alone.abs()).collect()),
            within(1.0),
            within(2.0),
            errors.len(),
        );
    }
    let is_false = |rim: &Judged| rim.confidence >= LEAST_CONFIDENCE && !rim.is_right;
    let false_in = |bare: bool| {
        let of_kind = || reports.iter().filter(move |report| report.is_bare == bare);
        (of_kind().filter(|report| report.rims.iter().any(is_false)).count(), of_kind().count())
    };
    let ((bare, bares), (other, others)) = (false_in(true), false_in(false));
    text + &format!(
        "  false rectangles in {bare} of {bares} pictures without anything rectangular to eat from, in {other} of {others} with\n"
    )
}

fn quantiles(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "an index"
    )]
    let at = |p: f64| 100.0 * values[(p * (values.len() - 1) as f64).round() as usize];
    format!("{:.2} / {:.2} %", at(0.5), at(0.95))
}

/// Of the rectangles in each band of confidence, how many are right, and how many should be.
pub fn reliability<'a>(rims: impl Iterator<Item = &'a Judged>) -> String {
    let rims: Vec<&Judged> = rims.collect();
    let bands = [0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.01];
    let rows = bands.windows(2).map(|band| {
        let inside: Vec<&&Judged> = rims.iter().filter(|rim| (band[0]..band[1]).contains(&rim.confidence)).collect();
        let right = inside.iter().filter(|rim| rim.is_right).count();
        let expected: f64 = inside.iter().map(|rim| rim.confidence).sum();
        let (from, to) = (band[0], band[1].min(1.0));
        format!("  {from:.2} to {to:.2}: {right} of {} right, {expected:.1} expected\n", inside.len())
    });
    std::iter::once("confidence\n".to_owned()).chain(rows).collect()
}
