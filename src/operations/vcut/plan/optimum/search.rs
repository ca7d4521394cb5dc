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
//! is broken, and the search ends as soon as none is broken.

use super::certain::Blend;
use super::chart::Chart;
use super::descent::{self, Rest};
use super::formulas::{Keeping, Model, Tooth};
use super::ground::{Found, Ground, KEPT, Measure, Merit, swing};
use super::polish;
use core::cmp::Ordering;
use std::collections::BinaryHeap;
use vcutc_geometry::number::{Interval, Slopes};

/// A box that promises less than this share of improvement is not looked into.
const GAP: f64 = 1e-7;

/// Most boxes that a search for the best shape looks into.
const MOST_BOXES: u32 = 6000;

/// Most boxes that a search for any shape looks into. What is left then breaks a bound, or misses
/// one by very little.
const MOST_FOR_ANY: u32 = 20_000;

/// On so many steps of the saw-tooth a quick search descends.
const QUICK: u32 = 12;

/// How closely shapes are tried before a descent: so many along each coordinate.
const TRIES: [u32; 2] = [6, 3];

/// A descent begins at a shape that is no worse than this many times the best.
const WORTH: f64 = 1.5;

/// A descent begins again where a bound is broken by less than this share of the least so far.
const NEARER: f64 = 0.5;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// The best shape.
    Best,
    /// Any shape that keeps the bounds.
    Any,
    /// Any shape that keeps the bounds, among those that a few descents meet.
    Quick,
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

/// What shapes of a box may come to.
struct Promise {
    measured: Slopes,
    /// How the bounds that may be broken in it slope.
    unsure: [Interval; 2],
    least: f64,
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
        let tooth = Tooth::Beyond(self.model.beyond(found.shape.share));
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
        if self.promise(&self.grounds[number], chart.sides).is_none() {
            return;
        }
        match tooth {
            Tooth::Any | Tooth::Beyond(_) => self.look_around(number),
            Tooth::Later(_) => {}
        }
        self.look(number, chart.sides);
    }

    /// Tries a few shapes all over a ground, and descends from the best.
    fn look_around(&mut self, number: usize) {
        let ground = self.grounds[number];
        let mut best: Option<([f64; 2], Merit)> = None;
        // The middle of one of so many equal parts of a side.
        let along = |i: usize, step: u32| {
            let side = ground.chart.sides[i];
            side.low + side.width() * (f64::from(step) + 0.5) / f64::from(TRIES[i])
        };
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

    /// Goes down from a place to where it is best around it, and records where nothing is better.
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
        let Some(promise) = self.promise(ground, sides) else {
            return Fate::Out;
        };
        let Promise {
            measured,
            unsure,
            least,
        } = promise;
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

    /// What a box promises; none if a bound is broken all over it or nothing in it is better than what is known.
    fn promise(&self, ground: &Ground<'_>, sides: [Interval; 2]) -> Option<Promise> {
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
                Tooth::Any | Tooth::Beyond(_) => slack
                    .value
                    .high
                    .min(centre + 1e-13 * (1.0 + centre.abs()) + swing(&slack, sides)),
            };
            if high < -KEPT {
                return None;
            }
            broken = broken.max(-high);
            if slack.value.low < 0.0 {
                unsure = [unsure[0].hull(slack.by[0]), unsure[1].hull(slack.by[1])];
            }
        }
        let from_centre = |value: f64| value * (1.0 - 1e-13) - swing(&measured, sides);
        let least = match (self.measure, ground.tooth) {
            (Measure::Breach, _) => broken,
            (Measure::Time | Measure::Cuts, Tooth::Later(_)) => measured.value.low,
            (Measure::Time, _) => measured.value.low.max(from_centre(at_centre.time)),
            (Measure::Cuts, _) => measured.value.low.max(from_centre(at_centre.cuts)),
        };
        (!self.hopeless(least)).then_some(Promise {
            measured,
            unsure,
            least,
        })
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
