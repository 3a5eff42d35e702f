//! A table as LaTeX, for papers: booktabs, with threeparttable for tables of a page and longtable for longer ones.

use super::display::{caption, cell, heading, printable, shown};
use crate::table::{Align, Column, Role, RowKind, Table, TableRow};

/// The greatest number of rows that stand on a page.
const MOST_ROWS_OF_A_PAGE: usize = 55;

/// The width of the widest table in each size of letters, in characters, for a text of 17 cm (A4 with margins of 2 cm); the
/// command of that size; and the command of the space beside columns.
const WIDTHS: [(usize, &str, &str); 3] =
    [(112, "\\footnotesize", "3pt"), (132, "\\scriptsize", "3pt"), (usize::MAX, "\\tiny", "1.5pt")];

type Columns<'a> = [(usize, &'a Column)];

/// The table as a LaTeX float, or, where it is longer than a page, as a table that goes on from page to page. The document needs
/// `\usepackage{booktabs,longtable,threeparttable}`, and pdflatex compiles it. Letters are as small as a text of 17 cm needs.
#[must_use]
pub fn latex(table: &Table) -> String {
    let columns = shown(table);
    let is_long = table.rows.len() > MOST_ROWS_OF_A_PAGE;
    let comment = format!("% {}\n", caption(table));
    comment + &if is_long { long(table, &columns) } else { float(table, &columns) }
}

fn float(table: &Table, columns: &Columns<'_>) -> String {
    let ([size, space], notes) = (size(table, columns), notes(table));
    // An empty list is an error in LaTeX.
    let notes = if notes.is_empty() { notes } else { format!("\\begin{{tablenotes}}\n{notes}\\end{{tablenotes}}\n") };
    format!(
        "% Needs \\usepackage{{booktabs,threeparttable}}.\n\\begin{{table}}[htbp]\n\\centering{size}\n\\begin{{threeparttable}}\n{}\n\\setlength{{\\tabcolsep}}{{{space}}}\n\\begin{{tabular}}{{{}}}\n\\toprule\n{}\\midrule\n{}\\bottomrule\n\\end{{tabular}}\n{notes}\\end{{threeparttable}}\n\\end{{table}}\n",
        captioned(table),
        alignments(columns),
        line(columns.iter().map(|(_, column)| stacked_heading(column))),
        body(table, columns),
    )
}

fn long(table: &Table, columns: &Columns<'_>) -> String {
    let [size, space] = size(table, columns);
    let heading = line(columns.iter().map(|(_, column)| stacked_heading(column)));
    format!(
        "% Needs \\usepackage{{booktabs,longtable,threeparttable}}.\n\\begingroup{size}\n\\setlength{{\\tabcolsep}}{{{space}}}\\setlength{{\\LTcapwidth}}{{\\linewidth}}\n\\begin{{longtable}}{{{}}}\n{}\\\\\n\\toprule\n{heading}\\midrule\n\\endfirsthead\n\\toprule\n{heading}\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n{}\\end{{longtable}}\n\\begin{{tablenotes}}\n\\item[] \n{}\\end{{tablenotes}}\n\\endgroup\n",
        alignments(columns),
        captioned(table),
        body(table, columns),
        notes(table),
    )
}

/// The title, with the definitions of the statistics. The number is left out: a float numbers itself, and 'Table II.' would
/// stand there twice.
fn captioned(table: &Table) -> String {
    let title = printable(&table.title);
    let statistic = escaped(&printable(&table.statistic));
    format!("\\caption{{{}. {statistic}}}\n\\label{{tab:{}}}", escaped(title.trim_end_matches('.')), label(&table.stem))
}

fn body(table: &Table, columns: &Columns<'_>) -> String {
    let mut text = String::new();
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
    text
}

/// The commands of the largest letters in which the table is not wider than a text of 17 cm, and of the space beside columns.
fn size(table: &Table, columns: &Columns<'_>) -> [&'static str; 2] {
    let length = |text: &str| text.chars().count();
    let width = |(place, column): (usize, &(usize, &Column))| {
        let words = heading(column.1);
        let longest_word = words.split_whitespace().map(length).max().unwrap_or(0);
        let of_row = |row: &TableRow| length(&cell(table, row, place, *column));
        let of_rows = if column.1.role == Role::Note { 0 } else { table.rows.iter().map(of_row).max().unwrap_or(0) };
        longest_word.max(of_rows) + 2
    };
    let all: usize = columns.iter().enumerate().map(width).sum();
    WIDTHS.iter().find(|(widest, ..)| all <= *widest).map_or(["", ""], |(_, size, space)| [size, space])
}

fn alignments(columns: &Columns<'_>) -> String {
    columns.iter().map(|(_, column)| alignment(column)).collect()
}

/// The column type of LaTeX: sentences wrap; names and numbers do not.
fn alignment(column: &Column) -> &'static str {
    match (column.role, column.align) {
        (Role::Note, _) => "p{0.45\\linewidth}",
        (_, Align::Left) => "l",
        (_, Align::Right) => "r",
    }
}

/// The heading with a word per line, since columns of numbers are narrow.
fn stacked_heading(column: &Column) -> String {
    let side = if column.align == Align::Left { 'l' } else { 'r' };
    let words: Vec<String> = heading(column).split_whitespace().map(escaped).collect();
    format!("\\shortstack[{side}]{{{}}}", words.join("\\\\"))
}

/// Footnotes and remarks as items of a LaTeX list.
fn notes(table: &Table) -> String {
    let mut items = String::new();
    for footnote in &table.footnotes {
        items.push_str(&format!("\\item[{}] {}\n", footnote.mark, escaped(&printable(&footnote.text))));
    }
    for remark in table.remarks.iter().chain(&table.statement) {
        items.push_str(&format!("\\item[] {}\n", escaped(&printable(remark))));
    }
    items
}

fn line(cells: impl Iterator<Item = String>) -> String {
    // The empty group is for cells that begin with '[', which would be taken as the argument of the \\ before them.
    format!("{{}}{} \\\\\n", cells.collect::<Vec<_>>().join(" & "))
}

/// The text of a cell. Numbers get the minus sign of mathematics.
fn shown_cell(text: &str, align: Align) -> String {
    let escaped = escaped(text);
    match (align, escaped.strip_prefix('-')) {
        (Align::Right, Some(number)) => format!("$-${number}"),
        _ => escaped,
    }
}

/// A label of those characters that no package makes active.
fn label(stem: &str) -> String {
    stem.chars().map(|character| if character.is_ascii_alphanumeric() { character } else { '-' }).collect()
}

/// The text, escaped so that it prints as it is. A character without a glyph in pdflatex's default fonts prints as its code
/// point.
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

/// Whether pdflatex composes the letter in its default encoding (OT1) without further packages. It does so for Latin-1 and
/// Latin Extended-A, apart from letters with an ogonek, eth, thorn, eng, bars and ligatures.
fn is_accented_latin(character: char) -> bool {
    const NO_GLYPH: &str = "\u{d0}\u{de}\u{f0}\u{fe}\u{104}\u{105}\u{110}\u{111}\u{118}\u{119}\u{126}\u{127}\u{12e}\u{12f}\u{138}\u{13f}\u{140}\u{149}\u{14a}\u{14b}\u{166}\u{167}\u{172}\u{173}\u{17f}";
    matches!(character, '\u{c0}'..='\u{17f}') && !NO_GLYPH.contains(character)
}
