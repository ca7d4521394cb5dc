//! What the compiler and a program outside of it say to each other.
//!
//! A target need not be linked in: a program `vcutc-backend-NAME` that speaks this protocol is one too. For every question
//! the compiler starts the program, writes one [`Request`] as JSON to its standard input, and reads one reply as JSON from
//! its standard output; then the program ends. Three things are asked:
//!
//! | [`Ask`] | Reply | When |
//! | --- | --- | --- |
//! | `describe` | [`Description`] | before all else |
//! | `emit` | [`Emitted`] | to write a program |
//! | `read` | [`ReadBack`] | to read one, when the description says that it can |
//!
//! `docs/backends.md` explains it with an example; `docs/schema/backend.json` is the schema. Units are those of the program
//! (mm, rad, s, kg, see `docs/ir.md`). Keys that a reader does not know it passes over: a later compiler may add some
//! without another version. A change that old readers would misread raises [`PROTOCOL_VERSION`].

use crate::backend::{Exceeded, MachineMismatch, OptionKind, OptionValue, Options};
use crate::exchange::Exchange;
use crate::ir::{Cell, MachineKind, Maker, OpId};
use crate::motion::{Branch, Elbow, Shoulder, Wrist};
use crate::profile::Profile;
use crate::readback::{Configuration, Frames, ProgramFile, Resolution, Statement};
use crate::units::Length;
use crate::verify::Capability;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Version of the protocol that this crate speaks.
pub const PROTOCOL_VERSION: u32 = 2;

/// What the names of outside programs begin with.
pub const PROGRAM_PREFIX: &str = "vcutc-backend-";

/// What the compiler writes to the program's standard input.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Request<'a> {
    /// Version of the protocol, [`PROTOCOL_VERSION`].
    pub protocol: u32,
    /// Version of the compiler, such as `0.1.0`; for messages.
    pub compiler: Cow<'a, str>,
    /// The question.
    #[serde(flatten)]
    pub ask: Ask<'a>,
}

/// A question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "ask", rename_all = "snake_case")]
#[allow(
    clippy::large_enum_variant,
    reason = "there is one at a time, and it is written or read at once"
)]
pub enum Ask<'a> {
    /// What are you? Answered by a [`Description`].
    Describe,
    /// Write this program. Answered by [`Emitted`].
    Emit(Emit<'a>),
    /// Read these files. Answered by a [`ReadBack`].
    Read(Read<'a>),
}

/// A program to write.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Emit<'a> {
    /// The program with the motion of its machine, as `--emit ir` shows it.
    pub program: Exchange<'a>,
    /// All options: what the job does not give has its default.
    pub options: BTreeMap<Cow<'a, str>, Value<'a>>,
    /// The habits of the machine.
    pub profile: Cow<'a, Profile>,
}

/// Files to read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Read<'a> {
    /// The files, which people may have edited.
    pub files: Cow<'a, [ProgramFile]>,
    /// The machine that they are for.
    pub cell: Cow<'a, Cell>,
    /// All options of the job.
    pub options: BTreeMap<Cow<'a, str>, Value<'a>>,
    /// The habits of the machine.
    pub profile: Cow<'a, Profile>,
}

/// The value of an option.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum Value<'a> {
    /// A whole number.
    Integer(u32),
    /// A length in mm.
    Length(Length),
    /// Lines of text.
    Lines(Cow<'a, [String]>),
    /// A word, or one text.
    Text(Cow<'a, str>),
}

/// All options by their keys.
#[must_use]
pub fn values(options: &Options) -> BTreeMap<Cow<'_, str>, Value<'_>> {
    let value = |value| match value {
        &OptionValue::Integer(number) => Value::Integer(number),
        &OptionValue::Length(length) => Value::Length(length),
        OptionValue::Lines(lines) => Value::Lines(Cow::Borrowed(lines)),
        OptionValue::Text(text) => Value::Text(Cow::Borrowed(text)),
        &OptionValue::Choice(word) => Value::Text(Cow::Borrowed(word)),
    };
    let options = options.iter();
    options
        .map(|(key, given)| (Cow::Borrowed(key), value(given)))
        .collect()
}

/// What a program is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Description {
    /// Version of the protocol that it speaks.
    pub protocol: u32,
    /// The NAME of its file.
    pub id: String,
    /// What it writes, in one line.
    pub summary: String,
    /// What it can say.
    pub capabilities: Vec<Capability>,
    /// The options it takes.
    #[serde(default)]
    pub options: Vec<DescribedOption>,
    /// The machines it drives.
    pub machines: Vec<Driven>,
    /// The same in words, such as `robots with six axes`.
    pub drives: String,
    /// How it reads its programs back; without it, it does not.
    #[serde(default)]
    pub reads: Option<Reads>,
}

/// Machines that a dialect drives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Driven {
    /// Their kind.
    pub kind: MachineKind,
    /// The makers of their controllers; empty when it does not matter.
    #[serde(default)]
    pub makers: Vec<Maker>,
}

/// An option that a program takes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DescribedOption {
    /// Its key.
    pub key: String,
    /// One sentence for people.
    pub help: String,
    /// What values it takes.
    #[serde(flatten)]
    pub kind: DescribedKind,
}

/// What values an option takes, and its default.
pub type DescribedKind = OptionKind<Vec<String>>;

/// How a program reads what it wrote.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Reads {
    /// Extensions of its files, without the dot.
    pub extensions: Vec<String>,
    /// Who sets tool and base.
    pub frames: Frames,
    /// How finely it prints.
    #[serde(rename = "grain")]
    pub resolution: Resolution,
    /// A whole-number option that counts decimals: the resolution is divided by ten to its power.
    #[serde(default)]
    pub decimals: Option<String>,
}

/// A program that was written, or why not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Emitted {
    /// Version of the protocol.
    pub protocol: u32,
    /// The files.
    #[serde(default)]
    pub files: Vec<ProgramFile>,
    /// For every op of the program, once each, where it is said.
    #[serde(default)]
    pub said: Vec<Said>,
    /// What stands in the way. With any, files are of no account.
    #[serde(default)]
    pub problems: Vec<Problem>,
}

/// Where an op is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Said {
    /// The op: its place in the list of ops.
    pub op: OpId,
    /// Place of the file in the list of files, from 0.
    pub file: u32,
    /// The line, from 1.
    pub line: u32,
}

/// Why a program cannot be written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "problem", rename_all = "snake_case")]
pub enum Problem {
    /// The dialect does not drive such a machine.
    WrongMachine {
        /// What of it is not as it should be.
        mismatch: MachineMismatch,
    },
    /// The machine block lacks something.
    MissingMachineField {
        /// The field's name in the language.
        field: String,
        /// What it is for.
        why: String,
    },
    /// An option does not go with another or with the program.
    OptionConflict {
        /// Its key.
        key: String,
        /// Why not.
        why: String,
    },
    /// The profile asks for something that cannot be had.
    Profile {
        /// The key of the profile.
        key: String,
        /// Why not.
        why: String,
    },
    /// The dialect has no such op.
    Unsupported {
        /// Where.
        op: OpId,
        /// What is missing.
        what: String,
    },
    /// A number that the dialect does not take.
    OutOfRange {
        /// Where, if in the program's ops.
        #[serde(default)]
        op: Option<OpId>,
        /// What it is, such as `X`.
        what: String,
        /// Its value with unit.
        value: String,
        /// What is allowed.
        allowed: String,
        /// Both as numbers of one unit, where what is allowed is one range: then the compiler looks for values of the job that are.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        range: Option<Exceeded>,
    },
}

/// A program that was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ReadBack {
    /// Version of the protocol.
    pub protocol: u32,
    /// The statements in the order in which they are carried out. A configuration is `[shoulder, elbow, wrist, number]` as
    /// [`branch_as_configuration`] makes it.
    pub statements: Vec<Statement>,
}

/// Everything that is said, for the schema.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
#[allow(
    clippy::large_enum_variant,
    reason = "there is one at a time, and it is written or read at once"
)]
pub enum Message<'a> {
    /// To the program.
    Request(Request<'a>),
    /// From it: what it is.
    Description(Description),
    /// From it: what it read.
    ReadBack(ReadBack),
    /// From it: what it wrote.
    Emitted(Emitted),
}

/// A branch as the numbers of a [`Configuration`]: shoulder (0 front, 1 back), elbow (0 forward, 1 backward), wrist (0 positive,
/// 1 negative), and 0; of a machine whose branches are numbered, three zeros and the number.
///
/// The dialect of an outside program may say more or less than a branch; this is what its reader reports.
#[must_use]
pub const fn branch_as_configuration(branch: Branch) -> Configuration {
    match branch {
        Branch::Arm {
            shoulder,
            elbow,
            wrist,
        } => Configuration([
            match shoulder {
                Shoulder::Front => 0,
                Shoulder::Back => 1,
            },
            match elbow {
                Elbow::Forward => 0,
                Elbow::Backward => 1,
            },
            match wrist {
                Wrist::Positive => 0,
                Wrist::Negative => 1,
            },
            0,
        ]),
        Branch::Numbered(number) => Configuration([0, 0, 0, number as i32]),
    }
}
