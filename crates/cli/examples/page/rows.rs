//! Made-up rows.

use model::{
    FrameReason, FrameRow, Kind, Level, Method, Problem, Quantity, ResultRow, RunLog, RunMetadata, SessionStatus,
    Severity, Stage, UtcNs,
};

/// The rows of a study, session by session, with the metadata and the times of its run.
pub struct Study {
    pub sessions: Vec<(Vec<ResultRow>, Vec<FrameRow>)>,
    pub metadata: RunMetadata,
    pub log: RunLog,
}

/// The names and numbers that a study is made from.
struct Plan<'a> {
    study: &'a str,
    sessions: Vec<String>,
    objects: &'a [&'a str],
    raters: &'a [&'a str],
    /// Number of images of a session; `marked` of them are marked.
    images: u32,
    marked: u32,
}

/// A small study whose names mean something to HTML, JSON, CSS and file systems.
pub fn small() -> Study {
    study(&Plan {
        study: "<script>alert(1)</script>",
        sessions: [
            "</script><script>alert(2)</script>",
            "\"'><img src=x onerror=alert(3)>",
            "..\u{2028}&amp;",
            "s\u{e9}ance 4",
        ]
        .map(str::to_owned)
        .into(),
        objects: &["<b>bowl</b> & \"cup\"", "plate' onclick='alert(4)", "\u{8336}\u{7897}"],
        raters: &["anna", "<i>ben</i>"],
        images: 20,
        marked: 6,
    })
}

/// A study of 10,000 measurements and 50,000 images.
pub fn large() -> Study {
    study(&Plan {
        study: "large",
        sessions: (1..=200).map(|number| format!("P{number:03}-lunch")).collect(),
        objects: &["plate", "soup bowl"],
        raters: &["anna", "ben"],
        images: 250,
        marked: 12,
    })
}

fn study(plan: &Plan<'_>) -> Study {
    let mut dice = Dice(7);
    let sessions: Vec<_> = plan.sessions.iter().map(|session| rows(plan, session, &mut dice)).collect();
    let status = |(place, name): (usize, &String)| {
        let (results, frames) = &sessions[place];
        status(name, place, results, frames)
    };
    let metadata = RunMetadata {
        program: "aim-batch example".to_owned(),
        commit: None,
        study: plan.study.to_owned(),
        statement: Some("Every number in this report is made up.".to_owned()),
        settings: serde_json::json!({"select": {"target_pitch_deg": 55.0, "pitch_tolerance_deg": 7.5}}),
        tables: Vec::new(),
        sessions: plan.sessions.iter().enumerate().map(status).collect(),
        inputs_sha256: plan
            .sessions
            .iter()
            .map(|name| (format!("cards/{name}"), "0123456789abcdef".repeat(4)))
            .collect(),
    };
    let log = RunLog {
        started_utc: "2026-03-01T20:00:00Z".to_owned(),
        finished_utc: "2026-03-01T20:10:00Z".to_owned(),
        seconds: 600.0,
        jobs: 2,
        ..RunLog::default()
    };
    Study { sessions, metadata, log }
}

fn status(name: &str, place: usize, results: &[ResultRow], frames: &[FrameRow]) -> SessionStatus {
    let problem = |severity: Severity| Problem {
        severity,
        stage: Stage::Ingest,
        code: model::ProblemCode::BadBlocks,
        place: format!("cards/{name}/SENSORS/ACC.BIN"),
        fact: "expected 1022 samples <in> a packet, got 511".to_owned(),
        remedy: "copy the card again & run again".to_owned(),
    };
    let problems = match place % 5 {
        1 => vec![problem(Severity::Loss)],
        2 => vec![problem(Severity::Note)],
        _ => Vec::new(),
    };
    SessionStatus {
        session: name.to_owned(),
        failed: false,
        images: frames.len(),
        with_pose: frames.iter().filter(|frame| frame.reason.has_pose()).count(),
        selected: frames.iter().filter(|frame| frame.reason == FrameReason::Selected).count(),
        sizes: results.iter().filter(|row| row.predicted_mm.is_some()).count(),
        problems,
        card_sketch: Vec::new(),
    }
}

fn rows(plan: &Plan<'_>, session: &str, dice: &mut Dice) -> (Vec<ResultRow>, Vec<FrameRow>) {
    let mut results = Vec::new();
    let mut frames = Vec::new();
    for number in 0..plan.images {
        let image = format!("IMAGES/{number:05}.JPG");
        let time = UtcNs(1_772_000_000_000_000_000 + i64::from(number) * 10_000_000_000);
        let is_marked = number < plan.marked;
        let reason = match number % 5 {
            _ if is_marked => FrameReason::Selected,
            0 | 1 => FrameReason::Moving,
            2 => FrameReason::NoRange,
            _ => FrameReason::PitchOutsideTarget,
        };
        frames.push(FrameRow {
            time_utc: Some(time),
            pitch_deg: Some(30.0 + 40.0 * dice.throw()),
            raters: if is_marked { 2 } else { 0 },
            sizes: u32::from(is_marked),
            ..FrameRow::without_numbers(plan.study, session, &image, reason)
        });
        for (object, rater) in pairs(plan).filter(|_| is_marked) {
            results.push(ResultRow {
                image: Some(image.clone()),
                time_utc: Some(time),
                ..row(plan.study, session, object, rater, Level::Frame, dice)
            });
        }
    }
    results.extend(pairs(plan).map(|(object, rater)| row(plan.study, session, object, rater, Level::Fused, dice)));
    (results, frames)
}

fn pairs<'a>(plan: &Plan<'a>) -> impl Iterator<Item = (&'a str, &'a str)> {
    let (objects, raters) = (plan.objects, plan.raters);
    objects.iter().flat_map(move |object| raters.iter().map(move |rater| (*object, *rater)))
}

fn row(study: &str, session: &str, object: &str, rater: &str, level: Level, dice: &mut Dice) -> ResultRow {
    let truth_mm = 180.0;
    let error_pct = 12.0 * (dice.throw() + dice.throw() + dice.throw() - 1.5);
    let predicted_mm = truth_mm * (1.0 + error_pct / 100.0);
    ResultRow {
        study: study.to_owned(),
        session: session.to_owned(),
        participant: Some(session.chars().take(4).collect()),
        rater: rater.to_owned(),
        pitch_deg: Some(48.0 + 14.0 * dice.throw()),
        roll_deg: Some(4.0 * dice.throw() - 2.0),
        range_mm: Some(480.0 + 200.0 * dice.throw()),
        level,
        predicted_mm: Some(predicted_mm),
        sigma_mm: Some(4.0 + 6.0 * dice.throw()),
        sigma_pitch_mm: Some(2.0),
        sigma_roll_mm: Some(0.5),
        sigma_range_mm: Some(3.0),
        sigma_marks_mm: Some(1.0),
        sigma_camera_mm: Some(1.0),
        plane_z_mm: Some(0.0),
        truth_mm: Some(truth_mm),
        error_pct: Some(error_pct),
        frames: if level == Level::Frame { 1 } else { 6 },
        spread_mm: (level == Level::Fused).then_some(5.0),
        flags: if dice.throw() < 0.1 { "range_step".to_owned() } else { String::new() },
        method_used: Some(Method::Ray),
        ..ResultRow::without_numbers(object, Kind::Plate, Quantity::Diameter, Method::Ray)
    }
}

/// Numbers in [0, 1) that look random and are the same each time (splitmix64, Steele et al. 2014).
struct Dice(u64);

impl Dice {
    #[expect(clippy::cast_precision_loss, reason = "53 bits are kept")]
    fn throw(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
