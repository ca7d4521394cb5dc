//! From runs over the plan to paths in space: for each layer the way down, the passes at its floor, and the way up.
//!
//! All points lie on the grid of programs, and arcs are those through the three points that a program states. So whether one
//! piece goes on into the next is decided on what will be written.

use super::{Entry, Leg, Plan, Run};
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

/// The heights between which a layer lies, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// What is above it: the top of the stock, or the floor of the layer before.
    pub above: f64,
    pub floor: f64,
    pub place: LayerPlace,
}

/// Where a layer lies among others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerPlace {
    /// Nothing of the pocket is cleared yet.
    First,
    /// The one above it is cleared.
    Below,
}

/// Share of the steepest way down that is used: points are rounded.
const CARE: f64 = 0.98;

/// Shorter stretches have no direction, in mm.
const SHORTEST: f64 = 2e-3;

/// Arcs lower than this over their chord are lines, in mm: a point on their way would lie on it, as rounded.
const FLAT: f64 = 2e-3;

/// The paths of a layer. Each begins and ends at `top`, the height from which on the air is free, or beside the stock.
#[must_use]
pub fn paths(plan: &Plan, layer: Layer, top: f64, ramp: Angle) -> Vec<Path> {
    let runs = plan.runs.iter();
    runs.map(|run| path(run, layer, top, ramp)).collect()
}

fn path(run: &Run, layer: Layer, top: f64, ramp: Angle) -> Path {
    let mut pen = match run.entry {
        Entry::Ramp { line } => {
            let mut pen = Pen::at(line.from, top);
            pen.ramp(line, layer, top, ramp);
            pen
        }
        Entry::Return { at } => {
            let mut pen = Pen::at(at, top);
            pen.line(at, layer.floor, Pace::Travel);
            pen.stop();
            pen
        }
        Entry::Open { from } => Pen::at(from, layer.floor),
    };
    for leg in &run.legs {
        pen.leg(leg, layer.floor);
    }
    if let Some(last) = run.legs.last().filter(|_| run.leaves_upwards()) {
        pen.stop();
        pen.line(last.piece.to, top, Pace::Travel);
    }
    pen.finish()
}

/// Writes stretches one after the other.
struct Pen {
    from: Point3,
    at: Point3,
    stretches: Vec<Stretch>,
}

/// A place at a height, on the grid.
fn on_grid(place: Place, z: f64) -> Point3 {
    Point3::new(grid::nearest(place.x), grid::nearest(place.y), grid::up(z))
}

impl Pen {
    fn at(place: Place, z: f64) -> Self {
        let from = on_grid(place, z);
        Self {
            from,
            at: from,
            stretches: Vec::new(),
        }
    }

    fn line(&mut self, to: Place, z: f64, pace: Pace) {
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

    /// Comes to a stop here.
    fn stop(&mut self) {
        if let Some(last) = self.stretches.last_mut() {
            last.joint = Joint::Stop;
        }
    }

    fn leg(&mut self, leg: &Leg, z: f64) {
        let pace = if leg.kind.is_slow() {
            Pace::Plunge
        } else {
            Pace::Cut
        };
        let parts = parts(leg.piece);
        for part in 0..parts.count {
            let share = |part: u32| f64::from(part) / f64::from(parts.count);
            let piece = leg.piece.part(share(part), share(part + 1));
            let via = (parts.shape == Shape::Arcs && bow(piece) > FLAT).then(|| on_grid(piece.at(0.5), z));
            self.add(on_grid(piece.to, z), via, pace);
        }
    }

    /// Down to and fro along a line, once to and fro at the floor, and to a stop where it began: there the layer before, if there is
    /// one, has left the way down free. Above the first one a verifier knows no air within the box of the stock, so the tool goes to
    /// and fro there too.
    fn ramp(&mut self, line: Piece, layer: Layer, top: f64, ramp: Angle) {
        let Layer { above, floor, place } = layer;
        match place {
            LayerPlace::First => self.back_and_forth(line, [top, above], ramp, Pace::Travel),
            LayerPlace::Below => {
                self.line(line.from, above, Pace::Travel);
                self.stop();
            }
        }
        self.back_and_forth(line, [above, floor], ramp, Pace::Plunge);
        for end in [line.to, line.from] {
            self.line(end, floor, Pace::Plunge);
            self.stop();
        }
    }

    fn back_and_forth(&mut self, line: Piece, [from, to]: [f64; 2], ramp: Angle, pace: Pace) {
        let steepest = line.length() * libm::tan(ramp.to_rad() * CARE);
        // The cast saturates, and a stock is no higher than a hundred metres.
        let ways = 2 * libm::ceil((from - to) / (2.0 * steepest)).max(0.0) as u32;
        for way in 1..=ways {
            let end = if way % 2 == 1 { line.to } else { line.from };
            let share = f64::from(way) / f64::from(ways);
            self.line(end, from + (to - from) * share, pace);
            self.stop();
        }
    }

    fn finish(mut self) -> Path {
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

/// Arcs that turn through less are written as lines: controls ask for a middle that is seen under some angle from both ends. RAPID
/// wants 1 degree between the middle and the end, seen from where an arc begins, which is a quarter of what it turns through.
const LEAST_SWEEP: Angle = Angle::deg(5.0);

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
        Some(radius) if sweep < LEAST_SWEEP.to_rad() || radius * sweep < SHORTEST_ARC => {
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
