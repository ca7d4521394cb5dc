//! What the Vs of columns leave over a part of a plane: the least of many planes.
//!
//! Within a slab a V is a plane on either side of its tip, and so is the top of the stock. Over a polygon, one V after the other takes off
//! the places where it is lower than what was there; what remains are polygons with a plane each, and over a triangle of the part the height
//! between is linear. A polygon that lies in several slabs is divided at the knots. That is exact up to rounding.

use super::{Heights, above};
use crate::region::{Half, Region, SLACK, width, within};
use crate::visible::Plane;
use vcutc_geometry::columns::{Column, slab};
use vcutc_geometry::curve::Point2;

/// The Vs of columns in a stock.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ruled {
    /// From left to right.
    vees: Vec<Column>,
    /// Where slabs end, in mm.
    knots: Vec<f64>,
    /// The height of the stock, in mm.
    top: f64,
    /// Below any tip.
    lowest: f64,
    /// Flatter than any flank.
    flattest: f64,
}

/// A plane over the plan: its height at the origin, and its rise over x and over y.
type Over = [f64; 3];

const fn at([start, over_x, over_y]: Over, [x, y]: [f64; 2]) -> f64 {
    start + over_x * x + over_y * y
}

impl Ruled {
    pub(super) fn new(mut vees: Vec<Column>, knots: Vec<f64>, top: f64) -> Self {
        vees.sort_by(|one, other| one.x.total_cmp(&other.x));
        Self {
            lowest: vees.iter().map(Column::lowest).fold(f64::INFINITY, f64::min),
            flattest: vees.iter().map(|vee| vee.flank).fold(f64::INFINITY, f64::min),
            vees,
            knots,
            top,
        }
    }

    /// Its height over a place.
    pub(super) fn height(&self, place: [f64; 2]) -> f64 {
        let [x, _] = place;
        let after = self.vees.partition_point(|vee| vee.x < x);
        let (left, right) = self.vees.split_at(after);
        let left: &mut dyn Iterator<Item = &Column> = &mut left.iter().rev();
        let right: &mut dyn Iterator<Item = &Column> = &mut right.iter();
        let mut height = self.top;
        for side in [left, right] {
            for vee in side {
                // No tip farther away counts.
                if self.lowest + self.flattest * (vee.x - x).abs() >= height {
                    break;
                }
                height = height.min(vee.height(place, &self.knots));
            }
        }
        height
    }

    /// Its section at a y, from x = 0 to a width: a polyline with a corner at each tip and between two.
    pub(super) fn section(&self, y: f64, width: f64) -> Vec<Point2> {
        let at_tip = |vee: &Column| Point2::new(vee.x, vee.height([vee.x, y], &self.knots));
        let is_seen = |tip: &Point2| tip.z <= self.height([tip.x, y]);
        let tips = self.vees.iter().map(at_tip).filter(is_seen);
        let mut points = vec![Point2::new(0.0, self.height([0.0, y]))];
        for tip in tips {
            if let Some(&last) = points.last() {
                points.extend(self.between(last, tip));
            }
            points.push(tip);
        }
        let end = Point2::new(width, self.height([width, y]));
        if let Some(&last) = points.last() {
            points.extend(self.between(last, end));
        }
        points.push(end);
        points
    }

    /// Where it turns between two places of a section between which no tip lies: where flanks meet, or the top of the stock.
    fn between(&self, from: Point2, to: Point2) -> Vec<Point2> {
        let flank = self.flattest;
        let apart = to.x - from.x;
        let high = (from.z + to.z + flank * apart) / 2.0;
        let on_way = |z: f64| [from.x + (z - from.z) / flank, to.x - (z - to.z) / flank];
        let [left, right] = on_way(high.min(self.top));
        let is_inside = |x: f64| from.x < x && x < to.x;
        let corners = if high > self.top {
            vec![Point2::new(left, self.top), Point2::new(right, self.top)]
        } else {
            vec![Point2::new(left, high)]
        };
        corners.into_iter().filter(|corner| is_inside(corner.x)).collect()
    }

    /// What of a region lies under each plane of it, with its heights above a plane.
    pub(crate) fn above(&self, region: &[[f64; 2]], plane: Plane) -> Vec<Heights> {
        let [low, high] = range(region, 1);
        let (first, last) = (slab(&self.knots, low), slab(&self.knots, high));
        if first == last {
            return self.above_in(first, region, plane);
        }
        let mut pieces = Vec::new();
        for number in first..=last {
            let Some(&[from, to]) = self.knots.get(number..=number + 1) else {
                continue;
            };
            let mut piece: Region = region.to_vec();
            if number > first {
                piece = within(&piece, Half::new([0.0, -1.0], -from));
            }
            if number < last {
                piece = within(&piece, Half::new([0.0, 1.0], to));
            }
            if piece.len() >= 3 && width(&piece) > SLACK {
                pieces.extend(self.above_in(number, &piece, plane));
            }
        }
        pieces
    }

    /// The same of a region within a slab.
    fn above_in(&self, slab: usize, region: &[[f64; 2]], plane: Plane) -> Vec<Heights> {
        let mut pieces: Vec<(Vec<[f64; 2]>, Over)> = vec![(region.to_vec(), [self.top, 0.0, 0.0])];
        for (side, lower) in self.planes(slab, region) {
            let before = core::mem::take(&mut pieces);
            for (piece, higher) in before {
                take_off(&piece, higher, (side, lower), &mut pieces);
            }
        }
        let over = |(piece, top): (Vec<[f64; 2]>, Over)| {
            piece
                .into_iter()
                .map(|place| (place, at(top, place) - plane.at(place)))
                .collect()
        };
        pieces.into_iter().map(over).filter(super::has_area).collect()
    }

    /// The planes that may count over a region in a slab, each with the side of its tip on which it holds: x, and 1 to the right of it.
    fn planes(&self, slab: usize, region: &[[f64; 2]]) -> Vec<([f64; 2], Over)> {
        let [from, to] = range(region, 0);
        // Tips farther away lie above the stock there.
        let away = ((self.top - self.lowest) / self.flattest).max(0.0);
        let first = self.vees.partition_point(|vee| vee.x < from - away);
        let last = self.vees.partition_point(|vee| vee.x <= to + away);
        let near = self.vees.get(first..last).unwrap_or_default();
        let lines = near
            .iter()
            .filter_map(|vee| Some((vee, Line::of(vee, &self.knots, slab)?)));
        let lines: Vec<(&Column, Line)> = lines.collect();
        let over = |vee: &Column, line: Line| {
            let heights = region
                .iter()
                .map(|&[x, y]| line.at(y) + vee.flank * (x - vee.x).abs());
            heights.fold(f64::NEG_INFINITY, f64::max)
        };
        // No lower than that is any place but one next to a tip, which is below its corners.
        let least = |vee: &Column, line: Line| {
            let aside = vee.flank * (vee.x.clamp(from, to) - vee.x).abs();
            let ends = region.iter().map(|&[_, y]| line.at(y));
            ends.fold(f64::INFINITY, f64::min) + aside
        };
        let most = lines.iter().map(|&(vee, line)| over(vee, line));
        let enough = most.fold(self.top, f64::min);
        let counting = lines.iter().filter(|&&(vee, line)| least(vee, line) < enough);
        counting
            .flat_map(|(vee, line)| {
                [-1.0, 1.0].map(|side: f64| {
                    let rise = side * vee.flank;
                    ([vee.x, side], [line.start - rise * vee.x, rise, line.slope])
                })
            })
            .collect()
    }
}

/// The way of a tip in a slab: its height at y = 0, and its slope.
#[derive(Clone, Copy)]
struct Line {
    start: f64,
    slope: f64,
}

impl Line {
    fn of(vee: &Column, knots: &[f64], slab: usize) -> Option<Self> {
        match (knots.get(slab..=slab + 1)?, vee.tips.get(slab..=slab + 1)?) {
            (&[front, back], &[low, high]) => {
                let slope = (high - low) / (back - front);
                Some(Self {
                    start: low - slope * front,
                    slope,
                })
            }
            (_, _) => None,
        }
    }

    const fn at(self, y: f64) -> f64 {
        self.start + self.slope * y
    }
}

/// From where to where a region reaches along x (0) or y (1).
fn range(region: &[[f64; 2]], axis: usize) -> [f64; 2] {
    let places = region.iter().map(|place| place[axis]);
    places.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], place| {
        [least.min(place), most.max(place)]
    })
}

/// Divides a piece by whether a plane that holds on a side of a tip is lower than its own.
fn take_off(
    piece: &[[f64; 2]],
    higher: Over,
    ([tip, side], lower): ([f64; 2], Over),
    out: &mut Vec<(Vec<[f64; 2]>, Over)>,
) {
    let places = |corners: Heights| corners.into_iter().map(|(place, _)| place).collect::<Vec<_>>();
    let cut = |piece: &[[f64; 2]], height: &dyn Fn([f64; 2]) -> f64| {
        let corners: Heights = piece.iter().map(|&place| (place, height(place))).collect();
        places(above(&corners))
    };
    let beside = |place: [f64; 2]| side * (place[0] - tip);
    let gain = |place: [f64; 2]| at(higher, place) - at(lower, place);
    let is_outside = |height: &dyn Fn([f64; 2]) -> f64| piece.iter().all(|&place| height(place) <= 0.0);
    if is_outside(&beside) || is_outside(&gain) {
        out.push((piece.to_vec(), higher));
        return;
    }
    let near = cut(piece, &beside);
    let parts = [
        (cut(piece, &|place| -beside(place)), higher),
        (cut(&near, &|place| -gain(place)), higher),
        (cut(&near, &gain), lower),
    ];
    // What only touches a border belongs to what lies beside it.
    out.extend(
        parts
            .into_iter()
            .filter(|(part, _)| part.len() >= 3 && width(part) > SLACK),
    );
}

#[cfg(test)]
mod tests;
