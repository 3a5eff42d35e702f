//! Measures the images of a session by all methods.

use std::collections::BTreeMap;

use model::{
    Container, Estimate, InputSigma, JointHeight, Method, Part, Quantity, Share, Sights, best_of, combined_sigma,
    estimate, fuse, joint_height, sights,
};

use super::scene::Thing;
use super::{Image, Level, Subject, Trial};

const ON_ONE_IMAGE: [Method; 3] = [Method::Paper, Method::Ray, Method::Coaxial];

type ByMethod = BTreeMap<(Quantity, Method), Vec<(usize, Estimate)>>;

/// The sizes of a session: of each image by each method and by the best one, and then fused.
pub(super) fn measure(thing: &Thing, images: &[Image], sigma: &InputSigma) -> Vec<Trial> {
    let mut trials = Vec::new();
    let mut by_method = ByMethod::new();
    for (number, image) in images.iter().enumerate() {
        let mut by_quantity: BTreeMap<Quantity, Vec<Estimate>> = BTreeMap::new();
        for method in ON_ONE_IMAGE {
            for (quantity, found) in estimate(&image.view, method, &thing.container(), &image.marks, sigma) {
                let Ok(found) = found else { continue };
                by_method.entry((quantity, method)).or_default().push((number, found.clone()));
                by_quantity.entry(quantity).or_default().push(found);
            }
        }
        for (quantity, found) in &by_quantity {
            let best = best_of(found).map(|best| (Method::Best, best));
            let sizes = found.iter().map(|e| (e.method, e)).chain(best);
            trials.extend(sizes.map(|(method, e)| Trial {
                predicted_mm: e.measured.predicted_mm,
                sigma_mm: e.sigma.total_mm,
                claims: e.doubts.is_empty(),
                ..blank(thing, *quantity, method, Level::Image)
            }));
        }
    }
    let mut of_session: Vec<Trial> =
        by_method.iter().filter_map(|(key, group)| fused(thing, *key, group, sigma)).collect();
    of_session.extend(joint(thing, images, sigma));
    trials.extend(with_best(of_session));
    trials
}

fn blank(thing: &Thing, quantity: Quantity, method: Method, level: Level) -> Trial {
    Trial {
        subject: thing.subject,
        quantity,
        method,
        level,
        true_mm: thing.truth_mm(quantity),
        predicted_mm: f64::NAN,
        sigma_mm: f64::NAN,
        claims: true,
    }
}

/// The sizes of a session and, for each quantity, the surest one as the best: of those whose method claims to apply, or of all
/// where none does.
fn with_best(mut trials: Vec<Trial>) -> Vec<Trial> {
    let mut best: BTreeMap<Quantity, Trial> = BTreeMap::new();
    for trial in &trials {
        let relative = |trial: &Trial| trial.sigma_mm / trial.predicted_mm;
        let surer = |than: &Trial| (!trial.claims, relative(trial)) < (!than.claims, relative(than));
        let taken = best.entry(trial.quantity).or_insert(*trial);
        if surer(taken) {
            *taken = *trial;
        }
    }
    trials.extend(best.into_values().map(|trial| Trial { method: Method::Best, ..trial }));
    trials
}

fn share(estimate: &Estimate, picture: usize, sigma: &InputSigma) -> Share {
    let part = Part { sensitivity: estimate.sensitivity, inputs: *sigma, picture };
    Share::of_picture(estimate.measured.predicted_mm, part, 1.0)
}

fn fused(
    thing: &Thing,
    (quantity, method): (Quantity, Method),
    group: &[(usize, Estimate)],
    sigma: &InputSigma,
) -> Option<Trial> {
    let fused = fuse(&group.iter().map(|(picture, e)| share(e, *picture, sigma)).collect::<Vec<_>>())?;
    Some(Trial {
        predicted_mm: fused.value_mm,
        sigma_mm: fused.sigma.total_mm,
        claims: group.iter().all(|(_, e)| e.doubts.is_empty()),
        ..blank(thing, quantity, method, Level::Session)
    })
}

/// The height from all images together, where they determine it, and the mouth on the plane at that height.
fn joint(thing: &Thing, images: &[Image], sigma: &InputSigma) -> Vec<Trial> {
    if !matches!(thing.subject, Subject::UprightBowl | Subject::SlopedBowl | Subject::CurvedBowl) {
        return Vec::new();
    }
    let sights_of = |(picture, image): (usize, &Image)| {
        Some(Sights { walls: sights(&image.view, &image.marks, sigma).ok()?, inputs: *sigma, picture })
    };
    let pictures: Vec<Sights> = images.iter().enumerate().filter_map(sights_of).collect();
    let Ok(height) = joint_height(&pictures) else { return Vec::new() };
    let trial = Trial {
        predicted_mm: height.height_mm,
        sigma_mm: height.sigma.total_mm,
        ..blank(thing, Quantity::Height, Method::Joint, Level::Session)
    };
    [Some(trial), mouth(thing, images, &height, sigma)].into_iter().flatten().collect()
}

fn mouth(thing: &Thing, images: &[Image], height: &JointHeight, sigma: &InputSigma) -> Option<Trial> {
    let known = Container { rim_height_mm: Some(height.height_mm), ..thing.container() };
    let mut shares = Vec::new();
    for (picture, image) in images.iter().enumerate() {
        let found = estimate(&image.view, Method::Ray, &known, &image.marks, sigma);
        let diameter = found.into_iter().find(|(quantity, _)| *quantity == Quantity::Diameter)?.1.ok()?;
        shares.push(share(&diameter, picture, sigma));
    }
    let fused = fuse(&shares)?;
    let camera_heights_mm: Vec<f64> = images.iter().map(|image| image.view.pose().camera_height_mm()).collect();
    let parts = height.parts_on_plane(&shares, &fused.weights, &camera_heights_mm);
    Some(Trial {
        predicted_mm: fused.value_mm,
        sigma_mm: combined_sigma(&parts).with_disagreement(fused.sigma.disagreement_mm).total_mm,
        ..blank(thing, Quantity::Diameter, Method::Joint, Level::Session)
    })
}
