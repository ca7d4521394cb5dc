//! Strips along walls: their slits, the passes of the disc, and the pillars in corners.

use super::layout::Measures;
use core::f64::consts::FRAC_PI_2;
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
    /// How many strips lie beside each other.
    pub(super) rings: u32,
    /// The ways of the level that bounds the rows, from open side to open side.
    pub(super) runs: &'l [Vec<Piece>],
    /// The ways nearest to the walls, with their corners.
    pub(super) sharp: &'l [Vec<Piece>],
}

impl Strips<'_> {
    /// A slit between strips, counted from the walls, as ways from open side to open side.
    pub(super) fn slit(&self, number: u32) -> Vec<Vec<Piece>> {
        let by = self.aside(number) + self.measures.radius - self.measures.over;
        self.runs.iter().map(|run| outward(run, by)).collect()
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
        arcs.extend(around(self.sharp, reach));
        slits.extend(arcs.into_iter().flat_map(|arc| self.around_a_pillar(arc)));
        slits
    }

    /// Slits that part a pillar. Where it still meets the slits along the walls: one with the blade square to its way, which ends so far before
    /// the walls that the blade touches them only at its corners. Else two, from the middle of the arc to the walls at both of its ends with
    /// the leading edge upright, so that nothing of the blade is beyond its tip there. None where neither has room.
    fn around_a_pillar(&self, arc: Piece) -> Vec<Slit> {
        let Measures {
            half_apex,
            deep,
            half,
            ..
        } = self.measures;
        let leading = [FRAC_PI_2 + half_apex; 2];
        let halves =
            [arc.part(0.0, 0.5).reversed(), arc.part(0.5, 1.0)].map(|way| SlitPiece { way, rakes: leading });
        let before = 2.0 * deep * libm::tan(half_apex);
        // So far the ends of the arc are beside the slits along the walls.
        let aside = before * before / (2.0 * arc.radius().unwrap_or(f64::INFINITY));
        let share = before / arc.length();
        let is_met = share < 0.4 && aside < MEETS * 2.0 * half;
        let whole = is_met.then(|| SlitPiece {
            way: arc.part(share, 1.0 - share),
            rakes: [FRAC_PI_2; 2],
        });
        let ways = [whole.into_iter().collect(), halves.to_vec()];
        let fitting = ways
            .into_iter()
            .find(|pieces| !pieces.is_empty() && pieces.iter().all(|piece| self.is_free(*piece)));
        let slits = fitting.into_iter().flatten().map(|piece| Slit {
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

    /// Appends the passes of the disc, those beside the rows first, and a last one into the corners: each begins where it is nearest to
    /// where the one before it ended.
    pub(super) fn passes(&self, passes: &mut Vec<Pass>) {
        for number in (0..self.rings).rev() {
            for run in self.runs {
                push(passes, number, outward(run, self.aside(number)));
            }
        }
        let has_corners = |run: &&Vec<Piece>| !corners(run, self.aside(0)).is_empty();
        if self.runs.iter().any(|run| has_corners(&run)) {
            for run in self.sharp {
                push(passes, 0, run.clone());
            }
        }
    }
}

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
