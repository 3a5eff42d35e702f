//! Readings of a range sensor that say 'no target'.

use crate::profile::NoTarget;

/// The reading that a recording holds for 'no target', mm, unless it is one of [`CODES_MM`] already.
const RECORDED_MM: f64 = 8190.0;
/// The codes of the VL53L0X itself, mm (ST UM2039: out of range). Drivers scale them like any reading: 819.0 cm, 8.19 m.
const CODES_MM: [f64; 2] = [8190.0, 8191.0];
/// What drivers give for a measurement that failed or timed out: Pololu's VL53L0X library 65535, others -1; some scale them.
const FAILURES: [f64; 2] = [65535.0, -1.0];
/// What drivers and loggers write for it: Adafruit's VL53L1X in Python gives `None`; ROS writes an infinite range (REP 117).
const WORDS: [&str; 8] = ["none", "null", "inf", "+inf", "-inf", "infinity", "+infinity", "-infinity"];
/// Numbers that differ by less, as a part of themselves, are the same: a reading may have been a 32-bit float.
const SAME_PART: f64 = 1e-6;
/// A word in a file stands for this count until it becomes a range.
pub(super) const WORD_COUNT: f64 = f64::INFINITY;

/// The readings that say 'no target': those that the profile declares, or those of the usual drivers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct NoTargetReadings(Option<Vec<NoTarget>>);

impl NoTargetReadings {
    /// The readings that `declared` names; those of the usual drivers where it is none.
    #[must_use]
    pub fn new(declared: Option<Vec<NoTarget>>) -> Self {
        Self(declared)
    }

    /// The range in mm that a recording holds for that count.
    pub(super) fn recorded_mm(&self, count: f64, mm_per_count: f64) -> f64 {
        let mm = count * mm_per_count;
        match CODES_MM.into_iter().find(|code| is_same(*code, mm)) {
            Some(code) if self.is_no_target(count, mm) => code,
            None if self.is_no_target(count, mm) => RECORDED_MM,
            _ => mm,
        }
    }

    fn is_no_target(&self, count: f64, mm: f64) -> bool {
        let Some(declared) = &self.0 else {
            return count.is_infinite()
                || CODES_MM.iter().any(|code| is_same(*code, mm))
                || FAILURES.iter().any(|code| is_same(*code, count) || is_same(*code, mm));
        };
        count.is_infinite() || declared.iter().filter_map(NoTarget::number).any(|code| is_same(code, count))
    }

    /// Whether the text of a field is a word that says 'no target'.
    pub(super) fn is_word(&self, field: &[u8]) -> bool {
        let is_field = |word: &str| word.trim().as_bytes().eq_ignore_ascii_case(field);
        match &self.0 {
            None => WORDS.into_iter().any(is_field),
            Some(declared) => declared.iter().any(|code| matches!(code, NoTarget::Word(word) if is_field(word))),
        }
    }
}

fn is_same(code: f64, value: f64) -> bool {
    (code - value).abs() <= SAME_PART * code.abs()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "codes are exact")]
    use super::*;

    fn word(text: &str) -> NoTarget {
        NoTarget::Word(text.to_owned())
    }

    #[test]
    fn what_the_usual_drivers_write_is_no_target_in_every_unit() {
        let usual = NoTargetReadings::default();
        for (count, mm_per_count) in [(8190.0, 1.0), (819.0, 10.0), (8.19, 1000.0), (f64::from(8.19_f32), 1000.0)] {
            assert_eq!(usual.recorded_mm(count, mm_per_count), 8190.0, "{count} x {mm_per_count}");
        }
        assert_eq!(usual.recorded_mm(819.1, 10.0), 8191.0);
        for (count, mm_per_count) in
            [(65535.0, 1.0), (65535.0, 10.0), (6553.5, 10.0), (-1.0, 1.0), (-1.0, 10.0), (-0.1, 10.0)]
        {
            assert_eq!(usual.recorded_mm(count, mm_per_count), 8190.0, "{count} x {mm_per_count}");
        }
    }

    #[test]
    fn a_reading_that_only_looks_like_a_code_stays() {
        let usual = NoTargetReadings::default();
        assert_eq!(usual.recorded_mm(8190.0, 0.1), 819.0); // tenths of a millimetre
        assert_eq!(usual.recorded_mm(819.0, 1.0), 819.0);
        assert_eq!(usual.recorded_mm(0.0, 1.0), 0.0);
    }

    #[test]
    fn a_declared_list_takes_the_place_of_the_usual_one() {
        let declared =
            NoTargetReadings::new(Some(vec![NoTarget::Number(0.0), NoTarget::Number(4000.0), word("OOR"), word("-2")]));
        assert_eq!([0.0, 4000.0, -2.0, WORD_COUNT].map(|count| declared.recorded_mm(count, 0.25)), [8190.0; 4]);
        assert_eq!(declared.recorded_mm(65535.0, 0.01), 655.35);
        assert!(declared.is_word(b"oor") && !declared.is_word(b"None"));
        assert!(NoTargetReadings::default().is_word(b"None") && !NoTargetReadings::default().is_word(b"OOR"));
    }
}
