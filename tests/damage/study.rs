//! A study of two sessions recorded in packets of one second: one is damaged, the other must not notice.

use std::path::PathBuf;

use model::{FrameReason, FrameRow, ResultRow, SessionStatus, Severity};

use super::corrupt::Corruptible;
use crate::support::{StudyFolder, assert_exit, label_me, line, run};

const CAMERA: &str = "schema_version = 1\nname = \"c\"\nwidth_px = 64\nheight_px = 48\nfocal_px = [60.0, 60.0]\n\
                      principal_px = [32.0, 24.0]\n[lens]\nmodel = \"none\"\n";
pub const PROFILE: &str = r#"
schema_version = 1
name = "unit"
version = "1"
mount_pitch_deg = 0.0

[acceleration]
files = ["S/ACC*.BIN"]
rate_hz = 64.0
g_per_count = 0.001
axes = ["+x", "+y", "+z"]

[acceleration.packets]
header = [{ field = "stamp", type = "f64" }, { field = "sequence", type = "u32" }]
endian = "little"
channels = ["x", "y", "z"]
samples = 64
order = "channel_major"

[range]
files = ["S/RNG*.BIN"]
rate_hz = 64.0
mm_per_count = 1.0

[range.packets]
header = [{ field = "stamp", type = "f64" }, { field = "sequence", type = "u32" }]
endian = "little"
channels = ["range"]
samples = 64
order = "channel_major"

[images]
files = ["I/*.jpg"]
time = { from = "name", pattern = "%Y%m%dT%H%M%SZ" }
"#;

/// 2024-01-01T00:00:00Z.
pub const START_S: f64 = 1_704_067_200.0;
/// Seconds, and packets, of a session; an image every 10 s, the first after 10 s.
pub const SECONDS: usize = 60;
pub const ACC_PACKET: usize = 12 + 3 * 64 * 2;
pub const RNG_PACKET: usize = 12 + 64 * 2;
pub const IMAGES: usize = 5;

/// A study with sessions `bad` and `good`, both whole.
pub struct DamagedStudy {
    pub folder: StudyFolder,
    out: PathBuf,
}

/// The status that a run gives the damaged session.
pub struct Told {
    pub exit: i32,
    pub status: SessionStatus,
    pub reasons: Vec<FrameReason>,
    pub frames: Vec<FrameRow>,
    good: (Vec<ResultRow>, Vec<FrameRow>),
}

impl DamagedStudy {
    pub fn new() -> Self {
        let folder = StudyFolder::new("", "object,kind,shape,true_diameter_mm\nplate,plate,circle,200\n", CAMERA);
        let toml = std::fs::read_to_string(folder.path().join("study.toml")).unwrap();
        folder.write("study.toml", toml.replace("device_profile = \"csv\"", "device_profile = \"unit\""));
        folder.write("devices/unit.toml", PROFILE);
        let study = Self { out: folder.path().join("out/results.parquet"), folder };
        for session in ["bad", "good"] {
            study.folder.write(&format!("cards/{session}/S/ACC0.BIN"), acceleration(SECONDS).bytes);
            study.folder.write(&format!("cards/{session}/S/RNG0.BIN"), range(SECONDS).bytes);
            for i in 1..=IMAGES {
                study.folder.write(&format!("cards/{session}/I/{}.jpg", stem(10 * i)), picture(i));
                study.folder.write(&format!("marks/A/{session}/{}.json", stem(10 * i)), marks().to_string());
            }
        }
        study
    }

    /// A file of the damaged card.
    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join("cards/bad").join(name)
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        self.folder.write(&format!("cards/bad/{name}"), bytes);
    }

    /// Changes study.toml or a device file.
    pub fn edit(&self, file: &str, from: &str, to: &str) {
        let text = std::fs::read_to_string(self.folder.path().join(file)).unwrap();
        assert!(text.contains(from), "{text}");
        self.folder.write(file, text.replace(from, to));
    }

    /// Damages one file of the card.
    pub fn corrupt(&self, name: &str, damage: impl FnOnce(&mut Corruptible) -> &mut Corruptible) {
        let packet = if name.contains("ACC") { ACC_PACKET } else { RNG_PACKET };
        let mut file = Corruptible::new(std::fs::read(self.file(name)).unwrap(), packet);
        damage(&mut file);
        std::fs::write(self.file(name), file.bytes).unwrap();
    }

    /// Runs, and asserts that the other session is what it is beside a whole one, to the byte.
    #[track_caller]
    pub fn run(&self) -> Told {
        let told = self.run_alone();
        let good = &told.good.0;
        assert!(good.iter().any(|row| row.predicted_mm.is_some_and(|mm| (mm - 200.0).abs() < 0.1)), "{good:?}");
        assert!(told.good == Self::new().run_alone().good, "the other session's rows have changed");
        told
    }

    #[track_caller]
    fn run_alone(&self) -> Told {
        let output = run(["run", self.folder.path().to_str().unwrap(), "--out", self.out.to_str().unwrap()]);
        let exit = output.status.code().unwrap();
        assert_exit(&output, exit); // no panic
        let results = report::Results::read(&self.out).unwrap();
        let frames = report::read_frames(&self.out.with_file_name("frames.parquet")).unwrap();
        let (good_frames, frames): (Vec<_>, Vec<_>) = frames.into_iter().partition(|frame| frame.session == "good");
        let good: Vec<_> = results.rows.into_iter().filter(|row| row.session == "good").collect();
        let status = results.metadata.sessions.into_iter().find(|status| status.session == "bad").unwrap();
        let reasons = frames.iter().map(|frame| frame.reason).collect();
        Told { exit, status, reasons, frames, good: (good, good_frames) }
    }
}

impl Told {
    /// Codes of what was lost, in order; each once.
    pub fn losses(&self) -> Vec<&str> {
        self.codes(Severity::Loss)
    }

    /// Codes of what is worth knowing.
    pub fn notes(&self) -> Vec<&str> {
        self.codes(Severity::Note)
    }

    /// The fact of the first problem with that code.
    #[track_caller]
    pub fn fact(&self, code: &str) -> &str {
        let problem = self.status.problems.iter().find(|problem| problem.code.code() == code);
        &problem.unwrap_or_else(|| panic!("no {code} in {:?}", self.status.problems)).fact
    }

    fn codes(&self, severity: Severity) -> Vec<&str> {
        let of_it = self.status.problems.iter().filter(|problem| problem.severity == severity);
        let mut codes: Vec<&str> = of_it.map(|problem| problem.code.code()).collect();
        codes.dedup();
        codes
    }
}

/// Packets of a camera 55 degrees down, at rest.
pub fn acceleration(packets: usize) -> Corruptible {
    let (sin, cos) = 55_f64.to_radians().sin_cos();
    let counts = [0.0, -1000.0 * cos, -1000.0 * sin].map(|count| count.round() as i16);
    // A little noise, so that no packet is like another.
    let value = |packet: usize, axis: usize, i: usize| counts[axis] + ((packet * 31 + i * 7 + axis) % 3) as i16 - 1;
    Corruptible::new((0..packets).flat_map(|p| packet(p, 3, |axis, i| value(p, axis, i))).collect(), ACC_PACKET)
}

/// Packets of a table 500 mm away.
pub fn range(packets: usize) -> Corruptible {
    let value = |packet: usize, i: usize| 499 + ((packet * 13 + i / 2 * 5) % 3) as i16;
    Corruptible::new((0..packets).flat_map(|p| packet(p, 1, |_, i| value(p, i))).collect(), RNG_PACKET)
}

fn packet(number: usize, channels: usize, value: impl Fn(usize, usize) -> i16) -> Vec<u8> {
    let mut bytes = (START_S + number as f64).to_le_bytes().to_vec();
    bytes.extend((number as u32).to_le_bytes());
    bytes.extend((0..channels).flat_map(|c| (0..64).map(move |i| (c, i))).flat_map(|(c, i)| value(c, i).to_le_bytes()));
    bytes
}

/// Name of the image so many seconds after the start, without extension.
pub fn stem(seconds: usize) -> String {
    format!("20240101T00{:02}{:02}Z", seconds / 60, seconds % 60)
}

/// A picture whose bytes are its own.
pub fn picture(shade: usize) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let noise = |x: u32, y: u32| ((x * 2_654_435) ^ (y * 40_503) ^ (shade as u32 * 97)) as u8;
    let picture = image::RgbImage::from_fn(64, 48, |x, y| image::Rgb([noise(x, y), noise(y, x), noise(x + y, x)]));
    picture.write_to(&mut bytes, image::ImageFormat::Jpeg).unwrap();
    bytes.into_inner()
}

pub fn marks() -> serde_json::Value {
    label_me(vec![line("plate/diameter", [[20.0, 24.0], [44.0, 24.0]])])
}
