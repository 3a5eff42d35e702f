//! Histograms on a line of text.

use pipeline::inspect::Histogram;

use super::words::count;

const BARS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// Stands in place of a bar where a bin has no count.
const NONE: char = '·';

/// A histogram as `0 |··▁█▃·| 30 deg`, one character per bin. The bar of a bin is as high as its share of the largest count,
/// rounded up, so that no bin with a count vanishes.
pub fn sparkline(histogram: &Histogram, unit: &str) -> String {
    let largest = histogram.counts.iter().copied().max().unwrap_or(0).max(1);
    let top = BARS.len() as u64;
    let bar = |count: &u64| match *count {
        0 => NONE,
        // In 128 bits, since 8 times a count may not fit 64.
        count => {
            let height = (u128::from(count) * u128::from(top)).div_ceil(u128::from(largest));
            BARS[usize::try_from(height).map_or(0, |height| height.clamp(1, BARS.len()) - 1)]
        }
    };
    let bars: String = histogram.counts.iter().map(bar).collect();
    format!("{} |{bars}| {} {unit}, {} {unit} each", histogram.from, histogram.to, histogram.bin_width)
}

/// A histogram in words: the number of values, the bin that holds most of them, and the numbers of those outside.
#[expect(clippy::cast_precision_loss, reason = "for people, who read two digits")]
pub fn in_words(histogram: &Histogram, unit: &str, what: &str) -> String {
    let mut words = count(histogram.total(), what);
    let most = histogram.counts.iter().copied().max().unwrap_or(0);
    // Of equal counts, the first.
    if let Some(bin) = histogram.counts.iter().position(|count| most > 0 && *count == most) {
        let from = histogram.from + bin as f64 * histogram.bin_width;
        let pct = 100.0 * most as f64 / histogram.total() as f64;
        words.push_str(&format!("; most, {pct:.0} %, at {from} to {} {unit}", from + histogram.bin_width));
    }
    let outside = [("below", histogram.from, histogram.below), ("above", histogram.to, histogram.above)];
    for (side, edge, number) in outside.into_iter().filter(|(_, _, number)| *number > 0) {
        words.push_str(&format!("; {number} {side} {edge}"));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn histogram(values: &[f64]) -> Histogram {
        let mut histogram = Histogram::new(0.0, 10.0, 4);
        values.iter().for_each(|value| histogram.add(*value));
        histogram
    }

    #[test]
    fn what_is_there_is_seen_and_what_is_not_is_not() {
        assert_eq!(sparkline(&histogram(&[]), "deg"), "0 |····| 40 deg, 10 deg each");
        let mut many = histogram(&[5.0, 35.0, 35.0]);
        many.counts[1] = 1000;
        many.counts[3] = 500;
        assert_eq!(sparkline(&many, "deg"), "0 |▁█·▄| 40 deg, 10 deg each");
    }

    #[test]
    fn words_say_where_most_are_and_what_is_outside() {
        assert_eq!(in_words(&histogram(&[]), "deg", "second"), "0 seconds");
        let words = in_words(&histogram(&[-1.0, 12.0, 13.0, 22.0]), "deg", "second");
        assert_eq!(words, "4 seconds; most, 50 %, at 10 to 20 deg; 1 below 0");
        assert_eq!(in_words(&histogram(&[41.0]), "mm", "reading"), "1 reading; 1 above 40");
    }
}
