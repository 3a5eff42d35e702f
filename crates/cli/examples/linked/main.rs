//! Compares the containers that were found without marks in a simulated study with its truth, session by session
//! (docs/rims-evaluation.md).
//!
//! ```text
//! aim-batch simulate worn -o STUDY
//! aim-batch run STUDY --marks auto --method ray --out RESULTS.parquet --write-marks MARKS
//! cargo run -p aim-batch --example linked -- STUDY RESULTS.parquet MARKS [MORE STUDIES ...]
//! ```
//!
//! Prints one line per container, and sums over all studies: how many names a container has, how many names hold two, how
//! often its kind is right, and how far sizes are off.

#![allow(clippy::print_stdout, reason = "tells what it compared")]

mod sums;
mod truth;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, bail};
use model::{Kind, Level, Quantity, ResultRow};
use pipeline::labelme;
use sums::Sums;
use truth::{Seen, Truth};

/// The rater of the rims that the program found itself.
const AUTO: &str = "auto";

/// A found rim: its name in its session, and the container whose rim it is, if it is one's.
struct Sighting {
    name: String,
    kind: Kind,
    of: Option<String>,
}

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.is_empty() || !arguments.len().is_multiple_of(3) {
        bail!("expected: STUDY RESULTS.parquet MARKS, once or more often");
    }
    let mut sums = Sums::default();
    for study in arguments.chunks(3) {
        let [study, results, marks] = study else { continue };
        compare(Path::new(study), Path::new(results), Path::new(marks), &mut sums)?;
    }
    print!("{sums}");
    Ok(())
}

fn compare(study: &Path, results: &Path, marks: &Path, sums: &mut Sums) -> anyhow::Result<()> {
    let truth = Truth::read(study)?;
    let rows = report::Results::read(results)?.rows;
    for (session, images) in &truth.sessions {
        let mut sightings = Vec::new();
        for (image, seen) in images {
            let stem = Path::new(image).with_extension("json");
            let file = marks.join(AUTO).join(session).join(stem.file_name().context("an image without a name")?);
            if file.is_file() {
                sightings.extend(in_image(&file, seen)?);
            }
        }
        let rows: Vec<&ResultRow> = rows.iter().filter(|row| row.session == *session && row.rater == AUTO).collect();
        for name in sightings.iter().map(|s| s.name.as_str()).collect::<BTreeSet<_>>() {
            let of: BTreeSet<_> = sightings.iter().filter(|s| s.name == name).filter_map(|s| s.of.as_deref()).collect();
            sums.name(of.len());
        }
        for object in truth.containers(session) {
            container(session, object, &sightings, &rows, sums);
        }
    }
    Ok(())
}

/// The rims that were found in one image, read from its file of marks.
fn in_image(file: &Path, seen: &Seen) -> anyhow::Result<Vec<Sighting>> {
    let marks = labelme::parse(&labelme::read_bytes(file)?, file, seen.view.camera().size_px())?;
    let found = marks.objects.iter().filter_map(|object| Some((object, marks.found.get(&object.object)?)));
    Ok(found
        .map(|(marks, found)| Sighting { name: marks.object.clone(), kind: found.kind, of: seen.container_of(marks) })
        .collect())
}

/// Prints one line about a container, and adds the container to the sums.
fn container(session: &str, object: &truth::Object, sightings: &[Sighting], rows: &[&ResultRow], sums: &mut Sums) {
    let of: Vec<&Sighting> = sightings.iter().filter(|s| s.of.as_deref() == Some(&object.name)).collect();
    let mut names: BTreeMap<&str, usize> = BTreeMap::new();
    for sighting in &of {
        *names.entry(&sighting.name).or_default() += 1;
    }
    let kinds = of.iter().filter(|s| s.kind == object.kind).count();
    sums.container(names.len(), of.len(), kinds);
    let Some((main, _)) = names.iter().max_by_key(|(_, images)| **images) else { return };
    let fused = |quantity: Quantity| {
        let is_one = |row: &&&ResultRow| row.object == **main && row.level == Level::Fused && row.quantity == quantity;
        rows.iter().find(is_one).copied()
    };
    for row in rows.iter().filter(|row| row.level == Level::Frame && row.quantity == Quantity::Diameter) {
        if names.contains_key(row.object.as_str()) {
            sums.frame(row, object);
        }
    }
    let diameter = fused(Quantity::Diameter);
    let told = diameter.map(|row| sums.fused(row, object)).unwrap_or_default();
    let names: Vec<String> = names.iter().map(|(name, images)| format!("{name} x{images}")).collect();
    let kind = diameter.map_or("", |row| row.kind.code());
    println!(
        "{session} {:13} {:5} {:3.0} mm: {told}; {kind}, {kinds} of {} kinds; {}",
        object.name,
        object.kind.code(),
        object.diameter_mm,
        of.len(),
        names.join(", ")
    );
}
