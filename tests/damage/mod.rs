//! Every defect that the input of a study has, in cards, marks and settings: what can be used is used, what is lost is reported
//! with its code, and no other session notices.

mod bad_input;
mod clocks;
mod corrupt;
mod images;
mod names;
mod packets;
mod study;

use model::FrameReason;

use study::{DamagedStudy, IMAGES};

#[test]
fn a_whole_study_loses_nothing() {
    let told = DamagedStudy::new().run();
    assert_eq!((told.exit, told.losses(), told.notes()), (0, vec![], vec![]));
    assert_eq!(told.reasons, [FrameReason::Selected; IMAGES]);
}
