//! Scales, which turn values into places on the page, and the ticks of axes.

use jiff::Timestamp;
use jiff::tz::TimeZone;

use super::words::number;

/// A value at an axis, with its label.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: String,
}

/// A map from the values of a domain to the places of a range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    domain: [f64; 2],
    range: [f64; 2],
    logarithmic: bool,
}

impl Scale {
    /// A linear scale. Both ends of the domain must be finite, and differ.
    pub(super) fn linear(domain: [f64; 2], range: [f64; 2]) -> Self {
        Self { domain, range, logarithmic: false }
    }

    /// A logarithmic scale. Both ends of the domain must be positive and finite, and differ.
    pub(super) fn logarithmic(domain: [f64; 2], range: [f64; 2]) -> Self {
        Self { domain: domain.map(f64::log10), range, logarithmic: true }
    }

    /// The place of a value. A value beyond the domain has the place of the nearer end.
    pub(super) fn place(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.max(f64::MIN_POSITIVE).log10() } else { value };
        let [low, high] = self.domain;
        let share = ((value - low) / (high - low)).clamp(0.0, 1.0);
        self.range[0] + share * (self.range[1] - self.range[0])
    }

    pub(super) const fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Whether a value lies in the domain.
    pub(super) fn holds(&self, value: f64) -> bool {
        let value = if self.logarithmic { value.max(f64::MIN_POSITIVE).log10() } else { value };
        (self.domain[0]..=self.domain[1]).contains(&value)
    }

    /// About `most` ticks at round values.
    pub(super) fn ticks(&self, most: usize) -> Vec<Tick> {
        if self.logarithmic {
            return log_ticks(self.domain);
        }
        // One tick does not make a scale, so the step is finer where round values are few.
        let all = (most..most + 4).map(|most| linear_ticks(self.domain, most));
        all.reduce(|found, finer| if found.len() < 3 { finer } else { found }).unwrap_or_default()
    }
}

/// The smallest of 1, 2 and 5 times a power of ten that cuts `span` into at most `most` parts.
#[expect(clippy::cast_precision_loss, reason = "a handful of ticks")]
fn round_step(span: f64, most: usize) -> f64 {
    let least = span / most.max(1) as f64;
    let power = 10_f64.powf(least.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| factor * power >= least * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a handful of ticks and decimals")]
fn linear_ticks([low, high]: [f64; 2], most: usize) -> Vec<Tick> {
    let step = round_step(high - low, most);
    let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
    let first = (low / step - 1e-9).ceil();
    let many = ((high / step + 1e-9).floor() - first).clamp(0.0, 50.0) as u32;
    let values = (0..=many).map(|i| (first + f64::from(i)) * step);
    values.map(|value| Tick { value, label: label(value, decimals) }).collect()
}

/// The label of a tick. Large numbers have powers of ten, since there is no room for their zeros.
fn label(value: f64, decimals: usize) -> String {
    if value.abs() >= 1e6 { format!("{value:e}").replace('-', "\u{2212}") } else { number(value, decimals) }
}

/// Ticks at 1, 2 and 5 times powers of ten over a short domain, and at powers of ten alone over a long one. The ends of the
/// domain are logarithms.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "decades of millimetres")]
fn log_ticks([low, high]: [f64; 2]) -> Vec<Tick> {
    let (first, last) = (low.floor() as i32, high.ceil() as i32);
    let decades = high - low;
    let factors: &[f64] = if decades <= 2.2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let every = ((decades / 6.0).ceil() as i32).max(1);
    let mut ticks = Vec::new();
    for power in (first..=last).filter(|power| power.rem_euclid(every) == 0) {
        for factor in factors {
            let value = factor * 10_f64.powi(power);
            if (low - 1e-9..=high + 1e-9).contains(&value.log10()) {
                ticks.push(Tick { value, label: number(value, (-power).max(0) as usize) });
            }
        }
    }
    ticks
}

/// Steps of time that people read easily, in seconds.
const TIME_STEPS_S: [f64; 23] = [
    1.0,
    2.0,
    5.0,
    10.0,
    15.0,
    30.0,
    60.0,
    120.0,
    300.0,
    600.0,
    900.0,
    1800.0,
    3600.0,
    7200.0,
    10_800.0,
    21_600.0,
    43_200.0,
    86_400.0,
    172_800.0,
    604_800.0,
    2_592_000.0,
    31_536_000.0,
    315_360_000.0,
];

/// Ticks of a time axis in UTC, at most about `most`, from `low` to `high` in seconds of POSIX time.
pub(super) fn time_ticks([low, high]: [f64; 2], most: usize) -> Vec<Tick> {
    #[expect(clippy::cast_precision_loss, reason = "a handful of ticks")]
    let least = (high - low) / most.max(1) as f64;
    let step = TIME_STEPS_S.into_iter().find(|step| *step >= least).unwrap_or(TIME_STEPS_S[22]);
    let form = if step >= 86_400.0 {
        "%m-%d"
    } else if step >= 60.0 {
        "%H:%M"
    } else {
        "%H:%M:%S"
    };
    let first = (low / step).ceil();
    let values = (0..50).map(|i| (first + f64::from(i)) * step).take_while(|value| *value <= high);
    values.map(|value| Tick { value, label: time(value, form) }).collect()
}

/// A time in UTC as text of the form `form` (strftime).
#[expect(clippy::cast_possible_truncation, reason = "seconds of a time that jiff checks")]
pub(super) fn time(posix_s: f64, form: &str) -> String {
    let stamp = Timestamp::from_second(posix_s.round() as i64).map(|stamp| stamp.to_zoned(TimeZone::UTC));
    stamp.map_or_else(|_| String::new(), |zoned| zoned.strftime(form).to_string())
}

/// The smallest interval that holds the values and, on either side, `margin` times their extent. A single value has some room
/// around it. None where there are no values.
pub(super) fn padded(values: impl IntoIterator<Item = f64>, margin: f64) -> Option<[f64; 2]> {
    let [low, high] = extremes(values)?;
    let span = high - low;
    let room = if span > 1e-9 * (1.0 + low.abs().max(high.abs())) { margin * span } else { 0.1 * low.abs().max(1.0) };
    Some([low - room, high + room])
}

/// The smallest and the largest of the values; none where there are no values.
pub(super) fn extremes(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let ends = |ends: Option<[f64; 2]>, value: f64| match ends {
        None => Some([value, value]),
        Some([low, high]) => Some([low.min(value), high.max(value)]),
    };
    values.into_iter().filter(|value| is_drawable(*value)).fold(None, ends)
}

/// Whether a figure can hold the number: it is finite, and small enough that differences keep their digits.
pub(super) fn is_drawable(value: f64) -> bool {
    value.is_finite() && value.abs() <= 1e12
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|tick| tick.label.as_str()).collect()
    }

    #[test]
    fn ticks_are_round() {
        assert_eq!(labels(&Scale::linear([-7.0, 13.0], [0.0, 1.0]).ticks(4)), ["\u{2212}5", "0", "5", "10"]);
        assert_eq!(labels(&Scale::linear([0.0, 0.11], [0.0, 1.0]).ticks(3)), ["0.00", "0.05", "0.10"]);
        assert_eq!(labels(&Scale::logarithmic([0.4, 30.0], [0.0, 1.0]).ticks(9)), ["0.5", "1", "2", "5", "10", "20"]);
        assert_eq!(labels(&time_ticks([1_614_610_800.0, 1_614_610_865.0], 4)), ["15:00:00", "15:00:30", "15:01:00"]);
        assert_eq!(time(1_614_610_800.0, "%Y-%m-%d"), "2021-03-01");
        assert_eq!(padded([], 0.1), None);
        assert_eq!(padded([f64::NAN, 5.0, f64::INFINITY], 0.1), Some([4.5, 5.5]));
    }

    proptest! {
        #[test]
        fn places_keep_their_order_and_stay_in_the_range(mut a in prop::array::uniform3(-1e9..1e9_f64), most in 1..12_usize) {
            a.sort_by(f64::total_cmp);
            let domain = padded([a[0], a[2]], 0.05).unwrap();
            let scale = Scale::linear(domain, [300.0, 20.0]);
            let places = a.map(|value| scale.place(value));
            prop_assert!(places[0] >= places[1] && places[1] >= places[2], "{places:?}");
            prop_assert!(places.iter().all(|place| (20.0..=300.0).contains(place)));
            let ticks = scale.ticks(most);
            prop_assert!(ticks.len() <= most + 5, "{ticks:?}");
            prop_assert!(ticks.iter().all(|tick| tick.value >= domain[0] - 1.0 && tick.value <= domain[1] + 1.0));
        }

        #[test]
        fn logarithmic_places_too(value in 1e-6..1e6_f64, low in 1e-6..1.0_f64) {
            let scale = Scale::logarithmic([low, low * 1e4], [0.0, 100.0]);
            prop_assert!((0.0..=100.0).contains(&scale.place(value)));
            prop_assert!((scale.place(low * 1e2) - 50.0).abs() < 1e-6);
            prop_assert!(!scale.ticks(5).is_empty());
        }
    }
}
