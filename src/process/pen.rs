//! From lines and arcs of the plan to a path in space, as programs state it.
//!
//! All points lie on the grid of programs, and arcs are those through the three points that a program states. So whether one
//! piece goes on into the next is decided on what will be written.

use core::f64::consts::PI;
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Joint;
use vcutc_backend_api::units::Angle;
use vcutc_backend_api::vector::{cross, dot, length, minus, scaled};
use vcutc_backend_api::verify::LARGEST_KINK;
use vcutc_geometry::grid;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// How fast a stretch is gone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// Through the air.
    Travel,
    /// Down into the material, and where much of the rim is in it.
    Plunge,
    /// Beside what is cleared.
    Cut,
}

/// A line or an arc of a path, from where the one before it ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    pub to: Point3,
    /// A point on the way of an arc.
    pub via: Option<Point3>,
    pub pace: Pace,
    pub joint: Joint,
}

/// A path from a place in the air to another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    pub from: Point3,
    pub stretches: Vec<Stretch>,
}

/// Share of the largest kink that goes on without a stop: points are rounded.
const CARE: f64 = 0.98;

/// Shorter stretches have no direction, in mm.
const SHORTEST: f64 = 2e-3;

/// Arcs lower than this over their chord are lines, in mm: a point on their way would lie on it, as rounded.
const FLAT: f64 = 2e-3;

/// Writes stretches one after the other.
#[derive(Clone, Debug)]
pub struct Pen {
    from: Point3,
    at: Point3,
    stretches: Vec<Stretch>,
}

/// A place at a height, on the grid.
fn on_grid(place: Place, z: f64) -> Point3 {
    Point3::new(grid::nearest(place.x), grid::nearest(place.y), grid::up(z))
}

impl Pen {
    /// Begins at a place at a height.
    #[must_use]
    pub fn at(place: Place, z: f64) -> Self {
        let from = on_grid(place, z);
        Self {
            from,
            at: from,
            stretches: Vec::new(),
        }
    }

    /// Straight to a place at a height.
    pub fn line(&mut self, to: Place, z: f64, pace: Pace) {
        self.add(on_grid(to, z), None, pace);
    }

    fn add(&mut self, to: Point3, via: Option<Point3>, pace: Pace) {
        if self.at.distance(to).to_mm() < SHORTEST && via.is_none() {
            return;
        }
        self.stretches.push(Stretch {
            to,
            via,
            pace,
            joint: Joint::Through,
        });
        self.at = to;
    }

    /// How many stretches there are so far.
    #[must_use]
    pub fn count(&self) -> usize {
        self.stretches.len()
    }

    /// Comes to a stop here.
    pub fn stop(&mut self) {
        if let Some(last) = self.stretches.last_mut() {
            last.joint = Joint::Stop;
        }
    }

    /// A line or an arc of the plan at a height.
    pub fn piece(&mut self, whole: Piece, z: f64, pace: Pace) {
        let parts = parts(whole);
        for part in 0..parts.count {
            let share = |part: u32| f64::from(part) / f64::from(parts.count);
            let piece = whole.part(share(part), share(part + 1));
            let via = (parts.shape == Shape::Arcs && bow(piece) > FLAT).then(|| on_grid(piece.at(0.5), z));
            self.add(on_grid(piece.to, z), via, pace);
        }
        self.end_at(on_grid(whole.to, z));
    }

    /// Lets the last line end at a place so near to its end that a line of its own would be too short: that is where a piece ends, and
    /// where the tool may come down again.
    fn end_at(&mut self, place: Point3) {
        let is_near = self.at != place && self.at.distance(place).to_mm() < SHORTEST;
        let [.., before, last] = self.stretches.as_mut_slice() else {
            return;
        };
        if is_near && last.via.is_none() && before.to.distance(place).to_mm() >= SHORTEST {
            last.to = place;
            self.at = place;
        }
    }

    /// The path. Where its direction changes by more than a chain may, it comes to a stop.
    #[must_use]
    pub fn finish(mut self) -> Path {
        self.stop();
        let mut at = self.from;
        let directions: Vec<[[f64; 3]; 2]> = self
            .stretches
            .iter()
            .map(|stretch| {
                let directions = directions(at, stretch);
                at = stretch.to;
                directions
            })
            .collect();
        let pairs = directions.iter().zip(directions.iter().skip(1));
        for (stretch, ([_, ends], [begins, _])) in self.stretches.iter_mut().zip(pairs) {
            if angle(*ends, *begins) > CARE * LARGEST_KINK.to_rad() {
                stretch.joint = Joint::Stop;
            }
        }
        Path {
            from: self.from,
            stretches: self.stretches,
        }
    }
}

/// Arcs are written as lines whose middle is seen from their end, at where they begin, under less: RAPID wants 1 degree. That angle is a
/// quarter of what an arc turns through.
const LEAST_SEEN: Angle = Angle::deg(1.0);

/// How far the points of an arc may be beside it by rounding, in mm.
const ROUNDING: f64 = 1.5e-3;

/// The shortest arc, in mm: RAPID wants 0.1 mm from where it begins to its middle.
const SHORTEST_ARC: f64 = 0.25;

/// How far such lines turn from one to the next at most, below what a chain may.
const LEAST_TURN: Angle = Angle::deg(0.4);

/// How far such lines may lie beside their arc, in mm: a quarter of what passes keep from walls for rounding.
const CHORD: f64 = 5e-4;

/// What a piece is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Lines,
    Arcs,
}

#[derive(Clone, Copy, Debug)]
struct Parts {
    shape: Shape,
    count: u32,
}

fn parts(piece: Piece) -> Parts {
    let sweep = piece.sweep.abs();
    match piece.radius() {
        Some(radius) if seen(radius, sweep) < LEAST_SEEN.to_rad() || radius * sweep < SHORTEST_ARC => {
            // Of a chord over the angle a the arc is off by r a^2 / 8.
            let off = radius * sweep * sweep / 8.0;
            let count = (sweep / LEAST_TURN.to_rad()).max((off / CHORD).sqrt());
            Parts {
                shape: Shape::Lines,
                count: libm::ceil(count).clamp(1.0, 10_000.0) as u32,
            }
        }
        Some(_) if sweep > PI => Parts {
            shape: Shape::Arcs,
            count: 2,
        },
        Some(_) => Parts {
            shape: Shape::Arcs,
            count: 1,
        },
        None => Parts {
            shape: Shape::Lines,
            count: 1,
        },
    }
}

/// The length of the lines that stand for an arc, in mm; none of what is written as it is.
#[must_use]
pub fn step_of(piece: Piece) -> Option<f64> {
    let parts = parts(piece);
    (parts.shape == Shape::Lines && !piece.is_line()).then(|| piece.length() / f64::from(parts.count))
}

/// Under which angle the end of an arc is seen beside its middle, from where it begins, at least, in rad.
fn seen(radius: f64, sweep: f64) -> f64 {
    sweep / 4.0 - 2.0 * ROUNDING / (radius * sweep)
}

/// How far an arc lies beside its chord, in mm.
fn bow(piece: Piece) -> f64 {
    let middle = piece.from.lerp(piece.to, 0.5);
    middle.distance(piece.at(0.5))
}

/// The directions in which a stretch begins and ends, of length 1.
fn directions(from: Point3, stretch: &Stretch) -> [[f64; 3]; 2] {
    let [from, to] = [from, stretch.to].map(Point3::to_array);
    let arc = stretch
        .via
        .and_then(|via| CircularArc::through([from, via.to_array(), to]));
    match arc {
        Some(arc) => [arc.direction(0.0), arc.direction(arc.sweep().to_rad())],
        None => [scaled(minus(to, from), 1.0 / length(minus(to, from))); 2],
    }
}

fn angle(one: [f64; 3], other: [f64; 3]) -> f64 {
    libm::atan2(length(cross(one, other)), dot(one, other))
}
