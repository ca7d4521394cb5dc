//! The options of a target as the machine's block gives them.

use vcutc_backend_api::backend::{Backend, OptionKind, OptionSpec, OptionValue, Options};
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{CheckedJob, GivenOption, GivenValue, Machine, TargetOptions};

/// The option that a profile can set too.
const DECIMALS: &str = "decimals";

/// Blocks in the machine that are meant for a target that does not exist.
pub(crate) fn unknown_targets(job: &CheckedJob, targets: &[&'static dyn Backend]) -> Vec<Diagnostic> {
    let known: Vec<&str> = targets.iter().map(|backend| backend.id()).collect();
    let blocks = job.machine.iter().flat_map(|machine| &machine.targets);
    blocks
        .filter(|block| !known.contains(&block.target.as_str()))
        .map(|block| unknown_target(block, &known))
        .collect()
}

fn unknown_target(block: &TargetOptions, known: &[&str]) -> Diagnostic {
    let message = format!(
        "a machine has no block `{}`, and there is no target of that name",
        block.target
    );
    let diagnostic = Diagnostic::new(
        Code::UnknownBlock,
        message,
        block.span,
        "neither a field nor a target",
    )
    .help(format!("targets are: {}", known.join(", ")));
    match nearest(&block.target, known.iter().copied()).first() {
        Some(near) => diagnostic.fix(format!("use `{near}`"), block.span, *near),
        None => diagnostic,
    }
}

/// The options of a backend as the job gives them.
pub(crate) fn options(job: &CheckedJob, backend: &dyn Backend) -> Result<Options, Vec<Diagnostic>> {
    let specs = backend.options();
    let mut options = Options::defaults(specs);
    let Some(block) = block(job.machine.as_ref(), backend.id()) else {
        return Ok(options);
    };
    let mut diagnostics = Vec::new();
    // What the job gives itself is set over what its profile says, and that over the default.
    if let Some(profile) = &block.profile {
        diagnostics.extend(set_decimals(&mut options, specs, block, profile));
        options = options.with_profile(profile.node.clone());
    }
    for given in &block.given {
        match specs.iter().find(|spec| spec.key == given.key) {
            Some(spec) => {
                if let Err(allowed) = set(&mut options, spec, &given.value) {
                    diagnostics.push(bad_option(given, &allowed, spec));
                }
            }
            None => diagnostics.push(unknown_option(given, backend)),
        }
    }
    if diagnostics.is_empty() {
        Ok(options)
    } else {
        Err(diagnostics)
    }
}

/// The block of a machine for a target.
pub(super) fn block<'m>(machine: Option<&'m Machine>, target: &str) -> Option<&'m TargetOptions> {
    machine?.targets.iter().find(|block| block.target == target)
}

/// Where an option has a value of its own.
pub(super) fn option_span(block: &TargetOptions, key: &str) -> Option<Span> {
    let mut given = block.given.iter();
    given
        .find(|given| given.key == key && given.value != GivenValue::Default)
        .map(|given| given.value_span)
}

/// Where a profile is named that sets an option.
pub(super) fn said_by_profile(block: &TargetOptions, key: &str) -> Option<Span> {
    let profile = block.profile.as_ref()?;
    (key == DECIMALS && profile.node.decimals.is_some()).then_some(profile.span)
}

/// Sets the option `decimals` to what the profile says, where the target has that option. Where it has none, it is for the target
/// to say that it cannot follow.
fn set_decimals(
    options: &mut Options,
    specs: &'static [OptionSpec],
    block: &TargetOptions,
    profile: &Spanned<Profile>,
) -> Option<Diagnostic> {
    let spec = specs.iter().find(|spec| spec.key == DECIMALS)?;
    let decimals = profile.node.decimals?;
    let value = OptionValue::Integer(u32::from(decimals));
    let allowed = options.set(spec, value).err()?;
    if option_span(block, DECIMALS).is_some() {
        return None;
    }
    let message = format!(
        "target `{}` takes {allowed} for `{DECIMALS}`, and the profile says {decimals}",
        block.target
    );
    let diagnostic = Diagnostic::new(Code::BadOption, message, profile.span, "this profile");
    Some(diagnostic.help(format!(
        "give the block its own `{DECIMALS}`, which overrides the profile's"
    )))
}

fn set(options: &mut Options, spec: &OptionSpec, given: &GivenValue) -> Result<(), String> {
    // What cannot be converted is set to an empty list of lines, which `Options::set` refuses in the same words as a value
    // out of range. An option of lines would take it, so its refusal is worded below.
    let none = OptionValue::Lines(Vec::new());
    let value = match (spec.kind, given) {
        (OptionKind::Integer { .. }, GivenValue::Ratio(ratio)) => {
            whole(*ratio).map_or(none, OptionValue::Integer)
        }
        (OptionKind::Length { .. }, GivenValue::Length(length)) => OptionValue::Length(*length),
        (OptionKind::Lines, GivenValue::Texts(lines)) => OptionValue::Lines(lines.clone()),
        (OptionKind::Text, GivenValue::Texts(lines)) => match lines.as_slice() {
            [text] => OptionValue::Text(text.clone()),
            [] | [_, _, ..] => none,
        },
        (OptionKind::Choice { of }, GivenValue::Word(word)) => of
            .iter()
            .find(|known| *known == word)
            .map_or(none, |known| OptionValue::Choice(known)),
        (OptionKind::Lines, GivenValue::Ratio(_) | GivenValue::Length(_) | GivenValue::Word(_)) => {
            return Err("text in quotes".to_owned());
        }
        // What the profile or the target says is set already.
        (_, GivenValue::Default) => return Ok(()),
        (
            OptionKind::Integer { .. }
            | OptionKind::Length { .. }
            | OptionKind::Text
            | OptionKind::Choice { .. },
            GivenValue::Ratio(_) | GivenValue::Length(_) | GivenValue::Texts(_) | GivenValue::Word(_),
        ) => none,
    };
    options.set(spec, value)
}

/// A number without fraction that fits.
fn whole(ratio: f64) -> Option<u32> {
    let fits = ratio.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&ratio);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked on the line above"
    )]
    let number = ratio as u32;
    fits.then_some(number)
}

fn bad_option(given: &GivenOption, allowed: &str, spec: &OptionSpec) -> Diagnostic {
    let message = format!("option `{}` takes {allowed}", given.key);
    let diagnostic = Diagnostic::new(
        Code::BadOption,
        message,
        given.value_span,
        "this value does not fit",
    )
    .note(spec.help);
    match nearest_fitting(spec.kind, &given.value) {
        Some(value) => diagnostic.fix(format!("use `{value}`"), given.value_span, value),
        None => diagnostic,
    }
}

/// The value nearest to the one given that an option takes, as text.
fn nearest_fitting(kind: OptionKind, given: &GivenValue) -> Option<String> {
    match (kind, given) {
        (OptionKind::Integer { min, max, .. }, GivenValue::Ratio(ratio)) if ratio.is_finite() => {
            let (min, max) = (f64::from(min), f64::from(max));
            Some(format!("{:.0}", ratio.round().clamp(min, max)))
        }
        (OptionKind::Length { min, max, .. }, GivenValue::Length(length)) => {
            Some(format!("{} mm", length.max(min).min(max).to_mm()))
        }
        // A number that lacks its unit.
        (OptionKind::Length { min, max, .. }, GivenValue::Ratio(ratio)) if ratio.is_finite() => {
            Some(format!("{} mm", Length::mm(*ratio).max(min).min(max).to_mm()))
        }
        (OptionKind::Choice { of }, GivenValue::Word(word)) => nearest(word, of.iter().copied())
            .first()
            .or_else(|| of.first())
            .map(|word| (*word).to_owned()),
        (
            OptionKind::Integer { .. }
            | OptionKind::Length { .. }
            | OptionKind::Choice { .. }
            | OptionKind::Lines
            | OptionKind::Text,
            _,
        ) => None,
    }
}

fn unknown_option(given: &GivenOption, backend: &dyn Backend) -> Diagnostic {
    let keys: Vec<&str> = backend.options().iter().map(|spec| spec.key).collect();
    let message = format!("target `{}` has no option `{}`", backend.id(), given.key);
    let diagnostic = Diagnostic::new(Code::UnknownOption, message, given.key_span, "no such option")
        .help(format!("its options are: {}", keys.join(", ")));
    match nearest(&given.key, keys.iter().copied()).first() {
        Some(near) => diagnostic.fix(format!("use `{near}`"), given.key_span, *near),
        None => diagnostic,
    }
}
