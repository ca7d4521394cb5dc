//! Where polylines along y that stand for curves have their knots, the same for all of them.
//!
//! Heights, evenly spaced, are the control points of a curve: of a quadratic spline, whose slope goes on evenly from one middle between two
//! of them to the next. A knot is set before any of the curves turns by more than a blade may turn there, and before a chord leaves any of
//! them by more than is allowed: a curve that turns by `a` over a length `l` lies off its chord by no more than `a l / 4`.

use vcutc_geometry::spine::Spine;

/// The share of the largest bend that a way may turn by from knot to knot.
const TURN: f64 = 0.97 * Spine::LARGEST_BEND;

/// Rounded to the grid, two knots so far apart, in mm, bend by one rad more, and farther ones by as much less.
const ROUNDED: f64 = 0.0022;

/// Knots are no nearer to each other than this, in mm.
pub(crate) const NEAREST: f64 = 0.5;

/// Within an interval of heights, curves are looked at in so many places at most.
const MOST_STEPS: f64 = 1000.0;

/// What is asked of knots.
#[derive(Clone, Copy)]
pub(crate) struct Rule {
    /// What a turn is measured by: of a slope.
    pub(crate) turn: fn(f64) -> f64,
    /// How far chords may leave curves, in mm.
    pub(crate) off: f64,
    /// How many knots there are at most.
    pub(crate) most: usize,
}

/// A knot of all curves.
pub(crate) struct Place {
    pub(crate) y: f64,
    /// The height of each curve.
    pub(crate) heights: Vec<f64>,
}

/// The knots of curves over a depth, from the first height of each to its last. None where there are too many.
pub(crate) fn knots(curves: &[Vec<f64>], depth: f64, rule: Rule) -> Option<Vec<Place>> {
    let count = curves.first()?.len();
    let apart = depth / (count - 1) as f64;
    let mut walk = Walk {
        knots: vec![Place {
            y: 0.0,
            heights: curves.iter().filter_map(|curve| curve.first().copied()).collect(),
        }],
        turns: curves
            .iter()
            .map(|curve| {
                let first = curve.first().zip(curve.get(1));
                (rule.turn)(first.map_or(0.0, |(low, high)| (high - low) / apart))
            })
            .collect(),
        turned: vec![0.0; curves.len()],
        rule,
    };
    let mut pieces = Vec::with_capacity(curves.len());
    for number in 0..count.saturating_sub(2) {
        pieces.clear();
        pieces.extend(
            curves
                .iter()
                .filter_map(|curve| Some(Piece::of(curve.get(number..number + 3)?, apart))),
        );
        let start = apart * (number as f64 + 0.5);
        let turn = pieces
            .iter()
            .map(|piece| ((rule.turn)(piece.to) - (rule.turn)(piece.from)).abs());
        let turn = turn.fold(0.0, f64::max);
        let steps = (turn / (TURN / 8.0)).ceil().clamp(1.0, MOST_STEPS) as u32;
        for step in 1..=steps {
            let along = apart * f64::from(step) / f64::from(steps);
            walk.on(start + along, along, apart, &pieces);
            if walk.knots.len() > rule.most {
                return None;
            }
        }
    }
    if let Some(knot) = walk.knots.last()
        && depth - knot.y < NEAREST
        && walk.knots.len() > 1
    {
        walk.knots.pop();
    }
    walk.knots.push(Place {
        y: depth,
        heights: curves.iter().filter_map(|curve| curve.last().copied()).collect(),
    });
    (walk.knots.len() <= rule.most).then_some(walk.knots)
}

/// A curve between two middles of its heights.
struct Piece {
    /// Its height at the first of them.
    rise: f64,
    /// Its slope there, and at the second one.
    from: f64,
    to: f64,
}

impl Piece {
    fn of(three: &[f64], apart: f64) -> Self {
        let slope = |low: f64, high: f64| (high - low) / apart;
        match *three {
            [before, here, after] => Self {
                rise: f64::midpoint(before, here),
                from: slope(before, here),
                to: slope(here, after),
            },
            _ => Self {
                rise: 0.0,
                from: 0.0,
                to: 0.0,
            },
        }
    }

    fn slope(&self, along: f64, apart: f64) -> f64 {
        self.from + (self.to - self.from) * along / apart
    }
}

/// Curves on their way from knot to knot.
struct Walk {
    knots: Vec<Place>,
    /// How each curve is turned.
    turns: Vec<f64>,
    /// By how much each turned since the last knot.
    turned: Vec<f64>,
    rule: Rule,
}

impl Walk {
    fn on(&mut self, y: f64, along: f64, apart: f64, pieces: &[Piece]) {
        let mut most = 0.0_f64;
        for ((piece, before), turned) in pieces.iter().zip(&mut self.turns).zip(&mut self.turned) {
            let turn = (self.rule.turn)(piece.slope(along, apart));
            *turned += (turn - *before).abs();
            *before = turn;
            most = most.max(*turned);
        }
        let length = self.knots.last().map_or(0.0, |last| y - last.y);
        let turns = most > 0.8 * (TURN - ROUNDED / length.max(NEAREST));
        let leaves = most * length / 4.0 > self.rule.off;
        if (turns || leaves) && length >= NEAREST {
            let heights = pieces
                .iter()
                .map(|piece| piece.rise + f64::midpoint(piece.from, piece.slope(along, apart)) * along);
            self.knots.push(Place {
                y,
                heights: heights.collect(),
            });
            self.turned.fill(0.0);
        }
    }
}
