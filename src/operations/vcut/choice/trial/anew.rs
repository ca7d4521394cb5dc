//! The spread once more, ranked by what its cuts would come to.
//!
//! The mean-value model reckons with the mean depth and with a turn of the blade at every V. Thick layers of close columns, cut
//! layer by layer, it sees as slow, and the plans that may be made are then spent on others. Counting the visits of every
//! column costs next to nothing, and tells such lattices apart. What comes of it is compared with what was found before, so
//! nothing is lost by it.

use super::spread::Spot;
use super::{AHEAD, Trials, alike};
use crate::asked::{Lattice, Objective};
use crate::choice::MOST_CUTS_COMPARED;
use crate::plan::lattice::{Column, Layout, Parity, Row};
use crate::plan::parameters::{Swung, VcutParameters};
use crate::plan::residual::least_gain;
use vcutc_backend_api::units::Angle;
use vcutc_geometry::cone;
use vcutc_geometry::profile::Profile;
use vcutc_job::{Auto, Order};

/// Most plans, by the number of cuts of the best one, as [`PLANS`](super::PLANS); and most lattices that are looked at for them.
const PLANS: [(usize, usize); 3] = [(500, 48), (2_000, 16), (MOST_CUTS_COMPARED, 2)];
const LOOKED_AT: [(usize, usize); 3] = [(500, 1_500), (2_000, 200), (MOST_CUTS_COMPARED, 10)];

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
            Lattice::Free => &[Self::None],
        }
    }

    const fn are_on_the_part(self, parity: Parity) -> bool {
        match (self, parity) {
            (Self::None, _) | (Self::Odd, Parity::Even) | (Self::Even, Parity::Odd) => false,
            (Self::Both, _) | (Self::Odd, Parity::Odd) | (Self::Even, Parity::Even) => true,
        }
    }
}

/// Parameters, and what the objective comes to by the count of their cuts.
struct Reckoned {
    parameters: VcutParameters,
    ends: Ends,
    merit: f64,
}

/// How often a column is cut, and how deep at last.
struct Visits {
    count: f64,
    depth: f64,
}

/// How much goes with so many cuts.
fn by_cuts(table: &[(usize, usize)], cuts: usize) -> usize {
    table
        .iter()
        .find(|(below, _)| cuts < *below)
        .map_or(1, |&(_, most)| most)
}

impl Trials<'_> {
    /// Plans what by the count of its cuts is better than the best one and leaves little enough, the best first, and goes on from
    /// there as before.
    pub(super) fn anew(&mut self) {
        let Some(best) = self.sound.first() else { return };
        if self.asked.limits.scallop.is_none() {
            return;
        }
        let looked_at = by_cuts(&LOOKED_AT, best.figures.cuts);
        (self.plans_left, self.most_plans) = (None, &PLANS);
        let before = self.best_merit();
        let mut reckoned = self.reckoned();
        reckoned.sort_by(|one, other| one.merit.total_cmp(&other.merit));
        reckoned.retain(|one| {
            !self
                .tried
                .iter()
                .any(|tried| alike(&tried.parameters, &one.parameters))
        });
        let mut next = reckoned.into_iter().take(looked_at).peekable();
        while next.peek().is_some() && self.may_go_on() {
            let mut worth: Vec<Reckoned> = Vec::new();
            while worth.len() < AHEAD
                && let Some(one) = next.next()
            {
                worth.extend(Some(one).filter(|one| self.is_promised(one.merit) && self.leaves_little(one)));
            }
            self.plan_ahead(worth.iter().map(|one| &one.parameters));
            for one in worth {
                self.weigh(one.parameters);
            }
        }
        if self.best_merit() < before {
            (self.plans_left, self.most_plans) = (None, &super::PLANS);
            self.wander();
            self.comb();
        }
    }

    /// Whether what is reckoned with leaves no more than it may.
    fn leaves_little(&self, one: &Reckoned) -> bool {
        let Some(limit) = self.asked.limits.scallop else {
            return true;
        };
        let found = &one.parameters;
        if found.lattice == Lattice::Free {
            return self.may_be_sound(found);
        }
        let followed = self.floor.followed(found.flanks.slope);
        followed
            .of_tips(found, limit.value, |column, parity| {
                self.stop(found, column, parity, one.ends)
            })
            .is_some()
    }

    fn best_merit(&self) -> f64 {
        let best = self.sound.first();
        best.map_or(f64::INFINITY, |best| {
            best.figures.merit(self.asked.objective.value)
        })
    }

    /// Whether what is reckoned is better than the best one reckoned in the same way.
    fn is_promised(&self, reckoned: f64) -> bool {
        self.sound.first().is_none_or(|best| {
            let found = &best.parameters;
            let clearance = self.clearance(found);
            let layout = Layout::new(self.bench.job.stock, found.lattice, found, &clearance);
            reckoned < self.merit(found, &layout, best.figures.cuts as f64)
        })
    }

    /// Parameters that are reckoned to be better than the best.
    fn reckoned(&self) -> Vec<Reckoned> {
        let mut spots = self.spots();
        spots.extend(self.closer_spots());
        let mut found: Vec<Reckoned> = Vec::new();
        let mut clearance: Option<(Angle, Profile)> = None;
        spots.sort_by(|one, other| one.parameters.swing.total_cmp(&other.parameters.swing));
        for Spot { parameters, .. } in spots {
            let is_same = |(swing, _): &(Angle, Profile)| *swing == parameters.swing;
            if !clearance.as_ref().is_some_and(is_same) {
                clearance = Some((parameters.swing, self.clearance(&parameters)));
            }
            let Some((_, of_swing)) = &clearance else { continue };
            for &ends in Ends::of(parameters.lattice) {
                let merit = self.reckon(&parameters, of_swing, ends);
                let parameters = parameters.clone();
                found.push(Reckoned {
                    parameters,
                    ends,
                    merit,
                });
            }
        }
        found
    }

    /// Close columns in the thickest layers, and some thinner ones: on interlaced lattices each row alone may have to leave little
    /// enough, where it is visited once only.
    fn closer_spots(&self) -> Vec<Spot> {
        let mut spots = Vec::new();
        let Some(limit) = self.asked.limits.scallop else {
            return spots;
        };
        for &lattice in self.lattices {
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
        self.merit(found, &layout, self.count(found, &layout, ends))
    }

    /// What the objective comes to with so many cuts.
    fn merit(&self, found: &VcutParameters, layout: &Layout<'_>, cuts: f64) -> f64 {
        match self.asked.objective.value {
            Objective::Cuts => cuts,
            Objective::Time | Objective::Scallop | Objective::BladeLoad => {
                self.seconds(found, cuts, f64::from(layout.layers()))
            }
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
                    let model = found.time_model(&self.bench.job, self.asked);
                    return model.cuts(found.layer, found.step);
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
            (Lattice::Orthogonal | Lattice::Free, Parity::Odd | Parity::Even) => (layer, layer),
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

    /// The time of so many cuts along the better of the orders that are open.
    fn seconds(&self, found: &VcutParameters, cuts: f64, layers: f64) -> f64 {
        let model = found.time_model(&self.bench.job, self.asked);
        let turn = Angle::rad(2.0 * libm::acos(found.swing.cos() * model.rake.sin())) / model.reorient_rate;
        let passes = (2.0 * model.depth + 4.0 * model.extension) / model.cut_feed;
        let across = found.step / model.travel_feed;
        let by_point = (passes + turn + turn.max(across)) * cuts;
        let by_layer = (passes + across + across) * cuts + turn * (2.0 * layers);
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
}
