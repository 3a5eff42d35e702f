//! Writes CWA files, as the format's tables say, by code of its own.

/// How samples are stored.
#[derive(Debug, Clone)]
pub enum Samples {
    /// x, y, z of 10 bits, and a common exponent.
    Packed(Vec<([i16; 3], u32)>),
    /// x, y, z of 16 bits.
    Accel(Vec<[i16; 3]>),
    /// Gyroscope x, y, z, then accelerometer x, y, z.
    GyroAccel(Vec<[i16; 6]>),
}

/// One data block.
#[derive(Debug, Clone)]
pub struct BlockSpec {
    pub sequence: u32,
    /// Seconds since midnight of 2024-05-17.
    pub stamp_s: f64,
    /// The sample that the stamp is of.
    pub index: i16,
    pub has_fraction: bool,
    pub rate_code: u8,
    /// Codes of the accelerometer's and the gyroscope's scale.
    pub scales: (u16, u16),
    pub samples: Samples,
}

/// 100 Hz and 8 g.
pub const RATE_100_HZ: u8 = 0x4a;

pub fn header(hardware: u8) -> Vec<u8> {
    let mut bytes = vec![0xff; 1024];
    bytes[..5].copy_from_slice(&[b'M', b'D', 0xfc, 0x03, hardware]);
    bytes[5..7].copy_from_slice(&39434_u16.to_le_bytes());
    bytes[7..11].copy_from_slice(&26_u32.to_le_bytes());
    bytes[13..17].copy_from_slice(&packed_stamp(10 * 3600).to_le_bytes());
    bytes[17..21].fill(0);
    bytes[36] = RATE_100_HZ;
    bytes[41] = 44;
    bytes
}

impl BlockSpec {
    pub fn bytes(&self) -> [u8; 512] {
        let mut bytes = [0; 512];
        let mut put = |at: usize, field: &[u8]| bytes[at..at + field.len()].copy_from_slice(field);
        let fraction = if self.has_fraction { (self.stamp_s.fract() * 32768.0).round() as u16 } else { 0 };
        let moved = i32::from(fraction) * rate_hz(self.rate_code) as i32 / 32768;
        let (form, count, samples) = self.samples.bytes();
        let flag = if self.has_fraction { 0x8000 } else { 0 };
        put(0, b"AX");
        put(2, &508_u16.to_le_bytes());
        put(4, &(flag | fraction).to_le_bytes());
        put(6, &26_u32.to_le_bytes());
        put(10, &self.sequence.to_le_bytes());
        put(14, &packed_stamp(self.stamp_s as u32).to_le_bytes());
        put(18, &((self.scales.0 << 13) | (self.scales.1 << 10) | 0x11b).to_le_bytes());
        put(24, &[self.rate_code, form]);
        put(26, &i16::try_from(i32::from(self.index) - moved).unwrap().to_le_bytes());
        put(28, &count.to_le_bytes());
        put(30, &samples);
        seal(&mut bytes);
        bytes
    }
}

impl Samples {
    /// Code of axes and packing, number of samples, bytes.
    fn bytes(&self) -> (u8, u16, Vec<u8>) {
        let (form, count, bytes): (u8, usize, Vec<u8>) = match self {
            Self::Packed(samples) => (0x30, samples.len(), samples.iter().flat_map(|s| pack(*s)).collect()),
            Self::Accel(samples) => {
                (0x32, samples.len(), samples.iter().flatten().flat_map(|v| v.to_le_bytes()).collect())
            }
            Self::GyroAccel(samples) => {
                (0x62, samples.len(), samples.iter().flatten().flat_map(|v| v.to_le_bytes()).collect())
            }
        };
        (form, u16::try_from(count).unwrap(), bytes)
    }
}

/// Makes the checksum hold.
pub fn seal(bytes: &mut [u8; 512]) {
    bytes[510..].fill(0);
    let sum: u32 = bytes.chunks(2).map(|word| u32::from(word[0]) + 256 * u32::from(word[1])).sum();
    let checksum = (0x10000 - sum % 0x10000) as u16;
    bytes[510..].copy_from_slice(&checksum.to_le_bytes());
}

fn rate_hz(code: u8) -> f64 {
    3200.0 / 2_f64.powi(15 - i32::from(code & 15))
}

fn packed_stamp(second_of_day: u32) -> u32 {
    let (hour, minute, second) = (second_of_day / 3600, second_of_day / 60 % 60, second_of_day % 60);
    let (year, month, day) = (24, 5, 17);
    (year << 26) | (month << 22) | (day << 17) | (hour << 12) | (minute << 6) | second
}

fn pack((values, exponent): ([i16; 3], u32)) -> [u8; 4] {
    let [x, y, z] = values.map(|value| u32::from(value as u16) & 0x3ff);
    (x | (y << 10) | (z << 20) | (exponent << 30)).to_le_bytes()
}
