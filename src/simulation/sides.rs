//! The side of a thick blade towards the material that stays, flank by flank.
//!
//! Edge-on the blade is a strip from its tip up, half its thickness to either side of its middle plane (`docs/process.md`,
//! "Narrower flanks"). Beside the tip its lower edge first falls along the end of the strip, then rises along its side.
//! A V whose flanks are as wide as its operation's is made deep enough by lowering it as a whole; the sides of a
//! narrower flank lie farther below its middle plane than that, and those of a wall lie beside it.

use crate::surface::Side;
use vcutc_geometry::curve::Point2;

/// A flank with the thickness of its blade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThickFlank {
    pub tip: Point2,
    /// Where it leans to.
    pub side: Side,
    /// Rise of its middle plane over x: positive, infinite for a wall.
    pub slope: f64,
    /// Half the thickness.
    pub half: f64,
}

impl ThickFlank {
    /// How far from the tip, on its side, the lower edge begins to rise.
    fn foot(self) -> f64 {
        if self.slope.is_infinite() {
            self.half
        } else {
            self.half * self.slope / libm::hypot(1.0, self.slope)
        }
    }

    /// How far its side lies below its middle plane along z; infinite for a wall.
    #[must_use]
    pub fn drop(self) -> f64 {
        if self.half > 0.0 {
            self.half * libm::hypot(1.0, self.slope)
        } else {
            0.0
        }
    }

    /// Height of the lower edge above the tip, so far from the tip on its side.
    #[must_use]
    pub fn lower(self, aside: f64) -> f64 {
        if aside <= self.foot() {
            return -aside / self.slope;
        }
        if self.slope.is_infinite() {
            return f64::INFINITY;
        }
        self.slope * aside - self.drop()
    }

    /// Where its lower edge comes lowest relative to a part, and by how much it stays above it there (negative: within). None
    /// where it lies beside the part.
    #[must_use]
    pub fn nearest(self, part: &[Point2]) -> Option<(Point2, f64)> {
        let sign = match self.side {
            Side::Left => -1.0,
            Side::Right => 1.0,
        };
        let gap = |aside: f64, part: f64| {
            let lower = self.lower(aside);
            let at = Point2 {
                x: self.tip.x + sign * aside,
                z: self.tip.z + if lower.is_finite() { lower } else { 0.0 },
            };
            (at, self.tip.z + lower - part)
        };
        // Both are straight between the part's corners and the two bends of the edge.
        let corners = part.iter().filter_map(|corner| {
            let aside = sign * (corner.x - self.tip.x);
            (aside >= 0.0).then(|| gap(aside, corner.z))
        });
        let bends = [0.0, self.foot()]
            .into_iter()
            .filter_map(|aside| Some(gap(aside, height(part, self.tip.x + sign * aside)?)));
        corners.chain(bends).min_by(|(_, a), (_, b)| a.total_cmp(b))
    }
}

/// Height of a polyline at x; none beside it.
fn height(line: &[Point2], x: f64) -> Option<f64> {
    let next = line.partition_point(|corner| corner.x < x);
    let to = line.get(next)?;
    match next.checked_sub(1).and_then(|before| line.get(before)) {
        Some(from) if to.x > from.x => Some(from.z + (to.z - from.z) * ((x - from.x) / (to.x - from.x))),
        Some(_) => Some(to.z),
        None => (to.x <= x).then_some(to.z),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The strip itself, point by point: its end and its side.
        #[test]
        fn the_lower_edge_is_that_of_the_strip(swing in 0.0..80.0_f64, half in 0.0..3.0_f64, along in 0.0..1.0_f64, up in 0.0..30.0_f64) {
            let (sine, cosine) = libm::sincos(swing.to_radians());
            let flank = ThickFlank { tip: Point2 { x: 0.0, z: 0.0 }, side: Side::Right, slope: cosine / sine, half };
            // `across` is square to the flank, towards the material that stays; `up` along it.
            let point = |across: f64, up: f64| (across * cosine + up * sine, up * cosine - across * sine);
            let (x, z) = point(half * along, 0.0);
            prop_assert!((flank.lower(x) - z).abs() < 1e-6 * (1.0 + flank.slope.min(1e6)) || half == 0.0);
            if swing > 0.1 {
                let (x, z) = point(half, up);
                prop_assert!((flank.lower(x) - z).abs() < 1e-6 * (1.0 + flank.slope));
            }
            for across in [-half, -half * along, 0.0, half * along, half] {
                let (x, z) = point(across, up);
                prop_assert!(x < 0.0 || swing < 0.1 || flank.lower(x) <= z + 1e-6 * (1.0 + flank.slope));
            }
        }
    }

    #[test]
    fn a_wall_goes_as_low_as_its_tip_over_half_its_thickness() {
        let wall = |x: f64| ThickFlank {
            tip: Point2 { x, z: 10.0 },
            side: Side::Right,
            slope: f64::INFINITY,
            half: 0.5,
        };
        // A step up at x 20.
        let part = [(0.0, 9.0), (20.0, 9.0), (20.0, 30.0), (40.0, 30.0)].map(|(x, z)| Point2 { x, z });
        let gap = |x: f64| wall(x).nearest(&part).unwrap().1;
        assert!((gap(19.4) - 1.0).abs() < 1e-12);
        assert!((gap(19.5 - 1e-9) - 1.0).abs() < 1e-12);
        assert!((gap(19.6) + 20.0).abs() < 1e-12);
    }
}
