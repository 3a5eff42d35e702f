//! Tests of scene files that are refused, with a message that says what is wrong and where.

use super::*;

#[test]
fn wrong_keys_and_values_are_told_on_their_lines() {
    for (part, line, expected) in [
        ("[tabel]\n", 4, "unknown field `tabel`"),
        ("[light]\nlamp_mm = [0, 0, 1000]\nlamps = 3\n", 6, "unknown field `lamps`"),
        ("[[bowls]]\nname = \"b\"\ndiameter_mm = 120\nheight_mm = 60\nfoot = 3\n", 8, "unknown field `foot`"),
        ("[[bowls]]\nname = \"b\"\ndiameter_mm = 5\nheight_mm = 60\n", 6, "got 5, expected 20 to 1000"),
        ("[[bowls]]\nname = \"b\"\nprofile = \"round\"\n", 6, "expected one of `straight`, `sloped`, `curved`"),
        ("[[bowls]]\nname = \"a/b\"\n", 5, "got 'a/b', expected up to 100 letters"),
        ("[table]\ntexture = { wool = {} }\n", 5, "unknown variant `wool`"),
        ("[table]\ntexture = { cloth = { colour = [1, 1, 1] } }\n", 5, "unknown field `colour`"),
        ("[picture]\nblur_px = nan\n", 5, "got NaN, expected 0 to 50"),
        (
            "[[sessions]]\nname = \"a\"\nposes = [\n  { pitch_deg = 50, height_mm = 400 },\n  { pitch = 50 },\n]\n",
            8,
            "unknown field `pitch`",
        ),
        ("[[glasses]]\nat_mm = [0, 1]\n[[glasses]]\nat_mm = [0, 1]\nfull_pct = 101\n", 8, "got 101, expected 0 to 100"),
        ("jpeg_quality = 101\n", 4, "got 101, expected 1 to 100"),
        ("seed = -1\n", 4, "expected u64"),
    ] {
        let (got_line, message) = refused(&format!("{HEAD}{part}"));
        assert!(got_line == line && message.contains(expected), "{part}: line {got_line}: {message}");
    }
}

#[test]
fn what_contradicts_itself_is_told_on_the_line_of_its_table() {
    for (part, line, expected) in [
        ("[[plates]]\nname = \"p\"\n", 4, "'p': expected diameter_mm (round), width_mm (square), or"),
        (
            "[[plates]]\nname = \"p\"\nwidth_mm = 200\nlength_mm = 150\n",
            4,
            "'p': width_mm = 200, expected 20.0 to 150.0",
        ),
        (
            "[[plates]]\nname = \"p\"\ndiameter_mm = 200\nwell_mm = 210\n",
            4,
            "'p': well_mm = 210, expected 20.0 to 200.0",
        ),
        (
            "[[bowls]]\nname = \"b\"\ndiameter_mm = 120\nheight_mm = 60\nprofile = \"straight\"\nfoot_mm = 80\n",
            4,
            "'b': foot_mm = 80, expected 120.0 to 120.0",
        ),
        (
            "[[boxes]]\nname = \"b\"\nwidth_mm = 90\nlength_mm = 150\nheight_mm = 50\n\
             glaze = { printed = { colours = [[1, 1, 1], [0, 0, 0]] } }\n",
            4,
            "'b': glaze printed, expected on round containers only",
        ),
        (
            "[[plates]]\nname = \"p\"\ndiameter_mm = 200\n\n[[plates]]\nname = \"q\"\ndiameter_mm = 200\nheight_mm = 4\n",
            8,
            "'q': height_mm = 4, expected 9.0 to 100.0",
        ),
        ("[[hands]]\ntip_mm = [0, 300, 50]\nelbow_mm = [0, 310, 50]\n", 4, "at least 100 mm apart"),
        ("[light]\nlamp_mm = [0, 0, 50]\n", 4, "lamp_mm is 50 mm above the table, expected at least 100"),
        ("[sensors]\nrange_scale_pct = 1\nrange_scale_sd_pct = 1\n", 4, "expected one, fixed or drawn by lot"),
        ("[[sessions]]\nname = \"a\"\n", 4, "'a': expected one of stand, poses and head"),
        (
            "[[sessions]]\nname = \"a\"\nstand = { pitch_deg = 50, height_mm = 400, over_mm = [0, 0], aim_mm = [0, 0] }\n",
            6,
            "both over_mm and aim_mm",
        ),
        ("[[sessions]]\nname = \"a\"\nhead = { pitch_deg = [60, 50] }\n", 6, "expected the smaller one first"),
        (
            "[[sessions]]\nname = \"a\"\nhead = { pitch_deg = [40, 90] }\n",
            6,
            "with a sway_deg of 0.25, expected 1 to 89",
        ),
        (
            "[table]\ntexture = { printed = { colours = [[1, 1, 1], [0, 0, 0]], rings_mm = [[9, 8]] } }\n",
            5,
            "the inner radius, then the outer one",
        ),
    ] {
        let (got_line, message) = refused(&format!("{HEAD}{part}"));
        assert!(got_line == line && message.contains(expected), "{part}: line {got_line}: {message}");
    }
}

#[test]
fn what_does_not_go_together_is_refused_before_anything_is_written() {
    let plate = |name: &str, x: i32| format!("[[plates]]\nname = \"{name}\"\ndiameter_mm = 200\nat_mm = [{x}, 300]\n");
    let both = plate("p", 0) + &plate("q", 150);
    let one = "one_at_a_time = true\n";
    for (parts, expected) in [
        (format!("{}{SESSION}", plate("p", 0) + &plate("P", 400)), "two containers are called 'P'"),
        (format!("{both}{SESSION}"), "'p' and 'q' stand in one another"),
        (format!("{SESSION}{SESSION}"), "two sessions are called 'a'"),
        (format!("{both}{SESSION}objects = [\"p\", \"r\"]\n"), "no container is called 'r'; there are: p, q"),
        ("sessions = []\n".to_owned(), "no [[sessions]]"),
        (
            SESSION.replace("440 }", "440, images = 200 }\nperiod_s = 600"),
            "session 'a': 200 images, 600 s apart, expected at most a day of them",
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("study");
        let error = scene(&parts).write(&out, &camera(), 1, b"", &|_, _| {}).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
        assert!(!out.exists());
    }
    assert!(scene(&format!("{both}{SESSION}{one}")).check().is_ok());
    assert!(scene(&format!("{both}{SESSION}objects = [\"q\"]\n")).check().is_ok());
    assert!(read(&format!("{HEAD}{SESSION}").replace("= 1", "= 2")).unwrap().check().is_err());
}

#[test]
fn a_camera_s_keys_are_told_on_their_lines_too() {
    let text =
        "schema_version = 1\nname = \"s\"\nsessions = []\n[camera]\nschema_version = 1\nname = \"c\"\nwidth = 96\n";
    let (line, message) = refused(text);
    assert!(line == 7 && message.contains("unknown field `width`"), "line {line}: {message}");
}
