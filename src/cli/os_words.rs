//! What the operating system refuses, in a sentence that says what to do about it.

use std::io::{self, ErrorKind};

/// An error of the operating system in words, without its number and without the passing names of temporary files.
pub(super) fn os_words(error: &io::Error) -> String {
    let known = match error.kind() {
        ErrorKind::NotFound => "there is no such file or folder: check the path",
        ErrorKind::PermissionDenied => {
            "this user has no permission for that: change the permissions of the file or its folder, or choose another place"
        }
        ErrorKind::IsADirectory => "it is a folder: give the name of a file",
        ErrorKind::NotADirectory => "a part of its path is a file, not a folder: check the path",
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "there is no space left: free some, or choose a place on another disk"
        }
        ErrorKind::ReadOnlyFilesystem => "the disk can only be read: choose a place on another disk",
        ErrorKind::InvalidFilename => {
            "its name is too long, or has characters that the disk does not take: choose another"
        }
        ErrorKind::InvalidData => "it is not UTF-8 text: save it in that encoding",
        _ => return plain(error),
    };
    known.to_owned()
}

/// The system's own words, without what is of no use to a person.
fn plain(error: &io::Error) -> String {
    let words = error.to_string();
    let words = words
        .split_once(" at path ")
        .map_or(words.as_str(), |(what, _)| what);
    let words = words.split_once(" (os error ").map_or(words, |(what, _)| what);
    words.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_common_refusal_says_what_to_do() {
        for kind in [
            ErrorKind::NotFound,
            ErrorKind::PermissionDenied,
            ErrorKind::IsADirectory,
            ErrorKind::NotADirectory,
            ErrorKind::StorageFull,
            ErrorKind::QuotaExceeded,
            ErrorKind::ReadOnlyFilesystem,
            ErrorKind::InvalidFilename,
            ErrorKind::InvalidData,
        ] {
            let words = os_words(&io::Error::from(kind));
            let (what, advice) = words.split_once(": ").unwrap();
            assert!(!what.is_empty() && !advice.is_empty(), "{words}");
        }
    }

    #[test]
    fn other_words_are_left_without_numbers_and_passing_names() {
        let error = io::Error::other("something (os error 5) at path \"/tmp/.vcutc-x\"");
        assert_eq!(os_words(&error), "something");
    }
}
