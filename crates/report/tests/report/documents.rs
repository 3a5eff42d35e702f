//! Tables in the programs that read them: pdflatex and pandoc. `.ci/documents` installs both and runs this.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use model::TableLayout;
use report::{FigureLeftOut, Figures, Table, accuracy, latex, markdown, sizes, tables};

use crate::bench;
use crate::figures::HOSTILE;

/// Tables in which every name that a person can choose is one that means something to LaTeX or Markdown.
fn hostile_tables() -> Vec<Table> {
    let long = "a name without end ".repeat(30);
    let mut all = Vec::new();
    for (index, name) in HOSTILE.iter().copied().chain([long.as_str()]).enumerate() {
        let mut spec = bench::spec(&index.to_string(), TableLayout::Setups, &[]);
        spec.title = name.to_owned();
        spec.notes = vec![bench::note(Some(name), None, name)];
        let fused = bench::fused(name, name, Some(51.0), 50.0);
        let rows = vec![bench::plate(name, true, Some(190.0), 200.0), fused];
        let mut results = bench::results(rows, vec![spec]);
        results.metadata.statement = Some(name.to_owned());
        results.rows.iter_mut().for_each(|row| row.session = name.to_owned());
        all.extend(tables(&results));
        all.extend([sizes(&results), accuracy(&results)]);
    }
    all
}

fn ran(program: &str, arguments: &[&str], folder: &Path) -> String {
    let output = Command::new(program).args(arguments).current_dir(folder).output();
    let output = output.unwrap_or_else(|error| panic!("cannot run {program}: {error}"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{program}:\n{text}\n{}", String::from_utf8_lossy(&output.stderr));
    text
}

#[test]
#[ignore = "needs pdflatex with threeparttable: .ci/documents"]
fn pdflatex_compiles_every_name() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = "\\documentclass{article}\n\\usepackage[a4paper,margin=2cm]{geometry}\n\
                    \\usepackage{booktabs,longtable,threeparttable}\n\\begin{document}\n"
        .to_owned();
    let mut all = hostile_tables();
    // Longer than a page.
    for table in &mut all[..3] {
        table.rows = table.rows.iter().cycle().take(200).cloned().collect();
    }
    for table in &all {
        let _ = writeln!(text, "{}\\clearpage", latex(table));
    }
    std::fs::write(folder.path().join("all.tex"), text + "\\end{document}\n").unwrap();
    let log = ran("pdflatex", &["-interaction=nonstopmode", "-halt-on-error", "all.tex"], folder.path());
    assert!(!log.contains("Missing character"), "{log}");
    let pages = log.split("Output written on all.pdf (").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
    assert!(pages.parse::<usize>().unwrap() >= all.len() + 3, "each begins a page, and three are longer:\n{log}");
}

#[test]
#[ignore = "needs pandoc: .ci/documents"]
fn pandoc_reads_every_name_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let all = hostile_tables();
    let text: Vec<String> = all.iter().map(markdown).collect();
    std::fs::write(folder.path().join("all.md"), text.join("\n")).unwrap();
    for reader in ["gfm", "markdown"] {
        let html = ran("pandoc", &["-f", reader, "-t", "html", "--wrap=none", "all.md"], folder.path());
        assert_eq!(html.matches("<table").count(), all.len(), "{reader}:\n{html}");
        assert!(!html.contains("<script>") && !html.contains("<math") && !html.contains("math inline"), "{html}");
        assert!(html.contains("&lt;script&gt;alert(1)&lt;/script&gt;"), "{reader}:\n{html}");
        assert!(html.contains(r"_%$#{}~^\ $x^2$"), "{reader}:\n{html}");
    }
}

#[test]
fn captions_of_figures_mean_nothing_to_markdown() {
    let folder = tempfile::tempdir().unwrap();
    let left_out = vec![FigureLeftOut { name: "flow", title: "Flow", reason: "*none*" }];
    let mut figures = Figures::default();
    figures.left_out = left_out;
    figures.statement = Some(HOSTILE[0].to_owned());
    report::write_figures(&figures, folder.path()).unwrap();
    let text = std::fs::read_to_string(folder.path().join("figures/figures.md")).unwrap();
    assert_eq!(text, "# Figures\n\n&lt;script&gt;alert(1)&lt;/script&gt;\n\n## Not drawn\n\n- Flow: \\*none\\*\n");
}
