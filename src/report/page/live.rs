//! What else a page has when a server shows it: its version, and a script that loads it again when there is
//! another one.

use crate::html::Html;

/// The script, to the byte.
pub(super) const SCRIPT: &str = include_str!("../assets/live.js");

/// A page that a server shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Served {
    /// What sets this page apart from all others that were or will be shown at its address.
    pub version: String,
    /// What went wrong apart from the job, shown at the top.
    pub trouble: Option<String>,
}

impl Served {
    /// A page of that version.
    #[must_use]
    pub const fn new(version: String) -> Self {
        Self {
            version,
            trouble: None,
        }
    }

    /// The same, with a message at its top.
    #[must_use]
    pub fn with_trouble(version: String, trouble: &str) -> Self {
        Self {
            version,
            trouble: Some(trouble.to_owned()),
        }
    }

    /// What went wrong, for the top of the page.
    pub(super) fn banner(&self) -> Option<Html> {
        let text = self.trouble.as_ref()?;
        Some(html!(in "<p class=\"trouble\" role=\"alert\">{text}</p>\n", text = text))
    }

    /// The version, for the head of the page.
    pub(super) fn meta(&self) -> Html {
        html!(
            in "<meta name=\"vcutc-version\" content=\"{version}\">\n",
            version = self.version
        )
    }
}
