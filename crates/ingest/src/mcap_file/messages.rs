//! The program's own messages. prost encodes and decodes them; foxglove's derive describes them to other readers. Both
//! number fields in the order of declaration, so that order is part of the format (`INGEST_VERSION`).

/// Topic `/imu/acceleration`: specific force in the device frame (x right, y down, z forward), in g.
#[derive(Clone, Copy, PartialEq, prost::Message, foxglove::Encode)]
pub(crate) struct Acceleration {
    #[prost(double, tag = "1")]
    pub x_g: f64,
    #[prost(double, tag = "2")]
    pub y_g: f64,
    #[prost(double, tag = "3")]
    pub z_g: f64,
}

/// Topic `/range`: the reading of the range sensor, codes 8190 and 8191 (no target) included.
#[derive(Clone, Copy, PartialEq, prost::Message, foxglove::Encode)]
pub(crate) struct Range {
    #[prost(double, tag = "1")]
    pub range_mm: f64,
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
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;

    /// What prost writes must be what the schema says: foxglove's own encoder is the reference.
    fn same_bytes<M: prost::Message + foxglove::Encode>(message: &M) {
        let mut reference = Vec::new();
        foxglove::Encode::encode(message, &mut reference).unwrap();
        assert_eq!(prost::Message::encode_to_vec(message), reference);
    }

    #[test]
    fn encoding_agrees_with_the_schema() {
        same_bytes(&Acceleration { x_g: 0.25, y_g: -1.0, z_g: 0.125 });
        same_bytes(&Range { range_mm: 8190.0 });
        same_bytes(&ImageFile { file: "IMAGES/1.JPG".to_owned(), bytes: 300_000, width_px: 2592, height_px: 1944 });
    }
}
