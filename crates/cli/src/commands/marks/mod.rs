//! `marks`: converts marks from and to other annotation tools.

mod args;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use pipeline::Study;
use pipeline::exchange::{self, ExchangeError, ExportOptions, Exported, Format, ImportOptions, Imported, Refused};

pub use args::MarksArgs;
use args::{MarksExportArgs, MarksFormat, MarksImportArgs, MarksWay};

use super::{PROGRAM, outcome, place, print, print_message};
use crate::exit::{Failure, Outcome};

/// Converts the marks, and lists those that could not be converted.
pub fn run(way: &MarksWay) -> Result<Outcome, Failure> {
    match way {
        MarksWay::Import(args) => import(args),
        MarksWay::Export(args) => export(args),
    }
}

fn import(args: &MarksImportArgs) -> Result<Outcome, Failure> {
    let study = load(&args.study)?;
    let folder = args.out.clone().unwrap_or_else(|| study.dir.join("marks"));
    place::check_outside("--out", &folder, &study, "cards")?;
    let options = ImportOptions {
        rater: args.rater.clone(),
        folder,
        session: args.session.clone(),
        renamed: args.label.iter().cloned().collect(),
        ignored: args.ignore.iter().cloned().collect(),
        frame: args.frame,
        with_hidden: args.with_hidden,
        force: args.force,
        dry_run: args.dry_run,
        program: PROGRAM.to_owned(),
    };
    let imported = exchange::import(&study, &args.file, &options).map_err(failure)?;
    print_message(&reasons_text(&args.file, "note: ", &imported.notes));
    print_message(&reasons_text(&args.file, "left out: ", &imported.refused));
    if imported.marks == 0 && !imported.refused.is_empty() {
        return Err(Failure::Failed(anyhow!("nothing of {} could be used", args.file.display())));
    }
    print(&imported_text(&imported, &options))?;
    Ok(outcome(!imported.refused.is_empty()))
}

fn imported_text(imported: &Imported, options: &ImportOptions) -> String {
    let Imported { marks, written, unchanged, ignored, .. } = imported;
    let verb = if options.dry_run { "to write" } else { "written" };
    let folder: PathBuf = options.folder.join(&options.rater);
    let mut text = format!("{marks} marks in {}: {written} files {verb}", folder.display());
    if *unchanged > 0 {
        let _ = write!(text, ", {unchanged} held them already");
    }
    if *ignored > 0 {
        let _ = write!(text, "; {ignored} annotations passed over by --ignore");
    }
    text + "\n"
}

fn export(args: &MarksExportArgs) -> Result<Outcome, Failure> {
    let study = load(&args.study)?;
    for part in ["cards", "marks"] {
        place::check_outside("--out", &args.out, &study, part)?;
    }
    let format = match args.format {
        MarksFormat::Coco => Format::Coco,
        MarksFormat::Cvat => Format::Cvat,
    };
    let (rater, out) = (args.rater.clone(), args.out.clone());
    let options = ExportOptions { rater, format, out, program: PROGRAM.to_owned() };
    let Exported { images, marks, refused } = exchange::export(&study, &options).map_err(failure)?;
    print_message(&reasons_text(&study.dir, "left out: ", &refused));
    if marks == 0 && !refused.is_empty() {
        return Err(Failure::Failed(anyhow!("none of the marks of '{}' could be used", args.rater)));
    }
    print(&format!("{marks} marks on {images} images in {}\n", args.out.display()))?;
    Ok(outcome(!refused.is_empty()))
}

fn load(study: &Path) -> Result<Study, Failure> {
    Study::load(study, |_| {}).map_err(Failure::usage)
}

fn failure(error: ExchangeError) -> Failure {
    match error {
        ExchangeError::Rater(_) | ExchangeError::Session { .. } | ExchangeError::NoMarks { .. } => {
            Failure::usage(error)
        }
        other => other.into(),
    }
}

/// The reasons for which marks were left out as text: each reason once, with every place in `file` that it holds for.
fn reasons_text(file: &Path, head: &str, refused: &[Refused]) -> String {
    let mut by_fact: Vec<(&str, Vec<&str>)> = Vec::new();
    let mut number_of = std::collections::HashMap::new();
    for Refused { place, fact } in refused {
        let number = *number_of.entry(fact.as_str()).or_insert_with(|| {
            by_fact.push((fact, Vec::new()));
            by_fact.len() - 1
        });
        by_fact[number].1.push(place);
    }
    let mut text = String::new();
    for (fact, places) in by_fact {
        let _ = writeln!(text, "{head}{fact}");
        for place in places {
            let _ = writeln!(text, "    {}: {place}", file.display());
        }
    }
    text
}
