//! Patterns for paths: `*` for any letters of one name, `?` for one letter, `**` for any number of folders.
//!
//! A matcher of our own and no package: it knows no disk, so it can be tested on names alone and the walk over the disk can be
//! bounded; it takes `/` on every platform; and it needs no more than two short loops. Names that begin with a dot are matched
//! only by patterns that do, as shells have it.

/// Longest pattern in bytes.
const LONGEST: usize = 1000;

/// A path relative to some folder, in which names may hold `*` and `?`, and `**` stands for folders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    text: String,
}

impl Pattern {
    /// Reads a pattern.
    ///
    /// # Errors
    /// Why it is not a pattern, as half a sentence.
    pub fn new(text: &str) -> Result<Self, &'static str> {
        if text.is_empty() {
            return Err("this one is empty");
        }
        if text.len() > LONGEST {
            return Err("this one is too long");
        }
        if text.starts_with('/') || text.get(1..3) == Some(":/") {
            return Err("this one begins at the root");
        }
        if text.contains('\\') {
            return Err("folders and files are separated by `/`, on Windows too");
        }
        if text.contains(['\n', '\r']) {
            return Err("this one has a line break");
        }
        Ok(Self {
            text: text.to_owned(),
        })
    }

    /// As it was written.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Whether it names exactly one file.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        !self.text.contains(['*', '?'])
    }

    /// The folders at its beginning that hold no `*` or `?`: where to look.
    #[must_use]
    pub fn root(&self) -> String {
        let plain: Vec<&str> = self
            .names()
            .take_while(|name| !name.contains(['*', '?']))
            .collect();
        let folders = match self.is_plain() {
            true => plain.split_last().map_or(&[][..], |(_, folders)| folders),
            false => &plain[..],
        };
        folders.join("/")
    }

    /// Whether files below [`Self::root`] can match that lie more than one folder deeper than `depth`.
    #[must_use]
    pub fn reaches_below(&self, depth: usize) -> bool {
        let folders = self.names().count().saturating_sub(1);
        let root = self.names().take_while(|name| !name.contains(['*', '?'])).count();
        self.names().any(|name| name == "**") || root + depth < folders
    }

    /// Whether a path matches, relative to the same folder as the pattern.
    #[must_use]
    pub fn matches(&self, path: &str) -> bool {
        let wanted: Vec<&str> = self.names().collect();
        let given: Vec<&str> = path
            .split('/')
            .filter(|name| !matches!(*name, "" | "."))
            .collect();
        all_match(
            &wanted,
            &given,
            |name| *name == "**",
            |name| !name.starts_with('.'),
            |wanted, given| name_matches(wanted, given),
        )
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.text.split('/').filter(|name| !matches!(*name, "" | "."))
    }
}

fn name_matches(wanted: &str, given: &str) -> bool {
    if given.starts_with('.') && !wanted.starts_with('.') {
        return false;
    }
    let (wanted, given): (Vec<char>, Vec<char>) = (wanted.chars().collect(), given.chars().collect());
    all_match(
        &wanted,
        &given,
        |&letter| letter == '*',
        |_| true,
        |&wanted, given| wanted == '?' || wanted == *given,
    )
}

/// Whether a sequence matches one in which some elements stand for any number of those that they may pass over.
///
/// When the match goes wrong, only the last such element has to take one more: an earlier one cannot help. So the time is at
/// most the product of the lengths.
fn all_match<W, G>(
    wanted: &[W],
    given: &[G],
    is_any: impl Fn(&W) -> bool,
    may_pass: impl Fn(&G) -> bool,
    is_same: impl Fn(&W, &G) -> bool,
) -> bool {
    let (mut next, mut at) = (0, 0);
    // The place after the last element that stands for any number, and how far that one has got.
    let mut again: Option<(usize, usize)> = None;
    while let Some(element) = given.get(at) {
        match wanted.get(next) {
            Some(any) if is_any(any) => {
                next += 1;
                again = Some((next, at));
                continue;
            }
            Some(one) if is_same(one, element) => {
                next += 1;
                at += 1;
                continue;
            }
            Some(_) | None => {}
        }
        match again {
            Some((after, reached)) if given.get(reached).is_some_and(&may_pass) => {
                again = Some((after, reached + 1));
                (next, at) = (after, reached + 1);
            }
            Some(_) | None => return false,
        }
    }
    wanted.get(next..).unwrap_or_default().iter().all(is_any)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn matches(pattern: &str, path: &str) -> bool {
        Pattern::new(pattern).unwrap().matches(path)
    }

    #[test]
    fn stars_stay_within_a_name_and_double_stars_cross_folders() {
        assert!(matches("jobs/*.vcut", "jobs/rib.vcut"));
        assert!(matches("./jobs//r?b.vcut", "jobs/rib.vcut"));
        assert!(!matches("jobs/*.vcut", "jobs/left/rib.vcut"));
        assert!(!matches("*.vcut", "jobs/rib.vcut"));
        assert!(matches("jobs/**/*.vcut", "jobs/rib.vcut"));
        assert!(matches("jobs/**/*.vcut", "jobs/a/b/rib.vcut"));
        assert!(matches("**/rib.vcut", "rib.vcut"));
        assert!(!matches("jobs/*.vcut", "jobs/.hidden.vcut"));
        assert!(!matches("**/*.vcut", ".git/rib.vcut"));
        assert!(matches(".ci/*.vcut", ".ci/rib.vcut"));
        assert!(!matches("jobs/*.vcut", "jobs/rib.vcut.bak"));
        assert!(matches("jobs/\u{e9}?.vcut", "jobs/\u{e9}\u{e9}.vcut"));
    }

    #[test]
    fn where_to_look_is_the_part_without_stars() {
        let root = |text: &str| Pattern::new(text).unwrap().root();
        assert_eq!(root("jobs/left/*.vcut"), "jobs/left");
        assert_eq!(root("jobs/rib.vcut"), "jobs");
        assert_eq!(root("*.vcut"), "");
        assert_eq!(root("../**/rib.vcut"), "..");
        let below = |text: &str, depth| Pattern::new(text).unwrap().reaches_below(depth);
        assert!(!below("jobs/*.vcut", 0));
        assert!(below("jobs/*/*.vcut", 0) && !below("jobs/*/*.vcut", 1));
        assert!(below("jobs/**/*.vcut", 50));
    }

    #[test]
    fn paths_that_lead_elsewhere_are_refused() {
        for text in ["", "/jobs/rib.vcut", "C:/jobs/rib.vcut", "jobs\\rib.vcut", "a\nb"] {
            assert!(Pattern::new(text).is_err(), "{text:?}");
        }
        assert!(Pattern::new(&"*".repeat(LONGEST + 1)).is_err());
    }

    #[test]
    fn many_stars_take_no_time() {
        let pattern = "*a".repeat(400);
        assert!(!matches(&pattern, &"a".repeat(399)));
        assert!(!matches(&"**/a/".repeat(100), &"b/".repeat(400)));
    }

    /// By the definition, as a recursion.
    fn slow(wanted: &[char], given: &[char]) -> bool {
        match (wanted, given) {
            ([], []) => true,
            (['*', rest @ ..], _) => slow(rest, given) || (!given.is_empty() && slow(wanted, &given[1..])),
            (['?', rest @ ..], [_, others @ ..]) => slow(rest, others),
            ([one, rest @ ..], [other, others @ ..]) => one == other && slow(rest, others),
            (_, _) => false,
        }
    }

    proptest! {
        #[test]
        fn names_match_as_they_are_defined_to(wanted in "[ab*?]{0,8}", given in "[ab]{0,8}") {
            let letters = |text: &str| -> Vec<char> { text.chars().collect() };
            prop_assert_eq!(name_matches(&wanted, &given), slow(&letters(&wanted), &letters(&given)));
        }
    }
}
