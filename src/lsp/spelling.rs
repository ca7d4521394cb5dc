//! URIs as clients spell them.
//!
//! Some clients send blanks, umlauts or brackets in URIs as they are, which RFC 3986 does not allow. Inside the server every URI
//! is one; on the way in such a URI is put into the standard's form, and on the way out it gets its client's own letters again:
//! many clients find a document by them, letter by letter.

use super::uri::encoded;
use lsp_types::Uri;
use serde_json::Value;
use std::collections::BTreeMap;

/// Keys under which messages hold URIs.
const KEYS: [&str; 3] = ["uri", "rootUri", "targetUri"];

/// The spellings of a client, by the URIs that they stand for.
#[derive(Debug, Default)]
pub(super) struct Spellings(BTreeMap<String, String>);

impl Spellings {
    /// Puts the URIs of a message that came in into the standard's form.
    pub(super) fn read(&mut self, message: &mut Value) {
        each_uri(message, &mut |text| {
            if text.parse::<Uri>().is_err() {
                let standard = standard(text);
                self.0
                    .insert(standard.clone(), core::mem::replace(text, standard));
            }
        });
    }

    /// Gives the URIs of a message that goes out their client's letters.
    pub(super) fn write(&self, message: &mut Value) {
        if self.0.is_empty() {
            return;
        }
        each_uri(message, &mut |text| {
            if let Some(spelling) = self.0.get(text) {
                text.clone_from(spelling);
            }
        });
    }
}

/// Goes through all URIs of a message: values of certain keys, and the keys of `changes`. As deep as JSON is read.
fn each_uri(message: &mut Value, change: &mut dyn FnMut(&mut String)) {
    match message {
        Value::Object(fields) => {
            for (key, value) in &mut *fields {
                match value {
                    Value::String(text) if KEYS.contains(&key.as_str()) => change(text),
                    Value::Object(by_uri) if key == "changes" => {
                        let edits = core::mem::take(by_uri).into_iter();
                        *by_uri = edits
                            .map(|(mut uri, edits)| {
                                change(&mut uri);
                                (uri, edits)
                            })
                            .collect();
                    }
                    Value::Null
                    | Value::Bool(_)
                    | Value::Number(_)
                    | Value::String(_)
                    | Value::Array(_)
                    | Value::Object(_) => each_uri(value, change),
                }
            }
        }
        Value::Array(values) => {
            for value in values {
                each_uri(value, change);
            }
        }
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

/// The URI that a text most likely means: what cannot follow its scheme is escaped, escapes stay.
fn standard(text: &str) -> String {
    let (scheme, rest) = match text.split_once(':') {
        Some((scheme, rest)) if is_scheme(scheme) => (Some(scheme), rest),
        Some(_) | None => (None, text),
    };
    let mut uri = scheme.map_or(String::new(), |scheme| format!("{scheme}:"));
    let mut pieces = rest.split('%');
    uri += &encoded(pieces.next().unwrap_or_default());
    for piece in pieces {
        let escape = piece
            .get(..2)
            .filter(|digits| digits.bytes().all(|digit| digit.is_ascii_hexdigit()));
        uri += &match escape {
            Some(digits) => format!("%{digits}{}", encoded(piece.get(2..).unwrap_or_default())),
            None => format!("%25{}", encoded(piece)),
        };
    }
    uri
}

fn is_scheme(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_alphabetic())
        && text
            .chars()
            .all(|letter| letter.is_ascii_alphanumeric() || matches!(letter, '+' | '-' | '.'))
}

#[cfg(test)]
mod tests {
    use super::super::uri::path_of;
    use super::*;
    use proptest::prelude::*;
    use serde_json::json;

    #[test]
    fn a_client_gets_its_own_letters_back() {
        let raw = "file:///Flügel der C 172/rib [2] 100%.vcut";
        let mut spellings = Spellings::default();
        let mut message = json!({
            "textDocument": { "uri": raw, "text": raw },
            "workspaceFolders": [{ "uri": "file:///a%20b" }],
        });
        spellings.read(&mut message);
        let read = message["textDocument"]["uri"].as_str().unwrap().to_owned();
        assert_eq!(
            read,
            "file:///Fl%C3%BCgel%20der%20C%20172/rib%20%5B2%5D%20100%25.vcut"
        );
        assert_eq!(
            path_of(&read.parse().unwrap()),
            "/Flügel der C 172/rib [2] 100%.vcut"
        );
        assert_eq!(message["textDocument"]["text"], raw, "texts are no URIs");
        assert_eq!(message["workspaceFolders"][0]["uri"], "file:///a%20b");

        let mut answer = json!({ "changes": { read.clone(): [1] }, "items": [{ "uri": read }] });
        spellings.write(&mut answer);
        assert_eq!(
            answer,
            json!({ "changes": { raw: [1] }, "items": [{ "uri": raw }] })
        );
    }

    proptest! {
        /// Whatever a client writes is a URI afterwards, and means what it meant.
        #[test]
        fn every_spelling_is_understood(path in "/(\\PC|%){0,24}") {
            prop_assume!(!path.get(1..3).is_some_and(|drive| drive.ends_with(':')));
            prop_assume!(!path.starts_with("//"));
            let raw = format!("file://{path}");
            let uri: Uri = standard(&raw).parse().unwrap();
            if !path.contains('%') {
                prop_assert_eq!(path_of(&uri), path);
            }
        }
    }
}
