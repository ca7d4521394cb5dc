//! The torques of a program for people and for programs.

use crate::arm::JOINTS;
use crate::drives::{Drives, Most, Unknown};
use serde::{Serialize, Serializer};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_diagnostics::number::{rounded, show};
use vcutc_machine::Model;
use vcutc_machine::kinematics::opw::Coupling;
use vcutc_machine::masses::{Backing, Covered};
use vcutc_motion::describe::site_words;
use vcutc_motion::summary::PlaceFigure;

/// What a program asks of the drives of an arm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TorqueFigures {
    /// The axes, in the controller's order.
    pub axes: Vec<AxisTorque>,
    /// How far the masses are backed, and the limits where there are some.
    #[serde(serialize_with = "word")]
    pub masses: Backing,
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "word_if_known")]
    pub limits: Option<Backing>,
    /// What adds to the torques and is not in the numbers.
    pub without: Vec<&'static str>,
}

/// The most that an axis needs, in Nm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxisTorque {
    pub name: String,
    /// As the controller counts.
    #[serde(serialize_with = "thousandths")]
    pub torque: f64,
    /// What of it holds the arm up.
    #[serde(serialize_with = "thousandths")]
    pub weight: f64,
    /// What of it moves the arm.
    #[serde(serialize_with = "thousandths")]
    pub motion: f64,
    /// What its drive gives, when known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
    pub at: PlaceFigure,
}

/// To a thousandth of a newton metre: what is less is noise of the arithmetic.
fn thousandths<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(rounded(*value, 1e3))
}

pub(crate) fn word<S: Serializer>(backing: &Backing, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(backing.word())
}

fn word_if_known<S: Serializer>(backing: &Option<Backing>, serializer: S) -> Result<S::Ok, S::Error> {
    backing.map(Backing::word).serialize(serializer)
}

impl AxisTorque {
    /// The share of its limit that it uses, when that is known.
    #[must_use]
    pub fn share(&self) -> Option<f64> {
        self.limit.map(|limit| self.torque.abs() / limit)
    }
}

/// How far one may rely on torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reliance {
    /// Masses and limits are those of the machine, and nothing is left out.
    Sound,
    /// Something is missing, or from others.
    Indicative,
}

impl TorqueFigures {
    /// Of a program on a machine.
    ///
    /// # Errors
    /// Why its torques are not known.
    pub fn of(model: &Model, reached: &ReachableProgram) -> Result<Self, Unknown> {
        let program = reached.program();
        let masses = model.masses.as_ref().ok_or(Unknown::Masses)?;
        let cell = program.cell.as_ref().ok_or(Unknown::Masses)?;
        let drives = Drives::of(model, cell, program)?;
        let most = drives.most(reached).into_iter().flatten();
        let limits = model.torques.as_ref();
        let axes = model.axes.iter().zip(most).enumerate().take(JOINTS);
        let figure = |(axis, (named, most)): (usize, (&vcutc_backend_api::ir::Axis, Most))| {
            let part = |torques: &[f64; JOINTS]| torques.get(axis).copied().unwrap_or_default();
            let words = program
                .ops
                .get(most.op.0 as usize)
                .map_or_else(String::new, |op| site_words(program, op.site));
            AxisTorque {
                name: named.name.clone(),
                torque: most.torques.of(axis),
                weight: part(&most.torques.weight),
                motion: part(&most.torques.motion),
                limit: limits.and_then(|torques| torques.limits.get(axis).copied()),
                at: PlaceFigure { op: most.op.0, words },
            }
        };
        Ok(Self {
            axes: axes.map(figure).collect(),
            masses: masses.backing,
            limits: limits.map(|torques| torques.backing),
            without: missing(model)
                .filter(|part| !masses.covered.contains(part))
                .map(Covered::word)
                .collect(),
        })
    }

    #[must_use]
    pub fn reliance(&self) -> Reliance {
        let is_own = |backing: Backing| matches!(backing, Backing::Measured | Backing::Maker);
        let is_sound = is_own(self.masses) && self.limits.is_some_and(is_own) && self.without.is_empty();
        if is_sound {
            Reliance::Sound
        } else {
            Reliance::Indicative
        }
    }

    /// The axis that comes nearest to its limit; where no limit is known, the one that needs the most.
    #[must_use]
    pub fn nearest(&self) -> Option<&AxisTorque> {
        let known = self.axes.iter().filter_map(|axis| Some((axis, axis.share()?)));
        let nearest = known.max_by(|(_, a), (_, b)| a.total_cmp(b));
        let needs = |axis: &&AxisTorque| axis.torque.abs();
        nearest
            .map(|(axis, _)| axis)
            .or_else(|| self.axes.iter().max_by(|a, b| needs(a).total_cmp(&needs(b))))
    }

    /// The text of its line: `A2 needs 34 % of 9600 Nm at layer 2, cut 1 (weight 3270 Nm, motion 12 Nm); ...`.
    #[must_use]
    pub fn line(&self) -> Option<String> {
        let nearest = self.nearest()?;
        let needs = match (nearest.limit, nearest.share()) {
            (Some(limit), Some(share)) => format!("{:.0} % of {} Nm", share * 100.0, show(limit)),
            (_, _) => format!("{} Nm", whole(nearest.torque.abs())),
        };
        let mut text = format!(
            "{} needs {needs} at {} (weight {} Nm, motion {} Nm); at programmed speeds, without cutting forces",
            nearest.name,
            nearest.at.words,
            whole(nearest.weight),
            whole(nearest.motion),
        );
        if self.reliance() == Reliance::Indicative {
            text += &format!("; indicative: {}", self.backing());
        }
        Some(text)
    }

    /// `published masses, without motors, balance and friction`.
    #[must_use]
    pub fn backing(&self) -> String {
        let mut text = format!("{} masses", self.masses.word());
        if self.limits.is_some_and(|limits| limits != self.masses)
            && let Some(limits) = self.limits
        {
            text += &format!(", {} limits", limits.word());
        }
        match self.without.as_slice() {
            [] => {}
            [only] => text += &format!(", without {only}"),
            [first @ .., last] => text += &format!(", without {} and {last}", first.join(", ")),
        }
        text
    }
}

/// A torque without decimals.
pub(crate) fn whole(torque: f64) -> String {
    show(torque.round())
}

/// What adds to the torques of an arm besides its links.
fn missing(model: &Model) -> impl Iterator<Item = Covered> {
    let arm = model.mechanism.ortho_parallel();
    let rods = arm.is_some_and(|arm| arm.coupling == Coupling::Parallelogram);
    let rods = rods.then_some(Covered::Rods);
    rods.into_iter()
        .chain([Covered::Motors, Covered::Balance, Covered::Friction])
}
