//! One kind, one height and one name for each container.

use std::collections::{BTreeMap, BTreeSet};

use super::Seen;
use super::link::containers;
use super::track::Sighting;
use crate::labelme::AutoRim;
use crate::rims::Found;
use crate::study::FOUND;

/// The rims by image, named: one container, one name, what it is by all of its images. Numbers go from 1 in the order in which
/// containers are first seen; `taken` are left out, and so are containers narrower than `least_diameter_mm`.
pub(super) fn named(seen: Vec<Seen>, taken: &BTreeSet<u32>, least_diameter_mm: f64) -> BTreeMap<String, Vec<AutoRim>> {
    let sightings: Vec<Sighting> = seen.iter().map(|seen| seen.sighting).collect();
    let mut free = (1..).filter(|number| !taken.contains(number));
    let mut decided: Vec<Option<(String, Found)>> = vec![None; seen.len()];
    for track in containers(&sightings) {
        let Some(looks) = track.looks() else { continue };
        let kind = looks.kind();
        let is_wide = track.diameter_mm(looks.height(kind).mm) >= least_diameter_mm;
        if !is_wide {
            continue;
        }
        let name = format!("{FOUND}{}", free.next().unwrap_or(u32::MAX));
        for member in track.members {
            let own = seen[member].rim.found;
            let found = Found { kind, height: looks.bowl, plate_height: Some(looks.plate), ..own };
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
