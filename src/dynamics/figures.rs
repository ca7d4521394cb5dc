//! The torques of a program for people and for programs.

use crate::arms::{Arms, Unknown};
use crate::cuts::{Known, Others};
use crate::drives::{Drives, Most};
use crate::everywhere::Demand;
pub use crate::everywhere::Pushing;
use serde::{Serialize, Serializer};
use vcutc_diagnostics::number::{rounded, show};
use vcutc_machine::Model;
use vcutc_machine::kinematics::opw::Coupling;
use vcutc_machine::masses::{Backing, Covered};
use vcutc_motion::describe::site_words;
use vcutc_motion::figures::PlaceFigure;
use vcutc_motion::parts::Motions;

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
    pub looked_at: LookedAt,
    pub cutting: Cutting,
    /// The share of its limit that an axis may use, when the job states one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowed: Option<f64>,
}

/// Where torques are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LookedAt {
    /// All along the program: nowhere is more needed.
    Everywhere,
    /// The same but for its first motion, whose start is not known without a home.
    AfterStart,
    /// In places along it.
    Places,
}

/// Whether the forces of blades are in the torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cutting {
    /// Of all cuts.
    Counted,
    /// Of the cuts by blades that state theirs.
    InPart,
    NotKnown,
}

/// The most that an axis needs, in Nm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxisTorque {
    pub name: String,
    /// It needs nowhere more, either way; where places are looked at, in none of them.
    #[serde(serialize_with = "thousandths")]
    pub most: f64,
    /// What it needs where that was found, as the controller counts.
    #[serde(serialize_with = "thousandths")]
    pub torque: f64,
    /// What of it holds the arm up.
    #[serde(serialize_with = "thousandths")]
    pub weight: f64,
    /// What of it moves the arm.
    #[serde(serialize_with = "thousandths")]
    pub motion: f64,
    /// What of it works against the forces of the blade.
    #[serde(serialize_with = "thousandths")]
    pub cutting: f64,
    /// What its drive gives, when known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
    pub at: PlaceFigure,
    /// How much of the op at that place is done there, from 0 to 1; none where so little is needed that the place means little.
    #[serde(skip)]
    pub done: Option<f64>,
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
        self.limit.map(|limit| self.most / limit)
    }
}

impl AxisTorque {
    /// `weight 3270 Nm, motion 12 Nm, cutting 5 Nm`: its parts where it needs the most, positive along the whole.
    #[must_use]
    pub fn parts(&self) -> String {
        let along = self.torque.signum();
        let cutting = if self.cutting == 0.0 {
            String::new()
        } else {
            format!(", cutting {} Nm", whole(along * self.cutting))
        };
        format!(
            "weight {} Nm, motion {} Nm{cutting}",
            whole(along * self.weight),
            whole(along * self.motion),
        )
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

/// What is proven of torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// At programmed speeds no axis needs more anywhere.
    Proven,
    /// Only places are looked at.
    InPlaces,
    /// Where the first motion starts is not known.
    WithoutStart,
    /// The numbers are not all those of the machine.
    Indicative,
    /// Not all forces of the blades are known.
    WithoutForces,
}

impl TorqueFigures {
    /// Of a program on these arms, whose blades are pushed so. `allowed` is the share of its limit that an axis
    /// may use.
    ///
    /// # Errors
    /// Why its torques are not known.
    pub fn of(
        known: Known<'_>,
        arms: &Arms,
        pushing: Pushing<'_>,
        allowed: Option<f64>,
    ) -> Result<Self, Unknown> {
        let Known { model, reached, .. } = known;
        let masses = model.masses.as_ref().ok_or(Unknown::Masses)?;
        let limits = model.torques.as_ref();
        let demand = Demand {
            motions: Motions::of(reached, known.rigs),
            rigs: known.rigs,
            weightless: arms.weightless(),
            arms,
            pushing,
        };
        let (looked_at, most) =
            match demand.most(limits.map(|torques| torques.limits), allowed.unwrap_or(1.0)) {
                Some(most) => (along(known), Some(most)),
                None => {
                    let drives = Drives::of(known.rigs, arms, reached.program());
                    (LookedAt::Places, drives.most_in_places(reached))
                }
            };
        let most = most.into_iter().flatten().enumerate();
        let axes = most.filter_map(|(axis, most)| figure(known, axis, &most));
        Ok(Self {
            axes: axes.collect(),
            masses: masses.backing,
            limits: limits.map(|torques| torques.backing),
            without: missing(model)
                .filter(|part| !masses.covered.contains(part))
                .map(Covered::word)
                .collect(),
            looked_at,
            cutting: match (looked_at, pushing) {
                (_, Pushing::Nothing) => Cutting::Counted,
                (LookedAt::Places, _) | (_, Pushing::NotKnown) => Cutting::NotKnown,
                (_, Pushing::By(cuts)) => match cuts.others() {
                    Others::None => Cutting::Counted,
                    Others::Some => Cutting::InPart,
                },
            },
            allowed,
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

    /// What is proven of them.
    #[must_use]
    pub fn standing(&self) -> Standing {
        match (self.looked_at, self.reliance(), self.cutting) {
            (LookedAt::Places, _, _) => Standing::InPlaces,
            (_, Reliance::Indicative, _) => Standing::Indicative,
            (_, Reliance::Sound, Cutting::InPart | Cutting::NotKnown) => Standing::WithoutForces,
            (LookedAt::AfterStart, Reliance::Sound, Cutting::Counted) => Standing::WithoutStart,
            (LookedAt::Everywhere, Reliance::Sound, Cutting::Counted) => Standing::Proven,
        }
    }

    /// The axis that comes nearest to its limit; where no limit is known, the one that needs the most.
    #[must_use]
    pub fn nearest(&self) -> Option<&AxisTorque> {
        let known = self.axes.iter().filter_map(|axis| Some((axis, axis.share()?)));
        let nearest = known.max_by(|(_, a), (_, b)| a.total_cmp(b));
        let needs = |axis: &&AxisTorque| axis.most;
        nearest
            .map(|(axis, _)| axis)
            .or_else(|| self.axes.iter().max_by(|a, b| needs(a).total_cmp(&needs(b))))
    }

    /// The text of its line: `A2 needs 34 % of 9600 Nm at layer 2, cut 1 (weight 3270 Nm, motion 12 Nm); ...`.
    #[must_use]
    pub fn line(&self) -> Option<String> {
        let nearest = self.nearest()?;
        let needs = match (nearest.limit, nearest.share()) {
            (Some(limit), Some(share)) => format!("{} % of {} Nm", percent(share), show(limit)),
            (_, _) => format!("{} Nm", whole(nearest.most)),
        };
        let mut text = format!(
            "{} needs at most {needs} at {} ({}); at programmed speeds{}",
            nearest.name,
            nearest.at.words,
            nearest.parts(),
            self.apart(),
        );
        if self.reliance() == Reliance::Indicative {
            text += &format!("; indicative: {}", self.backing());
        }
        Some(text)
    }

    /// What is not in the numbers because of where they are looked at, and of what is known of forces.
    #[must_use]
    pub fn apart(&self) -> String {
        let places = match self.looked_at {
            LookedAt::Everywhere => "",
            LookedAt::AfterStart => ", without the first motion, whose start is not known",
            LookedAt::Places => ", in places up to 25 mm apart",
        };
        let forces = match self.cutting {
            Cutting::Counted => "",
            Cutting::InPart => ", with the cutting forces that are stated",
            Cutting::NotKnown => ", without cutting forces",
        };
        format!("{places}{forces}")
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

/// Where the bounds of a program hold.
fn along(known: Known<'_>) -> LookedAt {
    let home = known.reached.program().cell.as_ref().and_then(|cell| cell.home);
    match home {
        Some(_) => LookedAt::Everywhere,
        None => LookedAt::AfterStart,
    }
}

/// What an axis of a machine needs at most.
fn figure(known: Known<'_>, axis: usize, most: &Most) -> Option<AxisTorque> {
    let (model, program) = (known.model, known.reached.program());
    let words = program.op(most.op).map(|op| site_words(program, op.site));
    let limits = model.torques.as_ref();
    Some(AxisTorque {
        name: model.axes.get(axis)?.name.clone(),
        most: most.most,
        torque: most.torques.of(axis),
        weight: *most.torques.weight.get(axis)?,
        motion: *most.torques.motion.get(axis)?,
        cutting: *most.torques.cutting.get(axis)?,
        limit: limits.and_then(|torques| torques.limits.get(axis).copied()),
        at: PlaceFigure {
            op: most.op.0,
            words: words.unwrap_or_default(),
        },
        done: most.done,
    })
}

/// By how much a whole percentage may be rounded in the arithmetic.
const ROUNDING: f64 = 1e-9;

/// A share as a percentage: whole, and upward, so that a limit that is passed shows.
#[must_use]
pub fn percent(share: f64) -> String {
    show((share * 100.0 - ROUNDING).ceil())
}

/// A torque without decimals.
pub(crate) fn whole(torque: f64) -> String {
    show(torque.round())
}

/// What else than the links adds to the torques of an arm.
fn missing(model: &Model) -> impl Iterator<Item = Covered> {
    let arm = model.mechanism.ortho_parallel();
    let rods = arm.is_some_and(|arm| arm.coupling == Coupling::Parallelogram);
    let rods = rods.then_some(Covered::Rods);
    rods.into_iter()
        .chain([Covered::Motors, Covered::Balance, Covered::Friction])
}
