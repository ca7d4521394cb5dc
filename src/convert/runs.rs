//! Runs: what a program moves along one axis, at one height, in one go.
//!
//! Posts divide a straight pass into many points, and round each of them by itself. So motions whose points lie within a
//! tolerance of one another, across and in height, are one run, and its line is the middle of them.

use super::axes::Axes;
use super::milling::{Milling, Move, Way, Written};
use super::types::Blank;
use vcutc_backend_api::arc::CircularArc;
use vcutc_diagnostics::source::Span;

/// A motion to a known point, in the axes of the job.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<'m> {
    pub(super) said: &'m Move,
    /// Where it begins; where it ends, if that is not known.
    pub(super) from: [f64; 3],
    /// The way of an arc, where it is known.
    pub(super) course: Option<CircularArc>,
    pub(super) to: [f64; 3],
    pub(super) kind: Kind,
}

/// What a motion is, by what changes along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Still,
    /// Only y.
    Along,
    /// Only z.
    Upright,
    /// Only x, or x and z.
    Across,
    /// y with something else.
    Oblique,
    /// An arc.
    Curve,
    /// From a place that is not known, as after motions of all axes.
    Landing,
}

impl Kind {
    fn of(way: Way, from: [f64; 3], to: [f64; 3], tolerance: f64) -> Self {
        match way {
            Way::Arc { .. } => return Self::Curve,
            Way::Straight | Way::Joint => {}
        }
        let [x, y, z] = [0, 1, 2].map(|axis| match (from.get(axis), to.get(axis)) {
            (Some(from), Some(to)) => (to - from).abs() > tolerance,
            (None, _) | (_, None) => false,
        });
        match (x, y, z) {
            (false, false, false) => Self::Still,
            (false, true, false) => Self::Along,
            (false, false, true) => Self::Upright,
            (true, false, _) => Self::Across,
            (_, true, _) => Self::Oblique,
        }
    }
}

impl Stretch<'_> {
    /// As seen from the blank's corner.
    pub(super) fn seen_from(self, blank: &Blank) -> Self {
        Self {
            from: blank.seen_from_corner(self.from),
            course: self
                .course
                .map(|arc| arc.seen(|direction| direction, |point| blank.seen_from_corner(point))),
            to: blank.seen_from_corner(self.to),
            ..self
        }
    }

    /// The lower of its ends.
    pub(super) const fn lowest(&self) -> f64 {
        self.from[2].min(self.to[2])
    }
}

/// The motions to known points, in the axes of a job, from the program's origin.
pub(super) fn stretches(milling: &Milling, axes: Axes, tolerance: f64) -> impl Iterator<Item = Stretch<'_>> {
    let befores = core::iter::once(None).chain(milling.moves.iter().map(|step| step.to));
    let pairs = befores.zip(&milling.moves);
    pairs.filter_map(move |(before, said)| {
        let to = axes.point(said.to?);
        let from = before.map(|from| axes.point(from));
        let course = match said.way {
            Way::Arc { course } => course.map(|arc| {
                let seen = |place| axes.point(place);
                arc.seen(seen, seen)
            }),
            Way::Straight | Way::Joint => None,
        };
        Some(Stretch {
            said,
            from: from.unwrap_or(to),
            course,
            to,
            kind: from.map_or(Kind::Landing, |from| Kind::of(said.way, from, to, tolerance)),
        })
    })
}

/// Motions along y that follow one another in one place, in the axes of a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Run {
    /// Least and greatest x of its points.
    x: [f64; 2],
    /// Least and greatest y.
    pub(super) y: [f64; 2],
    /// Least and greatest z.
    z: [f64; 2],
    /// Its first motion and its last.
    pub(super) places: [Span; 2],
    /// The speed of the first.
    pub(super) speed: Option<Written>,
    /// Another one, of a motion that leads farther.
    pub(super) second_speed: Option<Written>,
    /// Whether a motion of all axes is among them.
    pub(super) way: Way,
    pub(super) pieces: usize,
    /// How far they lead one by one, to and fro added up.
    pub(super) travelled: f64,
}

impl Run {
    fn of(stretch: &Stretch<'_>) -> Self {
        let range = |axis: fn([f64; 3]) -> f64| {
            let (from, to) = (axis(stretch.from), axis(stretch.to));
            [from.min(to), from.max(to)]
        };
        Self {
            x: range(|[x, _, _]| x),
            y: range(|[_, y, _]| y),
            z: range(|[_, _, z]| z),
            places: [stretch.said.place; 2],
            speed: stretch.said.speed,
            second_speed: None,
            way: stretch.said.way,
            pieces: 1,
            travelled: (stretch.to[1] - stretch.from[1]).abs(),
        }
    }

    /// With a piece that follows; none where that lies elsewhere.
    fn with(&self, piece: &Self, tolerance: f64) -> Option<Self> {
        let [x, y, z] = [(self.x, piece.x), (self.y, piece.y), (self.z, piece.z)]
            .map(|([low, high], [other_low, other_high])| [low.min(other_low), high.max(other_high)]);
        if x[1] - x[0] > tolerance || z[1] - z[0] > tolerance {
            return None;
        }
        let leads_farther = y[0] < self.y[0] - tolerance || y[1] > self.y[1] + tolerance;
        let value = |speed: Option<Written>| speed.map(|speed| speed.value);
        let changed = leads_farther && value(piece.speed) != value(self.speed);
        Some(Self {
            x,
            y,
            z,
            places: [self.places[0], piece.places[1]],
            second_speed: self.second_speed.or(piece.speed.filter(|_| changed)),
            way: match (self.way, piece.way) {
                (Way::Straight, way) => way,
                (way @ (Way::Joint | Way::Arc { .. }), _) => way,
            },
            pieces: self.pieces + piece.pieces,
            travelled: self.travelled + piece.travelled,
            ..*self
        })
    }

    /// Where its line lies: x, and y from end to end, and z.
    pub(super) fn line(&self) -> (f64, [f64; 2], f64) {
        (self.across(), self.y, self.height())
    }

    /// z of its line.
    pub(super) const fn height(&self) -> f64 {
        f64::midpoint(self.z[0], self.z[1])
    }

    /// How far points of it lie from its line, in x or in z.
    pub(super) const fn stray(&self) -> f64 {
        (self.x[1] - self.x[0]).max(self.z[1] - self.z[0]) / 2.0
    }

    /// x of its line.
    pub(super) const fn across(&self) -> f64 {
        f64::midpoint(self.x[0], self.x[1])
    }

    /// How far it leads.
    pub(super) const fn length(&self) -> f64 {
        self.y[1] - self.y[0]
    }
}

/// Some of a program's motions.
pub(super) enum Course<'m> {
    /// Along y.
    Run(Run),
    /// One that does not run along y, and leads somewhere.
    Other(Stretch<'m>),
}

/// Hands over the motions of a program in their order, with those along y put together.
pub(super) fn courses<'m>(
    milling: &'m Milling,
    axes: Axes,
    tolerance: f64,
    take: &mut dyn FnMut(Course<'m>),
) {
    let mut open: Option<Run> = None;
    for stretch in stretches(milling, axes, tolerance) {
        match stretch.kind {
            Kind::Still => {}
            Kind::Along => {
                let piece = Run::of(&stretch);
                open = match open.and_then(|run| run.with(&piece, tolerance)) {
                    Some(longer) => Some(longer),
                    None => {
                        if let Some(run) = open.take() {
                            take(Course::Run(run));
                        }
                        Some(piece)
                    }
                };
            }
            Kind::Upright | Kind::Across | Kind::Oblique | Kind::Curve | Kind::Landing => {
                if let Some(run) = open.take() {
                    take(Course::Run(run));
                }
                take(Course::Other(stretch));
            }
        }
    }
    if let Some(run) = open {
        take(Course::Run(run));
    }
}

/// All runs of a program.
pub(super) fn runs(milling: &Milling, axes: Axes, tolerance: f64) -> Vec<Run> {
    let mut found = Vec::new();
    courses(milling, axes, tolerance, &mut |course| match course {
        Course::Run(run) => found.push(run),
        Course::Other(_) => {}
    });
    found
}
