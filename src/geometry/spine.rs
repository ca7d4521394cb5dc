//! How cuts rise and fall along the work, where all of them do so alike: their spine.
//!
//! With a spine `s(y)` every tip runs at `(x_i, y, z_i + s(y))`, and the blade's plane keeps to the direction of its way. So all
//! sections across the work are alike but for `s`: seen with the spine taken off, a cut is a V of the same slopes at every y. A part
//! `p(x, y)` is kept clear of where the Vs keep clear of the greatest height of `p - s` over each x.
//!
//! A spine is a polyline over the depth of the stock that goes on straight beyond both ends. Its least rise is 0, so what is left
//! of the stock is nowhere higher than where the spine is taken for level.

use core::fmt;
use vcutc_backend_api::units::Length;

/// Where a spine changes its slope, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Along the cuts.
    pub y: f64,
    /// How high the spine is there.
    pub rise: f64,
}

/// A polyline over y.
#[derive(Clone, Debug, PartialEq)]
pub struct Spine {
    /// In order of y, at least two; the first at 0, the last at the depth of the stock.
    knots: Vec<Knot>,
}

/// A place of a way along a spine at which the blade's plane has a slope of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Along the cuts, in mm.
    pub y: f64,
    /// How high the spine is there, in mm.
    pub rise: f64,
    /// The slope of the blade's plane there, rise over y: that of the spine, and between two pieces their mean.
    pub slope: f64,
}

/// How far the flanks of a blade that follows a spine lie off the Vs of their tips, in mm along z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Above them at most, in crests.
    pub above: f64,
    /// Below them at most, in valleys.
    pub below: f64,
}

impl Deviation {
    /// The larger of two, above and below.
    #[must_use]
    pub const fn larger(self, other: Self) -> Self {
        Self {
            above: self.above.max(other.above),
            below: self.below.max(other.below),
        }
    }

    /// By how much two flanks may differ from what their tips say of each other.
    #[must_use]
    pub fn both(self) -> f64 {
        self.above + self.below
    }
}

/// Why knots make no spine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpineError {
    /// Fewer than two, not in order, or not beginning at 0.
    Order,
    /// Steeper than [`Spine::STEEPEST`], or its slope changes too much at a knot ([`Spine::LARGEST_BEND`]).
    Bends,
    /// The least rise is not 0, or a number is not finite.
    Level,
}

impl fmt::Display for SpineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Order => "the knots of a spine go from y = 0 on in order",
            Self::Bends => "the spine is too steep, or bends too much at a knot",
            Self::Level => "the least rise of a spine is 0",
        })
    }
}

impl core::error::Error for SpineError {}

impl Spine {
    /// The steepest slope that a spine may have: 45 degrees.
    pub const STEEPEST: f64 = 1.0;

    /// How much the direction may change at a knot, in rad: 0.45 degrees. At every knot the end of the edge is turned aside
    /// by `L cos(rake) sin(swing)` times that, 0.09 mm of an edge of 40 mm; and chains go on only where they bend by less than
    /// half a degree.
    pub const LARGEST_BEND: f64 = 0.45 * core::f64::consts::PI / 180.0;

    /// How steeply flanks may rise across the cuts, as a swing of 5 degrees does. A blade that is off its place by a little lies off the
    /// Vs of steeper ones by too much.
    pub const STEEPEST_FLANK: f64 = 11.43;

    /// A spine through knots.
    ///
    /// # Errors
    /// See [`SpineError`].
    pub fn new(knots: Vec<Knot>) -> Result<Self, SpineError> {
        let is_ordered = knots.windows(2).all(|pair| pair[0].y < pair[1].y);
        let starts = knots.first().is_some_and(|first| first.y == 0.0);
        if knots.len() < 2 || !is_ordered || !starts {
            return Err(SpineError::Order);
        }
        let least = knots.iter().map(|knot| knot.rise).fold(f64::INFINITY, f64::min);
        if least != 0.0
            || !knots
                .iter()
                .all(|knot| knot.rise.is_finite() && knot.y.is_finite())
        {
            return Err(SpineError::Level);
        }
        let spine = Self { knots };
        let slopes: Vec<f64> = spine.slopes().collect();
        let bends = slopes
            .windows(2)
            .any(|pair| (libm::atan(pair[1]) - libm::atan(pair[0])).abs() > Self::LARGEST_BEND);
        if bends || slopes.iter().any(|slope| slope.abs() > Self::STEEPEST) {
            return Err(SpineError::Bends);
        }
        Ok(spine)
    }

    /// The way of a column, which has been found not to bend too much. Its least rise need not be 0.
    pub(crate) const fn of_column(knots: Vec<Knot>) -> Self {
        Self { knots }
    }

    /// Its knots, in order of y.
    #[must_use]
    pub fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// The depth of the stock, in mm.
    #[must_use]
    pub fn depth(&self) -> f64 {
        self.knots.last().map_or(0.0, |last| last.y)
    }

    /// The slopes of its pieces.
    fn slopes(&self) -> impl Iterator<Item = f64> + '_ {
        let pairs = self.knots.windows(2);
        pairs.map(|pair| (pair[1].rise - pair[0].rise) / (pair[1].y - pair[0].y))
    }

    /// How high it is at a y in mm, which may lie beyond its ends.
    #[must_use]
    pub fn rise(&self, y: f64) -> f64 {
        let [from, to] = self.piece(y);
        from.rise + (to.rise - from.rise) / (to.y - from.y) * (y - from.y)
    }

    /// The piece at a y; the first one or the last one beyond the ends.
    fn piece(&self, y: f64) -> [Knot; 2] {
        let last = self.knots.len() - 1;
        let to = self.knots.partition_point(|knot| knot.y < y).clamp(1, last);
        [self.knots[to - 1], self.knots[to]]
    }

    /// How high it is at most from one y to another.
    #[must_use]
    pub fn highest(&self, from: f64, to: f64) -> f64 {
        let within = self.knots.iter().filter(|knot| from < knot.y && knot.y < to);
        let ends = self.rise(from).max(self.rise(to));
        within.map(|knot| knot.rise).fold(ends, f64::max)
    }

    /// The largest of its slopes, up or down.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        self.slopes().map(f64::abs).fold(0.0, f64::max)
    }

    /// How many times as long as the stock is deep it is.
    #[must_use]
    pub fn lengthening(&self) -> f64 {
        let pieces = self.knots.windows(2);
        let lengths = pieces.map(|pair| libm::hypot(pair[1].y - pair[0].y, pair[1].rise - pair[0].rise));
        lengths.sum::<f64>() / self.depth()
    }

    /// How far a flank that rises by `flank` across the cuts may lie off its V, in mm, because an edge of that length is not just where it
    /// is to be: it may leave its way by `blend`, places and postures are rounded, and turning from one place to the next its
    /// end leaves its chord by an eighth of the turn squared.
    #[must_use]
    pub fn off(&self, edge: Length, blend: Length, flank: f64) -> f64 {
        off(turned(edge, blend), flank, self.steepest())
    }

    /// How much higher than the section on the spine straight blades leave the work at most, in mm, the longest of them with an edge of
    /// that length: what their flanks lie above their Vs, the steepest ones ([`Self::STEEPEST_FLANK`]) included.
    #[must_use]
    pub fn left_above(&self, longest: Length, blend: Length) -> f64 {
        self.deviation(longest.to_mm()).above + self.off(longest, blend, Self::STEEPEST_FLANK)
    }

    /// Its slopes at y = 0 and at the depth of the stock, as y grows.
    #[must_use]
    pub fn end_slopes(&self) -> [f64; 2] {
        let first = self.slopes().next().unwrap_or(0.0);
        [first, self.slopes().last().unwrap_or(0.0)]
    }

    /// Its slope at a y, as y grows; at a knot the mean of those before and after it.
    #[must_use]
    pub fn slope(&self, y: f64) -> f64 {
        let slope = |[from, to]: [Knot; 2]| (to.rise - from.rise) / (to.y - from.y);
        let at = self.knots.partition_point(|knot| knot.y < y);
        let is_knot = self.knots.get(at).is_some_and(|knot| knot.y == y);
        match (is_knot, self.knots.get(at + 1)) {
            (true, Some(&next)) if at > 0 => {
                f64::midpoint(slope(self.piece(y)), slope([self.knots[at], next]))
            }
            (true, Some(&next)) => slope([self.knots[at], next]),
            _ => slope(self.piece(y)),
        }
    }

    /// The places of a way that begins `beyond` mm before the stock and ends as far after it: its ends, and the knots between.
    #[must_use]
    pub fn stations(&self, beyond: f64) -> Vec<Station> {
        let [first, last] = self.end_slopes();
        let end = |y: f64, slope: f64| Station {
            y,
            rise: self.rise(y),
            slope,
        };
        let mut stations = vec![end(-beyond, first)];
        let slopes: Vec<f64> = self.slopes().collect();
        let inner = self.knots.iter().skip(1).zip(slopes.windows(2));
        stations.extend(inner.map(|(knot, pair)| Station {
            y: knot.y,
            rise: knot.rise,
            slope: f64::midpoint(pair[0], pair[1]),
        }));
        stations.push(end(self.depth() + beyond, last));
        stations
    }

    /// How far flanks lie off the Vs of their tips, where the blade lies over the work by at most `overhang` mm before and after
    /// its tip along y.
    ///
    /// The edge that cuts a place at `y` belongs to a tip at `t`, `e = y - t` away, whose plane has the slope `m(t)`. So the flank
    /// there is off its V by `s(t) + m(t) e - s(t + e)`. Between two stations the blade turns evenly, and `m` is linear but for
    /// [`UNEVEN`]. The lines on which `t` is at a station or `t + e` at a knot cut the places into cells; within one there is nothing
    /// but a saddle, so the extremes lie on these lines: at their ends, or on a line through a knot where the derivative is 0.
    ///
    /// How long the ways beyond the stock are decides how much of its first and of its last turn a blade makes over the work: `m`
    /// lies between what it is where they have no length, and where they have no end.
    #[must_use]
    pub fn deviation(&self, overhang: f64) -> Deviation {
        let [none, endless] = [0.0, ENDLESS].map(|beyond| self.deviation_from(beyond, overhang));
        none.larger(endless)
    }

    /// The same with ways so long beyond the stock.
    fn deviation_from(&self, beyond: f64, overhang: f64) -> Deviation {
        let stations = self.stations(beyond);
        let mut deviation = Deviation::default();
        let mut most_turned = 0.0_f64;
        for pair in stations.windows(2) {
            let piece = Piece {
                from: pair[0],
                to: pair[1],
            };
            most_turned = most_turned.max((piece.to.slope - piece.from.slope).abs());
            let mut look = |t: f64, e: f64| {
                let off = self.rise(t) + piece.slope(t) * e - self.rise(t + e);
                deviation.above = deviation.above.max(off);
                deviation.below = deviation.below.max(-off);
            };
            // Of a way without an end only what may come over the work.
            let near_work = [-overhang, self.depth() + overhang];
            let ends = piece.ends().map(|end| end.clamp(near_work[0], near_work[1]));
            for t in ends {
                look(t, -overhang);
                look(t, overhang);
            }
            let first = self
                .knots
                .partition_point(|knot| knot.y < piece.from.y - overhang);
            let near = self.knots.iter().skip(first);
            for knot in near.take_while(|knot| knot.y <= piece.to.y + overhang) {
                let ends_of_edge = [knot.y - overhang, knot.y + overhang];
                let turning = piece.turning_towards(knot.y);
                for t in ends.into_iter().chain(ends_of_edge).chain(turning) {
                    let e = knot.y - t;
                    if (piece.from.y..=piece.to.y).contains(&t) && e.abs() <= overhang + 1e-9 {
                        look(t, e);
                    }
                }
            }
        }
        let uneven = UNEVEN * most_turned * overhang;
        Deviation {
            above: deviation.above + uneven,
            below: deviation.below + uneven,
        }
    }
}

/// How far an edge leaves its way where it may do so by `blend` and turns from one place to the next.
pub(crate) fn turned(edge: Length, blend: Length) -> f64 {
    let turn = Spine::LARGEST_BEND;
    edge.to_mm() * turn * turn / 8.0 + blend.to_mm()
}

/// How far a flank that rises by `flank` lies off its V where its edge is moved so far, in mm, and rounded, along a way as steep as that.
pub(crate) fn off(moved: f64, flank: f64, steepest: f64) -> f64 {
    (moved + ROUNDED) * (1.0 + flank * flank + steepest * steepest).sqrt()
}

/// What rounding of places and postures moves an edge by, in mm.
const ROUNDED: f64 = 0.003;

/// A way beyond the stock, in mm, on which a blade hardly turns over the length of its edge.
const ENDLESS: f64 = 1e7;

/// By how much of its change a slope may be off a linear one between two stations: the edge reaches as far along y at both, but for
/// the angle by which it turns.
const UNEVEN: f64 = 0.02;

/// A way between two stations.
#[derive(Clone, Copy)]
struct Piece {
    from: Station,
    to: Station,
}

impl Piece {
    const fn ends(&self) -> [f64; 2] {
        [self.from.y, self.to.y]
    }

    fn turned(&self) -> f64 {
        (self.to.slope - self.from.slope) / (self.to.y - self.from.y)
    }

    /// The slope of the blade's plane at a place.
    fn slope(&self, y: f64) -> f64 {
        self.from.slope + self.turned() * (y - self.from.y)
    }

    /// Where a tip is whose plane, seen from a fixed place, neither rises nor falls.
    fn turning_towards(&self, y: f64) -> Option<f64> {
        let turned = self.turned();
        let way = (self.to.rise - self.from.rise) / (self.to.y - self.from.y);
        let t = f64::midpoint(y, self.from.y) + (way - self.from.slope) / (2.0 * turned);
        t.is_finite().then_some(t)
    }
}

#[cfg(test)]
mod tests;
