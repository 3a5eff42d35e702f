//! Hands.

use nalgebra::{Point3, Vector3};
use rand::Rng;

use crate::world::{Body, Form, Material, Rgb, Texture};

/// A hand with an arm behind it. It has a palm, four fingers of three bones each, and a thumb.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::laid) struct Hand {
    /// The place of the fingertips.
    pub tip_mm: Point3<f64>,
    /// The place of the elbow.
    pub elbow_mm: Point3<f64>,
    pub skin: Rgb,
    /// The bend of the fingers, in radians per bone.
    pub curl: f64,
    /// Seed of the random pattern of the skin.
    pub seed: u64,
}

impl Hand {
    /// A hand with randomly bent fingers.
    pub fn random(random: &mut impl Rng, tip_mm: Point3<f64>, elbow_mm: Point3<f64>, skin: Rgb) -> Self {
        let seed = random.random();
        Self { tip_mm, elbow_mm, skin, curl: random.random_range(0.1..0.5), seed }
    }

    pub fn bodies(&self) -> Vec<Body> {
        let Self { tip_mm: reach, elbow_mm: from, skin, curl, seed } = *self;
        let colours = [skin, skin.map(|c| 0.85 * c)];
        let skin = Material::matt(Texture::Speckled { colours, grain_mm: 5.0, share: 0.3, seed });
        let along = (reach - from).normalize();
        let aside = along.cross(&Vector3::z()).normalize();
        let rod = |a: Point3<f64>, b: Point3<f64>, radius: f64| Body {
            form: Form::Capsule { ends: [a, b], radius },
            material: skin.clone(),
        };
        let wrist = reach - along * 165.0 + Vector3::z() * 18.0;
        let mut bodies = vec![rod(from, wrist, 33.0)];
        for (finger, length) in [66.0, 80.0, 84.0, 72.0].into_iter().enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "four fingers")]
            let y = finger as f64 * 19.0 - 28.0;
            let knuckle = reach - along * 85.0 + aside * y + Vector3::z() * 22.0;
            bodies.push(rod(wrist + aside * (0.6 * y), knuckle, 14.0));
            let mut joint = knuckle;
            for (bone, share) in [(0.0, 0.45), (1.0, 0.3), (2.0, 0.25)] {
                let bend = curl * (bone + 0.5);
                let next = joint + (along * bend.cos() - Vector3::z() * bend.sin()) * (share * length);
                bodies.push(rod(joint, next, 9.5 - 0.8 * bone));
                joint = next;
            }
        }
        let thumb = reach - along * 120.0 - aside * 40.0 + Vector3::z() * 12.0;
        bodies.extend([rod(wrist - aside * 15.0, thumb, 14.0), rod(thumb, thumb + along * 55.0 + aside * 12.0, 11.0)]);
        bodies
    }
}
