//! Blades whose forces are known: how much of one is in the material in a cut, and what pushes it there.

use crate::condition::Condition;
use crate::milling::{Milled, Teeth};
use crate::push::{Posture, Push};
use serde::Serialize;
use std::collections::BTreeMap;
use vcutc_backend_api::segments::LinearSegment;
use vcutc_backend_api::units::{Angle, AngularSpeed, Length, Speed};
use vcutc_job::forces::{EdgeForces, RimForces, TeethForces};
use vcutc_job::{BladeRef, Crusher};

/// A blade in a cut.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Engaged<'p> {
    pushed: Pushed<'p>,
    /// How much of it is in the material at most: of its edge, of its rim, or of the height of its teeth.
    pub(crate) length: Length,
}

/// What pushes a blade.
#[derive(Clone, Copy, Debug)]
enum Pushed<'p> {
    Edge {
        forces: &'p EdgeForces,
        half_apex: Angle,
    },
    Rim {
        forces: &'p RimForces,
        radius: Length,
        spin: AngularSpeed,
    },
    Teeth {
        forces: &'p TeethForces,
        radius: Length,
        spin: AngularSpeed,
        chip: Length,
        milled: Milled,
    },
}

/// What of a blade is in the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EngagedPart {
    /// So much of its edge, from the tip on.
    Edge,
    /// So much of its rim.
    Rim,
    /// So much of the height of its teeth.
    Teeth,
}

impl EngagedPart {
    /// Its name.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Edge => "edge",
            Self::Rim => "rim",
            Self::Teeth => "teeth",
        }
    }
}

/// What a cut forms of the part, as far as its deviation is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Forms {
    /// The flank of a V, or a wall along a slit.
    Flank,
    /// An upright wall beside teeth that mill.
    Wall,
    /// A surface under a disc: its deviation is not computed.
    Surface,
}

impl Forms {
    /// Whether the deviation of what it forms is computed.
    pub(crate) const fn has_deviation(self) -> bool {
        match self {
            Self::Flank | Self::Wall => true,
            Self::Surface => false,
        }
    }
}

/// A blade of a job that states what pushes it.
#[derive(Clone, Copy, Debug)]
pub struct PushedBlade<'b> {
    pub blade: BladeRef<'b>,
    /// How wide the strips are at most that it meets as a disc where what it meets is not measured; none where that is not known.
    pub strip: Option<Length>,
}

/// What teeth push with in the cuts of a program, of which many are alike: by their blade, their chip and their depth.
#[derive(Default)]
pub(crate) struct MilledForces(BTreeMap<(String, u64, u64), Milled>);

impl MilledForces {
    /// A blade in a cut along this line, with so much of it in the material where that is measured. None of a blade whose forces are not
    /// known.
    pub(crate) fn blade<'p>(
        &mut self,
        blade: PushedBlade<'p>,
        line: &LinearSegment,
        held: &Posture,
        used: Option<Length>,
    ) -> Option<Engaged<'p>> {
        let up_to = |most: Length| used.map_or(most, |used| used.min(most));
        match blade.blade {
            BladeRef::Straight(blade) => Some(Engaged {
                pushed: Pushed::Edge {
                    forces: blade.forces.as_ref()?,
                    half_apex: blade.half_apex.value,
                },
                // Where it is not measured, all of the edge may be in the material.
                length: up_to(blade.cutting_length.value),
            }),
            BladeRef::Disc(disc) => Some(Engaged {
                pushed: Pushed::Rim {
                    forces: disc.forces.as_ref()?,
                    radius: disc.radius.value,
                    spin: disc.spin.value,
                },
                length: used.unwrap_or_else(|| arc(disc.radius.value, blade.strip)),
            }),
            BladeRef::Crusher(crusher) => {
                let length = up_to(crusher.height.value);
                // Along its axis a tooth does not advance into the material.
                let feed = speed(line) * held.across();
                Some(Engaged {
                    pushed: self.teeth(crusher, crusher.forces.as_ref()?, feed, length),
                    length,
                })
            }
        }
    }

    fn teeth<'p>(
        &mut self,
        crusher: &Crusher,
        forces: &'p TeethForces,
        feed: Speed,
        depth: Length,
    ) -> Pushed<'p> {
        let (radius, spin) = (crusher.radius.value, crusher.spin.value);
        let teeth = Teeth::of(radius, forces);
        let chip = teeth.chip(feed, spin);
        let key = (
            crusher.name.clone(),
            chip.to_mm().to_bits(),
            depth.to_mm().to_bits(),
        );
        let milled = *self.0.entry(key).or_insert_with(|| teeth.milled(chip, depth));
        Pushed::Teeth {
            forces,
            radius,
            spin,
            chip,
            milled,
        }
    }
}

impl Engaged<'_> {
    /// What pushes it in a posture; none of a disc that moves along its own axis, and has no sides.
    pub(crate) fn push(&self, held: &Posture) -> Option<Push> {
        match self.pushed {
            Pushed::Edge { forces, half_apex } => Some(Push::on_edge(forces, half_apex, self.length, held)),
            Pushed::Rim { forces, radius, .. } => Push::on_rim(forces, radius, self.length, held),
            Pushed::Teeth {
                forces,
                radius,
                milled,
                ..
            } => Some(Push::on_teeth(
                &milled,
                forces.statement.spread.value,
                radius,
                held,
            )),
        }
    }

    /// How it cuts in a posture along a line.
    pub(crate) fn condition(&self, held: &Posture, line: &LinearSegment) -> Condition {
        match self.pushed {
            Pushed::Edge { .. } => Condition::of_edge(held, speed(line)),
            Pushed::Rim { spin, .. } => Condition::of_rim(speed(line), spin),
            Pushed::Teeth { spin, chip, .. } => Condition::of_teeth(chip, spin),
        }
    }

    /// How it was moved when its forces were measured.
    pub(crate) fn measured(&self) -> Condition {
        match self.pushed {
            Pushed::Edge { forces, .. } => Condition::from(&forces.measured),
            Pushed::Rim { forces, .. } => Condition::from(&forces.measured),
            Pushed::Teeth { forces, .. } => Condition::from(&forces.measured),
        }
    }

    pub(crate) const fn part(&self) -> EngagedPart {
        match self.pushed {
            Pushed::Edge { .. } => EngagedPart::Edge,
            Pushed::Rim { .. } => EngagedPart::Rim,
            Pushed::Teeth { .. } => EngagedPart::Teeth,
        }
    }

    pub(crate) const fn forms(&self) -> Forms {
        match self.pushed {
            Pushed::Edge { .. } => Forms::Flank,
            Pushed::Rim { .. } => Forms::Surface,
            Pushed::Teeth { .. } => Forms::Wall,
        }
    }
}

/// How fast a tip moves along a line.
fn speed(line: &LinearSegment) -> Speed {
    Speed::mm_per_s(line.length().to_mm() / line.duration().to_s())
}

/// How much of the rim of a disc is in the material at most where that is not measured: where a strip of this width lies at its side,
/// and the front half where the width is not known, or more than the disc.
fn arc(radius: Length, strip: Option<Length>) -> Length {
    let share = strip.map_or(2.0, |strip| strip.to_mm() / radius.to_mm());
    Length::mm(radius.to_mm() * libm::acos((1.0 - share).max(-1.0)))
}
