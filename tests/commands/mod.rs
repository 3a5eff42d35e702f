//! Every command apart from `run` and `report`, on small input of its own: `calibrate`, `check`, `ingest` and `measure`, `inspect`,
//! `marks`, `project`, and `simulate` with a scene file. What they print, what they write, what they refuse, and their exit codes.

mod calibrate;
mod check;
mod inspect;
mod marks;
mod measure;
mod project;
mod scene;
