//! What a backend lets a job choose: options with their kinds, ranges and defaults, and the values that were chosen.

use crate::profile::Profile;
use crate::units::Length;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One option of a backend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptionSpec {
    /// Its key.
    pub key: &'static str,
    /// What values it takes.
    pub kind: OptionKind,
    /// One sentence for the documentation.
    pub help: &'static str,
}

impl OptionSpec {
    /// A whole number from one to another, with a default.
    #[must_use]
    pub const fn integer(
        key: &'static str,
        (min, max): (u32, u32),
        default: u32,
        help: &'static str,
    ) -> Self {
        let kind = OptionKind::Integer { min, max, default };
        Self { key, kind, help }
    }

    /// Lines of text.
    #[must_use]
    pub const fn lines(key: &'static str, help: &'static str) -> Self {
        let kind = OptionKind::Lines;
        Self { key, kind, help }
    }

    /// A text on one line.
    #[must_use]
    pub const fn text(key: &'static str, help: &'static str) -> Self {
        let kind = OptionKind::Text;
        Self { key, kind, help }
    }

    /// One of a few words, the first being the default.
    #[must_use]
    pub const fn choice(key: &'static str, of: &'static [&'static str], help: &'static str) -> Self {
        let kind = OptionKind::Choice { of };
        Self { key, kind, help }
    }
}

/// What values an option takes, and its default. Words are those of a linked backend, or those that one outside of the
/// compiler describes ([`crate::protocol::DescribedKind`]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum OptionKind<W = &'static [&'static str]> {
    /// A whole number.
    Integer {
        /// Smallest.
        min: u32,
        /// Largest.
        max: u32,
        /// When not given.
        default: u32,
    },
    /// A length in mm.
    Length {
        /// Smallest.
        min: Length,
        /// Largest.
        max: Length,
        /// When not given.
        default: Length,
    },
    /// Lines of text, none when not given.
    Lines,
    /// One text on one line, empty when not given.
    Text,
    /// One of a few words.
    Choice {
        /// The words; the first is the default.
        of: W,
    },
}

impl<W> OptionKind<W> {
    /// The same with its words in another form.
    ///
    /// # Errors
    /// Why they cannot be had in that form.
    pub fn with_words<V, E>(self, words: impl FnOnce(W) -> Result<V, E>) -> Result<OptionKind<V>, E> {
        Ok(match self {
            Self::Integer { min, max, default } => OptionKind::Integer { min, max, default },
            Self::Length { min, max, default } => OptionKind::Length { min, max, default },
            Self::Lines => OptionKind::Lines,
            Self::Text => OptionKind::Text,
            Self::Choice { of } => OptionKind::Choice { of: words(of)? },
        })
    }
}

/// A value given to an option.
#[derive(Clone, Debug, PartialEq)]
pub enum OptionValue {
    /// A whole number.
    Integer(u32),
    /// A length.
    Length(Length),
    /// Lines of text.
    Lines(Vec<String>),
    /// A text on one line.
    Text(String),
    /// A word.
    Choice(&'static str),
}

/// Options of one backend, complete: what was not given has its default.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    values: BTreeMap<&'static str, OptionValue>,
    profile: Profile,
}

impl Options {
    /// All defaults.
    #[must_use]
    pub fn defaults(specs: &'static [OptionSpec]) -> Self {
        let default = |kind: OptionKind| match kind {
            OptionKind::Integer { default, .. } => OptionValue::Integer(default),
            OptionKind::Length { default, .. } => OptionValue::Length(default),
            OptionKind::Lines => OptionValue::Lines(Vec::new()),
            OptionKind::Text => OptionValue::Text(String::new()),
            OptionKind::Choice { of } => OptionValue::Choice(of.first().copied().unwrap_or_default()),
        };
        Self {
            values: specs.iter().map(|spec| (spec.key, default(spec.kind))).collect(),
            profile: Profile::default(),
        }
    }

    /// With the profile of a machine.
    #[must_use]
    pub fn with_profile(self, profile: Profile) -> Self {
        Self { profile, ..self }
    }

    /// The profile of the machine; all of it open when the job names none.
    #[must_use]
    pub const fn profile(&self) -> &Profile {
        &self.profile
    }

    /// What is set, in the order of the keys.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &OptionValue)> {
        self.values.iter().map(|(key, value)| (*key, value))
    }

    /// Sets an option to a value that fits its kind.
    ///
    /// # Errors
    /// What the option takes, in words, when the value does not fit.
    pub fn set(&mut self, spec: &OptionSpec, value: OptionValue) -> Result<(), String> {
        match (spec.kind, &value) {
            (OptionKind::Integer { min, max, .. }, OptionValue::Integer(n)) if (min..=max).contains(n) => {}
            (OptionKind::Integer { min, max, .. }, _) => {
                return Err(format!("a whole number from {min} to {max}"));
            }
            (OptionKind::Length { min, max, .. }, OptionValue::Length(l)) if (min..=max).contains(l) => {}
            (OptionKind::Length { min, max, .. }, _) => {
                return Err(format!("a length from {} mm to {} mm", min.to_mm(), max.to_mm()));
            }
            (OptionKind::Lines, OptionValue::Lines(_)) => {}
            (OptionKind::Lines, _) => return Err("text in quotes".to_owned()),
            (OptionKind::Text, OptionValue::Text(text)) if !text.contains(['\r', '\n']) => {}
            (OptionKind::Text, _) => return Err("one text in quotes, on one line".to_owned()),
            (OptionKind::Choice { of }, OptionValue::Choice(word)) if of.contains(word) => {}
            (OptionKind::Choice { of }, _) => return Err(format!("one of {}", of.join(", "))),
        }
        self.values.insert(spec.key, value);
        Ok(())
    }

    /// A whole number; 0 for a key that is not such an option (a backend only asks for its own).
    #[must_use]
    pub fn integer(&self, key: &str) -> u32 {
        match self.values.get(key) {
            Some(OptionValue::Integer(n)) => *n,
            _ => 0,
        }
    }

    /// A length; zero for a key that is not such an option.
    #[must_use]
    pub fn length(&self, key: &str) -> Length {
        match self.values.get(key) {
            Some(OptionValue::Length(l)) => *l,
            _ => Length::ZERO,
        }
    }

    /// Lines of text; none for a key that is not such an option.
    #[must_use]
    pub fn lines(&self, key: &str) -> &[String] {
        match self.values.get(key) {
            Some(OptionValue::Lines(lines)) => lines,
            _ => &[],
        }
    }

    /// A text; empty when not given, and for a key that is not such an option.
    #[must_use]
    pub fn text(&self, key: &str) -> &str {
        match self.values.get(key) {
            Some(OptionValue::Text(text)) => text,
            _ => "",
        }
    }

    /// A word; empty for a key that is not such an option.
    #[must_use]
    pub fn choice(&self, key: &str) -> &'static str {
        match self.values.get(key) {
            Some(OptionValue::Choice(word)) => word,
            _ => "",
        }
    }
}
