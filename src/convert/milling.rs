//! What a milling program says, as far as a conversion needs it: motions with places, speeds and attitudes, and the
//! statements that are not motions.

use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::geometry::Orientation;
use vcutc_diagnostics::source::Span;

/// A milling program as its motions.
#[derive(Clone, Debug, PartialEq)]
pub struct Milling {
    pub start: Span,
    /// The motions in the order in which they are made.
    pub moves: Vec<Move>,
    /// Positions of all axes that it goes to, such as home.
    pub axis_moves: usize,
    /// The rate of turning that it sets, in deg/s, as `$VEL.ORI1`; the last one.
    pub turning: Option<f64>,
    /// Statements that set up motions in general: a converted program has its own.
    pub settings: Vec<Span>,
    /// Statements with an effect that a conversion does not carry over.
    pub left_out: Vec<Span>,
    /// What axes outside of the arm are stated to be all along: their names and values, in mm or degrees.
    pub external: Vec<(&'static str, f64)>,
    /// Where routines that are carried out break off without `END`.
    pub ends_early: Vec<Span>,
    /// Routines with motions that are never called.
    pub uncalled: Vec<Span>,
}

impl Milling {
    /// A program without statements.
    #[must_use]
    pub const fn empty(start: Span) -> Self {
        Self {
            start,
            moves: Vec::new(),
            axis_moves: 0,
            turning: None,
            settings: Vec::new(),
            left_out: Vec::new(),
            external: Vec::new(),
            ends_early: Vec::new(),
            uncalled: Vec::new(),
        }
    }
}

/// A motion to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    pub place: Span,
    pub way: Way,
    /// Where it ends: x, y, z in the program's base, in mm. None where it is not known, as after axis moves.
    pub to: Option<[f64; 3]>,
    /// How the tool is held at its end, if the program says so.
    pub attitude: Option<Orientation>,
    /// The speed that holds for it, as the program writes it.
    pub speed: Option<Written>,
}

/// The way of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// On a straight line: `LIN`, `SLIN`.
    Straight,
    /// On a circular arc: `CIRC`, `SCIRC`.
    Arc {
        /// The arc, stated as the motion's end is; none where it is not known.
        course: Option<CircularArc>,
    },
    /// As all axes like it: `PTP`, `SPTP`.
    Joint,
}

/// A number of the program with its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Written {
    pub value: f64,
    /// Where it is set.
    pub place: Span,
}
