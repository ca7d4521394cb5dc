//! What prevents a plan of slits along walls, and contradictions between its fields.

use crate::asked::SlitWalls;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::{Unplanned, WorksThere};
use vcutc_process::slits::fit::Unfit;

/// Walls that are lower do not count, in mm: far below what a machine repeats.
pub(crate) const LOWEST: f64 = 0.01;

/// What prevents a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Why {
    /// The floor is not below the stock that the operations before have left.
    NothingThere {
        /// The highest of it over the region.
        top: Length,
    },
    /// All sides of the region are open.
    NoWalls,
    /// The blade does not fit.
    Unfit(Unfit),
}

impl From<Unfit> for Why {
    fn from(unfit: Unfit) -> Self {
        Self::Unfit(unfit)
    }
}

/// An operation without a plan.
pub(crate) struct Refused<'j> {
    pub(crate) asked: &'j SlitWalls,
    pub(crate) why: Why,
}

impl Unplanned for Refused<'_> {
    fn diagnostics(&self, _: &Wanted, _: &mut Effort, _: &mut WorksThere<'_>) -> Vec<Diagnostic> {
        vec![self.diagnostic()]
    }
}

impl Refused<'_> {
    fn diagnostic(&self) -> Diagnostic {
        let asked = self.asked;
        let name = &asked.region.name;
        match self.why {
            Why::NothingThere { top } => Diagnostic::new(
                Code::PocketOutside,
                format!(
                    "the floor is at {} mm, and the stock over `{name}` is {} mm high",
                    show(asked.floor.value.to_mm()),
                    show(top.to_mm())
                ),
                asked.floor.span.unwrap_or(asked.setup.head_span),
                "no wall above it",
            )
            .help(format!("use a floor at {} mm or below", show(highest_floor(top)))),
            Why::NoWalls => Diagnostic::new(
                Code::PocketOutside,
                format!("`{name}` has no walls: all of its sides are open"),
                asked.region_span,
                "no walls",
            )
            .help("leave out `slit walls`: a region without walls needs no slits"),
            Why::Unfit(unfit) => unfit.diagnostic(asked.fit()),
        }
    }
}

/// A blade whose back does not cut.
pub(crate) fn one_edge(asked: &SlitWalls) -> Diagnostic {
    let name = &asked.blade.name;
    Diagnostic::new(
        Code::WrongBlade,
        format!("`slit walls` needs a blade with two cutting edges; `{name}` has one"),
        asked.setup.head_span,
        "each slit begins straight down",
    )
    .and(asked.blade.span, "with `edges = single`")
    .help("use a blade with `edges = double`")
}

pub(crate) fn floor_above_stock(asked: &SlitWalls, stock: Spanned<Stock>) -> Diagnostic {
    let height = show(stock.node.height.to_mm());
    Diagnostic::new(
        Code::PocketOutside,
        format!(
            "the floor is at {} mm, and the stock is {height} mm high",
            show(asked.floor.value.to_mm()),
        ),
        asked.floor.span.unwrap_or(asked.setup.head_span),
        "no wall above it",
    )
    .and(stock.span, "the stock")
    .help(format!(
        "use a floor at {} mm or below",
        show(highest_floor(stock.node.height))
    ))
}

/// The highest floor with a wall above it, in mm, rounded down to a hundredth.
fn highest_floor(top: Length) -> f64 {
    ((top.to_mm() - LOWEST) * 100.0 + 1e-6).floor() / 100.0
}
