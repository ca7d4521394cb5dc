//! The least time or number of cuts over all shapes, by branch and bound.
//!
//! A descent from the best of a few shapes finds what is likely the best one, and proves that around it there is no better
//! (`certain`). The rest is divided into boxes. A box is thrown away when a bound is broken all over it, or when nothing in
//! it can beat the best shape known: what it can come to is enclosed by intervals, and more tightly by its value in the middle and
//! its slopes (the mean-value form of interval analysis). Where the objective falls along a coordinate all over a box, only
//! the box's far face remains. Of the rest the most promising box is halved, until nothing remains or the budget is spent;
//! the difference between the best shape and the most promising box left is then the proven gap.
//!
//! Whether any shape keeps all bounds is the same question: what is made least is then the greatest share by which a bound
//! is broken, and the search ends as soon as that is none.

use super::certain::Blend;
use super::chart::Chart;
use super::descent::{self, Rest};
use super::formulas::{Keeping, Model, Outcome, Shape, Tooth};
use super::number::{Interval, Jet, Number, Slopes};
use super::polish;
use core::cmp::Ordering;
use std::collections::BinaryHeap;

/// Bounds are kept to this share of them: what rounding may take.
pub(super) const KEPT: f64 = 1e-11;

/// A box that promises less than this share of improvement is not looked into.
const GAP: f64 = 1e-7;

/// Most boxes that a search for the best shape looks into.
const MOST_BOXES: u32 = 6000;

/// Most boxes that a search for any shape looks into. What is left then breaks a bound, or keeps all but for a hair.
const MOST_FOR_ANY: u32 = 20_000;

/// On so many steps of the saw-tooth a quick search descends.
const QUICK: u32 = 12;

/// How closely shapes are tried before a descent: so many along each coordinate.
const TRIES: [u32; 2] = [6, 3];

/// A descent begins at a shape that is no worse than this many times the best.
const WORTH: f64 = 1.5;

/// A descent begins anew where a bound is broken by less than this share of the least so far.
const NEARER: f64 = 0.5;

/// What is made least.
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
    /// The scallop does not.
    Scallop(Asked),
    Late(Keeping),
    Many(Keeping),
    /// The coordinate that the other two decide is below its range.
    Below,
    /// It is above its range.
    Above,
}

/// What asks for a least layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asked {
    Layer,
    Step,
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

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// The best shape.
    Best,
    /// Any shape that keeps the bounds.
    Any,
    /// Any shape that keeps the bounds, among those that a few descents meet.
    Quick,
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
    pub(super) tooth: Tooth,
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
    fn enclosed(&self, sides: [Interval; 2]) -> (Slopes, [Slopes; 6]) {
        let shape = self
            .chart
            .shape(Slopes::first(sides[0]), Slopes::second(sides[1]));
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
    pub(super) fn term<N: Number>(&self, term: Term, [first, second]: [N; 2]) -> N {
        let shape = self.chart.shape(first, second);
        let bounds = || self.model.bounds(shape, self.tooth);
        let cost = |keeping: Keeping| self.model.cost(shape, &bounds(), keeping);
        let one = N::constant(1.0);
        let beyond = |limit: Option<f64>, value: N| {
            limit.map_or(N::constant(-1.0), |limit| one - N::constant(limit) / value)
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
            Term::Below => N::constant(0.0) - self.chart.slack(shape)[0],
            Term::Above => N::constant(0.0) - self.chart.slack(shape)[1],
        }
    }

    pub(super) fn value(&self, term: Term, place: [f64; 2]) -> f64 {
        self.term(term, place)
    }

    pub(super) fn jet(&self, term: Term, [first, second]: [f64; 2]) -> Jet<f64> {
        self.term(term, [Jet::coordinate(0, first), Jet::coordinate(1, second)])
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

/// A box and the least that its shapes can come to.
struct Candidate {
    ground: usize,
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

/// A box in which nothing is better than what is known, on its ground.
struct Region {
    ground: usize,
    sides: [Interval; 2],
}

struct Search<'m> {
    model: &'m Model,
    measure: Measure,
    goal: Goal,
    grounds: Vec<Ground<'m>>,
    found: Option<Found>,
    /// The ground of the best shape, and the box that it was found in.
    home: (usize, [Interval; 2]),
    /// The least share by which a bound was broken so far.
    breach: f64,
    regions: Vec<Region>,
    /// What bounds the best shape, on its ground.
    blend: Option<(usize, Blend)>,
    open: BinaryHeap<Candidate>,
    boxes: u32,
    /// The least that boxes too small to halve can come to.
    remaining: f64,
}

/// The best shape of a lattice, or any; none if none keeps the bounds.
pub(super) fn best(model: &Model, measure: Measure, goal: Goal) -> Option<Found> {
    match goal {
        Goal::Any => Search::new(model, Measure::Breach, goal).run(),
        Goal::Quick => Search::new(model, Measure::Breach, goal).quick(),
        Goal::Best => Search::new(model, measure, goal).run(),
    }
}

impl<'m> Search<'m> {
    fn new(model: &'m Model, measure: Measure, goal: Goal) -> Self {
        Self {
            model,
            measure,
            goal,
            grounds: Vec::new(),
            found: None,
            home: (0, [Interval::ZERO; 2]),
            breach: f64::INFINITY,
            regions: Vec::new(),
            blend: None,
            open: BinaryHeap::new(),
            boxes: 0,
            remaining: f64::INFINITY,
        }
    }

    fn run(mut self) -> Option<Found> {
        for tooth in self.model.teeth() {
            self.enter(tooth);
        }
        if self.found.is_none() && self.measure != Measure::Breach {
            self.begin_within_bounds()?;
        }
        let most = match self.measure {
            Measure::Time | Measure::Cuts => MOST_BOXES,
            Measure::Breach => MOST_FOR_ANY,
        };
        while let Some(candidate) = self.open.pop() {
            if self.hopeless(candidate.least) {
                break;
            }
            if self.boxes >= most {
                self.remaining = self.remaining.min(candidate.least);
                break;
            }
            self.divide(&candidate);
        }
        let remaining = self.remaining;
        self.found.map(|found| Found {
            gap: ((found.value - remaining) / found.value).max(GAP),
            ..found
        })
    }

    /// What descents from a few shapes meet.
    fn quick(mut self) -> Option<Found> {
        let model = self.model;
        for first in model.teeth() {
            let mut rest = Some(first);
            for _ in 0..QUICK {
                let Some(tooth) = rest else {
                    break;
                };
                let (now, later) = match model.divided(tooth) {
                    Some([now, later]) => (now, Some(later)),
                    None => (tooth, None),
                };
                if let Some(chart) = Chart::new(model, now) {
                    let number = self.stand(chart, now);
                    self.look_around(number);
                }
                if self.found.is_some() {
                    return self.found;
                }
                rest = later;
            }
        }
        None
    }

    fn stand(&mut self, chart: Chart, tooth: Tooth) -> usize {
        self.grounds.push(Ground {
            model: self.model,
            chart,
            tooth,
            measure: self.measure,
        });
        self.grounds.len() - 1
    }

    /// Begins with a shape that keeps the bounds, if there is one.
    fn begin_within_bounds(&mut self) -> Option<()> {
        let found = Search::new(self.model, Measure::Breach, Goal::Any).run()?;
        let tooth = Tooth::Behind(self.model.behind(found.shape.share));
        let number = match self
            .grounds
            .iter()
            .position(|ground| ground.tooth == tooth || ground.tooth == Tooth::Any)
        {
            Some(number) => number,
            None => self.stand(Chart::new(self.model, tooth)?, tooth),
        };
        let place = self.grounds[number].chart.place(found.shape);
        self.descend(number, place);
        self.found = self.grounds[number].better(self.found, place).or(Some(found));
        Some(())
    }

    /// Whether what comes to no less than this is not worth looking into.
    fn hopeless(&self, least: f64) -> bool {
        least > self.threshold()
    }

    /// What comes to more is not worth looking into.
    fn threshold(&self) -> f64 {
        match (self.measure, &self.found) {
            (Measure::Time | Measure::Cuts, Some(found)) => found.value * (1.0 - GAP),
            (Measure::Time | Measure::Cuts, None) => f64::INFINITY,
            (Measure::Breach, Some(_)) => f64::NEG_INFINITY,
            (Measure::Breach, None) => KEPT,
        }
    }

    fn enter(&mut self, tooth: Tooth) {
        let Some(chart) = Chart::new(self.model, tooth) else {
            return;
        };
        let number = self.stand(chart, tooth);
        match tooth {
            Tooth::Any | Tooth::Behind(_) => self.look_around(number),
            Tooth::Later(_) => {}
        }
        self.look(number, chart.sides);
    }

    /// Tries a few shapes all over a ground, and descends from the best.
    fn look_around(&mut self, number: usize) {
        let ground = self.grounds[number];
        let mut best: Option<([f64; 2], Merit)> = None;
        let along = |i: usize, step: u32| ground.chart.sides[i].part(step, TRIES[i]);
        for first in 0..TRIES[0] {
            for second in 0..TRIES[1] {
                let place = [along(0, first), along(1, second)];
                let merit = ground.at(place).merit;
                if best.is_none_or(|(_, best)| merit.beats(best)) {
                    best = Some((place, merit));
                }
            }
        }
        let Some((place, merit)) = best else {
            return;
        };
        let worth = match (merit, self.found) {
            (Merit::Keeps(value), Some(found)) => value <= WORTH * found.value,
            (Merit::Keeps(_), None) => true,
            (Merit::Breaks(_), Some(_)) => false,
            (Merit::Breaks(breach), None) => {
                self.breach = self.breach.min(breach);
                self.measure == Measure::Breach
            }
        };
        if worth {
            self.try_at(number, place);
            self.descend(number, place);
        }
    }

    /// Tries a shape.
    fn try_at(&mut self, number: usize, place: [f64; 2]) -> bool {
        let before = self.found.map(|found| found.value);
        self.found = self.grounds[number].better(self.found, place);
        let better = self.found.map(|found| found.value) != before;
        if better {
            self.home = (number, self.grounds[number].chart.sides);
        }
        better
    }

    /// Goes down from a place to where it is best around it, and tells off where nothing is better.
    fn descend(&mut self, number: usize, start: [f64; 2]) {
        let ground = self.grounds[number];
        let rest = descent::descend(&ground, start);
        match rest {
            Some(rest) => {
                let better = self.try_at(number, rest.place);
                self.prove(number, rest, better);
            }
            None => {
                if let (Some(found), Measure::Time | Measure::Cuts) = (self.found, self.measure) {
                    let polished = polish::by_sections(&ground, ground.chart.sides, found);
                    self.try_at(number, polished.place);
                }
            }
        }
    }

    fn prove(&mut self, number: usize, rest: Rest, better: bool) {
        if self.goal == Goal::Quick {
            return;
        }
        let blend = Blend::at(rest);
        let ground = self.grounds[number];
        if let Some(sides) = blend.region(&ground, self.threshold()) {
            self.regions.push(Region {
                ground: number,
                sides,
            });
        }
        if (better || self.measure == Measure::Breach) && blend.is_mixed() {
            self.blend = Some((number, blend));
        }
    }

    fn divide(&mut self, candidate: &Candidate) {
        let ground = self.grounds[candidate.ground];
        if let Some(teeth) = self.model.divided(ground.tooth) {
            for tooth in teeth {
                self.enter(tooth);
            }
            return;
        }
        let (along, at) = self.cut(candidate);
        let side = candidate.sides[along];
        if side.width() <= 1e-13 * side.magnitude() {
            self.remaining = self.remaining.min(candidate.least);
            return;
        }
        for half in [Interval { high: at, ..side }, Interval { low: at, ..side }] {
            let mut sides = candidate.sides;
            sides[along] = half;
            self.look(candidate.ground, sides);
        }
    }

    /// Where a box is divided: along the edge of one that is done with, or in the middle.
    fn cut(&self, candidate: &Candidate) -> (usize, f64) {
        for region in self
            .regions
            .iter()
            .filter(|region| region.ground == candidate.ground)
        {
            let meets = (0..2).all(|i| {
                region.sides[i].low <= candidate.sides[i].high
                    && candidate.sides[i].low <= region.sides[i].high
            });
            if !meets {
                continue;
            }
            for i in [candidate.along, 1 - candidate.along] {
                for edge in [region.sides[i].low, region.sides[i].high] {
                    if candidate.sides[i].low < edge && edge < candidate.sides[i].high {
                        return (i, edge);
                    }
                }
            }
        }
        (candidate.along, candidate.sides[candidate.along].between())
    }

    fn done_with(&self, number: usize, sides: [Interval; 2]) -> bool {
        self.regions.iter().any(|region| {
            region.ground == number
                && (0..2)
                    .all(|i| region.sides[i].low <= sides[i].low && sides[i].high <= region.sides[i].high)
        })
    }

    /// Judges a box and keeps it if there is hope.
    fn look(&mut self, number: usize, mut sides: [Interval; 2]) {
        let ground = self.grounds[number];
        loop {
            self.boxes += 1;
            if self.done_with(number, sides) {
                return;
            }
            match self.judge(number, &ground, sides) {
                Fate::Out => return,
                Fate::Face(face) => sides = face,
                Fate::Open(least, along) => {
                    self.open.push(Candidate {
                        ground: number,
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

    /// Tries the shape of a box that is most likely to keep the bounds, and descends from it if it is better than what is known.
    fn try_one(&mut self, number: usize, sides: [Interval; 2], unsure: [Interval; 2]) {
        let place = [0, 1].map(|i| match (unsure[i].low >= 0.0, unsure[i].high <= 0.0) {
            (true, false) => sides[i].high,
            (false, true) => sides[i].low,
            (true, true) | (false, false) => sides[i].middle(),
        });
        if self.try_at(number, place) {
            self.descend(number, place);
            return;
        }
        if self.measure != Measure::Breach || self.found.is_some() {
            return;
        }
        if let Merit::Breaks(breach) = self.grounds[number].at(place).merit
            && breach < NEARER * self.breach
        {
            self.breach = breach;
            self.descend(number, place);
        }
    }

    fn judge(&mut self, number: usize, ground: &Ground<'_>, sides: [Interval; 2]) -> Fate {
        let chart = &ground.chart;
        let (measured, slacks) = ground.enclosed(sides);
        let centre = chart.shape(sides[0].middle(), sides[1].middle());
        let at_centre = self.model.outcome(centre, ground.tooth, Keeping::Both);
        let at_centres = at_centre.slack.into_iter().chain(chart.slack(centre));
        let mut unsure = [Interval::ZERO; 2];
        let mut broken = f64::NEG_INFINITY;
        for (slack, centre) in slacks.into_iter().zip(at_centres) {
            let high = match ground.tooth {
                // The value in the middle is not that of one function all over the box.
                Tooth::Later(_) => slack.value.high,
                Tooth::Any | Tooth::Behind(_) => slack
                    .value
                    .high
                    .min(centre + 1e-13 * (1.0 + centre.abs()) + swing(&slack, sides)),
            };
            if high < -KEPT {
                return Fate::Out;
            }
            broken = broken.max(-high);
            if slack.value.low < 0.0 {
                unsure = [unsure[0].hull(slack.by[0]), unsure[1].hull(slack.by[1])];
            }
        }
        let least = match (self.measure, ground.tooth) {
            (Measure::Breach, _) => broken,
            (Measure::Time | Measure::Cuts, Tooth::Later(_)) => measured.value.low,
            (Measure::Time, _) => {
                let from_centre = at_centre.time * (1.0 - 1e-13) - swing(&measured, sides);
                measured.value.low.max(from_centre)
            }
            (Measure::Cuts, _) => {
                let from_centre = at_centre.cuts * (1.0 - 1e-13) - swing(&measured, sides);
                measured.value.low.max(from_centre)
            }
        };
        if self.hopeless(self.blended(number, ground, sides, least)) {
            return Fate::Out;
        }
        self.try_one(number, sides, unsure);
        if self.hopeless(least) {
            return Fate::Out;
        }
        match face(&measured, unsure, sides) {
            Some(face) => Fate::Face(face),
            None => {
                let function = match self.measure {
                    Measure::Time | Measure::Cuts => measured.by,
                    Measure::Breach => unsure,
                };
                let reach = |along: usize| {
                    let relative = sides[along].width() / sides[along].magnitude().max(1e-300);
                    let slope = function[along].magnitude().min(1e50);
                    (slope * sides[along].width()).max(relative * 1e-6)
                };
                Fate::Open(least, usize::from(reach(1) > reach(0)))
            }
        }
    }

    /// What a box can come to at least, by what bounds the best shape too.
    fn blended(&self, number: usize, ground: &Ground<'_>, sides: [Interval; 2], least: f64) -> f64 {
        match &self.blend {
            Some((home, blend)) if *home == number && !self.hopeless(least) => {
                least.max(blend.least(ground, sides))
            }
            Some(_) | None => least,
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

/// The face of a box on which its best shape lies: where the objective does not rise along a coordinate all over the box,
/// and no bound that may be broken in it gets tighter that way.
fn face(measured: &Slopes, unsure: [Interval; 2], sides: [Interval; 2]) -> Option<[Interval; 2]> {
    for along in 0..2 {
        let side = sides[along];
        if side.width() <= 0.0 {
            continue;
        }
        let slope = measured.by[along];
        let end = if slope.high <= 0.0 && unsure[along].low >= 0.0 {
            side.high
        } else if slope.low >= 0.0 && unsure[along].high <= 0.0 {
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
