//! The repository itself: the dependency rule between the crates holds, and the documents agree with the files, commands and
//! links that they name. Nothing is measured here.

mod documents;
mod layers;
