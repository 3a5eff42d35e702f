//! Ground truth -> a study on disk: renderer and sensor models.
