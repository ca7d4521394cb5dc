//! Tests of plans: the numbers of the comparison of both processes, and an independent simulation of slits and passes.

mod counted;
mod judge;
mod judged;
mod leaning;
mod published;
mod slopes;
mod traps;

use super::automatic::plan;
use super::blades::{Cover, Knife, Shaft, Wheel};
use super::model::Pace;
use super::refusal::{Exceeded, Over, Refusal};
use super::{Blades, Limits, PlannedRect, Rounding, Slit, Stage, Strip, StripOrigin, WORTH, Wish, Work};
use crate::asked::Residual;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::{Angle, AngularSpeed, Duration, Length, Speed};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::Auto;

/// The straight blade of the comparison, d = 10 mm, and a disc that takes what it is given.
fn blades() -> Blades {
    Blades {
        knife: Knife {
            edge: Length::mm(12.543),
            half_apex: Angle::deg(7.13),
            rake: Angle::deg(60.0),
            standoff: Length::ZERO,
            covers: Cover::Uncut,
        },
        shank: None,
        wheel: Wheel {
            radius: Length::mm(25.0),
            depth: Length::mm(100.0),
            width: Length::mm(100.0),
            body: vec![Shaft {
                from: Length::ZERO,
                radius: Length::mm(8.0),
            }],
            beyond: Length::ZERO,
            clearance: Length::mm(1.0),
            lead: Angle::ZERO,
        },
        pace: Pace {
            slit: Speed::mm_per_s(10_000.0 / 60.0),
            free: Speed::mm_per_s(6_000.0 / 60.0),
            travel: Speed::mm_per_s(100_000.0),
            reorient: AngularSpeed::deg_per_s(10_000.0),
            change: Duration::s(10.0),
            change_way: Duration::ZERO,
            run_out: Length::ZERO,
            clearance: Length::mm(10.0),
        },
    }
}

/// Layers and strips of 10 mm, wherever formulas put them, whatever little they gain.
fn wish(residual: Residual) -> Wish {
    Wish {
        layer: Auto::Given(Length::mm(10.0)),
        step: Auto::Given(Length::mm(10.0)),
        through: Auto::Given(1),
        residual: Auto::Given(residual),
        down_to: Length::ZERO,
        limits: Limits::default(),
        rounding: Rounding::Exact,
        worth: 0.0,
    }
}

/// A part in its stock.
#[derive(Clone, Debug)]
struct Sample {
    part: Profile,
    width: f64,
    height: f64,
    /// What stands before.
    before: Vec<Point2>,
}

impl Sample {
    fn new(points: Vec<Point2>, height: f64) -> Self {
        let width = points.last().unwrap().x;
        Self {
            part: Profile::new(points).unwrap(),
            width,
            height,
            before: vec![Point2::new(0.0, height), Point2::new(width, height)],
        }
    }

    /// Through these corners.
    fn through(corners: &[(f64, f64)], height: f64) -> Self {
        Self::new(corners.iter().map(|&(x, z)| Point2::new(x, z)).collect(), height)
    }

    /// A height for every x, in steps of a tenth of a millimetre.
    fn formula(width: u32, height: f64, z: impl Fn(f64) -> f64) -> Self {
        let points = (0..=10 * width).map(|i| {
            let x = f64::from(i) / 10.0;
            Point2::new(x, z(x))
        });
        Self::new(points.collect(), height)
    }

    /// A cubic curve.
    fn bezier(control: [(f64, f64); 4], height: f64) -> Self {
        const PIECES: u32 = 2000;
        let points = (0..=PIECES).map(|i| {
            let t = f64::from(i) / f64::from(PIECES);
            let u = 1.0 - t;
            let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
            let sum = |part: fn((f64, f64)) -> f64| {
                weights
                    .iter()
                    .zip(control)
                    .map(|(weight, point)| weight * part(point))
                    .sum::<f64>()
            };
            Point2::new(sum(|(x, _)| x), sum(|(_, z)| z))
        });
        Self::new(points.collect(), height)
    }

    /// The part of the language page.
    fn language() -> Self {
        Self::bezier([(0.0, 18.0), (20.0, 30.0), (60.0, 34.0), (85.0, 14.0)], 50.0)
    }

    fn straight() -> Self {
        Self::through(&[(0.0, 10.0), (100.0, 40.0)], 50.0)
    }

    fn hill() -> Self {
        Self::formula(100, 50.0, |x| {
            40.0 - 30.0 * ((x - 50.0) / 50.0) * ((x - 50.0) / 50.0)
        })
    }

    fn valley() -> Self {
        Self::formula(100, 50.0, |x| {
            10.0 + 30.0 * ((x - 50.0) / 50.0) * ((x - 50.0) / 50.0)
        })
    }

    fn flat(width: f64, height: f64) -> Self {
        Self::through(&[(0.0, 10.0), (width, 10.0)], height)
    }

    fn stock(&self) -> Stock {
        Stock {
            width: Length::mm(self.width),
            depth: Length::mm(1000.0),
            height: Length::mm(self.height),
        }
    }

    fn work(&self) -> Work<'_> {
        Work {
            stock: self.stock(),
            part: &self.part,
            bound: &self.part,
            before: &self.before,
            allowance: Length::ZERO,
        }
    }

    fn plan(&self, blades: &Blades, wish: &Wish) -> Result<PlannedRect, Refusal> {
        plan(self.work(), blades, wish, 100_000)
    }
}
