//! Cuts that are straight, each with a slope of its own along the work: a fan.
//!
//! A part `p(x, y)` is covered from above by straight lines along y, one over each x: `p <= R(x, y) = R0(x) (1 - y/D) + R1(x) y/D`.
//! A tip at `x_i` rises by the slope `m(x_i)` of its place, so that all tips over one x are parallel. Both `R` and the flanks of a V,
//! `z_i(y) + c |x - x_i|`, are linear in y over each x. So a V that stays above `R` at y = 0 and at y = D does so in between: no cut
//! enters the part where none enters `R0` and `R1` (derived here).
//!
//! A tip is planned by the height of its lower end. There the two ends ask for at least
//! `f(x) = max over both ends of C(x) - rise(x, y)`, with `C` the part at that end raised so that no flank is steeper, and
//! `rise(x, y) >= 0` how far the line through x lies above its lower end. A V over `f` is clear at both ends, whatever the slopes
//! `m` are (derived here).

use crate::cone::clearance;
use crate::curve::Point2;
use crate::offset::offset_up;
use crate::profile::{Profile, ProfileError, height_between, least_step};
use vcutc_backend_api::units::Length;

/// Lines along y over each x, as a part is covered by them.
#[derive(Clone, Debug, PartialEq)]
pub struct Fan {
    /// The cover at y = 0 and at the depth of the stock.
    ends: [Profile; 2],
    /// Rise over y by x, as a polyline: z is the slope.
    slopes: Vec<Point2>,
    depth: f64,
}

/// The way of a tip of a fan, and its flanks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ruling {
    /// Across the cuts, in mm.
    pub x: f64,
    /// The height of the tip at y = 0 and at the depth of the stock, in mm.
    pub ends: [f64; 2],
    /// Rise of the flanks over x.
    pub flank: f64,
}

impl Ruling {
    /// The height of its V over a place in a stock of that depth.
    #[must_use]
    pub fn height(&self, [x, y]: [f64; 2], depth: f64) -> f64 {
        let [front, back] = self.ends;
        front + (back - front) * (y / depth) + self.flank * (x - self.x).abs()
    }

    /// Whether its V lies nowhere above another one with flanks as steep.
    #[must_use]
    pub fn covers(&self, other: &Self) -> bool {
        let aside = self.flank * (self.x - other.x).abs();
        let ends = self.ends.iter().zip(other.ends);
        ends.map(|(own, other)| own + aside - other)
            .all(|above| above <= 0.0)
    }
}

impl Fan {
    /// The steepest slope that its lines may have: 45 degrees.
    pub const STEEPEST: f64 = 1.0;

    /// A fan over a part that these profiles cover at y = 0 and at that depth. At corners of `slopes`, which span the same, x is a place
    /// and z the slope there.
    ///
    /// # Errors
    /// See [`ProfileError`], of the slopes as of a profile.
    pub fn new(ends: [Profile; 2], slopes: Vec<Point2>, depth: Length) -> Result<Self, ProfileError> {
        let slopes = Profile::new(slopes)?.points().to_vec();
        Ok(Self {
            ends,
            slopes,
            depth: depth.to_mm(),
        })
    }

    /// The depth of the stock, in mm.
    #[must_use]
    pub const fn depth(&self) -> f64 {
        self.depth
    }

    /// The cover at y = 0 and at the depth of the stock.
    #[must_use]
    pub const fn ends(&self) -> &[Profile; 2] {
        &self.ends
    }

    /// The slope of tips at an x in mm, rise over y.
    #[must_use]
    pub fn slope(&self, x: f64) -> f64 {
        let after = self.slopes.partition_point(|corner| corner.x < x);
        let after = after.clamp(1, self.slopes.len() - 1);
        match self.slopes.get(after - 1..=after) {
            Some(&[from, to]) => height_between(from, to, x),
            Some(_) | None => 0.0,
        }
    }

    /// How far the line through an x lies at a y, which may lie beyond the stock, above its lower end over the stock.
    #[must_use]
    pub fn rise(&self, x: f64, y: f64) -> f64 {
        let slope = self.slope(x);
        slope * (y - if slope < 0.0 { self.depth } else { 0.0 })
    }

    /// The largest of its slopes, up or down.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        self.slopes
            .iter()
            .map(|corner| corner.z.abs())
            .fold(0.0, f64::max)
    }

    /// By how much more one end rises over x than the other at most: its twist times its depth.
    #[must_use]
    pub fn shear(&self) -> f64 {
        let pairs = self.slopes.windows(2);
        let each = pairs.map(|pair| ((pair[1].z - pair[0].z) / (pair[1].x - pair[0].x)).abs());
        each.fold(0.0, f64::max) * self.depth
    }

    /// How much more steeply than its flanks the V of a tip at x rises at most to the left and to the right, where lines are seen from
    /// their lower ends: what any of its sections shows lies below that.
    #[must_use]
    pub fn opening(&self, x: f64) -> [f64; 2] {
        let ends = [0.0, self.depth];
        let own = ends.map(|y| self.rise(x, y));
        let mut most = [0.0_f64; 2];
        for place in self.breaks() {
            let side = usize::from(place > x);
            let above = ends.iter().zip(own).map(|(&y, own)| own - self.rise(place, y));
            let above = above.fold(0.0, f64::max) / (place - x).abs();
            if above.is_finite()
                && let Some(most) = most.get_mut(side)
            {
                *most = most.max(above);
            }
        }
        most
    }

    /// The places at which rises over x have corners.
    fn breaks(&self) -> impl Iterator<Item = f64> + '_ {
        let level = self.slopes.windows(2).filter_map(|pair| {
            let (from, to) = (pair[0], pair[1]);
            let x = from.x + (to.x - from.x) * (from.z / (from.z - to.z));
            (from.z * to.z < 0.0).then_some(x)
        });
        self.slopes.iter().map(|corner| corner.x).chain(level)
    }

    /// The cover at both ends with an allowance. Its ball is taken for one that is as high as the ellipse that it makes across the
    /// steepest line, `sqrt(1 + m^2)` times as high as wide.
    #[must_use]
    pub fn ends_with(&self, allowance: Length) -> [Profile; 2] {
        let stretched = allowance * libm::hypot(1.0, self.steepest());
        [0, 1].map(|end| offset_up(&self.ends[end], stretched))
    }

    /// The part as the lower ends of tips see it: `f` of the module. Flanks may rise by `flank` or more.
    #[must_use]
    pub fn section(&self, flank: f64, allowance: Length) -> Profile {
        self.seen(&self.ends_with(allowance).map(|end| clearance(&end, flank)))
    }

    /// The same without flanks or allowance: what tips that are infinitely close leave.
    #[must_use]
    pub fn shadow(&self) -> Profile {
        self.seen(&self.ends)
    }

    /// The greater of both ends, with the rises of lines taken off. Between two corners of either it is convex, so that a chord lies
    /// above it.
    fn seen(&self, ends: &[Profile; 2]) -> Profile {
        let corners = ends
            .iter()
            .flat_map(|end| end.points().iter().map(|corner| corner.x));
        let mut places: Vec<f64> = corners.chain(self.breaks()).collect();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|next, before| *next - *before < least_step(*next));
        let height = |x: f64| {
            let ys = [0.0, self.depth];
            let seen = ends
                .iter()
                .zip(ys)
                .map(|(end, y)| end.height(x) - self.rise(x, y));
            Point2::new(x, seen.fold(f64::NEG_INFINITY, f64::max))
        };
        Profile::from_ascending(places.into_iter().map(height).collect())
    }
}

#[cfg(test)]
mod tests;
