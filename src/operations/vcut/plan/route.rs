//! In which order the Vs of an operation are cut, and how the blade gets from one to the next (`docs/process.md`,
//! "Sequence").
//!
//! A route is a list of [`Run`]s: neighbouring cuts of one layer, made one after the other. `rows` and `boustrophedon` go
//! layer by layer; `nearest` goes on with whatever stretch is nearest among those that may be cut ([`precedence`]), and so
//! finishes a hollow before it crosses a hill.
//!
//! From the end of one run to the start of the next the blade stays beside the work where it meets nothing there
//! ([`Walker::way`]), else it goes over the safe plane.

pub mod precedence;

use super::parameters::VcutParameters;
use super::{PlannedCut, Way};
use crate::asked::Sequence;
use core::ops::Range;
use std::collections::BTreeSet;
use vcutc_geometry::curve::Point2;
use vcutc_job::Order;
use vcutc_simulation::surface::Surface;

/// Cuts of one layer that are made one after the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Places in the list of cuts.
    pub cuts: Range<usize>,
    /// Which of them comes first.
    pub heading: Heading,
    /// How the blade gets to the first of them from where the run before ended.
    pub way: Way,
}

/// Which way a run goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Heading {
    /// From left to right.
    Rightwards,
    /// From right to left.
    Leftwards,
}

impl Heading {
    const fn reversed(self) -> Self {
        match self {
            Self::Rightwards => Self::Leftwards,
            Self::Leftwards => Self::Rightwards,
        }
    }
}

/// What a route is found for.
#[derive(Clone, Copy, Debug)]
pub struct Terrain<'p> {
    /// The cuts, layer by layer, each layer from left to right.
    pub cuts: &'p [PlannedCut],
    /// What operations before left of the stock.
    pub before: &'p Surface,
    /// The operation's parameters.
    pub parameters: &'p VcutParameters,
    /// Height of the safe plane.
    pub safe: f64,
}

/// The cuts of all layers in the order of a sequence.
#[must_use]
pub fn route(terrain: Terrain<'_>, sequence: Sequence, order: Order) -> Vec<Run> {
    match sequence {
        Sequence::Rows => rows(terrain.cuts),
        Sequence::Boustrophedon => to_and_fro(terrain, order),
        Sequence::Nearest => nearest(terrain, order),
    }
}

/// The cuts of all layers, one after the other, each in the direction that is given for it.
#[must_use]
pub fn as_given(terrain: Terrain<'_>, headings: &[Heading], order: Order) -> Vec<Run> {
    let mut walker = Walker::new(terrain, order);
    layers(terrain.cuts)
        .zip(headings)
        .map(|(cuts, &heading)| walker.visit(cuts, heading))
        .collect()
}

/// Places of the cuts of each layer.
pub fn layers(cuts: &[PlannedCut]) -> impl Iterator<Item = Range<usize>> {
    runs_between(cuts, |a, b| a.layer == b.layer)
}

/// Places of the cuts of each stretch: of a layer, as far as the blade gets from cut to cut beside the work.
fn stretches(cuts: &[PlannedCut]) -> impl Iterator<Item = Range<usize>> {
    runs_between(cuts, |a, b| a.layer == b.layer && b.way == Way::Beside)
}

fn runs_between(
    cuts: &[PlannedCut],
    joins: impl Fn(&PlannedCut, &PlannedCut) -> bool,
) -> impl Iterator<Item = Range<usize>> {
    cuts.chunk_by(joins).scan(0, |first, run| {
        let start = *first;
        *first += run.len();
        Some(start..*first)
    })
}

fn rows(cuts: &[PlannedCut]) -> Vec<Run> {
    let run = |cuts| Run {
        cuts,
        heading: Heading::Rightwards,
        way: Way::Over,
    };
    layers(cuts).map(run).collect()
}

fn to_and_fro(terrain: Terrain<'_>, order: Order) -> Vec<Run> {
    let mut walker = Walker::new(terrain, order);
    let mut heading = Heading::Rightwards;
    let run = |cuts: Range<usize>| {
        let run = walker.visit(cuts, heading);
        heading = match order {
            Order::Point => heading.reversed(),
            // A layer's right flanks lead back to where it began.
            Order::Layer => heading,
        };
        run
    };
    layers(terrain.cuts).map(run).collect()
}

/// At most this many stretches on either side of the blade are looked at for the nearest one.
const LOOKED_AT: usize = 16;

fn nearest(terrain: Terrain<'_>, order: Order) -> Vec<Run> {
    let stretches: Vec<Range<usize>> = stretches(terrain.cuts).collect();
    let mut waiting = precedence::Waiting::new(terrain, &stretches);
    let mut walker = Walker::new(terrain, order);
    let mut open = Open::default();
    for stretch in waiting.free() {
        open.add(stretch, terrain.cuts, &stretches);
    }
    let mut runs = Vec::with_capacity(stretches.len());
    while let Some(entry) = open.nearest(&mut walker) {
        let Some(cuts) = stretches.get(entry.stretch).cloned() else {
            break;
        };
        open.remove(entry.stretch, terrain.cuts, &stretches);
        runs.push(walker.visit(cuts, entry.heading));
        for freed in waiting.done(entry.stretch) {
            open.add(freed, terrain.cuts, &stretches);
        }
    }
    runs
}

/// An end of a stretch that may be cut now.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Entry {
    /// Where it lies, in micrometres.
    x: i64,
    stretch: usize,
    /// How it is run through from there.
    heading: Heading,
    cut: usize,
}

/// The ends of all stretches that may be cut now, from left to right.
#[derive(Default)]
struct Open {
    entries: BTreeSet<Entry>,
}

impl Open {
    fn ends(stretch: usize, cuts: &[PlannedCut], stretches: &[Range<usize>]) -> impl Iterator<Item = Entry> {
        let range = stretches.get(stretch).cloned().unwrap_or_default();
        let ends = [
            (range.start, Heading::Rightwards),
            (range.end.saturating_sub(1), Heading::Leftwards),
        ];
        let entry = move |(cut, heading)| {
            let planned: &PlannedCut = cuts.get(cut)?;
            Some(Entry {
                x: micrometres(planned.tip.x),
                stretch,
                heading,
                cut,
            })
        };
        ends.into_iter().filter_map(entry)
    }

    fn add(&mut self, stretch: usize, cuts: &[PlannedCut], stretches: &[Range<usize>]) {
        self.entries.extend(Self::ends(stretch, cuts, stretches));
    }

    fn remove(&mut self, stretch: usize, cuts: &[PlannedCut], stretches: &[Range<usize>]) {
        for end in Self::ends(stretch, cuts, stretches) {
            self.entries.remove(&end);
        }
    }

    /// The end that is the shortest way from the blade; the upper layer's, then the left one, among equals.
    fn nearest(&self, walker: &mut Walker<'_>) -> Option<Entry> {
        let Some(at) = walker.at else {
            return self.entries.first().copied();
        };
        let here = Entry {
            x: micrometres(at.x),
            stretch: 0,
            heading: Heading::Rightwards,
            cut: 0,
        };
        let left = self.entries.range(..here).rev().take(LOOKED_AT);
        let right = self.entries.range(here..).take(LOOKED_AT);
        let mut near: Vec<(f64, Entry)> = left
            .chain(right)
            .filter_map(|&entry| Some((walker.least_way(entry.cut)?, entry)))
            .collect();
        near.sort_by(|(a, one), (b, other)| a.total_cmp(b).then(one.stretch.cmp(&other.stretch)));
        let mut best: Option<(f64, Entry)> = None;
        for (least, entry) in near {
            if best.is_some_and(|(length, _)| length <= least) {
                break;
            }
            let Some(length) = walker.length_of_way(entry.cut) else {
                continue;
            };
            if best.is_none_or(|(known, _)| length < known) {
                best = Some((length, entry));
            }
        }
        best.map(|(_, entry)| entry)
    }
}

/// Tips lie on a grid of a micrometre.
#[expect(
    clippy::cast_possible_truncation,
    reason = "lengths of a stock in micrometres"
)]
fn micrometres(x: f64) -> i64 {
    (x * 1000.0).round() as i64
}

/// Heights this close are equal: a nanometre, as in the surface.
const TOUCH: f64 = 1e-6;

/// Goes along a route and keeps the surface as the cuts leave it.
pub(super) struct Walker<'p> {
    terrain: Terrain<'p>,
    order: Order,
    surface: Surface,
    /// Where the run before ended.
    at: Option<Point2>,
}

impl<'p> Walker<'p> {
    pub(super) fn new(terrain: Terrain<'p>, order: Order) -> Self {
        Self {
            terrain,
            order,
            surface: terrain.before.clone(),
            at: None,
        }
    }

    pub(super) fn visit(&mut self, cuts: Range<usize>, heading: Heading) -> Run {
        let all = self.terrain.cuts;
        let made = all.get(cuts.clone()).unwrap_or_default();
        let (Some(leftmost), Some(rightmost)) = (made.first(), made.last()) else {
            return Run {
                cuts,
                heading,
                way: Way::Over,
            };
        };
        let (first, last) = match heading {
            Heading::Rightwards => (leftmost, rightmost),
            Heading::Leftwards => (rightmost, leftmost),
        };
        let way = self.way(first.tip);
        for cut in made {
            self.surface.release(cut.vee());
        }
        self.at = Some(match self.order {
            Order::Point => last.tip,
            Order::Layer => first.tip,
        });
        Run { cuts, heading, way }
    }

    /// How the blade gets from where it is to a tip: beside the work if it meets nothing there.
    ///
    /// It goes across at the higher of both tips, turning as it goes, and straight down to the lower one as from the safe
    /// plane.
    pub(super) fn way(&mut self, to: Point2) -> Way {
        let clear = self.at.is_some_and(|from| self.is_clear(from, to));
        if clear { Way::Beside } else { Way::Over }
    }

    /// Whether no material stands so high that the blade, leaning over it by at most the swing to either side, meets it on
    /// a level way from one place to the other.
    ///
    /// Up to the clear height above its tip the blade is not over the work at all; what of it lies higher is at most
    /// `tan(swing)` times that height to the side of the tip. So material may stand as high as the clear height, and beside
    /// the way as high as a flank that rises from there. Both the surface and that bound are straight between the places
    /// that are looked at.
    fn is_clear(&mut self, from: Point2, to: Point2) -> bool {
        let (slope, clear) = (
            self.terrain.parameters.flanks.slope,
            self.terrain.parameters.clear_height.to_mm(),
        );
        let level = from.z.max(to.z);
        let (left, right) = (from.x.min(to.x), from.x.max(to.x));
        let bound = |x: f64| {
            let aside = (left - x).max(x - right).max(0.0);
            level + clear.max(aside * slope) + TOUCH
        };
        let bends = [left - clear / slope, right + clear / slope];
        let inside = self.surface.width();
        if bends
            .into_iter()
            .any(|x| (0.0..=inside).contains(&x) && self.surface.height(x) > bound(x))
        {
            return false;
        }
        // Farther away the bound lies above the stock.
        let far = (self.surface.top() - level).max(0.0) / slope;
        self.surface
            .corners_between((left - far).max(0.0), right + far)
            .all(|corner| corner.z <= bound(corner.x))
    }

    /// The shortest that the way to a cut can be.
    fn least_way(&self, cut: usize) -> Option<f64> {
        let (from, to) = (self.at?, self.terrain.cuts.get(cut)?.tip);
        Some((to.x - from.x).abs() + (to.z - from.z).abs())
    }

    /// How long the way to a cut is.
    fn length_of_way(&mut self, cut: usize) -> Option<f64> {
        let (from, to) = (self.at?, self.terrain.cuts.get(cut)?.tip);
        let safe = self.terrain.safe;
        Some(match self.way(to) {
            Way::Beside => (to.x - from.x).abs() + (to.z - from.z).abs(),
            Way::Over => (to.x - from.x).abs() + (safe - from.z) + (safe - to.z),
        })
    }
}
