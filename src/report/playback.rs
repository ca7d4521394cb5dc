//! The playback of a report.
