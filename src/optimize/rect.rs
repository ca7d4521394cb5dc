//! Rectangular roughing: what other limits on the scallop cost, and what better blades and faster feeds would buy.
//!
//! Each line is a plan with one thing changed, on what the operations before have left. Times are by the formula; no machine is
//! asked.

use super::table::{seconds, table};
use super::{Against, OperationOptimum, against, bounds};
use core::any::Any;
use serde::Serialize;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::source::SourceMap;
use vcutc_driver::ways::Comparison;
use vcutc_job::operation::Operation;
use vcutc_job::{CheckedJob, PlanningJob};
use vcutc_process::plan::ground_of;
use vcutc_rect::asked::RoughRect;
use vcutc_rect::prices::{Figures, Price};

/// The tables of an operation, or of a way to do one.
#[derive(Clone, Debug, PartialEq)]
pub struct RectOptimum {
    /// Which operation of the job it is, counted from 1.
    pub number: u16,
    /// Where it stands: `rib.vcut:12:1`.
    pub place: String,
    /// The job's limit on the scallop.
    pub limit: Option<Length>,
    /// As the job asks for it; none where there is no plan.
    pub now: Option<Figures>,
    /// Limits on the scallop, by growing scallop, with what comes of them.
    pub trade_off: Vec<(Length, Option<Figures>)>,
    pub prices: Vec<Price>,
}

/// Of all rectangular roughing of a job, and of that which is a way to do an operation, whether it was taken or not. Limits are those
/// of the V cuts of the same operation, where there are any, so that the tables compare.
pub(super) fn of(
    job: &CheckedJob,
    comparisons: &[Comparison],
    vcuts: &[OperationOptimum],
    points: u32,
    sources: &SourceMap,
) -> Vec<RectOptimum> {
    let Some(planning) = PlanningJob::of(job) else {
        return Vec::new();
    };
    let numbered = (1..).zip(job.operations.iter().map(|operation| &**operation));
    let tables = numbered.filter_map(|(number, operation)| {
        let index = usize::from(number) - 1;
        let asked = rect_of(operation).or_else(|| {
            let ways = comparisons
                .iter()
                .filter(|comparison| comparison.operation == index);
            ways.flat_map(|comparison| &comparison.ways)
                .find_map(|way| rect_of(&*way.operation))
        })?;
        let ground = ground_of(&planning, index)?;
        let now = asked.figures(&ground);
        let limit = asked.limits.scallop.map(|limit| limit.value);
        let of_vcuts = vcuts.iter().find(|vcut| vcut.number == number);
        let limits = match of_vcuts {
            Some(vcut) if vcut.trade_off.against == Against::Scallop => {
                let points = vcut.trade_off.points.iter();
                points.map(|point| Length::mm(point.limit)).collect()
            }
            Some(_) | None => limits_about(limit.or(now.map(|now| now.left)), points),
        };
        let is_own = |other: &Length| limit.is_some_and(|limit| (*other - limit).abs() < ALIKE);
        let others = limits.into_iter().filter(|other| !is_own(other));
        let trade_off = others.map(|limit| (limit, asked.figures_under(limit, &ground)));
        Some(RectOptimum {
            number,
            place: bounds::place(sources, asked.setup.head_span),
            limit,
            now,
            trade_off: trade_off.collect(),
            prices: asked.prices(&ground),
        })
    });
    tables.collect()
}

fn rect_of(operation: &dyn Operation) -> Option<&RoughRect> {
    let operation: &dyn Any = operation;
    operation.downcast_ref()
}

/// So many limits about this one, each by the same factor above the one before.
fn limits_about(limit: Option<Length>, points: u32) -> Vec<Length> {
    let Some(limit) = limit.filter(|limit| *limit > Length::ZERO) else {
        return Vec::new();
    };
    against::about(limit.to_mm(), points)
        .map(|limit| Length::mm(against::hundredths(limit)))
        .collect()
}

/// Limits nearer to each other are printed alike.
const ALIKE: Length = Length::mm(0.005);

impl RectOptimum {
    /// For people.
    pub(super) fn text(&self, job: &str) -> String {
        let mut text = format!(
            "{job}: operation {} ({}), slits and strips, planned under other limits of the scallop, times by the formula\n\n",
            self.number, self.place
        );
        let head = [
            "", "limit", "time", "slits", "strips", "changes", "leaves", "layer", "step", "through",
        ];
        let now = self.now.map(|now| row("*", self.limit, Some(now)));
        let others = self
            .trade_off
            .iter()
            .map(|(limit, plan)| row("", Some(*limit), *plan));
        text += &table(&head, &now.into_iter().chain(others).collect::<Vec<_>>());
        if let Some(now) = self.now {
            text.push('\n');
            for (index, price) in self.prices.iter().enumerate() {
                let head = if index == 0 { "prices" } else { "" };
                text += &format!("  {head:<10} {}: {}\n", price.change, gained(now, price.plan));
            }
        }
        text
    }
}

/// `saves 12.3 s (3.2 %)`.
fn gained(now: Figures, then: Option<Figures>) -> String {
    let Some(then) = then else {
        return "no plan".to_owned();
    };
    let saved = now.time - then.time;
    if saved.to_s().abs() < 0.05 {
        return "saves nothing".to_owned();
    }
    let share = (saved.to_s() / now.time.to_s()).abs() * 100.0;
    if saved > Duration::ZERO {
        format!("saves {} ({share:.1} %)", seconds(saved))
    } else {
        format!("takes {} longer ({share:.1} %)", seconds(Duration::ZERO - saved))
    }
}

fn row(mark: &str, limit: Option<Length>, plan: Option<Figures>) -> Vec<String> {
    let limit = limit.map_or_else(|| "none".to_owned(), |limit| format!("{:.2} mm", limit.to_mm()));
    let head = [mark.to_owned(), limit];
    let rest = match plan {
        None => vec!["no plan".to_owned()],
        Some(plan) => vec![
            seconds(plan.time),
            plan.counts.slits.to_string(),
            plan.counts.strips.to_string(),
            plan.counts.changes.to_string(),
            format!("{:.2} mm", plan.left.to_mm()),
            format!("{:.3} mm", plan.layer.to_mm()),
            format!("{:.3} mm", plan.step.to_mm()),
            plan.through.to_string(),
        ],
    };
    head.into_iter().chain(rest).collect()
}

/// For programs.
#[derive(Debug, Serialize)]
pub(super) struct RectBody<'a> {
    operation: u16,
    place: &'a str,
    planned: Option<FiguresBody>,
    trade_off: Vec<UnderBody>,
    prices: Vec<PriceBody<'a>>,
}

/// Lengths in mm, times in s.
#[derive(Debug, Serialize)]
struct FiguresBody {
    time: f64,
    slits: usize,
    strips: usize,
    changes: usize,
    leaves: f64,
    layer: f64,
    step: f64,
    through: u32,
}

#[derive(Debug, Serialize)]
struct UnderBody {
    /// On the scallop, in mm.
    limit: f64,
    planned: Option<FiguresBody>,
}

#[derive(Debug, Serialize)]
struct PriceBody<'a> {
    change: &'a str,
    planned: Option<FiguresBody>,
}

impl RectOptimum {
    pub(super) fn body(&self) -> RectBody<'_> {
        let under = self.trade_off.iter().map(|(limit, plan)| UnderBody {
            limit: limit.to_mm(),
            planned: plan.map(figures_body),
        });
        let prices = self.prices.iter().map(|price| PriceBody {
            change: &price.change,
            planned: price.plan.map(figures_body),
        });
        RectBody {
            operation: self.number,
            place: &self.place,
            planned: self.now.map(figures_body),
            trade_off: under.collect(),
            prices: prices.collect(),
        }
    }
}

fn figures_body(figures: Figures) -> FiguresBody {
    FiguresBody {
        time: figures.time.to_s(),
        slits: figures.counts.slits,
        strips: figures.counts.strips,
        changes: figures.counts.changes,
        leaves: figures.left.to_mm(),
        layer: figures.layer.to_mm(),
        step: figures.step.to_mm(),
        through: figures.through,
    }
}
