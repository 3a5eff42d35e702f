//! Writes figures as files.

use std::io;
use std::path::Path;

use super::Figures;
use crate::atomic;
use crate::render::markdown_text;
use crate::write_dir::WriteError;

/// Writes every figure as a file of its own, `DIR/figures/NAME.svg`, on white ground, and `DIR/figures/figures.md` with their
/// captions and the list of the figures that were left out. Makes the folder where there is none; every file is written aside
/// and renamed. Removes the file of an earlier run for a figure that is now left out.
///
/// # Errors
/// [`WriteError::Folder`], [`WriteError::File`] and [`WriteError::OldFigure`].
pub fn write_figures(figures: &Figures, dir: &Path) -> Result<(), WriteError> {
    let folder = dir.join("figures");
    std::fs::create_dir_all(&folder).map_err(|source| WriteError::Folder { path: folder.clone(), source })?;
    for (figure, standalone) in figures.drawn.iter().zip(&figures.standalone) {
        atomic::write(&folder.join(format!("{}.svg", figure.name)), standalone.as_bytes())?;
    }
    for left_out in &figures.left_out {
        let path = folder.join(format!("{}.svg", left_out.name));
        match std::fs::remove_file(&path) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => {
                return Err(WriteError::OldFigure { path, source });
            }
            _ => {}
        }
    }
    Ok(atomic::write(&folder.join("figures.md"), captions(figures).as_bytes())?)
}

/// The figures with their captions, as a Markdown document.
fn captions(figures: &Figures) -> String {
    let mut text = "# Figures\n".to_owned();
    if let Some(statement) = &figures.statement {
        text.push_str(&format!("\n{}\n", markdown_text(statement)));
    }
    for figure in &figures.drawn {
        let [title, alt, caption] = [&figure.title, &figure.alt, &figure.caption].map(|text| markdown_text(text));
        text.push_str(&format!("\n## {title}\n\n![{alt}]({}.svg)\n\n{caption}\n", figure.name));
    }
    if !figures.left_out.is_empty() {
        text.push_str("\n## Not drawn\n\n");
    }
    for left_out in &figures.left_out {
        text.push_str(&format!("- {}: {}\n", markdown_text(left_out.title), markdown_text(left_out.reason)));
    }
    text
}
