//! Path data (SVG 1.1, 8.3): commands and numbers, to lines, arcs and Bezier curves.

use super::super::DataError;
use super::super::drawing::Shape;
use super::scan::Scan;
use super::tree::Text;
use crate::point::Point2;
use core::f64::consts::{PI, TAU};

/// Reads path data: the shapes of each subpath. Subpaths that are a single point are left out.
pub(super) fn subpaths(text: Text<'_>) -> Result<Vec<Vec<Shape>>, DataError> {
    let mut scan = Scan::new(text);
    let mut drawing = Drawing::default();
    if text.text.trim() == "none" {
        return Ok(Vec::new());
    }
    while scan.peek().is_some() {
        let Some(letter) = scan.letter() else {
            return Err(scan.wrong("a command of a path"));
        };
        let command = Command::of(letter).ok_or_else(|| scan.wrong("a command of a path before this"))?;
        if !drawing.has_begun && command != Command::Move {
            return Err(scan.wrong("`M` before any other command"));
        }
        let from_here = letter.is_ascii_lowercase();
        drawing.step(command, from_here, &mut scan)?;
        let mut command = command;
        loop {
            scan.take(',');
            if command == Command::Close || !scan.is_number_next() {
                break;
            }
            // Further pairs after a move are lines.
            if command == Command::Move {
                command = Command::Line;
            }
            drawing.step(command, from_here, &mut scan)?;
        }
    }
    drawing.finish_subpath();
    Ok(drawing.subpaths)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Command {
    Move,
    Line,
    Across,
    Down,
    Cubic,
    SmoothCubic,
    Quadratic,
    SmoothQuadratic,
    Arc,
    Close,
}

impl Command {
    const fn of(letter: char) -> Option<Self> {
        Some(match letter.to_ascii_uppercase() {
            'M' => Self::Move,
            'L' => Self::Line,
            'H' => Self::Across,
            'V' => Self::Down,
            'C' => Self::Cubic,
            'S' => Self::SmoothCubic,
            'Q' => Self::Quadratic,
            'T' => Self::SmoothQuadratic,
            'A' => Self::Arc,
            'Z' => Self::Close,
            _ => return None,
        })
    }
}

/// The last control point, for commands that go on smoothly.
#[derive(Clone, Copy)]
enum Handle {
    Cubic(Point2),
    Quadratic(Point2),
    None,
}

impl Handle {
    const fn of_cubic(self) -> Option<Point2> {
        match self {
            Self::Cubic(last) => Some(last),
            Self::Quadratic(_) | Self::None => None,
        }
    }

    const fn of_quadratic(self) -> Option<Point2> {
        match self {
            Self::Quadratic(last) => Some(last),
            Self::Cubic(_) | Self::None => None,
        }
    }
}

struct Drawing {
    subpaths: Vec<Vec<Shape>>,
    shapes: Vec<Shape>,
    /// Where the subpath began.
    start: Point2,
    here: Point2,
    handle: Handle,
    has_begun: bool,
}

impl Default for Drawing {
    fn default() -> Self {
        let origin = Point2::new(0.0, 0.0);
        Self {
            subpaths: Vec::new(),
            shapes: Vec::new(),
            start: origin,
            here: origin,
            handle: Handle::None,
            has_begun: false,
        }
    }
}

impl Drawing {
    fn finish_subpath(&mut self) {
        if !self.shapes.is_empty() {
            self.subpaths.push(core::mem::take(&mut self.shapes));
        }
    }

    fn step(&mut self, command: Command, from_here: bool, scan: &mut Scan<'_>) -> Result<(), DataError> {
        let origin = if from_here {
            self.here
        } else {
            Point2::new(0.0, 0.0)
        };
        let point = |scan: &mut Scan<'_>| -> Result<Point2, DataError> {
            let (x, y) = (scan.number()?, scan.number()?);
            Ok(Point2::new(origin.x + x, origin.z + y))
        };
        match command {
            Command::Move => {
                let to = point(scan)?;
                self.begin(to);
            }
            Command::Line => {
                let to = point(scan)?;
                self.line(to);
            }
            Command::Across => {
                let x = origin.x + scan.number()?;
                self.line(Point2::new(x, self.here.z));
            }
            Command::Down => {
                let y = origin.z + scan.number()?;
                self.line(Point2::new(self.here.x, y));
            }
            Command::Cubic => {
                let (first, second, to) = (point(scan)?, point(scan)?, point(scan)?);
                self.curve(vec![first, second, to], Handle::Cubic(second));
            }
            Command::SmoothCubic => {
                let first = self.smooth(self.handle.of_cubic());
                let (second, to) = (point(scan)?, point(scan)?);
                self.curve(vec![first, second, to], Handle::Cubic(second));
            }
            Command::Quadratic => {
                let (middle, to) = (point(scan)?, point(scan)?);
                self.curve(vec![middle, to], Handle::Quadratic(middle));
            }
            Command::SmoothQuadratic => {
                let middle = self.smooth(self.handle.of_quadratic());
                let to = point(scan)?;
                self.curve(vec![middle, to], Handle::Quadratic(middle));
            }
            Command::Arc => {
                let arc = Ring {
                    radii: (scan.number()?.abs(), scan.number()?.abs()),
                    turned: scan.number()?,
                    is_large: scan.flag()?,
                    leads_on: scan.flag()?,
                };
                let to = point(scan)?;
                self.arc(&arc, to);
            }
            Command::Close => {
                self.line(self.start);
                self.finish_subpath();
            }
        }
        Ok(())
    }

    /// Begins a subpath.
    fn begin(&mut self, at: Point2) {
        self.finish_subpath();
        self.has_begun = true;
        self.start = at;
        self.here = at;
        self.handle = Handle::None;
    }

    /// The control point with which a curve continues smoothly: the last one mirrored about the pen, or the pen.
    fn smooth(&self, last: Option<Point2>) -> Point2 {
        last.map_or(self.here, |last| {
            Point2::new(2.0 * self.here.x - last.x, 2.0 * self.here.z - last.z)
        })
    }

    fn line(&mut self, to: Point2) {
        if self.here.distance(to) > 0.0 {
            match self.shapes.last_mut() {
                Some(Shape::Polyline(points)) => points.push(to),
                _ => self.shapes.push(Shape::Polyline(vec![self.here, to])),
            }
        }
        self.here = to;
        self.handle = Handle::None;
    }

    fn curve(&mut self, after: Vec<Point2>, handle: Handle) {
        if let Some(&to) = after.last() {
            let mut control = vec![self.here];
            control.extend(after);
            self.shapes.push(Shape::Bezier(control));
            self.here = to;
            self.handle = handle;
        }
    }

    fn arc(&mut self, arc: &Ring, to: Point2) {
        if self.here.distance(to) <= 0.0 {
            return;
        }
        let flat = arc.radii.0.min(arc.radii.1) <= 0.0;
        if flat {
            self.line(to);
        } else {
            self.shapes.push(arc.between(self.here, to));
            self.here = to;
            self.handle = Handle::None;
        }
    }
}

/// An elliptic arc as path data gives it.
struct Ring {
    radii: (f64, f64),
    /// The angle of the first axis, in degrees.
    turned: f64,
    /// Whether it is more than half of the ellipse.
    is_large: bool,
    /// Whether it turns from x towards y.
    leads_on: bool,
}

impl Ring {
    /// The arc between two points, by its centre (SVG 1.1, F.6.5); radii that are too small are made large enough (F.6.6).
    fn between(&self, from: Point2, to: Point2) -> Shape {
        let (rx, ry) = self.radii;
        let (sin, cos) = super::super::drawing::sincos_degrees(self.turned);
        // Half the way back, in axes in which the ellipse is the unit circle.
        let half = Point2::new((from.x - to.x) / 2.0, (from.z - to.z) / 2.0);
        let along = Point2::new(
            (cos * half.x + sin * half.z) / rx,
            (cos * half.z - sin * half.x) / ry,
        );
        let size = along.dot(along);
        let (grown, aside) = if size >= 1.0 {
            (size.sqrt(), 0.0)
        } else {
            (1.0, ((1.0 - size) / size).sqrt())
        };
        let (rx, ry) = (rx * grown, ry * grown);
        let aside = if self.is_large == self.leads_on {
            -aside
        } else {
            aside
        };
        let along = Point2::new(along.x / grown, along.z / grown);
        // The centre from the middle of the chord, on the unit circle's scale.
        let center = Point2::new(aside * along.z, -aside * along.x);
        let angle = |x: f64, z: f64| libm::atan2(z - center.z, x - center.x);
        let start = angle(along.x, along.z);
        let turn = (angle(-along.x, -along.z) - start).rem_euclid(TAU);
        let sweep = match self.leads_on {
            true if turn > 0.0 => turn,
            true => PI,
            false => turn - TAU,
        };
        if rx.total_cmp(&ry).is_eq() {
            return Shape::Arc { from, to, sweep };
        }
        let (first, second) = (Point2::new(rx * cos, rx * sin), Point2::new(-ry * sin, ry * cos));
        let middle = from.lerp(to, 0.5);
        Shape::Ellipse {
            center: Point2::new(
                middle.x + first.x * center.x + second.x * center.z,
                middle.z + first.z * center.x + second.z * center.z,
            ),
            half: [first, second],
            start,
            sweep,
        }
    }
}
