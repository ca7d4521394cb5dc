//! How the cuts of a job follow its part along y: `follow`, decided for all operations together.

use super::part::Part;
use super::report::{Checked, Reports};
use crate::follow::Follow;
use crate::ways::Ways;
use crate::{Machine, Operation, Sourced};
use vcutc_backend_api::ir::{AxisKind, Stock};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_surface::spine::Rising;
use vcutc_surface::surface::Surface;

/// By how much more a simpler way to follow the part may leave than the best one.
const HARDLY_MORE: f64 = 1.1;

/// Rotary axes that it takes to turn the plane of a blade any way.
const ROTARY_AXES: usize = 3;

/// What the decision is made from.
pub(super) struct Asked<'a> {
    pub(super) part: Part,
    /// Where the part is described.
    pub(super) place: Span,
    pub(super) stock: Stock,
    pub(super) machine: Option<&'a Machine>,
}

/// The part as the cuts of all operations follow it.
pub(super) fn decide(asked: Asked<'_>, ways: &mut [Ways], reports: &mut Reports) -> Checked<Part> {
    let Some(follow) = agreed(ways, reports)? else {
        return Ok(asked.part);
    };
    let word = Spanned {
        node: follow.value,
        span: follow.span.unwrap_or(asked.place),
    };
    let rising = match (asked.part.surface(), follow.value) {
        (_, Follow::Straight) | (None, Follow::Auto) => None,
        (None, Follow::Pitched | Follow::Spine) => {
            return Err(reports.push(nothing_to_follow(word, asked.place)));
        }
        (Some(_), Follow::Pitched) => Some(Rising::Evenly),
        (Some(_), Follow::Spine) => Some(Rising::Freely),
        (Some(surface), Follow::Auto) => best(&asked.part, surface, ways, asked.machine),
    };
    // Where nothing is better than level cuts, these are taken.
    let Some(rising) = rising.filter(|rising| asked.part.fitted(*rising).is_some()) else {
        return Ok(asked.part);
    };
    if let Some(machine) = asked.machine.filter(|machine| !turns_planes(machine)) {
        return Err(reports.push(too_few_axes(word, machine)));
    }
    // A surface that covers the stock does so with its spine taken off.
    let Some(part) = asked.part.along(rising, asked.stock) else {
        return Ok(asked.part);
    };
    if let Some(spine) = part.spine() {
        for way in ways.iter_mut().flat_map(Ways::iter_mut) {
            way.operation.go_along(spine);
        }
    }
    Ok(part)
}

/// What all operations ask for that have a say; none where none has.
fn agreed(ways: &[Ways], reports: &mut Reports) -> Checked<Option<Sourced<Follow>>> {
    let mut found: Option<(Sourced<Follow>, &dyn Operation)> = None;
    for way in ways.iter().flat_map(Ways::iter) {
        let operation = &*way.operation;
        match (operation.follows(), found) {
            (Some(follow), None) => found = Some((follow, operation)),
            (Some(follow), Some((known, before))) if follow.value != known.value => {
                return Err(reports.push(otherwise([(known, before), (follow, operation)])));
            }
            (Some(_) | None, _) => {}
        }
    }
    Ok(found.map(|(follow, _)| follow))
}

/// The simplest way to follow a surface that leaves hardly more than the best, or no more than all limits allow; none where level
/// cuts do.
fn best(part: &Part, surface: &Surface, ways: &[Ways], machine: Option<&Machine>) -> Option<Rising> {
    if machine.is_some_and(|machine| !turns_planes(machine)) {
        return None;
    }
    let operations = ways.iter().flat_map(Ways::iter).map(|way| &way.operation);
    let limits = operations.filter_map(|operation| operation.scallop_limit());
    let limit = limits.map(|limit| limit.value).reduce(Length::min);
    let straight = surface.left_by_straight_cuts();
    let all = [Rising::Evenly, Rising::Freely];
    let found = all.map(|rising| Some((rising, part.fitted(rising)?.leaves)));
    let least = found
        .iter()
        .flatten()
        .map(|(_, leaves)| *leaves)
        .fold(straight, f64::min);
    let enough = limit.map_or(0.0, Length::to_mm).max(HARDLY_MORE * least);
    if straight <= enough {
        return None;
    }
    let mut found = found.into_iter().flatten();
    found
        .find(|(_, leaves)| *leaves <= enough)
        .map(|(rising, _)| rising)
}

/// Whether a machine can hold the plane of a blade along any way.
fn turns_planes(machine: &Machine) -> bool {
    let axes = machine.model.axes.iter();
    axes.filter(|axis| axis.kind == AxisKind::Rotary).count() >= ROTARY_AXES
}

fn nothing_to_follow(follow: Spanned<Follow>, part: Span) -> Diagnostic {
    let word = follow.node.word();
    Diagnostic::new(
        Code::CannotFollow,
        format!("`follow = {word}` has nothing to follow"),
        follow.span,
        "cuts rise and fall with a part that changes along y",
    )
    .and(part, "this part is the same at every y")
    .help("delete `follow`, or describe the part by a `surface`")
    .fix("cut level: `straight`", follow.span, Follow::Straight.word())
}

fn too_few_axes(follow: Spanned<Follow>, machine: &Machine) -> Diagnostic {
    let word = follow.node.word();
    let axes = machine.model.axes.iter();
    let count = axes.filter(|axis| axis.kind == AxisKind::Rotary).count();
    Diagnostic::new(
        Code::CannotFollow,
        format!(
            "{} cannot pitch the blade as `follow = {word}` asks",
            machine.name
        ),
        follow.span,
        "the plane of the blade would have to turn about a third axis",
    )
    .and(machine.model_span, format!("a machine with {count} rotary axes"))
    .help("use `follow = straight`, or a machine with three rotary axes, such as a robot")
    .fix("cut level: `straight`", follow.span, Follow::Straight.word())
}

fn otherwise([(first, before), (second, after)]: [(Sourced<Follow>, &dyn Operation); 2]) -> Diagnostic {
    let place = |follow: Sourced<Follow>, operation: &dyn Operation| {
        follow.span.unwrap_or(operation.setup().head_span)
    };
    let label = |follow: Sourced<Follow>| format!("these cuts follow it `{}`", follow.value.word());
    Diagnostic::new(
        Code::CannotFollow,
        "the operations of this job follow the part in different ways",
        place(second, after),
        label(second),
    )
    .and(place(first, before), label(first))
    .note("an operation has to know in one cross-section what those before it left")
    .help("give all operations of `rough vcut` the same `follow`; others cut straight")
}
