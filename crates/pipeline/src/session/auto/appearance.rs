//! The appearance of a container in all images that show it: plate or bowl, and the height of its rim.
//!
//! One image often cannot tell: the foot is hidden, food covers the well, a shadow looks like a wall. But a container is one
//! thing in all of its images, so all of them have a say, and its sizes are measured on one plane in all of them.

use model::Kind;

use rims::{HeightSource, RimHeight};

/// The evidence of one image, or of several, on what a container is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Appearance {
    /// The height of the rim if it is a plate's.
    pub plate: RimHeight,
    /// The height of the rim if it is a bowl's.
    pub bowl: RimHeight,
    /// The natural logarithm of the odds of a plate against a bowl.
    pub plate_log_odds: f64,
}

/// No image counts for more than this, a factor of e^10 = 22,000: an edge that is taken for a foot may be a shadow, however
/// sharp it is.
const MOST_LOG_ODDS: f64 = 10.0;
/// The share of the variance of a height that the images of a container have in common: its own form, its food, what is
/// common among containers. Among the rims of simulated sessions (`worn`, seeds 101 to 103, 38 containers) it was 0.78 for
/// bowls and 0.72 for plates.
const SHARED: f64 = 0.75;

impl Appearance {
    /// The likelier kind.
    pub fn kind(&self) -> Kind {
        if self.plate_log_odds >= 0.0 { Kind::Plate } else { Kind::Bowl }
    }

    pub fn height(&self, kind: Kind) -> RimHeight {
        if kind == Kind::Plate { self.plate } else { self.bowl }
    }
}

/// The appearance of a container in several images, summed up image by image.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct PooledAppearance {
    images: u32,
    log_odds: f64,
    plate: Heights,
    bowl: Heights,
}

impl PooledAppearance {
    pub fn add(&mut self, appearance: &Appearance) {
        self.images += 1;
        self.log_odds += limited(appearance.plate_log_odds);
        self.plate.add(&appearance.plate);
        self.bowl.add(&appearance.bowl);
    }

    pub fn append(&mut self, other: &Self) {
        self.images += other.images;
        self.log_odds += other.log_odds;
        self.plate.append(&other.plate);
        self.bowl.append(&other.bowl);
    }

    /// The appearance by all images; none where there is no image.
    ///
    /// Images of one container mostly err alike, and differ a little. The evidence of n of them therefore counts as that of
    /// √n, between one (all err alike) and n (none do).
    pub fn appearance(&self) -> Option<Appearance> {
        Some(Appearance {
            plate: self.plate.mean()?,
            bowl: self.bowl.mean()?,
            plate_log_odds: self.log_odds / f64::from(self.images).sqrt(),
        })
    }
}

/// The appearance by several images; none where there is no image.
pub(super) fn pooled<'a>(all: impl Iterator<Item = &'a Appearance>) -> Option<Appearance> {
    let mut pooled = PooledAppearance::default();
    all.for_each(|appearance| pooled.add(appearance));
    pooled.appearance()
}

fn limited(log_odds: f64) -> f64 {
    if log_odds.is_nan() { 0.0 } else { log_odds.clamp(-MOST_LOG_ODDS, MOST_LOG_ODDS) }
}

/// Sums over images of heights, weighted by their inverse variances w.
#[derive(Debug, Clone, Default, PartialEq)]
struct Heights {
    weight: f64,
    weighted_mm: f64,
    /// The sum of w σ, that is, of the square roots of w.
    weighted_sigma: f64,
    /// The sum of w by the source of the height, in the order of [`SOURCES`].
    by_source: [f64; SOURCES.len()],
}

/// The sources of heights, the surest first.
const SOURCES: [HeightSource; 5] =
    [HeightSource::Given, HeightSource::Session, HeightSource::Foot, HeightSource::Floor, HeightSource::Common];
/// No height is known better than this.
const LEAST_SIGMA_MM: f64 = 1e-3;

impl Heights {
    fn add(&mut self, height: &RimHeight) {
        let weight = height.sigma_mm.max(LEAST_SIGMA_MM).powi(-2);
        self.weight += weight;
        self.weighted_mm += weight * height.mm;
        self.weighted_sigma += weight.sqrt();
        for (sum, source) in self.by_source.iter_mut().zip(SOURCES) {
            *sum += if source == height.source { weight } else { 0.0 };
        }
    }

    fn append(&mut self, other: &Self) {
        self.weight += other.weight;
        self.weighted_mm += other.weighted_mm;
        self.weighted_sigma += other.weighted_sigma;
        for (sum, of_other) in self.by_source.iter_mut().zip(other.by_source) {
            *sum += of_other;
        }
    }

    /// The weighted mean. With weights W = w / Σw the part of the variance that images have of their own is Σ W² σ² = 1 /
    /// Σw, and the part that they share (Σ W σ)² = (Σ √w / Σw)².
    fn mean(&self) -> Option<RimHeight> {
        let own = self.weight.recip();
        let shared = (self.weighted_sigma / self.weight).powi(2);
        let mm = self.weighted_mm / self.weight;
        let surest = SOURCES.into_iter().zip(self.by_source).reduce(|a, b| if b.1 > a.1 { b } else { a });
        let sigma_mm = (SHARED * shared + (1.0 - SHARED) * own).sqrt();
        (mm.is_finite() && sigma_mm.is_finite()).then_some(RimHeight { mm, sigma_mm, source: surest?.0 })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    fn height(mm: f64, sigma_mm: f64, source: HeightSource) -> RimHeight {
        RimHeight { mm, sigma_mm, source }
    }

    fn appearance(plate_log_odds: f64, bowl: RimHeight) -> Appearance {
        Appearance { plate: height(20.0, 5.0, HeightSource::Common), bowl, plate_log_odds }
    }

    fn pooled(all: &[Appearance]) -> Appearance {
        let mut pooled = PooledAppearance::default();
        all.iter().for_each(|appearance| pooled.add(appearance));
        pooled.appearance().unwrap()
    }

    #[test]
    fn one_image_says_what_it_said() {
        let one = appearance(-3.0, height(60.0, 12.0, HeightSource::Foot));
        let by_all = pooled(&[one]);
        assert!((by_all.bowl.mm - 60.0).abs() < 1e-9 && (by_all.bowl.sigma_mm - 12.0).abs() < 1e-9);
        assert_eq!((by_all.kind(), by_all.bowl.source), (Kind::Bowl, HeightSource::Foot));
        assert!((by_all.plate_log_odds + 3.0).abs() < 1e-12);
    }

    #[test]
    fn images_outvote_one_that_is_off_however_sure_it_is() {
        let bowl = height(60.0, 12.0, HeightSource::Foot);
        let by_all =
            pooled(&[appearance(4.0, bowl), appearance(5.0, bowl), appearance(-300.0, bowl), appearance(4.0, bowl)]);
        assert_eq!(by_all.kind(), Kind::Plate);
    }

    #[test]
    fn what_images_share_does_not_average_out() {
        let bowl = height(60.0, 10.0, HeightSource::Common);
        let by_all = pooled(&vec![appearance(-1.0, bowl); 10_000]);
        assert!((by_all.bowl.sigma_mm - 10.0 * SHARED.sqrt()).abs() < 0.01, "{by_all:?}");
        assert!((by_all.plate_log_odds + 100.0).abs() < 1e-9, "as 100 images");
    }

    #[test]
    fn the_surer_height_counts_more_and_names_the_source() {
        let (seen, guessed) = (height(60.0, 5.0, HeightSource::Foot), height(90.0, 20.0, HeightSource::Common));
        let by_all = pooled(&[appearance(-1.0, seen), appearance(-1.0, guessed), appearance(-1.0, guessed)]);
        assert!((by_all.bowl.mm - (16.0 * 60.0 + 2.0 * 90.0) / 18.0).abs() < 1e-9, "{by_all:?}");
        assert_eq!(by_all.bowl.source, HeightSource::Foot);
        assert!(by_all.bowl.sigma_mm < 7.0);
    }

    #[test]
    fn parts_give_what_the_whole_gives() {
        let all: Vec<Appearance> = (0..7)
            .map(|i| appearance(f64::from(i) - 3.0, height(50.0 + f64::from(i), 9.0, HeightSource::Floor)))
            .collect();
        let (mut a, mut b) = (PooledAppearance::default(), PooledAppearance::default());
        all[..3].iter().for_each(|appearance| a.add(appearance));
        all[3..].iter().for_each(|appearance| b.add(appearance));
        a.append(&b);
        let (parts, whole) = (a.appearance().unwrap(), pooled(&all));
        assert!(
            (parts.bowl.mm - whole.bowl.mm).abs() < 1e-9 && (parts.bowl.sigma_mm - whole.bowl.sigma_mm).abs() < 1e-9
        );
        assert!((parts.plate_log_odds - whole.plate_log_odds).abs() < 1e-9);
    }

    #[test]
    fn odd_numbers_are_no_trouble() {
        assert_eq!(PooledAppearance::default().appearance(), None);
        let odd = appearance(f64::NAN, height(f64::NAN, 0.0, HeightSource::Foot));
        let mut pooled = PooledAppearance::default();
        pooled.add(&odd);
        assert_eq!(pooled.appearance(), None);
    }
}
