//! What the open parameters come out as.
//!
//! This is the one place where `auto` is decided: swing, layer and step by closed form (the paper's 45 degrees, the
//! largest layer the blade and the scallop limit allow, the widest step at the asked overlap), extension and standoff
//! from the blade. A search for the fastest parameters would replace [`resolve`] and nothing else.

use super::blade_reach::{self, Flanks};
use super::grid;
use super::time_model::TimeModel;
use crate::diag::{Code, Diagnostic};
use crate::job::{Auto, CheckedJob, Direction, Lattice, RoughVcut};
use crate::posture::Holder;
use vcutc_backend_api::units::{Angle, Area, Length};

/// The swing at which a chip of given edge length is largest [Cui 3]; taken when the swing is left open.
pub const AUTO_SWING: Angle = Angle::deg(45.0);

/// The parameters of one V-cutting operation, all decided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VcutParameters {
    /// How tips are laid out.
    pub lattice: Lattice,
    /// Overlap by which an open step follows from the layer.
    pub overlap: f64,
    /// Half the opening angle of the V.
    pub swing: Angle,
    /// Layer spacing.
    pub layer: Length,
    /// Spacing of tips in a layer; free layouts use a little less where that spreads tips evenly over a stretch.
    pub step: Length,
    /// How far cuts run out beyond the stock.
    pub extension: Length,
    /// Distance of the blade's middle plane from the material that stays.
    pub standoff: Length,
    /// How much higher the tip runs than the V its material side makes: `standoff / sin(swing)`.
    pub drop: Length,
    /// Slope and reach of the flanks.
    pub flanks: Flanks,
    /// How high above the tip material may stand while the blade moves or turns beside it: the blade leans over the work.
    pub clear_height: Length,
}

/// A parameter that was left to the compiler, and what it came out as.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Its name in the language.
    pub name: &'static str,
    /// Its value with unit.
    pub value: String,
}

impl VcutParameters {
    /// Whether the blade reaches what the lattice needs far from the part.
    #[must_use]
    pub fn lattice_fits(&self) -> bool {
        fits(self.lattice, self.layer, self.step, &self.flanks)
    }

    /// The step that goes with this layer when it is left open.
    #[must_use]
    pub fn step_for_layer(&self) -> Length {
        widest_step(self.lattice, self.layer, self.overlap, &self.flanks)
    }

    /// What was left open and how it was decided, in the order of the language reference.
    #[must_use]
    pub fn choices(&self, asked: &RoughVcut) -> Vec<Choice> {
        let length = |name, open: Auto<Length>, value: Length| match open {
            Auto::Auto => Some(Choice {
                name,
                value: format!("{:.3} mm", value.to_mm()),
            }),
            Auto::Given(_) => None,
        };
        let swing = match asked.swing.value {
            Auto::Auto => Some(Choice {
                name: "swing",
                value: format!("{:.3} deg", self.swing.to_deg()),
            }),
            Auto::Given(_) => None,
        };
        [
            swing,
            length("layer", asked.layer.value, self.layer),
            length("step", asked.step.value, self.step),
            length("extension", asked.extension.value, self.extension),
            length("standoff", asked.standoff.value, self.standoff),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// The mean-value model of the paper for a job cut with these parameters.
    #[must_use]
    pub fn time_model(&self, job: &CheckedJob, asked: &RoughVcut) -> TimeModel {
        let stock = job.stock;
        let part = job.profile.area_below(0.0, stock.width.to_mm());
        TimeModel {
            width: stock.width,
            depth: stock.depth,
            area: Area::mm2(stock.width.to_mm() * stock.height.to_mm()) - part,
            clearance: asked.clearance.value,
            extension: self.extension,
            rake: asked.rake.value,
            cut_feed: asked.cut_feed.value,
            travel_feed: asked.travel_feed.value,
            reorient_rate: asked.reorient_rate.value,
        }
    }
}

/// Decides what is open. None when the operation contradicts itself, which is then reported.
#[must_use]
pub fn resolve(asked: &RoughVcut, diagnostics: &mut Vec<Diagnostic>) -> Option<VcutParameters> {
    let before = diagnostics.len();
    check_rake(asked, diagnostics);
    let swing = resolve_swing(asked, diagnostics);
    let standoff = resolve_standoff(asked, diagnostics);
    if diagnostics.len() > before {
        return None;
    }
    let drop = standoff / swing.sin();
    let flanks = Flanks::new(
        asked.blade.cutting_length.value,
        asked.blade.half_apex.value,
        asked.rake.value,
        swing,
    );
    let (layer, step) = resolve_layer_and_step(asked, &flanks, drop, diagnostics)?;
    let lean = Lean::new(asked, swing);
    // Between the tips of the layer above, teeth stand up to this much above the tips of this one.
    let teeth = layer + step * (flanks.slope / 2.0);
    let extension = resolve_extension(
        asked,
        edge_overhang(asked, swing),
        lean.overhang(teeth),
        diagnostics,
    )?;
    // Who gives a shorter extension than the teeth ask for, as [Cui 5] does, accepts that the blade brushes them.
    let clear_height = lean.clear_height(extension).max(teeth);
    Some(VcutParameters {
        lattice: asked.lattice.value.or(Lattice::Orthogonal),
        overlap: asked.overlap.value.or(0.0),
        swing,
        layer,
        step,
        extension,
        standoff,
        drop,
        flanks,
        clear_height,
    })
}

/// How far the edge lies over the work while it cuts [Cui 5] and while it turns beside it; the whole cutting length, as deep
/// cuts use it.
fn edge_overhang(asked: &RoughVcut, swing: Angle) -> Length {
    let (length, half_apex) = (asked.blade.cutting_length.value, asked.blade.half_apex.value);
    let cutting = length * (asked.rake.value - half_apex).cos();
    match asked.direction.value {
        Direction::Alternate => {
            let holder = Holder {
                swing,
                rake: asked.rake.value,
                edges: asked.blade.edges,
            };
            cutting.max(holder.turning_overhang(length, half_apex))
        }
        // The blade turns above the work only.
        Direction::Forward | Direction::Backward => cutting,
    }
}

/// How the blade leans over the work while its tip is beside it. Above the cutting length it is taken to go on along the tool
/// axis as wide as it is there.
struct Lean {
    /// Half the blade's width at its full cutting length, measured along y: `L sin(beta) / sin(theta)`.
    half_width: Length,
    /// How far the tool axis leans along y for each millimetre of height: `cot(theta) / cos(alpha)`.
    per_height: f64,
}

impl Lean {
    fn new(asked: &RoughVcut, swing: Angle) -> Self {
        let (blade, rake) = (&asked.blade, asked.rake.value);
        Self {
            half_width: blade.cutting_length.value * (blade.half_apex.value.sin() / rake.sin()),
            per_height: rake.cos().max(0.0) / (rake.sin() * swing.cos()),
        }
    }

    /// How far the blade lies over the work at a height above the tip.
    fn overhang(&self, height: Length) -> Length {
        self.half_width + height * self.per_height
    }

    /// The height up to which the blade is clear of the work with its tip that far beside it.
    fn clear_height(&self, extension: Length) -> Length {
        let upright = 1e-9;
        Length::mm((extension - self.half_width).to_mm().max(0.0) / self.per_height.max(upright))
    }
}

fn check_rake(asked: &RoughVcut, diagnostics: &mut Vec<Diagnostic>) {
    let (rake, half_apex) = (asked.rake.value, asked.blade.half_apex.value);
    if rake > half_apex {
        return;
    }
    let span = asked.rake.span.unwrap_or(asked.head_span);
    diagnostics.push(
        Diagnostic::new(
            Code::RakeTooFlat,
            format!(
                "with a rake of {} deg the leading edge does not cut",
                show(rake.to_deg())
            ),
            span,
            format!(
                "the edge leads the feed by rake less half apex, {} deg",
                show((rake - half_apex).to_deg())
            ),
        )
        .and(
            asked.blade.half_apex.span.unwrap_or(asked.blade.span),
            format!("half the blade's apex angle is {} deg", show(half_apex.to_deg())),
        )
        .help(format!(
            "use a rake well above {} deg, such as {} deg",
            show(half_apex.to_deg()),
            show(usual_rake(half_apex).to_deg())
        ))
        .fix(
            "use a rake that cuts",
            span,
            format!("{} deg", show(usual_rake(half_apex).to_deg())),
        ),
    );
}

/// The rake of the paper, or for very blunt blades one halfway to upright.
fn usual_rake(half_apex: Angle) -> Angle {
    let paper = Angle::deg(60.0);
    paper.max((half_apex + Angle::deg(90.0)) / 2.0)
}

fn resolve_swing(asked: &RoughVcut, diagnostics: &mut Vec<Diagnostic>) -> Angle {
    let limit = asked.limits.swing.most;
    match (asked.swing.value, limit) {
        (Auto::Auto, None) => AUTO_SWING,
        (Auto::Auto, Some(limit)) => AUTO_SWING.min(limit.value),
        (Auto::Given(swing), Some(limit)) if swing > limit.value => {
            let (limit_deg, span) = (
                show(limit.value.to_deg()),
                asked.swing.span.unwrap_or(asked.head_span),
            );
            let message = format!(
                "a swing of {} deg is above its limit of {limit_deg} deg",
                show(swing.to_deg())
            );
            let diagnostic = Diagnostic::new(Code::OutOfRange, message, span, "larger than the limit allows")
                .and(limit.span.unwrap_or(asked.head_span), "the limit")
                .help(format!("use at most {limit_deg} deg, or raise the limit"))
                .fix("use the limit", span, format!("{limit_deg} deg"));
            diagnostics.push(diagnostic);
            swing
        }
        (Auto::Given(swing), _) => swing,
    }
}

/// Half the blade's thickness, or what is given: less would let the blade's side enter the part.
fn resolve_standoff(asked: &RoughVcut, diagnostics: &mut Vec<Diagnostic>) -> Length {
    let least = asked.blade.thickness.value / 2.0;
    match asked.standoff.value {
        Auto::Auto => least,
        Auto::Given(standoff) => {
            if standoff < least {
                diagnostics.push(standoff_too_small(asked, standoff, least));
            }
            standoff
        }
    }
}

fn standoff_too_small(asked: &RoughVcut, standoff: Length, least: Length) -> Diagnostic {
    let blade = &asked.blade;
    let span = asked.standoff.span.unwrap_or(asked.head_span);
    let (standoff, least) = (show(standoff.to_mm()), show(least.to_mm()));
    let thickness = show(blade.thickness.value.to_mm());
    Diagnostic::new(
        Code::OutOfRange,
        format!("with a standoff of {standoff} mm the blade's side would enter the part"),
        span,
        format!("less than half the blade's thickness, {least} mm"),
    )
    .and(
        blade.thickness.span.unwrap_or(blade.span),
        format!("{thickness} mm thick"),
    )
    .help(format!("use at least {least} mm, or leave it `auto`"))
    .fix("let the compiler choose: `auto`", span, "auto")
}

/// The extension on the grid. The blade lies over the work by its edge, and above the edge by its body up to the teeth of
/// the layer above; given extensions need only clear the edge.
fn resolve_extension(
    asked: &RoughVcut,
    edge: Length,
    body_overhang: Length,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Length> {
    let on_grid = |extension: Length| Length::mm(grid::up(extension.to_mm()));
    match asked.extension.value {
        Auto::Auto => Some(on_grid(body_overhang.max(edge) + asked.run_out.value)),
        Auto::Given(extension) if on_grid(extension) >= on_grid(edge) => Some(on_grid(extension)),
        Auto::Given(extension) => {
            diagnostics.push(extension_too_short(asked, extension, on_grid(edge)));
            None
        }
    }
}

fn extension_too_short(asked: &RoughVcut, extension: Length, least: Length) -> Diagnostic {
    let blade = &asked.blade;
    let span = asked.extension.span.unwrap_or(asked.head_span);
    let (extension, least) = (show(extension.to_mm()), show(least.to_mm()));
    Diagnostic::new(
        Code::ExtensionTooShort,
        format!("with an extension of {extension} mm the blade would turn within the work"),
        span,
        format!("the edge lies {least} mm over the work"),
    )
    .and(
        blade.cutting_length.span.unwrap_or(blade.span),
        format!("{} mm of edge", show(blade.cutting_length.value.to_mm())),
    )
    .help(format!("use at least {least} mm, or leave it `auto`"))
    .fix("let the compiler choose: `auto`", span, "auto")
}

/// Layer and step, as far as they are open: the largest layer that blade and scallop limit allow, the widest step.
fn resolve_layer_and_step(
    asked: &RoughVcut,
    flanks: &Flanks,
    drop: Length,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<(Length, Length)> {
    let widest = |layer| {
        widest_step(
            asked.lattice.value.or(Lattice::Orthogonal),
            layer,
            asked.overlap.value.or(0.0),
            flanks,
        )
    };
    match (asked.layer.value, asked.step.value) {
        (Auto::Given(layer), Auto::Given(step)) => Some((layer, step)),
        (Auto::Given(layer), Auto::Auto) => Some((layer, widest(layer))),
        (Auto::Auto, _) if scallop_room(asked, drop).is_some_and(|room| room <= Length::ZERO) => {
            diagnostics.extend(no_room_for_scallops(asked, drop));
            None
        }
        (Auto::Auto, Auto::Given(step)) => {
            let layer = largest_layer_at(asked, step, flanks, drop);
            if layer.is_none() {
                diagnostics.push(step_too_wide(asked, step, flanks, drop));
            }
            layer.map(|layer| (layer, step))
        }
        (Auto::Auto, Auto::Auto) => {
            let layer = largest_layer(asked, flanks, drop);
            Some((layer, widest(layer)))
        }
    }
}

/// A scallop limit that allowance and standoff alone exceed: no layer follows from it.
fn no_room_for_scallops(asked: &RoughVcut, drop: Length) -> Option<Diagnostic> {
    let limit = asked.limits.scallop?;
    let least = show((asked.allowance.value + drop).to_mm());
    let limit_mm = show(limit.value.to_mm());
    let span = limit.span.unwrap_or(asked.head_span);
    let message = format!("at least {least} mm stay on the part below the tips, the limit is {limit_mm} mm");
    let diagnostic = Diagnostic::new(Code::ScallopOverLimit, message, span, "the limit");
    let allowance = (asked.allowance.value > Length::ZERO)
        .then_some(asked.allowance.span)
        .flatten();
    let diagnostic = match allowance {
        Some(span) => diagnostic.and(span, "this stays on the part"),
        None => diagnostic,
    };
    let diagnostic = if drop > Length::ZERO {
        let drop = show(drop.to_mm());
        diagnostic.note(format!(
            "the blade's standoff keeps its tip {drop} mm above the material that stays"
        ))
    } else {
        diagnostic
    };
    Some(diagnostic.help(format!(
        "set the limit well above {least} mm: what is left of it decides the layer"
    )))
}

/// A step at which no layer, however thin, is cut free or keeps the scallop limit.
fn step_too_wide(asked: &RoughVcut, step: Length, flanks: &Flanks, drop: Length) -> Diagnostic {
    let (lattice, overlap) = (
        asked.lattice.value.or(Lattice::Orthogonal),
        asked.overlap.value.or(0.0),
    );
    let works = widest_step(lattice, largest_layer(asked, flanks, drop), overlap, flanks);
    let (step_mm, works) = (show(step.to_mm()), show(works.to_mm()));
    let span = asked.step.span.unwrap_or(asked.head_span);
    let by_reach = blade_reach::largest_layer_at_step(lattice, step, flanks.slope, flanks.reach);
    let diagnostic = match (by_reach, asked.limits.scallop) {
        (Some(_), Some(limit)) => Diagnostic::new(
            Code::ScallopOverLimit,
            format!("with a step of {step_mm} mm no layer is thin enough for the scallop limit"),
            span,
            format!("between tips {step_mm} mm apart too much material stays"),
        )
        .and(limit.span.unwrap_or(asked.head_span), "the limit"),
        (Some(_) | None, _) => {
            let blade = &asked.blade;
            let length = show(blade.cutting_length.value.to_mm());
            Diagnostic::new(
                Code::ChipNotFreed,
                format!("with a step of {step_mm} mm no layer is thin enough to be cut free"),
                span,
                format!("between tips {step_mm} mm apart material stands higher than the blade reaches"),
            )
            .and(
                blade.cutting_length.span.unwrap_or(blade.span),
                format!("{length} mm of edge"),
            )
        }
    };
    diagnostic
        .help(format!("use a `step` of {works} mm, or leave it `auto`"))
        .fix("let the compiler choose the step", span, "auto")
}

/// Whether a blade reaches what a lattice needs, wherever rounding puts its tips.
fn fits(lattice: Lattice, layer: Length, step: Length, flanks: &Flanks) -> bool {
    let needed = |layer: Length, step: Length| blade_reach::needed_reach(lattice, layer, step, flanks.slope);
    let layers = around(layer, grid::SPACING);
    let steps = around(step, grid::SPACING * tips_per_step(lattice));
    let worst = layers
        .iter()
        .flat_map(|&layer| steps.iter().map(move |&step| needed(layer, step)));
    worst.fold(Length::ZERO, Length::max) <= flanks.reach + Length::mm(1e-6)
}

/// The spacings that tips rounded to the grid really have: the value itself where it is a multiple of the unit, else up to a
/// grid spacing more or less.
fn around(value: Length, unit: f64) -> [Length; 3] {
    let multiple = value.to_mm() / unit;
    let off = if (multiple - multiple.round()).abs() < 1e-6 {
        0.0
    } else {
        grid::SPACING
    };
    [-off, 0.0, off].map(|off| (value + Length::mm(off)).max(Length::mm(grid::SPACING)))
}

/// Interlaced rows lie half a step apart, so half a step must be on the grid for all tips to be.
const fn tips_per_step(lattice: Lattice) -> f64 {
    match lattice {
        Lattice::Interlaced => 2.0,
        Lattice::Orthogonal | Lattice::Free => 1.0,
    }
}

/// The largest layer on the grid, starting from a closed form, that fits with the step it gets: rounding may cost a few
/// spacings.
fn largest_fitting(
    lattice: Lattice,
    closed_form: Length,
    flanks: &Flanks,
    step: impl Fn(Length) -> Length,
) -> Length {
    let mut layer = on_grid(closed_form);
    for _ in 0..1000 {
        if layer.to_mm() <= grid::SPACING || fits(lattice, layer, step(layer), flanks) {
            break;
        }
        layer = on_grid(layer - Length::mm(grid::SPACING));
    }
    layer
}

/// What of the scallop limit is left for the lattice: allowance and standoff stand on the part anyway.
fn scallop_room(asked: &RoughVcut, drop: Length) -> Option<Length> {
    let limit = asked.limits.scallop?;
    Some(limit.value - asked.allowance.value - drop)
}

/// The largest layer with the step left open, for error messages and for `auto`.
#[must_use]
pub fn largest_layer(asked: &RoughVcut, flanks: &Flanks, drop: Length) -> Length {
    let (lattice, overlap) = (
        asked.lattice.value.or(Lattice::Orthogonal),
        asked.overlap.value.or(0.0),
    );
    let by_reach = blade_reach::largest_layer(lattice, overlap, flanks.reach);
    let by_scallop = scallop_room(asked, drop)
        .map(|room| blade_reach::largest_layer_for_scallop(lattice, overlap, flanks.slope, room));
    let closed_form = by_scallop.map_or(by_reach, |layer| layer.min(by_reach));
    largest_fitting(lattice, closed_form, flanks, |layer| {
        widest_step(lattice, layer, overlap, flanks)
    })
}

/// The largest layer at a given step, if there is any.
#[must_use]
pub fn largest_layer_at(asked: &RoughVcut, step: Length, flanks: &Flanks, drop: Length) -> Option<Length> {
    let lattice = asked.lattice.value.or(Lattice::Orthogonal);
    let by_reach = blade_reach::largest_layer_at_step(lattice, step, flanks.slope, flanks.reach)?;
    let closed_form = match scallop_room(asked, drop) {
        None => by_reach,
        Some(room) => {
            blade_reach::largest_layer_for_scallop_at_step(lattice, step, flanks.slope, room)?.min(by_reach)
        }
    };
    Some(largest_fitting(lattice, closed_form, flanks, |_| step))
}

/// Rounded down to the grid, and at least one spacing.
fn on_grid(layer: Length) -> Length {
    Length::mm(grid::down(layer.to_mm()).max(grid::SPACING))
}

/// A step this near to a grid step, in grid steps, is that one: 2 h tan(45 deg) comes out as 11.999 999 999 mm.
const ON_GRID: f64 = 1e-6;

/// The widest step at an overlap [Cui 7], on the grid. Rounded down, unless that hair makes flanks pass below the older
/// tips they are meant to pass through, which takes far more reach: interlaced lattices without overlap, and others at
/// overlaps like a half, are then rounded up.
fn widest_step(lattice: Lattice, layer: Length, overlap: f64, flanks: &Flanks) -> Length {
    let unit = grid::SPACING * tips_per_step(lattice);
    let [_, _, layer] = around(layer, grid::SPACING);
    let ideal = 2.0 * (1.0 - overlap) * layer.to_mm() / flanks.slope / unit;
    let steps =
        [(ideal + ON_GRID).floor(), (ideal - ON_GRID).ceil()].map(|count| Length::mm(count.max(1.0) * unit));
    let [narrow, wide] = steps.map(|step| blade_reach::needed_reach(lattice, layer, step, flanks.slope));
    let jump = Length::mm(unit * (1.0 + flanks.slope));
    let [down, up] = steps;
    if narrow > wide + jump { up } else { down }
}

/// A number for people: up to three decimals, without trailing zeros.
#[must_use]
pub fn show(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}
