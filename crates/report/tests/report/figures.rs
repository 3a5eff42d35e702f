//! Tests of figures: which data are drawn, which figures are left out, and how names are escaped.

use model::results::{FrameRow, ResultRow};
use model::{FrameReason, Level, Method, UtcNs};
use proptest::prelude::*;
use report::{Figure, Figures, Results, figures, write_figures};

use crate::bench;
use crate::drawn::Drawn;

pub const HOSTILE: [&str; 8] = [
    "<script>alert(1)</script>",
    "a & b \"c\" 'd' ]]> &amp; &#0;",
    r"_%$#{}~^\ $x^2$",
    "two\nlines\r\0\u{1b}[2J\u{ffff}",
    "\u{202e}\u{5d0}\u{5d1}\u{5d2} \u{627}\u{644}",
    "",
    " ",
    "\u{8336}\u{7897}-\u{1f35c}",
];

/// An image at this time in seconds.
fn frame(session: &str, time_s: i64, pitch_deg: Option<f64>, reason: FrameReason) -> FrameRow {
    FrameRow {
        time_utc: Some(UtcNs((1_700_000_000 + time_s) * 1_000_000_000)),
        pitch_deg,
        range_mm: pitch_deg.map(|pitch| 8.0 * pitch),
        ..FrameRow::without_numbers("by hand", session, "a.jpg", reason)
    }
}

fn frames(session: &str, many: i64) -> Vec<FrameRow> {
    let reason = |i| match i % 3 {
        0 => FrameReason::Selected,
        1 => FrameReason::PitchOutsideTarget,
        _ => FrameReason::NoAcceleration,
    };
    let pitch = |i: i64| (i % 3 != 2).then(|| 40.0 + f64::from(u8::try_from(i * 7 % 31).unwrap()));
    (0..many).map(|i| frame(session, 10 * i, pitch(i), reason(i))).collect()
}

/// Single images and fused sizes with uncertainties.
fn with_sigma() -> Results {
    let mut results = bench::paper_plates();
    results.metadata.settings =
        serde_json::json!({ "study": { "select": { "target_pitch_deg": 55.0, "pitch_tolerance_deg": 7.5 } } });
    for row in &mut results.rows {
        row.sigma_mm = Some(6.0);
        row.selected = row.pitch_deg.is_some_and(|pitch| (47.5..=62.5).contains(&pitch));
    }
    let fused: Vec<ResultRow> = results.rows.iter().filter(|row| row.selected).cloned().collect();
    results.rows.extend(fused.into_iter().map(|row| ResultRow { level: Level::Fused, image: None, ..row }));
    results
}

fn named<'a>(figures: &'a Figures, name: &str) -> &'a Figure {
    figures.drawn.iter().find(|figure| figure.name == name).unwrap_or_else(|| panic!("no {name}"))
}

/// Checks all that must hold for any figure, and returns its content.
fn check(figure: &Figure) -> Drawn {
    let drawn = Drawn::parse(&figure.svg);
    let name = &figure.name;
    assert!(drawn.ids.iter().all(|id| id.starts_with(&format!("{name}-"))) && drawn.ids.len() == 2, "{:?}", drawn.ids);
    let known = ["svg", "title", "desc", "g", "path", "text"];
    assert!(drawn.elements.iter().all(|element| known.contains(&element.as_str())), "{:?}", drawn.elements);
    let [width, height] = drawn.view_box;
    let inside = |[x, y]: [f64; 2]| (0.0..=width).contains(&x) && (0.0..=height).contains(&y);
    for (class, part) in &drawn.parts {
        assert!(part.iter().all(|point| inside(*point)), "{name}: {class} at {part:?} is not in {:?}", drawn.view_box);
    }
    assert!(drawn.texts.iter().all(|(place, _)| inside(*place)), "{name}: {:?}", drawn.texts);
    for text in drawn.texts.iter().map(|(_, text)| text).chain(&drawn.titles) {
        assert!(!text.contains(['\n', '\r', '\0', '\u{1b}', '\u{202e}', '\u{ffff}']), "{name}: {text:?}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{name}: {text:?}");
    }
    assert_eq!(drawn.titles[..2], [figure.title.clone(), figure.alt.clone()]);
    assert!(!figure.caption.is_empty() && figure.svg.len() < 300_000, "{name} has {} bytes", figure.svg.len());
    drawn
}

#[test]
fn every_figure_is_well_formed_in_its_box_and_the_same_each_time() {
    let all = || figures(&with_sigma(), &frames("a", 60)).unwrap();
    let drawn = all();
    assert!(drawn.left_out.is_empty(), "{:?}", drawn.left_out);
    assert_eq!(drawn.drawn.len(), 9);
    drawn.drawn.iter().for_each(|figure| drop(check(figure)));
    assert_eq!(drawn, all());
}

#[test]
fn axes_have_units() {
    let drawn = figures(&with_sigma(), &frames("a", 60)).unwrap();
    for (name, words) in [
        ("error_by_pitch", ["error (%)", "pitch (deg)"]),
        ("error_by_height", ["error (%)", "height of the camera (cm)"]),
        ("bland_altman", ["predicted \u{2212} true (mm)", "true size (mm)"]),
        ("coverage", ["errors within k sigma (%)", "k, in predicted standard uncertainties"]),
        ("calibration", ["absolute error (mm)", "predicted standard uncertainty (mm)"]),
        ("pitch_and_range", ["pitch (deg)", "range (cm)"]),
        ("selected_share", ["images selected (% of the session's)", "20 of 60"]),
        ("sizes", ["size (mm)", "95 % interval"]),
        ("flow", ["found", "60 (100 %)"]),
    ] {
        let texts = Drawn::parse(&named(&drawn, name).svg).texts;
        for word in words {
            assert!(texts.iter().any(|(_, text)| text == word), "{name} does not say '{word}': {texts:?}");
        }
    }
}

#[test]
fn every_row_has_a_mark() {
    let results = with_sigma();
    let single = results.rows.iter().filter(|row| row.level == Level::Frame).count();
    let fused = results.rows.len() - single;
    assert!(single == 45 && fused > 10, "{single} {fused}");
    let all = figures(&results, &frames("a", 60)).unwrap();
    for (name, marks) in [
        ("error_by_pitch", single),
        ("error_by_height", single),
        ("bland_altman", fused),
        ("calibration", single + fused),
        ("sizes", fused),
        // Forty images have pitch and range; of the others, a cross of two strokes (one M) stands in both panels.
        ("pitch_and_range", 2 * 60),
    ] {
        assert_eq!(Drawn::parse(&named(&all, name).svg).marks(), marks, "{name}");
    }
}

/// The numbers are computed by hand: errors of -5, 5 and 5 % (-9, 9 and 10 mm), with a claimed uncertainty of 6 mm.
#[test]
fn numbers_in_the_words_are_those_of_the_tables() {
    let mut results = bench::plates();
    for row in &mut results.rows {
        row.sigma_mm = Some(9.5);
    }
    let all = figures(&results, &[]).unwrap();
    assert!(named(&all, "error_by_pitch").alt.contains("method paper: plate, across +1.7 %"));
    let agreement = &named(&all, "bland_altman").alt;
    // Mean 10 / 3, SD of (-9, 9, 10) 10.69.
    assert!(agreement.contains("plate, across +3.3 mm (\u{2212}17.6 to 24.3)"), "{agreement}");
    let coverage = &named(&all, "coverage").alt;
    assert!(coverage.contains("paper, single images: 67 and 100 %"), "{coverage}");
}

#[test]
fn without_data_figures_are_left_out_with_a_reason() {
    let nothing = figures(&bench::results(Vec::new(), Vec::new()), &[]).unwrap();
    assert!(nothing.drawn.is_empty());
    assert_eq!(nothing.left_out.len(), 9);
    assert!(nothing.left_out.iter().all(|left_out| !left_out.reason.is_empty()));

    let mut untrue = with_sigma();
    untrue.rows.iter_mut().for_each(|row| row.truth_mm = None);
    let all = figures(&untrue, &frames("a", 1)).unwrap();
    let names: Vec<&str> = all.drawn.iter().map(|figure| figure.name.as_str()).collect();
    assert_eq!(names, ["flow", "pitch_and_range", "selected_share", "sizes"]);
    assert!(all.left_out.iter().all(|left_out| left_out.reason.contains("no size has a true size")));
    all.drawn.iter().for_each(|figure| drop(check(figure)));

    let mut one = with_sigma();
    one.rows.truncate(1);
    figures(&one, &frames("a", 1)).unwrap().drawn.iter().for_each(|figure| drop(check(figure)));
}

#[test]
fn names_mean_nothing_to_a_page() {
    let long = "long name ".repeat(400);
    let names: Vec<&str> = HOSTILE.iter().copied().chain([long.as_str()]).collect();
    let mut results = with_sigma();
    for (row, name) in results.rows.iter_mut().zip(names.iter().cycle()) {
        for field in [&mut row.object, &mut row.session, &mut row.rater] {
            *field = (*name).to_owned();
        }
        row.image = row.image.as_ref().map(|_| (*name).to_owned());
    }
    let all_frames: Vec<FrameRow> = names.iter().flat_map(|name| frames(name, 6)).collect();
    let all = figures(&results, &all_frames).unwrap();
    assert_eq!(all.drawn.len(), 9);
    for figure in &all.drawn {
        let drawn = check(figure);
        // Escaped names come back unchanged.
        if figure.name == "selected_share" {
            let has = |name: &str| drawn.texts.iter().any(|(_, text)| text == name);
            assert!(has(HOSTILE[0]) && has(HOSTILE[2]) && has(HOSTILE[7]) && has("(no name)"), "{:?}", drawn.texts);
        }
    }
}

#[test]
fn large_studies_give_small_figures() {
    let mut results = with_sigma();
    let few = results.rows.clone();
    let row = |i: u32| {
        let row = &few[i as usize % few.len()];
        let error = f64::from(i % 997) * 0.05 - 25.0;
        let predicted_mm = row.truth_mm.map(|truth| truth + error);
        let pitch_deg = row.pitch_deg.map(|pitch| pitch + f64::from(i % 61) * 0.1);
        ResultRow { predicted_mm, pitch_deg, session: format!("session-{:03}", i % 200), ..row.clone() }
    };
    results.rows = (0..10_000).map(row).collect();
    let all_frames: Vec<FrameRow> = (0..20).flat_map(|i| frames(&format!("session-{i:03}"), 2500)).collect();
    let all = figures(&results, &all_frames).unwrap();
    all.drawn.iter().for_each(|figure| drop(check(figure)));
    assert!(named(&all, "error_by_pitch").caption.contains(" marks, "), "says that marks are left out");
    assert!(named(&all, "pitch_and_range").caption.starts_with("The first 12 of 20 sessions"));
    let many: Vec<FrameRow> = (0..300).flat_map(|i| frames(&format!("session-{i:03}"), 3)).collect();
    assert!(named(&figures(&results, &many).unwrap(), "selected_share").caption.contains("in classes of 5 %"));
}

#[test]
fn an_outlier_stands_at_the_edge_and_is_told() {
    let mut results = with_sigma();
    results.rows[0].predicted_mm = Some(1e7);
    let all = figures(&results, &[]).unwrap();
    let figure = named(&all, "error_by_pitch");
    assert!(figure.caption.contains("1 error beyond a scale"), "{}", figure.caption);
    assert_eq!(check(figure).marks(), 45);
}

#[test]
fn files_stand_alone_and_old_ones_go() {
    let dir = tempfile::tempdir().unwrap();
    write_figures(&figures(&with_sigma(), &frames("a", 9)).unwrap(), dir.path()).unwrap();
    let folder = dir.path().join("figures");
    let text = std::fs::read_to_string(folder.join("error_by_pitch.svg")).unwrap();
    let parsed = Drawn::parse(&text);
    assert!(text.starts_with("<svg xmlns=") && text.contains("fill=\"#ffffff\"") && text.contains("color=\"#1a1a1a\""));
    assert!(!text.contains("href") && !text.contains("url("));
    assert_eq!(parsed.marks(), 45);
    let captions = std::fs::read_to_string(folder.join("figures.md")).unwrap();
    assert!(captions.contains("](error_by_pitch.svg)") && captions.contains("proves arithmetic only"));

    write_figures(&figures(&bench::results(Vec::new(), Vec::new()), &[]).unwrap(), dir.path()).unwrap();
    let left: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["figures.md"]);
    assert!(std::fs::read_to_string(folder.join("figures.md")).unwrap().contains("## Not drawn"));
}

#[test]
fn drawn() {
    insta::assert_snapshot!("figure_flow", named(&figures(&bench::plates(), &frames("a", 9)).unwrap(), "flow").svg);
}

fn number() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![
        4 => (0.0..400.0).prop_map(Some),
        1 => any::<f64>().prop_map(Some),
        1 => Just(Some(f64::NAN)),
        1 => Just(None),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn no_number_leaves_the_box(
        numbers in prop::collection::vec(prop::array::uniform5(number()), 1..40),
        seconds in prop::collection::vec(-9_000_000_000..9_000_000_000_i64, 1..40),
    ) {
        let mut results = with_sigma();
        let place = |index: usize| results.rows[index % results.rows.len()].clone();
        let rows = numbers.iter().enumerate().map(|(index, [pitch_deg, range_mm, predicted_mm, truth_mm, sigma_mm])| {
            let method = Method::ALL[index % Method::ALL.len()];
            let level = Level::ALL[index % 2];
            ResultRow {
                pitch_deg: *pitch_deg, range_mm: *range_mm, predicted_mm: *predicted_mm, truth_mm: *truth_mm,
                sigma_mm: *sigma_mm, method, level, setup_height_mm: None, ..place(index)
            }
        }).collect();
        results.rows = rows;
        let all_frames: Vec<FrameRow> = seconds.iter().zip(numbers.iter().cycle()).map(|(seconds, numbers)| FrameRow {
            time_utc: Some(UtcNs(seconds * 1_000_000_000)),
            pitch_deg: numbers[0],
            range_mm: numbers[1],
            ..FrameRow::without_numbers("by hand", "a", "a.jpg", FrameReason::Selected)
        }).collect();
        figures(&results, &all_frames).unwrap().drawn.iter().for_each(|figure| drop(check(figure)));
    }
}
