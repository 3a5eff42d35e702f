//! Messages as they are in the file, for those who copy them.

use std::path::Path;

use foxglove::messages::CompressedImage;
use model::UtcNs;

use super::summary::ChunkAt;
use super::{Damage, Index, ReadError, SessionReader, chunk};
use crate::mcap_file::metadata::Records;
use crate::mcap_file::topic;
use crate::parse::image_orientation;
use crate::summary::ImageEntry;

/// A message that is not decoded.
#[derive(Debug, Clone)]
pub(crate) struct RawMessage {
    pub topic: String,
    pub sequence: u32,
    pub time: UtcNs,
    pub data: Vec<u8>,
}

impl RawMessage {
    /// The bytes of the image that it holds. `path`: the file that it is from.
    pub fn image(&self, path: &Path) -> Result<Vec<u8>, ReadError> {
        let image: Result<CompressedImage, _> = prost::Message::decode(self.data.as_slice());
        Ok(image.map_err(|error| ReadError::new(path, error.into()))?.data.into())
    }

    /// The message of an image, marked as upright, so that every viewer shows it in the frame of what is drawn over it. `path`: the
    /// file that it is from.
    pub fn upright(self, path: &Path) -> Result<Self, ReadError> {
        let image: Result<CompressedImage, _> = prost::Message::decode(self.data.as_slice());
        let mut image = image.map_err(|error| ReadError::new(path, error.into()))?;
        let Some(upright) = image_orientation::upright(&image.data) else { return Ok(self) };
        image.data = upright.into();
        Ok(Self { data: prost::Message::encode_to_vec(&image), ..self })
    }
}

impl SessionReader {
    /// The chunks that hold samples, in file order.
    pub(crate) fn sensor_chunks(&self) -> Vec<ChunkAt> {
        let topics = self.index.topics_with("");
        let is_sensor =
            |topic: &&str| *topic == topic::ACCELERATION || *topic == topic::RANGE || topic.starts_with(topic::EXTRA);
        let sensors: Vec<&str> = topics.iter().map(String::as_str).filter(is_sensor).collect();
        self.index.chunks_of(&sensors).cloned().collect()
    }

    /// All messages of a chunk.
    pub(crate) fn raw_messages(&self, chunk: &ChunkAt) -> Result<Vec<RawMessage>, ReadError> {
        let mut messages = Vec::new();
        let read = chunk::for_each_message(&self.file, chunk, |header, data| {
            let topic = self.index.topic(header.channel_id).unwrap_or_default().to_owned();
            let time = chunk::time_of(header)?;
            messages.push(RawMessage { topic, sequence: header.sequence, time, data: data.to_owned() });
            Ok(())
        });
        read.map_err(|damage| ReadError::new(&self.path, damage)).map(|()| messages)
    }

    /// The message of an image.
    pub(crate) fn raw_image(&mut self, image: &ImageEntry) -> Result<RawMessage, ReadError> {
        let none = || Damage::NoImage(image.file.clone());
        let listed = self.image_list()?.iter().find(|(entry, _)| entry.file == image.file);
        let sequence = listed.map(|(_, sequence)| *sequence);
        let found = sequence.map(|sequence| self.image_at(image.time, sequence)).transpose();
        match found.map(Option::flatten) {
            Ok(Some(message)) => Ok(message),
            Ok(None) => Err(ReadError::new(&self.path, none())),
            Err(damage) => Err(ReadError::new(&self.path, damage)),
        }
    }

    /// The messages of the list of images.
    pub(crate) fn raw_list(&self) -> Result<Vec<RawMessage>, ReadError> {
        let mut list = Vec::new();
        for chunk in self.index.chunks_of(&[topic::FILE]) {
            list.extend(self.raw_messages(chunk)?.into_iter().filter(|message| message.topic == topic::FILE));
        }
        Ok(list)
    }

    /// The metadata records.
    pub(crate) fn records(&self) -> Result<Records, ReadError> {
        let read = Index::read(&self.file).map_err(|damage| ReadError::new(&self.path, damage))?;
        Ok(read.1)
    }

    pub(super) fn image_at(&self, time: UtcNs, sequence: u32) -> Result<Option<RawMessage>, Damage> {
        for chunk in self.index.chunks_of(&[topic::IMAGE]).filter(|chunk| chunk.covers(time)) {
            let mut found = None;
            chunk::for_each_message(&self.file, chunk, |header, data| {
                let is_image = self.index.topic(header.channel_id) == Some(topic::IMAGE);
                if is_image && header.sequence == sequence && chunk::time_of(header)? == time {
                    let topic = topic::IMAGE.to_owned();
                    found = Some(RawMessage { topic, sequence, time, data: data.to_owned() });
                }
                Ok(())
            })?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }
}
