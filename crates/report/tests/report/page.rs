//! Tests of the page that need no browser.

use std::path::Path;

use model::{Feature, GalleryMark, GalleryPicture, GallerySink as _, PictureView, RunLog};
use report::{Figure, Figures, Page, Pictures, Results, write_report};

use crate::bench;

const NASTY: &str = "</script><script>alert(1)</script> \"'\u{2028}&";

fn page_of(results: &Results, pictures: &Pictures, dir: &Path) -> String {
    let page = Page { results, log: None, figures: &Figures::default(), pictures };
    let file = write_report(&page, dir).unwrap();
    assert_eq!(file, dir.join("index.html"));
    std::fs::read_to_string(file).unwrap()
}

fn plain(results: &Results) -> String {
    let dir = tempfile::tempdir().unwrap();
    page_of(results, &Pictures::new(dir.path()), dir.path())
}

fn picture(session: &str, image: &str, bytes: usize) -> GalleryPicture {
    GalleryPicture {
        session: session.to_owned(),
        image: image.to_owned(),
        view: PictureView::Camera,
        size_px: [640, 480],
        jpeg: vec![7; bytes],
        marks: vec![GalleryMark {
            object: NASTY.to_owned(),
            rater: "anna".to_owned(),
            feature: Feature::Rim,
            closed: true,
            points_px: vec![[1.0, 2.0], [30.0, 2.0], [30.0, 40.5], [f64::NAN, 0.0]],
        }],
    }
}

#[test]
fn no_name_becomes_markup() {
    let mut results = bench::paper_plates();
    results.metadata.study = NASTY.to_owned();
    results.metadata.statement = Some(NASTY.to_owned());
    results.metadata.tables[0].title = NASTY.to_owned();
    results.metadata.inputs_sha256.insert(NASTY.to_owned(), "0".repeat(64));
    for row in &mut results.rows {
        (row.session, row.object, row.rater) = (NASTY.to_owned(), NASTY.to_owned(), NASTY.to_owned());
    }
    let dir = tempfile::tempdir().unwrap();
    let mut pictures = Pictures::new(dir.path());
    pictures.picture(picture(NASTY, NASTY, 10)).unwrap();
    let html = page_of(&results, &pictures, dir.path());
    assert!(!html.contains("<script>alert"), "a name became a script");
    let scripts = html.split("<script").skip(1).map(|rest| rest.split("</script>").next().unwrap());
    assert!(!scripts.map(str::to_owned).collect::<String>().contains('\u{2028}'), "it would end a line of script");
    // Two blocks of data, and the page's own script; each is closed once.
    assert_eq!(html.matches("<script").count(), 3, "scripts of the page");
    assert_eq!(html.matches("</script>").count(), 3);
    assert!(html.contains("&#60;/script&#62;&#60;script&#62;alert(1)"), "the name is shown");
}

#[test]
fn nothing_in_the_page_asks_a_network() {
    let html = plain(&bench::paper_plates());
    assert!(html.contains("default-src &#39;none&#39;"), "the policy stands");
    // Names of XML's own are no requests.
    let addresses = html.replace("http://www.w3.org/2000/svg", "");
    for scheme in ["http:", "https:", "//cdn", "@import", "url("] {
        assert!(!addresses.contains(scheme), "{scheme} in the page");
    }
}

#[test]
fn the_same_results_give_the_same_bytes() {
    let results = bench::paper_plates();
    assert!(plain(&results) == plain(&results));
}

#[test]
fn tables_stand_in_it_with_printed_numbers_and_notes() {
    let html = plain(&bench::plates());
    for text in [
        "Table ",
        "printed (cm)",
        "printed without its minus sign",
        "proves arithmetic only",
        "<th scope=\"col\"",
        "<th scope=\"row\"",
        "-note-a\"",
    ] {
        assert!(html.contains(text), "{text}");
    }
}

#[test]
fn figures_stand_in_the_page_and_very_large_ones_as_pictures() {
    let dir = tempfile::tempdir().unwrap();
    let svg = |inside: &str| format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\">{inside}</svg>");
    let figure = |name: &str, svg: String| Figure {
        name: name.to_owned(),
        title: "A < B".to_owned(),
        caption: "caption".to_owned(),
        alt: "what it shows \"quoted\"".to_owned(),
        svg,
    };
    let mut figures = Figures::default();
    figures.drawn = vec![figure("one", svg("<path d=\"M0 0\"/>")), figure("two", svg(&"<path/>".repeat(3000)))];
    let (results, pictures) = (bench::plates(), Pictures::new(dir.path()));
    let page = Page { results: &results, log: Some(&RunLog::default()), figures: &figures, pictures: &pictures };
    let html = std::fs::read_to_string(write_report(&page, dir.path()).unwrap()).unwrap();
    assert!(html.contains("A &#60; B") && html.contains("href=\"figures/one.svg\""));
    assert!(html.contains(&figures.drawn[0].svg) && !html.contains(&figures.drawn[1].svg));
    assert!(
        html.contains("alt=\"what it shows &#34;quoted&#34;\"") && html.contains("data:image/svg+xml;base64,PHN2ZyB")
    );
}

#[test]
fn few_pictures_are_in_the_page_and_many_beside_it() {
    let dir = tempfile::tempdir().unwrap();
    let results = bench::plates();
    let folder = dir.path().join("pictures");

    let mut many = Pictures::new(dir.path());
    for number in 0..5 {
        many.picture(picture("s1", &format!("IMAGES/{number}.JPG"), 1_000_000)).unwrap();
    }
    let html = page_of(&results, &many, dir.path());
    assert!(!html.contains("data:image/jpeg") && html.contains("\"pictures/s1_/4_.camera.jpg\""));
    let files = |folder: &Path| walk(folder).len();
    assert_eq!(files(&folder), 6, "five pictures and their list");
    assert!(html.len() < 1_000_000);

    let mut fewer = Pictures::new(dir.path());
    (0..5).for_each(|number| fewer.picture(picture("s2", &format!("{number}.jpg"), 900_000)).unwrap());
    std::fs::write(folder.join("mine.jpg"), "somebody's own").unwrap();
    page_of(&results, &fewer, dir.path());
    assert_eq!(files(&folder), 7, "those of s1 are gone, what is not ours stays");

    let mut few = Pictures::new(dir.path());
    few.picture(picture("s1", "a.jpg", 1000)).unwrap();
    let html = page_of(&results, &few, dir.path());
    assert!(html.contains("data:image/jpeg;base64,BwcH") && html.contains("1,2 30,2 30,40.5"));
    assert_eq!(files(&folder), 1, "only somebody's own");
}

fn walk(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { walk(&path) } else { vec![path] }).collect()
}

#[test]
fn a_changed_list_removes_nothing_else() {
    let dir = tempfile::tempdir().unwrap();
    let (inside, report) = (dir.path().join("keep.jpg"), dir.path().join("report"));
    std::fs::create_dir_all(report.join("pictures")).unwrap();
    std::fs::write(&inside, "keep").unwrap();
    let list = format!("pictures/../../keep.jpg\n{}\nindex.html\npictures\n", inside.display());
    std::fs::write(report.join("pictures/files.txt"), list).unwrap();
    page_of(&bench::plates(), &Pictures::new(&report), &report);
    assert!(inside.is_file() && report.join("index.html").is_file());
}

#[test]
fn a_long_table_is_short_in_the_document() {
    let mut results = bench::plates();
    let row = bench::fused("bowl", "anna", Some(150.0), 149.0);
    results.rows =
        (0..1000).map(|number| model::ResultRow { session: format!("s{number:04}"), ..row.clone() }).collect();
    let html = plain(&results);
    assert!(html.contains("The first 40 of 1000 rows.") && html.contains("id=\"sizes-rows\""));
    assert!(html.matches("<tr").count() < 500);
    assert!(html.contains("s0999"), "all are there for the script");
}
