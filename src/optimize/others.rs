//! Operations that the formulas of V cuts are not about, and ways to do an operation, with their results.

use super::against::Against;
use super::scallop::ScallopTradeOff;
use super::table::seconds;
use super::values::{OtherValue, OtherValues, Subject, ValueKind};
use super::{Optimisation, Wanted, bounds};
use core::any::Any;
use serde::Serialize;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_driver::summary::{processes, row};
use vcutc_driver::ways::{Came, Comparison};
use vcutc_job::operation::Operation;
use vcutc_job::{PlannedJob, PlannedOperation};
use vcutc_rect::asked::RoughRect;
use vcutc_vcut::PlannedVcut;

/// An operation of another kind.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherOperation {
    /// Which operation of the job it is, counted from 1.
    pub number: u16,
    /// Where it stands: `rib.vcut:12:1`.
    pub place: String,
    /// Its results, in lines of names and texts.
    pub lines: Vec<(&'static str, String)>,
    /// What other values save; none of rectangular roughing, which has prices.
    pub values: Option<OtherValues>,
    /// The times of the job under other limits on the scallop, where the job sets one and time is traded against it.
    pub trade_off: Option<ScallopTradeOff>,
}

pub(super) fn of(plan: &PlannedJob, subject: Subject<'_>, wanted: Wanted) -> Vec<OtherOperation> {
    let numbered = (1..).zip(plan.operations.iter().map(|planned| &**planned));
    let others = numbered.filter(|(_, planned)| PlannedVcut::of(*planned).is_none());
    let mut seen = Vec::new();
    let other = |(number, planned): (u16, &dyn PlannedOperation)| {
        let asked = planned.asked();
        let asks_text = !is_rect(asked);
        OtherOperation {
            number,
            place: bounds::place(subject.sources, asked.setup().head_span),
            lines: planned.summary(&subject.compiled.report),
            values: asks_text.then(|| OtherValues::of(asked, subject, &mut seen)),
            trade_off: asked
                .scallop_limit()
                .filter(|_| asks_text && wanted.against == Against::Scallop)
                .and_then(|limit| ScallopTradeOff::of(limit, wanted.points, subject)),
        }
    };
    others.map(other).collect()
}

fn is_rect(operation: &dyn Operation) -> bool {
    let operation: &dyn Any = operation;
    operation.is::<RoughRect>()
}

/// What other values save, a line each.
fn values_text(values: &OtherValues, now: Duration) -> String {
    let OtherValues { found, not_tried } = values;
    let of = |kind: ValueKind| found.iter().filter(move |value| value.kind == kind);
    let lines = |head: &'static str, kind: ValueKind| {
        let heads = [head].into_iter().chain(core::iter::repeat(""));
        heads
            .zip(of(kind))
            .map(|(head, value)| row(head, &saved(value, now)) + "\n")
    };
    let mut text: String = lines("binds", ValueKind::Limit)
        .chain(lines("faster", ValueKind::Other))
        .collect();
    if found.is_empty() && not_tried.is_empty() {
        text += &(row("binds", "nothing: no other value saves more than 0.2 %") + "\n");
    }
    if !not_tried.is_empty() {
        let words = format!("because the program is so long: {}", not_tried.join(", "));
        text += &(row("not tried", &words) + "\n");
    }
    text
}

/// `engagement <= 150 deg (tray.vcut:28:28); 165 deg saves 3.2 s of the job (2.10 %)`.
fn saved(value: &OtherValue, now: Duration) -> String {
    format!(
        "{} ({}); {} saves {} of the job ({:.2} %)",
        value.words,
        value.place,
        value.other,
        seconds(now - value.time),
        value.share * 100.0
    )
}

/// The same for people, a text for each.
pub(super) fn texts(optimisation: &Optimisation) -> Vec<String> {
    let others = optimisation.others.iter().map(|other| {
        let head = format!(
            "{}: operation {} ({}); as planned\n\n",
            optimisation.job, other.number, other.place
        );
        let lines = other.lines.iter().map(|(name, words)| row(name, words) + "\n");
        let values = other.values.as_ref();
        let values = values.map_or(String::new(), |values| values_text(values, optimisation.time));
        let trade_off = other.trade_off.as_ref();
        let trade_off = trade_off.map_or(String::new(), ScallopTradeOff::text);
        head + &lines.collect::<String>() + &values + &trade_off
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
    /// Other values that save time, as the whole job was compiled with them.
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<Vec<ValueBody<'a>>>,
    /// Values that were not tried: the program is too long.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    not_tried: &'a [String],
    /// Times of the job under limits on the scallop, its own among them.
    #[serde(skip_serializing_if = "Option::is_none")]
    trade_off: Option<Vec<LimitBody>>,
}

/// Another value of a limit, speed, choice or blade.
#[derive(Debug, Serialize)]
struct ValueBody<'a> {
    words: &'a str,
    place: &'a str,
    other: &'a str,
    /// Of the job, in s.
    time: f64,
    /// Of the job's time.
    share: f64,
}

/// A limit in mm, and the time of the job in s; none where it does not compile.
#[derive(Debug, Serialize)]
struct LimitBody {
    limit: f64,
    time: Option<f64>,
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
        values: other
            .values
            .as_ref()
            .map(|values| values.found.iter().map(value_body).collect()),
        not_tried: other.values.as_ref().map_or(&[], |values| &values.not_tried),
        trade_off: other
            .trade_off
            .as_ref()
            .map(|trade_off| trade_off.by_limit().into_iter().map(limit_body).collect()),
    }
}

fn value_body(value: &OtherValue) -> ValueBody<'_> {
    ValueBody {
        words: &value.words,
        place: &value.place,
        other: &value.other,
        time: value.time.to_s(),
        share: value.share,
    }
}

fn limit_body((limit, time): (Length, Option<Duration>)) -> LimitBody {
    LimitBody {
        limit: limit.to_mm(),
        time: time.map(Duration::to_s),
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
