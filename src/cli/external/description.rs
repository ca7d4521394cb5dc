//! What an outside program says that it is, compared with what a backend may be.

use super::fault::{fault, line};
use vcutc_backend_api::backend::{Fault, OptionKind, OptionSpec};
use vcutc_backend_api::protocol::{DescribedOption, Description, Driven, Reads};
use vcutc_backend_api::readback::Resolution;
use vcutc_backend_api::verify::Capabilities;

/// Most options of a program, and most words of a choice.
const MOST_OPTIONS: usize = 64;

/// The key under which a job names a profile: no option can have it.
const PROFILE: &str = "profile";

/// The word by which a job takes an option back.
const DEFAULT: &str = "default";

/// Finest count of decimals: doubles have no more.
const MOST_DECIMALS: u32 = 15;

/// A program that can be asked to write.
#[derive(Debug)]
pub(super) struct Described {
    pub(super) summary: &'static str,
    pub(super) capabilities: Capabilities,
    pub(super) options: &'static [OptionSpec],
    pub(super) machines: Vec<Driven>,
    pub(super) drives: &'static str,
    pub(super) reads: Option<Reads>,
}

/// Keeps a text to the end of the process. The trait of backends speaks of texts that are part of the compiler; those of an
/// outside program are kept once for its description, and for the few problems of its one reply.
pub(super) fn kept(text: &str) -> &'static str {
    Box::leak(line(text).into_boxed_str())
}

/// The description of the program of that name.
///
/// # Errors
/// The first thing that does not fit.
pub(super) fn described(name: &str, description: Description) -> Result<Described, Fault> {
    let refused = |what: String| Err(fault(what));
    if description.id != name {
        let id = line(&description.id);
        return refused(format!(
            "says that its id is `{id}`, but its file is named for `{name}`"
        ));
    }
    if description.summary.trim().is_empty() || description.drives.trim().is_empty() {
        return refused("describes itself without `summary` or `drives`".to_owned());
    }
    if description.machines.is_empty() {
        return refused("names no machines that it drives".to_owned());
    }
    if description.options.len() > MOST_OPTIONS {
        return refused(format!("has more than {MOST_OPTIONS} options"));
    }
    let mut specs: Vec<OptionSpec> = Vec::new();
    for option in &description.options {
        let spec = spec(option)?;
        if specs.iter().any(|known| known.key == spec.key) {
            return refused(format!("has the option `{}` twice", spec.key));
        }
        specs.push(spec);
    }
    if let Some(reads) = &description.reads {
        readable(reads, &specs)?;
    }
    let capabilities = description.capabilities.iter();
    Ok(Described {
        summary: kept(&description.summary),
        capabilities: capabilities.fold(Capabilities::NONE, |all, &one| all.with(one)),
        options: Box::leak(specs.into_boxed_slice()),
        machines: description.machines,
        drives: kept(&description.drives),
        reads: description.reads,
    })
}

fn spec(option: &DescribedOption) -> Result<OptionSpec, Fault> {
    let key = line(&option.key);
    let refused = |what: &str| fault(format!("has an option `{key}` {what}"));
    if !is_name(&option.key) {
        return Err(refused(
            "whose key is not a name (letters a to z, digits and `_`, a letter first)",
        ));
    }
    if option.key == PROFILE {
        return Err(refused("which is the key under which jobs name a profile"));
    }
    if option.help.trim().is_empty() {
        return Err(refused("without help"));
    }
    let kind = option.kind.clone().with_words(|of| {
        if of.is_empty() || of.len() > MOST_OPTIONS || !of.iter().all(|word| is_name(word)) {
            return Err(refused(
                "with no words, too many words, or words that are not names",
            ));
        }
        if of.iter().any(|word| word == DEFAULT) {
            return Err(refused(
                "with the word `default`, by which jobs take an option back",
            ));
        }
        let words: Vec<&'static str> = of.iter().map(|word| kept(word)).collect();
        Ok(&*Box::leak(words.into_boxed_slice()))
    })?;
    if !is_sound(kind) {
        return Err(refused("whose default is not in its range"));
    }
    Ok(OptionSpec {
        key: kept(&option.key),
        kind,
        help: kept(&option.help),
    })
}

fn is_sound(kind: OptionKind) -> bool {
    match kind {
        OptionKind::Integer { min, max, default } => (min..=max).contains(&default),
        OptionKind::Length { min, max, default } => (min..=max).contains(&default),
        OptionKind::Lines | OptionKind::Text | OptionKind::Choice { .. } => true,
    }
}

/// Whether a job can write a word as a name.
pub(super) fn is_name(word: &str) -> bool {
    const MOST: usize = 40;
    let rest = |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '_';
    word.len() <= MOST
        && word.starts_with(|letter: char| letter.is_ascii_lowercase())
        && word.chars().all(rest)
}

fn readable(reads: &Reads, specs: &[OptionSpec]) -> Result<(), Fault> {
    if reads.extensions.is_empty() {
        return Err(fault("reads files, but names no extension of theirs"));
    }
    let Some(key) = &reads.decimals else {
        return fine_enough(&reads.resolution);
    };
    let decimals = specs.iter().find_map(|spec| match spec.kind {
        OptionKind::Integer { max, default, .. } if spec.key == key && max <= MOST_DECIMALS => Some(default),
        OptionKind::Integer { .. }
        | OptionKind::Length { .. }
        | OptionKind::Lines
        | OptionKind::Text
        | OptionKind::Choice { .. } => None,
    });
    match decimals {
        Some(decimals) => fine_enough(&divided(&reads.resolution, decimals)),
        None => {
            let key = line(key);
            Err(fault(format!(
                "counts decimals by `{key}`, which is not a whole-number option up to {MOST_DECIMALS}"
            )))
        }
    }
}

/// Whether programs printed with that resolution differ.
///
/// # Errors
/// Which of its values is too coarse, and how large it may be.
pub(super) fn fine_enough(resolution: &Resolution) -> Result<(), Fault> {
    resolution
        .is_sound()
        .map_err(|allowed| fault(format!("prints too coarsely to compare anything: {allowed}")))
}

/// A resolution divided by ten to some power.
pub(super) fn divided(resolution: &Resolution, decimals: u32) -> Resolution {
    let by = (0..decimals).fold(1.0, |power, _| power * 10.0);
    Resolution {
        length: resolution.length / by,
        attitude: resolution.attitude / by,
        axis: resolution.axis / by,
        speed: resolution.speed / by,
        rate: resolution.rate / by,
        per_minute: resolution.per_minute / by,
        time: resolution.time / by,
    }
}
