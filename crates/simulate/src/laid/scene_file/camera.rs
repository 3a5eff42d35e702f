//! The camera of a scene file.

use model::CameraSpec;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// `camera = "NAME"`, or a table with the keys of a camera file.
#[derive(Debug, Clone, PartialEq)]
pub enum SceneCamera {
    /// A built-in camera, or a camera file beside the scene file.
    Named(String),
    /// A camera of the scene's own.
    Own(Box<CameraSpec>),
}

impl<'de> Deserialize<'de> for SceneCamera {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CameraVisitor)
    }
}

/// A visitor in place of an untagged enum, whose errors would not say which key is wrong, and where.
struct CameraVisitor;

impl<'de> Visitor<'de> for CameraVisitor {
    type Value = SceneCamera;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("the name of a camera, or a table with the keys of a camera file")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<SceneCamera, E> {
        Ok(SceneCamera::Named(name.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<SceneCamera, A::Error> {
        CameraSpec::deserialize(MapAccessDeserializer::new(map)).map(|spec| SceneCamera::Own(Box::new(spec)))
    }
}
