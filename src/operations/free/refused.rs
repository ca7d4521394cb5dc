//! What prevents a plan of a pocket to be freed, and contradictions between its fields.

use crate::asked::{AIR, FreePocket};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_process::slits::fit::Unfit;
use vcutc_process::verdict::floors;
use vcutc_region::piece::Piece;

/// What prevents a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Why {
    /// The floor is not below the stock that the operations before have left.
    NothingThere {
        /// The highest of it over the region.
        top: Length,
    },
    /// The region is too large, or too far from what is planned.
    TooLarge,
    /// The straight blade does not fit.
    Unfit(Unfit),
    /// The straight blade is so thin that nothing can be said of what its slits part.
    TooThin,
    /// No side is open.
    Closed,
    /// An island stands in the region.
    Island { at: [f64; 2] },
    /// No room for the rows: how far from walls these begin, in mm.
    Narrow { level: f64 },
    /// No room to pass from one row to the next.
    Stuck { at: [f64; 2] },
    /// Rows are parted by walls.
    Parted { at: [f64; 2] },
    /// The shank would meet ground that still stands there, by so many mm.
    Met { at: [f64; 2], by: f64 },
    /// A slit between strips is an arc that is too short for the straight blade.
    Bent { way: Piece },
    /// Strips of this width cannot be freed.
    Width {
        step: Length,
        most: Length,
        least: Length,
    },
    /// The shank is so thick for the disc that it frees no row.
    Shank,
    /// No pass can be laid along the walls.
    Broken { at: [f64; 2] },
}

impl From<Unfit> for Why {
    fn from(unfit: Unfit) -> Self {
        Self::Unfit(unfit)
    }
}

impl Why {
    /// Where other measures of strips may help: what else may, as the begin of a sentence that offers a crusher.
    pub(crate) const fn otherwise(self) -> Option<&'static str> {
        match self {
            Self::Stuck { .. } | Self::Parted { .. } | Self::Met { .. } => {
                Some("use a region that is widest at its open side, or ")
            }
            Self::Bent { .. } => Some("draw these walls as one line or one arc, or "),
            Self::Narrow { .. } => Some("use a smaller disc, or "),
            Self::Shank
            | Self::Broken { .. }
            | Self::NothingThere { .. }
            | Self::TooLarge
            | Self::Unfit(_)
            | Self::TooThin
            | Self::Closed
            | Self::Island { .. }
            | Self::Width { .. } => None,
        }
    }

    /// Of two the one that says more of the region: where the disc gets stuck, before the lack of room for more strips.
    pub(crate) const fn worth_more(self, other: Self) -> Self {
        match (self, other) {
            // What takes the least room.
            (Self::Narrow { level }, Self::Narrow { level: more }) => Self::Narrow {
                level: level.min(more),
            },
            (Self::Narrow { .. } | Self::TooLarge, other) => other,
            (known, _) => known,
        }
    }
}

/// An operation without a plan.
#[derive(Clone, Copy)]
pub(crate) struct Refused<'j> {
    pub(crate) asked: &'j FreePocket,
    pub(crate) why: Why,
}

/// What works in any region with walls.
pub(crate) const CRUSHER: &str = "clear it with a crusher (`clear pocket`)";

impl Refused<'_> {
    /// What to report, without what is tried.
    pub(crate) fn diagnostic(&self) -> Diagnostic {
        let asked = self.asked;
        let name = &asked.region.name;
        match self.why {
            Why::Unfit(unfit) => unfit.diagnostic(asked.fit()),
            Why::NothingThere { top } => {
                floors::nothing_left_above(asked.floor, asked.setup.head_span, &asked.region, top)
            }
            Why::Closed => closed(asked),
            Why::Island { at } => Diagnostic::new(
                Code::NoWayForDisc,
                format!(
                    "an island of `{name}` at {} stands in the way of the rows that `{}` frees",
                    place(at),
                    asked.disc.name
                ),
                asked.region_span,
                "has an island",
            )
            .and(asked.region.span, "defined here")
            .help(format!("free the ground around it in regions of their own, or {CRUSHER}")),
            Why::Stuck { at } => self.no_way(
                format!(
                    "at {} in `{name}`, `{}` has no room to pass from one row to the next",
                    place(at),
                    asked.disc.name
                ),
                "its rows begin at an open side, and lie beside each other",
            ),
            Why::Parted { at } => self.no_way(
                format!(
                    "beyond {} walls part the rows of `{}` in `{name}`, and it has no way from one part to the other",
                    place(at),
                    asked.disc.name
                ),
                "has a neck or two arms for this disc",
            ),
            Why::Met { at, by } => self.no_way(
                format!(
                    "at {} in `{name}`, the shank of `{}` with its air would be {} mm within ground that still stands",
                    place(at),
                    asked.disc.name,
                    show(up(by))
                ),
                "no order of strips that was tried keeps the shank over ground that is out",
            ),
            Why::Bent { way } => self.bent(way),
            Why::Narrow { level } => narrow(asked, level),
            Why::Width { step, most, least } => width(asked, [step, most, least]),
            Why::Shank => Diagnostic::new(
                Code::NoWayForDisc,
                format!(
                    "the shank of `{}` leaves no room for rows: it has a radius of {} mm in a layer, its edge {} mm",
                    asked.disc.name,
                    show(shank(asked).to_mm()),
                    show(asked.disc.radius.value.to_mm())
                ),
                asked.disc.body.span,
                "too thick",
            )
            .help("use a disc with a thinner shank, or a larger edge"),
            Why::TooThin => too_thin(asked),
            Why::Broken { at } => Diagnostic::new(
                Code::PocketTooNarrow,
                format!("no pass can be laid along the walls of `{name}` at {}", place(at)),
                asked.region_span,
                "walls touch or nearly touch there",
            )
            .help("draw walls that touch farther apart, or change the disc or the step a little"),
            Why::TooLarge => Diagnostic::new(
                Code::PocketTooNarrow,
                format!("`{name}` takes more strips than are planned"),
                asked.region_span,
                "too large for this disc",
            )
            .help("use a larger disc, or free the region in parts"),
        }
    }
}

impl Refused<'_> {
    fn no_way(&self, message: String, label: &str) -> Diagnostic {
        let asked = self.asked;
        let diagnostic = Diagnostic::new(Code::NoWayForDisc, message, asked.region_span, label);
        diagnostic.and(asked.region.span, "defined here")
    }

    fn bent(&self, way: Piece) -> Diagnostic {
        let asked = self.asked;
        let diagnostic = Diagnostic::new(
            Code::WallTooShort,
            format!(
                "at {} a slit between strips of `{}` turns by {} deg between short lines, so it is an arc of {} mm: too short for a blade \
                 that turns with it",
                place([way.from.x, way.from.y]),
                asked.region.name,
                show((way.sweep.abs().to_degrees() * 100.0).round() / 100.0),
                show((way.length() * 100.0).round() / 100.0)
            ),
            asked.region_span,
            "has short walls that turn a little",
        );
        diagnostic.and(asked.region.span, "defined here")
    }
}

fn closed(asked: &FreePocket) -> Diagnostic {
    let shank = asked.disc.body.stages.first();
    let thick = shank.map_or(0.0, |stage| 2.0 * stage.radius.value.to_mm());
    Diagnostic::new(
        Code::NoWayForDisc,
        format!(
            "`{}` is closed: the shank of `{}` ({} mm) has no room before a first strip is out",
            asked.region.name,
            asked.disc.name,
            show(thick)
        ),
        asked.region_span,
        "no straight open side along a side of the stock",
    )
    .and(asked.region.span, "defined here")
    .help(format!(
        "open it to a side of the stock with `open to`, or {CRUSHER}"
    ))
}

fn narrow(asked: &FreePocket, level: f64) -> Diagnostic {
    let needs = up(2.0 * level);
    Diagnostic::new(
        Code::PocketTooNarrow,
        format!(
            "`{}` needs {} mm between the walls of `{}` to free a row between two strips along them",
            asked.disc.name,
            show(needs),
            asked.region.name
        ),
        asked.region_span,
        "too narrow for the disc",
    )
    .and(asked.disc.radius.span.unwrap_or(asked.disc.span), "its radius")
}

fn width(asked: &FreePocket, [step, most, least]: [Length; 3]) -> Diagnostic {
    let down = |length: Length| show((length.to_mm() * 1e3).floor() / 1e3);
    if most < least {
        return Diagnostic::new(
            Code::BladesTooSmall,
            format!(
                "`{}` frees strips of {} mm at most beside its shank of {} mm, and slits of `{}` leave none below {} mm",
                asked.disc.name,
                down(most.max(Length::ZERO)),
                show(shank(asked).to_mm()),
                asked.blade.name,
                show(least.to_mm())
            ),
            asked.setup.head_span,
            "no strip is left between two slits",
        )
        .and(asked.disc.body.span, "the shank")
        .help("use a disc with a thinner shank, a larger edge or a larger `width`, or a thinner straight blade");
    }
    let span = asked.step.span.unwrap_or(asked.setup.head_span);
    if step < least {
        let text = format!("{} mm", show(least.to_mm()));
        return Diagnostic::new(
            Code::BladesTooSmall,
            format!(
                "strips of {} mm are hardly wider than a slit of `{}`, {} mm",
                show(step.to_mm()),
                asked.blade.name,
                show(asked.blade.thickness.value.to_mm())
            ),
            span,
            "too narrow",
        )
        .and(asked.blade.span, "the straight blade")
        .fix(format!("use at least {text}"), span, text);
    }
    let text = format!("{} mm", down(most));
    Diagnostic::new(
        Code::BladesTooSmall,
        format!(
            "strips of {} mm are wider than `{}` frees: {text}, beside its shank of {} mm with {} mm of air, and with a `width` of {} mm",
            show(step.to_mm()),
            asked.disc.name,
            show(shank(asked).to_mm()),
            show(AIR.to_mm()),
            show(asked.disc.width.value.to_mm())
        ),
        span,
        "too wide",
    )
    .and(asked.disc.body.span, "the shank")
    .fix(format!("use a step of {text}"), span, text)
}

/// The widest of the disc's body in a layer of the greatest thickness.
fn shank(asked: &FreePocket) -> Length {
    let thick = asked.layer.value.or(asked.disc.depth.value);
    let stages = asked.disc.body.stages.iter();
    let low = stages.filter(|stage| stage.from.value < thick);
    low.map(|stage| stage.radius.value)
        .fold(Length::ZERO, Length::max)
}

fn too_thin(asked: &FreePocket) -> Diagnostic {
    let thickness = asked.blade.thickness;
    Diagnostic::new(
        Code::BladesTooSmall,
        format!(
            "the slits of `{}` are {} mm wide: too thin in `{}` to prove what they part",
            asked.blade.name,
            show(thickness.value.to_mm()),
            asked.region.name
        ),
        thickness.span.unwrap_or(asked.blade.span),
        "too thin",
    )
    .help("use a thicker blade, or free the region in parts")
}

/// A blade whose back does not cut.
pub(crate) fn one_edge(asked: &FreePocket) -> Diagnostic {
    let name = &asked.blade.name;
    Diagnostic::new(
        Code::WrongBlade,
        format!("`free pocket` needs a straight blade with two cutting edges; `{name}` has one"),
        asked.setup.head_span,
        "slits begin straight down",
    )
    .and(asked.blade.span, "with `edges = single`")
    .help("use a blade with `edges = double`")
}

pub(crate) fn too_thick(asked: &FreePocket, layer: Length) -> Diagnostic {
    let depth = asked.disc.depth;
    let diagnostic = Diagnostic::new(
        Code::LayerTooThick,
        format!(
            "a layer of {} mm, and `{}` takes {} mm at once",
            show(layer.to_mm()),
            asked.disc.name,
            show(depth.value.to_mm())
        ),
        asked.layer.span.unwrap_or(asked.setup.head_span),
        "thicker than the disc takes",
    )
    .and(depth.span.unwrap_or(asked.disc.span), "its depth");
    diagnostic.help(format!("use `layer = {} mm`", show(depth.value.to_mm())))
}

/// `(12.5 mm, 40 mm)`.
fn place([x, y]: [f64; 2]) -> String {
    let round = |value: f64| show((value * 100.0).round() / 100.0);
    format!("({} mm, {} mm)", round(x), round(y))
}

/// Rounded up to a hundredth, so that the number shown works.
fn up(value: f64) -> f64 {
    (value * 100.0).ceil() / 100.0
}
