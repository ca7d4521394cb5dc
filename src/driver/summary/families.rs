//! Lines of the summary, and notes of messages, about the ways for all cuts to follow the part: which was taken, and how others compare.

use super::{row, time};
use crate::families::{ComparedFamily, FamilyCame};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::{Diagnostic, Severity};

/// The line about them; none where the job leaves no choice.
pub(super) fn lines(families: &[ComparedFamily]) -> Vec<String> {
    if families.is_empty() {
        return Vec::new();
    }
    vec![row("families", &together(families))]
}

/// Adds to the first error of a job that compiles in no family which of them it is about, and why the others do not compile.
pub(crate) fn explain(found: &mut [Diagnostic], families: &[ComparedFamily]) {
    let Some((taken, others)) = families.split_first() else {
        return;
    };
    let Some(first) = found.iter_mut().find(|one| one.severity() == Severity::Error) else {
        return;
    };
    let taken = taken.family.word();
    first.notes.push(if others.is_empty() {
        format!("`follow = auto` tried `{taken}` alone")
    } else {
        format!(
            "this is about `{taken}`, which `follow = auto` tried first; {}",
            together(others)
        )
    });
}

/// All of them; those that do not compile for the same reason together.
fn together(families: &[ComparedFamily]) -> String {
    let mut all: Vec<(Vec<&str>, String)> = Vec::new();
    for one in families {
        let (word, words) = (one.family.word(), words(&one.came));
        match all.last_mut().filter(|(_, before)| *before == words) {
            Some((alike, _)) => alike.push(word),
            None => all.push((vec![word], words)),
        }
    }
    let all = all
        .into_iter()
        .map(|(alike, words)| format!("{}: {words}", alike.join(", ")));
    all.collect::<Vec<_>>().join("; ")
}

/// `3 min 12.0 s, at most 4.21 mm stay, 1.02 mm on average`, `no, ...` or `not planned, 42.18 mm would stay`.
fn words(came: &FamilyCame) -> String {
    let mm = |length: Length| format!("{:.2} mm", length.to_mm());
    match came {
        FamilyCame::Compiled(figures) => format!(
            "{}, at most {} stay, {} on average",
            time(figures.time),
            mm(figures.highest),
            mm(figures.mean)
        ),
        FamilyCame::Refused(Some(why)) => format!("no, {}", why.message),
        FamilyCame::Refused(None) => "no".to_owned(),
        FamilyCame::LeavesMore(expected) => format!("not planned, {} would stay", mm(*expected)),
    }
}
