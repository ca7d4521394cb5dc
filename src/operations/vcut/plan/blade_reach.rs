//! How far a blade reaches, and how far a lattice needs it to reach: the closed forms of [Cui II.B] and what follows
//! from them.
//!
//! With swing `alpha`, rake `theta` and half apex `beta`, an edge of length L shows itself in the x-z plane with length
//! `d = L sin(theta - beta)` [Cui 2], of which `d cos(alpha)` is vertical. A cut needs the vertical distance from its
//! tip to the point where its flank comes out.
//!
//! After a layer the surface is a saw-tooth whose flanks have slope `c = cot(alpha)`. A new flank runs parallel to one
//! side of the teeth and meets the other: going up from a tip `h` below the old ones, it passes under every old tip whose
//! flank height at that place is below `h`, and comes out on the descending side of the tooth beyond the
//! first tip that it passes above. If that tip lies `u` away, the flanks meet at height `(h + c u) / 2`. So
//! everything depends on the offsets `u` of the older tips, which is what distinguishes the lattices.

use crate::asked::Lattice;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_simulation::surface::Vee;

/// The flanks of a V in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flanks {
    /// Rise over x: `cot(swing)`.
    pub slope: f64,
    /// Vertical reach of the blade: `d cos(swing)`.
    pub reach: Length,
    /// Edge length that one millimetre of vertical reach takes: `1 / (cos(swing) sin(rake - half_apex))`.
    pub edge_per_reach: f64,
    /// How much lower than their tips say flanks may lie against what others have left, where they follow a spine.
    pub lower: Length,
}

impl Flanks {
    /// For a blade held at a swing and a rake above the half apex angle.
    #[must_use]
    pub fn new(cutting_length: Length, half_apex: Angle, rake: Angle, swing: Angle) -> Self {
        let vertical = swing.cos() * (rake - half_apex).sin();
        Self {
            slope: 1.0 / swing.tan(),
            reach: cutting_length * vertical,
            edge_per_reach: 1.0 / vertical,
            lower: Length::ZERO,
        }
    }

    /// The reach that a lattice may need at most where flanks lie as low as they may.
    #[must_use]
    pub fn reach_in_lattice(&self) -> Length {
        (self.reach - self.lower).max(Length::ZERO)
    }

    /// A V for those that ask how far its flanks have to reach: as low as it may lie.
    #[must_use]
    pub fn lowest(&self, vee: Vee) -> Vee {
        let tip = Point2 {
            z: vee.tip.z - self.lower.to_mm(),
            ..vee.tip
        };
        Vee { tip, ..vee }
    }
}

/// Offsets at which a flank finds older tips, in the order it passes them: `first + k * spacing`.
struct OlderTips {
    first: f64,
    spacing: f64,
}

impl OlderTips {
    fn of(lattice: Lattice, step: f64) -> Self {
        match lattice {
            Lattice::Orthogonal => Self {
                first: step,
                spacing: step,
            },
            Lattice::Interlaced | Lattice::Fitted => Self {
                first: step / 2.0,
                spacing: step,
            },
            // Anywhere: at worst the flank just misses a tip, and the next lies a whole step further.
            Lattice::Free => Self {
                first: 0.0,
                spacing: step,
            },
        }
    }
}

/// Flank heights this close to an older tip pass above it: the same nanometre that the simulation grants.
const TOUCH: f64 = 1e-6;

/// Vertical reach that a lattice of that layer and step needs, far from the part and the stock's sides.
///
/// Orthogonal without overlap gives 3h/2 [Cui 4], with overlap `eps <= 1/2` it gives `(3 - 2 eps) h / 2`; interlaced gives
/// h without and `(4 - 3 eps) h / 2` with overlap; free gives 2h without overlap.
#[must_use]
pub fn needed_reach(lattice: Lattice, layer: Length, step: Length, slope: f64) -> Length {
    let (h, s) = (layer.to_mm(), step.to_mm());
    let tips = OlderTips::of(lattice, s);
    match lattice {
        Lattice::Orthogonal | Lattice::Interlaced => {
            let missed = ((h - TOUCH - slope * tips.first) / (slope * tips.spacing))
                .ceil()
                .max(0.0);
            Length::mm((h + slope * (tips.first + missed * tips.spacing)) / 2.0).max(layer)
        }
        Lattice::Free => Length::mm(h + slope * s / 2.0),
        // Rows above the last one are as far apart as that needs, whatever its step.
        Lattice::Fitted => layer,
    }
}

/// The largest layer whose step is `2 (1 - overlap) h tan(swing)` [Cui 7] and whose needed reach is at most `reach`.
#[must_use]
pub fn largest_layer(lattice: Lattice, overlap: f64, reach: Length) -> Length {
    // With c s = 2 (1 - eps) h everything scales with h, so the need of h = 1 is the whole answer.
    let unit = needed_reach(lattice, Length::mm(1.0), Length::mm(2.0 * (1.0 - overlap)), 1.0);
    Length::mm(reach / unit)
}

/// The largest layer that a given step allows within `reach`, if there is any: the best over the number of older tips that
/// a flank may pass under.
#[must_use]
pub fn largest_layer_at_step(lattice: Lattice, step: Length, slope: f64, reach: Length) -> Option<Length> {
    let rise = slope * step.to_mm();
    let reach = reach.to_mm();
    let best = match lattice {
        Lattice::Free => reach - rise / 2.0,
        Lattice::Fitted => reach,
        Lattice::Orthogonal | Lattice::Interlaced => {
            let tips = OlderTips::of(lattice, rise);
            // Passing under k tips: h <= u_k (so that tip k is passed above) and (h + u_k) / 2 <= reach. The best k has u_k
            // next to the reach, on one side of it or the other.
            let below = ((reach - tips.first) / tips.spacing).floor().max(0.0);
            [below, below + 1.0]
                .map(|k| tips.first + k * tips.spacing)
                .map(|u| u.min(2.0 * reach - u))
                .into_iter()
                .fold(f64::NEG_INFINITY, f64::max)
        }
    };
    (best > 0.0).then(|| Length::mm(best.min(reach)))
}

/// The scallop that a lattice leaves at most on a part, away from the stock's sides: [Cui 12] for orthogonal and free
/// lattices; for interlaced ones `(2 - eps) h` down to the next tip or `s / 2` sideways and `h` down to one of the column
/// beside, whichever is farther.
#[must_use]
pub fn scallop_bound(lattice: Lattice, layer: Length, step: Length, slope: f64) -> Length {
    // (2 - eps) h with eps from the step: 1 - eps = c s / (2 h).
    let drop = layer.to_mm() + slope * step.to_mm() / 2.0;
    match lattice {
        Lattice::Orthogonal | Lattice::Free => Length::mm(libm::hypot(step.to_mm() / 2.0, drop)),
        Lattice::Interlaced | Lattice::Fitted => {
            Length::mm(drop.max(libm::hypot(step.to_mm() / 2.0, layer.to_mm())))
        }
    }
}

/// The largest layer whose scallop bound is at most `limit`, at a given overlap.
#[must_use]
pub fn largest_layer_for_scallop(lattice: Lattice, overlap: f64, slope: f64, limit: Length) -> Length {
    let step = 2.0 * (1.0 - overlap) / slope;
    Length::mm(limit / scallop_bound(lattice, Length::mm(1.0), Length::mm(step), slope))
}

/// The largest layer whose scallop bound is at most `limit`, at a given step, if there is any.
#[must_use]
pub fn largest_layer_for_scallop_at_step(
    lattice: Lattice,
    step: Length,
    slope: f64,
    limit: Length,
) -> Option<Length> {
    let (s, limit) = (step.to_mm(), limit.to_mm());
    let down = (limit * limit - s * s / 4.0).max(0.0).sqrt();
    let layer = match lattice {
        Lattice::Orthogonal | Lattice::Free => down - slope * s / 2.0,
        Lattice::Interlaced | Lattice::Fitted => down.min(limit - slope * s / 2.0),
    };
    (layer > 0.0).then(|| Length::mm(layer))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use vcutc_geometry::curve::Point2;
    use vcutc_simulation::surface::{Side, Surface, Vee};

    /// Simulates layers of a lattice wide enough that the sides do not matter, and measures the reach in the middle.
    fn simulated(lattice: Lattice, layer: f64, step: f64, slope: f64) -> f64 {
        let width = 80.0 * step.max(layer / slope);
        let top = 100.0 * layer;
        let mut surface = Surface::flat(width, top);
        let mut worst: f64 = 0.0;
        for j in 1..=5_u32 {
            let shift = if lattice == Lattice::Interlaced && j % 2 == 0 {
                step / 2.0
            } else {
                0.0
            };
            let z = top - f64::from(j) * layer;
            let mut x = shift;
            let mut vees = Vec::new();
            while x <= width {
                vees.push(Vee::even(Point2 { x, z }, slope));
                x += step;
            }
            for vee in vees {
                if (vee.tip.x - width / 2.0).abs() < width / 4.0 {
                    worst = worst.max(surface.flank(vee, Side::Right).reach);
                }
                surface.release(vee);
            }
        }
        worst
    }

    fn a_lattice() -> impl Strategy<Value = Lattice> {
        prop::sample::select(vec![Lattice::Orthogonal, Lattice::Interlaced])
    }

    proptest! {
        #[test]
        fn needed_reach_is_what_simulation_measures(lattice in a_lattice(), layer in 1.0..8.0_f64, overlap in 0.01..0.9_f64, swing in 15.0..60.0_f64) {
            let slope = 1.0 / Angle::deg(swing).tan();
            let step = 2.0 * (1.0 - overlap) * layer / slope;
            let closed = needed_reach(lattice, Length::mm(layer), Length::mm(step), slope).to_mm();
            prop_assert!((closed - simulated(lattice, layer, step, slope)).abs() < 1e-4 * closed, "{closed}");
        }

        #[test]
        fn largest_layer_at_step_is_the_largest(lattice in a_lattice(), step in 1.0..12.0_f64, swing in 15.0..60.0_f64, reach in 2.0..12.0_f64) {
            let slope = 1.0 / Angle::deg(swing).tan();
            let (step, reach) = (Length::mm(step), Length::mm(reach));
            let fits = |layer: f64| needed_reach(lattice, Length::mm(layer), step, slope).to_mm() <= reach.to_mm() + 1e-5;
            let best_by_search = (1..=4000_u32).map(|i| f64::from(i) * reach.to_mm() / 4000.0).filter(|&h| fits(h)).fold(0.0, f64::max);
            let closed = largest_layer_at_step(lattice, step, slope, reach).map_or(0.0, Length::to_mm);
            prop_assert!((closed - best_by_search).abs() <= reach.to_mm() / 3000.0, "{closed} {best_by_search}");
        }

        #[test]
        fn scallop_limits_invert_the_bound(lattice in a_lattice(), overlap in 0.0..0.9_f64, swing in 15.0..60.0_f64, limit in 1.0..20.0_f64) {
            let slope = 1.0 / Angle::deg(swing).tan();
            let layer = largest_layer_for_scallop(lattice, overlap, slope, Length::mm(limit));
            let step = layer * (2.0 * (1.0 - overlap) / slope);
            prop_assert!((scallop_bound(lattice, layer, step, slope).to_mm() - limit).abs() < 1e-9 * limit);
            let again = largest_layer_for_scallop_at_step(lattice, step, slope, Length::mm(limit)).unwrap();
            prop_assert!((again / layer - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn largest_layers_of_the_paper() {
        let flanks = Flanks::new(
            Length::mm(10.0),
            Angle::deg(7.13),
            Angle::deg(60.0),
            Angle::deg(34.16),
        );
        // [Cui 4] and Table 1.
        let orthogonal = largest_layer(Lattice::Orthogonal, 0.0, flanks.reach);
        assert!((orthogonal.to_mm() - 4.40).abs() < 0.005, "{orthogonal:?}");
        // Interlaced without overlap reaches its whole depth, free half of it [Cui II.A].
        assert!((largest_layer(Lattice::Interlaced, 0.0, flanks.reach) / flanks.reach - 1.0).abs() < 1e-12);
        assert!((largest_layer(Lattice::Free, 0.0, flanks.reach) / flanks.reach - 0.5).abs() < 1e-12);
        // Overlap a half, at 35.75 degrees: 6.47 mm instead of [Cui 4]'s 4.31 mm.
        let flanks = Flanks::new(
            Length::mm(10.0),
            Angle::deg(7.13),
            Angle::deg(60.0),
            Angle::deg(35.75),
        );
        assert!((largest_layer(Lattice::Orthogonal, 0.5, flanks.reach).to_mm() - 6.470).abs() < 1e-3);
        // [Cui 12] at Table 1's optimum: 9.29 mm.
        let slope = 1.0 / Angle::deg(34.16).tan();
        let scallop = scallop_bound(Lattice::Orthogonal, Length::mm(4.40), Length::mm(5.97), slope);
        assert!((scallop.to_mm() - 9.29).abs() < 0.005, "{scallop:?}");
    }
}
