#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use super::*;

fn place_of(cards: &[(&str, &[&str])], name: &str) -> Result<String, String> {
    let dirs: Vec<SessionDir> = cards.iter().map(|(session, _)| SessionDir::new(session)).collect();
    let mut pictures = Pictures::default();
    for (dir, (_, files)) in dirs.iter().zip(cards) {
        files.iter().for_each(|file| pictures.add((*file).to_owned()));
        pictures.sessions.push(MarkedSession { dir, prepared: Err("broken".to_owned()) });
    }
    pictures.find(name).map(|(picture, change)| match change {
        None => pictures.place(picture),
        Some(change) => format!("{} {change:?}", pictures.place(picture)),
    })
}

#[test]
fn a_name_with_or_without_folders() {
    let cards: &[(&str, &[&str])] = &[("S1", &["images/a.jpg", "images/b.jpg"]), ("S2", &["images/a.jpg"])];
    for (name, expected) in [
        ("b.jpg", "S1/images/b.jpg"),
        ("b.png", "S1/images/b.jpg"),
        ("S1/b", "S1/images/b.jpg"),
        ("S2/a.jpg", "S2/images/a.jpg"),
        (r"study\cards\S1\images\a.jpg", "S1/images/a.jpg"),
        ("./images/b.jpg", "S1/images/b.jpg"),
        ("other/b.jpg", "S1/images/b.jpg Folders"),
    ] {
        assert_eq!(place_of(cards, name).as_deref(), Ok(expected), "{name}");
    }
}

#[test]
fn a_name_in_either_unicode_form() {
    let cards: &[(&str, &[&str])] = &[("m\u{fc}ller", &["I/k\u{e4}se.jpg"]), ("S2", &["I/k\u{e4}se.jpg"])];
    let found = place_of(cards, "mu\u{308}ller/ka\u{308}se.jpg");
    assert_eq!(found.as_deref(), Ok("m\u{fc}ller/I/k\u{e4}se.jpg"));
}

#[test]
fn a_name_that_a_tool_changed() {
    let cards: &[(&str, &[&str])] = &[
        ("S1", &["IMAGES/20210301T154030.250Z.JPG", "IMAGES/a (1).JPG", "IMAGES/b.JPG"]),
        ("S2", &["IMAGES/b.JPG", "IMAGES/c.JPG", "IMAGES/0a1b2c3d-c.JPG"]),
    ];
    for (name, expected) in [
        ("1a2b3c4d-20210301T154030.250Z.JPG", "S1/IMAGES/20210301T154030.250Z.JPG LabelStudio"),
        ("images/1a2b3c4d-a_1.JPG", "S1/IMAGES/a (1).JPG LabelStudio"),
        (
            "20210301T154030-250Z_JPG.rf.0123456789abcdef0123456789abcdef.jpg",
            "S1/IMAGES/20210301T154030.250Z.JPG Roboflow",
        ),
        ("S2/b_JPG.rf.0123456789abcdef.jpg", "S2/IMAGES/b.JPG Roboflow"),
        ("S1/1a2b3c4d-b.JPG", "S1/IMAGES/b.JPG LabelStudio"),
        ("a%20%281%29.JPG", "S1/IMAGES/a (1).JPG Percent"),
        ("cards%2FS2%2FIMAGES%2Fb.JPG", "S2/IMAGES/b.JPG Percent"),
        ("S2_IMAGES_b.JPG", "S2/IMAGES/b.JPG Characters"),
        ("job_7/a (1).JPG", "S1/IMAGES/a (1).JPG Folders"),
    ] {
        assert_eq!(place_of(cards, name).as_deref(), Ok(expected), "{name}");
    }
    for (name, expected) in [
        ("1a2b3c4d-b.JPG", "any of: S1/IMAGES/b.JPG, S2/IMAGES/b.JPG"),
        ("b_JPG.rf.0123456789abcdef.jpg", "any of: S1/IMAGES/b.JPG, S2/IMAGES/b.JPG"),
        ("IMAGES-b.jpg", "any of: S1/IMAGES/b.JPG, S2/IMAGES/b.JPG"),
        ("0a1b2c3d-c.JPG", "any of: S2/IMAGES/0a1b2c3d-c.JPG, S2/IMAGES/c.JPG"),
        ("1a2b3c4d-d.JPG", "no card has an image of this name"),
        ("a 1x.JPG", "no card has an image of this name"),
    ] {
        let fact = place_of(cards, name).unwrap_err();
        assert!(fact.contains(expected), "{name}: {fact}");
    }
}

#[test]
fn what_is_not_clear_is_not_guessed() {
    let cards: &[(&str, &[&str])] =
        &[("S1", &["images/a.jpg", "c.jpg", "c.png"]), ("S2", &["images/a.jpg", "b.jpg"]), ("S3", &[])];
    for (name, expected) in [
        ("a.jpg", "S1/images/a.jpg, S2/images/a.jpg"),
        ("images/a.jpg", "may be any of"),
        ("S1/S2/a.jpg", "may be any of"),
        ("S3/b.jpg", "session 'S3' cannot be used: broken"),
        ("d.jpg", "no card has an image of this name (5 images of 3 sessions, the first is S1/c.jpg)"),
        ("S1/c.jpg", "several images of one session"),
        ("", "no card has an image"),
    ] {
        let fact = place_of(cards, name).unwrap_err();
        assert!(fact.contains(expected), "{name}: {fact}");
    }
}

#[test]
fn the_folder_that_agrees_best_decides() {
    let cards: &[(&str, &[&str])] = &[("S1", &["left/a.jpg"]), ("S2", &["right/a.jpg"])];
    assert_eq!(place_of(cards, "right/a.jpg").as_deref(), Ok("S2/right/a.jpg"));
}
