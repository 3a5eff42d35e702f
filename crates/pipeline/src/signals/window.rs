//! Windows around images over a stream of samples, in one pass and bounded memory.

use model::UtcNs;

/// Calls `evaluate` for each image with the samples within `half_s` of it, as soon as the stream has passed them.
pub(super) struct Windows<'a, T, R, F: Fn(UtcNs, &[(UtcNs, T)]) -> R> {
    image_times: &'a [UtcNs],
    half_s: f64,
    evaluate: F,
    /// The samples that an open image may still need, in the order of the stream.
    kept: Vec<(UtcNs, T)>,
    /// The number of samples at the front of `kept` that no open image needs; they are removed when they are many.
    stale: usize,
    results: Vec<R>,
}

/// `kept` is compacted when this many samples at its front are stale, and at least half of it.
const COMPACT_FROM: usize = 1024;

impl<'a, T, R, F: Fn(UtcNs, &[(UtcNs, T)]) -> R> Windows<'a, T, R, F> {
    /// Windows around `image_times`, which must be in order.
    pub(super) fn new(image_times: &'a [UtcNs], half_s: f64, evaluate: F) -> Self {
        debug_assert!(image_times.is_sorted(), "images come in the order of their times");
        Self {
            image_times,
            half_s,
            evaluate,
            kept: Vec::new(),
            stale: 0,
            results: Vec::with_capacity(image_times.len()),
        }
    }

    /// Takes the next sample of the stream, which must be in the order of time.
    pub(super) fn push(&mut self, time: UtcNs, value: T) {
        while let Some(open) = self.image_times.get(self.results.len())
            && time.seconds_since(*open) > self.half_s
        {
            self.close(*open);
        }
        let Some(open) = self.image_times.get(self.results.len()) else { return };
        if open.seconds_since(time) <= self.half_s {
            self.kept.push((time, value));
        }
    }

    /// The results of `evaluate` for the images, in their order.
    pub(super) fn finish(mut self) -> Vec<R> {
        while let Some(open) = self.image_times.get(self.results.len()) {
            self.close(*open);
        }
        self.results
    }

    fn close(&mut self, image_time: UtcNs) {
        let too_old = |(time, _): &&(UtcNs, T)| image_time.seconds_since(*time) > self.half_s;
        self.stale += self.kept[self.stale..].iter().take_while(too_old).count();
        let in_window = &self.kept[self.stale..];
        let end = in_window.partition_point(|(time, _)| time.seconds_since(image_time) <= self.half_s);
        self.results.push((self.evaluate)(image_time, &in_window[..end]));
        if self.stale >= COMPACT_FROM && 2 * self.stale >= self.kept.len() {
            self.kept.drain(..self.stale);
            self.stale = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seconds(s: f64) -> UtcNs {
        UtcNs(0).plus_seconds(s)
    }

    fn count(image_times: &[UtcNs], half_s: f64, samples: impl IntoIterator<Item = f64>) -> Vec<usize> {
        let mut windows = Windows::new(image_times, half_s, |_, samples: &[(UtcNs, ())]| samples.len());
        for sample in samples {
            windows.push(seconds(sample), ());
        }
        windows.finish()
    }

    #[test]
    fn each_image_gets_its_own_samples_even_where_windows_overlap() {
        let images = [seconds(1.0), seconds(1.5), seconds(10.0)];
        let samples = (0..20).map(|i| f64::from(i) * 0.25); // 0 to 4.75 s
        assert_eq!(count(&images, 0.5, samples), [5, 5, 0]);
    }

    #[test]
    fn images_before_the_first_and_after_the_last_sample_get_what_there_is() {
        let images = [seconds(-5.0), seconds(0.1), seconds(2.0), seconds(99.0)];
        assert_eq!(count(&images, 0.2, [0.0, 0.1, 1.9]), [0, 2, 1, 0]);
    }

    #[test]
    fn memory_stays_near_the_window_over_a_long_stream() {
        let images: Vec<_> = (0..2000).map(|i| seconds(f64::from(i) * 10.0)).collect();
        let mut windows = Windows::new(&images, 1.0, |_, samples: &[(UtcNs, ())]| samples.len());
        let mut most_kept = 0;
        for i in 0..(2000 * 1280) {
            windows.push(seconds(f64::from(i) / 128.0), ());
            most_kept = most_kept.max(windows.kept.len());
        }
        assert!(most_kept < 4 * COMPACT_FROM, "kept {most_kept} samples");
        assert!(windows.finish()[1..].iter().all(|n| *n == 257));
    }
}
