//! What is forecast of the parameters of the spread, so that the best come first.
//!
//! The mean-value model reckons with the mean depth and with a turn of the blade at every V. Thick layers of close columns, cut
//! layer by layer, it sees as slow, and the plans that may be made are then spent on others. Counting the visits of every
//! column costs almost nothing, and distinguishes such lattices. Where redundant Vs are skipped, the
//! distance of the tips counts as well ([`SHARE`]).

use super::Trials;
use crate::PlannedVcut;
use crate::asked::{Lattice, Objective, Residual};
use crate::choice::MOST_CUTS_COMPARED;
use crate::choice::redundant::Skipping;
use crate::plan::fitted::{Fitting, Testing};
use crate::plan::lattice::{Column, Layout, Parity, Row};
use crate::plan::parameters::{Swung, VcutParameters};
use crate::plan::residual::least_gain;
use vcutc_backend_api::units::{Angle, Duration};
use vcutc_geometry::cone;
use vcutc_geometry::profile::Profile;
use vcutc_job::{Auto, Order};

/// How much what is cut with all its Vs counts for what is cut without the redundant ones; the rest counts how far the tips are
/// apart.
const SHARE: f64 = 0.4;

/// Steps, as shares of the one that leaves as much as may stay on a level part.
const STEPS: [f64; 6] = [1.0, 0.88, 0.77, 0.68, 0.56, 0.45];

/// How many of the swings that can leave little enough, the widest first, are tried with them.
const SWINGS: usize = 6;

/// Of which rows of columns the last tips are put onto the part; those of the others lie in their layers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ends {
    None,
    /// Of those of the first layer; orthogonal lattices have no others.
    Odd,
    Even,
    Both,
}

impl Ends {
    /// All that differ on a lattice.
    const fn of(lattice: Lattice) -> &'static [Self] {
        match lattice {
            Lattice::Interlaced => &[Self::None, Self::Odd, Self::Even, Self::Both],
            Lattice::Orthogonal => &[Self::None, Self::Odd],
            Lattice::Free | Lattice::Fitted => &[Self::None],
        }
    }

    const fn are_on_the_part(self, parity: Parity) -> bool {
        match (self, parity) {
            (Self::None, _) | (Self::Odd, Parity::Even) | (Self::Even, Parity::Odd) => false,
            (Self::Both, _) | (Self::Odd, Parity::Odd) | (Self::Even, Parity::Even) => true,
        }
    }
}

/// Parameters with what is forecast of them.
pub(super) struct Forecast {
    pub(super) parameters: VcutParameters,
    ends: Ends,
    /// The smaller, the better.
    merit: f64,
}

/// How often a column is cut, and how deep at last.
struct Visits {
    count: f64,
    depth: f64,
}

impl Trials<'_> {
    /// Whether a lattice leaves no more than it may, by its last tips.
    pub(super) fn leaves_little(&self, one: &Forecast) -> bool {
        let Some(limit) = self.asked.limits.scallop else {
            return true;
        };
        let found = &one.parameters;
        if matches!(found.lattice, Lattice::Free | Lattice::Fitted) {
            return self.may_be_sound(found);
        }
        let followed = self.floor.followed(found.flanks.slope);
        followed
            .of_tips(found, limit.value, |column, parity| {
                self.stop(found, column, parity, one.ends)
            })
            .is_some()
    }

    /// Whether it does so with last tips where the residual strategy may put them: `discard` puts none onto the part.
    pub(super) fn is_likely_sound(&self, one: &Forecast) -> bool {
        let discards = self.asked.residual.value == Auto::Given(Residual::Discard);
        (one.ends == Ends::None || !discards) && self.leaves_little(one)
    }

    /// All parameters of the spread, those first of which the best is forecast.
    pub(super) fn forecasts(&self) -> Vec<Forecast> {
        let mut spots = self.spots();
        spots.extend(self.closer_spots());
        let mut found: Vec<Forecast> = Vec::new();
        spots.sort_by(|one, other| one.swing.total_cmp(&other.swing));
        for of_swing in spots.chunk_by(|one, next| one.swing == next.swing) {
            let Some(first) = of_swing.first() else { continue };
            let clearance = self.clearance(first);
            let mut fitting = Fitting::new(
                &self.bench.job,
                self.asked,
                first,
                &clearance,
                self.bench.work().before,
                self.bench.cuts_left.min(MOST_CUTS_COMPARED),
            )
            .tested(Testing::AtPeaks);
            for parameters in of_swing {
                if parameters.lattice == Lattice::Fitted {
                    self.add_fitted(parameters, &mut fitting, &mut found);
                    continue;
                }
                for &ends in Ends::of(parameters.lattice) {
                    let with_all = self.reckon(parameters, &clearance, ends);
                    found.push(Forecast {
                        merit: self.forecast(parameters, with_all),
                        parameters: parameters.clone(),
                        ends,
                    });
                }
            }
        }
        found.sort_by(|one, other| one.merit.total_cmp(&other.merit));
        found
    }

    /// What is forecast, from what the objective comes to with all Vs. Without the redundant ones as many remain as the scallop
    /// needs, on the part, and as the blade's reach needs above it: close steps and thick layers lose most.
    fn forecast(&self, found: &VcutParameters, with_all: f64) -> f64 {
        if Skipping::of(&self.bench.job, self.asked) == Skipping::Never {
            return with_all;
        }
        let apart = match found.lattice {
            Lattice::Interlaced => found.step / 2.0,
            Lattice::Orthogonal | Lattice::Free | Lattice::Fitted => found.step,
        };
        libm::pow(with_all, SHARE) * libm::pow(apart.to_mm(), SHARE - 1.0)
    }

    /// Close columns in the thickest layers, and some thinner ones: on interlaced lattices each row alone may have to leave little
    /// enough, where it is visited once only.
    fn closer_spots(&self) -> Vec<VcutParameters> {
        let mut spots = Vec::new();
        let Some(limit) = self.asked.limits.scallop else {
            return spots;
        };
        for &lattice in self
            .lattices
            .iter()
            .filter(|lattice| **lattice != Lattice::Fitted)
        {
            for swing in self.swings().into_iter().take(SWINGS) {
                let Some(swung) = Swung::new(self.asked, lattice, swing) else {
                    continue;
                };
                let room = limit.value - self.asked.allowance.value - swung.drop();
                let level = room * (2.0 / swung.flanks.slope);
                for share in STEPS {
                    self.spots_of_step(&swung, level * share, &mut spots);
                }
            }
        }
        spots
    }

    fn clearance(&self, found: &VcutParameters) -> Profile {
        cone::clearance(self.bench.work().bound, found.flanks.slope)
    }

    /// What the objective comes to by the count of cuts: seconds, or cuts.
    fn reckon(&self, found: &VcutParameters, clearance: &Profile, ends: Ends) -> f64 {
        let layout = Layout::new(self.bench.job.stock, found.lattice, found, clearance);
        self.merit(
            found,
            f64::from(layout.layers()),
            self.count(found, &layout, ends),
        )
    }

    /// Adds parameters of a fitted lattice with what their tips come to, where they fit: of steps that come to the same, the first one.
    fn add_fitted(&self, parameters: &VcutParameters, fitting: &mut Fitting<'_>, found: &mut Vec<Forecast>) {
        let is_of_layer = |last: &Forecast| last.parameters.layer == parameters.layer;
        if found.last().is_some_and(is_of_layer) && !fitting.is_narrowed_by(parameters.step) {
            return;
        }
        let Ok(rows) = fitting.rows(parameters) else {
            return;
        };
        let cuts: usize = rows.iter().map(Vec::len).sum();
        let merit = self.merit(parameters, rows.len() as f64, cuts as f64);
        found.push(Forecast {
            merit,
            parameters: parameters.clone(),
            ends: Ends::None,
        });
    }

    /// What the objective comes to with so many layers and cuts.
    fn merit(&self, found: &VcutParameters, layers: f64, cuts: f64) -> f64 {
        match self.asked.objective.value {
            Objective::Cuts => cuts,
            Objective::Time | Objective::Scallop | Objective::BladeLoad => self.seconds(found, cuts, layers),
        }
    }

    /// How many cuts the columns of a lattice come to; by the model where it has none.
    fn count(&self, found: &VcutParameters, layout: &Layout<'_>, ends: Ends) -> f64 {
        let mut cuts = 0.0;
        let mut seen: Option<Parity> = None;
        for row in [layout.row(1), layout.row(2)] {
            match row {
                Row::Columns { parity, .. } if seen == Some(parity) => {}
                Row::Columns { parity, columns } => {
                    seen = Some(parity);
                    let visits = columns
                        .iter()
                        .map(|column| self.visits(found, *column, parity, ends).count);
                    cuts += visits.sum::<f64>();
                }
                Row::Free(_) => {
                    return found.estimated_cuts(&self.bench.job, self.asked);
                }
            }
        }
        cuts
    }

    /// How low the last tip of a column lies; none where none is cut.
    fn stop(&self, found: &VcutParameters, column: Column, parity: Parity, ends: Ends) -> Option<f64> {
        let visits = self.visits(found, column, parity, ends);
        (visits.count > 0.0).then(|| self.bench.job.stock.height.to_mm() - visits.depth)
    }

    /// How often a column is cut: at every layer of its row down to the part, and once more on the part where that takes enough.
    fn visits(&self, found: &VcutParameters, column: Column, parity: Parity, ends: Ends) -> Visits {
        let layer = found.layer.to_mm();
        let floor = self.bench.job.stock.height.to_mm() - column.floor;
        let (first, apart) = match (found.lattice, parity) {
            (Lattice::Interlaced, Parity::Odd) => (layer, 2.0 * layer),
            (Lattice::Interlaced, Parity::Even) => (2.0 * layer, 2.0 * layer),
            (Lattice::Orthogonal | Lattice::Free | Lattice::Fitted, Parity::Odd | Parity::Even) => {
                (layer, layer)
            }
        };
        let count = (((floor - first) / apart).floor() + 1.0).max(0.0);
        let depth = if count > 0.0 {
            first + (count - 1.0) * apart
        } else {
            0.0
        };
        let worth = least_gain(self.asked, found.layer).to_mm();
        if ends.are_on_the_part(parity) && floor - depth > worth {
            Visits {
                count: count + 1.0,
                depth: floor,
            }
        } else {
            Visits { count, depth }
        }
    }

    /// The order of the flanks by which an operation is reckoned to be faster.
    pub(super) fn faster_order(&self, vcut: &PlannedVcut) -> Order {
        let layers = vcut.cuts.last().map_or(0, |cut| cut.layer);
        let [by_point, by_layer] = self.by_order(&vcut.parameters, vcut.cuts.len() as f64, f64::from(layers));
        if by_layer < by_point {
            Order::Layer
        } else {
            Order::Point
        }
    }

    /// The time of so many cuts along the better of the orders that are open.
    fn seconds(&self, found: &VcutParameters, cuts: f64, layers: f64) -> f64 {
        let [by_point, by_layer] = self.by_order(found, cuts, layers);
        let order = match (self.asked.order.value, self.bench.latitude.order()) {
            (Auto::Given(order), _) => Some(order),
            (Auto::Auto, only) => only,
        };
        match order {
            Some(Order::Point) => by_point.to_s(),
            Some(Order::Layer) => by_layer.to_s(),
            None => by_point.min(by_layer).to_s(),
        }
    }

    /// The time of so many cuts by point and by layer.
    fn by_order(&self, found: &VcutParameters, cuts: f64, layers: f64) -> [Duration; 2] {
        let model = found.time_model(&self.bench.job, self.asked);
        let turn = Angle::rad(2.0 * libm::acos(found.swing.cos() * model.rake.sin())) / model.reorient_rate;
        let passes = (2.0 * model.depth + 4.0 * model.extension) / model.cut_feed;
        let across = match found.lattice {
            Lattice::Orthogonal | Lattice::Interlaced | Lattice::Free => found.step,
            Lattice::Fitted => model.width * (layers / cuts),
        } / model.travel_feed;
        let by_point = (passes + turn + turn.max(across)) * cuts;
        let by_layer = (passes + across + across) * cuts + turn * (2.0 * layers);
        [by_point, by_layer]
    }
}
