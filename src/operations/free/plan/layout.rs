//! How strips lie over a region: rows along an open side, and strips along the walls around them.
//!
//! With the radius `R` of the disc, `R_s` of its shank, the air `c` that this keeps, and `o` by which the rim runs on beyond a slit: the
//! disc undercuts a strip of width `f` from its slit on, and its shank lies over the strip before, if
//!
//! ```text
//! f <= R - R_s - o - c
//! ```
//!
//! Let `L` be the level at `R + m f` from the walls. All slits and passes between it and the walls are `L` moved outwards: slits by
//! `(m - n) f + R - o` and passes by `(m - n) f`, for `n = 0 ... m`. So no slit has an inward corner that is sharper than `R - o`, where a
//! rim would leave ground under it, and each pass lies as far from both of its slits in corners as it does along straight walls.

use super::crossing;
use super::inner::{self, Inner};
use super::measures::Measures;
use super::rows::Field;
use super::strips::{self, Strips};
use crate::asked::FreePocket;
use crate::refused::Why;
use vcutc_backend_api::ir::Stock;
use vcutc_region::distance::Walls;
use vcutc_region::offset::{Kind, OffsetFault, Offsets};
use vcutc_region::outward::outward;
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::region::{Region, Side};
use vcutc_region::rows::Front;
use vcutc_region::slits::Slit;

/// A layer with every choice made.
#[derive(Clone, Debug)]
pub(super) struct Laid {
    pub(super) rings: u32,
    pub(super) rows: usize,
    pub(super) row: f64,
    /// Other than those along walls.
    pub(super) slits: Vec<Slit>,
    pub(super) passes: Vec<Pass>,
}

/// What rounding may take of a line, in mm.
const ROUNDING: f64 = 1e-6;

/// The straight open sides of a region, each line once.
pub(super) fn fronts(region: &Region) -> Vec<Front> {
    let mut fronts: Vec<Front> = Vec::new();
    for edge in region.edges() {
        if edge.side == Side::Wall || !edge.piece.is_line() {
            continue;
        }
        let is_known = fronts.iter().any(|front| {
            [edge.piece.from, edge.piece.to]
                .iter()
                .all(|at| front.depth(*at).abs() < ROUNDING)
        });
        if !is_known {
            fronts.push(Front::of(edge.piece));
        }
    }
    fronts
}

/// The strips of a layer, seen from an open side, with so many strips along the walls.
pub(super) fn lay(
    asked: &FreePocket,
    measures: Measures,
    (front, rings): (Front, u32),
    stock: Stock,
) -> Result<Laid, Why> {
    let region = &asked.region.region;
    let outline = outline(region)?;
    let mut offsets = Offsets::of(region, measures.reach);
    let level = measures.level(rings);
    let bound = bounding(region, &mut offsets, (measures, level))?;
    let aside = (measures.radius - measures.shank - measures.over).min(f64::from(rings) * measures.step);
    let field = Field {
        front,
        level,
        centres: &outward(&bound, aside),
        ground: &outward(&bound, measures.radius - measures.over),
        deepest: front.deepest(&outline),
        to_corner: measures.radius - measures.over - aside,
        measures,
        stock,
    };
    let rowed = field.rows()?;
    let runs = runs(region, &mut offsets, level)?;
    let strips = Strips {
        measures,
        walls: &Walls::of(region),
        stock,
        rings,
        inner: &inner_levels(region, &mut offsets, (measures, rings), &runs)?,
        runs: &runs,
    };
    let mut slits = strips.slits();
    slits.extend(rowed.slits);
    slits.extend(crossing::along(&strips));
    let mut passes = vec![rowed.way];
    strips.passes(&mut passes);
    Ok(Laid {
        rings,
        rows: rowed.count,
        row: rowed.wide,
        slits,
        passes,
    })
}

/// The outline of a region without islands.
fn outline(region: &Region) -> Result<Vec<Piece>, Why> {
    match region.loops() {
        [outline] => Ok(outline.iter().map(|edge| edge.piece).collect()),
        [_, island, ..] => {
            let at = island.first().map(|edge| edge.piece.from);
            Err(at.map_or(Why::TooLarge, |at| Why::Island { at: [at.x, at.y] }))
        }
        [] => Err(Why::TooLarge),
    }
}

fn has_walls(region: &Region) -> bool {
    region.edges().any(|edge| edge.side == Side::Wall)
}

/// The level that bounds the rows, closed beyond open sides.
fn bounding(
    region: &Region,
    offsets: &mut Offsets,
    (measures, level): (Measures, f64),
) -> Result<Vec<Piece>, Why> {
    if !has_walls(region) {
        return Ok(strips::beyond_all_sides(region, measures.reach));
    }
    let closed = offsets.closed_level(level).map_err(without_level)?;
    let mut loops = closed.into_iter().filter(|way| way.kind == Kind::Loop);
    let first = loops.next().ok_or(Why::Narrow { level })?;
    let other = loops.next().and_then(|other| Some(other.pieces.first()?.from));
    match other {
        Some(at) => Err(Why::Parted { at: [at.x, at.y] }),
        None => Ok(first.pieces),
    }
}

/// The ways of a level from open side to open side.
fn runs(region: &Region, offsets: &mut Offsets, level: f64) -> Result<Vec<Vec<Piece>>, Why> {
    if !has_walls(region) {
        return Ok(Vec::new());
    }
    let ways = offsets.level(level).map_err(without_level)?;
    let runs = ways.into_iter().filter(|way| way.kind == Kind::Run);
    Ok(runs.map(|way| way.pieces).collect())
}

/// The levels on which the disc enters the corners of these ways.
fn inner_levels(
    region: &Region,
    offsets: &mut Offsets,
    (measures, rings): (Measures, u32),
    outer: &[Vec<Piece>],
) -> Result<Vec<Inner>, Why> {
    let wide = f64::from(rings) * measures.step;
    let of = inner::levels(rings, outer);
    let levels = (1..=of).map(|stage| {
        let aside = wide * inner::share([stage, of]);
        let runs = runs(region, offsets, measures.level(0) + aside)?;
        Ok(Inner::of([stage, of], aside, runs, rings))
    });
    levels.collect()
}

fn without_level(fault: OffsetFault) -> Why {
    match fault {
        OffsetFault::Broken(at) => Why::Broken { at: [at.x, at.y] },
        OffsetFault::NoWalls | OffsetFault::Distance | OffsetFault::Dense => Why::TooLarge,
    }
}
