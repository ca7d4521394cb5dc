//! What the edge of a disc covers in the x-z plane.
//!
//! The edge is a circle of radius R about the disc's centre. With a lead gamma its axis leans along the feed, so that the
//! leading rim is lowest. Swept along y, the circle shows as an ellipse with semi-axes R and `R sin gamma`, of which the lower
//! half cuts (`docs/process.md`, "The cross-section of rectangular cutting"). It is convex: the height of a straight piece above
//! it has one maximum, where both have the same slope.
//!
//! A disc that is rolled about its feed as well shows as the same ellipse, turned. Sheared along z, a turned ellipse is an upright
//! one: with the slope `m` of its conjugate diameter, half its width `w` and its sag `k w`, the lower half is
//! `z_c + m x - k sqrt(w^2 - x^2)`. Heights above straight pieces do not change by that but for the slope, so all that holds of
//! upright ones holds of those.

#[cfg(test)]
mod tests;

use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;

/// How far a disc gets aside and up with each mm that it goes along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// Towards +x.
    pub right: f64,
    /// Towards +z.
    pub climb: f64,
}

impl Drift {
    /// Straight along y.
    pub const NONE: Self = Self {
        right: 0.0,
        climb: 0.0,
    };

    /// The square of half the width of the ellipse that a disc of radius 1 shows as, with these parts of its axis along x and y: above 0
    /// of an axis that points up.
    pub(crate) fn width_square(self, x: f64, y: f64) -> f64 {
        let p = x - self.right * y;
        (1.0 + self.right * self.right - p * p).max(f64::MIN_POSITIVE)
    }
}

/// The lower half of the ellipse that a disc's edge shows as.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rim {
    centre: Point2,
    /// Half its width, in mm: of an upright disc its radius.
    half: f64,
    /// How far it hangs below its diameter, to half its width: of an upright disc the sine of its lead.
    sag: f64,
    /// Of the diameter that ends where the ellipse is vertical; 0 of an upright disc.
    slope: f64,
    /// How far it reaches along y, in mm.
    overhang: f64,
}

impl Rim {
    /// The rim of a disc with its centre there, in mm.
    #[must_use]
    pub fn new(centre: Point2, radius: Length, lead: Angle) -> Self {
        let (sine, cosine) = libm::sincos(lead.to_rad());
        Self {
            centre,
            half: radius.to_mm(),
            sag: sine.abs(),
            slope: 0.0,
            overhang: radius.to_mm() * cosine,
        }
    }

    /// The rim of a disc that leans along its feed by a lead above 0 and is rolled about its feed, so that its axis leans by that
    /// towards -x: as on a part that rises by this angle towards +x.
    #[must_use]
    pub fn rolled(centre: Point2, radius: Length, lead: Angle, roll: Angle) -> Self {
        let upright = Self::new(centre, radius, lead);
        if roll == Angle::ZERO {
            return upright;
        }
        let (sine, cosine) = libm::sincos(roll.to_rad());
        // The semi-axes of the ellipse, of which the first one lies at the angle of the roll.
        let (long, short) = (upright.half, upright.half * upright.sag);
        let square = (long * cosine) * (long * cosine) + (short * sine) * (short * sine);
        Self {
            half: square.sqrt(),
            sag: long * short / square,
            slope: (long * long - short * short) * sine * cosine / square,
            ..upright
        }
    }

    /// The rim of a disc that drifts on its way along y, seen along that way in the section through its centre. Its axis leans by the
    /// lead along y, and by the roll towards -x.
    ///
    /// A point at the distance y along the way from the centre passes that section `right y` farther left and `climb y` lower: the
    /// circle of the edge, sheared so, shows as an ellipse again. With the axis `a`, `p = a_x - right a_y`, `q = a_z - climb a_y` and
    /// `c = 1 + right^2 - p^2`, its half width is `R sqrt(c)`, the slope of its conjugate diameter `(right climb - p q) / c`, and it hangs
    /// below that by `(right a_x + a_y + climb a_z) / c` times its half width: twice its area is `R^2` times the part of the axis along
    /// `(right, 1, climb)`.
    #[must_use]
    pub fn swept(centre: Point2, radius: Length, [lead, roll]: [Angle; 2], drift: Drift) -> Self {
        if drift == Drift::NONE {
            return Self::rolled(centre, radius, lead, roll);
        }
        let Drift { right, climb } = drift;
        let [x, y, z] = axis(lead, roll);
        let (p, q) = (x - right * y, z - climb * y);
        let rest = drift.width_square(x, y);
        Self {
            centre,
            half: radius.to_mm() * rest.sqrt(),
            sag: (right * x + y + climb * z).abs() / rest,
            slope: (right * climb - p * q) / rest,
            overhang: radius.to_mm() * (1.0 - y * y).max(0.0).sqrt(),
        }
    }

    /// The centre of the edge, in mm.
    #[must_use]
    pub const fn centre(&self) -> Point2 {
        self.centre
    }

    /// From where to where it reaches over x, in mm.
    #[must_use]
    pub const fn cover(&self) -> [f64; 2] {
        [self.centre.x - self.half, self.centre.x + self.half]
    }

    /// Height over x, in mm; beyond the cover that of its end.
    #[must_use]
    pub fn height(&self, x: f64) -> f64 {
        if self.is_level() {
            return self.centre.z;
        }
        let off = (x - self.centre.x).max(-self.half).min(self.half);
        let square = self.half * self.half - off * off;
        self.centre.z + self.slope * off - self.sag * square.max(0.0).sqrt()
    }

    /// How far one turns about the axis along its leading half from one x to another.
    pub(crate) fn turned(&self, stretch: [f64; 2]) -> Angle {
        // Seen from y, a circle is an ellipse whose points still lie over x as the cosine of their turn has it.
        let [from, to] = stretch.map(|x| {
            let share = (x - self.centre.x) / self.half;
            libm::acos(share.clamp(-1.0, 1.0))
        });
        Angle::rad((from - to).max(0.0))
    }

    /// Its lowest point.
    #[must_use]
    pub fn lowest(&self) -> Point2 {
        self.touching(0.0)
    }

    /// Its point below the centre.
    fn bottom(&self) -> Point2 {
        Point2::new(self.centre.x, self.centre.z - self.depth().to_mm())
    }

    /// How far it hangs below its centre: what it shaves off the floors of its neighbours at most.
    #[must_use]
    pub fn depth(&self) -> Length {
        Length::mm(self.half * self.sag)
    }

    /// How far it reaches along y, before and after its centre.
    #[must_use]
    pub const fn overhang(&self) -> Length {
        Length::mm(self.overhang)
    }

    /// Its point where it has a slope: there it is deepest below a flank of that slope.
    #[must_use]
    pub fn touching(&self, slope: f64) -> Point2 {
        let slope = slope - self.slope;
        let length = (slope * slope + self.sag * self.sag).sqrt();
        if length > 0.0 {
            let off = self.half * slope / length;
            Point2::new(
                self.centre.x + off,
                self.centre.z + self.slope * off - self.half * self.sag * self.sag / length,
            )
        } else {
            self.centre
        }
    }

    /// Height over its centre of the flank of a slope that touches it from below.
    #[must_use]
    pub fn flank(&self, slope: f64) -> f64 {
        let slope = slope - self.slope;
        self.centre.z - self.half * (slope * slope + self.sag * self.sag).sqrt()
    }

    /// The radius of its curvature where it has a slope, in mm; infinite of one that shows as a straight line.
    #[must_use]
    pub fn curvature_radius(&self, slope: f64) -> f64 {
        // Of `z = m x - k sqrt(w^2 - x^2)` at the offset x: z'' = k w^2 / (w^2 - x^2)^(3/2), where z' is the slope.
        let rest = self.over(self.touching(slope)).root;
        let bend = self.sag * self.half * self.half / (rest * rest * rest);
        let length = (1.0 + slope * slope).sqrt();
        length * length * length / bend
    }

    /// Both x at which it has a height; its ends where it lies below that, and the centre where it lies above.
    pub(crate) fn levels(&self, z: f64) -> [f64; 2] {
        let line = Line {
            from: Point2::new(self.centre.x, z),
            slope: 0.0,
        };
        if self.is_level() {
            self.cover()
        } else {
            self.crossings(line, 0.0)
        }
    }

    /// Whether it shows as a level line.
    pub(crate) const fn is_level(&self) -> bool {
        self.sag == 0.0
    }

    /// How far a point lies above it.
    pub(crate) fn below(&self, point: Point2) -> f64 {
        point.z - self.height(point.x)
    }

    /// A point with what its place has in common for both pieces that end there.
    pub(crate) fn over(&self, at: Point2) -> Over {
        let off = at.x - self.centre.x;
        let root = (self.half * self.half - off * off).max(0.0).sqrt();
        let off = off.max(-self.half).min(self.half);
        Over {
            at,
            above: at.z - (self.centre.z + self.slope * off) + self.sag * root,
            root,
        }
    }

    /// Whether a straight piece plainly is nowhere more than so much above it. The rim lies below its own chord there by no more
    /// than its greatest curvature makes it.
    pub(crate) fn is_clear(&self, from: Over, to: Over, level: f64) -> bool {
        let higher = from.above.max(to.above);
        if higher > level {
            return false;
        }
        if self.is_level() {
            return true;
        }
        let (width, root) = (to.at.x - from.at.x, from.root.min(to.root));
        let bend = width * width * self.sag * self.half * self.half;
        (level - higher) * (8.0 * root * root * root) >= bend
    }

    /// The place between two x where a straight piece lies highest above it.
    pub(crate) fn highest_above(&self, line: Line, from: f64, to: f64) -> f64 {
        if self.is_level() {
            return if line.slope > 0.0 { to } else { from };
        }
        self.touching(line.slope).x.max(from).min(to)
    }

    /// Where a straight piece lies more than so much above it.
    pub(crate) fn above(&self, from: Point2, to: Point2, level: f64) -> Option<Above> {
        let ends = [self.below(from) - level, self.below(to) - level];
        let line = Line::through(from, to);
        let is_above = ends.map(|end| end > 0.0);
        if is_above == [true; 2] {
            let (from, to) = (from.x, to.x);
            return Some(Above { from, to, line });
        }
        if self.is_level() {
            let cross = from.x + (to.x - from.x) * (ends[0] / (ends[0] - ends[1]));
            let (from, to) = match is_above {
                [true, _] => (from.x, cross),
                [_, true] => (cross, to.x),
                [false, false] => return None,
            };
            return Some(Above { from, to, line });
        }
        let top = self.highest_above(line, from.x, to.x);
        if self.below(line.at(top)) <= level {
            return None;
        }
        let crossings = self.crossings(line, level);
        let left = if ends[0] > 0.0 {
            from.x
        } else {
            crossings[0].max(from.x).min(top)
        };
        let right = if ends[1] > 0.0 {
            to.x
        } else {
            crossings[1].min(to.x).max(top)
        };
        Some(Above {
            from: left,
            to: right,
            line,
        })
    }

    /// Both x at which a line lies so much above it, from left to right; of a line that never does, that of the nearest place.
    fn crossings(&self, line: Line, level: f64) -> [f64; 2] {
        let over = line.at(self.centre.x).z - self.centre.z - level;
        let (square, slope) = (self.sag * self.sag, line.slope - self.slope);
        let length = slope * slope + square;
        let root = (self.half * self.half * length - over * over).max(0.0).sqrt();
        [-1.0, 1.0].map(|sense| self.centre.x + (sense * self.sag * root - over * slope) / length)
    }

    /// A polyline from one x to a greater one, with corners on the rim and nowhere more than so much above it.
    pub(crate) fn chords(&self, from: f64, to: f64, tolerance: f64, out: &mut Vec<Point2>) {
        out.push(Point2::new(from, self.height(from)));
        if !self.is_level() {
            let middle = self.centre.x.max(from).min(to);
            self.inwards(from, middle, tolerance, out);
            if from < middle && middle < to {
                out.push(self.bottom());
            }
            let first = out.len();
            self.inwards(to, middle, tolerance, out);
            if let Some(right) = out.get_mut(first..) {
                right.reverse();
            }
        }
        out.push(Point2::new(to, self.height(to)));
    }

    /// The ends of chords between an x and one nearer to the centre. The rim becomes flatter there, so each chord may be as long
    /// as the curvature at its start allows, or the bend of one that starts at the rim's own end.
    fn inwards(&self, outer: f64, inner: f64, tolerance: f64, out: &mut Vec<Point2>) {
        let scale = 8.0 * tolerance / (self.sag * self.half * self.half);
        let least = STEEP * 8.0 * tolerance * tolerance / (self.sag * self.sag * self.half);
        let mut root = self.over(Point2::new(outer, 0.0)).root;
        let (sense, way) = ((inner - outer).signum(), (inner - outer).abs());
        let mut done = 0.0;
        for _ in 0..MOST_CHORDS {
            done += (scale * root * root * root).sqrt().max(least);
            if done >= way {
                break;
            }
            let over = self.over(Point2::new(outer + sense * done, 0.0));
            root = over.root;
            out.push(Point2::new(over.at.x, -over.above));
        }
    }
}

/// The axis of a disc, of length 1, that leans by a lead along y and is rolled towards -x.
pub(crate) fn axis(lead: Angle, roll: Angle) -> [f64; 3] {
    let (along, up) = libm::sincos(lead.to_rad());
    let (aside, upright) = libm::sincos(roll.to_rad());
    [-aside * up, along, up * upright]
}

/// No stretch takes more chords than this on either side of the centre; the last one is longer if need be.
const MOST_CHORDS: usize = 10_000;

/// The closed form for the first chord at the rim's end is good for short ones; this makes it so for all.
const STEEP: f64 = 0.9;

/// A straight line that is not vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Line {
    from: Point2,
    pub(crate) slope: f64,
}

impl Line {
    pub(crate) fn through(from: Point2, to: Point2) -> Self {
        let width = to.x - from.x;
        let slope = if width > 0.0 { (to.z - from.z) / width } else { 0.0 };
        Self { from, slope }
    }

    pub(crate) fn at(self, x: f64) -> Point2 {
        Point2::new(x, self.from.z + self.slope * (x - self.from.x))
    }
}

/// A point over a rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Over {
    pub(crate) at: Point2,
    /// How far it lies above the rim.
    pub(crate) above: f64,
    /// Half the width of the edge there, seen along its axis.
    root: f64,
}

/// Where a straight piece lies above a rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Above {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) line: Line,
}
