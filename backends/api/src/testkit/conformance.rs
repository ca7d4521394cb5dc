//! What every backend promises.

use super::{reachable, two_blades};
use crate::backend::{Backend, BackendIssue, EmitError, OptionKind, OptionSpec, Options};
use crate::bundle::{Bundle, Sink, SinkError};
use crate::ir::Changer;
use crate::motion::ReachableProgram;
use crate::readback::{Comparator, Replay, Sources, program_files};
use crate::verify::{Capability, verify};
use std::collections::BTreeSet;

/// Checks the promises of the trait on the sample programs:
///
/// * options have unique keys and sound defaults;
/// * an op that needs a capability the backend lacks is refused, not written;
/// * the same program gives the same files, in plain ASCII, under plain names that differ in more than case;
/// * a sink that fails is reported;
/// * what was written is read back as the program, op by op, where the backend has a reader.
///
/// `samples` are for a machine that the dialect drives ([`super::samples_for`], [`super::five_axis_samples`]).
///
/// # Errors
/// The first promise that is broken, in words.
pub fn conformance(
    backend: &dyn Backend,
    samples: &[(&'static str, ReachableProgram)],
) -> Result<(), String> {
    conformance_with(backend, samples, &Options::defaults(backend.options()))
}

/// The same with other options than the defaults, for backends whose machines differ too much to have any.
///
/// # Errors
/// The first promise that is broken, in words.
pub fn conformance_with(
    backend: &dyn Backend,
    samples: &[(&'static str, ReachableProgram)],
    chosen: &Options,
) -> Result<(), String> {
    options(backend.options())?;
    for (name, program) in samples {
        sample(backend, program, chosen)
            .map_err(|problem| format!("{}, sample {name}: {problem}", backend.id()))?;
    }
    Ok(())
}

fn options(specs: &'static [OptionSpec]) -> Result<(), String> {
    let mut keys = BTreeSet::new();
    let mut options = Options::defaults(specs);
    for spec in specs {
        if !keys.insert(spec.key) {
            return Err(format!("option {} is there twice", spec.key));
        }
        if spec.help.is_empty() {
            return Err(format!("option {} has no help", spec.key));
        }
        let default = match spec.kind {
            OptionKind::Integer { default, .. } => crate::backend::OptionValue::Integer(default),
            OptionKind::Length { default, .. } => crate::backend::OptionValue::Length(default),
            OptionKind::Lines => crate::backend::OptionValue::Lines(Vec::new()),
            OptionKind::Text => crate::backend::OptionValue::Text(String::new()),
            OptionKind::Choice { of } => {
                let first = of.first().ok_or("a choice of nothing")?;
                crate::backend::OptionValue::Choice(first)
            }
        };
        options
            .set(spec, default)
            .map_err(|range| format!("the default of option {} is not {range}", spec.key))?;
    }
    Ok(())
}

fn sample(backend: &dyn Backend, program: &ReachableProgram, options: &Options) -> Result<(), String> {
    let bundle = emitted(backend, program, options)?;
    if let Some(cell) = &program.program().cell
        && backend.mismatch(cell.kind, cell.maker).is_some()
    {
        return Err("it writes a program for a machine that it says it does not drive".to_owned());
    }
    files(&bundle)?;
    if emitted(backend, program, options)? != bundle {
        return Err("two runs gave different bytes".to_owned());
    }
    read_back(backend, program, options, &bundle)?;
    beyond_capabilities(backend, program, options)?;
    full_disk(backend, program, options)
}

fn emitted(backend: &dyn Backend, program: &ReachableProgram, options: &Options) -> Result<Bundle, String> {
    let mut bundle = Bundle::default();
    backend
        .check(program, options)
        .map_err(|issues| format!("refused: {issues:?}"))?
        .write(&mut bundle)
        .map_err(|error| format!("not written: {error:?}"))?;
    Ok(bundle)
}

fn read_back(
    backend: &dyn Backend,
    program: &ReachableProgram,
    options: &Options,
    bundle: &Bundle,
) -> Result<(), String> {
    let Some(reader) = backend.reader() else {
        return Ok(());
    };
    let cell = program
        .program()
        .cell
        .as_ref()
        .ok_or("a sample without a machine")?;
    let files = program_files(bundle);
    if let Some(file) = files.iter().find(|file| !reader.recognises(&file.name)) {
        return Err(format!("{} is not recognised by its reader", file.name));
    }
    let sources = Sources {
        files: &files,
        cell,
        options,
    };
    let mut replay = Replay::new(
        Comparator::new(program, reader, reader.resolution(options)),
        reader.frames(),
    );
    reader.read(sources, &mut |statement| replay.take(&statement));
    match replay.finish() {
        Ok(_) => Ok(()),
        Err(divergence) => {
            let text = divergence.place.and_then(|place| {
                let file = files.get(place.file as usize)?;
                file.text.get(place.start as usize..place.end as usize)
            });
            Err(format!(
                "read back as another program: {divergence:?} at {text:?}"
            ))
        }
    }
}

fn files(bundle: &Bundle) -> Result<(), String> {
    if bundle.files().is_empty() {
        return Err("no files".to_owned());
    }
    let mut names = BTreeSet::new();
    for (name, bytes) in bundle.files() {
        let plain = name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '-'));
        if !plain || name.starts_with('.') {
            return Err(format!("{name:?} is not a plain file name"));
        }
        if !names.insert(name.to_ascii_lowercase()) {
            return Err(format!("two files are called {name}"));
        }
        if !bytes.is_ascii() {
            return Err(format!("{name} is not ASCII"));
        }
    }
    Ok(())
}

/// A backend that cannot change blades must refuse a program that does; one that can must write it.
fn beyond_capabilities(
    backend: &dyn Backend,
    program: &ReachableProgram,
    options: &Options,
) -> Result<(), String> {
    let changed = two_blades(program.program().clone(), Changer::Hand);
    let changed = verify(changed).map_err(|faults| format!("{faults:?}"))?;
    let changed = reachable(changed).map_err(|faults| format!("{faults:?}"))?;
    if backend.capabilities().has(Capability::ToolChange) {
        let bundle = emitted(backend, &changed, options)?;
        return read_back(backend, &changed, options, &bundle);
    }
    match backend.check(&changed, options) {
        Err(issues)
            if issues
                .iter()
                .any(|issue| matches!(issue, BackendIssue::Unsupported { .. })) =>
        {
            Ok(())
        }
        Err(issues) => Err(format!("a tool change gave {issues:?}")),
        Ok(_) => Err("a tool change was accepted without the capability".to_owned()),
    }
}

/// Takes files, but no bytes.
struct FullDisk;

impl Sink for FullDisk {
    fn file(&mut self, _name: &str) -> Result<(), SinkError> {
        Ok(())
    }

    fn write(&mut self, _bytes: &[u8]) -> Result<(), SinkError> {
        Err(SinkError("full".to_owned()))
    }
}

fn full_disk(backend: &dyn Backend, program: &ReachableProgram, options: &Options) -> Result<(), String> {
    let emission = backend
        .check(program, options)
        .map_err(|issues| format!("refused: {issues:?}"))?;
    match emission.write(&mut FullDisk) {
        Err(EmitError::Sink(_)) => Ok(()),
        other => Err(format!("a sink that failed gave {other:?}")),
    }
}
