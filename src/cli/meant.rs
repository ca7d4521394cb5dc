//! Targets for people who name none, or one that does not exist: those that drive the machine of their job.

use super::Targets;
use super::args::Overrides;
use super::console::Failure;
use super::files::Disk;
use vcutc_backend_api::backend::Origin;
use vcutc_backend_api::protocol::PROGRAM_PREFIX;
use vcutc_diagnostics::suggest::nearest;
use vcutc_driver::{self as driver, Request, Typed};

/// What is known of the machine of the jobs on a command line.
pub(super) enum Driven<'a> {
    /// Nothing: there is no job, it has errors, or there are several with different machines.
    Unknown,
    /// The job states no machine.
    NoMachine,
    Machine {
        /// As messages say it.
        words: String,
        /// The targets of this build that drive machines of its kind and maker.
        drivers: Vec<&'static str>,
        /// The job, or the first of several with such a machine.
        job: Job<'a>,
    },
}

/// A job on the command line.
#[derive(Clone, Copy)]
pub(super) struct Job<'a> {
    path: &'a str,
    overrides: &'a Overrides,
    targets: &'a Targets,
}

impl<'a> Driven<'a> {
    /// Reads the jobs, up to their machine.
    pub(super) fn of(jobs: &'a [String], overrides: &'a Overrides, targets: &'a Targets) -> Self {
        let mut each = jobs.iter().map(|path| {
            Self::of_one(Job {
                path,
                overrides,
                targets,
            })
        });
        let Some(first) = each.next() else {
            return Self::Unknown;
        };
        if each.all(|other| other.is_as(&first)) {
            first
        } else {
            Self::Unknown
        }
    }

    fn is_as(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Unknown, Self::Unknown) | (Self::NoMachine, Self::NoMachine) => true,
            (Self::Machine { words, .. }, Self::Machine { words: others, .. }) => words == others,
            (Self::Unknown | Self::NoMachine | Self::Machine { .. }, _) => false,
        }
    }

    fn of_one(job: Job<'a>) -> Self {
        let Job {
            path,
            overrides,
            targets,
        } = job;
        let disk = Disk::around(path);
        let Some(checked) = driver::understood(overrides.request(&disk, targets)) else {
            return Self::Unknown;
        };
        let Some(machine) = checked.machine else {
            return Self::NoMachine;
        };
        let model = &machine.model;
        // Targets that are programs of their own are asked only when they are named.
        let linked = targets
            .iter()
            .filter(|backend| backend.origin() == Origin::Linked);
        let drivers = linked.filter(|backend| backend.mismatch(model.kind(), model.maker).is_none());
        Self::Machine {
            words: driver::machine_words(model),
            drivers: drivers.map(|backend| backend.id()).collect(),
            job,
        }
    }
}

/// How often options that do not fit are taken back: without one of them, others may not fit.
const MOST_ROUNDS: usize = 3;

impl Job<'_> {
    /// The options with which a target takes the job's program: those given, and the word `default` for each of the block's
    /// that does not go together with them. None where that is not enough.
    fn fitting(&self, target: &str, given: &[String]) -> Option<Vec<String>> {
        let mut backends = self.targets.iter().copied();
        let backend = backends.find(|backend| backend.id() == target)?;
        let disk = Disk::around(self.path);
        let mut options = given.to_vec();
        for _ in 0..MOST_ROUNDS {
            let request = Request {
                options: Typed {
                    target,
                    given: &options,
                    beside: "",
                },
                ..self.overrides.request(&disk, self.targets)
            };
            let misfits = driver::misfits(request, backend)?;
            if misfits.is_empty() {
                return Some(options);
            }
            let taken_back = misfits.into_iter().map(|key| format!("{key}=default"));
            let before = options.len();
            let taken_back: Vec<String> = taken_back.filter(|option| !options.contains(option)).collect();
            options.extend(taken_back);
            // What is missing is not had by taking options back.
            if options.len() == before {
                return None;
            }
        }
        None
    }
}

/// A target under the name of a maker, a control or a language.
struct Meant {
    target: &'static str,
    /// The dialect of G-code.
    dialect: Option<&'static str>,
}

impl Meant {
    /// As it is typed, with what else the job needs then as far as that was found by trying.
    fn flags(&self, asking: &Driven<'_>) -> String {
        let target = self.target;
        let given: Vec<String> = self
            .dialect
            .iter()
            .map(|dialect| format!("dialect={dialect}"))
            .collect();
        let fitting = match asking {
            Driven::Machine { job, .. } if !given.is_empty() => job.fitting(target, &given),
            Driven::Machine { .. } | Driven::Unknown | Driven::NoMachine => None,
        };
        let options = fitting.unwrap_or(given);
        let options: String = options
            .iter()
            .map(|option| format!(" --option {option}"))
            .collect();
        format!("--target {target}{options}")
    }
}

/// The target that people mean who know its machines or controls by these names.
fn known_otherwise(name: &str) -> Option<Meant> {
    let (target, dialect) = match name.to_ascii_lowercase().as_str() {
        "kuka" | "krc" | "krc2" | "krc4" | "krc5" | "src" => ("krl", None),
        "abb" | "irc5" | "omnicore" | "mod" => ("rapid", None),
        "fanuc" => ("gcode", Some("fanuc")),
        "sinumerik" | "siemens" | "840d" | "mpf" => ("gcode", Some("sinumerik")),
        "heidenhain" | "tnc" | "itnc" => ("gcode", Some("heidenhain")),
        "linuxcnc" | "emc2" | "ngc" => ("gcode", Some("linuxcnc")),
        "cnc" | "nc" | "iso" | "g-code" => ("gcode", None),
        _ => return None,
    };
    Some(Meant { target, dialect })
}

/// A target that there is not, and which ones the job can use.
pub(super) fn unknown(targets: &Targets, id: &str, asking: &Driven<'_>) -> Failure {
    let failure = Failure::new(format!("there is no target `{id}`"));
    let usable: Vec<_> = match asking {
        Driven::Unknown | Driven::NoMachine => targets.iter().map(|backend| backend.id()).collect(),
        Driven::Machine { drivers, .. } => drivers.clone(),
    };
    let meant = known_otherwise(id).filter(|meant| usable.contains(&meant.target));
    let near = nearest(id, usable.iter().copied());
    let failure = match (meant, near.first(), asking) {
        (Some(meant), _, _) => failure.help(format!("did you mean `{}`?", meant.flags(asking))),
        (None, Some(near), _) => failure.help(format!("did you mean `--target {near}`?")),
        (None, None, Driven::Machine { words, drivers, .. }) => failure.help(match drivers.first() {
            Some(driver) => format!("the machine of the job is {words}: write `--target {driver}`"),
            None => format!("the machine of the job is {words}, and no target of this build drives it"),
        }),
        (None, None, Driven::Unknown | Driven::NoMachine) => failure,
    };
    failure.help(format!(
        "targets: {}; others are programs `{PROGRAM_PREFIX}NAME` on the PATH or in a folder of `--backend-path`",
        names(targets)
    ))
}

/// A place for files without any that would go there.
pub(super) fn pointless_output(output: &str, targets: &Targets, asking: &Driven<'_>) -> Failure {
    let failure = Failure::new(format!(
        "`-o {output}` gives a place for files, but no target was given, so there are none"
    ));
    let check_only = "or leave `-o` out to check the job only";
    failure.help(match asking {
        Driven::Unknown => {
            let target = targets.first().map_or("TARGET", |backend| backend.id());
            let names = names(targets);
            format!("write `--target {target} -o {output}` (targets: {names}), {check_only}")
        }
        Driven::NoMachine => format!(
            "the job has no machine to write a program for: add a `machine` block and give its target, {check_only}"
        ),
        Driven::Machine { words, drivers, .. } => match drivers.first() {
            Some(target) => format!(
                "write `--target {target} -o {output}`, which drives the machine of the job ({words}), {check_only}"
            ),
            None => format!(
                "no target of this build drives the machine of the job ({words}): leave `-o` out to check the job only"
            ),
        },
    })
}

/// The names of all targets in one line.
pub(super) fn names(targets: &Targets) -> String {
    let names: Vec<_> = targets.iter().map(|backend| backend.id()).collect();
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}
