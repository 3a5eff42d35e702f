//! A container as far as it has been seen, and how likely it is that two of them are one.

use std::collections::BTreeSet;

use model::{Kind, UtcNs};

use super::appearance::{Appearance, PooledAppearance};

/// The properties of a rim by which it can be recognised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sighting {
    /// The number of its image in the session.
    pub image: usize,
    pub time: UtcNs,
    /// The diameter, or length of a rectangle, on the plane Z = 0. On the plane Z = h it is smaller by the factor 1 - h /
    /// camera_mm.
    pub across_mm: f64,
    /// The width of a rectangle over its length; none for a round rim.
    pub narrowness: Option<f64>,
    /// The relative standard uncertainty of the diameter against other images of the session.
    pub relative_sigma: f64,
    /// The height of the camera above the table.
    pub camera_mm: f64,
    /// The centre on the plane Z = 0: world X and Y, from the point of the table under the camera.
    pub at_mm: [f64; 2],
    pub appearance: Appearance,
}

/// The cost of leaving open whether a container is a plate or a bowl: -2 ln 1/2.
const EITHER: f64 = 2.0 * std::f64::consts::LN_2;
/// The share of the variance of a size that the images of one container have in common; the mean of a track keeps it,
/// whatever the track's length.
const ALIKE: f64 = 0.3;
/// Smaller relative uncertainties count as this.
const LEAST_SIGMA: f64 = 1e-6;

/// A container that has been seen in one image or more.
#[derive(Debug, Clone)]
pub(super) struct Track {
    /// The numbers of its sightings, in the order of time.
    pub members: Vec<usize>,
    /// The numbers of its images.
    pub images: BTreeSet<usize>,
    pooled: PooledAppearance,
    /// The narrowness of its first sighting.
    narrowness: Option<f64>,
    /// Sums over its sightings: of weights, of weighted diameters on Z = 0, and of those divided by the camera's height.
    weight: f64,
    across_mm: f64,
    across_per_camera: f64,
}

impl Track {
    pub fn from_sighting(number: usize, sighting: &Sighting) -> Self {
        let mut track = Self {
            members: Vec::new(),
            images: BTreeSet::new(),
            pooled: PooledAppearance::default(),
            narrowness: sighting.narrowness,
            weight: 0.0,
            across_mm: 0.0,
            across_per_camera: 0.0,
        };
        track.add(number, sighting);
        track
    }

    pub fn add(&mut self, number: usize, sighting: &Sighting) {
        let weight = sighting.relative_sigma.max(LEAST_SIGMA).powi(-2);
        self.members.push(number);
        self.images.insert(sighting.image);
        self.pooled.add(&sighting.appearance);
        self.weight += weight;
        self.across_mm += weight * sighting.across_mm;
        self.across_per_camera += weight * sighting.across_mm / sighting.camera_mm;
    }

    pub fn append(&mut self, other: Self) {
        self.members.extend(other.members);
        self.members.sort_unstable();
        self.images.extend(other.images);
        self.pooled.append(&other.pooled);
        self.weight += other.weight;
        self.across_mm += other.across_mm;
        self.across_per_camera += other.across_per_camera;
    }

    /// The appearance by all of its images.
    pub fn appearance(&self) -> Option<Appearance> {
        self.pooled.appearance()
    }

    /// The mean diameter if the rim is at this height.
    pub fn diameter_mm(&self, height_mm: f64) -> f64 {
        (self.across_mm - height_mm * self.across_per_camera) / self.weight
    }

    /// The shorter side if the rim is at this height.
    pub fn narrowest_mm(&self, height_mm: f64) -> f64 {
        self.diameter_mm(height_mm) * self.narrowness.unwrap_or(1.0)
    }

    /// Whether both are round, or rectangles with sides in about the same ratio.
    fn is_shaped_as(&self, other: &Self, most: f64) -> bool {
        match (self.narrowness, other.narrowness) {
            (None, None) => true,
            (Some(a), Some(b)) => (a / b).ln().abs() <= most * self.relative_sigma().hypot(other.relative_sigma()),
            (None, Some(_)) | (Some(_), None) => false,
        }
    }

    /// The relative standard uncertainty of the mean diameter.
    #[expect(clippy::cast_precision_loss, reason = "some thousand images")]
    fn relative_sigma(&self) -> f64 {
        let images = self.members.len() as f64;
        ((ALIKE + (1.0 - ALIKE) / images) * images / self.weight).sqrt()
    }

    /// How unlikely it is, by their sizes, that both are one container (squared standard deviations). None where they cannot
    /// be: where the diameters differ by more than `most` of their joint standard uncertainties.
    ///
    /// One container has one height, so sizes are compared at the height that both give together. An error of that height
    /// hardly matters then, since it makes both wrong alike. Whether it is a plate or a bowl is left open; a kind that is
    /// unlikely by the appearance of both costs as much as it is unlikely.
    pub fn unlike(&self, other: &Self, most: f64) -> Option<f64> {
        if !self.is_shaped_as(other, most) {
            return None;
        }
        let mut both = self.pooled.clone();
        both.append(&other.pooled);
        let appearance = both.appearance()?;
        let sigma = self.relative_sigma().hypot(other.relative_sigma());
        let as_kind = |kind: Kind| {
            let height_mm = appearance.height(kind).mm;
            let size = (self.diameter_mm(height_mm) / other.diameter_mm(height_mm)).ln() / sigma;
            let against = if kind == Kind::Plate { -appearance.plate_log_odds } else { appearance.plate_log_odds };
            let unlike = size * size + 2.0 * against.exp().ln_1p();
            (unlike <= most * most + EITHER).then_some(unlike)
        };
        [Kind::Plate, Kind::Bowl].into_iter().filter_map(as_kind).reduce(f64::min)
    }
}
