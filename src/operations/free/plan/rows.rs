//! Rows along an open side: their slits, and the way of the disc from row to row.

use super::crossing;
use super::measures::Measures;
use super::strips::upright;
use crate::refused::Why;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::rows::Front;
use vcutc_region::slits::{Begin, Slit};

/// Ground that is freed in rows.
pub(super) struct Field<'l> {
    pub(super) front: Front,
    /// Bounds where the centre of the disc may be.
    pub(super) centres: &'l [Piece],
    /// How far from walls the rows begin, in mm.
    pub(super) level: f64,
    /// Bounds what the rows free.
    pub(super) ground: &'l [Piece],
    /// How far the region goes in, in mm.
    pub(super) deepest: f64,
    /// How far the centres end before the ground, in mm.
    pub(super) to_corner: f64,
    pub(super) measures: Measures,
    pub(super) stock: Stock,
}

/// Rows of a layer.
pub(super) struct Rowed {
    pub(super) count: usize,
    pub(super) wide: f64,
    pub(super) slits: Vec<Slit>,
    /// The way of the disc: it begins and ends beside the stock.
    pub(super) way: Pass,
}

/// Most rows.
const MOST: f64 = 2000.0;

/// How much more air the shank keeps, in parts of half the thickness of the straight blade: the open side has no slit along it, so squares
/// of the proof lie on both sides of it.
const SLACK: f64 = 0.7;

/// At how many places between two rows room is looked for.
const LOOKED_AT: u32 = 12;

/// At how many places of a side it is looked at how far walls open.
const SAMPLES: u32 = 8;

/// How far a way into the next row keeps from where the centre may not be, in mm, and how often it is moved aside by so much.
const ASIDE: f64 = 0.25;
const TRIALS: u32 = 60;

/// Where a row of the disc begins and ends along the side, and its depth.
#[derive(Clone, Copy, Debug)]
struct Row {
    depth: f64,
    ends: [f64; 2],
}

impl Field<'_> {
    pub(super) fn rows(&self) -> Result<Rowed, Why> {
        let Measures { radius, shank, .. } = self.measures;
        let air = SLACK * self.measures.half;
        let most = |over: f64| (radius - shank - over - air).min(self.measures.widest);
        let is_wide = |over: &f64| most(*over) >= 4.0 * self.measures.half;
        // Where walls open too far for that, rows are laid as between square ones; whether the disc finds its way is looked at later.
        let wider = self.over(self.widening());
        let wider = wider.filter(is_wide);
        let Some(over) = wider.or_else(|| self.over(0.0).filter(is_wide)) else {
            return Err(Why::Shank);
        };
        let most = most(over);
        // Where the far side is open too, no slit lies along it either.
        let deep = self.front.deepest(self.ground).min(self.deepest + air);
        let count = libm::ceil(deep / most);
        if !(1.0..=MOST).contains(&count) {
            return Err(Why::TooLarge);
        }
        let wide = deep / count;
        // The casts saturate; there are a few thousand at most.
        let count = count as u32;
        let slits = (1..count).map(|row| f64::from(row) * wide);
        let slits: Vec<Row> = slits
            .map(|depth| self.row(self.ground, depth))
            .collect::<Result<_, _>>()?;
        let rows = (1..=count).map(|row| f64::from(row) * wide + over - radius);
        let rows: Vec<Row> = rows
            .map(|depth| self.row(self.centres, depth))
            .collect::<Result<_, _>>()?;
        let mut cut: Vec<Slit> = slits
            .iter()
            .map(|row| {
                let [from, to] = row.ends.map(|way| self.front.place(way, row.depth));
                upright(vec![Piece::line(from, to)], Begin::Within)
            })
            .collect();
        cut.extend(crossing::over(&self.crossings(&slits)));
        Ok(Rowed {
            count: rows.len(),
            wide,
            slits: cut,
            way: self.way(&rows)?,
        })
    }

    /// How far the rim has to run on beyond the slit of a row, so that at the end of the row it reaches the corner between this slit and the
    /// one along the walls, which open farther in by an angle of this sine; none where the centre has no room for that.
    fn over(&self, widening: f64) -> Option<f64> {
        let (radius, far) = (self.measures.radius, self.to_corner);
        let beside = libm::sqrt((radius * radius - far * far).max(0.0));
        let square = libm::sqrt((1.0 - widening * widening).max(0.0));
        let over = (radius - square * beside + widening * far).max(self.measures.over);
        (over <= radius - far).then_some(over)
    }

    /// The sine of the angle by which the ground of the rows opens most farther in.
    fn widening(&self) -> f64 {
        let sides = self.ground.iter().flat_map(|side| {
            let shares = (0..=SAMPLES).map(|sample| f64::from(sample) / f64::from(SAMPLES));
            let inside = shares.filter(|share| self.front.depth(side.at(*share)) > 0.0);
            inside.map(|share| self.front.inward(side.direction(share).left()))
        });
        sides.fold(0.0, f64::max).min(1.0)
    }

    /// A row at a depth, in one piece.
    fn row(&self, bounds: &[Piece], depth: f64) -> Result<Row, Why> {
        match self.front.row(bounds, depth).as_slice() {
            [ends] => Ok(Row { depth, ends: *ends }),
            [] => Err(Why::Narrow { level: self.level }),
            [first, ..] => {
                let at = self.front.place(first[1], depth);
                Err(Why::Parted { at: [at.x, at.y] })
            }
        }
    }

    /// Where rows are longer than a chip may be: lines across them.
    fn crossings(&self, slits: &[Row]) -> Vec<Piece> {
        let mut before = -self.measures.half;
        let mut lines = Vec::new();
        let widths = slits.iter().map(|row| (row.depth, row.ends));
        let last = slits.last().map(|row| (f64::INFINITY, row.ends));
        for (depth, [from, to]) in widths.chain(last) {
            let parts = libm::ceil((to - from) / self.measures.chip).clamp(1.0, MOST) as u32;
            for part in 1..parts {
                let way = from + (to - from) * f64::from(part) / f64::from(parts);
                let across = self.front.turned().row(self.ground, -way);
                let end = across.first().map_or(before, |ends| ends[1].min(depth));
                if end > before {
                    lines.push(Piece::line(
                        self.front.place(way, before),
                        self.front.place(way, end),
                    ));
                }
            }
            before = depth;
        }
        lines
    }

    /// From beside the stock over all rows, and out again.
    fn way(&self, rows: &[Row]) -> Result<Pass, Why> {
        let out = -self.measures.reach;
        let mut places: Vec<Place> = Vec::new();
        let mut depth = out;
        let mut end = 0;
        for row in rows {
            let aside = self.step_in(depth, row, end)?;
            // Back to where there is room to step in, to the end that is nearer, and along the row.
            places.push(self.front.place(aside, depth));
            places.push(self.front.place(aside, row.depth));
            places.push(self.front.place(row.ends[end], row.depth));
            end = 1 - end;
            places.push(self.front.place(row.ends[end], row.depth));
            depth = row.depth;
        }
        let first = places
            .first()
            .copied()
            .unwrap_or_else(|| self.front.place(0.0, out));
        if !self.is_beside_the_stock(first) {
            return Err(Why::Closed);
        }
        self.leave(&mut places, rows, depth);
        let pairs = places.iter().zip(places.iter().skip(1));
        let pieces = pairs.filter(|(from, to)| from.distance(**to) > SHORTEST);
        let mut pieces: Vec<Piece> = pieces.map(|(&from, &to)| Piece::line(from, to)).collect();
        let mut at = first;
        for piece in &mut pieces {
            piece.from = at;
            at = piece.to;
        }
        Ok(Pass {
            level: DEEPEST,
            pieces,
        })
    }

    /// Whether the disc is clear of the stock there.
    fn is_beside_the_stock(&self, at: Place) -> bool {
        let reach = self.measures.radius;
        let [width, depth] = [self.stock.width, self.stock.depth].map(Length::to_mm);
        let is_beyond = |at: f64, long: f64| at <= -reach || at >= long + reach;
        is_beyond(at.x, width) || is_beyond(at.y, depth)
    }

    /// How far along the side there is room to go from one depth to a row, nearest to one end of it.
    fn step_in(&self, from: f64, row: &Row, end: usize) -> Result<f64, Why> {
        let side = if end == 0 { 1.0 } else { -1.0 };
        let mut way = row.ends[end];
        for step in 0..=LOOKED_AT {
            let depth = from + (row.depth - from) * f64::from(step) / f64::from(LOOKED_AT);
            if let [ends] = self.front.row(self.centres, depth).as_slice() {
                way = side * (side * way).max(side * ends[end]);
            }
        }
        for trial in 1..=TRIALS {
            let way = way + side * ASIDE * f64::from(trial);
            let line = Piece::line(self.front.place(way, from), self.front.place(way, row.depth));
            if Front::holds(self.centres, line) {
                return Ok(way);
            }
        }
        let at = self.front.place(way, row.depth);
        Err(Why::Stuck { at: [at.x, at.y] })
    }

    /// Out of the ground: straight, or back as the disc came.
    fn leave(&self, places: &mut Vec<Place>, rows: &[Row], depth: f64) {
        let out = -self.measures.reach;
        let Some(last) = rows.last() else { return };
        let [from, to] = last.ends;
        let tries = (0..=LOOKED_AT).map(|step| from + (to - from) * f64::from(step) / f64::from(LOOKED_AT));
        let free = tries.into_iter().find(|&way| {
            let line = Piece::line(self.front.place(way, depth), self.front.place(way, out));
            Front::holds(self.centres, line)
        });
        match free {
            Some(way) => {
                places.push(self.front.place(way, depth));
                places.push(self.front.place(way, out));
            }
            None => {
                let back: Vec<Place> = places.iter().rev().skip(1).copied().collect();
                places.extend(back);
            }
        }
    }
}

/// Shorter ways are left out, in mm.
const SHORTEST: f64 = 1e-3;

/// Rows lie deeper than all strips along walls.
const DEEPEST: u32 = u32::MAX;
