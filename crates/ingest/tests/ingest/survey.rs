//! A survey: everything but the pictures.

use aim_batch_ingest::{Ingested, NoProgress, SessionReader, ingest_if_changed, survey_session};

use crate::support::{NOON_S, Study, acceleration_packet, jpeg, range_packet, samples};

fn study() -> Study {
    let study = Study::new("aim2-packets");
    study.write("SENSORS/ACC1.BIN", &acceleration_packet(NOON_S as f64));
    study.write("SENSORS/RNG1.BIN", &range_packet(NOON_S as f64, 500));
    study.write("IMAGES/20250601T120001.000Z.JPG", &jpeg(32, 24, 200));
    study.write("IMAGES/20250601T120002.000Z.JPG", &jpeg(16, 12, 200));
    study
}

#[test]
fn a_survey_finds_what_ingest_finds_and_has_no_pictures() {
    let study = study();
    let survey_file = study.dir.path().join("survey/P01.mcap");
    let surveyed = survey_session(&study.source, &survey_file, &NoProgress).unwrap();
    let mut survey = SessionReader::open(&survey_file).unwrap();
    let (ingested, mut whole) = study.ingest();
    assert_eq!(surveyed.problems, ingested.problems);
    assert_eq!((surveyed.counts, surveyed.bytes), (ingested.counts, ingested.bytes));
    let (images, dropped) = (survey.images().unwrap(), survey.metadata().dropped_images.clone());
    assert_eq!((images.len(), dropped.len()), (1, 1));
    assert_eq!((&images, &dropped), (&whole.images().unwrap(), &whole.metadata().dropped_images));
    assert_eq!(samples(&mut survey), samples(&mut whole));
    assert!(survey.metadata().is_survey() && !whole.metadata().is_survey());
    assert!(survey.image_bytes(&images[0].file).is_err() && whole.image_bytes(&images[0].file).is_ok());
}

#[test]
fn a_survey_never_passes_for_the_file_of_its_session() {
    let study = study();
    survey_session(&study.source, &study.out(), &NoProgress).unwrap();
    assert!(matches!(ingest_if_changed(&study.source, &study.out(), &NoProgress), Ok(Ingested::Fresh(_))));
    assert!(!SessionReader::open(&study.out()).unwrap().metadata().is_survey());
}

#[test]
fn channels_that_are_carried_along_are_read_by_name() {
    let study = study();
    let (_, mut reader) = study.ingest();
    assert_eq!(reader.extra_channels(), ["optical"]);
    let mut optical = Vec::new();
    reader.for_each_extra("optical", |time, value| optical.push((time.0, value))).unwrap();
    assert_eq!((optical.len(), optical[0]), (1022, (NOON_S * 1_000_000_000, 7.0)));
    reader.for_each_extra("sound", |_, _| panic!("there is no such channel")).unwrap();
}
