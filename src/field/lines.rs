//! The zero lines of a field: passes of a tool.
//!
//! They are found on a grid, moved onto the zeros of the field itself, and joined to chains of arcs.

use crate::complex::Complex;
use crate::domain::{Domain, Grid, GridError, Ground};
use crate::field::Field;
use crate::lanes;
use rayon::prelude::*;
use trace::{Chain, Crossing};
use vcutc_region::pass::Pass;
use vcutc_region::place::Place;
use vcutc_region::region::Region;

mod fit;
mod trace;

/// Points of the grid over a step.
const POINTS_OVER_STEP: f64 = 3.0;

/// More than the diagonal of a cell, in pitches.
const CELL: f64 = 1.5;

/// Halvings that find where a line meets an open side.
const HALVINGS: u32 = 40;

/// Why there are no lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinesError {
    /// The grid cannot be made.
    Grid(GridError),
    /// The radius of the tool is not a number above 0.
    Radius,
    /// The points of the grid times the sources of the field are more than this.
    TooMuchWork {
        /// The most.
        most: usize,
    },
}

/// Points of a grid times sources at most: some ten seconds.
const MOST_WORK: usize = 300_000_000;

/// How a line of a field continues at its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Run {
    /// It is closed.
    Closed,
    /// Both of its ends lie on open sides.
    Through,
    /// It ends within the region: fronts of neighbouring sources do not meet there.
    Broken,
}

/// A zero line of a field.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Its way.
    pub pass: Pass,
    /// How it ends.
    pub run: Run,
}

/// The zero lines of a field over a region, as passes of a tool of this radius, in mm. Lines that come
/// nearer to a wall than the radius less half a step are cut there.
///
/// # Errors
/// Where the radius is unsound, or the region has too many steps or the field too many sources.
pub fn lines(region: &Region, field: &Field, radius: f64) -> Result<Vec<Line>, LinesError> {
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(LinesError::Radius);
    }
    let domain = Domain::new(region);
    let step = field.tuning().step;
    let grid = domain.grid(step / POINTS_OVER_STEP).map_err(LinesError::Grid)?;
    // Cells that lines cross may reach that much nearer to walls.
    let nearest = radius - step / 2.0;
    let grounds = domain.grounds(&grid, nearest - CELL * grid.pitch);
    let turn = field.turned_to(radius);
    let values = sampled(field, turn, &grid, &grounds)?;
    let zeros = Zeros { field, turn };
    let traced = trace::trace(&grid, &grounds, &values, |place| zeros.at(place).0);
    let points: Vec<Point> = traced
        .crossings
        .par_iter()
        .map(|crossing| zeros.on_edge(crossing, &grid))
        .collect();
    let cut = Cut {
        domain: &domain,
        zeros: &zeros,
        grid: &grid,
        nearest,
    };
    let chains = traced.chains.iter().flat_map(|chain| cut.parts(chain, &points));
    let chains: Vec<(Vec<Point>, Run)> = chains.collect();
    Ok(chains
        .par_iter()
        .map(|(points, run)| Line {
            pass: Pass {
                level: level(points, &domain, radius, step),
                pieces: fit::pieces(points, &zeros, grid.pitch),
            },
            run: *run,
        })
        .collect())
}

/// The turned field at all points of a grid that are open to lines; zero elsewhere.
pub(crate) fn sampled(
    field: &Field,
    turn: Complex,
    grid: &Grid,
    grounds: &[Ground],
) -> Result<Vec<Complex>, LinesError> {
    if grounds.len().saturating_mul(field.sources().len()) > MOST_WORK {
        return Err(LinesError::TooMuchWork { most: MOST_WORK });
    }
    let rows = grounds.par_chunks(grid.columns).enumerate();
    let values = rows.flat_map_iter(|(row, grounds)| lanes::row(field, turn, grid, row, grounds));
    Ok(values.collect())
}

/// A point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    place: Place,
    /// The gradient of the turned field's real part.
    gradient: Place,
}

/// The zeros of a field's real part, once it is turned.
struct Zeros<'a> {
    field: &'a Field,
    turn: Complex,
}

/// Steps to a zero at most: halvings of a pitch down to all digits.
const MOST_STEPS: u32 = 60;

/// A zero is found by a step below this, in mm: Newton's next one would be of the order of its square.
const LAST_STEP: f64 = 5e-4;

/// Zeros found so close to a point of the grid, in mm, are looked for beyond it.
const CLOSE: f64 = 1e-2;

/// Places on a line found by halves are on an open side within this, in mm.
const FOUND: f64 = 1e-5;

/// Places across the middle of a way at which the sign is looked at, on both sides, and their number over its length.
const REACH: u32 = 160;
const STEPS_OVER_WAY: f64 = 8.0;

impl Zeros<'_> {
    fn at(&self, place: Place) -> (f64, Place) {
        let (value, [by_x, by_y]) = self.field.with_gradient(place);
        let real = |number: Complex| (number * self.turn).re;
        (real(value), Place::new(real(by_x), real(by_y)))
    }

    /// The zero on an edge of the grid between points of both signs: Newton's, or halving where that leads away.
    fn on_edge(&self, crossing: &Crossing, grid: &Grid) -> Point {
        let (from, to) = (crossing.from.place(grid), crossing.to.place(grid));
        let way = to.minus(from);
        let is_rising = crossing.values[1].re >= 0.0;
        let (mut low, mut high) = (0.0, 1.0);
        let mut t = first_guess(crossing.values);
        let mut point = Point {
            place: from.lerp(to, t),
            gradient: way,
        };
        for _ in 0..MOST_STEPS {
            let (value, gradient) = self.at(from.lerp(to, t));
            if (value >= 0.0) == is_rising {
                high = t
            } else {
                low = t
            }
            let next = t - value / gradient.dot(way);
            // Not a number is not between them either.
            let next = if next > low && next < high {
                next
            } else {
                f64::midpoint(low, high)
            };
            let step = (next - t).abs() * grid.pitch;
            t = next;
            point = Point {
                place: from.lerp(to, t),
                gradient,
            };
            if step < LAST_STEP {
                break;
            }
        }
        // The values of a grid are coarse: the zero may lie just beyond a point of it, and the search has ended at that.
        let is_at_end = t * grid.pitch < CLOSE || (1.0 - t) * grid.pitch < CLOSE;
        let found = is_at_end.then(|| self.near(point.place, grid.pitch));
        found.flatten().unwrap_or(point)
    }

    /// The zero next to a place, square to the line; none where it is not as near as `within`, in mm.
    fn near(&self, place: Place, within: f64) -> Option<Point> {
        let mut at = place;
        for _ in 0..8 {
            let (value, gradient) = self.at(at);
            let step = gradient.times(-value / gradient.dot(gradient));
            at = at.plus(step);
            let off = at.distance(place);
            if off.is_nan() || off >= within {
                return None;
            }
            if step.length() < LAST_STEP {
                return Some(Point { place: at, gradient });
            }
        }
        None
    }

    /// The zero on the middle line between two places, the one nearest to them: the tip of a cusp, which no step finds.
    fn across(&self, from: Place, to: Place) -> Option<Point> {
        let way = to.minus(from);
        let middle = from.lerp(to, 0.5);
        let place = |share: f64| middle.plus(way.left().times(share));
        let is_positive = |share: f64| self.at(place(share)).0 >= 0.0;
        let here = is_positive(0.0);
        for count in 1..=REACH {
            for side in [1.0, -1.0] {
                let share = side * f64::from(count) / STEPS_OVER_WAY;
                if is_positive(share) == here {
                    continue;
                }
                let (mut low, mut high) = (share - side / STEPS_OVER_WAY, share);
                for _ in 0..HALVINGS {
                    let middle = f64::midpoint(low, high);
                    if is_positive(middle) == here {
                        low = middle
                    } else {
                        high = middle
                    }
                }
                let (_, gradient) = self.at(place(low));
                return Some(Point {
                    place: place(low),
                    gradient,
                });
            }
        }
        None
    }
}

/// Where between two values of the field its real part is zero: their angles change evenly.
fn first_guess([from, to]: [Complex; 2]) -> f64 {
    let even = from.re / (from.re - to.re);
    let turned = (to * from.conjugate()).angle();
    let missing = core::f64::consts::FRAC_PI_2.copysign(turned * from.re) - from.angle();
    let quarter = core::f64::consts::PI;
    let missing = missing - 2.0 * quarter * libm::round(missing / (2.0 * quarter));
    let guess = missing / turned;
    if guess > 0.0 && guess < 1.0 {
        guess
    } else {
        even.clamp(0.0, 1.0)
    }
}

/// What chains are cut by.
struct Cut<'a> {
    domain: &'a Domain<'a>,
    zeros: &'a Zeros<'a>,
    grid: &'a Grid,
    /// Least distance to walls.
    nearest: f64,
}

/// Where a point of a chain lies.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Lies {
    InRegion,
    NearWall,
    Outside,
}

impl Cut<'_> {
    /// The parts of a chain in the region and off the walls, and how they end.
    fn parts(&self, chain: &Chain, points: &[Point]) -> Vec<(Vec<Point>, Run)> {
        let mut points: Vec<Point> = chain
            .crossings
            .iter()
            .filter_map(|&index| points.get(index).copied())
            .collect();
        let mut lies: Vec<Lies> = points.par_iter().map(|point| self.lies(point.place)).collect();
        if chain.is_closed() {
            let Some(gap) = lies.iter().position(|lies| *lies != Lies::InRegion) else {
                return vec![(points, Run::Closed)];
            };
            // From the gap round to the gap; the first point is there twice.
            points.pop();
            lies.pop();
            points.rotate_left(gap);
            lies.rotate_left(gap);
            points.extend(points.first().copied());
            lies.extend(lies.first().copied());
        }
        let mut parts = Vec::new();
        let mut from = 0;
        for run in lies.chunk_by(|one, other| one == other) {
            let to = from + run.len();
            if run.first() == Some(&Lies::InRegion) {
                parts.extend(self.part(&points, &lies, from, to));
            }
            from = to;
        }
        parts
    }

    /// The points from one number to before another, with those on open sides.
    fn part(&self, points: &[Point], lies: &[Lies], from: usize, to: usize) -> Option<(Vec<Point>, Run)> {
        let inside = points.get(from..to)?;
        let exit = |inside: Option<&Point>, next: Option<usize>| {
            let is_out = lies.get(next?) == Some(&Lies::Outside);
            is_out.then_some((inside?.place, points.get(next?)?.place))
        };
        let first = exit(inside.first(), from.checked_sub(1)).and_then(|way| self.at_open_side(way));
        let last = exit(inside.last(), Some(to)).and_then(|way| self.at_open_side(way));
        let run = if first.is_some() && last.is_some() {
            Run::Through
        } else {
            Run::Broken
        };
        let mut part: Vec<Point> = first.into_iter().collect();
        part.extend(inside);
        part.extend(last);
        (part.len() > 1).then_some((part, run))
    }

    fn lies(&self, place: Place) -> Lies {
        if !self.domain.contains(place) {
            Lies::Outside
        } else if self.domain.distance(place) < self.nearest {
            Lies::NearWall
        } else {
            Lies::InRegion
        }
    }

    /// Where a line comes to an open side between a place in the region and one beyond; none where it comes to a wall.
    fn at_open_side(&self, (inside, outside): (Place, Place)) -> Option<Point> {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if self.domain.contains(inside.lerp(outside, middle)) {
                low = middle
            } else {
                high = middle
            }
        }
        let place = inside.lerp(outside, low);
        let is_open = self.domain.is_by_open_side(place, FOUND);
        let point = || self.zeros.near(place, self.grid.pitch);
        is_open.then(point)?
    }
}

/// How many passes lie between a line and the walls, by its mean distance to them.
fn level(points: &[Point], domain: &Domain, radius: f64, step: f64) -> u32 {
    let sum: f64 = points.iter().map(|point| domain.distance(point.place)).sum();
    let level = (sum / points.len() as f64 - radius) / step;
    // The cast saturates.
    libm::round(level) as u32
}

#[cfg(test)]
mod tests;
