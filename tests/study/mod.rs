//! Whole studies through `run` and `report`: sizes by every method, with marks of people and with rims that the program found,
//! and what is made of them (tables, figures, page, pictures, annotated recordings). The studies are the sample that ships with
//! the program, the preset `large`, and small ones whose truth is exact.

mod annotate;
mod auto;
mod corrected;
mod figures;
mod flow;
mod four_corners;
mod gallery;
mod large;
pub mod methods;
mod misplaced;
mod names;
mod published_bench;
mod squares;
mod turned;
mod unicode;
