//! Strips along walls: their slits, the passes of the disc, and the pillars in corners.

use super::gentle::gentle;
use super::inner::{Inner, has_corners};
use super::measures::Measures;
use core::f64::consts::FRAC_PI_2;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_region::curve::Curve;
use vcutc_region::distance::Walls;
use vcutc_region::outward::{corners, outward};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::plate::{Reach, Stroke};
use vcutc_region::region::Region;
use vcutc_region::slits::{Begin, Slit, SlitPiece};

/// Strips along the walls around rows.
pub(super) struct Strips<'l> {
    pub(super) measures: Measures,
    pub(super) walls: &'l Walls,
    pub(super) stock: Stock,
    /// How many strips lie beside each other.
    pub(super) rings: u32,
    /// The ways of the level that bounds the rows, from open side to open side.
    pub(super) runs: &'l [Vec<Piece>],
    /// The levels on which the disc enters corners, the one nearest to the walls last.
    pub(super) inner: &'l [Inner],
}

impl Strips<'_> {
    /// A slit between strips, counted from the walls, as ways from open side to open side.
    pub(super) fn slit(&self, number: u32) -> Vec<Vec<Piece>> {
        let by = self.aside(number) + self.measures.radius - self.measures.over;
        self.runs
            .iter()
            .map(|run| gentle(self.led_out(outward(run, by))))
            .collect()
    }

    /// A way that ends as far beyond the sides of the stock as ways run out there: moved outwards, it may end less far.
    fn led_out(&self, mut pieces: Vec<Piece>) -> Vec<Piece> {
        if let Some(first) = pieces.first_mut().filter(|piece| piece.is_line()) {
            first.from = self.beyond(first.from, first.direction(0.0).times(-1.0));
        }
        if let Some(last) = pieces.last_mut().filter(|piece| piece.is_line()) {
            last.to = self.beyond(last.to, last.direction(1.0));
        }
        pieces
    }

    /// A place beyond a side of the stock, moved out in a direction as far as it takes.
    fn beyond(&self, at: Place, out: Place) -> Place {
        let [width, depth] = [self.stock.width, self.stock.depth].map(Length::to_mm);
        let reach = self.measures.reach;
        let missing = |at: f64, out: f64, long: f64| {
            let by = if at > long {
                (long + reach - at) / out
            } else {
                (-reach - at) / out
            };
            let is_beyond = at > long || at < 0.0;
            (is_beyond && by.is_finite() && by > 0.0).then_some(by)
        };
        let ways = [missing(at.x, out.x, width), missing(at.y, out.y, depth)];
        let far = ways.into_iter().flatten().reduce(f64::min).unwrap_or(0.0);
        at.plus(out.times(far))
    }

    /// How far a pass lies beside the level, counted from the walls.
    fn aside(&self, number: u32) -> f64 {
        f64::from(self.rings - number.min(self.rings)) * self.measures.step
    }

    /// The slits between strips, and those around the pillars.
    pub(super) fn slits(&self) -> Vec<Slit> {
        let between = (1..=self.rings).flat_map(|number| self.slit(number));
        let mut slits: Vec<Slit> = between.map(|way| upright(way, Begin::Beside)).collect();
        let reach = self.measures.radius - self.measures.over;
        let around = |runs: &[Vec<Piece>], by: f64| -> Vec<Piece> {
            runs.iter().flat_map(|run| corners(run, by)).collect()
        };
        let mut arcs = around(self.runs, self.aside(0) + reach);
        arcs.extend(self.inner.iter().flat_map(|inner| inner.arcs(reach)));
        slits.extend(arcs.into_iter().flat_map(|arc| self.around_a_pillar(arc)));
        slits
    }

    /// Slits that part a pillar: one along the arc with the blade square to its way, or two from its middle to both ends with the leading
    /// edge more upright, so that less of the blade is ahead of its tip, and more behind it. They end so far before the walls that the blade
    /// touches these only at its corners; the first of those is taken that keeps from walls and still meets the slits along them. None in
    /// corners so flat that no pillar is left.
    fn around_a_pillar(&self, arc: Piece) -> Vec<Slit> {
        let Measures {
            half_apex,
            deep,
            half,
            ..
        } = self.measures;
        let radius = arc.radius().unwrap_or(f64::INFINITY);
        let flat = radius * (1.0 / libm::cos(arc.sweep / 2.0) - 1.0);
        if flat < FLAT * half {
            return Vec::new();
        }
        let pieces = UPRIGHT.into_iter().filter_map(|upright| {
            let rake = FRAC_PI_2 + upright * half_apex;
            let before = 2.0 * Reach::at(rake, half_apex, deep).ahead;
            // So far the ends of the arc are beside the slits along the walls.
            let is_met = before * before / (2.0 * radius) < MEETS * 2.0 * half;
            let share = before / arc.length();
            let ways = if upright == 0.0 {
                vec![arc.part(share, 1.0 - share)]
            } else {
                vec![arc.part(share, 0.5).reversed(), arc.part(0.5, 1.0 - share)]
            };
            let pieces = ways.into_iter().map(|way| SlitPiece {
                way,
                rakes: [rake; 2],
            });
            let pieces: Vec<SlitPiece> = pieces.collect();
            let fits = is_met && share < 0.4 && pieces.iter().all(|piece| self.is_free(*piece));
            fits.then_some(pieces)
        });
        let slits = pieces.take(1).flatten().map(|piece| Slit {
            pieces: vec![piece],
            begins: Begin::Within,
        });
        slits.collect()
    }

    /// Whether the blade keeps from all walls on a piece of a slit, at the full depth of the pocket.
    fn is_free(&self, piece: SlitPiece) -> bool {
        let Measures {
            half_apex,
            deep,
            half,
            keeps,
            ..
        } = self.measures;
        let stroke = Stroke {
            way: piece.way,
            reaches: piece.rakes.map(|rake| Reach::at(rake, half_apex, deep)),
            half,
        };
        stroke
            .nearest_to(self.walls)
            .is_none_or(|(_, near)| near.distance >= keeps[0])
    }

    /// Appends the passes of the disc, those beside the rows first, then those into the corners: each begins where it is nearest to where
    /// the one before it ended.
    pub(super) fn passes(&self, passes: &mut Vec<Pass>) {
        for number in (0..self.rings).rev() {
            for run in self.runs {
                push(passes, number, self.led_out(outward(run, self.aside(number))));
            }
        }
        if !self.runs.iter().any(|run| has_corners(run)) {
            return;
        }
        for inner in self.inner {
            for run in inner.passes() {
                push(passes, 0, if inner.is_last() { run } else { self.led_out(run) });
            }
        }
    }
}

/// How upright the leading edge is held beside a pillar, from square to the way to upright.
const UPRIGHT: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Pillars that are thinner than this lie within the slits along the walls, in parts of half the thickness of the straight blade.
const FLAT: f64 = 0.4;

/// How far beside each other two slits lie at most that meet, in thicknesses.
const MEETS: f64 = 0.6;

/// Appends a way, from its nearer end.
fn push(passes: &mut Vec<Pass>, level: u32, mut pieces: Vec<Piece>) {
    let at = passes
        .last()
        .and_then(|pass| pass.pieces.last())
        .map(|piece| piece.to);
    let ends = pieces.first().zip(pieces.last());
    let is_far = at
        .zip(ends)
        .is_some_and(|(at, (first, last))| last.to.distance(at) < first.from.distance(at));
    if is_far {
        pieces.reverse();
        for piece in &mut pieces {
            *piece = piece.reversed();
        }
    }
    if !pieces.is_empty() {
        passes.push(Pass { level, pieces });
    }
}

/// A slit with the blade square to its way.
pub(super) fn upright(way: Vec<Piece>, begins: Begin) -> Slit {
    let pieces = way.into_iter().map(|way| SlitPiece {
        way,
        rakes: [FRAC_PI_2; 2],
    });
    Slit {
        pieces: pieces.collect(),
        begins,
    }
}

/// A rectangle that lies so far beyond all sides of a region.
pub(super) fn beyond_all_sides(region: &Region, reach: f64) -> Vec<Piece> {
    let bounds = region
        .edges()
        .map(|edge| Curve::of(edge.piece).extent())
        .reduce(|one, other| one.with(other));
    let Some(bounds) = bounds.map(|bounds| bounds.grown(reach)) else {
        return Vec::new();
    };
    let (low, high) = (bounds.low, bounds.high);
    let corners = [low, Place::new(high.x, low.y), high, Place::new(low.x, high.y)];
    let next = corners.iter().cycle().skip(1);
    corners
        .iter()
        .zip(next)
        .map(|(&from, &to)| Piece::line(from, to))
        .collect()
}
