//! The metadata records of a session's MCAP file, to and from text.

use std::collections::BTreeMap;

use sha2::{Digest, Sha256};

use model::{CameraSpec, Problem};
use serde::de::DeserializeOwned;

use crate::profile::Profile;
use crate::summary::{Counts, DroppedImage};
use crate::timeline::Timeline;

pub(crate) const SESSION: &str = "aim_batch.session";
pub(crate) const PROFILE: &str = "aim_batch.profile";
pub(crate) const CAMERA: &str = "aim_batch.camera";
pub(crate) const INPUTS: &str = "aim_batch.inputs";
pub(crate) const DROPPED_IMAGES: &str = "aim_batch.dropped_images";
pub(crate) const TIMELINE: &str = "aim_batch.timeline";
pub(crate) const PROBLEMS: &str = "aim_batch.problems";
/// SHA-256 of all the others: chunks carry checksums, metadata records do not.
pub(crate) const SEAL: &str = "aim_batch.seal";
/// In an annotated recording: what its notes are made from.
pub(crate) const ANNOTATED: &str = "aim_batch.annotated";

/// Metadata records by name.
pub(crate) type Records = BTreeMap<String, BTreeMap<String, String>>;

/// The facts in the metadata of one session.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Facts {
    pub session: String,
    pub program: String,
    pub ingest_version: u32,
    pub key: String,
    pub time_zone: String,
    pub counts: Counts,
    pub timeline: Timeline,
    pub profile: Profile,
    pub camera: CameraSpec,
    pub inputs_sha256: BTreeMap<String, String>,
    pub dropped_images: Vec<DroppedImage>,
    pub problems: Vec<Problem>,
}

/// A record that is missing, or whose text is not what it should be.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("metadata record {record}: {fact}")]
pub struct MetadataError {
    /// Name of the record.
    pub record: String,
    /// The fault.
    pub fact: String,
}

impl Facts {
    pub fn to_records(&self) -> Result<Records, MetadataError> {
        let session = BTreeMap::from([
            ("session".to_owned(), self.session.clone()),
            ("program".to_owned(), self.program.clone()),
            ("ingest_version".to_owned(), self.ingest_version.to_string()),
            ("key".to_owned(), self.key.clone()),
            ("time_zone".to_owned(), self.time_zone.clone()),
            ("profile_name".to_owned(), self.profile.name.clone()),
            ("profile_version".to_owned(), self.profile.version.clone()),
            ("mount_pitch_deg".to_owned(), self.profile.mount_pitch_deg.to_string()),
            ("counts".to_owned(), json(SESSION, &self.counts)?),
        ]);
        let one = |key: &str, value: String| BTreeMap::from([(key.to_owned(), value)]);
        let mut records = Records::from([
            (SESSION.to_owned(), session),
            (PROFILE.to_owned(), one("toml", toml_text(PROFILE, &self.profile)?)),
            (CAMERA.to_owned(), one("toml", toml_text(CAMERA, &self.camera)?)),
            (INPUTS.to_owned(), self.inputs_sha256.clone()),
            (DROPPED_IMAGES.to_owned(), one("json", json(DROPPED_IMAGES, &self.dropped_images)?)),
            (TIMELINE.to_owned(), one("json", json(TIMELINE, &self.timeline)?)),
            (PROBLEMS.to_owned(), one("json", json(PROBLEMS, &self.problems)?)),
        ]);
        records.insert(SEAL.to_owned(), one("sha256", seal(&records)));
        Ok(records)
    }

    pub fn from_records(mut records: Records) -> Result<Self, MetadataError> {
        let sealed = records.remove(SEAL).and_then(|mut record| record.remove("sha256"));
        let sealed = sealed.ok_or_else(|| wrong(SEAL, "missing: not a file of this program"))?;
        if sealed != seal(&records) {
            return Err(wrong(SEAL, "the metadata is not what was written: the file is damaged"));
        }
        let session = records.get(SESSION).ok_or_else(|| wrong(SESSION, "missing"))?;
        let text = |key: &str| session.get(key).cloned().ok_or_else(|| wrong(SESSION, format!("no key {key}")));
        let version = text("ingest_version")?;
        Ok(Self {
            session: text("session")?,
            program: text("program")?,
            ingest_version: version.parse().map_err(|_| wrong(SESSION, format!("ingest_version is '{version}'")))?,
            key: text("key")?,
            time_zone: text("time_zone")?,
            counts: from_json(&records, SESSION, "counts")?,
            timeline: from_json(&records, TIMELINE, "json")?,
            profile: from_toml(&records, PROFILE)?,
            camera: from_toml(&records, CAMERA)?,
            dropped_images: from_json(&records, DROPPED_IMAGES, "json")?,
            problems: from_json(&records, PROBLEMS, "json")?,
            inputs_sha256: records.remove(INPUTS).ok_or_else(|| wrong(INPUTS, "missing"))?,
        })
    }
}

/// The records of a recording, for one with notes that were made from `key`.
pub(crate) fn annotated(mut records: Records, key: &str) -> Records {
    records.remove(SEAL);
    records.insert(ANNOTATED.to_owned(), BTreeMap::from([("key".to_owned(), key.to_owned())]));
    let sealed = seal(&records);
    records.insert(SEAL.to_owned(), BTreeMap::from([("sha256".to_owned(), sealed)]));
    records
}

fn seal(records: &Records) -> String {
    let mut hasher = Sha256::new();
    let mut add = |text: &str| {
        hasher.update((text.len() as u64).to_le_bytes());
        hasher.update(text);
    };
    for (name, record) in records {
        add(name);
        for (key, value) in record {
            add(key);
            add(value);
        }
    }
    format!("{:x}", hasher.finalize())
}

fn wrong(record: &str, fact: impl Into<String>) -> MetadataError {
    MetadataError { record: record.to_owned(), fact: fact.into() }
}

fn json<T: serde::Serialize>(record: &str, value: &T) -> Result<String, MetadataError> {
    serde_json::to_string(value).map_err(|error| wrong(record, error.to_string()))
}

pub(crate) fn toml_text<T: serde::Serialize>(record: &str, value: &T) -> Result<String, MetadataError> {
    toml::to_string(value).map_err(|error| wrong(record, error.to_string()))
}

fn text_of<'r>(records: &'r Records, record: &str, key: &str) -> Result<&'r str, MetadataError> {
    let text = records.get(record).and_then(|map| map.get(key));
    text.map(String::as_str).ok_or_else(|| wrong(record, format!("no key {key}")))
}

fn from_json<T: DeserializeOwned>(records: &Records, record: &str, key: &str) -> Result<T, MetadataError> {
    serde_json::from_str(text_of(records, record, key)?).map_err(|error| wrong(record, error.to_string()))
}

fn from_toml<T: DeserializeOwned>(records: &Records, record: &str) -> Result<T, MetadataError> {
    toml::from_str(text_of(records, record, "toml")?).map_err(|error| wrong(record, error.message()))
}
