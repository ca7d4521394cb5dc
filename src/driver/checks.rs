//! Which checks a compilation made, which it did not make, and why.
//!
//! The list is made once, from what the stages really did: what the proof of reach measured, not what a sheet promises. The
//! verdict of the summary, the sentence of the report, the list of the JSON messages and the warnings all come from it, so
//! that none of them claims a check that another one denies.

mod by_hand;
mod warnings;
mod words;

pub use words::CheckFigure;

use vcutc_backend_api::ir::Axis;
use vcutc_backend_api::units::Area;
use vcutc_dynamics::arms::Unknown;
use vcutc_dynamics::deviation;
use vcutc_dynamics::figures::{Standing as OfTorques, TorqueFigures};
use vcutc_job::{CheckedJob, Machine};
use vcutc_machine::Model;
use vcutc_machine::kinematics::Mechanism;
use vcutc_machine::kinematics::opw::Coupling;
use vcutc_motion::pace::{Basis, Kept};
use vcutc_motion::solve::{ReachReport, Reached};
use vcutc_simulation::report::Report;

/// Something that is worth knowing of a program before it runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Check {
    /// Every chip comes free, and the blade's way to it is clear.
    Chips,
    /// No cut enters the part or its allowance.
    Part,
    /// In sections across tracks on a surface strips come free and no more stays than may, and the disc enters the part between
    /// poses by no more than it may.
    Tracks,
    /// The tool keeps off the walls and the floors of pockets, and what it leaves uncut there is bounded.
    Pockets,
    /// The blade keeps off the walls that it slits and off the floors, and what it leaves at their foot is bounded.
    Walls,
    /// The same of strips and of what stays, between these sections.
    BetweenSections,
    /// Of an air cut, which cuts nothing: the tip stays above the stock.
    AboveStock,
    /// Every axis stays within its range.
    AxisLimits,
    /// This axis stays within its rate.
    AxisRate(String),
    /// The arm keeps away from its singular poses.
    SingularPoses,
    /// One configuration carries every motion that must not change it.
    Branch,
    /// The angle between the arms of a parallelogram, which its sheet cannot state.
    ElbowAngle,
    /// The edge stays out of the work while the blade turns beside it.
    Turns,
    /// At programmed speeds no axis needs more torque than its drive gives.
    Torques,
    /// How far the forces of the blade push cuts off is bounded, and no more than the limit where one is set.
    Deviation,
    /// Cuts whose tips are offset against forces stay out of the part where less pushes the blade.
    Unloaded,
    /// The time of the program counts speeding up and slowing down.
    Accelerations,
    /// Shank and holder of the blade stay out of the work: of these blades, of all where none is named.
    Holder(Vec<String>),
    /// The arm meets neither the work nor anything else in the cell.
    Collisions,
    /// The text that was written, read again, is the program.
    ReadBack,
}

/// What a check is about, as far as others ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum About<'c> {
    /// The rate of this axis.
    Rate(&'c str),
    SingularPoses,
    ElbowAngle,
    /// Motions of the machine in another way. These checks are made wherever there is a machine.
    Motions,
    /// The bodies of these blades.
    Bodies(&'c [String]),
    /// Cuts, times, loads, or the text.
    Others,
}

impl Check {
    const fn about(&self) -> About<'_> {
        match self {
            Self::AxisRate(axis) => About::Rate(axis.as_str()),
            Self::SingularPoses => About::SingularPoses,
            Self::ElbowAngle => About::ElbowAngle,
            Self::AxisLimits | Self::Branch | Self::Turns => About::Motions,
            Self::Holder(blades) => About::Bodies(blades.as_slice()),
            Self::Chips
            | Self::Part
            | Self::Tracks
            | Self::Pockets
            | Self::Walls
            | Self::BetweenSections
            | Self::AboveStock
            | Self::Torques
            | Self::Deviation
            | Self::Unloaded
            | Self::Accelerations
            | Self::Collisions
            | Self::ReadBack => About::Others,
        }
    }
}

/// The result of a check. A check that was made found nothing wrong: otherwise there is no program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    Made,
    NotMade(Reason),
}

/// Why a check was not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// The job has no machine.
    NoMachine,
    /// The machine's description lacks the number.
    NotStated,
    /// What is described of machines has no place for it.
    NoPlaceForIt,
    /// The arm has no closed form, and its distance from singularities is not measured.
    NotMeasured,
    /// Nothing states the shapes.
    NoBody,
    /// The program cuts nothing.
    AirCut,
    /// The target has no reader.
    NoReader,
    /// Sections are looked at, not what lies between them.
    SectionsOnly,
    /// Nothing states the load on the flange.
    NoLoad,
    /// It is not computed for such a machine.
    NotComputed,
    /// It is not computed for the surfaces under a disc.
    Disc,
    /// No blade states its forces.
    NoForces,
    /// Places along the program are looked at, not what lies between them.
    PlacesOnly,
    /// The numbers that it takes are not all those of the machine.
    Indicative,
    /// Without a home it is not known where the first motion starts.
    NoHome,
}

/// A check, and its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checked {
    pub check: Check,
    /// Its result.
    pub outcome: Outcome,
}

/// What is proven of a program as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// All that this compiler proves of such a job.
    Proven,
    /// Less, because something about the job's machine is not known.
    InPart,
}

/// How the text of a program was looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReadBack {
    /// It was read again, and is the program.
    Same,
    /// Its target has no reader.
    NoReader,
}

/// Whether the bodies of a job's blades are known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Bodies {
    /// Of all of them.
    Stated,
    /// Of none of them.
    Lacking,
    /// Of all but these.
    LackingOf(Vec<String>),
}

impl Bodies {
    /// Of the blades of a job.
    #[must_use]
    pub fn of(job: &CheckedJob) -> Self {
        let blades = job.operations.iter().flat_map(|operation| operation.blades());
        let (stated, lacking): (Vec<_>, Vec<_>) = blades.partition(|blade| blade.body().is_some());
        let mut names: Vec<String> = lacking.iter().map(|blade| blade.name().to_owned()).collect();
        names.sort_unstable();
        names.dedup();
        match (stated.is_empty(), names.is_empty()) {
            (_, true) => Self::Stated,
            (true, false) => Self::Lacking,
            (false, false) => Self::LackingOf(names),
        }
    }
}

/// All checks of a compilation that came to a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checks(Vec<Checked>);

/// What carries a program out, as far as there is something.
#[derive(Clone, Copy)]
pub struct Carried<'a> {
    /// The machine of the job.
    pub machine: &'a Machine,
    /// What was found of it.
    pub reached: &'a Reached,
}

impl Checks {
    /// The checks of a job whose cuts are proven.
    #[must_use]
    pub fn of(carried: Option<Carried<'_>>, basis: Basis, bodies: Bodies, report: &Report) -> Self {
        let holder = match bodies {
            Bodies::Stated => made(Check::Holder(Vec::new())),
            Bodies::Lacking => not_made(Check::Holder(Vec::new()), Reason::NoBody),
            Bodies::LackingOf(blades) => not_made(Check::Holder(blades), Reason::NoBody),
        };
        let mut all = Vec::new();
        // Pockets and slits along walls alone free no chips, and cut into no part.
        let is_of_regions = !report.cleared.is_empty() || !report.slit.is_empty();
        if !is_of_regions || report.removed > Area::mm2(0.0) {
            all.extend([made(Check::Chips), made(Check::Part)]);
        }
        if !report.tracked.is_empty() {
            all.push(made(Check::Tracks));
            all.push(not_made(Check::BetweenSections, Reason::SectionsOnly));
        }
        if !report.cleared.is_empty() {
            all.push(made(Check::Pockets));
        }
        if !report.slit.is_empty() {
            all.push(made(Check::Walls));
        }
        if report.compensations.iter().any(Option::is_some) {
            all.push(made(Check::Unloaded));
        }
        Self::after(all, carried, basis, holder)
    }

    /// The checks of an air cut.
    #[must_use]
    pub fn of_air_cut(carried: Option<Carried<'_>>, basis: Basis, bodies: Bodies) -> Self {
        let holder = match bodies {
            Bodies::Stated => not_made(Check::Holder(Vec::new()), Reason::AirCut),
            Bodies::Lacking => not_made(Check::Holder(Vec::new()), Reason::NoBody),
            Bodies::LackingOf(blades) => not_made(Check::Holder(blades), Reason::NoBody),
        };
        Self::after(vec![made(Check::AboveStock)], carried, basis, holder)
    }

    /// The checks of the cuts, and those of what carries them out.
    fn after(mut all: Vec<Checked>, carried: Option<Carried<'_>>, basis: Basis, holder: Checked) -> Self {
        match carried {
            Some(carried) => all.extend(of_machine(carried)),
            None => all.extend(without_machine()),
        }
        all.push(match carried {
            Some(carried) if counts_accelerations(&carried.machine.model, basis) => {
                made(Check::Accelerations)
            }
            Some(_) => not_made(Check::Accelerations, Reason::NotStated),
            None => not_made(Check::Accelerations, Reason::NoMachine),
        });
        all.push(holder);
        all.push(not_made(Check::Collisions, Reason::NoBody));
        Self(all)
    }

    /// The same with that of the program's text, where one was written.
    #[must_use]
    pub fn with(&self, read_back: Option<ReadBack>) -> Self {
        let of_text = read_back.map(|read_back| match read_back {
            ReadBack::Same => made(Check::ReadBack),
            ReadBack::NoReader => not_made(Check::ReadBack, Reason::NoReader),
        });
        Self(self.0.iter().cloned().chain(of_text).collect())
    }

    /// The same with that of the torques of a machine.
    #[must_use]
    pub fn with_torques(&self, known: Result<&TorqueFigures, Unknown>) -> Self {
        let reason = match known.map(TorqueFigures::standing) {
            Ok(OfTorques::Proven) => None,
            Ok(OfTorques::InPlaces) => Some(Reason::PlacesOnly),
            Ok(OfTorques::WithoutStart) => Some(Reason::NoHome),
            Ok(OfTorques::Indicative) => Some(Reason::Indicative),
            Ok(OfTorques::WithoutForces) => Some(Reason::NoForces),
            Err(Unknown::Masses) => Some(Reason::NotStated),
            Err(Unknown::Load) => Some(Reason::NoLoad),
        };
        let of_torques = match reason {
            Some(reason) => not_made(Check::Torques, reason),
            None => made(Check::Torques),
        };
        Self(self.0.iter().cloned().chain([of_torques]).collect())
    }

    /// The same with that of the deviations by the forces of its blades.
    #[must_use]
    pub fn with_deviation(&self, known: Result<(), deviation::Unknown>) -> Self {
        let of_deviation = match known {
            Ok(()) => made(Check::Deviation),
            Err(deviation::Unknown::Forces) => not_made(Check::Deviation, Reason::NoForces),
            Err(deviation::Unknown::Elasticity | deviation::Unknown::Weight) => {
                not_made(Check::Deviation, Reason::NotStated)
            }
            Err(deviation::Unknown::ClosedForm) => not_made(Check::Deviation, Reason::NotComputed),
            Err(deviation::Unknown::Disc) => not_made(Check::Deviation, Reason::Disc),
        };
        Self(self.0.iter().cloned().chain([of_deviation]).collect())
    }

    /// All of them, in a fixed order.
    pub fn iter(&self) -> impl Iterator<Item = &Checked> {
        self.0.iter()
    }

    /// Whether everything that this compiler proves of such a job is proven.
    #[must_use]
    pub fn standing(&self) -> Standing {
        let is_of_the_machine = |checked: &Checked| match (checked.check.about(), checked.outcome) {
            (_, Outcome::Made) | (About::Bodies(_) | About::Others, Outcome::NotMade(_)) => false,
            (
                About::Rate(_) | About::SingularPoses | About::ElbowAngle | About::Motions,
                Outcome::NotMade(reason),
            ) => reason != Reason::NoMachine,
        };
        if self.0.iter().any(is_of_the_machine) {
            Standing::InPart
        } else {
            Standing::Proven
        }
    }

    /// Whether a check was made.
    fn is_made(&self, check: &Check) -> bool {
        let made = Checked {
            check: check.clone(),
            outcome: Outcome::Made,
        };
        self.0.contains(&made)
    }
}

/// What reach checked.
fn of_machine(carried: Carried<'_>) -> Vec<Checked> {
    let model: &Model = &carried.machine.model;
    let report = &carried.reached.report;
    let mut all = vec![made(Check::AxisLimits)];
    let rates = model.axes.iter().enumerate().map(|(index, axis)| {
        let rate = Check::AxisRate(axis.name.clone());
        match kept_rate(axis, index, report) {
            Outcome::Made => made(rate),
            Outcome::NotMade(reason) => not_made(rate, reason),
        }
    });
    all.extend(rates);
    all.extend(singular_poses(&model.mechanism, report));
    all.extend(branch(&model.mechanism));
    all.extend(elbow(&model.mechanism));
    // Arms turn the blade about one axis, for which the extension of the cuts is computed; the sweep of machines that interpolate
    // their rotary axes is proven with the reach of the program.
    all.push(made(Check::Turns));
    all
}

/// Whether the times keep accelerations of all that moves: of every axis, or of tip and blade along the way. One number among many
/// that are not known is not enough.
fn counts_accelerations(model: &Model, basis: Basis) -> bool {
    let of_axes = model.axes.iter().all(|axis| axis.acceleration.is_some());
    let of_the_way = model.path.acceleration.is_some() && model.path.turning_acceleration.is_some();
    match basis.kept {
        Kept::Speeds => false,
        Kept::Accelerations | Kept::Jerks => of_axes || of_the_way,
    }
}

/// The checks of a machine that there is not.
fn without_machine() -> Vec<Checked> {
    let all = [
        Check::AxisLimits,
        Check::SingularPoses,
        Check::Branch,
        Check::Turns,
    ];
    all.map(|check| not_made(check, Reason::NoMachine)).to_vec()
}

/// Reach compares the rates of motions with those that are known.
fn kept_rate(axis: &Axis, index: usize, report: &ReachReport) -> Outcome {
    let measured = report.demand.rate.get(index);
    match (axis.rate, measured) {
        (Some(_), Some(_)) => Outcome::Made,
        (None, _) | (_, None) => Outcome::NotMade(Reason::NotStated),
    }
}

/// Arms with a closed form measure their distance from singularities. Machines of linear axes have none that matter: their
/// rotary axes are interpolated, and go each at a constant rate whatever the pose.
fn singular_poses(mechanism: &Mechanism, report: &ReachReport) -> Option<Checked> {
    let is_measured = || {
        report
            .demand
            .clearance
            .iter()
            .any(|nearest| nearest.value.is_finite())
    };
    match mechanism {
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => {
            Some(if is_measured() {
                made(Check::SingularPoses)
            } else {
                not_made(Check::SingularPoses, Reason::NotMeasured)
            })
        }
        Mechanism::FiveAxis(_) => None,
    }
}

/// Machines of linear axes have no arm that could stand otherwise.
fn branch(mechanism: &Mechanism) -> Option<Checked> {
    match mechanism {
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => {
            Some(made(Check::Branch))
        }
        Mechanism::FiveAxis(_) => None,
    }
}

/// A parallelogram limits the angle between its arms as well as the axes; sheets do not state it.
fn elbow(mechanism: &Mechanism) -> Option<Checked> {
    match mechanism {
        Mechanism::OrthoParallel(arm) => match arm.coupling {
            Coupling::Parallelogram => Some(not_made(Check::ElbowAngle, Reason::NoPlaceForIt)),
            Coupling::Serial => None,
        },
        Mechanism::Mounted(_) | Mechanism::Serial(_) | Mechanism::FiveAxis(_) => None,
    }
}

const fn made(check: Check) -> Checked {
    Checked {
        check,
        outcome: Outcome::Made,
    }
}

const fn not_made(check: Check, reason: Reason) -> Checked {
    Checked {
        check,
        outcome: Outcome::NotMade(reason),
    }
}
