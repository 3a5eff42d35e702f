//! The repository itself: the dependency rules hold, between the crates and between the modules of pipeline, and the documents
//! agree with the files, commands and links that they name. Nothing is measured here.

mod documents;
mod layers;
mod module_layers;
