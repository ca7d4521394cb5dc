//! Programs that are split into parts otherwise than the compiler splits them now, because they were written with other
//! options.
//!
//! Every part sets everything up again and restates where the machine stands, and numbers may be written otherwise in it
//! (RAPID's quaternions begin again with either sign). Commands are therefore paired by what they say, and
//! what belongs to a part's head or end alone is left aside: it says nothing new.

use super::comparison::Comparison;
use super::listing::{Listing, Numbering};
use super::meaning::meaning;
use super::steps::{Step, steps_between};
use std::collections::{BTreeMap, BTreeSet};
use vcutc_backend_api::ir::OpId;
use vcutc_backend_api::readback::{Command, Effect, normalized};
use vcutc_diff::align::{Pair, common};

/// Whether parts begin elsewhere, judged by what texts of the two programs have in common.
pub(super) fn is_split_otherwise(comparison: &Comparison<'_>, pairs: &[Pair]) -> bool {
    let begins = |listing: &Listing<'_>, index: usize| listing.effect(index) == Some(&Effect::PartBegins);
    let all = |listing: &Listing<'_>| {
        (0..listing.statements.len())
            .filter(|&at| begins(listing, at))
            .count()
    };
    let paired = pairs
        .iter()
        .filter(|&&(fresh, given)| begins(comparison.fresh, fresh) && begins(comparison.given, given))
        .count();
    all(comparison.fresh) != paired || all(comparison.given) != paired
}

/// The steps between two programs that are split in different ways.
pub(super) fn steps(comparison: &Comparison<'_>) -> Vec<Step> {
    let mut names = Numbering::default();
    let keys = [comparison.fresh, comparison.given].map(|listing| keys(listing, &mut names));
    let [fresh_keys, given_keys] = &keys;
    let pairs = common(fresh_keys, given_keys);
    let aside = Aside::of(comparison, &keys, &pairs);
    let [in_fresh, in_given] = [&aside.fresh, &aside.given].map(|aside| {
        let kept = aside
            .iter()
            .enumerate()
            .filter(|(_, aside)| **aside == Part::Content);
        kept.map(|(index, _)| index).collect::<Vec<_>>()
    });
    let of = |all: &[u32], places: &[usize]| -> Vec<u32> {
        places
            .iter()
            .filter_map(|&place| all.get(place).copied())
            .collect()
    };
    let mut names = Numbering::default();
    let skeletons = [
        comparison.fresh.skeletons(&mut names),
        comparison.given.skeletons(&mut names),
    ];
    let [fresh_kinds, given_kinds] = &skeletons;
    let between = steps_between(
        &[of(fresh_keys, &in_fresh), of(given_keys, &in_given)],
        &[of(fresh_kinds, &in_fresh), of(given_kinds, &in_given)],
    );
    let fresh_at = |place: usize| in_fresh.get(place).copied().unwrap_or(fresh_keys.len());
    let given_at = |place: usize| in_given.get(place).copied().unwrap_or(given_keys.len());
    let mut steps: Vec<Step> = between
        .into_iter()
        .map(|step| step.at(fresh_at, given_at))
        .collect();
    let parts = aside.given.iter().enumerate();
    let parts = parts.filter(|(_, aside)| **aside == Part::Frame);
    steps.extend(parts.map(|(given, _)| Step::OfPart { given }));
    steps.sort_by_key(Step::order);
    steps
}

/// Commands by what they say, other statements by their texts, in which names of the program's files are all the same.
fn keys(listing: &Listing<'_>, names: &mut Numbering) -> Vec<u32> {
    let key = |index: usize| match listing.effect(index).and_then(Effect::command) {
        Some(command) => meaning(command),
        None => format!("text {}", normalized(listing.text(index))),
    };
    (0..listing.statements.len())
        .map(|index| names.number(key(index)))
        .collect()
}

/// Whether a statement is of a part's head or end, or of what the part does.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Frame,
    Content,
}

/// What is left aside of either program.
struct Aside {
    fresh: Vec<Part>,
    given: Vec<Part>,
}

impl Aside {
    fn of(comparison: &Comparison<'_>, keys: &[Vec<u32>; 2], pairs: &[Pair]) -> Self {
        let [fresh_keys, given_keys] = keys;
        let fresh_known: BTreeSet<u32> = fresh_keys.iter().copied().collect();
        let given_known: BTreeSet<u32> = given_keys.iter().copied().collect();
        let to_fresh: BTreeMap<usize, usize> = pairs.iter().map(|&(fresh, given)| (given, fresh)).collect();
        let paired: BTreeSet<usize> = pairs.iter().map(|&(fresh, _)| fresh).collect();
        let restated = restated(comparison, &to_fresh);
        let of_part = |listing: &Listing<'_>, index: usize, known: bool, restates: bool| {
            let is_of_part = match listing.effect(index) {
                Some(Effect::PartBegins) => true,
                Some(Effect::Setting) => known || names_file(listing, index),
                Some(Effect::Frame(..)) => known,
                Some(Effect::Command(_)) => restates,
                Some(Effect::Unknown | Effect::Unreadable { .. }) | None => false,
            };
            if is_of_part { Part::Frame } else { Part::Content }
        };
        let fresh = fresh_keys.iter().enumerate().map(|(index, key)| {
            if paired.contains(&index) {
                return Part::Content;
            }
            of_part(
                comparison.fresh,
                index,
                given_known.contains(key),
                is_restatement_of_ours(comparison, index),
            )
        });
        let given = given_keys.iter().enumerate().map(|(index, key)| {
            if to_fresh.contains_key(&index) {
                return Part::Content;
            }
            of_part(
                comparison.given,
                index,
                fresh_known.contains(key),
                restated.contains(&index),
            )
        });
        Self {
            fresh: fresh.collect(),
            given: given.collect(),
        }
    }
}

/// Whether a command of the fresh program says no op and no point on the way of one.
fn is_restatement_of_ours(comparison: &Comparison<'_>, fresh: usize) -> bool {
    let command = comparison.fresh.effect(fresh).and_then(Effect::command);
    let restates = command.is_some_and(|command| !matches!(command, Command::Straight { .. }));
    restates && comparison.owner(fresh).is_none()
}

/// The commands of the given program that restate, at the head of a part, what holds there.
fn restated(comparison: &Comparison<'_>, to_fresh: &BTreeMap<usize, usize>) -> BTreeSet<usize> {
    let moments = comparison.moments();
    let mut found = BTreeSet::new();
    let mut next = OpId(0);
    let mut at_head = false;
    for (given, statement) in comparison.given.statements.iter().enumerate() {
        match &statement.effect {
            Effect::PartBegins => at_head = true,
            Effect::Command(command) => {
                let partner = to_fresh.get(&given);
                let owner = partner.and_then(|&fresh| comparison.owner(fresh));
                if let Some(op) = owner {
                    next = OpId(op.0.saturating_add(1));
                    at_head = false;
                } else if at_head && let Some(moment) = moments.get(next.0 as usize) {
                    if comparison.comparator.restates(*moment, command) {
                        found.insert(given);
                    } else {
                        at_head = false;
                    }
                }
            }
            Effect::Frame(..) | Effect::Setting | Effect::Unknown | Effect::Unreadable { .. } => {}
        }
    }
    found
}

/// Whether a statement names a file of its program, as its beginning, its end and calls of it do.
fn names_file(listing: &Listing<'_>, index: usize) -> bool {
    let text = listing.text(index).to_ascii_uppercase();
    let is_of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut words = text.split(|c| !is_of_word(c));
    let stems: Vec<_> = listing
        .files
        .iter()
        .map(|file| {
            file.name
                .split('.')
                .next()
                .unwrap_or_default()
                .to_ascii_uppercase()
        })
        .collect();
    // RAPID's parts are routines that are called after the program.
    let is_of = |word: &str, stem: &str| {
        let rest = word.strip_prefix(stem);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    words.any(|word| stems.iter().any(|stem| !stem.is_empty() && is_of(word, stem)))
}
