//! What prevents a plan of slits along walls, and contradictions between its fields.

use crate::asked::SlitWalls;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::{Unplanned, WorksThere};
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::slits::Misfit;

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
    /// The edge is too short for the height of the walls.
    TooDeep { height: Length, needed: Length },
    /// The edges make a right angle, or more: with one upright the other one would lie.
    Blunt,
    /// An arc is so short that only lines can stand for it, which turn the blade out of its plane.
    Short {
        /// The way of the tip.
        way: Piece,
    },
    /// All sides of the region are open.
    NoWalls,
    /// The blade does not follow the walls.
    Misfit(Misfit),
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
            Why::Blunt => Diagnostic::new(
                Code::WallTooShort,
                format!(
                    "with a half apex angle of {} deg, `{}` has no edge that stands upright beside a corner while the other one cuts",
                    show(asked.blade.half_apex.value.to_deg()),
                    asked.blade.name
                ),
                asked.blade.half_apex.span.unwrap_or(asked.blade.span),
                "too blunt for walls",
            )
            .and(asked.setup.head_span, "slits walls with it")
            .help("use a blade with a half apex angle below 44.4 deg"),
            Why::TooDeep { height, needed } => too_deep(asked, height, needed),
            Why::Short { way } => short(asked, way),
            Why::NoWalls => Diagnostic::new(
                Code::PocketOutside,
                format!("`{name}` has no walls: all of its sides are open"),
                asked.region_span,
                "no walls",
            )
            .help("leave out `slit walls`: a region without walls needs no slits"),
            Why::Misfit(Misfit::Tight { edge, radius }) => tight(asked, edge, radius),
            Why::Misfit(Misfit::NoRoom { edge, at }) => no_room(asked, edge, at),
        }
    }
}

fn too_deep(asked: &SlitWalls, height: Length, needed: Length) -> Diagnostic {
    let length = asked.blade.cutting_length;
    let deepest = length.value.to_mm() * libm::cos(2.0 * asked.blade.half_apex.value.to_rad());
    let deepest = (deepest * 100.0).floor() / 100.0;
    let diagnostic = Diagnostic::new(
        Code::LayerTooThick,
        format!(
            "walls of {} mm take {} mm of edge beside a corner, where the other edge stands upright; `{}` has {} mm",
            show(height.to_mm()),
            show((needed.to_mm() * 100.0).ceil() / 100.0),
            asked.blade.name,
            show(length.value.to_mm())
        ),
        asked.floor.span.unwrap_or(asked.setup.head_span),
        "deeper than the blade reaches",
    )
    .and(length.span.unwrap_or(asked.blade.span), "its edge");
    let floor = asked.floor.value.to_mm() + height.to_mm() - deepest;
    diagnostic.help(format!(
        "use a longer blade, or a floor at {} mm or above",
        show((floor * 100.0).ceil() / 100.0)
    ))
}

fn short(asked: &SlitWalls, way: Piece) -> Diagnostic {
    let round = |value: f64| show((value * 100.0).round() / 100.0);
    Diagnostic::new(
        Code::WallTooShort,
        format!(
            "at ({} mm, {} mm) a wall of `{}` is an arc of {} mm that turns by {} deg, too short for a blade that turns with it",
            round(way.from.x),
            round(way.from.y),
            asked.region.name,
            round(way.length()),
            round(way.sweep.abs().to_degrees())
        ),
        asked.region_span,
        "has walls of short arcs",
    )
    .and(asked.region.span, "defined here")
    .help("draw the wall with arcs that turn by 5 deg or more; ellipses and splines of a drawing become shorter ones")
}

/// Ends of a wall, as messages name it.
fn ends(asked: &SlitWalls, edge: usize) -> String {
    let round = |value: f64| show((value * 100.0).round() / 100.0);
    let place = |place: Place| format!("({} mm, {} mm)", round(place.x), round(place.y));
    let wall = asked.region.region.edges().nth(edge);
    wall.map_or_else(String::new, |wall| {
        format!("from {} to {}", place(wall.piece.from), place(wall.piece.to))
    })
}

fn tight(asked: &SlitWalls, edge: usize, radius: f64) -> Diagnostic {
    Diagnostic::new(
        Code::WallLeft,
        format!(
            "the hollow wall {} of `{}` has a radius of {} mm, and `{}` has no room in it",
            ends(asked, edge),
            asked.region.name,
            show((radius * 1e3).round() / 1e3),
            asked.blade.name
        ),
        asked.region_span,
        "tighter than the blade",
    )
    .and(asked.region.span, "defined here")
    .help("use a narrower or thinner blade, a larger radius, or a floor higher up; or leave `slit walls` out, and let the crusher make the walls")
}

fn no_room(asked: &SlitWalls, edge: usize, at: Place) -> Diagnostic {
    let round = |value: f64| show((value * 100.0).round() / 100.0);
    Diagnostic::new(
        Code::WallTooShort,
        format!(
            "along the wall {} of `{}`, `{}` meets another wall at ({} mm, {} mm)",
            ends(asked, edge),
            asked.region.name,
            asked.blade.name,
            round(at.x),
            round(at.y)
        ),
        asked.region_span,
        "too narrow for the blade",
    )
    .and(asked.region.span, "defined here")
    .help(if asked.allowance.value > Length::ZERO {
        "use a smaller allowance, a blade with a smaller apex angle or thickness, or a floor higher up: the deeper it cuts, the wider the \
         blade is at the top"
    } else {
        "use a blade with a smaller apex angle or thickness, or a floor higher up: the deeper it cuts, the wider the blade is at the top"
    })
    .note("walls that touch, or nearly touch, cannot be slit with any blade")
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
