//! What a block orders, in terms that all dialects share.
//!
//! An [`Order`] is the block alone: what it leaves to what was said before (the meaning of F, coordinates that stay) is filled
//! in by the model of the control.

use super::plane::{Plane, Sense};
use crate::axes::Word;
use core::mem::discriminant;
use vcutc_backend_api::ir::{MOST_AXES, Switch};
use vcutc_backend_api::readback::End;
use vcutc_backend_api::units::{Duration, Length};

/// What a block is read with.
#[derive(Clone, Copy)]
pub(crate) struct Scope<'a> {
    /// The machine's axes as words.
    pub(crate) words: &'a [Word],
    /// How far the job rounds corners.
    pub(crate) approximation: Option<Length>,
}

/// What the word F means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FeedMode {
    /// Speed of the tip, in mm/min.
    Tip,
    /// Inverse time: the block takes a minute divided by F.
    InverseTime,
    /// Rate of the rotary axes together, in deg/min.
    Rotary,
}

/// Why a block is not understood.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ReadError {
    /// A word, or a combination of words, that no program of this crate has.
    Unknown,
    Expected(String),
}

/// What became of a part of a block.
pub(crate) type Parsed<T> = Result<T, ReadError>;

/// That something else was expected.
pub(crate) fn expected<T>(what: impl Into<String>) -> Parsed<T> {
    Err(ReadError::Expected(what.into()))
}

/// A block.
#[derive(Clone, Debug, Default)]
pub(crate) struct Order<'t> {
    /// The kind of motion that it names.
    pub(crate) motion: Option<Motion>,
    pub(crate) coordinates: Coordinates,
    /// It ends at a standstill, whatever holds for others.
    pub(crate) exact_once: Once,
    /// Values of the axes' words in mm and degrees, at their places among the machine's axes.
    pub(crate) axes: [Option<f64>; MOST_AXES],
    /// The words I, J and K: where an arc has its centre, seen from its start.
    pub(crate) centre: [Option<f64>; 3],
    /// A point of an arc between its ends.
    pub(crate) via: [Option<f64>; 3],
    /// The word F.
    pub(crate) feed: Option<f64>,
    /// What holds from here on.
    pub(crate) modes: Vec<Mode>,
    /// What is done apart from motion.
    pub(crate) act: Option<Act>,
    /// It is done in time only after a stop of reading ahead.
    pub(crate) after_stop: Once,
    /// What is carried out next.
    pub(crate) flow: Option<Flow<'t>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Motion {
    /// As fast as may be.
    Rapid,
    /// At the speed of F, straight.
    AtFeed,
    /// At the speed of F, on an arc about a centre.
    Round(Sense),
    /// At the speed of F, on an arc through a point.
    Via,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Coordinates {
    /// Those of the tip, from the zero of the work.
    #[default]
    Work,
    /// Those of the machine's axes, in this block.
    Machine,
}

/// Whether something is said for one block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Once {
    #[default]
    No,
    Yes,
}

/// Something that holds from here on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mode {
    /// A convention that every program of this crate has.
    Convention(Convention),
    /// The opposite of it.
    Not(Convention),
    /// The meaning of F; none for one that no program of this crate has.
    Feed(Option<FeedMode>),
    /// How moves end; none for a way that is not that of the job.
    Stop(Option<End>),
    /// The plane of arcs.
    Plane(Plane),
    /// The centre of arcs, in X and Y.
    Pole([f64; 2]),
    /// Tool-centre-point control; none while it is being switched.
    Tcp(Option<Tcp>),
    /// The tool whose length counts, 0 for none; none when it has to be said again.
    Tool(Option<u32>),
    /// The work offset.
    Work(u32),
    /// A line of what takes several, but the last.
    Cycle(Cycle),
}

impl Mode {
    /// Whether two are about the same: a block says it once.
    fn is_like(self, other: Self) -> bool {
        match (self, other) {
            (Self::Convention(one) | Self::Not(one), Self::Convention(another) | Self::Not(another)) => {
                one == another
            }
            (_, _) => discriminant(&self) == discriminant(&other),
        }
    }
}

/// What has been said of something that takes several lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cycle {
    /// A wait.
    Dwell,
    /// A work offset is called up.
    WorkOffset,
    /// How far the tip may leave its way is set.
    Tolerance,
    /// The spindle's speed, in 1/min, at which the next line starts it.
    Speed(u32),
    /// A loop with this number begins, which waits for an input.
    Loop(u32),
    /// In the loop of this number this input has been waited for, though not without a limit.
    Waited(u32, u32),
}

/// Whether tool-centre-point control is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tcp {
    On,
    Off,
}

/// Conventions of the programs of this crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Convention {
    /// Coordinates are absolute.
    Absolute,
    /// Lengths are in mm.
    Millimetres,
    /// Rotary axes go straight to their values while the tip is controlled.
    ByAxes,
    /// Their values are those of the machine.
    MachineAngles,
    /// F is the speed of the tip alone.
    FeedOfTip,
    /// Rotary axes go the way that is written, not the shorter one.
    AsWritten,
    /// I, J and K are counted from the start of an arc.
    CentresFromStart,
}

/// How many conventions there are.
pub(crate) const CONVENTIONS: usize = 7;

/// What is done apart from motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Act {
    /// An output is switched.
    Switch(u32, Switch),
    /// The generator is switched, by blocks that the job gives.
    Generator(Switch),
    /// Waits for an input.
    Await(u32),
    /// Waits until the generator is ready, by blocks that the job gives.
    AwaitReady,
    Wait(Duration),
    /// A blade is put in: from this place of the changer, or by a person while the program stands.
    ChangeTool(Option<u32>),
    /// The tool of this number is put in, unless it is in the spindle.
    CallTool(u32),
    /// The spindle turns at this speed, in 1/min, or stops.
    Spin(Option<f64>),
    /// The spindle turns at the speed that the line before says.
    CycleSpin,
    /// The second of the two lines of a wait.
    CycleWait(Duration),
    /// The second line of a loop that waits for an input.
    LoopWait(u32),
    /// The last line of the loop of this number: it begins again if the wait has ended without the input.
    LoopEnds(u32),
    /// The second of the two lines of how far the tip may leave its way; none for as far as the machine does without it.
    CycleTolerance(Option<Length>),
    /// The second of the two lines that call up a work offset.
    CycleWork(u32),
    /// Reading ahead ends here.
    StopReading,
}

/// What is carried out next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow<'t> {
    /// The mark around a file on tape.
    Tape,
    /// A file begins, with its name.
    Head(Routine<'t>),
    /// The file of a part begins, with its name.
    PartHead(Routine<'t>),
    /// A part is carried out.
    Call(Routine<'t>),
    /// Back to the caller.
    Return,
    /// Back from the part of this name to the caller.
    ReturnFrom(Routine<'t>),
    /// Back to the caller, or the end of the program.
    Close(Routine<'t>),
    /// The program ends.
    End,
}

/// The name of a program or part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Routine<'t> {
    /// In letters, small and capital ones alike.
    Name(&'t str),
    Number(u32),
}

impl Routine<'_> {
    /// Whether two names are the same.
    pub(crate) fn is(self, other: Routine<'_>) -> bool {
        match (self, other) {
            (Self::Name(a), Routine::Name(b)) => a.eq_ignore_ascii_case(b),
            (Self::Number(a), Routine::Number(b)) => a == b,
            (Self::Name(_), Routine::Number(_)) | (Self::Number(_), Routine::Name(_)) => false,
        }
    }
}

impl<'t> Order<'t> {
    /// A block that only says where things go on.
    pub(crate) fn flow(flow: Flow<'t>) -> Self {
        Self {
            flow: Some(flow),
            ..Self::default()
        }
    }

    /// A block that does one thing apart from motion.
    pub(crate) fn act(act: Act) -> Self {
        Self {
            act: Some(act),
            ..Self::default()
        }
    }

    /// A block that sets these.
    pub(crate) fn modes(modes: Vec<Mode>) -> Self {
        Self {
            modes,
            ..Self::default()
        }
    }

    /// Adds what holds from here on.
    pub(crate) fn set(&mut self, mode: Mode) -> Parsed<()> {
        if self.modes.iter().any(|known| known.is_like(mode)) {
            return expected("one word of a group");
        }
        self.modes.push(mode);
        Ok(())
    }

    /// Names the kind of motion.
    pub(crate) fn moves(&mut self, motion: Motion) -> Parsed<()> {
        once(&mut self.motion, motion, "one word for the motion")
    }

    /// Adds what is done.
    pub(crate) fn does(&mut self, act: Act) -> Parsed<()> {
        once(&mut self.act, act, "one thing that is done in a block")
    }

    /// Adds where things go on.
    pub(crate) fn goes(&mut self, flow: Flow<'t>) -> Parsed<()> {
        once(&mut self.flow, flow, "one way to go on")
    }

    /// Whether it says where an arc lies.
    pub(crate) fn has_arc(&self) -> bool {
        self.centre.iter().chain(&self.via).any(Option::is_some)
    }

    /// Whether it has coordinates.
    pub(crate) fn has_axes(&self) -> bool {
        self.axes.iter().any(Option::is_some)
    }
}

/// Says something that a block says once.
fn once<T>(known: &mut Option<T>, said: T, what: &str) -> Parsed<()> {
    match known.replace(said) {
        Some(_) => expected(what),
        None => Ok(()),
    }
}
