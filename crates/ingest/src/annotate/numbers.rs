//! Numbers that viewers plot. prost encodes them; foxglove's derive describes them to other readers. Both number fields in the
//! order of declaration. What is not known is NaN, which leaves a gap in a plot.

use model::{FrameReason, FrameRow, ResultRow};

/// Topic `/frame`: what the sensors say about an image, as in frames.parquet.
#[derive(Clone, PartialEq, prost::Message, foxglove::Encode)]
pub(crate) struct FrameNumbers {
    /// Depression of the optical axis below the horizontal.
    #[prost(double, tag = "1")]
    pub pitch_deg: f64,
    /// Positive clockwise as the wearer sees it.
    #[prost(double, tag = "2")]
    pub roll_deg: f64,
    /// Distance to the table along the optical axis.
    #[prost(double, tag = "3")]
    pub range_mm: f64,
    #[prost(double, tag = "4")]
    pub range_spread_mm: f64,
    #[prost(double, tag = "5")]
    pub stillness_mg: f64,
    #[prost(double, tag = "6")]
    pub gravity_mg: f64,
    /// Predicted uncertainty of a plate's diameter in this image.
    #[prost(double, tag = "7")]
    pub plate_sigma_mm: f64,
    /// Whether it counts for fused sizes.
    #[prost(bool, tag = "8")]
    pub selected: bool,
    /// Code of the reason.
    #[prost(string, tag = "9")]
    pub reason: String,
    #[prost(string, tag = "10")]
    pub flags: String,
    #[prost(string, tag = "11")]
    pub file: String,
}

impl FrameNumbers {
    pub fn from_frame(frame: &FrameRow) -> Self {
        Self {
            pitch_deg: or_gap(frame.pitch_deg),
            roll_deg: or_gap(frame.roll_deg),
            range_mm: or_gap(frame.range_mm),
            range_spread_mm: or_gap(frame.range_spread_mm),
            stillness_mg: or_gap(frame.stillness_mg),
            gravity_mg: or_gap(frame.gravity_mg),
            plate_sigma_mm: or_gap(frame.plate_sigma_mm),
            selected: frame.reason == FrameReason::Selected,
            reason: frame.reason.code().to_owned(),
            flags: frame.flags.clone(),
            file: frame.image.clone(),
        }
    }
}

/// Topics `/sizes/RATER/OBJECT/QUANTITY`: a size measured in an image, as in results.parquet.
#[derive(Clone, PartialEq, prost::Message, foxglove::Encode)]
pub(crate) struct SizeNumbers {
    #[prost(double, tag = "1")]
    pub size_mm: f64,
    #[prost(double, tag = "2")]
    pub sigma_mm: f64,
    /// Two standard uncertainties below and above it.
    #[prost(double, tag = "3")]
    pub low_mm: f64,
    #[prost(double, tag = "4")]
    pub high_mm: f64,
    #[prost(double, tag = "5")]
    pub truth_mm: f64,
    #[prost(double, tag = "6")]
    pub error_pct: f64,
    #[prost(string, tag = "7")]
    pub object: String,
    #[prost(string, tag = "8")]
    pub rater: String,
    #[prost(string, tag = "9")]
    pub quantity: String,
    #[prost(string, tag = "10")]
    pub method: String,
    #[prost(string, tag = "11")]
    pub flags: String,
}

impl SizeNumbers {
    pub fn from_row(row: &ResultRow) -> Self {
        let (size_mm, sigma_mm) = (or_gap(row.predicted_mm), or_gap(row.sigma_mm));
        Self {
            size_mm,
            sigma_mm,
            low_mm: size_mm - 2.0 * sigma_mm,
            high_mm: size_mm + 2.0 * sigma_mm,
            truth_mm: or_gap(row.truth_mm),
            error_pct: or_gap(row.error_pct),
            object: row.object.clone(),
            rater: row.rater.clone(),
            quantity: row.quantity.to_string(),
            method: row.method_used.unwrap_or(row.method).to_string(),
            flags: row.flags.clone(),
        }
    }
}

fn or_gap(number: Option<f64>) -> f64 {
    number.unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    /// foxglove's own encoder belongs to the schema, and is the reference.
    #[test]
    fn encoding_agrees_with_the_schema() {
        let frame = FrameRow {
            pitch_deg: Some(54.5),
            range_mm: Some(480.0),
            ..FrameRow::without_numbers("study", "S1", "a.jpg", FrameReason::Selected)
        };
        let numbers = FrameNumbers::from_frame(&frame);
        assert!(numbers.roll_deg.is_nan() && numbers.selected);
        let mut reference = Vec::new();
        foxglove::Encode::encode(&numbers, &mut reference).unwrap();
        let read = <FrameNumbers as prost::Message>::decode(reference.as_slice()).unwrap();
        assert_eq!((read.pitch_deg.to_bits(), read.range_mm.to_bits()), (54.5_f64.to_bits(), 480.0_f64.to_bits()));
        assert_eq!((read.reason.as_str(), read.file.as_str(), read.selected), ("selected", "a.jpg", true));
    }
}
