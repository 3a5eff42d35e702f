//! Style and script of the page, which are part of the program.

/// The style sheet.
pub(super) const STYLE: &str = concat!(
    include_str!("../../assets/style/base.css"),
    include_str!("../../assets/style/layout.css"),
    include_str!("../../assets/style/tables.css"),
    include_str!("../../assets/style/viewer.css"),
    include_str!("../../assets/style/print.css"),
);

/// The script: all of its files in one scope. The last one starts it.
pub(super) const SCRIPT: &str = concat!(
    "(() => {\n\"use strict\";\n",
    include_str!("../../assets/script/dom.js"),
    include_str!("../../assets/script/theme.js"),
    include_str!("../../assets/script/sections.js"),
    include_str!("../../assets/script/rows.js"),
    include_str!("../../assets/script/headers.js"),
    include_str!("../../assets/script/static_tables.js"),
    include_str!("../../assets/script/grid.js"),
    include_str!("../../assets/script/pictures.js"),
    include_str!("../../assets/script/filters.js"),
    include_str!("../../assets/script/measurements.js"),
    include_str!("../../assets/script/sheet.js"),
    include_str!("../../assets/script/viewer.js"),
    include_str!("../../assets/script/examples.js"),
    include_str!("../../assets/script/main.js"),
    "})();\n",
);
