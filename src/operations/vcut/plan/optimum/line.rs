//! The least time where one coordinate decides it: a proof of a few microseconds.
//!
//! Where reach and extension are the same whatever the overlap, the time falls with the layer and, on one layer, with the
//! step. So of all shapes of one swing none takes less than the widest step on the thickest layer that the blade reaches
//! would: a function of the swing alone, which leaves out every other bound. Its least is a bound from below for all shapes.
//! Where it is reached by a shape that keeps the other bounds too, nothing is better.
//!
//! The least is found by Newton's method within a bracket, and proven by intervals (Moore: Interval Analysis, 1966). Around it the
//! function is curved upwards, so that it falls no further below its value there than half the square of its slope
//! over its curvature, which is some rounding. Away from it, stretch by stretch, it stays above the least or falls towards it.
//! Where any of that fails, the search over all shapes decides.

use super::chart::Chart;
use super::formulas::{Model, Tooth};
use super::ground::{Found, Ground, Measure};
use vcutc_geometry::number::{Interval, OnLine, Scalar};

/// That nothing is less by this share is proven.
const GAP: f64 = 1e-12;

/// Most steps towards the least.
const MOST_STEPS: u32 = 60;

/// A step this short, as a share of the place, is the last.
const SHORT: f64 = 1e-9;

/// How far the first stretch that is tried around the least reaches, as a share of the place; each further one reaches half as
/// far.
const WIDEST: f64 = 0.4;

/// Most stretches that are tried around it.
const MOST_AROUND: u32 = 6;

/// The first stretch on a side of it is at least this long, as a share of the place.
const NEAREST: f64 = 0.1;

/// Most stretches that are tried on a side of it.
const MOST_ASIDE: u32 = 40;

/// The least of what is measured, where one coordinate decides it.
pub(super) fn best(model: &Model, measure: Measure) -> Option<Found> {
    let line = Line::new(model, measure)?;
    let bottom = line.bottom();
    let found = line.found(bottom)?;
    let least = found.value * (1.0 - GAP);
    line.proves(bottom, least).then_some(Found { gap: GAP, ..found })
}

/// What a swing comes to at least, by its tangent.
struct Line<'m> {
    model: &'m Model,
    measure: Measure,
    range: Interval,
}

impl<'m> Line<'m> {
    fn new(model: &'m Model, measure: Measure) -> Option<Self> {
        let asks = match measure {
            Measure::Time | Measure::Cuts => true,
            Measure::Breach => false,
        };
        let [low, high] = model.ranges.tangent;
        (asks && low <= high && model.is_least_at_widest()).then_some(Self {
            model,
            measure,
            range: Interval { low, high },
        })
    }

    fn at<N: Scalar>(&self, tangent: N) -> N {
        let cost = self.model.at_widest(tangent);
        match self.measure {
            Measure::Time | Measure::Breach => cost.time,
            Measure::Cuts => cost.cuts,
        }
    }

    /// Where it is likely least.
    fn bottom(&self) -> f64 {
        let mut bracket = self.range;
        let mut place = 1.0_f64.max(bracket.low).min(bracket.high);
        for _ in 0..MOST_STEPS {
            let jet = self.at(OnLine::coordinate(0, place));
            let ([slope], [curve]) = (jet.by, jet.curve);
            if (slope <= 0.0 && place >= bracket.high) || (slope >= 0.0 && place <= bracket.low) {
                return place;
            }
            if slope <= 0.0 {
                bracket.low = place;
            } else {
                bracket.high = place;
            }
            let aim = (curve > 0.0).then(|| place - slope / curve);
            let next = match aim {
                Some(aim) if aim > bracket.low && aim < bracket.high => aim,
                Some(aim) if aim >= self.range.high && place < self.range.high => self.range.high,
                Some(aim) if aim <= self.range.low && place > self.range.low => self.range.low,
                Some(_) | None => bracket.between(),
            };
            if (next - place).abs() <= SHORT * place {
                return next;
            }
            place = next;
        }
        place
    }

    /// The shape there, if it keeps all bounds.
    fn found(&self, tangent: f64) -> Option<Found> {
        let ground = Ground {
            model: self.model,
            chart: Chart::new(self.model, Tooth::Any)?,
            tooth: Tooth::Any,
            measure: self.measure,
        };
        ground.better(None, ground.chart.place(self.model.widest(tangent)))
    }

    /// Whether nothing is below `least`, which is a hair below what the bottom comes to.
    fn proves(&self, bottom: f64, least: f64) -> bool {
        let here = self.at(OnLine::coordinate(0, Interval::exactly(bottom)));
        if here.value.low < least {
            return false;
        }
        let around = self.around(bottom, &here, least);
        self.rises(bottom, around.low, self.range.low, least)
            && self.rises(bottom, around.high, self.range.high, least)
    }

    /// A stretch around the bottom in which nothing is below `least`.
    fn around(&self, bottom: f64, here: &OnLine<Interval>, least: f64) -> Interval {
        let slope = here.by[0].magnitude();
        let room = here.value.low - least;
        let mut reach = WIDEST;
        for _ in 0..MOST_AROUND {
            let stretch = Interval {
                low: (bottom * (1.0 - reach)).greater(self.range.low),
                high: (bottom * (1.0 + reach)).lesser(self.range.high),
            };
            let [curve] = self.at(OnLine::coordinate(0, stretch)).curve;
            // Twice what the slope may take, for rounding.
            if curve.low > 0.0 && slope * slope <= room * curve.low {
                return stretch;
            }
            reach *= 0.5;
        }
        Interval::exactly(bottom)
    }

    /// Whether nothing from a place outwards is below `least`: stretch by stretch, each about as long as it is far from the
    /// bottom.
    fn rises(&self, bottom: f64, from: f64, end: f64, least: f64) -> bool {
        let mut near = from;
        let mut length = (near - bottom).abs().greater(NEAREST * bottom);
        for _ in 0..MOST_ASIDE {
            if near == end {
                return true;
            }
            let (far, stretch) = if end < near {
                let low = (near - length).greater(end);
                (low, Interval { low, high: near })
            } else {
                let high = (near + length).lesser(end);
                (high, Interval { low: near, high })
            };
            let jet = self.at(OnLine::coordinate(0, stretch));
            let [slope] = jet.by;
            let falls_to_near = if far < near {
                slope.high <= 0.0
            } else {
                slope.low >= 0.0
            };
            if jet.value.low >= least || falls_to_near {
                near = far;
                length = (near - bottom).abs();
            } else {
                length *= 0.5;
            }
        }
        false
    }
}
