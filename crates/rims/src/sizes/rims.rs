//! Sizes of a found rim, by the code that measures people's marks.

use model::{
    Container, Estimate, InputSigma, Kind, MeasureError, Measured, Method, ObjectMarks, PerSource, Quantity,
    Sensitivity, Shape, View, estimate,
};

use super::{SHARED_PX, square};
use crate::found::Found;
use crate::rim::Rim;
use crate::rim_height::{HeightSource, RimHeight};

impl Rim {
    /// The height of the plane that it is measured on: the known one, else the one that was found for its kind.
    #[must_use]
    pub fn height_as(&self, container: &Container) -> RimHeight {
        self.found().height_as(container)
    }

    /// The sizes of the rim; see [`Found::sizes`].
    #[must_use]
    pub fn sizes(
        &self,
        view: &View,
        method: Method,
        container: &Container,
        inputs: &InputSigma,
    ) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
        self.found().sizes(view, method, container, &self.marks(""), inputs)
    }
}

impl Found {
    /// The height of the plane that it is measured on: the known one, else the one that was found for its kind.
    #[must_use]
    pub fn height_as(&self, container: &Container) -> RimHeight {
        match (container.rim_height_mm, container.kind) {
            (Some(mm), _) => RimHeight { mm, sigma_mm: 0.0, source: HeightSource::Given },
            (None, Kind::Plate) => {
                self.plate_height.unwrap_or(RimHeight { mm: 0.0, sigma_mm: 0.0, source: HeightSource::Given })
            }
            (None, Kind::Bowl | Kind::Box) => self.height,
        }
    }

    /// Sizes by the marks of the rim: of a bowl of unknown height the height, and the diameter with what the height's
    /// uncertainty makes of it (in the part from the marks).
    #[must_use]
    pub fn sizes(
        &self,
        view: &View,
        method: Method,
        container: &Container,
        marks: &ObjectMarks,
        inputs: &InputSigma,
    ) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
        if self.shape != Shape::Circle {
            return square::sizes(self, view, method, container, marks, inputs);
        }
        let height = self.height_as(container);
        let on_plane = |mm: f64| {
            let container = Container { rim_height_mm: Some(mm), ..*container };
            estimate(view, method, &container, marks, inputs)
        };
        let diameter_mm = |mm: f64| match on_plane(mm).as_slice() {
            [(_, Ok(estimate)), ..] => Some(estimate.measured.predicted_mm),
            _ => None,
        };
        let mut sizes = on_plane(height.mm);
        for (_, size) in &mut sizes {
            let Ok(Estimate { measured, sigma, .. }) = size else { continue };
            let by_height = 0.5
                * (diameter_mm(height.mm + height.sigma_mm).unwrap_or(measured.predicted_mm)
                    - diameter_mm(height.mm - height.sigma_mm).unwrap_or(measured.predicted_mm));
            let shared = 2.0 * SHARED_PX * std::f64::consts::PI * measured.predicted_mm / self.perimeter_px;
            *sigma = sigma.with_marks(sigma.marks_mm.hypot(by_height).hypot(shared));
        }
        if height.source != HeightSource::Given && container.kind != Kind::Plate {
            sizes.insert(0, (Quantity::Height, Ok(height.estimate(method))));
        }
        sizes
    }
}

impl RimHeight {
    /// The height as a size: its uncertainty was worked out where it was found, all of it in the part from the marks.
    fn estimate(&self, method: Method) -> Estimate {
        let measured = Measured::by_one_mark(Quantity::Height, self.mm, 0.0);
        let sensitivity = Sensitivity { by_source: PerSource::zeros(), marks_mm_per_px: 0.0 };
        let sigma = sensitivity.sigma(&InputSigma::NONE).with_marks(self.sigma_mm);
        Estimate { method, measured, sensitivity, sigma, wall_slope: None, doubts: Vec::new() }
    }
}
