//! Rectangular cutting: layers of slits, then a disc that frees the strips between them from the left, in the section alone.
//!
//! Jobs grow in both directions, as real ones do; what lies below a disc stays the same. The peer takes each layer's strips off
//! as rectangles, all at once.

use clipper2_rust::core::{FillRule as ClipperFill, Paths64, Point64, area_paths};
use clipper2_rust::difference_64;
use vcutc::geometry::curve::Point2;
use vcutc::geometry::profile::Profile;
use vcutc::simulation::cross_section::{CrossSection, Guard};
use vcutc::simulation::disc::{Disc, DiscPass};
use vcutc::simulation::surface::{Side, Surface};
use vcutc_backend_api::ir::BodyStage;
use vcutc_backend_api::units::{Angle, Length};

/// Height of a layer and width of a strip, in mm.
const STEP: f64 = 10.0;

/// How far the rim goes beyond a slit, in mm.
const BEYOND: f64 = 0.5;

/// Slits and passes of a job.
#[derive(Debug)]
pub struct Strips {
    columns: u32,
    layers: u32,
    lead: Angle,
    part: Profile,
    disc: Disc,
}

impl Strips {
    /// About so many slits and passes in all.
    #[must_use]
    pub fn new(cuts: u32, lead: Angle) -> Self {
        let layers = ((f64::from(cuts) / 8.0).sqrt() as u32).max(1);
        let columns = cuts / 2 / layers;
        // A part below all floors, with as many corners as curves have.
        let width = f64::from(columns) * STEP;
        let points = (0..=columns * 40).map(|i| {
            let x = width * f64::from(i) / f64::from(columns * 40);
            Point2::new(x, 2.0 + zigzag(i))
        });
        let stage = |from, radius| BodyStage {
            from: Length::mm(from),
            radius: Length::mm(radius),
        };
        Self {
            columns,
            layers,
            lead,
            part: Profile::new(points.collect()).expect("x increases"),
            disc: Disc {
                radius: Length::mm(25.0),
                depth: None,
                width: None,
                body: vec![stage(0.0, 8.0), stage(60.0, 25.0)],
            },
        }
    }

    /// How many slits and passes there are.
    #[must_use]
    pub fn cuts(&self) -> u64 {
        2 * u64::from(self.columns) * u64::from(self.layers)
    }

    fn width(&self) -> f64 {
        f64::from(self.columns) * STEP
    }

    fn top(&self) -> f64 {
        f64::from(self.layers + 1) * STEP
    }

    /// The section that is left.
    ///
    /// # Panics
    /// When a pass finds fault with anything.
    #[must_use]
    pub fn ours(&self) -> CrossSection {
        let mut section = CrossSection::new(Surface::flat(self.width(), self.top()));
        let guard = Guard::new(&self.part);
        for layer in 1..=self.layers {
            let floor = self.top() - f64::from(layer) * STEP;
            for column in 1..=self.columns {
                let pass = self.pass(column, floor);
                let x = f64::from(column) * STEP;
                section.slit(x, pass.rim(&self.disc).height(x));
            }
            for column in 1..=self.columns {
                let outcome = section.pass(&self.disc, &self.pass(column, floor), &guard);
                assert!(
                    outcome.faults.is_empty() && !outcome.freed.is_empty(),
                    "{layer} {column} {outcome:?}"
                );
            }
        }
        section
    }

    fn pass(&self, column: u32, floor: f64) -> DiscPass {
        let x = f64::from(column) * STEP + BEYOND - self.disc.radius.to_mm();
        DiscPass {
            centre: Point2::new(x, floor),
            lead: self.lead,
            side: Side::Right,
            beyond: Length::mm(BEYOND),
            shave: None,
            clearance: Length::mm(1.0),
        }
    }

    /// Area in mm2 that a section has.
    #[must_use]
    pub fn area(section: &mut CrossSection) -> f64 {
        let corners: Vec<_> = section.surface().corners().collect();
        let below = corners
            .windows(2)
            .map(|pair| (pair[1].x - pair[0].x) * (pair[0].z + pair[1].z) / 2.0);
        below.sum()
    }

    /// The stock and all strips of level passes, in whole micrometres.
    #[must_use]
    pub fn for_clipper(&self) -> (Paths64, Paths64) {
        let rectangle = |x: [f64; 2], z: [f64; 2]| {
            [(0, 0), (1, 0), (1, 1), (0, 1)]
                .map(|(i, j): (usize, usize)| {
                    Point64::new((x[i] * 1e3).round() as i64, (z[j] * 1e3).round() as i64)
                })
                .to_vec()
        };
        let strips = (1..=self.layers).flat_map(|layer| {
            let floor = self.top() - f64::from(layer) * STEP;
            (1..=self.columns).map(move |column| {
                let x = f64::from(column) * STEP;
                rectangle([x - STEP, x], [floor, floor + STEP])
            })
        });
        let stock = rectangle([0.0, self.width()], [0.0, self.top()]);
        (vec![stock], strips.collect())
    }
}

/// Up and down again.
fn zigzag(i: u32) -> f64 {
    f64::from(i % 7) * 0.1
}

/// Area in mm2 that is left, by Clipper2.
#[must_use]
pub fn clipper((stock, strips): &(Paths64, Paths64)) -> f64 {
    area_paths(&difference_64(stock, strips, ClipperFill::NonZero)).abs() * 1e-6
}
