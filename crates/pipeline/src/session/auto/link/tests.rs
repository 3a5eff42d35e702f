use model::UtcNs;

use super::*;
use crate::session::auto::appearance::Appearance;
use rims::{HeightSource, RimHeight};

const CAMERA_MM: f64 = 420.0;

fn appearance(plate_log_odds: f64, diameter_mm: f64) -> Appearance {
    let height = |share: f64| RimHeight {
        mm: share * diameter_mm,
        sigma_mm: 0.3 * share * diameter_mm,
        source: HeightSource::Common,
    };
    Appearance { plate: height(0.1), bowl: height(0.4), plate_log_odds }
}

/// A rim that may be anything, 3 % uncertain. `across_mm`: on the plane Z = 0.
fn rim(at_s: i64, across_mm: f64, at_mm: [f64; 2]) -> Sighting {
    Sighting {
        image: usize::try_from(at_s).unwrap_or(0),
        time: UtcNs(at_s * 1_000_000_000),
        across_mm,
        narrowness: None,
        relative_sigma: 0.03,
        camera_mm: CAMERA_MM,
        at_mm,
        appearance: appearance(0.0, across_mm),
    }
}

/// Number of the container of every sighting, from 1.
fn numbers(seen: &[Sighting]) -> Vec<usize> {
    let mut numbers = vec![0; seen.len()];
    for (number, track) in (1..).zip(containers(seen, &[])) {
        for member in track.members {
            assert_eq!(numbers[member], 0, "each sighting is of one container");
            numbers[member] = number;
        }
    }
    numbers
}

#[test]
fn one_container_keeps_its_name_however_the_head_turns() {
    let seen: Vec<Sighting> = (0..20)
        .map(|i| {
            let yaw = 0.4 * f64::from(i).sin();
            rim(10 * i64::from(i), 150.0 + f64::from(i % 3), [400.0 * yaw.sin(), 400.0 * yaw.cos()])
        })
        .collect();
    assert_eq!(numbers(&seen), vec![1; 20]);
    let late = rim(10_000, 151.0, [-300.0, 100.0]);
    assert_eq!(numbers(&[seen[0], late]), [1, 1], "long after, its size is enough");
}

#[test]
fn a_container_that_looks_like_a_plate_once_and_like_a_bowl_then_is_one() {
    let seen: Vec<Sighting> = (0..6_i32)
        .map(|i| Sighting {
            appearance: appearance(if i % 2 == 0 { 3.0 } else { -3.0 }, 200.0),
            ..rim(10 * i64::from(i), 200.0, [0.0, 400.0])
        })
        .collect();
    assert_eq!(numbers(&seen), [1; 6]);
}

/// As the head rises, a circle on Z = 0 shrinks the more, the higher the rim is: a bowl's more than a plate's.
#[test]
fn sizes_are_compared_at_the_height_of_the_rim() {
    let bowl = |at_s, camera_mm: f64| Sighting {
        camera_mm,
        appearance: appearance(-8.0, 150.0),
        ..rim(at_s, 150.0 / (1.0 - 60.0 / camera_mm), [0.0, 300.0])
    };
    assert_eq!(numbers(&[bowl(0, 250.0), bowl(1_000, 500.0)]), [1, 1]);
    let flat = [bowl(0, 250.0), bowl(1_000, 500.0)]
        .map(|sighting| Sighting { appearance: appearance(8.0, 150.0), ..sighting });
    assert_eq!(numbers(&flat), [1, 2]);
}

#[test]
fn other_sizes_are_others() {
    let seen = [rim(0, 150.0, [0.0, 300.0]), rim(10, 190.0, [0.0, 300.0]), rim(20, 240.0, [0.0, 300.0])];
    assert_eq!(numbers(&seen), [1, 2, 3]);
}

#[test]
fn rectangles_are_told_apart_by_both_sides_and_from_what_is_round() {
    let plate = |at_s, narrowness| Sighting { narrowness, ..rim(at_s, 200.0, [0.0, 300.0]) };
    let seen = [plate(0, Some(0.75)), plate(10, Some(0.76)), plate(20, Some(0.95)), plate(30, None)];
    assert_eq!(numbers(&seen), [1, 1, 2, 3]);
}

#[test]
fn equal_bowls_are_told_apart_by_their_places() {
    let pair = |at_s, shift: f64| [rim(at_s, 150.0, [-200.0 + shift, 350.0]), rim(at_s, 150.0, [200.0 + shift, 350.0])];
    let [a, b] = pair(0, 0.0);
    let [c, d] = pair(10, 60.0);
    assert_eq!(numbers(&[a, b, d, c]), [1, 2, 2, 1], "whatever their order");
}

#[test]
fn what_is_not_clear_is_not_linked() {
    let first = [rim(0, 150.0, [-200.0, 350.0]), rim(0, 150.0, [200.0, 350.0])];
    let later = rim(3_600, 150.0, [0.0, 350.0]);
    let then = rim(3_610, 150.0, [20.0, 350.0]);
    assert_eq!(numbers(&[first[0], first[1], later, then]), [1, 2, 3, 3]);
    let two = [rim(3_600, 150.0, [-50.0, 350.0]), rim(3_600, 151.0, [50.0, 350.0])];
    assert_eq!(numbers(&[first[0], two[0], two[1]]), [1, 2, 3]);
}

#[test]
fn containers_that_no_head_could_move_so_far_are_two() {
    let far = rim(10, 150.0, [0.0, 900.0]); // nobody leans so far in 10 s
    let later = [rim(600, 150.0, [0.0, 300.0]), rim(1_200, 150.0, [0.0, 300.0])];
    let numbers = numbers(&[rim(0, 150.0, [0.0, 300.0]), far, later[0], later[1]]);
    assert_eq!((&numbers[..2], numbers[2] == numbers[3]), (&[1, 2][..], true), "{numbers:?}");
}

/// One odd image begins a track of its own; what comes between them later shows that both are one.
#[test]
fn an_odd_image_does_not_split_a_container_for_ever() {
    let sizes = [151.0, 168.0, 159.0, 160.0, 161.0, 160.0];
    let seen: Vec<Sighting> =
        sizes.iter().zip(0..).map(|(across_mm, i)| rim(1_000 * i, *across_mm, [0.0, 300.0])).collect();
    assert_eq!(numbers(&seen), [1; 6]);
}

#[test]
fn odd_numbers_are_no_trouble() {
    let odd = |across_mm, relative_sigma| Sighting { relative_sigma, ..rim(0, across_mm, [f64::NAN, 0.0]) };
    let seen = [odd(f64::NAN, 1.0), odd(150.0, 0.0), odd(150.0, f64::INFINITY), odd(-1.0, f64::NAN)];
    assert_eq!(numbers(&seen), [1, 2, 3, 4]);
    let late = [odd(f64::NAN, f64::NAN), Sighting { image: 1, camera_mm: 0.0, ..odd(150.0, 0.03) }];
    assert_eq!(numbers(&late), [1, 2]);
}
