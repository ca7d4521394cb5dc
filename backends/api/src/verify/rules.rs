//! The rules of a program, and what a broken one is called.

use core::fmt;

/// The rules of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The program states the version that this crate knows.
    Version,
    /// Every id refers to an entry of its table.
    TableReference,
    /// Every number is finite, every length, speed and time that must be positive is.
    Number,
    /// The machine has at least one axis and at most [`MOST_AXES`](crate::ir::MOST_AXES), each with a range, and rates that are positive.
    Axes,
    /// The first motion is `Home` where there is a cell with a home, and the first to a pose is an `AxisTravel`: the way of
    /// a straight move from axis values would depend on the arm.
    KnownStart,
    /// `Home` needs a cell with home angles.
    HomeAngles,
    /// Rotations between consecutive poses are below [`LARGEST_TURN`](super::LARGEST_TURN).
    AmbiguousTurn,
    /// Moves through the air keep the tip out of the stock.
    AirMoveThroughStock,
    /// Turns happen with the blade clear of the stock.
    TurnInStock,
    /// A cut runs along y through the whole depth of the stock.
    CutAcrossStock,
    /// In a cut a straight blade's shank leans along the feed, and to the side of its flank or to none, and a cutting edge leads.
    CutPosture,
    /// The blade vibrates while it cuts.
    SilentCut,
    /// A blade that spins does so while it cuts.
    StillCut,
    /// Where generator or spindle are switched on, their readiness is awaited before the cut.
    ReadyNotAwaited,
    /// A machine has a spindle where a blade of the program spins.
    NoSpindle,
    /// The spindle runs with a blade only that spins.
    IdleSpindle,
    /// Generator and spindle are off at the end, and the machine at home where there is one.
    Ending,
    /// A cut is a cut of an operation, a chain too, and has no flank twice: one left and one right flank, or one of them.
    CutFlanks,
    /// In an air cut the blade stays above the stock, all along and by half its thickness at least, and generator and spindle off.
    AirCut,
    /// The machine has a tool for every blade, and a changer that goes by places has one of its own for each.
    Tools,
    /// Blades are changed at the change place, with generator and spindle off.
    ChangeAway,
    /// A motion of the blade serves an operation that cuts with the blade at hand.
    OtherBlade,
    /// Three points make the arc of a piece of a chain, which goes round by less than [`LARGEST_SWEEP`](super::LARGEST_SWEEP).
    Arc,
    /// Where a piece of a chain is not to end in a stop the next one of the same cut follows at once, in the same direction but for
    /// [`LARGEST_KINK`](super::LARGEST_KINK).
    ChainJoint,
    /// All along a piece of a chain a straight blade stands in the plane of its way but for
    /// [`LARGEST_SLIP`](super::LARGEST_SLIP), and a cutting edge leads. The shank of any blade leans along the way or square to it; a crusher may go down as steeply as its
    /// ramp, and straight to where it has been.
    ChainPosture,
    /// Operations come in order, and the cuts of each layer are numbered from 1 without gaps. In which order an operation
    /// visits them is for the proof to judge.
    Order,
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Version => "the program is of another version",
            Self::TableReference => "an id refers to nothing",
            Self::Number => "a number is not finite or not positive",
            Self::Axes => "the machine has no axes, too many, or one without a range",
            Self::KnownStart => "a motion starts from an unknown pose",
            Self::HomeAngles => "the machine has no home angles",
            Self::AmbiguousTurn => "a rotation of nearly half a turn has two ways round",
            Self::AirMoveThroughStock => "a move through the air leads through the stock",
            Self::TurnInStock => "the blade turns within the stock",
            Self::CutAcrossStock => "a cut does not run along y through the whole stock",
            Self::CutPosture => "a cut holds the blade wrongly",
            Self::SilentCut => "a cut without vibration",
            Self::StillCut => "a cut with a spindle that stands still",
            Self::ReadyNotAwaited => "generator or spindle are not awaited before a cut",
            Self::NoSpindle => "the machine has no spindle for a blade that spins",
            Self::IdleSpindle => "the spindle is switched on with a blade that does not spin",
            Self::Ending => "the program does not end at home with generator and spindle off",
            Self::CutFlanks => "a cut that is of no operation, or has a flank twice",
            Self::AirCut => "an air cut lets the blade down to the stock, or starts a drive",
            Self::Tools => "the machine has not one tool and one place for each blade",
            Self::ChangeAway => "the blade is changed away from the change place, or with a drive on",
            Self::OtherBlade => "an operation has another blade at hand than its own",
            Self::Arc => "three points do not make the arc of a piece of a chain",
            Self::ChainJoint => "a chain does not go on in the same direction, or does not end",
            Self::ChainPosture => "a chain holds the blade wrongly",
            Self::Order => "operations are out of order, or a layer's cuts are not all there",
        })
    }
}
