//! Why there is no plan of a pocket, and what its fields contradict each other in.

use crate::asked::ClearPocket;
use vcutc_backend_api::units::Length;
use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::{Unplanned, WorksThere};
use vcutc_process::lower::{BLEND, ROUNDING_ROOM};
use vcutc_process::verdict::floors;

/// Why there is no plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Why {
    /// The tool fits nowhere: the widest circle within the region.
    TooNarrow {
        /// How wide, in mm.
        wide: f64,
        /// Where.
        at: [f64; 2],
    },
    /// The floor is not below the stock that the operations before have left.
    NothingThere {
        /// The highest of it over the region.
        top: Length,
    },
    /// The passes are too many.
    TooLarge,
    /// There is no room to go down.
    NoWayDown {
        /// Where a way down was looked for.
        at: [f64; 2],
    },
    /// A helix has no room.
    NoHelix {
        /// Where it was looked for.
        at: [f64; 2],
    },
    /// A run begins over the stock, where the tool may not go down into the material.
    NotOpen {
        /// Where.
        at: [f64; 2],
    },
    /// There is no sound field over the region.
    NoField,
    /// All sides are open, and the passes of this pattern follow walls.
    NoWalls,
    /// A pass beside walls breaks off.
    Broken {
        /// Where.
        at: [f64; 2],
    },
}

/// A change of the job with which there is a plan: it was tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Remedy {
    /// Down a ramp.
    Ramp,
    /// With a narrower tool.
    Radius(Length),
}

/// An operation without a plan.
pub(crate) struct Refused<'j> {
    pub(crate) asked: &'j ClearPocket,
    pub(crate) why: Why,
    /// What gives a plan.
    pub(crate) remedy: Option<Remedy>,
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
            Why::TooNarrow { wide, at: [x, y] } => {
                let radius = asked.crusher.radius.value.to_mm();
                // Passes keep what a control may cut off at joints, and what rounding takes.
                let margin = (asked.allowance.value + BLEND + ROUNDING_ROOM).to_mm();
                let needs = 2.0 * (radius + margin);
                let largest = down(wide / 2.0 - margin);
                Diagnostic::new(
                    Code::PocketTooNarrow,
                    format!(
                        "`{}` needs {} mm between walls; the widest circle in `{name}` has {} mm, at ({} mm, {} mm)",
                        asked.crusher.name,
                        show(needs),
                        show(down(wide)),
                        show(x),
                        show(y)
                    ),
                    asked.region_span,
                    "too narrow for the tool",
                )
                .and(asked.crusher.radius.span.unwrap_or(asked.crusher.span), "its radius")
                .help(if largest > 0.0 {
                    format!("use a tool with a radius of at most {} mm", show(largest))
                } else {
                    "use a smaller allowance".to_owned()
                })
            }
            Why::NothingThere { top } => {
                floors::nothing_left_above(asked.floor, asked.setup.head_span, &asked.region, top)
            }
            Why::NoWayDown { at: [x, y] } => Diagnostic::new(
                Code::PocketTooNarrow,
                format!(
                    "`{}` fits into `{name}`, but has no room to go down at ({} mm, {} mm): a crusher does not cut at its centre",
                    asked.crusher.name,
                    show(x),
                    show(y)
                ),
                asked.region_span,
                "hardly wider than the tool",
            )
            .help("use a narrower tool"),
            Why::NoHelix { at } => self.no_helix(at),
            Why::NotOpen { at } => self.not_open(at),
            Why::NoField => Diagnostic::new(
                Code::PocketTooNarrow,
                format!("the sound field over `{name}` cannot be computed"),
                asked.region_span,
                "has too many sides, or is too large for this step",
            )
            .help("use another pattern, such as `pattern = sfs`, or a wider `step`"),
            Why::NoWalls => {
                let pattern = asked.pattern.span;
                let diagnostic = Diagnostic::new(
                    Code::PocketTooNarrow,
                    format!("all sides of `{name}` are open: it has no walls that passes could follow"),
                    pattern.unwrap_or(asked.region_span),
                    "follows walls",
                );
                match pattern {
                    Some(span) => diagnostic.fix("clear it in rows", span, "zigzag"),
                    None => diagnostic.help("use `pattern = zigzag`"),
                }
            }
            Why::Broken { at: [x, y] } => Diagnostic::new(
                Code::PocketTooNarrow,
                format!(
                    "no pass can be laid along the walls of `{name}` at ({} mm, {} mm)",
                    show(x),
                    show(y)
                ),
                asked.region_span,
                "walls touch or nearly touch there",
            )
            .help("draw walls that touch farther apart, or as one loop; or change the tool or the step a little"),
            Why::TooLarge => Diagnostic::new(
                Code::PocketTooNarrow,
                format!("`{name}` takes more passes than are planned"),
                asked.region_span,
                "too large for this step",
            )
            .help("use a wider tool, or a wider `step`"),
        }
    }
}

impl Refused<'_> {
    fn at_entry(&self, message: String, label: &str) -> Diagnostic {
        let asked = self.asked;
        let span = asked.entry.span.unwrap_or(asked.region_span);
        Diagnostic::new(Code::NoEntry, message, span, label)
    }

    fn no_helix(&self, [x, y]: [f64; 2]) -> Diagnostic {
        let asked = self.asked;
        let wide = asked.crusher.radius.value.to_mm() / 2.0;
        let message = format!(
            "a helix of `{}` has a radius of at least {} mm, half of the tool's, and `{}` has no room for it near ({} mm, {} mm)",
            asked.crusher.name,
            show(wide),
            asked.region.name,
            show(x),
            show(y)
        );
        self.at_entry(message, "no room for it")
            .and(asked.region_span, "the region")
            .help(match self.remedy {
                Some(Remedy::Ramp) => "use `entry = ramp`".to_owned(),
                Some(Remedy::Radius(radius)) => {
                    format!(
                        "a ramp has no room either: use a tool with a radius of {} mm",
                        show(radius.to_mm())
                    )
                }
                None => "a ramp has no room either: use a much narrower tool".to_owned(),
            })
    }

    fn not_open(&self, [x, y]: [f64; 2]) -> Diagnostic {
        let asked = self.asked;
        let message = format!(
            "a pass over `{}` begins at ({} mm, {} mm), where no open side leads",
            asked.region.name,
            show(x),
            show(y)
        );
        self.at_entry(message, "the tool may not go down into the material")
            .and(asked.region_span, "the region")
            .help(match (asked.opening, self.remedy) {
                (_, Some(_)) => "use `entry = ramp`",
                (None, None) => "name a hole with `opening = hole(x = , y = , radius = )`",
                (Some(_), None) => "name a hole from which a straight way leads to that place",
            })
    }
}

/// Rounded down to a hundredth, so that the number shown works.
fn down(value: f64) -> f64 {
    (value * 100.0).floor() / 100.0
}

pub(crate) fn step_too_wide(asked: &ClearPocket, step: Length) -> Diagnostic {
    let radius = asked.crusher.radius;
    Diagnostic::new(
        Code::OutOfRange,
        format!(
            "passes {} mm apart leave core between them: `{}` is {} mm wide",
            show(step.to_mm()),
            asked.crusher.name,
            show(2.0 * radius.value.to_mm())
        ),
        asked.step.span.unwrap_or(asked.setup.head_span),
        "wider than the tool",
    )
    .and(radius.span.unwrap_or(asked.crusher.span), "its radius")
    .help(format!(
        "use a step of at most {} mm, which leaves nothing",
        show(radius.value.to_mm())
    ))
}

pub(crate) fn too_thick(asked: &ClearPocket, layer: Length) -> Diagnostic {
    let height = asked.crusher.height;
    Diagnostic::new(
        Code::LayerTooThick,
        format!(
            "a layer of {} mm, and `{}` cuts {} mm at once",
            show(layer.to_mm()),
            asked.crusher.name,
            show(height.value.to_mm())
        ),
        asked.layer.span.unwrap_or(asked.setup.head_span),
        "thicker than the tool is high",
    )
    .and(height.span.unwrap_or(asked.crusher.span), "its height")
    .help(format!("use `layer = {} mm`", show(height.value.to_mm())))
}
