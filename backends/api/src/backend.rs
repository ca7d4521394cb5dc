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
pub use crate::options::{OptionKind, OptionSpec, OptionValue, Options};
use crate::readback::Reader;
use crate::verify::Capabilities;
use serde::{Deserialize, Serialize};

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

    /// What reads its programs back. If there is no reader, nothing checks what was written.
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
    /// The outside program of the dialect failed. A dialect of the compiler never fails like this
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
