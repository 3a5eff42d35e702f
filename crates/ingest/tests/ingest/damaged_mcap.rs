//! MCAP files that are cut off or altered: an error that says so, or the data as it was written. Never wrong data.

use aim_batch_ingest::{Sample, SessionReader};

use crate::support::{NOON_S, Study, acceleration_packet, jpeg, range_packet};

/// Everything a reader gives, or the error.
fn read_all(bytes: &[u8]) -> Result<(Vec<Sample>, Vec<Vec<u8>>), String> {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    std::io::Write::write_all(&mut file, bytes).unwrap();
    let mut reader = SessionReader::open(file.path()).map_err(|error| error.to_string())?;
    let mut samples = Vec::new();
    reader.for_each_sample(|sample| samples.push(sample)).map_err(|error| error.to_string())?;
    let mut images = Vec::new();
    for entry in reader.images().map_err(|error| error.to_string())? {
        images.push(reader.image_bytes(&entry.file).map_err(|error| error.to_string())?);
    }
    Ok((samples, images))
}

fn small_mcap() -> Vec<u8> {
    let study = Study::new("aim2-packets");
    let noon = NOON_S as f64;
    study.write("SENSORS/ACC.BIN", &acceleration_packet(noon));
    study.write("SENSORS/RNG.BIN", &range_packet(noon, 400));
    study.write("IMAGES/20250601T120000Z.JPG", &jpeg(32, 24, 9));
    study.ingest();
    std::fs::read(study.out()).unwrap()
}

#[test]
fn a_file_cut_off_anywhere_gives_an_error() {
    let bytes = small_mcap();
    for end in (0..bytes.len()).step_by(997).chain([bytes.len() - 1]) {
        let error = read_all(&bytes[..end]).unwrap_err();
        assert!(error.contains("ends early") || error.contains("damaged"), "cut at {end}: {error}");
    }
    assert!(read_all(b"").unwrap_err().contains("it has no index at its end"));
}

#[test]
fn an_altered_byte_gives_an_error_or_what_was_written() {
    let bytes = small_mcap();
    let original = read_all(&bytes).unwrap();
    let mut errors = 0;
    for at in (0..bytes.len()).step_by(37).chain(bytes.len() - 2000..bytes.len()) {
        for flip in [0x01, 0x80] {
            let mut altered = bytes.clone();
            altered[at] ^= flip;
            match read_all(&altered) {
                Ok(read) => assert_eq!(read, original, "byte {at} altered"),
                Err(_) => errors += 1,
            }
        }
    }
    assert!(errors > 2000, "only {errors} alterations were noticed");
}

#[test]
fn a_file_of_another_program_is_refused() {
    let mut bytes = std::io::Cursor::new(Vec::new());
    mcap::Writer::new(&mut bytes).unwrap().finish().unwrap();
    let error = read_all(bytes.get_ref()).unwrap_err();
    assert!(error.contains("not a file of this program"), "{error}");
}
