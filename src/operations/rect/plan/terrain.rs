//! What stands while strips are taken out one by one: straight pieces with walls between them.
//!
//! A whole stock and what strips leave are level pieces; V-cuts of an operation before leave sloped ones. A pass with a lead leaves
//! an arc; here it counts as the highest place of that arc over the strip.

use super::blades::TOUCH;
use vcutc_geometry::curve::Point2;
use vcutc_simulation::surface::Side;

/// A surface over the width of the stock.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Terrain {
    /// From left to right, each up to the next one's start; at least one, the first one starts at 0.
    pieces: Vec<Segment>,
    width: f64,
}

/// A straight piece of the surface, up to where the next one begins.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Segment {
    from: f64,
    /// Height where it begins and where it ends.
    heights: [f64; 2],
}

/// A part of such a piece, with where it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Clipped {
    from: Point2,
    to: Point2,
}

impl Terrain {
    /// What these corners are, from left to right over all of a width; two at one place are a wall.
    pub(crate) fn of(corners: &[Point2], width: f64) -> Self {
        let pieces = corners.windows(2).filter_map(|pair| match pair {
            [from, to] if to.x > from.x => Some(Segment {
                from: from.x,
                heights: [from.z, to.z],
            }),
            _ => None,
        });
        Self {
            pieces: pieces.collect(),
            width,
        }
    }

    /// The highest place over a range; none where the range is outside. Pieces that reach into it by less than [`TOUCH`] do not
    /// count.
    pub(crate) fn highest(&self, from: f64, to: f64) -> Option<f64> {
        let (from, to) = (from.max(0.0), to.min(self.width));
        if to - from <= TOUCH {
            return None;
        }
        let first = self.pieces.partition_point(|piece| piece.from <= from + TOUCH);
        let last = self.pieces.partition_point(|piece| piece.from < to - TOUCH);
        let within = first.saturating_sub(1)..last;
        let clipped = within.filter_map(|index| self.clipped(index, from, to));
        clipped.map(|part| part.from.z.max(part.to.z)).reduce(f64::max)
    }

    /// Whether it is one level piece.
    pub(crate) fn is_level(&self) -> bool {
        self.pieces.len() == 1 && self.clipped(0, 0.0, self.width).is_some_and(Clipped::is_level)
    }

    /// The area that stands above a height over a range, in mm2.
    pub(crate) fn area_above(&self, from: f64, to: f64, height: f64) -> f64 {
        let (from, to) = (from.max(0.0), to.min(self.width));
        let parts = (0..self.pieces.len()).filter_map(|index| self.clipped(index, from, to));
        parts.map(|part| part.area_above(height)).sum()
    }

    /// The height just beside a place; none where the stock ends.
    pub(crate) fn beside(&self, x: f64, side: Side) -> Option<f64> {
        match side {
            Side::Left => self.highest(x - 2.0 * TOUCH, x),
            Side::Right => self.highest(x, x + 2.0 * TOUCH),
        }
    }

    /// The nearest place beside another one, at most so far away, from which on nothing stands higher than that; the side of the
    /// stock where it is nearer.
    pub(crate) fn falls_beside(&self, x: f64, side: Side, reach: f64, height: f64) -> Option<f64> {
        let (from, to) = match side {
            Side::Left => (x - reach, x),
            Side::Right => (x, x + reach),
        };
        let parts =
            (0..self.pieces.len()).filter_map(|index| self.clipped(index, from.max(0.0), to.min(self.width)));
        let is_low = |part: &Clipped| part.from.z.max(part.to.z) <= height;
        let low = parts.filter(is_low).map(|part| [part.from.x, part.to.x]);
        match side {
            Side::Left if from <= 0.0 => low.map(|[_, to]| to).chain([0.0]).reduce(f64::max),
            Side::Left => low.map(|[_, to]| to).reduce(f64::max),
            Side::Right if to >= self.width => low.map(|[from, _]| from).chain([self.width]).reduce(f64::min),
            Side::Right => low.map(|[from, _]| from).reduce(f64::min),
        }
    }

    /// Takes away what stands higher than that over a range.
    pub(crate) fn lower(&mut self, from: f64, to: f64, height: f64) {
        let (from, to) = (from.max(0.0), to.min(self.width));
        if to - from <= TOUCH {
            return;
        }
        let reaches = self.pieces.partition_point(|piece| piece.from <= from + TOUCH);
        let first = reaches.saturating_sub(1);
        let last = self.pieces.partition_point(|piece| piece.from < to - TOUCH);
        let mut parts: Vec<Clipped> = Vec::new();
        for index in first..last {
            let Some(piece) = self.clipped(index, 0.0, self.width) else {
                continue;
            };
            let (mut start, mut end) = (piece.from.x, piece.to.x);
            if start < from - TOUCH {
                parts.extend(self.clipped(index, 0.0, from));
                start = from;
            }
            let mut rest = None;
            if end > to + TOUCH {
                rest = self.clipped(index, to, self.width);
                end = to;
            }
            if let Some(within) = self.clipped(index, start, end) {
                within.below(height, &mut parts);
            }
            parts.extend(rest);
        }
        // With its neighbours, so that level pieces of one height are one.
        let around = first.saturating_sub(1)..self.pieces.len().min(last + 1);
        let whole = |index| self.clipped(index, 0.0, self.width);
        let joined: Vec<Clipped> = (around.start..first)
            .filter_map(whole)
            .chain(parts)
            .chain((last..around.end).filter_map(whole))
            .collect();
        self.pieces.splice(around, pieces(&joined));
    }

    /// Its corners from left to right, over all of the width or within a range; walls are two at one x.
    pub(crate) fn corners(&self, from: f64, to: f64) -> Vec<Point2> {
        let parts = (0..self.pieces.len()).filter_map(|index| self.clipped(index, from, to));
        parts.flat_map(|part| [part.from, part.to]).collect()
    }

    /// A piece within a range; none of what has no length there.
    fn clipped(&self, index: usize, from: f64, to: f64) -> Option<Clipped> {
        let piece = self.pieces.get(index)?;
        let end = self.pieces.get(index + 1).map_or(self.width, |next| next.from);
        let whole = Clipped {
            from: Point2::new(piece.from, piece.heights[0]),
            to: Point2::new(end, piece.heights[1]),
        };
        let part = Clipped {
            from: if from > piece.from {
                whole.at(from)
            } else {
                whole.from
            },
            to: if to < end { whole.at(to) } else { whole.to },
        };
        (part.from.x < part.to.x).then_some(part)
    }
}

impl Clipped {
    fn at(self, x: f64) -> Point2 {
        let share = (x - self.from.x) / (self.to.x - self.from.x);
        Point2::new(x, self.from.z + share * (self.to.z - self.from.z))
    }

    const fn is_level(self) -> bool {
        self.from.z.to_bits() == self.to.z.to_bits()
    }

    fn goes_on_as(self, next: Self) -> bool {
        self.is_level() && next.is_level() && self.to.z.to_bits() == next.from.z.to_bits()
    }

    /// Where it passes a height that lies between those of its ends.
    fn crossing(self, height: f64) -> f64 {
        let share = (height - self.from.z) / (self.to.z - self.from.z);
        self.from.x + share * (self.to.x - self.from.x)
    }

    fn area_above(self, height: f64) -> f64 {
        let [from, to] = [self.from.z, self.to.z].map(|z| z - height);
        let length = self.to.x - self.from.x;
        match [from > 0.0, to > 0.0] {
            [false, false] => 0.0,
            [true, true] => length * f64::midpoint(from, to),
            // A triangle up to where it passes the height.
            [true, false] => length * from * from / (from - to) / 2.0,
            [false, true] => length * to * to / (to - from) / 2.0,
        }
    }

    /// Adds its part up to a height, and that height where it stands above.
    fn below(self, height: f64, out: &mut Vec<Self>) {
        let over = [self.from.z > height, self.to.z > height];
        let level = |from: f64, to: f64| Self {
            from: Point2::new(from, height),
            to: Point2::new(to, height),
        };
        let cross = self.crossing(height);
        let is_within = cross > self.from.x && cross < self.to.x;
        match over {
            [false, false] => out.push(self),
            [true, false] if is_within => {
                out.push(level(self.from.x, cross));
                out.push(Self {
                    from: Point2::new(cross, height),
                    ..self
                });
            }
            [false, true] if is_within => {
                out.push(Self {
                    to: Point2::new(cross, height),
                    ..self
                });
                out.push(level(cross, self.to.x));
            }
            [true, _] | [_, true] => out.push(level(self.from.x, self.to.x)),
        }
    }
}

/// Parts that follow each other as pieces, level ones of one height as one.
fn pieces(parts: &[Clipped]) -> Vec<Segment> {
    let runs = parts.chunk_by(|one, next| one.goes_on_as(*next));
    let joined = runs.filter_map(|run| {
        Some(Segment {
            from: run.first()?.from.x,
            heights: [run.first()?.from.z, run.last()?.to.z],
        })
    });
    joined.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn flat(width: f64, height: f64) -> Terrain {
        Terrain::of(&[Point2::new(0.0, height), Point2::new(width, height)], width)
    }

    proptest! {
        /// Against a row of cells a millimetre wide.
        #[test]
        fn steps_are_what_cells_are(cuts in prop::collection::vec((0_usize..40, 1_usize..20, 1_u32..9), 1..30)) {
            let mut terrain = flat(50.0, 10.0);
            let mut cells = [10.0; 50];
            for (from, width, depth) in cuts {
                let to = (from + width).min(50);
                let highest = cells[from..to].iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let height = highest - f64::from(depth) / 4.0;
                for cell in &mut cells[from..to] {
                    *cell = cell.min(height);
                }
                terrain.lower(from as f64, to as f64, height);
                for x in 0..50 {
                    prop_assert_eq!(terrain.highest(x as f64, x as f64 + 1.0), Some(cells[x]));
                    let left = x.checked_sub(1).map(|x| cells[x]);
                    prop_assert_eq!(terrain.beside(x as f64, Side::Left), left);
                    prop_assert_eq!(terrain.beside(x as f64, Side::Right), Some(cells[x]));
                }
                let area: f64 = cells[from..to].iter().map(|cell| (cell - 7.5).max(0.0)).sum();
                prop_assert!((terrain.area_above(from as f64, to as f64, 7.5) - area).abs() < 1e-9);
                let wide = cells[from..to].iter().copied().fold(f64::NEG_INFINITY, f64::max);
                prop_assert_eq!(terrain.highest(from as f64, to as f64), Some(wide));
                let walls = cells.windows(2).filter(|pair| pair[0] != pair[1]).count();
                prop_assert_eq!(terrain.corners(0.0, 50.0).len(), 2 + 2 * walls);
            }
        }

        /// Slopes and walls, against the surface at many places.
        #[test]
        fn slopes_are_cut_where_they_stand_higher(
            heights in prop::collection::vec((0.0..20.0_f64, 0.0..20.0_f64), 10),
            cuts in prop::collection::vec((0.0..100.0_f64, 1.0..60.0_f64, 0.0..20.0_f64), 1..12),
            range in (0.0..59.0_f64, 1.0..40.0_f64),
        ) {
            let corners: Vec<Point2> = (0_u32..)
                .zip(&heights)
                .flat_map(|(i, &(left, right))| {
                    let from = f64::from(10 * i);
                    [Point2::new(from, left), Point2::new(from + 10.0, right)]
                })
                .collect();
            let mut terrain = Terrain::of(&corners, 100.0);
            for &(from, width, height) in &cuts {
                terrain.lower(from, from + width, height);
            }
            let places: Vec<f64> = (0..10_000).map(|i| 0.005 + f64::from(i) / 100.0).collect();
            let height = |x: f64| {
                let i = (x / 10.0) as usize;
                let (left, right) = heights[i];
                let stands = left + (x / 10.0 - i as f64) * (right - left);
                let over = cuts.iter().filter(|(from, width, _)| (*from..*from + *width).contains(&x));
                over.fold(stands, |stands, (_, _, height)| stands.min(*height))
            };
            let [from, to] = [range.0, range.0 + range.1];
            let within = places.iter().copied().filter(|x| (from..to).contains(x));
            let ends = [from + 2.0 * TOUCH, to - 2.0 * TOUCH];
            let sampled = within.chain(ends).map(height).fold(f64::NEG_INFINITY, f64::max);
            let highest = terrain.highest(from, to).unwrap();
            let above = places.iter().filter(|x| (range.0..range.0 + range.1).contains(x));
            let area: f64 = above.map(|&x| (height(x) - 8.0).max(0.0) * 0.01).sum();
            prop_assert!((terrain.area_above(from, to, 8.0) - area).abs() < 0.5, "{}", area);
            // Slopes are at most 2, and places a hundredth apart.
            prop_assert!(highest >= sampled - 1e-9 && highest <= sampled + 0.021, "{} {}", highest, sampled);
            for x in places {
                let here = terrain.highest(x - 1e-3, x + 1e-3).unwrap();
                let beside = [x - 1e-3, x, x + 1e-3].map(height);
                prop_assert!(beside.iter().any(|height| (here - height).abs() < 5e-3), "{} {:?}", here, beside);
            }
        }
    }
}
