//! What a page has besides when a server shows it: its version, and a script that loads it anew when there is another one.

use super::html::escaped;

/// The script, to the byte.
pub(super) const SCRIPT: &str = include_str!("../assets/live.js");

/// A page that a server shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Served {
    /// What sets this page apart from all others that were or will be shown at its address.
    pub version: String,
}

impl Served {
    /// The version, for the head of the page.
    pub(super) fn meta(&self) -> String {
        format!(
            "<meta name=\"vcutc-version\" content=\"{}\">\n",
            escaped(&self.version)
        )
    }
}

/// The script in its element, for the end of the page.
pub(super) fn element() -> String {
    format!("<script>{SCRIPT}</script>\n")
}
