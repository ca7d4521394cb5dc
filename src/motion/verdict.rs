//! What keeps a machine from a program, in the words of the job: which cut, which axis, by how much, what to change.

mod outside;
mod posture;
mod size;

pub use size::too_large;

use crate::describe::{branch_words, site_words, value_words};
use crate::moves::{pacing, path_of};
use crate::path::{Singularity, Violation};
use crate::rig::Rig;
use crate::solve::{LEAST_CLEARANCE, Unreachable};
use crate::stray::{LARGEST, Stray};
use crate::sweep::{BladePart, Cure, Sweep};
use crate::trouble::{Count, Failing, Leads, Trouble};
use crate::way::{Obstacle, Obstruction};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Axis, AxisKind, MachineKind, OpId, Program, Site};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::segments::{LimitedBy, LinearSegment, Path};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{CheckedJob, Machine, Setup};
use vcutc_machine::LimitPlaces;

/// Why a program is not carried out.
pub struct Explained {
    pub diagnostic: Diagnostic,
    /// What to do where no single change is known to help. None where neither the machine nor the place of the work is the
    /// cause, and the diagnostic says all.
    pub advice: Option<String>,
}

impl Explained {
    /// The diagnostic with its advice.
    #[must_use]
    pub fn with_advice(self) -> Diagnostic {
        match self.advice {
            Some(advice) => self.diagnostic.help(advice),
            None => self.diagnostic,
        }
    }
}

/// Explains why the program of a job is not carried out. A job without a machine has nothing to explain.
#[must_use]
pub fn explain(job: &CheckedJob, unreachable: &Unreachable) -> Option<Explained> {
    let scene = Scene {
        job,
        machine: job.machine.as_ref()?,
        program: unreachable.program.program(),
    };
    let trouble = &unreachable.trouble;
    Some(match scene.of_the_job_alone(trouble) {
        Some(diagnostic) => Explained {
            diagnostic,
            advice: None,
        },
        None => Explained {
            diagnostic: scene.trouble(trouble),
            advice: Some(scene.general(trouble)),
        },
    })
}

/// A job, its machine and the program made of it.
struct Scene<'s> {
    job: &'s CheckedJob,
    machine: &'s Machine,
    program: &'s Program,
}

impl<'s> Scene<'s> {
    /// What to do where no single change was found.
    fn general(&self, trouble: &Trouble) -> String {
        match trouble {
            Trouble::Motion { failing, hardest, .. } => match failing.worst.what {
                Violation::OutOfReach => {
                    "move the work closer to the machine with `base`, or choose a machine with a longer reach".to_owned()
                }
                Violation::Limit { .. } => {
                    "turn or shift the work with `base`, so that this axis stays in its range".to_owned()
                }
                Violation::Rate { axis, .. } => {
                    let slow_enough = self
                        .slow_enough(failing, hardest.as_ref())
                        .map_or_else(String::new, |speed| format!(" (this motion needs {speed} or less)"));
                    // How far a linear axis travels for a cut does not depend on where the work lies.
                    let is_linear = self.axis(axis).is_some_and(|axis| axis.kind == AxisKind::Linear);
                    let or_else = match self.limited_by(failing.op) {
                        Some(LimitedBy::Feed(_)) if is_linear => "",
                        Some(LimitedBy::Feed(_) | LimitedBy::Rate(_)) | None => {
                            ", or shift the work with `base` to where the axis turns less"
                        }
                    };
                    format!("lower this speed{slow_enough}{or_else}")
                }
                Violation::Singular(_) => {
                    "shift or turn the work with `base`, or tilt the tool in its mount, so that the arm stays bent"
                        .to_owned()
                }
            },
            Trouble::NoCommonBranch { failing, .. } => {
                let direction = self.asked(failing.op).and_then(|asked| asked.direction);
                let forward = if direction.is_some() {
                    "let the blade come up between cuts with `direction = forward`, so that the arm can change there, or "
                } else {
                    ""
                };
                format!("{forward}shift or turn the work with `base`")
            }
            Trouble::Way { .. } => {
                "choose a `home` from which the blade comes to the work from above".to_owned()
            }
            Trouble::Sweep(sweep) => match sweep.cure {
                Cure::HigherUp(_) => {
                    "turn the blade higher above the work, with a larger `clearance`".to_owned()
                }
                Cure::FartherOut(_) | Cure::Unknown => {
                    let field = self.asked(sweep.op).map_or("extension", |asked| asked.turning_field().0);
                    format!("turn the blade farther beside the work, with a larger `{field}`")
                }
            },
            Trouble::Stray(_) => {
                "let the blade turn about an axis of the machine: turn the work with `base` until its vertical is parallel to that axis; or divide the way into shorter pieces".to_owned()
            }
            Trouble::Nowhere => "bring the work and the machine together with `base`".to_owned(),
        }
    }

    /// The speed at which the axes are just fast enough for these motions; others may need a lower one. Rates grow in proportion to the speed that paces a motion.
    fn slow_enough(&self, failing: &Failing, hardest: Option<&Failing>) -> Option<String> {
        let (span, _) = self.speed(failing.op);
        let is_paced_alike = |other: &&Failing| self.speed(other.op).0 == span;
        let share = [Some(failing), hardest.filter(is_paced_alike)]
            .into_iter()
            .flatten()
            .filter_map(|failing| match failing.worst.what {
                Violation::Rate { axis, rate } => Some(self.axis(axis)?.rate? / rate),
                Violation::OutOfReach | Violation::Limit { .. } | Violation::Singular(_) => None,
            })
            .reduce(f64::min)?;
        let (asked, unit) = match self.limited_by(failing.op)? {
            LimitedBy::Feed(feed) => (feed.to_mm_per_s(), "mm/s"),
            LimitedBy::Rate(rate) => (rate.to_rad_per_s().to_degrees(), "deg/s"),
        };
        // Downwards, to whole units or to a hundredth of slow ones.
        let steps = if asked * share >= 10.0 { 1.0 } else { 100.0 };
        let enough = (asked * share * steps).floor() / steps;
        (enough > 0.0).then(|| format!("{} {unit}", show(enough)))
    }

    fn trouble(&self, trouble: &Trouble) -> Diagnostic {
        match trouble {
            Trouble::Motion {
                failing,
                other_cuts,
                hardest,
            } => self.motion(failing, *other_cuts, hardest.as_ref()),
            Trouble::NoCommonBranch { failing, other } => self.no_common_branch(failing, other),
            Trouble::Way { op, leads, obstacle } => self.way(*op, *leads, obstacle),
            Trouble::Sweep(sweep) => self.sweep(sweep),
            Trouble::Stray(stray) => self.stray(stray),
            Trouble::Nowhere => Diagnostic::new(
                Code::OutOfReach,
                "the machine reaches no pose of this job",
                self.base(),
                "with the work in this place",
            ),
        }
    }

    /// What no place of the work mends: a posture that a five-axis machine cannot hold, or a length that carries the blade away.
    fn of_the_job_alone(&self, trouble: &Trouble) -> Option<Diagnostic> {
        self.lacks_an_axis(trouble).or_else(|| self.far_outside(trouble))
    }

    fn far_outside(&self, trouble: &Trouble) -> Option<Diagnostic> {
        let failing = trouble.failing()?;
        match failing.worst.what {
            Violation::OutOfReach | Violation::Limit { .. } => {}
            Violation::Rate { .. } | Violation::Singular(_) => return None,
        }
        let op = self.program.op(failing.op)?;
        let place = self.place(failing.op);
        outside::far_outside(self.job, &place, op, self.tip(failing.op)?)
    }

    /// A posture that a five-axis machine cannot hold wherever the work is.
    fn lacks_an_axis(&self, trouble: &Trouble) -> Option<Diagnostic> {
        let failing = match trouble {
            Trouble::Motion { failing, .. } => failing,
            Trouble::NoCommonBranch { .. }
            | Trouble::Way { .. }
            | Trouble::Sweep(_)
            | Trouble::Stray(_)
            | Trouble::Nowhere => return None,
        };
        let taught = match path_of(self.program, failing.op)? {
            Path::Axes(pose) => [None, Some(pose)],
            Path::Linear(line) => [Some(line.from), Some(line.to)],
            Path::Still | Path::Home | Path::Change => return None,
        };
        let place = self.place(failing.op);
        taught.into_iter().flatten().find_map(|pose| {
            let held = self.program.orientation(pose.orientation)?;
            posture::lacks_an_axis(self.machine, &place, pose.tip, held)
        })
    }

    fn motion(&self, failing: &Failing, other_cuts: Count, hardest: Option<&Failing>) -> Diagnostic {
        let place = self.place(failing.op);
        let (at, base) = (self.along(failing), self.base());
        let diagnostic = match failing.worst.what {
            Violation::OutOfReach => Diagnostic::new(
                Code::OutOfReach,
                format!("the machine does not reach {place}"),
                base,
                "no axis values bring the blade there with the work in this place",
            )
            .and(self.machine.model_span, self.out_of_reach(failing.op)),
            Violation::Limit { axis, value } => self.limit(&place, axis, value, base),
            Violation::Rate { axis, rate } => self.rate(&place, axis, rate, failing.op),
            Violation::Singular(singularity) => self.singular(&place, singularity, base),
        };
        let diagnostic = diagnostic.note(at);
        let diagnostic = match failing.branch {
            Some(branch @ Branch::Arm { .. }) => {
                diagnostic.note(format!("tried with {}", branch_words(branch)))
            }
            Some(Branch::Numbered(_)) | None => diagnostic,
        };
        let diagnostic = match hardest {
            Some(hardest) => diagnostic.note(self.hardest(hardest)),
            None => diagnostic,
        };
        match other_cuts {
            Count::Exactly(0) => diagnostic,
            Count::Exactly(1) => diagnostic.note("one more cut is affected"),
            Count::Exactly(others) => diagnostic.note(format!("{others} more cuts are affected")),
            Count::AtLeast(others) => diagnostic.note(format!("at least {others} more cuts are affected")),
        }
    }

    /// How far from an arm the tip would be, where that is farther than it comes with its tool.
    fn out_of_reach(&self, op: OpId) -> String {
        let model = &self.machine.model;
        let reach = model.reach();
        let either = format!(
            "the work is out of the reach of `{}`: too far or too close",
            model.name
        );
        match (model.kind(), self.tip(op)) {
            (MachineKind::Robot, Some(tip)) => {
                let there = Rig::of(self.machine).point_in_root(tip);
                let tool = self.machine.tools.first().frame.value.frame.origin;
                let aside = libm::hypot(there.x, there.y);
                // No arm stands higher than half its reach.
                let (distance, within) = if there.z.abs() > 1.5 * reach {
                    (libm::hypot(aside, there.z), 1.5 * reach)
                } else {
                    (aside, reach)
                };
                if distance <= within + libm::hypot(libm::hypot(tool.x, tool.y), tool.z) {
                    return either;
                }
                format!(
                    "`{}` comes {} mm from its axis 1 with the flange; the work is {} mm away there",
                    model.name,
                    show(reach.round()),
                    show(distance.round())
                )
            }
            (MachineKind::Robot, None) | (MachineKind::FiveAxis, _) => either,
        }
    }

    /// What lacks most: a first motion that lacks little is not all there is to change.
    fn hardest(&self, failing: &Failing) -> String {
        let place = self.place(failing.op);
        let named = |axis: usize| self.axis(axis);
        match failing.worst.what {
            Violation::OutOfReach => format!("{place} is out of reach altogether"),
            Violation::Limit { axis, value } => match named(axis) {
                Some(axis) => format!(
                    "worst at {place}: {} would be at {}",
                    axis.name,
                    value_words(axis, value)
                ),
                None => format!("worst at {place}"),
            },
            Violation::Rate { axis, rate } => match named(axis) {
                Some(axis) => format!(
                    "worst at {place}: {} would need {}/s",
                    axis.name,
                    value_words(axis, rate)
                ),
                None => format!("worst at {place}"),
            },
            Violation::Singular(_) => format!("{place} comes closest to a singularity"),
        }
    }

    fn limit(&self, place: &str, axis: usize, value: f64, base: Span) -> Diagnostic {
        let span = self.limits_of(axis).range.unwrap_or(self.machine.model_span);
        let Some(axis) = self.axis(axis) else {
            return self.unnamed(Code::AxisLimit, place, base);
        };
        let limit = if value < axis.min { axis.min } else { axis.max };
        let beyond = value_words(axis, (value - limit).abs());
        let (name, limit) = (&axis.name, value_words(axis, limit));
        Diagnostic::new(
            Code::AxisLimit,
            format!(
                "{place} takes {name} to {}, {beyond} beyond its limit",
                value_words(axis, value)
            ),
            base,
            "with the work in this place",
        )
        .and(span, format!("{name} ends at {limit}"))
    }

    fn rate(&self, place: &str, axis: usize, rate: f64, op: OpId) -> Diagnostic {
        let (span, speed) = self.speed(op);
        let stated = self.limits_of(axis).rate.unwrap_or(self.machine.model_span);
        let Some(axis) = self.axis(axis) else {
            return self.unnamed(Code::AxisRate, place, span);
        };
        let name = &axis.name;
        let fastest = axis.rate.map_or_else(String::new, |fastest| {
            format!("the limit of {name} is {}/s", value_words(axis, fastest))
        });
        let limit = axis.rate.map_or_else(String::new, |fastest| {
            format!("; its limit is {}/s", value_words(axis, fastest))
        });
        Diagnostic::new(
            Code::AxisRate,
            format!(
                "{place} needs {}/s of {name} at {speed}{limit}",
                value_words(axis, rate)
            ),
            span,
            "too fast for this axis there",
        )
        .and(stated, fastest)
    }

    fn singular(&self, place: &str, singularity: Singularity, base: Span) -> Diagnostic {
        let least = LEAST_CLEARANCE;
        let (what, label) = match singularity {
            Singularity::Wrist(angle) => (
                format!(
                    "the wrist within {} of straight, where two axes align",
                    degrees(angle)
                ),
                format!(
                    "the axis between them must be bent by at least {}",
                    degrees(least.wrist)
                ),
            ),
            Singularity::Elbow(angle) => (
                format!("the arm within {} of stretched or folded", degrees(angle)),
                format!("its elbow must be bent by at least {}", degrees(least.elbow)),
            ),
            Singularity::Shoulder(distance) => (
                format!("the wrist within {} mm of the first axis", show(distance)),
                format!("it must be at least {} mm away", show(least.shoulder)),
            ),
        };
        Diagnostic::new(
            Code::NearSingular,
            format!("{place} takes {what}"),
            base,
            "with the work in this place",
        )
        .and(self.machine.model_span, label)
    }

    /// An axis that the machine does not have; cannot be.
    fn unnamed(&self, code: Code, place: &str, span: Span) -> Diagnostic {
        Diagnostic::new(
            code,
            format!("the machine cannot carry out {place}"),
            span,
            "from here",
        )
    }

    fn no_common_branch(&self, failing: &Failing, other: &Failing) -> Diagnostic {
        let words = |failing: &Failing| {
            let branch = failing.branch.map(branch_words).unwrap_or_default();
            format!("with {branch} {}", self.reason(failing))
        };
        Diagnostic::new(
            Code::NoCommonBranch,
            format!(
                "no single configuration works for all motions between {} and {}",
                self.place(failing.op.min(other.op)),
                self.place(failing.op.max(other.op))
            ),
            self.base(),
            "with the work in this place",
        )
        .and(
            self.machine.model_span,
            "each motion is possible, but the arm cannot change its configuration within them",
        )
        .note(words(failing))
        .note(words(other))
    }

    /// Why a motion fails, in half a sentence.
    fn reason(&self, failing: &Failing) -> String {
        let place = self.place(failing.op);
        match failing.worst.what {
            Violation::OutOfReach => format!("{place} is out of reach"),
            Violation::Limit { axis, value } => match self.axis(axis) {
                Some(axis) => format!("{place} takes {} to {}", axis.name, value_words(axis, value)),
                None => format!("{place} leaves the range of an axis"),
            },
            Violation::Rate { axis, rate } => match self.axis(axis) {
                Some(axis) => format!("{place} takes {} to {}/s", axis.name, value_words(axis, rate)),
                None => format!("{place} is too fast for an axis"),
            },
            Violation::Singular(_) => format!("{place} comes too close to a singularity"),
        }
    }

    fn way(&self, op: OpId, leads: Leads, obstacle: &Obstacle) -> Diagnostic {
        let home = self.machine.home.and_then(|home| home.span);
        let span = home.unwrap_or(self.machine.head_span);
        let place = self.place(op);
        let way = match leads {
            Leads::ToPose => format!("the axis move to {place}"),
            Leads::ToHome => "the axis move home".to_owned(),
            Leads::ToChange => "the axis move to where the blade is changed".to_owned(),
        };
        let part_words = |part: BladePart| match part {
            BladePart::Edge => "blade",
            BladePart::Body => "body of the blade",
        };
        let place_words = |place: Point3| {
            let [x, y, z] = [place.x, place.y, place.z].map(show);
            format!("x {x} mm, y {y} mm, z {z} mm")
        };
        let headline = match obstacle.what {
            Obstruction::Stock(part, lowest) => format!(
                "{way} leads through the stock: the {} comes down to {}",
                part_words(part),
                place_words(lowest)
            ),
            Obstruction::Unproven(part, lowest) => format!(
                "{way} cannot be shown to keep the {} out of the stock; beside it, it comes down to {}",
                part_words(part),
                place_words(lowest)
            ),
            Obstruction::Limit => format!("{way} begins or ends beyond the limit of an axis"),
        };
        Diagnostic::new(
            Code::WayThroughStock,
            headline,
            span,
            "the machine starts here and returns here",
        )
        .and(self.base(), "the work is here")
        .note(format!(
            "the stock's top is at z {} mm; this happens {} % along the way",
            show(self.program.stock.height.to_mm()),
            show((obstacle.at * 1000.0).round() / 10.0)
        ))
        .note("in an axis move each axis goes straight to its value, so the blade does not follow a line")
    }

    fn sweep(&self, sweep: &Sweep) -> Diagnostic {
        let part = match sweep.part {
            BladePart::Edge => "an edge",
            BladePart::Body => "the blade above its edges",
        };
        let [x, y, z] = sweep.place.map(|value| show((value * 100.0).round() / 100.0));
        let asked = self.asked(sweep.op);
        let (span, label) = match (sweep.cure, asked) {
            (Cure::HigherUp(by), Some(asked)) => (
                asked.clearance.span,
                format!("turned {} mm higher, it clears the work", show_up(by)),
            ),
            (Cure::FartherOut(by), Some(asked)) => (
                asked.turning_field().1,
                format!("turned {} mm farther beside it, it clears the work", show_up(by)),
            ),
            (Cure::Unknown, Some(asked)) => (asked.turning_field().1, "the blade turns here".to_owned()),
            (_, None) => (None, "the blade turns here".to_owned()),
        };
        let span = span
            .or(asked.map(|asked| asked.head_span))
            .unwrap_or(self.machine.head_span);
        Diagnostic::new(
            Code::SweepThroughWork,
            format!(
                "{} takes {part} through the work, at x {x} mm, y {y} mm, z {z} mm",
                self.place(sweep.op)
            ),
            span,
            label,
        )
        .and(
            self.machine.model_span,
            "its control interpolates the rotary axes, each at a constant rate",
        )
        .note(format!(
            "this happens {} % along the way",
            show((sweep.at * 1000.0).round() / 10.0)
        ))
    }

    fn stray(&self, stray: &Stray) -> Diagnostic {
        let asked = self.asked(stray.op).map(|asked| asked.head_span);
        let largest = show(LARGEST);
        Diagnostic::new(
            Code::ChainPosture,
            format!(
                "the rotary axes take the blade {} mm off its planned place at {}",
                show_up(stray.by),
                self.place(stray.op)
            ),
            asked.unwrap_or(self.machine.head_span),
            "the blade turns here on its way through the work",
        )
        .and(
            self.machine.model_span,
            "its control interpolates the rotary axes, each at a constant rate",
        )
        .note(format!(
            "this is worst {} % along the way; at most {largest} mm is allowed",
            show((stray.at * 1000.0).round() / 10.0)
        ))
    }

    /// Where the machine's own file states the limits of an axis.
    fn limits_of(&self, index: usize) -> LimitPlaces {
        self.machine.limit_spans.get(index).copied().unwrap_or_default()
    }

    fn axis(&self, index: usize) -> Option<&Axis> {
        self.machine.model.axes.get(index)
    }

    fn base(&self) -> Span {
        self.machine.base.span.unwrap_or(self.machine.head_span)
    }

    /// Where in the job the speed of an op was asked for, and what it is.
    fn speed(&self, op: OpId) -> (Span, String) {
        let words = match self.limited_by(op) {
            Some(LimitedBy::Feed(feed)) => format!("{} mm/s", show(feed.to_mm_per_s())),
            Some(LimitedBy::Rate(rate)) => format!("{} deg/s", show(rate.to_rad_per_s().to_degrees())),
            None => String::new(),
        };
        let span = self
            .asked(op)
            .and_then(|asked| pacing(self.program, op)?.span(asked));
        (span.unwrap_or(self.machine.head_span), words)
    }

    fn asked(&self, op: OpId) -> Option<&Setup> {
        let operation = self.program.op(op)?.site.operation()?;
        Some(self.job.operations.get(usize::from(operation.0))?.setup())
    }

    fn line(&self, op: OpId) -> Option<LinearSegment> {
        path_of(self.program, op)?.line().copied()
    }

    /// What decides how long an op takes.
    fn limited_by(&self, op: OpId) -> Option<LimitedBy> {
        self.line(op)?.limited_by()
    }

    /// `layer 7, cut 12 (x 43.2 mm, z 18.6 mm)`.
    fn place(&self, op: OpId) -> String {
        let Some(found) = self.program.op(op) else {
            return "the program".to_owned();
        };
        let tip = self.tip(op);
        let site = site_words(self.program, found.site);
        let place = match tip {
            Some(tip) => format!("{site} (x {} mm, z {} mm)", show(tip.x), show(tip.z)),
            None => site,
        };
        match (found.site, found.action) {
            (
                Site::Cut { .. },
                Action::Travel { .. } | Action::Approach { .. } | Action::AxisTravel { .. },
            ) => {
                format!("the way to {place}")
            }
            (Site::Cut { .. }, Action::Turn { .. }) => format!("the turn at {place}"),
            (Site::Cut { .. }, Action::Retract { .. }) => format!("the way up from {place}"),
            (Site::Layer { .. }, Action::Retract { .. }) => format!("the way up from {place}"),
            (Site::Layer { .. }, _) => format!("the way to {place}"),
            (Site::Cut { .. } | Site::Operation(_) | Site::Program, _) => place,
        }
    }

    /// Where the tip comes to in an op, in the work.
    fn tip(&self, op: OpId) -> Option<Point3> {
        Some(self.program.segment(op)?.target()?.tip)
    }

    /// How far along its motion something fails.
    fn along(&self, failing: &Failing) -> String {
        let Some(line) = self.line(failing.op) else {
            return "this is where the program comes to the work".to_owned();
        };
        let [first, worst] = [failing.breach, failing.worst].map(|breach| breach.at.clamp(0.0, 1.0));
        let (length, turn) = (line.length().to_mm(), line.turn.to_deg());
        let (whole, unit) = if length > 0.0 {
            (length, "mm")
        } else {
            (turn, "deg")
        };
        let shown = |at: f64| show((at * whole * 10.0).round() / 10.0);
        let begins = format!(
            "not possible from {} {unit} of this {} {unit} motion on",
            shown(first),
            shown(1.0)
        );
        if (worst - first) * whole < 0.1 {
            begins
        } else {
            format!("{begins}; worst at {} {unit}", shown(worst))
        }
    }
}

/// A length rounded up to hundredths of a millimetre.
fn show_up(length: Length) -> String {
    show((length.to_mm() * 100.0 - 1e-6).ceil() / 100.0)
}

fn degrees(angle: f64) -> String {
    format!("{} deg", show(angle.to_degrees()))
}
