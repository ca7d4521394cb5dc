//! Passes of a raster: stretches along y below the top of the blank, and all other motions beside them [Cui III.A].
//!
//! A motion is a piece of a pass where only y changes. Pieces that follow one another in one column at one height are one
//! pass, however many points the program divides it into and however often it goes to and fro. Everything else has to be
//! in the air or beside the blank: what cuts across, obliquely or along a slope is no pass, and is refused.

use super::axes::Axes;
use super::complaints;
use super::milling::{Milling, Move, Way, Written};
use super::place::Blank;
use crate::diag::Diagnostic;
use crate::plan::grid;
use crate::source::Span;

/// Coordinates this close, in mm, are the same: programs are printed with two or three decimals.
pub(super) const SAME: f64 = 0.01;

/// A pass of the milling tool, in the axes of the job, from the blank's corner, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// Where it runs across the blank; on a grid of a micrometre.
    pub x: f64,
    /// How high; on that grid.
    pub z: f64,
    /// From the least y to the greatest.
    pub y: [f64; 2],
    /// Where it is said: its first motion and its last.
    pub places: [Span; 2],
    /// The speed that holds for it.
    pub speed: Option<Written>,
    /// Whether a motion of all axes is taken for a part of it.
    pub way: Way,
}

/// What a milling program does to a blank.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Raster {
    /// The passes in the order of the program.
    pub passes: Vec<Pass>,
    /// Passes beside the blank, which cut nothing.
    pub beside: Vec<Pass>,
    /// How many passes follow another one in the same place.
    pub repeated: usize,
    /// How many motions are no passes.
    pub other_moves: usize,
    /// The highest place that the tool goes to.
    pub highest: Option<f64>,
    /// Speeds on straight lines that are no passes.
    pub travel: Vec<Written>,
    /// The path of the tool, broken where nobody knows where it is.
    pub path: Vec<Vec<[f64; 3]>>,
}

/// A motion between two known points, in the axes of the job.
#[derive(Clone, Copy)]
pub(super) struct Stretch<'m> {
    pub(super) said: &'m Move,
    pub(super) from: [f64; 3],
    pub(super) to: [f64; 3],
}

/// What a motion is, by what changes along it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Nothing.
    Still,
    /// Only y.
    Along,
    /// Only z.
    Upright,
    /// Only x, or x and z.
    Across,
    /// y with something else.
    Oblique,
}

impl Stretch<'_> {
    pub(super) fn kind(&self) -> Kind {
        let differs = |axis: usize| match (self.from.get(axis), self.to.get(axis)) {
            (Some(from), Some(to)) => (to - from).abs() > SAME,
            _ => false,
        };
        match (differs(0), differs(1), differs(2)) {
            (false, false, false) => Kind::Still,
            (false, true, false) => Kind::Along,
            (false, false, true) => Kind::Upright,
            (true, false, _) => Kind::Across,
            (_, true, _) => Kind::Oblique,
        }
    }

    /// The lower of its ends.
    pub(super) const fn lowest(&self) -> f64 {
        self.from[2].min(self.to[2])
    }
}

/// The motions between known points, in the axes of a job, from the program's origin.
pub(super) fn stretches(milling: &Milling, axes: Axes) -> impl Iterator<Item = Stretch<'_>> {
    milling.moves.windows(2).filter_map(move |pair| match pair {
        [before, said] => Some(Stretch {
            said,
            from: axes.point(before.to?),
            to: axes.point(said.to?),
        }),
        _ => None,
    })
}

/// The passes of a program over a blank whose place is known.
///
/// # Errors
/// Motions in the material that are no passes, told one by one.
pub(super) fn recognise(milling: &Milling, axes: Axes, blank: Blank) -> Result<Raster, Vec<Diagnostic>> {
    let mut builder = Builder {
        blank,
        raster: Raster::default(),
        open: None,
        complaints: Vec::new(),
    };
    builder.raster.path = path(milling, axes, blank);
    let all = builder.raster.path.iter().flatten();
    builder.raster.highest = all.map(|point| point[2]).reduce(f64::max);
    for stretch in stretches(milling, axes) {
        builder.take(Stretch {
            from: blank.seen_from_corner(stretch.from),
            to: blank.seen_from_corner(stretch.to),
            ..stretch
        });
    }
    builder.close();
    if builder.complaints.is_empty() {
        Ok(builder.raster)
    } else {
        Err(builder.complaints)
    }
}

fn path(milling: &Milling, axes: Axes, blank: Blank) -> Vec<Vec<[f64; 3]>> {
    milling
        .moves
        .split(|step| step.to.is_none())
        .map(|known| {
            let points = known.iter().filter_map(|step| step.to);
            points.map(|to| blank.seen_from_corner(axes.point(to))).collect()
        })
        .filter(|points: &Vec<_>| !points.is_empty())
        .collect()
}

/// Most motions that are told as no passes.
const MOST_COMPLAINTS: usize = 5;

struct Builder {
    blank: Blank,
    raster: Raster,
    open: Option<Pass>,
    complaints: Vec<Diagnostic>,
}

impl Builder {
    fn take(&mut self, stretch: Stretch<'_>) {
        let is_below = stretch.lowest() < self.blank.height - SAME;
        match stretch.kind() {
            Kind::Along if is_below => self.along(stretch),
            Kind::Still => {}
            Kind::Along | Kind::Upright => self.other(stretch),
            Kind::Across | Kind::Oblique => {
                if self.meets_the_blank(stretch) {
                    self.refuse(stretch);
                }
                self.other(stretch);
            }
        }
    }

    /// Whether a motion leads through the blank, its faces left out.
    fn meets_the_blank(&self, stretch: Stretch<'_>) -> bool {
        let sizes = [self.blank.width, self.blank.depth, self.blank.height];
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for ((from, to), size) in stretch.from.into_iter().zip(stretch.to).zip(sizes) {
            let (low, high) = (SAME, size - SAME);
            let run = to - from;
            if run.abs() < 1e-9 {
                if from <= low || from >= high {
                    return false;
                }
            } else {
                let (first, second) = ((low - from) / run, (high - from) / run);
                enters = enters.max(first.min(second));
                leaves = leaves.min(first.max(second));
            }
        }
        enters < leaves
    }

    fn refuse(&mut self, stretch: Stretch<'_>) {
        if self.complaints.len() < MOST_COMPLAINTS {
            self.complaints.push(complaints::no_pass(&stretch));
        }
    }

    fn other(&mut self, stretch: Stretch<'_>) {
        self.close();
        self.raster.other_moves += 1;
        if let (Way::Straight, Some(speed)) = (stretch.said.way, stretch.said.speed) {
            let is_new = self.raster.travel.iter().all(|known| known.value != speed.value);
            if is_new && self.raster.travel.len() < MOST_SPEEDS {
                self.raster.travel.push(speed);
            }
        }
    }

    fn along(&mut self, stretch: Stretch<'_>) {
        let said = stretch.said;
        let piece = Pass {
            x: grid::nearest(stretch.to[0]),
            z: grid::nearest(stretch.to[2]),
            y: [
                stretch.from[1].min(stretch.to[1]),
                stretch.from[1].max(stretch.to[1]),
            ],
            places: [said.place; 2],
            speed: said.speed,
            way: said.way,
        };
        match &mut self.open {
            Some(open) if is_same_column(open, &piece) => {
                open.y = [open.y[0].min(piece.y[0]), open.y[1].max(piece.y[1])];
                open.places[1] = said.place;
                if piece.way == Way::Joint {
                    open.way = Way::Joint;
                }
            }
            Some(_) | None => {
                self.close();
                self.open = Some(piece);
            }
        }
    }

    /// Ends the pass at hand.
    fn close(&mut self) {
        let Some(pass) = self.open.take() else { return };
        if pass.x < 0.0 || pass.x > self.blank.width {
            self.raster.beside.push(pass);
        } else if self
            .raster
            .passes
            .last()
            .is_some_and(|last| is_same_column(last, &pass))
        {
            self.raster.repeated += 1;
        } else {
            self.raster.passes.push(pass);
        }
    }
}

/// Most different speeds between passes that are remembered.
const MOST_SPEEDS: usize = 64;

fn is_same_column(one: &Pass, other: &Pass) -> bool {
    (one.x - other.x).abs() <= SAME && (one.z - other.z).abs() <= SAME
}
