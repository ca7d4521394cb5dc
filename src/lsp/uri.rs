//! Paths as the compiler knows them and the URIs by which editors call documents.
//!
//! A path uses `/`. On Windows a URI is `file:///c%3A/jobs/rib.vcut` and the path `c:/jobs/rib.vcut`; on other systems the
//! path begins with `/`. What has no path, such as `untitled:Untitled-1`, is its own name: it holds no file, and files that
//! it uses are not found.

use lsp_types::Uri;
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use std::borrow::Cow;

/// The path of a document.
pub(super) fn path_of(uri: &Uri) -> String {
    let text = uri.as_str();
    let Some(rest) = text.strip_prefix("file://") else {
        return text.to_owned();
    };
    // A host, which only Windows has any use for: `file://server/share` is `//server/share`.
    let (host, path) = rest.split_at(rest.find('/').unwrap_or(rest.len()));
    let path = decoded(path);
    let has_drive = {
        let mut letters = path.chars().skip(1);
        letters.next().is_some_and(|c| c.is_ascii_alphabetic()) && letters.next() == Some(':')
    };
    match (host, has_drive) {
        ("" | "localhost", true) => path.get(1..).unwrap_or_default().to_owned(),
        ("" | "localhost", false) => path,
        (host, _) => format!("//{host}{path}"),
    }
}

/// The URI of a path; none for one that cannot be said as such.
pub(super) fn uri_of(path: &str) -> Option<Uri> {
    let is_uri = path.split_once(':').is_some_and(|(scheme, _)| scheme.len() > 1) && !path.starts_with('/');
    if is_uri {
        return path.parse().ok();
    }
    let slash = if path.starts_with('/') { "" } else { "/" };
    format!("file://{slash}{}", encoded(path)).parse().ok()
}

/// `%C3%A4` is `ä`. What is not such an escape, or not text in UTF-8, stays as it is.
fn decoded(text: &str) -> String {
    let decoded = percent_decode_str(text).decode_utf8();
    decoded.map_or_else(|_| text.to_owned(), Cow::into_owned)
}

/// All but what RFC 3986 calls unreserved, and `/`. Editors escape the colon of a drive too.
const ESCAPED: AsciiSet = NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'.')
    .remove(b'_')
    .remove(b'~')
    .remove(b'/');

/// A path with escapes.
pub(super) fn encoded(path: &str) -> String {
    utf8_percent_encode(path, &ESCAPED).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn path(uri: &str) -> String {
        path_of(&uri.parse().unwrap())
    }

    #[test]
    fn paths_come_out_of_the_uris_of_editors() {
        assert_eq!(
            path("file:///home/%C3%A4%20b/rib%231.vcut"),
            "/home/ä b/rib#1.vcut"
        );
        assert_eq!(path("file:///c%3A/jobs/rib.vcut"), "c:/jobs/rib.vcut");
        assert_eq!(path("file:///C:/jobs/rib.vcut"), "C:/jobs/rib.vcut");
        assert_eq!(path("file://localhost/jobs/rib.vcut"), "/jobs/rib.vcut");
        assert_eq!(path("file://server/share/rib.vcut"), "//server/share/rib.vcut");
        assert_eq!(path("untitled:Untitled-1"), "untitled:Untitled-1");
        assert_eq!(path("file:///100%25/%FF"), "/100%25/%FF", "no UTF-8: left alone");
    }

    #[test]
    fn uris_are_those_of_editors() {
        let uri = |path: &str| uri_of(path).unwrap().as_str().to_owned();
        assert_eq!(
            uri("/home/ä b/rib#1.vcut"),
            "file:///home/%C3%A4%20b/rib%231.vcut"
        );
        assert_eq!(uri("c:/jobs/rib.vcut"), "file:///c%3A/jobs/rib.vcut");
        assert_eq!(uri("untitled:Untitled-1"), "untitled:Untitled-1");
    }

    proptest! {
        #[test]
        fn every_path_comes_back(path in "/(\\PC){0,24}") {
            prop_assume!(!path.get(1..3).is_some_and(|drive| drive.ends_with(':')));
            let uri = uri_of(&path).unwrap();
            prop_assert!(uri.as_str().is_ascii());
            prop_assert_eq!(path_of(&uri), path);
        }
    }
}
