//! The least that a lattice can leave: every tip as low as the part lets it.
//!
//! No tip that stays in its column lies lower than the part allows there, whatever the layer and the residual strategy. So no
//! such plan leaves less than the lower envelope of the Vs at those lowest tips (`docs/process.md`, "Choices"). That envelope
//! costs a small share of a plan, which makes it the first thing to look at: a swing or a step that leaves too much even so
//! need not be planned. Only tips that are moved sideways escape it.

use super::Work;
use super::lattice::{Column, Layout, Parity, Row};
use super::parameters::VcutParameters;
use vcutc_backend_api::units::Length;
use vcutc_geometry::cone;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::PlanningJob;
use vcutc_simulation::surface::{Surface, Vee};

/// Most corners that are compared with the part: of longer contours every second one, or every third, and so on.
const MOST_CORNERS: usize = 4000;

/// An operation on what those before it left, to be asked what lattices leave of it.
pub struct Floor<'f> {
    job: &'f PlanningJob<'f>,
    bound: &'f Profile,
    before: &'f Surface,
}

/// What flanks of one slope can follow of the part.
pub struct Followed<'f> {
    floor: &'f Floor<'f>,
    slope: f64,
    clearance: Profile,
}

impl<'f> Floor<'f> {
    /// For one operation.
    #[must_use]
    pub const fn new(job: &'f PlanningJob<'f>, work: Work<'f>) -> Self {
        let Work { before, bound, .. } = work;
        Self { job, bound, before }
    }

    /// With flanks of a slope.
    #[must_use]
    pub fn followed(&'f self, slope: f64) -> Followed<'f> {
        Followed {
            floor: self,
            slope,
            clearance: cone::clearance(self.bound, slope),
        }
    }
}

impl Followed<'_> {
    /// The least that can stay, whatever the step, with tips `drop` above the V that may be made. None where that is more
    /// than `most`.
    #[must_use]
    pub fn of_flanks(&self, drop: Length, most: Length) -> Option<Length> {
        let mut before = self.floor.before.clone();
        let corners = self.clearance.points().iter().map(|corner| Point2 {
            x: corner.x,
            z: (corner.z + drop.to_mm()).min(before.height(corner.x)),
        });
        self.floor.farthest(corners.collect(), most)
    }

    /// The least that a lattice can leave with its tips in their columns; none where that is more than `most`. Free lattices
    /// have no columns: what their flanks can leave is theirs.
    #[must_use]
    pub fn of_lattice(&self, parameters: &VcutParameters, most: Length) -> Option<Length> {
        self.of_tips(parameters, most, |column, _| Some(column.floor))
    }

    /// What a lattice leaves whose columns are cut down to these heights at last; none where that is more than `most`, or, of
    /// free lattices, where their flanks cannot leave so little.
    #[must_use]
    pub fn of_tips(
        &self,
        parameters: &VcutParameters,
        most: Length,
        last: impl Fn(Column, Parity) -> Option<f64>,
    ) -> Option<Length> {
        let slope = self.slope;
        let layout = Layout::new(
            self.floor.job.stock,
            parameters.lattice,
            parameters,
            &self.clearance,
        );
        let mut surface = self.floor.before.clone();
        for layer in [1, 2] {
            match layout.row(layer) {
                Row::Columns { parity, columns } => {
                    for &column in columns {
                        if let Some(z) = last(column, parity) {
                            let tip = Point2 { x: column.x, z };
                            surface.release(Vee::even(tip, slope));
                        }
                    }
                }
                Row::Free(_) => return self.of_flanks(parameters.drop, most),
            }
        }
        self.floor.farthest(surface.corners().collect(), most)
    }
}

impl Floor<'_> {
    /// The distance of the corner farthest from the part; none as soon as one is farther than `most`.
    fn farthest(&self, corners: Vec<Point2>, most: Length) -> Option<Length> {
        let stride = corners.len().div_ceil(MOST_CORNERS).max(1);
        // As much as a plan may be over its limit by rounding.
        let most = most + Length::mm(1e-3);
        corners
            .into_iter()
            .step_by(stride)
            .try_fold(Length::ZERO, |farthest, corner| {
                // The point straight below is found faster, and the nearest one is no farther away.
                let below = (corner.z - self.job.profile.height(corner.x)).abs();
                if below <= farthest.to_mm() {
                    return Some(farthest);
                }
                let distance = Length::mm(self.job.profile.nearest_distance(corner));
                (distance <= most).then(|| farthest.max(distance))
            })
    }
}
