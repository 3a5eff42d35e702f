//! Gives each container one kind, one height and one name.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::appearance::Appearance;
use super::link::containers;
use super::table::OnTable;
use super::track::{Sighting, Track};
use crate::labelme::AutoRim;
use crate::study::FOUND;
use rims::{Found, as_judged, plate_log_odds};

/// A rim with the sighting by which it is linked to others.
pub(super) struct Seen {
    pub image: String,
    pub rim: AutoRim,
    pub sighting: Sighting,
    /// Ideal rays through points along it.
    pub rays: Vec<Vector3<f64>>,
}

/// The rims by image, under the name of their container and with its kind and height by all of its images. Numbers go from 1
/// in the order in which containers are first seen. Those in `taken` are not given, and containers narrower than
/// `least_diameter_mm` are left out. `on_table`: what is known of containers by their places.
pub(super) fn name_containers(
    seen: Vec<Seen>,
    on_table: &[OnTable],
    taken: &BTreeSet<u32>,
    least_diameter_mm: f64,
) -> BTreeMap<String, Vec<AutoRim>> {
    let sightings: Vec<Sighting> = seen.iter().map(|seen| seen.sighting).collect();
    let mut free = (1..).filter(|number| !taken.contains(number));
    let mut decided: Vec<Option<(String, Found)>> = vec![None; seen.len()];
    for track in containers(&sightings, on_table) {
        let Some(appearance) = track.appearance().map(|appearance| by_session(appearance, &track, on_table)) else {
            continue;
        };
        let kind = appearance.kind();
        let is_wide = track.narrowest_mm(appearance.height(kind).mm) >= least_diameter_mm;
        if !is_wide {
            continue;
        }
        let (plate_height, height) = as_judged(appearance.plate, appearance.bowl, appearance.plate_log_odds);
        let name = format!("{FOUND}{}", free.next().unwrap_or(u32::MAX));
        for member in track.members {
            let own = seen[member].rim.found;
            let found = Found { kind, height, plate_height: Some(plate_height), ..own };
            decided[member] = Some((name.clone(), found));
        }
    }
    let mut by_image: BTreeMap<String, Vec<AutoRim>> = BTreeMap::new();
    for (Seen { image, rim, .. }, decided) in seen.into_iter().zip(decided) {
        let Some((object, found)) = decided else { continue };
        by_image.entry(image).or_default().push(AutoRim { object, found, ..rim });
    }
    by_image
}

/// The appearance of a container, with the height that its session gives, where that is surer than what single images show.
fn by_session(appearance: Appearance, track: &Track, on_table: &[OnTable]) -> Appearance {
    let of_track = on_table.iter().find(|one| one.members.iter().all(|member| track.members.contains(member)));
    let Some(height) = of_track.map(OnTable::rim_height) else { return appearance };
    if height.sigma_mm >= appearance.height(appearance.kind()).sigma_mm {
        return appearance;
    }
    let plate_log_odds = plate_log_odds(&height, track.diameter_mm(height.mm));
    Appearance { plate: height, bowl: height, plate_log_odds }
}

#[cfg(test)]
mod tests {
    use model::{Kind, Shape, UtcNs};

    use super::*;
    use crate::session::auto::appearance::Appearance;
    use rims::{HeightSource, RimHeight};

    const LEAST_MM: f64 = 90.0;

    /// A rim of a bowl 60 mm high, seen from 400 mm.
    fn seen(image: u32, across_mm: f64, plate_log_odds: f64, bowl_mm: f64) -> Seen {
        let height = |mm: f64| RimHeight { mm, sigma_mm: 10.0, source: HeightSource::Foot };
        let (plate, bowl) = (height(20.0), height(bowl_mm));
        let kind = if plate_log_odds > 0.0 { Kind::Plate } else { Kind::Bowl };
        let (shape, plate_height) = (Shape::Circle, Some(plate));
        let found = Found { kind, shape, confidence: 0.9, perimeter_px: 500.0, height: bowl, plate_height };
        let sighting = Sighting {
            image: image as usize,
            time: UtcNs(i64::from(image) * 1_000_000_000_000),
            across_mm,
            narrowness: None,
            relative_sigma: 0.03,
            camera_mm: 400.0,
            at_mm: [0.0, 300.0],
            appearance: Appearance { plate, bowl, plate_log_odds },
        };
        let rim = AutoRim { object: String::new(), points_px: Vec::new(), found };
        Seen { image: format!("{image}.jpg"), rim, sighting, rays: Vec::new() }
    }

    #[test]
    fn all_images_of_a_container_have_its_kind_and_height() {
        let images = vec![seen(0, 200.0, -9.0, 50.0), seen(1, 201.0, 1.0, 70.0), seen(2, 199.0, -9.0, 60.0)];
        let by_image = name_containers(images, &[], &BTreeSet::new(), LEAST_MM);
        let rims: Vec<&AutoRim> = by_image.values().flatten().collect();
        assert_eq!(rims.len(), 3);
        for rim in rims {
            assert_eq!((rim.object.as_str(), rim.found.kind), ("auto-1", Kind::Bowl));
            assert!((rim.found.height.mm - 60.0).abs() < 1e-9 && rim.found.height.sigma_mm < 10.0, "{:?}", rim.found);
        }
    }

    /// A plate of 20 mm, or a bowl of 60 mm: the height of what it is taken for has to say that.
    #[test]
    fn a_height_is_less_sure_where_the_kind_is() {
        let sigma_mm = |plate_log_odds: f64| {
            let by_image = name_containers(vec![seen(0, 200.0, plate_log_odds, 60.0)], &[], &BTreeSet::new(), LEAST_MM);
            by_image["0.jpg"][0].found.height.sigma_mm
        };
        assert!((sigma_mm(-9.0) - 10.0).abs() < 0.2, "{}", sigma_mm(-9.0));
        assert!(sigma_mm(-1.0) > 20.0, "{}", sigma_mm(-1.0));
    }

    #[test]
    fn numbers_are_of_what_is_kept_and_free() {
        let images = vec![seen(0, 80.0, -6.0, 60.0), seen(0, 150.0, -6.0, 60.0), seen(1, 250.0, 6.0, 60.0)];
        let by_image = name_containers(images, &[], &BTreeSet::from([1, 3]), LEAST_MM);
        let names = |image: &str| by_image[image].iter().map(|rim| rim.object.as_str()).collect::<Vec<_>>();
        assert_eq!((names("0.jpg"), names("1.jpg")), (vec!["auto-2"], vec!["auto-4"]), "a cup has no name");
    }

    /// Whether it is a cup is asked of the container: in one image alone it would be wide enough.
    #[test]
    fn a_container_is_narrow_in_all_of_its_images_or_in_none() {
        let cup = vec![seen(0, 109.0, -6.0, 60.0), seen(1, 103.0, -6.0, 60.0), seen(2, 102.0, -6.0, 60.0)];
        assert!(name_containers(cup, &[], &BTreeSet::new(), LEAST_MM).is_empty());
    }

    /// Single images take it for a plate of 20 mm; the session sees that its rim is at 72 mm.
    #[test]
    fn the_height_by_the_session_decides_height_and_kind() {
        let images = || vec![seen(0, 200.0, 3.0, 60.0), seen(1, 201.0, 3.0, 60.0)];
        let height = |height_mm: (f64, f64)| {
            let on_table = [OnTable { members: vec![0, 1], height_mm }];
            name_containers(images(), &on_table, &BTreeSet::new(), LEAST_MM)["1.jpg"][0].found
        };
        let sure = height((72.0, 3.0));
        assert_eq!((sure.kind, sure.height.source), (Kind::Bowl, HeightSource::Session));
        assert!((sure.height.mm - 72.0).abs() < 1e-9 && (sure.height.sigma_mm - 3.0).abs() < 0.1, "{sure:?}");
        let flat = height((17.0, 3.0));
        assert_eq!((flat.kind, flat.height.source), (Kind::Plate, HeightSource::Session));
        let unsure = height((72.0, 40.0));
        assert_eq!(
            (unsure.kind, unsure.height.source),
            (Kind::Plate, HeightSource::Foot),
            "one place alone knows nothing"
        );
    }

    #[test]
    fn places_decide_before_sizes_do() {
        // Sizes alone would make two containers of the first two, and one of the last two.
        let images = || vec![seen(0, 200.0, -6.0, 60.0), seen(1, 240.0, -6.0, 60.0), seen(2, 241.0, -6.0, 60.0)];
        let names = |on_table: &[OnTable]| {
            let by_image = name_containers(images(), on_table, &BTreeSet::new(), LEAST_MM);
            by_image.into_values().flatten().map(|rim| rim.object).collect::<Vec<_>>()
        };
        assert_eq!(names(&[]), ["auto-1", "auto-2", "auto-2"]);
        let at = |members: &[usize]| OnTable { members: members.to_vec(), height_mm: (60.0, 50.0) };
        assert_eq!(
            names(&[at(&[0, 1])]),
            ["auto-1", "auto-1", "auto-1"],
            "what is not tied goes with most of its track"
        );
        let apart = names(&[at(&[0]), at(&[1]), at(&[2])]);
        assert_eq!(apart, ["auto-1", "auto-2", "auto-2"], "one that was moved keeps its name by its size");
    }
}
