//! The program's own messages. prost encodes and decodes them; foxglove's derive describes them to other readers. Both
//! number fields in the order of declaration, so that order is part of the format (`INGEST_VERSION`).

/// Topic `/imu/acceleration`: specific force in the device frame (x right, y down, z forward), in g.
///
/// A message holds consecutive samples of less than a second; its own time is that of the first. Sample i is `i * step_ns` later where `step_ns`
/// is not 0, and `offset_ns[i]` later otherwise. The same holds for the other sensor messages.
#[derive(Clone, PartialEq, prost::Message, foxglove::Encode)]
pub(crate) struct AccelerationBlock {
    #[prost(double, tag = "1")]
    pub step_ns: f64,
    #[prost(uint64, repeated, tag = "2")]
    pub offset_ns: Vec<u64>,
    #[prost(float, repeated, tag = "3")]
    pub x_g: Vec<f32>,
    #[prost(float, repeated, tag = "4")]
    pub y_g: Vec<f32>,
    #[prost(float, repeated, tag = "5")]
    pub z_g: Vec<f32>,
}

/// Topic `/range`: the readings of the range sensor, codes 8190 and 8191 (no target) included.
#[derive(Clone, PartialEq, prost::Message, foxglove::Encode)]
pub(crate) struct RangeBlock {
    #[prost(double, tag = "1")]
    pub step_ns: f64,
    #[prost(uint64, repeated, tag = "2")]
    pub offset_ns: Vec<u64>,
    #[prost(float, repeated, tag = "3")]
    pub range_mm: Vec<f32>,
}

/// Topics `/extra/NAME`: a channel that the program carries along and does not use, as the device counts it; NaN where
/// missing.
#[derive(Clone, PartialEq, prost::Message, foxglove::Encode)]
pub(crate) struct ExtraBlock {
    #[prost(double, tag = "1")]
    pub step_ns: f64,
    #[prost(uint64, repeated, tag = "2")]
    pub offset_ns: Vec<u64>,
    #[prost(float, repeated, tag = "3")]
    pub value: Vec<f32>,
}

/// Topic `/camera/file`: which file an image came from. It has the image's time and sequence number.
#[derive(Clone, PartialEq, prost::Message, foxglove::Encode)]
pub(crate) struct ImageFile {
    #[prost(string, tag = "1")]
    pub file: String,
    #[prost(uint64, tag = "2")]
    pub bytes: u64,
    #[prost(uint32, tag = "3")]
    pub width_px: u32,
    #[prost(uint32, tag = "4")]
    pub height_px: u32,
    /// EXIF's number, 1 to 8; 1 where the file gives none.
    #[prost(uint32, tag = "5")]
    pub orientation: u32,
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;

    /// Fields must be what the schema says: foxglove's own encoder, which belongs to the schema, is the reference. (It does
    /// not pack lists; a reader of protobuf takes both.)
    fn reads_back<M: prost::Message + Default + PartialEq + std::fmt::Debug + foxglove::Encode>(message: &M) {
        let mut reference = Vec::new();
        foxglove::Encode::encode(message, &mut reference).unwrap();
        assert_eq!(&M::decode(reference.as_slice()).unwrap(), message);
        assert_eq!(&M::decode(message.encode_to_vec().as_slice()).unwrap(), message);
    }

    #[test]
    fn encoding_agrees_with_the_schema() {
        let (step_ns, offset_ns) = (0.0, vec![0, 7_812_500, 15_625_000]);
        let (x_g, y_g, z_g) = (vec![0.25, 0.5, -0.5], vec![-1.0; 3], vec![0.125; 3]);
        reads_back(&AccelerationBlock { step_ns, offset_ns: offset_ns.clone(), x_g, y_g, z_g });
        reads_back(&RangeBlock { step_ns: 7_812_500.0, offset_ns: vec![], range_mm: vec![8190.0, 512.0] });
        reads_back(&ExtraBlock { step_ns, offset_ns, value: vec![1.0, 2.0, 3.0] });
        reads_back(&ImageFile {
            file: "IMAGES/1.JPG".to_owned(),
            bytes: 300_000,
            width_px: 2592,
            height_px: 1944,
            orientation: 6,
        });
    }
}
