//! The page's content security policy: nothing is loaded, and only the page's own scripts run, each known by its hash.
//!
//! Styles are not restricted: without images and fonts a style has nothing to ask for.

use crate::base64::base64;
use crate::digest::sha256;

/// What a page may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Requests {
    /// Nothing: it is complete in itself.
    None,
    /// The server that it came from, for changes.
    OwnServer,
}

/// The policy, as the content of a `meta` element, for a page with these scripts. A script is what stands between its tags, to
/// the byte.
pub(crate) fn policy(scripts: &[&str], requests: Requests) -> String {
    let hashes: Vec<String> = scripts
        .iter()
        .map(|script| format!("'sha256-{}'", base64(&sha256(script.as_bytes()))))
        .collect();
    let allowed = if hashes.is_empty() {
        "'none'".to_owned()
    } else {
        hashes.join(" ")
    };
    let requests = match requests {
        Requests::None => "",
        Requests::OwnServer => " connect-src 'self';",
    };
    format!(
        "default-src 'none';{requests} script-src {allowed}; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of the standard (CSP level 3, section 2.3.1): `alert('Hello, world.');`.
    #[test]
    fn scripts_are_known_by_their_hash() {
        let policy = policy(&["alert('Hello, world.');"], Requests::None);
        assert!(
            policy.contains("'sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng='"),
            "{policy}"
        );
        assert!(!policy.contains("connect-src"), "{policy}");
        let none = super::policy(&[], Requests::None);
        assert!(none.contains("script-src 'none';"), "{none}");
    }
}
