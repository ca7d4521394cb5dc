//! Whether a straight blade fits the walls of a region at a depth: its slits, or why there are none, in words.

use super::SHORTEST_STEP;
use crate::lower::BLEND;
use crate::pen::step_of;
use core::f64::consts::FRAC_PI_2;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::grid;
use vcutc_job::{NamedRegion, Setup, Sourced, StraightBlade};
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::slits::{Knife, Misfit, Slit, slits};

/// What is asked of slits along walls.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    pub blade: &'a StraightBlade,
    pub region: &'a NamedRegion,
    /// Where the operation names it.
    pub region_span: Span,
    pub floor: Sourced<Length>,
    /// How far the sides of the blade keep from walls.
    pub allowance: Sourced<Length>,
    pub setup: &'a Setup,
    /// What else could be done about a wall that the blade cannot follow.
    pub otherwise: Option<&'static str>,
}

/// Why a blade does not fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unfit {
    /// The edge is too short for the height of the walls.
    TooDeep { height: Length, needed: Length },
    /// The edges make a right angle, or more: with one upright the other one would lie.
    Blunt,
    /// An arc is so short that only lines can stand for it, which turn the blade out of its plane.
    Short {
        /// The way of the tip.
        way: Piece,
    },
    /// The blade does not follow the walls.
    Misfit(Misfit),
}

/// How far slits keep from walls beyond what must be kept, so that rounding to the grid of programs takes nothing of it, in mm.
const GRID: f64 = 0.004;

/// How much less than a right angle there is between the edges of a blade at most, in rad: one edge upright, the other one would lie.
const BLUNT: f64 = 0.01;

/// The blade with its tip so far below the top of the walls, in mm.
///
/// # Errors
/// It is too blunt or too short.
pub fn knife(asked: Asked<'_>, height: f64) -> Result<Knife, Unfit> {
    let half_apex = asked.blade.half_apex.value.to_rad();
    // The longer edge, where the other one stands upright.
    let needed = height / libm::cos(2.0 * half_apex);
    let available = asked.blade.cutting_length.value;
    if 2.0 * half_apex >= FRAC_PI_2 - BLUNT {
        return Err(Unfit::Blunt);
    }
    if needed > available.to_mm() {
        return Err(Unfit::TooDeep {
            height: Length::mm(height),
            needed: Length::mm(needed),
        });
    }
    Ok(Knife {
        half_apex,
        half: asked.blade.thickness.value.to_mm() / 2.0,
        keep: asked.allowance.value.to_mm() + BLEND.to_mm() + GRID,
        height,
        run_out: asked.setup.run_out.value.to_mm(),
        grid: grid::SPACING,
    })
}

/// The slits along all walls of a region; none of one without walls.
///
/// # Errors
/// The blade does not follow some wall.
pub fn along_walls(asked: Asked<'_>, knife: Knife) -> Result<Vec<Slit>, Unfit> {
    let slits = slits(&asked.region.region, knife).map_err(Unfit::Misfit)?;
    can_be_followed(&slits)?;
    Ok(slits)
}

/// Whether programs can state the arcs of slits so that the blade turns with them.
///
/// # Errors
/// An arc is too short.
pub fn can_be_followed(slits: &[Slit]) -> Result<(), Unfit> {
    let mut ways = slits.iter().flat_map(|slit| &slit.pieces).map(|piece| piece.way);
    ways.find(|way| !is_followed(*way))
        .map_or(Ok(()), |way| Err(Unfit::Short { way }))
}

/// Whether programs can state a way so that a blade turns with it.
#[must_use]
pub fn is_followed(way: Piece) -> bool {
    step_of(way).is_none_or(|step| step >= SHORTEST_STEP)
}

impl Unfit {
    #[must_use]
    pub fn diagnostic(self, asked: Asked<'_>) -> Diagnostic {
        match self {
            Self::Blunt => Diagnostic::new(
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
            Self::TooDeep { height, needed } => too_deep(asked, height, needed),
            Self::Short { way } => short(asked, way),
            Self::Misfit(Misfit::Tight { edge, radius }) => tight(asked, edge, radius),
            Self::Misfit(Misfit::NoRoom { edge, at }) => no_room(asked, edge, at),
        }
    }
}

fn too_deep(asked: Asked<'_>, height: Length, needed: Length) -> Diagnostic {
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

fn short(asked: Asked<'_>, way: Piece) -> Diagnostic {
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
fn ends(asked: Asked<'_>, edge: usize) -> String {
    let round = |value: f64| show((value * 100.0).round() / 100.0);
    let place = |place: Place| format!("({} mm, {} mm)", round(place.x), round(place.y));
    let wall = asked.region.region.edges().nth(edge);
    wall.map_or_else(String::new, |wall| {
        format!("from {} to {}", place(wall.piece.from), place(wall.piece.to))
    })
}

fn tight(asked: Asked<'_>, edge: usize, radius: f64) -> Diagnostic {
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
    .help(format!(
        "use a narrower or thinner blade, a larger radius, or a floor higher up{}",
        asked
            .otherwise
            .map_or_else(String::new, |other| format!("; or {other}"))
    ))
}

fn no_room(asked: Asked<'_>, edge: usize, at: Place) -> Diagnostic {
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
