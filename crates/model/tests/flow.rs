//! The flow of images, compared with a count image by image.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::{Flow, FlowStep, FrameReason, FrameRow, StudyFlow};
use proptest::prelude::*;

fn frame(session: &str, reason: FrameReason, raters: u32, sizes: u32) -> FrameRow {
    FrameRow { raters, sizes, ..FrameRow::without_numbers("s", session, "a.jpg", reason) }
}

fn frames() -> impl Strategy<Value = Vec<FrameRow>> {
    let session = proptest::sample::select(vec!["a", "b", "c"]);
    let reason = proptest::sample::select(FrameReason::ALL.to_vec());
    // About half of the images are selected, so that the last steps of the flow are tested as well.
    let reason = prop_oneof![reason, Just(FrameReason::Selected)];
    let row = (session, reason, 0..3_u32, 0..3_u32)
        .prop_map(|(session, reason, raters, sizes)| frame(session, reason, raters, sizes));
    proptest::collection::vec(row, 0..60)
}

fn study(frames: &[FrameRow]) -> StudyFlow {
    let mut study = StudyFlow::default();
    frames.iter().for_each(|frame| study.add(frame));
    study
}

/// Whether one image reaches a step, by the meaning of the step.
fn reaches(frame: &FrameRow, step: FlowStep) -> bool {
    use FrameReason::{Moving, PitchOutsideTarget, Selected, TimesDisagree};
    let selected = frame.reason == Selected;
    match step {
        FlowStep::Found => true,
        FlowStep::Readable => frame.reason > TimesDisagree,
        FlowStep::WithPose => frame.reason.has_pose(),
        FlowStep::Still => frame.reason.has_pose() && frame.reason != Moving,
        FlowStep::Selected => frame.reason.has_pose() && frame.reason != Moving && frame.reason != PitchOutsideTarget,
        FlowStep::Marked => selected && frame.raters > 0,
        FlowStep::Measured => selected && frame.raters > 0 && frame.sizes > 0,
    }
}

fn count(frames: &[FrameRow], keep: impl Fn(&FrameRow) -> bool) -> usize {
    frames.iter().filter(|frame| keep(frame)).count()
}

proptest! {
    #[test]
    fn every_step_holds_the_images_that_its_meaning_says(frames in frames()) {
        let total = study(&frames).total();
        for step in FlowStep::ALL {
            prop_assert_eq!(total.images_at(*step), count(&frames, |frame| reaches(frame, *step)), "{}", step);
        }
        let others = total.not_selected();
        let not_selected = |frame: &FrameRow| frame.reason != FrameReason::Selected;
        prop_assert_eq!(others.images, count(&frames, not_selected));
        prop_assert_eq!(others.marked, count(&frames, |frame| not_selected(frame) && frame.raters > 0));
        for reason in FrameReason::ALL {
            prop_assert_eq!(total.with_reason(*reason).images, count(&frames, |frame| frame.reason == *reason));
        }
    }

    #[test]
    fn each_step_holds_no_more_than_the_one_before_and_loses_what_its_reasons_say(frames in frames()) {
        let total = study(&frames).total();
        for pair in FlowStep::ALL.windows(2) {
            let [before, after] = [pair[0], pair[1]].map(|step| total.images_at(step));
            prop_assert!(after <= before, "{} {} -> {} {}", pair[0], before, pair[1], after);
            if pair[1] <= FlowStep::Selected {
                let lost = FrameReason::ALL.iter().filter(|reason| reason.ends() == Some(pair[1]));
                prop_assert_eq!(before - after, lost.map(|reason| total.with_reason(*reason).images).sum::<usize>());
            }
        }
    }

    #[test]
    fn the_order_of_images_does_not_matter_and_sessions_add_up(
        (frames, shuffled) in frames().prop_flat_map(|frames| (Just(frames.clone()), Just(frames).prop_shuffle())),
    ) {
        let flow = study(&frames);
        prop_assert_eq!(&flow, &study(&shuffled));
        let mut whole = Flow::default();
        shuffled.iter().for_each(|frame| whole.add(frame));
        prop_assert_eq!(&whole, &flow.total());
        for step in FlowStep::ALL {
            let sum: usize = flow.sessions().map(|(_, session)| session.images_at(*step)).sum();
            prop_assert_eq!(sum, whole.images_at(*step));
        }
    }
}

#[test]
fn an_image_that_is_measured_but_not_selected_stands_beside_the_funnel() {
    let moving = frame("a", FrameReason::Moving, 2, 4);
    let total = study(&[moving, frame("a", FrameReason::Selected, 0, 0)]).total();
    let steps = FlowStep::ALL.iter().map(|step| total.images_at(*step)).collect::<Vec<_>>();
    assert_eq!(steps, [2, 2, 2, 1, 1, 0, 0]);
    let others = total.not_selected();
    assert_eq!((others.images, others.marked, others.measured), (1, 1, 1));
    assert!((total.selected_pct().unwrap() - 50.0).abs() < 1e-12);
    assert_eq!(Flow::default().selected_pct(), None);
}

#[test]
fn every_reason_but_selected_ends_a_step_and_the_order_of_reasons_is_that_of_the_flow() {
    for reason in FrameReason::ALL {
        assert_eq!(reason.ends().is_none(), *reason == FrameReason::Selected, "{reason}");
        assert_eq!(reason.has_pose(), reason.reaches() >= FlowStep::WithPose, "{reason}");
    }
    assert!(FrameReason::ALL.windows(2).all(|pair| pair[0].reaches() <= pair[1].reaches()));
}
