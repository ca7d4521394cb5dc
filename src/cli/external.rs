//! Targets that are programs of their own: `vcutc-backend-NAME`, looked for in the folders of `--backend-path` and then on the
//! PATH. The protocol is [`vcutc_backend_api::protocol`]; `docs/backends.md` teaches it.
//!
//! An [`External`] is a [`Backend`] like any other, so that the rest of the compiler does not know the difference. It runs its
//! program when it is first asked for something that only the program knows; listing the names runs nothing. What the
//! program answers is checked here, and what is amiss becomes [`BackendIssue::Failed`].

mod answer;
mod description;
mod fault;
mod process;

use super::args::OutsideArgs;
use description::{Described, described, divided, fine_enough, is_name};
use fault::{fault, line};
use process::{Limits, ask};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock};
use std::time::Duration;
use vcutc_backend_api::backend::{
    Backend, BackendIssue, Emission, EmitError, Fault, MachineMismatch, OptionSpec, Options, Origin,
};
use vcutc_backend_api::bundle::Sink;
use vcutc_backend_api::exchange::Exchange;
use vcutc_backend_api::ir::{AxisValues, Cell, MachineKind, Maker, OpId};
use vcutc_backend_api::motion::{Branch, ReachableProgram};
use vcutc_backend_api::protocol::{
    Ask, Description, Emit, Emitted, PROGRAM_PREFIX, PROTOCOL_VERSION, Read, ReadBack, Request,
    branch_as_configuration, values,
};
use vcutc_backend_api::readback::{
    Configuration, Effect, Frames, Place, ProgramFile, Reader, Resolution, Sources, Statement,
};
use vcutc_backend_api::units::{self, Angle, AngularSpeed, Length, Speed};
use vcutc_backend_api::verify::{Capabilities, Capability};

/// Largest description, in bytes.
const LARGEST_DESCRIPTION: usize = 1 << 20;

/// Largest program with its account of ops, in bytes: some millions of lines.
const LARGEST_REPLY: usize = 1 << 28;

/// A target that is a program outside of the compiler.
#[derive(Debug)]
pub(super) struct External {
    name: &'static str,
    path: PathBuf,
    time: Duration,
    described: OnceLock<Result<Described, Fault>>,
    /// The reading that failed last: the trait's readers report statements, and have no other way to say that
    /// there are none.
    unread: Mutex<Option<Fault>>,
}

/// The programs that can be found, by their names; of several with one name the first that is found.
pub(super) fn found(args: &OutsideArgs) -> Vec<&'static External> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = args
        .backend_path
        .iter()
        .map(PathBuf::from)
        .chain(std::env::split_paths(&path));
    let mut found: Vec<External> = Vec::new();
    for folder in folders {
        for (name, path) in programs(&folder) {
            if !found.iter().any(|known| known.name == name) {
                found.push(External::new(
                    &name,
                    path,
                    Duration::from_secs(args.backend_timeout),
                ));
            }
        }
    }
    found.sort_by_key(|external| external.name);
    // They are targets of this process, as those that are linked in.
    found
        .into_iter()
        .map(|external| &*Box::leak(Box::new(external)))
        .collect()
}

/// The programs of a folder, in the order of their names. Folders that cannot be read have none: the PATH names many.
fn programs(folder: &Path) -> Vec<(String, PathBuf)> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut programs: Vec<(String, PathBuf)> = entries
        .filter_map(|entry| {
            let name = target_of(entry.file_name().to_str()?)?.to_owned();
            entry.path().is_file().then(|| (name, entry.path()))
        })
        .collect();
    programs.sort();
    programs
}

/// The target whose program has that file name.
fn target_of(file: &str) -> Option<&str> {
    let name = file.strip_prefix(PROGRAM_PREFIX)?;
    let name = if cfg!(windows) {
        let (stem, ending) = name.rsplit_once('.')?;
        let starts = ["exe", "cmd", "bat"]
            .iter()
            .any(|known| ending.eq_ignore_ascii_case(known));
        starts.then_some(stem)?
    } else {
        name
    };
    is_name(name).then_some(name)
}

impl External {
    fn new(name: &str, path: PathBuf, time: Duration) -> Self {
        Self {
            name: Box::leak(name.to_owned().into_boxed_str()),
            path,
            time,
            described: OnceLock::new(),
            unread: Mutex::new(None),
        }
    }

    /// Where its program is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    fn described(&self) -> Result<&Described, &Fault> {
        let description = self.described.get_or_init(|| {
            let description: Description = self.ask(Ask::Describe, LARGEST_DESCRIPTION)?;
            described(self.name, description)
        });
        description.as_ref()
    }

    fn ask<T: DeserializeOwned>(&self, ask_for: Ask<'_>, reply: usize) -> Result<T, Fault> {
        let request = Request {
            protocol: PROTOCOL_VERSION,
            compiler: Cow::Borrowed(env!("CARGO_PKG_VERSION")),
            ask: ask_for,
        };
        let question =
            serde_json::to_vec(&request).map_err(|error| fault(format!("cannot be started: {error}")))?;
        let limits = Limits {
            time: self.time,
            reply,
        };
        understood(&ask(&self.path, question, limits)?)
    }

    fn write(
        &self,
        program: &ReachableProgram,
        options: &Options,
    ) -> Result<Vec<ProgramFile>, Vec<BackendIssue>> {
        let described = self
            .described()
            .map_err(|fault| vec![BackendIssue::Failed(fault.clone())])?;
        let refused: Vec<_> = wrong_machine(described, program.program().cell.as_ref())
            .into_iter()
            .chain(missing(described, program))
            .collect();
        if !refused.is_empty() {
            return Err(refused);
        }
        // The job may have asked for fewer decimals than the description has by itself.
        if described.reads.is_some() {
            fine_enough(&self.resolution(options)).map_err(|fault| vec![BackendIssue::Failed(fault)])?;
        }
        let emit = Emit {
            program: Exchange::of(program.program(), Some(program.motion())),
            options: values(options),
            profile: Cow::Borrowed(options.profile()),
        };
        let emitted: Emitted = self
            .ask(Ask::Emit(emit), LARGEST_REPLY)
            .map_err(|fault| vec![BackendIssue::Failed(fault.clone())])?;
        answer::files(emitted, program.program().ops.len(), described)
    }
}

/// A reply in this protocol.
fn understood<T: DeserializeOwned>(reply: &[u8]) -> Result<T, Fault> {
    /// What every reply has, whatever its version.
    #[derive(Deserialize)]
    struct Versioned {
        protocol: u32,
    }
    let other = |error: serde_json::Error| {
        let error = line(&error.to_string());
        Fault {
            said: vec![beginning(reply)],
            ..fault(format!(
                "answers something other than the protocol requires: {error}"
            ))
        }
    };
    let Versioned { protocol } = serde_json::from_slice(reply).map_err(other)?;
    if protocol != PROTOCOL_VERSION {
        return Err(fault(format!(
            "speaks version {protocol} of the protocol, this compiler version {PROTOCOL_VERSION}"
        )));
    }
    serde_json::from_slice(reply).map_err(other)
}

/// What a reply looks like.
fn beginning(reply: &[u8]) -> String {
    const MOST: usize = 80;
    let start = reply.get(..reply.len().min(MOST)).unwrap_or_default();
    match line(&String::from_utf8_lossy(start)).as_str() {
        "" => "(nothing)".to_owned(),
        start => format!("{start} ..."),
    }
}

fn wrong_machine(described: &Described, cell: Option<&Cell>) -> Option<BackendIssue> {
    let cell = cell?;
    Some(BackendIssue::WrongMachine {
        mismatch: foreign(described, cell.kind, cell.maker)?,
        drives: described.drives,
    })
}

/// What sets machines of a kind and maker apart from those that the program says it drives.
fn foreign(described: &Described, kind: MachineKind, maker: Maker) -> Option<MachineMismatch> {
    let of_kind = || described.machines.iter().filter(|driven| driven.kind == kind);
    if of_kind().next().is_none() {
        Some(MachineMismatch::Kind)
    } else if of_kind().any(|driven| driven.makers.is_empty() || driven.makers.contains(&maker)) {
        None
    } else {
        Some(MachineMismatch::Maker)
    }
}

/// The first op for each capability that the program lacks.
fn missing(described: &Described, program: &ReachableProgram) -> Vec<BackendIssue> {
    let missing = program.verified().needs().missing_from(described.capabilities);
    missing
        .map(|capability| BackendIssue::Unsupported {
            op: OpId(0),
            what: capability.words(),
        })
        .collect()
}

impl Backend for External {
    fn id(&self) -> &'static str {
        self.name
    }

    fn summary(&self) -> &'static str {
        self.described().map_or("", |described| described.summary)
    }

    fn origin(&self) -> Origin {
        Origin::Outside
    }

    fn capabilities(&self) -> Capabilities {
        match self.described() {
            Ok(described) => described.capabilities,
            // Nothing is lacking then but the program itself, which `ready` and `check` report.
            Err(_) => Capability::ALL
                .into_iter()
                .fold(Capabilities::NONE, Capabilities::with),
        }
    }

    fn options(&self) -> &'static [OptionSpec] {
        self.described().map_or(&[], |described| described.options)
    }

    fn ready(&self) -> Result<(), Fault> {
        self.described().map_err(Fault::clone)?;
        let unread = self.unread.lock().ok().and_then(|fault| fault.clone());
        unread.map_or(Ok(()), Err)
    }

    fn mismatch(&self, kind: MachineKind, maker: Maker) -> Option<MachineMismatch> {
        foreign(self.described().ok()?, kind, maker)
    }

    fn reader(&self) -> Option<&dyn Reader> {
        let reads = self.described().ok()?.reads.is_some();
        reads.then_some(self)
    }

    fn check<'p>(
        &self,
        program: &'p ReachableProgram,
        options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
        Ok(Box::new(Written(self.write(program, options)?)))
    }
}

/// Files that are there already.
struct Written(Vec<ProgramFile>);

impl Emission for Written {
    fn write(&self, sink: &mut dyn Sink) -> Result<(), EmitError> {
        for file in &self.0 {
            sink.file(&file.name)?;
            sink.write(file.text.as_bytes())?;
        }
        Ok(())
    }
}

/// How finely a program prints that cannot be started: what it writes is not read.
const EXACT: Resolution = Resolution {
    length: Length::ZERO,
    attitude: Angle::ZERO,
    axis: Angle::ZERO,
    speed: Speed::ZERO,
    rate: AngularSpeed::ZERO,
    per_minute: 0.0,
    time: units::Duration::ZERO,
};

impl Reader for External {
    fn recognises(&self, file: &str) -> bool {
        let Some((_, extension)) = file.rsplit_once('.') else {
            return false;
        };
        let reads = self
            .described()
            .ok()
            .and_then(|described| described.reads.as_ref());
        let known = reads.into_iter().flat_map(|reads| &reads.extensions);
        known
            .into_iter()
            .any(|known| known.eq_ignore_ascii_case(extension))
    }

    fn resolution(&self, options: &Options) -> Resolution {
        let reads = self
            .described()
            .ok()
            .and_then(|described| described.reads.as_ref());
        reads.map_or(EXACT, |reads| match &reads.decimals {
            Some(key) => divided(&reads.resolution, options.integer(key)),
            None => reads.resolution,
        })
    }

    fn frames(&self) -> Frames {
        let reads = self
            .described()
            .ok()
            .and_then(|described| described.reads.as_ref());
        reads.map_or(Frames::OnMachine, |reads| reads.frames)
    }

    fn configuration(&self, branch: Branch, _axes: AxisValues) -> Option<Configuration> {
        Some(branch_as_configuration(branch))
    }

    fn read(&self, sources: Sources<'_>, visit: &mut dyn FnMut(Statement)) {
        let read = Read {
            files: Cow::Borrowed(sources.files),
            cell: Cow::Borrowed(sources.cell),
            options: values(sources.options),
            profile: Cow::Borrowed(sources.options.profile()),
        };
        let statements = self
            .ask(Ask::Read(read), LARGEST_REPLY)
            .and_then(|answer: ReadBack| {
                match answer
                    .statements
                    .iter()
                    .find(|statement| !is_there(statement.place, sources.files))
                {
                    Some(Statement { place, .. }) => Err(fault(format!(
                        "reads bytes {} to {} of file {}, which are not there",
                        place.start, place.end, place.file
                    ))),
                    None => Ok(answer.statements),
                }
            });
        match statements {
            Ok(statements) => statements.into_iter().for_each(visit),
            Err(fault) => {
                visit(unread(self.name, &fault));
                if let Ok(mut unread) = self.unread.lock() {
                    *unread = Some(fault);
                }
            }
        }
    }
}

/// Whether a place is one of the text of a file, from letter to letter.
fn is_there(place: Place, files: &[ProgramFile]) -> bool {
    let file = files.get(place.file as usize);
    file.is_some_and(|file| file.text.get(place.start as usize..place.end as usize).is_some())
}

/// What a reader that could not read at all reports.
fn unread(name: &str, fault: &Fault) -> Statement {
    Statement {
        place: Place {
            file: 0,
            start: 0,
            end: 0,
        },
        effect: Effect::Unreadable {
            expected: format!("what the program of `{name}` would read (it {})", fault.what),
        },
    }
}
