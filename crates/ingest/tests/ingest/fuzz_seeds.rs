//! The files from which fuzzing starts: well-formed and damaged ones of every kind, small. `AIM_BATCH_UPDATE=1` writes them
//! into `fuzz/corpus/`; files there whose names begin otherwise than `seed-` were found by fuzzing and stay.

mod recordings;

use std::path::{Path, PathBuf};

use fuzz_targets::TARGETS;

use crate::cwa_files::writer::{BlockSpec, RATE_100_HZ, Samples, header, seal};
use crate::support::{jpeg, jpeg_with_exif, png};
use recordings::{mcap, packets, timeline};

const LARGEST_FILE_BYTES: usize = 16 * 1024;
const LARGEST_CORPUS_BYTES: usize = 300 * 1024;

/// The files of a target's corpus, by name.
pub fn corpus(target: &str) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<(String, Vec<u8>)> = std::fs::read_dir(root().join("fuzz/corpus").join(target))
        .unwrap_or_else(|error| panic!("{error}: fuzz/corpus/{target}; AIM_BATCH_UPDATE=1 writes the seeds"))
        .map(|entry| entry.unwrap())
        .map(|entry| (entry.file_name().to_string_lossy().into_owned(), std::fs::read(entry.path()).unwrap()))
        .collect();
    files.sort();
    files
}

/// Every file runs; every seed that is not damaged on purpose still means something to its parser.
#[test]
fn the_corpus_is_read() {
    if std::env::var_os("AIM_BATCH_UPDATE").is_some() {
        write_seeds();
    }
    let mut all_bytes = 0;
    for (target, entry) in TARGETS {
        let files = corpus(target);
        assert!(files.iter().filter(|(name, _)| name.starts_with("seed-")).count() >= 3, "{target}: too few seeds");
        for (name, bytes) in files {
            assert!(bytes.len() <= LARGEST_FILE_BYTES, "{target}/{name}: {} bytes", bytes.len());
            all_bytes += bytes.len();
            let read = entry(&bytes);
            assert!(read > 0 || !name.starts_with("seed-"), "{target}/{name}: nothing is read; write the seeds again");
        }
    }
    assert!(all_bytes <= LARGEST_CORPUS_BYTES, "the corpus has grown to {all_bytes} bytes");
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn write_seeds() {
    let seeds = [
        ("config_toml", config_toml()),
        ("csv", csv()),
        ("cwa", cwa()),
        ("exchange", exchange()),
        ("image", image()),
        ("labelme", labelme()),
        ("mcap", mcap()),
        ("packets", packets()),
        ("timeline", timeline()),
    ];
    for (target, files) in seeds {
        let folder = root().join("fuzz/corpus").join(target);
        std::fs::create_dir_all(&folder).unwrap();
        for (name, bytes) in files {
            std::fs::write(folder.join(format!("seed-{name}")), bytes).unwrap();
        }
    }
}

type Seeds = Vec<(String, Vec<u8>)>;

fn named(name: &str, bytes: impl Into<Vec<u8>>) -> (String, Vec<u8>) {
    (name.to_owned(), bytes.into())
}

fn repository_file(path: &str) -> Vec<u8> {
    std::fs::read(root().join(path)).unwrap()
}

/// The built-in profiles and cameras, and a study of each kind of file.
fn config_toml() -> Seeds {
    let built_in = [
        ("profiles", "aim2-packets"),
        ("profiles", "axivity-cwa"),
        ("profiles", "csv"),
        ("profiles", "pupil-neon"),
        ("profiles", "pupil-invisible"),
        ("cameras", "aim2-raw"),
        ("cameras", "aim2-corrected"),
    ];
    let mut seeds: Seeds = built_in
        .iter()
        .map(|(kind, name)| {
            named(&format!("{name}.toml"), repository_file(&format!("crates/ingest/{kind}/{name}.toml")))
        })
        .collect();
    seeds.push(named("study.toml", repository_file("data-samples/published-bench/study.toml")));
    let session = "participant = \"P01\"\nsetup_height_mm = 450.0\nsetup_pitch_deg = 55\ncamera = \"aim2-raw\"\n\
                   clock_zero_utc = \"2025-06-01T12:00:00Z\"\n";
    seeds.push(named("session.toml", session));
    seeds.push(named("fisheye.toml", CAMERA.replace("LENS", "model = \"fisheye\"\nk1 = 0.01\nk4 = -0.001")));
    seeds.push(named("plumb-bob.toml", CAMERA.replace("LENS", "model = \"plumb_bob\"\nk1 = -0.1\np1 = 0.001")));
    seeds
}

const CAMERA: &str = "schema_version = 1\nname = \"small\"\nwidth_px = 640\nheight_px = 480\nfocal_px = [500.0, 501.0]\n\
                      principal_px = [320.0, 240.0]\n[lens]\nLENS\n";

/// Settings of `fuzz/src/csv.rs`, then the file.
fn csv() -> Seeds {
    let rows = |line: &dyn Fn(u32) -> String| (0..12).map(line).collect::<String>();
    let seed = |settings: [u8; 8], text: String| [&settings[..], text.as_bytes()].concat();
    let range = rows(&|i| format!("1748779200.{i:03},{},{i}\n", 400 + i));
    let acceleration =
        rows(&|i| format!("{}\t{i}\t-1000\t{}\t7\r\n", 1_748_779_200_000_u64 + 10 * u64::from(i), 2 * i));
    let texts = rows(&|i| format!("2025-06-01 12:00:{i:02}.5;\"{}\";\n", 400 + i));
    let zoned = rows(&|i| format!("01.06.2025 01:00:{i:02} PM +0200,{}\n", 500 + i));
    let damaged = "t,range\n1748779200,1\n1748779201,x\n1748779202\n1748779204,\n,5\n1748779203,nan\n1748779203.5,3\n";
    vec![
        named("range", seed([3, 0, 0, 0, 0, 0, 9, 0], format!("t,range,optical\n{range}"))),
        named(
            "milliseconds",
            seed([1, 1, 2, 2, 3, 0, 99, 0], format!("# a\n# b\nt\tx\ty\tz\toptical\n{acceleration}")),
        ),
        named("texts", seed([3, 5, 1, 0, 0, 1, 0, 0], format!(" t ;range;optical\n{texts}"))),
        named("zoned", seed([3, 7, 0, 0, 5, 0, 0, 0], format!("t,range,optical\n{zoned}"))),
        named("counted", seed([10, 4, 0, 0, 0, 0, 9, 0], "0,1\n0,2\n0,\n0,4\n0,5\n".to_owned())),
        named("boot", seed([6, 1, 0, 0, 0, 0, 9, 1], "1099511620,1\n1099511627,2\n3,3\n40,4\n".to_owned())),
        named("local", seed([2, 0, 0, 0, 0, 1, 0, 2], "1762042500,1\n1762045200,2\n1762048800,3\n".to_owned())),
        named("damaged", seed([3, 0, 0, 0, 1, 0, 0, 0], damaged.replace("t,range", "t,range,optical"))),
    ]
}

fn cwa() -> Seeds {
    let block = |i: u32, samples: Samples| BlockSpec {
        sequence: i,
        stamp_s: 36_000.0 + 0.8 * f64::from(i),
        index: 40,
        has_fraction: true,
        rate_code: RATE_100_HZ,
        scales: (0, 4),
        samples,
    };
    let accel = |i: u32| block(i, Samples::Accel((0..80).map(|k| [k, -256, i as i16]).collect())).bytes();
    let gyro = |i: u32| block(i, Samples::GyroAccel((0..40).map(|k| [k, 1, 2, 3, 4, 5]).collect())).bytes();
    let packed = |i: u32| block(i, Samples::Packed((0..120).map(|k| ([k, -256, 3], 1)).collect())).bytes();
    let file = |hardware: u8, blocks: Vec<[u8; 512]>| [header(hardware), blocks.concat()].concat();
    let whole = file(0x17, (0..5).map(accel).collect());
    let mut odd = accel(3);
    odd[28] = 200; // more samples than there is room for
    seal(&mut odd);
    let damaged = [&whole[1024..1600], &[0; 100], &odd, &whole[1536..3000]].concat();
    vec![
        named("accel", whole.clone()),
        named("gyro", file(0x64, [0, 1, 3, 2, 4].map(gyro).to_vec())),
        named("packed", file(0xff, [0, 0, 1, 9].map(packed).to_vec())),
        named("damaged", damaged),
    ]
}

/// Pictures; and a pattern with a name.
fn image() -> Seeds {
    let exif = |time, subsec, offset| jpeg_with_exif(time, subsec, offset);
    vec![
        named("plain.jpg", jpeg(32, 24, 9)),
        named("plain.png", png(32, 24)),
        named("utc.jpg", exif(Some("2025:06:01 12:00:00"), Some("123456"), Some("+01:00"))),
        named("local.jpg", exif(Some("2025:06:01 12:00:00"), None, None)),
        named("no-time.jpg", exif(None, Some("5"), Some("   :  "))),
        named("cut.jpg", &exif(Some("2025:06:01 12:00:00"), Some("5"), None)[..400]),
        named("name", "%Y%m%dT%H%M%S%.fZ\n20250601T120000.250Z.JPG"),
        named("name-seconds", "img_%s\nimg_1748779200.jpg"),
    ]
}

fn labelme() -> Seeds {
    let shape = |label: &str, kind: &str, points: &str| {
        format!("{{\"label\": \"{label}\", \"points\": [{points}], \"shape_type\": \"{kind}\", \"group_id\": null}}")
    };
    let file = |shapes: &[String]| {
        let shapes = shapes.join(", ");
        format!("{{\"version\": \"5.4.1\", \"shapes\": [{shapes}], \"imageWidth\": 640, \"imageHeight\": 480}}")
    };
    let line = shape("red bowl/diameter", "line", "[1, 2], [3.5, 4e2]");
    let height = shape("a/b/height", "linestrip", "[-1, 2], [3, 4]");
    let rim = shape("plate/rim", "polygon", "[1, 2], [3, 4], [5, 6.5], [0.1, 1e-7]");
    let base = shape("plate/base", "points", "[1, 2], [3, 4]");
    let refused = [shape("plate", "line", ""), shape("p/girth", "line", "[1, 2]"), shape("p/rim", "circle", "[1, 2]")];
    vec![
        named("line.json", file(std::slice::from_ref(&line))),
        named("all.json", file(&[line.clone(), height, rim, base])),
        named("refused.json", file(&[&refused[..], std::slice::from_ref(&line)].concat())),
        named("mark.json", format!("\u{feff}{{\"shapes\": [{line}]}}")),
    ]
}

/// CVAT's XML with every shape, a small one, and COCO's JSON with polygons and keypoints.
fn exchange() -> Seeds {
    let skeleton = "<skeleton label=\"red bowl\"><points label=\"height_foot\" points=\"1,2\" outside=\"0\" occluded=\"1\"/>\
                    <points label=\"height_rim\" points=\"3,4\"/></skeleton>";
    let shapes = "<ellipse label=\"rim\" cx=\"30\" cy=\"20\" rx=\"9\" ry=\"4\" rotation=\"7\">\
                  <attribute name=\"object\">pl&#97;te</attribute></ellipse>";
    let xml = format!(
        "<annotations><image name=\"S/a.jpg\" width=\"64\" height=\"48\">{shapes}{skeleton}</image></annotations>"
    );
    let coco = |annotations: &str| {
        format!(
            "{{\"images\": [{{\"id\": 1, \"file_name\": \"a.jpg\", \"width\": 64, \"height\": 48}}], \"categories\": \
             [{{\"id\": 1, \"name\": \"plate/rim\"}}, {{\"id\": 2, \"name\": \"red bowl/width\", \"keypoints\": \
             [\"1\", \"2\"]}}], \"annotations\": [{annotations}]}}"
        )
    };
    let polygon = "{\"id\": 1, \"image_id\": 1, \"category_id\": 1, \"segmentation\": [[1, 2, 3, 4, 5, 6.5]], \"bbox\": [1, 2, 4, 4.5]}";
    let keypoints =
        "{\"id\": 2, \"image_id\": 1, \"category_id\": 2, \"keypoints\": [1, 2, 2, 30, 4e0, 1], \"segmentation\": []}";
    let mask = "{\"id\": 3, \"image_id\": 1, \"category_id\": 1, \"segmentation\": {\"counts\": \"a\", \"size\": [48, 64]}, \"iscrowd\": 1}";
    vec![
        named("cvat-all.xml", repository_file("crates/pipeline/src/exchange/cvat/sample.xml")),
        named("cvat.xml", xml),
        named("coco.json", coco(&[polygon, keypoints].join(", "))),
        named("coco-mask.json", coco(mask)),
    ]
}
