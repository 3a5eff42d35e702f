//! Every defect that cards have: what can be used is used, what is lost is told with its code, and no other session notices.

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
