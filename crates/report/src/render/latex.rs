//! For papers: booktabs and threeparttable.

use super::display::{caption, cell, heading, printable, shown};
use crate::table::{Align, Column, Role, RowKind, Table};

/// The table as a LaTeX float. The document needs `\usepackage{booktabs,threeparttable}`; pdflatex compiles it.
#[must_use]
pub fn latex(table: &Table) -> String {
    let columns = shown(table);
    let alignment: String = columns.iter().map(|(_, column)| alignment(column)).collect();
    // The float numbers itself; 'Table II.' would stand there twice. The file and the label say which it is.
    let title = printable(&table.title);
    let mut text = format!(
        "% {}\n% Needs \\usepackage{{booktabs,threeparttable}}.\n\\begin{{table}}[htbp]\n\\centering\\footnotesize\n\\begin{{threeparttable}}\n\\caption{{{}. {}}}\n\\label{{tab:{}}}\n\\setlength{{\\tabcolsep}}{{3pt}}\n\\begin{{tabular}}{{{alignment}}}\n\\toprule\n",
        caption(table),
        escaped(title.trim_end_matches('.')),
        escaped(&printable(&table.statistic)),
        label(&table.stem),
    );
    text.push_str(&line(columns.iter().map(|(_, column)| stacked_heading(column))));
    text.push_str("\\midrule\n");
    for (index, row) in table.rows.iter().enumerate() {
        let after_mean = index > 0 && table.rows[index - 1].kind == RowKind::ObjectMean;
        let begins_overall = row.kind == RowKind::Overall && index > 0;
        if after_mean || begins_overall {
            text.push_str("\\midrule\n");
        }
        text.push_str(&line(columns.iter().enumerate().map(|(place, column)| {
            let text = shown_cell(&cell(table, row, place, *column), column.1.align);
            if place == 0 && !row.marks.is_empty() { format!("{text}\\tnote{{{}}}", row.marks.join(",")) } else { text }
        })));
    }
    text.push_str("\\bottomrule\n\\end{tabular}\n");
    text.push_str(&notes(table));
    text.push_str("\\end{threeparttable}\n\\end{table}\n");
    text
}

/// Sentences wrap; names and numbers do not.
fn alignment(column: &Column) -> &'static str {
    match (column.role, column.align) {
        (Role::Note, _) => "p{0.45\\linewidth}",
        (_, Align::Left) => "l",
        (_, Align::Right) => "r",
    }
}

/// The heading with a word per line: columns of numbers are narrow.
fn stacked_heading(column: &Column) -> String {
    let side = if column.align == Align::Left { 'l' } else { 'r' };
    let words: Vec<String> = heading(column).split_whitespace().map(escaped).collect();
    format!("\\shortstack[{side}]{{{}}}", words.join("\\\\"))
}

fn notes(table: &Table) -> String {
    let mut items = String::new();
    for footnote in &table.footnotes {
        items.push_str(&format!("\\item[{}] {}\n", footnote.mark, escaped(&printable(&footnote.text))));
    }
    for remark in table.remarks.iter().chain(&table.statement) {
        items.push_str(&format!("\\item[] {}\n", escaped(&printable(remark))));
    }
    // An empty list is an error in LaTeX.
    if items.is_empty() { items } else { format!("\\begin{{tablenotes}}\n{items}\\end{{tablenotes}}\n") }
}

fn line(cells: impl Iterator<Item = String>) -> String {
    // An empty group: a cell that begins with '[' would be taken as the argument of the \\ before it.
    format!("{{}}{} \\\\\n", cells.collect::<Vec<_>>().join(" & "))
}

/// Numbers get the minus sign of mathematics.
fn shown_cell(text: &str, align: Align) -> String {
    let escaped = escaped(text);
    match (align, escaped.strip_prefix('-')) {
        (Align::Right, Some(number)) => format!("$-${number}"),
        _ => escaped,
    }
}

/// A label's characters that no package makes active.
fn label(stem: &str) -> String {
    stem.chars().map(|character| if character.is_ascii_alphanumeric() { character } else { '-' }).collect()
}

/// Text that prints as it is. What pdflatex has no glyph for in its default fonts prints as its code point.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '<' => escaped.push_str("\\textless{}"),
            '>' => escaped.push_str("\\textgreater{}"),
            '|' => escaped.push_str("\\textbar{}"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                escaped.push('\\');
                escaped.push(character);
            }
            '\u{b1}' => escaped.push_str("$\\pm$"),
            '\u{b0}' => escaped.push_str("$^\\circ$"),
            '\u{b5}' => escaped.push_str("$\\mu$"),
            '\u{d7}' => escaped.push_str("$\\times$"),
            '\u{2212}' => escaped.push_str("$-$"),
            '\u{2013}' => escaped.push_str("--"),
            '\u{2014}' => escaped.push_str("---"),
            ' '..='~' => escaped.push(character),
            character if is_accented_latin(character) => escaped.push(character),
            character => escaped.push_str(&format!("\\texttt{{U+{:04X}}}", u32::from(character))),
        }
    }
    escaped
}

/// Letters that pdflatex composes in its default encoding (OT1) without further packages: Latin-1 and Latin Extended-A
/// but for those with an ogonek, eth, thorn, eng, bars and ligatures.
fn is_accented_latin(character: char) -> bool {
    const NO_GLYPH: &str = "\u{d0}\u{de}\u{f0}\u{fe}\u{104}\u{105}\u{110}\u{111}\u{118}\u{119}\u{126}\u{127}\u{12e}\u{12f}\u{138}\u{13f}\u{140}\u{149}\u{14a}\u{14b}\u{166}\u{167}\u{172}\u{173}\u{17f}";
    matches!(character, '\u{c0}'..='\u{17f}') && !NO_GLYPH.contains(character)
}
