//! Signals, selection, marks, measurement and fusion of one session; rayon over a study.
