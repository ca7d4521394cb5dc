//! The machined contour by polygon clipping: one difference of the stock's rectangle and the triangles of all cuts.
//!
//! A cut takes out a triangle that stands on its tip. As high as the blade reaches it covers every chip of these jobs,
//! which is all that can be said before the cuts have been replayed, so the replay is compared with that.
//! Triangles just as high as the lattice's chips leave the same material too; they give the peers the least
//! overlap to resolve, but only because somebody knew the lattice. Either way the areas left are compared
//! before a time counts.
//!
//! Coordinates are whole micrometres, the grid that tips lie on, which both peers take without converting. Both peers
//! sweep along one axis, so how many edges are active at once depends on which way round the polygons lie: each peer gets
//! the way that is faster for it.

use clipper2_rust::core::{FillRule as ClipperFill, Paths64, Point64, area_paths};
use clipper2_rust::difference_64;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{IntOverlayOptions, Overlay};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;
use vcutc::job::PlannedJob;
use vcutc::simulation::prove::Replay;
use vcutc::vcut::PlannedVcut;

/// How high triangles are.
#[derive(Clone, Copy, Debug)]
pub enum Height {
    /// As high as the blade reaches.
    BladeReach,
    /// As high as a chip of the lattice.
    Chip,
}

/// Which axis the polygons' x is.
#[derive(Clone, Copy, Debug)]
pub enum Axes {
    /// x across the cuts, y up.
    AsDrawn,
    /// x up, y across the cuts.
    Swapped,
}

/// A corner in whole micrometres.
type Corner = (i64, i64);

/// The stock and what is cut away, in whole micrometres.
#[derive(Clone, Debug)]
pub struct Polygons {
    stock: [Corner; 4],
    chips: Vec<[Corner; 3]>,
}

impl Polygons {
    /// The polygons of a plan.
    #[must_use]
    pub fn new(plan: &PlannedJob, height: Height, axes: Axes) -> Self {
        let (width, top) = (
            micrometres(plan.stock.width.to_mm()),
            micrometres(plan.stock.height.to_mm()),
        );
        let turned = |(x, z): Corner| match axes {
            Axes::AsDrawn => (x, z),
            Axes::Swapped => (z, x),
        };
        let mut chips = Vec::new();
        for vcut in plan
            .operations
            .iter()
            .filter_map(|planned| PlannedVcut::of(&**planned))
        {
            let flanks = vcut.parameters.flanks;
            let reach = match height {
                Height::BladeReach => flanks.reach.to_mm(),
                // Teeth of a lattice without overlap are a layer high, and stand a layer above the next tip.
                Height::Chip => 2.0 * vcut.parameters.layer.to_mm(),
            };
            let (rise, run) = (micrometres(reach), micrometres(reach / flanks.slope));
            chips.extend(vcut.cuts.iter().map(|cut| {
                let (x, z) = (micrometres(cut.tip.x), micrometres(cut.tip.z));
                [(x, z), (x + run, z + rise), (x - run, z + rise)].map(turned)
            }));
        }
        Self {
            stock: [(0, 0), (width, 0), (width, top), (0, top)].map(turned),
            chips,
        }
    }

    /// The polygons in the form that Clipper2 takes.
    #[must_use]
    pub fn for_clipper(&self) -> (Paths64, Paths64) {
        let path = |corners: &[Corner]| {
            corners
                .iter()
                .map(|&(x, y)| Point64::new(x, y))
                .collect::<Vec<_>>()
        };
        (
            vec![path(&self.stock)],
            self.chips.iter().map(|chip| path(chip)).collect(),
        )
    }

    /// The polygons in the form that i_overlay takes.
    #[must_use]
    pub fn for_i_overlay(&self) -> (Contours, Contours) {
        let point = |&(x, y): &Corner| IntPoint::new(narrow(x), narrow(y));
        let contour = |corners: &[Corner]| corners.iter().map(point).collect::<Vec<_>>();
        (
            vec![contour(&self.stock)],
            self.chips.iter().map(|chip| contour(chip)).collect(),
        )
    }
}

/// Contours of i_overlay on its 32 bit grid.
pub type Contours = Vec<Vec<IntPoint<i32>>>;

/// Area in mm2 that is left, by Clipper2.
#[must_use]
pub fn clipper((stock, chips): &(Paths64, Paths64)) -> f64 {
    area_paths(&difference_64(stock, chips, ClipperFill::NonZero)).abs() * 1e-6
}

/// Area in mm2 that is left, by i_overlay.
#[must_use]
pub fn i_overlay((stock, chips): &(Contours, Contours)) -> f64 {
    let mut overlay = Overlay::<i32>::from_subj_and_clip_custom(
        stock,
        chips,
        IntOverlayOptions::default(),
        i_overlay::core::solver::Solver::default(),
    );
    let shapes = overlay.overlay(OverlayRule::Difference, FillRule::NonZero);
    shapes
        .iter()
        .flatten()
        .map(|contour| signed_area(contour))
        .sum::<f64>()
        .abs()
        * 1e-6
}

/// Area in mm2 that is left, by the compiler's own replay.
#[must_use]
pub fn ours(replay: &Replay) -> f64 {
    let corners: Vec<_> = replay.surface.corners().collect();
    corners
        .windows(2)
        .map(|pair| (pair[1].x - pair[0].x) * (pair[0].z + pair[1].z) / 2.0)
        .sum()
}

/// Makes sure that the peer answers the same question.
///
/// # Panics
/// When the areas differ by more than 1e-4 of ours.
pub fn assert_same_area(peer: &str, theirs: f64, ours: f64) {
    assert!(
        (theirs - ours).abs() <= 1e-4 * ours,
        "{peer} leaves {theirs} mm2, the replay {ours} mm2"
    );
}

fn signed_area(contour: &[IntPoint<i32>]) -> f64 {
    let next = contour.iter().cycle().skip(1);
    let doubled: f64 = contour
        .iter()
        .zip(next)
        .map(|(a, b)| f64::from(a.x) * f64::from(b.y) - f64::from(b.x) * f64::from(a.y))
        .sum();
    doubled / 2.0
}

fn micrometres(mm: f64) -> i64 {
    (mm * 1000.0).round() as i64
}

fn narrow(micrometres: i64) -> i32 {
    i32::try_from(micrometres).expect("the job is less than two kilometres wide")
}
