//! Times, durations and numbers, as people read them.

use pipeline::inspect::{LocalSpan, Moment};

/// Number of columns before the words of a line.
pub const MARGIN: usize = 16;

/// Appends a line with a name, indented by `depth` columns, and words after the margin.
pub fn line(text: &mut String, depth: usize, name: &str, words: &str) {
    let name = format!("{:depth$}{name}", "");
    // A long name keeps one space of distance.
    let gap = if name.chars().count() < MARGIN { "" } else { " " };
    let width = MARGIN;
    text.push_str(&format!("{name:width$}{gap}{words}\n"));
}

/// Appends a line that goes on with the one before.
pub fn more(text: &mut String, words: &str) {
    line(text, 0, "", words);
}

/// A local time as `2021-03-01 09:00:10.250 -06:00`.
pub fn moment(moment: &Moment) -> String {
    moment.0.strftime("%Y-%m-%d %H:%M:%S%.3f %:z").to_string()
}

/// The two ends of a span and the time between them; two lines where the ends differ in day or UTC offset.
pub fn span(span: &LocalSpan) -> Vec<String> {
    let (from, to) = (&span.from.0, &span.to.0);
    let length = duration(span.duration_s);
    if from.date() == to.date() && from.offset() == to.offset() {
        let from = from.strftime("%Y-%m-%d %H:%M:%S%.3f");
        return vec![format!("{from} to {}, {length}", to.strftime("%H:%M:%S%.3f %:z"))];
    }
    vec![format!("{} to", moment(&span.from)), format!("{}, {length}", moment(&span.to))]
}

/// Appends one or two lines with a span, or `nothing` where there is none.
pub fn span_line(text: &mut String, depth: usize, name: &str, recorded: Option<&LocalSpan>) {
    let words = recorded.map_or_else(|| vec!["nothing".to_owned()], span);
    for (i, words) in words.iter().enumerate() {
        line(text, depth, if i == 0 { name } else { "" }, words);
    }
}

/// A duration as `12.345 s`, `1 min 35.8 s` or `16 h 01 min 35 s`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative, and the cast saturates")]
pub fn duration(seconds: f64) -> String {
    // Rounding comes first, so that no minute has 60 seconds.
    let (tenths, whole) = ((seconds * 10.0).round() as u64, seconds.round() as u64);
    if seconds < 59.9995 {
        format!("{seconds:.3} s")
    } else if tenths < 36_000 {
        format!("{} min {}.{} s", tenths / 600, tenths % 600 / 10, tenths % 10)
    } else {
        format!("{} h {:02} min {:02} s", whole / 3600, whole % 3600 / 60, whole % 60)
    }
}

/// A number of things as `1 gap` or `2 gaps`.
pub fn count(n: u64, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_of_time() {
        let written: Vec<String> = [0.0, 59.9994, 59.9996, 95.84, 3599.96, 57_695.0].map(duration).into();
        assert_eq!(
            written,
            ["0.000 s", "59.999 s", "1 min 0.0 s", "1 min 35.8 s", "1 h 00 min 00 s", "16 h 01 min 35 s"]
        );
    }

    #[test]
    fn long_names_keep_their_distance() {
        let mut text = String::new();
        line(&mut text, 2, "images", "8");
        line(&mut text, 2, "extra gyro_x(deg/s)", "8");
        assert_eq!(text, "  images        8\n  extra gyro_x(deg/s) 8\n");
    }
}
