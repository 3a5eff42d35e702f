//! Tests of the table of fused sizes.

use report::{csv, sizes};

use crate::bench;

#[test]
fn every_fused_size_has_its_row_and_single_images_have_none() {
    let table = sizes(&bench::raters());
    let fused = bench::raters().rows.iter().filter(|row| row.level == model::Level::Fused).count();
    assert!(fused > 0 && table.rows.len() == fused);
    let text = csv(&table);
    assert!(text.starts_with("session,object,rater,quantity,method,images,predicted_mm,sigma_mm,"), "{text}");
    assert!(text.contains("\ns2,box,anna,"), "{text}");
    assert!(sizes(&bench::plates()).rows.is_empty());
    assert!(sizes(&bench::plates()).remarks[0].contains("frames.parquet"));
}
