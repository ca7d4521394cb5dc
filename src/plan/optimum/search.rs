//! The least time or number of cuts over all shapes, by branch and bound.
//!
//! A box of shapes is thrown away when a bound is broken all over it, or when nothing in it can beat the best shape known:
//! what it can come to is enclosed by intervals, and more tightly by its value in the middle and its slopes (the mean-value
//! form of interval analysis). Where the objective falls along a coordinate all over a box, only the box's far face
//! remains. Of the rest the most promising box is halved, until nothing remains or the budget is spent; the
//! difference between the best shape and the most promising box left is then the proven gap.

use super::blend::Blend;
use super::chart::Chart;
use super::formulas::{Keeping, Model, Outcome, Shape, Tooth};
use super::number::{Interval, Slopes};
use super::polish;
use core::cmp::Ordering;
use std::collections::BinaryHeap;

/// Bounds are kept to this share of them: what rounding may take.
pub(super) const KEPT: f64 = 1e-11;

/// A box that promises less than this share of improvement is not looked into.
const GAP: f64 = 1e-7;

/// Most boxes that a search for the best shape looks into.
const MOST_BOXES: u32 = 6000;

/// Most boxes that a search for any shape looks into: without one so far there is none but for a hair.
const MOST_FOR_ANY: u32 = 1000;

/// After so many boxes the best shape is improved where it is, so that it throws away more boxes.
const FIRST_LOOK: u32 = 12;

/// What is made least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    Time,
    Cuts,
}

impl Measure {
    pub(super) const fn of<N: Copy>(self, outcome: &Outcome<N>) -> N {
        match self {
            Self::Time => outcome.time,
            Self::Cuts => outcome.cuts,
        }
    }
}

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// The best shape.
    Best,
    /// Any shape that keeps the bounds.
    Any,
}

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
    pub(super) measure: Measure,
}

impl Ground<'_> {
    /// What a shape comes to.
    pub(super) fn at(&self, [first, second]: [f64; 2]) -> Tried {
        let shape = self.chart.shape(first, second);
        let tooth = Tooth::Behind(self.model.behind(shape.share));
        let outcome = self.model.outcome(shape, tooth, Keeping::Both);
        let breach = outcome
            .slack
            .into_iter()
            .chain(self.chart.slack(shape))
            .fold(f64::INFINITY, f64::min);
        let merit = if breach >= -KEPT {
            Merit::Keeps(self.measure.of(&outcome))
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
    pub(super) fn enclosed(
        &self,
        sides: [Interval; 2],
        tooth: Tooth,
        keeping: Keeping,
    ) -> (Slopes, [Slopes; 6]) {
        let shape = self
            .chart
            .shape(Slopes::first(sides[0]), Slopes::second(sides[1]));
        let outcome = self.model.outcome(shape, tooth, keeping);
        let ([a, b, c, d], [e, f]) = (outcome.slack, self.chart.slack(shape));
        (self.measure.of(&outcome), [a, b, c, d, e, f])
    }

    /// The slopes of the measure at a place.
    pub(super) fn slopes(&self, place: [f64; 2]) -> [f64; 2] {
        let share = self.chart.shape(place[0], place[1]).share;
        let tooth = Tooth::Behind(self.model.behind(share));
        let (measured, _) = self.enclosed(place.map(Interval::exactly), tooth, Keeping::Both);
        measured.by.map(Interval::middle)
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

/// A box and the least that its shapes can come to.
struct Candidate {
    chart: Chart,
    tooth: Tooth,
    sides: [Interval; 2],
    least: f64,
    /// Along which coordinate it is halved.
    along: usize,
    /// The order in which boxes were made decides between equals.
    number: u32,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Candidate {}
impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Candidate {
    /// The greatest is the most promising.
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .least
            .total_cmp(&self.least)
            .then(other.number.cmp(&self.number))
    }
}

/// What is known of a box.
enum Fate {
    /// Nothing in it is better than what is known.
    Out,
    /// Only this part of it can be.
    Face([Interval; 2]),
    /// It can be, at most by so much, and is best halved along a coordinate.
    Open(f64, usize),
}

struct Search<'m> {
    model: &'m Model,
    measure: Measure,
    goal: Goal,
    found: Option<Found>,
    /// Where the best shape is, to be improved there.
    home: Option<(Chart, [Interval; 2])>,
    improved: bool,
    /// What bounds it together.
    blend: Option<Blend>,
    open: BinaryHeap<Candidate>,
    boxes: u32,
    /// The least that boxes too small to halve can come to.
    remaining: f64,
}

/// The best shape of a lattice; none if none keeps the bounds.
pub(super) fn best(model: &Model, measure: Measure, goal: Goal) -> Option<Found> {
    let mut search = Search {
        model,
        measure,
        goal,
        found: None,
        home: None,
        improved: false,
        blend: None,
        open: BinaryHeap::new(),
        boxes: 0,
        remaining: f64::INFINITY,
    };
    for tooth in model.teeth() {
        search.enter(tooth);
    }
    search.run();
    search.found
}

impl Search<'_> {
    fn enter(&mut self, tooth: Tooth) {
        if let Some(chart) = Chart::new(self.model, tooth) {
            self.look(chart, tooth, chart.sides);
        }
    }

    fn run(&mut self) {
        let mut improved_at = 0;
        while let Some(candidate) = self.open.pop() {
            if self.goal == Goal::Any && self.found.is_some() {
                return;
            }
            if self.hopeless(candidate.least) {
                break;
            }
            let most = match self.goal {
                Goal::Best => MOST_BOXES,
                Goal::Any => MOST_FOR_ANY,
            };
            if self.boxes >= most {
                self.remaining = self.remaining.min(candidate.least);
                break;
            }
            if self.boxes >= improved_at + FIRST_LOOK && self.improved {
                self.improve();
                improved_at = self.boxes;
            }
            self.divide(&candidate);
        }
        if self.improved {
            self.improve();
        }
        let remaining = self.remaining;
        if let Some(found) = &mut self.found {
            found.gap = ((found.value - remaining) / found.value).max(GAP);
        }
    }

    /// Whether what comes to no less than this is not worth looking into.
    fn hopeless(&self, least: f64) -> bool {
        self.found.is_some_and(|found| least > found.value * (1.0 - GAP))
    }

    fn divide(&mut self, candidate: &Candidate) {
        if let Some(teeth) = self.model.divided(candidate.tooth) {
            for tooth in teeth {
                self.enter(tooth);
            }
            return;
        }
        let side = candidate.sides[candidate.along];
        let middle = side.between();
        if side.width() <= 1e-13 * side.magnitude() {
            self.remaining = self.remaining.min(candidate.least);
            return;
        }
        for half in [
            Interval { high: middle, ..side },
            Interval { low: middle, ..side },
        ] {
            let mut sides = candidate.sides;
            sides[candidate.along] = half;
            self.look(candidate.chart, candidate.tooth, sides);
        }
    }

    /// Judges a box and keeps it if there is hope.
    fn look(&mut self, chart: Chart, tooth: Tooth, mut sides: [Interval; 2]) {
        loop {
            self.boxes += 1;
            let ground = Ground {
                model: self.model,
                chart,
                measure: self.measure,
            };
            let middle = sides.map(Interval::middle);
            let before = self.found.map(|found| found.value);
            self.found = ground.better(self.found, middle);
            if self.found.map(|found| found.value) != before {
                self.home = Some((chart, sides));
                self.improved = true;
            }
            match self.judge(&ground, tooth, sides) {
                Fate::Out => return,
                Fate::Face(face) => sides = face,
                Fate::Open(least, along) => {
                    self.open.push(Candidate {
                        chart,
                        tooth,
                        sides,
                        least,
                        along,
                        number: self.boxes,
                    });
                    return;
                }
            }
        }
    }

    fn judge(&self, ground: &Ground<'_>, tooth: Tooth, sides: [Interval; 2]) -> Fate {
        let chart = &ground.chart;
        let (measured, slacks) = ground.enclosed(sides, tooth, Keeping::Both);
        let centre = chart.shape(sides[0].middle(), sides[1].middle());
        let at_centre = self.model.outcome(centre, tooth, Keeping::Both);
        let at_centres = at_centre.slack.into_iter().chain(chart.slack(centre));
        let mut unsure = [Interval::exactly(0.0); 2];
        for (slack, centre) in slacks.into_iter().zip(at_centres) {
            let high = match tooth {
                // The value in the middle is not that of one function all over the box.
                Tooth::Later(_) => slack.value.high,
                Tooth::Any | Tooth::Behind(_) => slack.value.high.min(centre + swing(&slack, sides)),
            };
            if high < -KEPT {
                return Fate::Out;
            }
            if slack.value.low < 0.0 {
                unsure = [unsure[0].hull(slack.by[0]), unsure[1].hull(slack.by[1])];
            }
        }
        let from_centre = match tooth {
            Tooth::Later(_) => f64::NEG_INFINITY,
            Tooth::Any | Tooth::Behind(_) => {
                let value = self.measure.of(&at_centre);
                value * (1.0 - 1e-13) - swing(&measured, sides)
            }
        };
        let mut least = measured.value.low.max(from_centre);
        if let (Some(blend), Tooth::Any | Tooth::Behind(_), false) =
            (&self.blend, tooth, self.hopeless(least))
        {
            least = least.max(blend.least(ground, tooth, sides));
        }
        if self.hopeless(least) {
            return Fate::Out;
        }
        match face(&measured, unsure, sides) {
            Some(face) => Fate::Face(face),
            None => {
                let reach = |along: usize| {
                    let relative = sides[along].width() / sides[along].magnitude().max(1e-300);
                    let slope = measured.by[along].magnitude().min(1e50);
                    (slope * sides[along].width()).max(relative * 1e-6)
                };
                Fate::Open(least, usize::from(reach(1) > reach(0)))
            }
        }
    }

    /// Improves the best shape near where it was found.
    fn improve(&mut self) {
        self.improved = false;
        let (Some(found), Some((chart, sides))) = (self.found, self.home) else {
            return;
        };
        if self.goal == Goal::Any {
            return;
        }
        let ground = Ground {
            model: self.model,
            chart,
            measure: self.measure,
        };
        let found = polish::polish(&ground, sides, found);
        self.found = Some(found);
        self.blend = Blend::at(&ground, &found);
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

/// The face of a box on which its best shape lies: where the objective falls along a coordinate all over the box, and no
/// bound that may be broken in it gets tighter that way.
fn face(measured: &Slopes, unsure: [Interval; 2], sides: [Interval; 2]) -> Option<[Interval; 2]> {
    for along in 0..2 {
        let side = sides[along];
        if side.width() <= 0.0 {
            continue;
        }
        let slope = measured.by[along];
        let end = if slope.high < 0.0 && unsure[along].low >= 0.0 {
            side.high
        } else if slope.low > 0.0 && unsure[along].high <= 0.0 {
            side.low
        } else {
            continue;
        };
        let mut face = sides;
        face[along] = Interval::exactly(end);
        return Some(face);
    }
    None
}
