//! How the cuts of a job follow its part along y: `follow`, decided for all operations together.

use super::part::Part;
use super::report::{Checked, Reports};
use crate::follow::{Follow, Guide};
use crate::ways::Ways;
use crate::{BladeRef, Machine, Operation, Sourced};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_surface::columns::Each;
use vcutc_surface::spine::Rising;
use vcutc_surface::surface::Surface;

/// How much more a simpler way to follow the part may leave than the best one: so many times as much, or so much more, in mm.
const HARDLY_MORE: (f64, f64) = (1.1, 0.25);

/// What the decision is made from.
pub(super) struct Asked<'a> {
    pub(super) part: Part,
    /// Where the part is described.
    pub(super) place: Span,
    pub(super) stock: Stock,
    pub(super) machine: Option<&'a Machine>,
}

/// What cuts may follow other than level lines.
#[derive(Clone, Copy)]
enum Manner {
    /// All of them one spine.
    Alike(Rising),
    /// Each a way of its own.
    Own(Each),
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
    let manner = match (asked.part.surface(), follow.value) {
        (_, Follow::Straight) | (None, Follow::Auto) => None,
        (None, Follow::Pitched | Follow::Spine | Follow::Fan | Follow::Columns) => {
            return Err(reports.push(nothing_to_follow(word, asked.place)));
        }
        (Some(_), Follow::Pitched) => Some(Manner::Alike(Rising::Evenly)),
        (Some(_), Follow::Spine) => Some(Manner::Alike(Rising::Freely)),
        (Some(_), Follow::Fan) => Some(Manner::Own(Each::Straight)),
        (Some(_), Follow::Columns) => Some(Manner::Own(Each::Curved)),
        (Some(surface), Follow::Auto) => best(&asked, surface, ways),
    };
    match manner {
        None => Ok(asked.part),
        Some(Manner::Alike(rising)) => alike(asked, rising, word, ways, reports),
        Some(Manner::Own(each)) => own(asked, each, word, ways, reports),
    }
}

/// The part with all cuts along one spine.
fn alike(
    asked: Asked<'_>,
    rising: Rising,
    word: Spanned<Follow>,
    ways: &mut [Ways],
    reports: &mut Reports,
) -> Checked<Part> {
    // Where nothing is better than level cuts, these are taken.
    if asked.part.fitted(rising).is_none() {
        return Ok(asked.part);
    }
    if let Some(machine) = asked.machine.filter(|machine| !machine.turns_planes()) {
        return Err(reports.push(too_few_axes(word, machine)));
    }
    // A surface that covers the stock does so with its spine taken off.
    let Some(part) = asked.part.along(rising, asked.stock) else {
        return Ok(asked.part);
    };
    if let Some(guide) = part.guide() {
        let longest: Vec<Option<Length>> = ways.iter().map(longest_edge).collect();
        for (number, ways) in ways.iter_mut().enumerate() {
            let others = longest.iter().enumerate().filter(|(other, _)| *other != number);
            let others = others.filter_map(|(_, edge)| *edge).reduce(Length::max);
            for way in ways.iter_mut() {
                way.operation.go_along(guide, others);
            }
        }
    }
    Ok(part)
}

/// The part with every cut along the way of its place.
fn own(
    asked: Asked<'_>,
    each: Each,
    word: Spanned<Follow>,
    ways: &mut [Ways],
    reports: &mut Reports,
) -> Checked<Part> {
    if let Some(machine) = asked.machine.filter(|machine| !machine.turns_planes()) {
        return Err(reports.push(too_few_axes(word, machine)));
    }
    if let [_, second, ..] = ways {
        let second = second.iter().next().map(|way| way.operation.setup().head_span);
        return Err(reports.push(not_alone(word, second.unwrap_or(asked.place))));
    }
    if let Some(body) = body(ways) {
        return Err(reports.push(stated_body(word, body)));
    }
    let Some(part) = asked.part.along_columns(each, asked.stock) else {
        return Err(reports.push(not_covered(word, asked.place)));
    };
    let steepest = part.guide().map_or(0.0, Guide::steepest);
    if steepest == 0.0 {
        return Ok(asked.part);
    }
    if let Some(guide) = part.guide() {
        for way in ways.iter_mut().flat_map(Ways::iter_mut) {
            way.operation.go_along(guide, None);
        }
    }
    Ok(part)
}

/// Where the body of a blade is stated.
fn body(ways: &[Ways]) -> Option<Span> {
    let blades = ways
        .iter()
        .flat_map(Ways::iter)
        .flat_map(|way| way.operation.blades());
    blades.filter_map(BladeRef::body).map(|body| body.span).next()
}

/// The longest edge of the straight blades of an operation, if it has some.
fn longest_edge(ways: &Ways) -> Option<Length> {
    let blades = ways.iter().flat_map(|way| way.operation.blades());
    blades.filter_map(BladeRef::edge).reduce(Length::max)
}

/// What all operations ask for that have a say; none where none has.
fn agreed(ways: &[Ways], reports: &mut Reports) -> Checked<Option<Sourced<Follow>>> {
    let mut found: Option<(Sourced<Follow>, &dyn Operation)> = None;
    for way in ways.iter().flat_map(Ways::iter) {
        let operation = &*way.operation;
        match (operation.follows(), found) {
            (Some(follow), None) => found = Some((follow, operation)),
            // `auto` goes along with what others ask for.
            (Some(follow), Some((known, _))) if known.value == Follow::Auto => {
                found = Some((follow, operation))
            }
            (Some(follow), Some((known, before)))
                if follow.value != known.value && follow.value != Follow::Auto =>
            {
                return Err(reports.push(otherwise([(known, before), (follow, operation)])));
            }
            (Some(_) | None, _) => {}
        }
    }
    Ok(found.map(|(follow, _)| follow))
}

/// Ways of their own that rise by more are taken only where the job asks for them, as a slope (20 deg): flanks along steep ways need more
/// edge than most blades have, and whether a blade has it is known only after planning.
const STEEP: f64 = 0.364;

/// The simplest way to follow a surface that leaves hardly more than the best; none where level cuts do. Ways of their own are looked at
/// where cuts can have them.
fn best(asked: &Asked<'_>, surface: &Surface, ways: &[Ways]) -> Option<Manner> {
    if asked.machine.is_some_and(|machine| !machine.turns_planes()) {
        return None;
    }
    let part = &asked.part;
    let may_differ = ways.len() == 1 && body(ways).is_none();
    let straight = surface.left_by_straight_cuts();
    let alike = |rising| Some((Manner::Alike(rising), part.fitted(rising)?.leaves));
    let own = |each| {
        let covered = part.covered(each).filter(|_| may_differ)?;
        let covered = Some(covered).filter(|covered| covered.columns.steepest() <= STEEP)?;
        Some((Manner::Own(each), covered.leaves))
    };
    let found = [
        alike(Rising::Evenly),
        alike(Rising::Freely),
        own(Each::Straight),
        own(Each::Curved),
    ];
    let least = found
        .iter()
        .flatten()
        .map(|(_, leaves)| *leaves)
        .fold(straight, f64::min);
    let (times, more) = HARDLY_MORE;
    let enough = (times * least).max(least + more);
    if straight <= enough {
        return None;
    }
    let mut found = found.into_iter().flatten();
    found
        .find(|(_, leaves)| *leaves <= enough)
        .map(|(manner, _)| manner)
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

fn not_alone(follow: Spanned<Follow>, second: Span) -> Diagnostic {
    Diagnostic::new(
        Code::CannotFollow,
        match follow.node {
            Follow::Fan => "cuts that follow a fan have their job to themselves",
            _ => "cuts that follow columns have their job to themselves",
        },
        follow.span,
        its_own(follow),
    )
    .and(
        second,
        "this operation would have to know what they left at every y",
    )
    .note("other operations are planned in one cross-section, and after these cuts all of them differ")
    .help("delete the other operations, or let all of them `follow = spine`")
}

/// What sets cuts apart that have ways of their own.
const fn its_own(follow: Spanned<Follow>) -> &'static str {
    match follow.node {
        Follow::Fan => "the slope of each of these cuts is its own",
        _ => "the way of each of these cuts is its own",
    }
}

fn stated_body(follow: Spanned<Follow>, blade: Span) -> Diagnostic {
    Diagnostic::new(
        Code::CannotFollow,
        format!(
            "`follow = {}` does not go with a blade whose `body` is stated",
            follow.node.word()
        ),
        follow.span,
        its_own(follow),
    )
    .and(blade, "the body of this blade is stated")
    .note("how bodies pass the work is computed in one cross-section, and those of these cuts differ")
    .help("delete `body`, or use `follow = spine`")
    .fix("follow a spine: `spine`", follow.span, Follow::Spine.word())
}

fn not_covered(follow: Spanned<Follow>, part: Span) -> Diagnostic {
    Diagnostic::new(
        Code::CannotFollow,
        match follow.node {
            Follow::Fan => "no straight lines cover this part",
            _ => "no curves that a blade can follow cover this part",
        },
        follow.span,
        match follow.node {
            Follow::Fan => "every cut follows the straight line that covers the part in its place",
            _ => "every cut follows the curve that covers the part in its place",
        },
    )
    .and(
        part,
        match follow.node {
            Follow::Fan => "this surface has a gap along y",
            _ => "this surface is steeper than 45 degrees along y",
        },
    )
    .help(match follow.node {
        Follow::Fan => "close the gap, or use `follow = straight`",
        _ => "use `follow = straight`",
    })
    .fix("cut level: `straight`", follow.span, Follow::Straight.word())
}

fn too_few_axes(follow: Spanned<Follow>, machine: &Machine) -> Diagnostic {
    let word = follow.node.word();
    let count = machine.rotary_axes();
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
