//! The forces of teeth that mill, from the thickness of the chips that they take.
//!
//! A tooth that has turned by `t` since it came in takes a chip of the thickness `s sin t`, where `s` is the feed for each tooth [Ha 2019,
//! equation 33]. On each length of it acts `K_c s sin t + K_e`, against its motion, towards the axis and along the axis (32). Seen along
//! the feed, to the left of it and towards the shank that is (36), for a tool that turns clockwise seen from its shank,
//!
//! ```text
//! (-cos t F_t - sin t F_r,  sin t F_t - cos t F_r,  F_a)
//! ```
//!
//! A tooth lags by `k = tan(helix) / R` for each length up the axis (34), and all of them together push with the integral over the
//! depth (37, 39). Equation 38 solves it for one tooth, with misprints (Budak 2006 has it right); tests compare with it. What is
//! needed here is its largest value over a turn, whatever part of the front is in the material: the integral over what is positive.

use core::array;
use core::f64::consts::{PI, TAU};
use vcutc_backend_api::units::{AngularSpeed, CuttingPressure, EdgeForce, Length, Speed};
use vcutc_geometry::number::Interval;
use vcutc_job::forces::{ChipParts, TeethForces};

/// Into how many cells the angle from one tooth to the next is divided.
const CELLS: usize = 1024;

/// How many quantities are looked at: each part of the force both ways, and what turns the tool about its tip.
const QUANTITIES: usize = 7;

/// The teeth of a tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Teeth {
    count: u32,
    /// By how much they lag, in rad for each mm up the axis.
    lag: f64,
    /// On each area of a chip, in N/mm2: tangential, radial, axial.
    cutting: [f64; 3],
    /// On each length of a tooth, in N/mm.
    edge: [f64; 3],
}

/// What teeth push with, in N: along the feed, to the left of it, and along the axis towards the shank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Milled {
    /// How much of their height is in the material at most.
    pub(crate) depth: Length,
    /// Whatever it may be while the tool turns and any part of its front is in the material.
    pub(crate) any: [Interval; 3],
    /// The mean over a turn with all of its front in the material.
    pub(crate) mean: [f64; 3],
    /// The means, likewise, of what turns the tool for each length of its radius: against its motion about its axis, and along its
    /// axis, ahead of it.
    pub(crate) mean_turning: [f64; 2],
    /// How large the forces are together that act off the axis and turn the tool: against its motion, and along its axis.
    pub(crate) turning: f64,
}

/// The means over a turn of a force on a tooth, in N.
struct Means {
    all: f64,
    /// Times the sine of how far the tooth has turned.
    across: f64,
}

impl Teeth {
    /// Those of a tool of this radius.
    pub(crate) fn of(radius: Length, forces: &TeethForces) -> Self {
        let ChipParts {
            tangential,
            radial,
            axial,
        } = forces.cutting;
        let cutting = [tangential, radial, axial].map(CuttingPressure::to_n_per_mm2);
        let ChipParts {
            tangential,
            radial,
            axial,
        } = forces.edge;
        Self {
            count: forces.count.get(),
            lag: libm::tan(forces.helix.value.to_rad()) / radius.to_mm(),
            cutting,
            edge: [tangential, radial, axial].map(EdgeForce::to_n_per_mm),
        }
    }

    /// The thickest chip of a tool that turns and moves so fast: the feed for each tooth.
    pub(crate) fn chip(&self, feed: Speed, spin: AngularSpeed) -> Length {
        let teeth_a_second = spin.to_rad_per_s() / TAU * f64::from(self.count);
        Length::mm(feed.to_mm_per_s() / teeth_a_second)
    }

    /// What acts on each mm of a tooth that has turned so far, in N: tangential, radial, axial.
    fn on_tooth(&self, sine: f64, chip: f64) -> [f64; 3] {
        array::from_fn(|part| self.cutting[part] * chip * sine + self.edge[part])
    }

    /// The same along the feed, to the left of it, and along the axis.
    fn on_length(&self, angle: f64, chip: f64) -> [f64; 3] {
        let (sine, cosine) = libm::sincos(angle);
        let [tangential, radial, axial] = self.on_tooth(sine, chip);
        [
            -cosine * tangential - sine * radial,
            sine * tangential - cosine * radial,
            axial,
        ]
    }

    /// What such a tool pushes with while so much of it is in the material: at this feed for each tooth and at any lower one.
    pub(crate) fn milled(&self, chip: Length, depth: Length) -> Milled {
        let (chip, height) = (chip.to_mm(), depth.to_mm());
        // Each quantity is linear in the chip, so the sum of what is positive is convex in it, and largest at an end.
        let ends = [0.0, chip].map(|chip| self.cells(chip));
        let [ahead, back, left, right, up, down, turning] = array::from_fn(|quantity| {
            let most = ends.each_ref().map(|cells| self.most(cells, quantity, height));
            most[0].max(most[1])
        });
        let between = |low: f64, high: f64| Interval { low: -low, high };
        Milled {
            depth,
            any: [between(back, ahead), between(right, left), between(down, up)],
            mean: self.mean(chip, height),
            mean_turning: self.mean_turning(chip, height),
            turning,
        }
    }

    /// The mean over a turn, of teeth that are in the material for half of it.
    fn mean(&self, chip: f64, depth: f64) -> [f64; 3] {
        let [tangential, radial, axial] = self.means(chip, depth);
        [-radial.across, tangential.across, axial.all]
    }

    /// The same of what turns the tool, for each length of its radius.
    fn mean_turning(&self, chip: f64, depth: f64) -> [f64; 2] {
        let [tangential, _, axial] = self.means(chip, depth);
        [tangential.all, axial.across]
    }

    /// The means over a turn of each force on a tooth.
    fn means(&self, chip: f64, depth: f64) -> [Means; 3] {
        // Half of a turn has these integrals of `sin^2 t` and of `sin t`; those with an odd power of `cos t` are zero.
        let (squares, sines) = (0.5 * PI, 2.0);
        let per_turn = depth * f64::from(self.count) / TAU;
        array::from_fn(|part| {
            let (cutting, edge) = (self.cutting[part] * chip, self.edge[part]);
            Means {
                all: per_turn * (cutting * sines + edge * PI),
                across: per_turn * (cutting * squares + edge * sines),
            }
        })
    }

    /// The most that each quantity comes to on each mm of the axis while a tooth is in each cell of the way to the next one, together with
    /// the other teeth.
    fn cells(&self, chip: f64) -> Vec<[f64; QUANTITIES]> {
        let apart = TAU / f64::from(self.count);
        let cell = apart / CELLS as f64;
        // Between the ends of a cell a quantity exceeds both by no more than its second derivative allows.
        let [tangential, radial, axial] =
            array::from_fn(|part| 2.0 * self.cutting[part] * chip + self.edge[part]);
        let off = (tangential + radial + axial) * cell * cell / 8.0;
        let teeth = |begin: f64| (0..self.count).map(move |tooth| begin + f64::from(tooth) * apart);
        let ends = |begin: f64| (begin < PI).then(|| [begin, (begin + cell).min(PI)]);
        (0..CELLS)
            .map(|number| {
                let mut all = [0.0; QUANTITIES];
                for [begin, end] in teeth(number as f64 * cell).filter_map(ends) {
                    let [begin, end] = [begin, end].map(|angle| self.quantities(angle, chip));
                    for (quantity, sum) in all.iter_mut().enumerate() {
                        *sum += (begin[quantity].max(end[quantity]) + off).max(0.0);
                    }
                }
                all
            })
            .collect()
    }

    /// Each part of the force on each mm of a tooth, both ways, and how large those are that turn the tool.
    fn quantities(&self, angle: f64, chip: f64) -> [f64; QUANTITIES] {
        let [along, left, up] = self.on_length(angle, chip);
        let [tangential, _, axial] = self.on_tooth(libm::sin(angle), chip);
        [along, -along, left, -left, up, -up, tangential + axial]
    }

    /// The most that a quantity comes to over the depth while the tool turns.
    fn most(&self, cells: &[[f64; QUANTITIES]], quantity: usize, depth: f64) -> f64 {
        let at = |cell: usize| cells[cell % CELLS][quantity];
        // While the tool turns through a cell, each place of the axis is in one or in the next.
        let either: Vec<f64> = (0..CELLS).map(|cell| at(cell).max(at(cell + 1))).collect();
        let span = depth * self.lag * f64::from(self.count) * CELLS as f64 / TAU;
        if span <= 1.0 {
            return depth * either.iter().copied().fold(0.0, f64::max);
        }
        // The mean over the cells that the depth spans: whole turns to the next tooth, whole cells, and a part of one.
        let mut sums = vec![0.0];
        for cell in 0..2 * CELLS {
            sums.push(sums[cell] + either[cell % CELLS]);
        }
        let whole = span.floor();
        let turns = (whole / CELLS as f64).floor();
        let rest = (whole - turns * CELLS as f64) as usize;
        let sum = |begin: usize| {
            let part = (span - whole) * either[(begin + rest) % CELLS];
            turns * sums[CELLS] + sums[begin + rest] - sums[begin] + part
        };
        depth / span * (0..CELLS).map(sum).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests;
