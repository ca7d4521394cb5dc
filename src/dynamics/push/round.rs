//! How the work pushes a disc, and the teeth of a crusher.
//!
//! Their forces act away from the axis, so they also turn the blade about its tip: by no more than their size times the radius, about
//! whatever axis.

use super::{Amount, Force, Moment, Posture, Push, Sides, SpreadAlong};
use crate::milling::Milled;
use glam::DVec3;
use vcutc_backend_api::units::Length;
use vcutc_geometry::number::Interval;
use vcutc_job::forces::{RimForces, RimParts};
use vcutc_machine::body::MILLIMETRES;

/// The directions of a round blade, seen from the blade.
struct Directions {
    way: DVec3,
    /// Along the axis, towards the shank.
    up: DVec3,
    /// Square to both, to the left of the way.
    left: DVec3,
}

impl Directions {
    /// None of a blade that moves along its axis.
    fn of(held: &Posture) -> Option<Self> {
        let way = held.blade_in_work.transpose() * held.way;
        let up = -DVec3::Z;
        let left = up.cross(way).try_normalize()?;
        Some(Self { way, up, left })
    }

    /// With the part of the way that is square to the axis: there teeth go into the material.
    fn across_the_axis(self) -> Self {
        Self {
            way: self.left.cross(self.up),
            ..self
        }
    }
}

impl Push {
    /// The push on a disc, by up to a length of its rim. None where it moves along its axis.
    pub(crate) fn on_rim(forces: &RimForces, radius: Length, length: Length, held: &Posture) -> Option<Self> {
        let Directions { way, up, left } = Directions::of(held)?;
        let RimParts { drag, axial, radial } = forces.rim;
        let [drag, axial, radial] = [drag, axial, radial].map(|part| {
            let force = part.to_n_per_mm() * length.to_mm();
            Amount::of(force, forces.statement.spread.value)
        });
        let acting = |direction: DVec3, edge: Amount| Force::on_edge(held, direction, edge);
        let push = Self {
            edge: 0.0,
            along_edge: seen(held, up),
            normal: seen(held, left),
            sides: Sides::Either,
            spread_along: SpreadAlong::Evenly,
            drag: acting(-way, drag),
            axial: acting(up, axial),
            side: acting(left, radial.either_way()),
            turns: held.turns.to_rad(),
            moment: Moment::NONE,
        };
        let size: f64 = push.forces().into_iter().map(Force::most).sum();
        Some(Self {
            // At which places of the rim it acts is not known.
            moment: Moment {
                most: size * radius.to_mm() / MILLIMETRES,
                stated: None,
            },
            ..push
        })
    }

    /// The push on the teeth of a crusher, by up to a height of them.
    ///
    /// They push to the left where they go up the way, and to the right where they come back; which of them are in the material, and
    /// which way a helix pulls, is not asked: across the way and along the axis their force counts either way. Where the tool goes along
    /// its axis, material may be on any side of it.
    pub(crate) fn on_teeth(milled: &Milled, spread: f64, radius: Length, held: &Posture) -> Self {
        let [mut along, mut across, axial] = milled.any;
        let [mut mean_along, mut mean_across, mean_axial] = milled.mean;
        let [about_the_axis, mut tilting] = milled.mean_turning;
        let across_the_axis = Directions::of(held).map(Directions::across_the_axis);
        let Directions { way, up, left } = across_the_axis.unwrap_or_else(|| {
            let most = libm::hypot(along.magnitude(), across.magnitude());
            [along, across] = [Interval::around(0.0, most); 2];
            [mean_along, mean_across, tilting] = [0.0; 3];
            let [way, left, up] = [DVec3::X, -DVec3::Y, -DVec3::Z];
            Directions { way, up, left }
        });
        let acting = |direction: DVec3, any: Interval, mean: f64| {
            Force::on_edge(held, direction, Amount::within(any.scaled(1.0 + spread), mean))
        };
        // Against the turning of the tool, and about the left by forces along the axis in front of it.
        let lever = radius.to_mm() / MILLIMETRES;
        let stated = up * (about_the_axis * lever) - left * (tilting * lever);
        Self {
            edge: milled.depth.to_mm() / MILLIMETRES,
            along_edge: seen(held, up),
            normal: seen(held, left),
            sides: Sides::Either,
            spread_along: SpreadAlong::Anyhow,
            drag: acting(way, along, mean_along),
            axial: acting(up, axial.either_way(), mean_axial),
            side: acting(left, across.either_way(), mean_across),
            turns: held.turns.to_rad(),
            moment: Moment {
                most: (1.0 + spread) * milled.turning * lever,
                stated: Some(seen(held, stated)),
            },
        }
    }
}

impl Force {
    /// All along the edge, and nothing at the tip.
    fn on_edge(held: &Posture, direction: DVec3, edge: Amount) -> Self {
        Self {
            direction: seen(held, direction),
            edge,
            tip: Amount::of(0.0, 0.0),
        }
    }
}

impl Amount {
    /// Anything from end to end, and this on average.
    fn within(any: Interval, stated: f64) -> Self {
        Self {
            stated,
            centre: any.middle(),
            off: 0.5 * any.width(),
        }
    }
}

/// A direction of the blade, seen from the hand.
fn seen(held: &Posture, direction: DVec3) -> [f64; 3] {
    (held.blade_in_hand * direction).to_array()
}
