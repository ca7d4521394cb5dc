//! One lattice's problem in two coordinates: what a shape comes to, and the functions that this is made of.
//!
//! What is made least is the greatest of a few smooth functions, one for each bound that the layer may be as thick as:
//! the time falls with the layer, so the thinnest of these layers takes the longest. So is the share by which a bound is
//! broken.

use super::chart::Chart;
use super::formulas::{Asked, Keeping, Model, Outcome, Shape, Tooth};
use vcutc_geometry::number::{Interval, OnPlane, Scalar, Slopes};

/// Bounds are kept to this share of them: what rounding may take.
pub(super) const KEPT: f64 = 1e-11;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    Time,
    Cuts,
    /// The greatest share by which a bound is broken.
    Breach,
}

/// A function of the shape: a part of what is made least, or a bound, which is kept where it is not positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Term {
    Time(Keeping),
    Cuts(Keeping),
    /// Reach does not allow the least layer, or that of the least step.
    Reach(Asked),
    Scallop(Asked),
    Late(Keeping),
    Many(Keeping),
    /// The coordinate that the other two decide is below its range.
    Below,
    /// It is above its range.
    Above,
}

/// The functions whose greatest is what is made least or broken, as far as they apply.
const TIMES: [Term; 4] = [
    Term::Time(Keeping::Both),
    Term::Time(Keeping::Reach),
    Term::Time(Keeping::Scallop),
    Term::Time(Keeping::Neither),
];
const CUTS: [Term; 4] = [
    Term::Cuts(Keeping::Both),
    Term::Cuts(Keeping::Reach),
    Term::Cuts(Keeping::Scallop),
    Term::Cuts(Keeping::Neither),
];
const BREACHES: [Term; 14] = [
    Term::Reach(Asked::Layer),
    Term::Reach(Asked::Step),
    Term::Scallop(Asked::Layer),
    Term::Scallop(Asked::Step),
    Term::Late(Keeping::Both),
    Term::Late(Keeping::Reach),
    Term::Late(Keeping::Scallop),
    Term::Late(Keeping::Neither),
    Term::Many(Keeping::Both),
    Term::Many(Keeping::Reach),
    Term::Many(Keeping::Scallop),
    Term::Many(Keeping::Neither),
    Term::Below,
    Term::Above,
];

/// A shape that keeps the bounds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    /// Where in the coordinates of its ground.
    pub(super) place: [f64; 2],
    pub(super) shape: Shape<f64>,
    pub(super) outcome: Outcome<f64>,
    /// What it comes to in the measure.
    pub(super) value: f64,
    /// No shape comes to less than this share below it.
    pub(super) gap: f64,
}

/// How a shape compares: by what it comes to if it keeps the bounds, else by how much it breaks them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Merit {
    Keeps(f64),
    Breaks(f64),
}

impl Merit {
    pub(super) fn beats(self, other: Self) -> bool {
        match (self, other) {
            (Self::Keeps(one), Self::Keeps(two)) | (Self::Breaks(one), Self::Breaks(two)) => one < two,
            (Self::Keeps(_), Self::Breaks(_)) => true,
            (Self::Breaks(_), Self::Keeps(_)) => false,
        }
    }
}

/// What a place comes to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tried {
    pub(super) shape: Shape<f64>,
    pub(super) outcome: Outcome<f64>,
    pub(super) merit: Merit,
}

/// One lattice's problem in the coordinates of one stretch.
#[derive(Clone, Copy)]
pub(super) struct Ground<'m> {
    pub(super) model: &'m Model,
    pub(super) chart: Chart,
    pub(super) tooth: Tooth,
    pub(super) measure: Measure,
}

impl Ground<'_> {
    /// What a shape comes to.
    pub(super) fn at(&self, [first, second]: [f64; 2]) -> Tried {
        let shape = self.chart.shape(first, second);
        let tooth = Tooth::Beyond(self.model.beyond(shape.share));
        let outcome = self.model.outcome(shape, tooth, Keeping::Both);
        let breach = outcome
            .slack
            .into_iter()
            .chain(self.chart.slack(shape))
            .fold(f64::INFINITY, f64::min);
        let merit = if breach >= -KEPT {
            Merit::Keeps(match self.measure {
                Measure::Time => outcome.time,
                Measure::Cuts => outcome.cuts,
                Measure::Breach => 0.0,
            })
        } else {
            Merit::Breaks(-breach)
        };
        Tried {
            shape,
            outcome,
            merit,
        }
    }

    /// The measure over a box of shapes, and all slacks.
    pub(super) fn enclosed(&self, sides: [Interval; 2]) -> (Slopes, [Slopes; 6]) {
        let shape = self
            .chart
            .shape(Slopes::coordinate(0, sides[0]), Slopes::coordinate(1, sides[1]));
        let outcome = self.model.outcome(shape, self.tooth, Keeping::Both);
        let ([a, b, c, d], [e, f]) = (outcome.slack, self.chart.slack(shape));
        let measured = match self.measure {
            Measure::Time => outcome.time,
            Measure::Cuts => outcome.cuts,
            Measure::Breach => Slopes::constant(0.0),
        };
        (measured, [a, b, c, d, e, f])
    }

    /// A term at a place, or over a box.
    pub(super) fn term<N: Scalar>(&self, term: Term, [first, second]: [N; 2]) -> N {
        let shape = self.chart.shape(first, second);
        let bounds = || self.model.bounds(shape, self.tooth);
        let cost = |keeping: Keeping| self.model.cost(shape, &bounds(), keeping);
        let one = N::constant(1.0);
        let beyond = |limit: Option<f64>, value: N| {
            limit.map_or(N::constant(-1.0), |limit| value.times(1.0 / limit).plus(-1.0))
        };
        match term {
            Term::Time(keeping) => cost(keeping).time,
            Term::Cuts(keeping) => cost(keeping).cuts,
            Term::Reach(asked) => one - bounds().by_reach / self.model.asked(shape, asked),
            Term::Scallop(asked) => {
                let kept = |by_scallop: N| one - by_scallop / self.model.asked(shape, asked);
                bounds().by_scallop.map_or(N::constant(-1.0), kept)
            }
            Term::Late(keeping) => beyond(self.model.time, cost(keeping).time),
            Term::Many(keeping) => beyond(self.model.cuts, cost(keeping).cuts),
            Term::Below => self.chart.slack(shape)[0].times(-1.0),
            Term::Above => self.chart.slack(shape)[1].times(-1.0),
        }
    }

    pub(super) fn value(&self, term: Term, place: [f64; 2]) -> f64 {
        self.term(term, place)
    }

    pub(super) fn jet(&self, term: Term, [first, second]: [f64; 2]) -> OnPlane<f64> {
        self.term(
            term,
            [OnPlane::coordinate(0, first), OnPlane::coordinate(1, second)],
        )
    }

    fn applies(&self, term: Term) -> bool {
        let layer = |keeping: Keeping| match keeping {
            Keeping::Both => self.model.given(),
            Keeping::Reach | Keeping::Neither => !self.model.given(),
            Keeping::Scallop => !self.model.given() && self.model.scallop.is_some(),
        };
        match term {
            Term::Time(keeping) | Term::Cuts(keeping) => layer(keeping),
            Term::Late(keeping) => self.model.time.is_some() && layer(keeping),
            Term::Many(keeping) => self.model.cuts.is_some() && layer(keeping),
            Term::Reach(_) | Term::Below | Term::Above => true,
            Term::Scallop(_) => self.model.scallop.is_some(),
        }
    }

    fn greatest(&self, terms: &[Term], place: [f64; 2]) -> Option<(Term, f64)> {
        let applying = terms.iter().filter(|term| self.applies(**term));
        let values = applying.map(|&term| (term, self.value(term, place)));
        values.reduce(|best, other| if other.1 > best.1 { other } else { best })
    }

    /// The greatest of the terms that what is made least consists of.
    pub(super) fn top(&self, place: [f64; 2]) -> Term {
        let (terms, first) = match self.measure {
            Measure::Time => (TIMES.as_slice(), TIMES[0]),
            Measure::Cuts => (CUTS.as_slice(), CUTS[0]),
            Measure::Breach => (BREACHES.as_slice(), BREACHES[0]),
        };
        self.greatest(terms, place).map_or(first, |(term, _)| term)
    }

    /// The bound that is broken most, and by how much.
    pub(super) fn most_broken(&self, place: [f64; 2]) -> Option<(Term, f64)> {
        match self.measure {
            Measure::Time | Measure::Cuts => self.greatest(&BREACHES, place),
            Measure::Breach => None,
        }
    }

    /// The best of two shapes.
    pub(super) fn better(&self, found: Option<Found>, place: [f64; 2]) -> Option<Found> {
        let tried = self.at(place);
        match tried.merit {
            Merit::Keeps(value) if found.is_none_or(|found| value < found.value) => Some(Found {
                place,
                shape: tried.shape,
                outcome: tried.outcome,
                value,
                gap: 0.0,
            }),
            Merit::Keeps(_) | Merit::Breaks(_) => found,
        }
    }
}

/// How far a value strays from that in the middle of a box at most.
pub(super) fn swing(function: &Slopes, sides: [Interval; 2]) -> f64 {
    let along = |i: usize| {
        let half = 0.5 * sides[i].width();
        if half > 0.0 {
            function.by[i].magnitude() * half
        } else {
            0.0
        }
    };
    (along(0) + along(1)) * (1.0 + 1e-12)
}
