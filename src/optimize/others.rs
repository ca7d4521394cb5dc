//! Operations that the formulas of V cuts are not about, and ways to do an operation, with their results.

use super::{Optimisation, bounds};
use serde::Serialize;
use vcutc_diagnostics::source::SourceMap;
use vcutc_driver::Compiled;
use vcutc_driver::summary::{processes, row};
use vcutc_driver::ways::{Came, Comparison};
use vcutc_job::{PlannedJob, PlannedOperation};
use vcutc_vcut::PlannedVcut;

/// An operation of another kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OtherOperation {
    /// Which operation of the job it is, counted from 1.
    pub number: u16,
    /// Where it stands: `rib.vcut:12:1`.
    pub place: String,
    /// Its results, in lines of names and texts.
    pub lines: Vec<(&'static str, String)>,
}

pub(super) fn of(plan: &PlannedJob, compiled: &Compiled, sources: &SourceMap) -> Vec<OtherOperation> {
    let numbered = (1..).zip(plan.operations.iter().map(|planned| &**planned));
    let others = numbered.filter(|(_, planned)| PlannedVcut::of(*planned).is_none());
    let other = |(number, planned): (u16, &dyn PlannedOperation)| OtherOperation {
        number,
        place: bounds::place(sources, planned.asked().setup().head_span),
        lines: planned.summary(&compiled.report),
    };
    others.map(other).collect()
}

/// The same for people, a text for each.
pub(super) fn texts(optimisation: &Optimisation) -> Vec<String> {
    let others = optimisation.others.iter().map(|other| {
        let head = format!(
            "{}: operation {} ({}); as planned\n\n",
            optimisation.job, other.number, other.place
        );
        let lines = other.lines.iter().map(|(name, words)| row(name, words) + "\n");
        head + &lines.collect::<String>()
    });
    let compared = optimisation.comparisons.iter().map(|comparison| {
        let lines = processes::of_one(comparison).into_iter();
        lines.map(|line| line + "\n").collect::<String>()
    });
    let rects = optimisation.rects.iter().map(|rect| rect.text(&optimisation.job));
    others.chain(compared).chain(rects).collect()
}

#[derive(Debug, Serialize)]
pub(super) struct OtherBody<'a> {
    operation: u16,
    place: &'a str,
    lines: Vec<(&'a str, &'a str)>,
}

/// A way to do an operation.
#[derive(Debug, Serialize)]
pub(super) struct ProcessBody<'a> {
    operation: usize,
    process: &'a str,
    /// In s; none where it does not compile.
    time_s: Option<f64>,
    cuts: Option<usize>,
    changes: Option<usize>,
    /// Why it does not compile.
    refused: Option<&'a str>,
}

pub(super) fn body(other: &OtherOperation) -> OtherBody<'_> {
    OtherBody {
        operation: other.number,
        place: &other.place,
        lines: other
            .lines
            .iter()
            .map(|(name, words)| (*name, words.as_str()))
            .collect(),
    }
}

/// The ways to do an operation, the one that is taken first.
pub(super) fn process_bodies(comparison: &Comparison) -> impl Iterator<Item = ProcessBody<'_>> {
    comparison.ways.iter().map(|way| {
        let (figures, refused) = match &way.came {
            Came::Compiled(figures) => (Some(figures), None),
            Came::Refused(why) => (None, why.as_ref().map(|why| why.message.as_str())),
        };
        ProcessBody {
            operation: comparison.operation + 1,
            process: way.word,
            time_s: figures.map(|figures| figures.time.to_s()),
            cuts: figures.map(|figures| figures.cuts),
            changes: figures.map(|figures| figures.planned.changes),
            refused,
        }
    })
}
