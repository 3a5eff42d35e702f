//! SD card -> one MCAP file per session, and MCAP -> typed streams.
