//! The trait a backend implements, and the data it speaks in.
//!
//! A backend answers what it can do ([`Backend::capabilities`], [`Backend::options`]), then whether it can say a given
//! program ([`Backend::check`]); the [`Emission`] which that returns is the proof that it can, and is the only thing that
//! writes. Problems are data ([`BackendIssue`]), never text: the compiler puts them into words and finds the place in
//! the source.

use crate::bundle::{Sink, SinkError};
use crate::ir::{MachineKind, Maker, OpId};
use crate::motion::ReachableProgram;
use crate::number::NotFinite;
use crate::profile::Profile;
use crate::readback::Reader;
use crate::units::Length;
use crate::verify::Capabilities;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Where a backend is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// It is linked into the compiler, and its faults are those of the compiler.
    Linked,
    /// It is a program of its own, with authors of its own.
    Outside,
}

/// One output dialect.
pub trait Backend: Sync {
    /// The word after `--target`, and the name of its options block in the job.
    fn id(&self) -> &'static str;

    /// What it is, in one line, for `--help`.
    fn summary(&self) -> &'static str;

    /// What the dialect can say.
    fn capabilities(&self) -> Capabilities;

    /// The options it takes.
    fn options(&self) -> &'static [OptionSpec];

    /// Whose fault it is when what was written is not what was asked for.
    fn origin(&self) -> Origin {
        Origin::Linked
    }

    /// Whether it can be asked, and has answered so far. Backends that are linked in always can; one that is a program of its own may
    /// be broken.
    ///
    /// # Errors
    /// What it did when it was asked.
    fn ready(&self) -> Result<(), Fault> {
        Ok(())
    }

    /// Why it drives no machine of that kind and maker, as far as these two decide it; none where it may drive them. Asked
    /// before there is a program, so that it is not offered for a job that it would refuse.
    fn mismatch(&self, kind: MachineKind, maker: Maker) -> Option<MachineMismatch> {
        let _ = (kind, maker);
        None
    }

    /// Who reads its programs back; none when nobody can, and then nothing checks what was written.
    fn reader(&self) -> Option<&dyn Reader>;

    /// Whether the dialect can say this program with these options, and the writer if it can.
    ///
    /// # Errors
    /// Everything that stands in the way, not only the first thing.
    fn check<'p>(
        &self,
        program: &'p ReachableProgram,
        options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>>;
}

/// A program that a backend has found sayable.
pub trait Emission {
    /// Writes all files. The same program and options give the same bytes, always.
    ///
    /// # Errors
    /// What the sink reports, or a broken promise of the backend itself.
    fn write(&self, sink: &mut dyn Sink) -> Result<(), EmitError>;
}

/// Why a program was not written after all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EmitError {
    /// The sink did not take the bytes.
    Sink(SinkError),
    /// A value that a verified program cannot hold: a fault in the compiler, not in the job.
    Internal(&'static str),
}

impl From<SinkError> for EmitError {
    fn from(error: SinkError) -> Self {
        Self::Sink(error)
    }
}

impl From<NotFinite> for EmitError {
    fn from(_: NotFinite) -> Self {
        Self::Internal("a number to print is not finite")
    }
}

/// Why a dialect cannot say a program.
#[derive(Clone, Debug, PartialEq)]
pub enum BackendIssue {
    /// The dialect does not drive such a machine.
    WrongMachine {
        /// What of it is not as it should be.
        mismatch: MachineMismatch,
        /// What the dialect drives, such as `KUKA robots with six axes`.
        drives: &'static str,
    },
    /// The machine block lacks something the dialect needs.
    MissingMachineField {
        /// The field's name in the language.
        field: &'static str,
        /// What it is for.
        why: &'static str,
    },
    /// Two options, or an option and the program, do not go together.
    OptionConflict {
        /// The option.
        key: &'static str,
        /// Why not.
        why: String,
    },
    /// The profile asks for something that the dialect does not have, or cannot take.
    Profile {
        /// The key of the profile.
        key: &'static str,
        /// Why not.
        why: String,
    },
    /// The dialect has no such op.
    Unsupported {
        /// Where.
        op: OpId,
        /// What is missing.
        what: &'static str,
    },
    /// A number that the dialect or the controller does not take.
    OutOfRange {
        /// Where, if in the program's ops.
        op: Option<OpId>,
        /// What it is, such as `X` or `output number`.
        what: &'static str,
        /// Its value as text with unit.
        value: String,
        /// What is allowed, as text.
        allowed: String,
        /// The value and the ends of what is allowed as numbers, where it is one range: from these the compiler offers values of the
        /// job that are allowed.
        range: Option<Exceeded>,
    },
    /// The program behind the dialect did not do its work. Only programs outside of the compiler can fail so
    /// ([`crate::protocol`]).
    Failed(Fault),
}

/// A value and the range that it is not in, in one unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Exceeded {
    /// The value.
    pub value: f64,
    /// The least that is allowed.
    pub least: f64,
    /// The most that is allowed.
    pub most: f64,
}

impl Exceeded {
    /// By what the value has to be multiplied to come to the nearer end of the range; none where no factor does.
    #[must_use]
    pub fn factor(&self) -> Option<f64> {
        let end = if self.value < self.least {
            self.least
        } else {
            self.most
        };
        let factor = end / self.value;
        (factor.is_finite() && factor > 0.0).then_some(factor)
    }
}

/// What a program outside of the compiler did instead of its work.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Where, if about one op.
    pub op: Option<OpId>,
    /// What it did, such as `ended with exit status 3`.
    pub what: String,
    /// What it said itself, line by line.
    pub said: Vec<String>,
}

/// What sets a machine apart from those that a dialect drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum MachineMismatch {
    /// Its kind.
    Kind,
    /// The maker of its controller.
    Maker,
    /// Its arm: the number or kind of its axes, or branches that the dialect cannot name.
    Arm,
}

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

/// What values an option takes, and its default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OptionKind {
    /// A whole number.
    Integer {
        /// Smallest.
        min: u32,
        /// Largest.
        max: u32,
        /// When not given.
        default: u32,
    },
    /// A length.
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
    /// A text on one line, empty when not given.
    Text,
    /// One of a few words.
    Choice {
        /// The words; the first is the default.
        of: &'static [&'static str],
    },
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

    /// With the habits of a machine.
    #[must_use]
    pub fn with_profile(self, profile: Profile) -> Self {
        Self { profile, ..self }
    }

    /// The habits of the machine; all of them open when the job names none.
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

    /// A whole number; 0 for a key that is no such option (a backend only asks for its own).
    #[must_use]
    pub fn integer(&self, key: &str) -> u32 {
        match self.values.get(key) {
            Some(OptionValue::Integer(n)) => *n,
            _ => 0,
        }
    }

    /// A length; zero for a key that is no such option.
    #[must_use]
    pub fn length(&self, key: &str) -> Length {
        match self.values.get(key) {
            Some(OptionValue::Length(l)) => *l,
            _ => Length::ZERO,
        }
    }

    /// Lines of text; none for a key that is no such option.
    #[must_use]
    pub fn lines(&self, key: &str) -> &[String] {
        match self.values.get(key) {
            Some(OptionValue::Lines(lines)) => lines,
            _ => &[],
        }
    }

    /// A text; empty when not given, and for a key that is no such option.
    #[must_use]
    pub fn text(&self, key: &str) -> &str {
        match self.values.get(key) {
            Some(OptionValue::Text(text)) => text,
            _ => "",
        }
    }

    /// A word; empty for a key that is no such option.
    #[must_use]
    pub fn choice(&self, key: &str) -> &'static str {
        match self.values.get(key) {
            Some(OptionValue::Choice(word)) => word,
            _ => "",
        }
    }
}
