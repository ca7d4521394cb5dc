//! How the cuts of a job follow its part along y: `follow`, decided for all operations together.

use super::families::{Candidate, EachWay, Misfit, Work, candidates, follow};
use super::part::Part;
use super::report::{Checked, Reports};
use crate::follow::{Family, Follow};
use crate::ways::Ways;
use crate::{Machine, Operation, Sourced};
use vcutc_backend_api::ir::Stock;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_surface::columns::Each;

/// What the decision is made from.
pub(super) struct Asked<'a> {
    pub(super) part: Part,
    /// Where the part is described.
    pub(super) place: Span,
    pub(super) stock: Stock,
    pub(super) machine: Option<&'a Machine>,
}

/// How cuts follow the part.
pub(super) struct Decided {
    /// The part as the cuts of all operations follow it.
    pub(super) part: Part,
    /// The families that planning may take instead, where the job leaves that open.
    pub(super) families: Vec<Candidate>,
}

/// Decides what the job decides, and finds what it leaves open.
pub(super) fn decide(asked: Asked<'_>, ways: &mut [Ways], reports: &mut Reports) -> Checked<Decided> {
    let Some(agreed) = agreed(ways, reports)? else {
        return Ok(Decided {
            part: asked.part,
            families: Vec::new(),
        });
    };
    let second = ways.get(1).and_then(|ways| ways.iter().next());
    let second = second.map(|way| way.operation.setup().head_span);
    let mut operations: Vec<EachWay<'_>> = ways
        .iter_mut()
        .map(|ways| ways.iter_mut().map(|way| &mut way.operation).collect())
        .collect();
    let work = Work {
        part: &asked.part,
        stock: asked.stock,
        machine: asked.machine,
    };
    let (family, families) = match (agreed.value.family(), asked.part.surface()) {
        (Some(family), _) => (family, Vec::new()),
        (None, None) => (Family::Straight, Vec::new()),
        (None, Some(surface)) => {
            let found = candidates(work, surface, &operations);
            // Level cuts alone leave no choice.
            (Family::Straight, if found.len() > 1 { found } else { Vec::new() })
        }
    };
    let word = Spanned {
        node: family,
        span: agreed.span.unwrap_or(asked.place),
    };
    if asked.part.surface().is_none() && family != Family::Straight {
        return Err(reports.push(nothing_to_follow(word, asked.place)));
    }
    if let Some(warning) = steeper_than_ways(&asked.part, word) {
        let _ = reports.push(warning);
    }
    match follow(work, family, &mut operations) {
        Ok(part) => Ok(Decided { part, families }),
        Err(why) => Err(reports.push(refused(why, word, asked.place, second))),
    }
}

/// More stays where the part is steeper than its cuts, in mm, than is worth a warning.
const MUCH_STAYS: f64 = 0.5;

/// A warning about cuts that cannot rise as steeply as the part.
fn steeper_than_ways(part: &Part, word: Spanned<Family>) -> Option<Diagnostic> {
    let each = match word.node {
        Family::Fan => Each::Straight,
        Family::Columns => Each::Curved,
        Family::Straight | Family::Pitched | Family::Spine => return None,
    };
    let leaves = part.covered(each)?.leaves;
    let steep = part.surface()?.steeper_than_ways(each)?;
    if leaves <= MUCH_STAYS {
        return None;
    }
    let [x, y] = steep.place;
    let angle = steep.angle.to_deg();
    let diagnostic = Diagnostic::new(
        Code::SteeperThanCuts,
        format!("the part rises by {angle:.1} deg along y, and these cuts by 45 deg at most"),
        word.span,
        match each {
            Each::Straight => format!("the line nearest to the part is steepest at x {x:.1} mm"),
            Each::Curved => format!("the part is steepest at x {x:.1} mm, y {y:.1} mm"),
        },
    )
    .note(format!(
        "up to {leaves:.2} mm stay above the part, however close the cuts are"
    ))
    .help("turn the part so that it is steep across the cuts");
    Some(diagnostic.fix(
        "plan all ways to follow the part: `auto`",
        word.span,
        Follow::Auto.word(),
    ))
}

/// Why the cuts cannot follow the part as the job asks.
fn refused(why: Misfit<'_>, word: Spanned<Family>, part: Span, second: Option<Span>) -> Diagnostic {
    match why {
        Misfit::TooFewAxes(machine) => too_few_axes(word, machine),
        Misfit::NotAlone => not_alone(word, second.unwrap_or(part)),
        Misfit::StatedBody(body) => stated_body(word, body),
        Misfit::NotCovered => not_covered(word, part),
        Misfit::Asked(diagnostic) => *diagnostic,
    }
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

fn nothing_to_follow(follow: Spanned<Family>, part: Span) -> Diagnostic {
    let word = follow.node.word();
    Diagnostic::new(
        Code::CannotFollow,
        format!("`follow = {word}` has nothing to follow"),
        follow.span,
        "cuts rise and fall with a part that changes along y",
    )
    .and(part, "this part is the same at every y")
    .help("delete `follow`, or describe the part by a `surface`")
    .fix("cut level: `straight`", follow.span, Family::Straight.word())
}

fn not_alone(follow: Spanned<Family>, second: Span) -> Diagnostic {
    Diagnostic::new(
        Code::CannotFollow,
        match follow.node {
            Family::Fan => "cuts that follow a fan have their job to themselves",
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
const fn its_own(follow: Spanned<Family>) -> &'static str {
    match follow.node {
        Family::Fan => "the slope of each of these cuts is its own",
        _ => "the way of each of these cuts is its own",
    }
}

fn stated_body(follow: Spanned<Family>, blade: Span) -> Diagnostic {
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
    .fix("follow a spine: `spine`", follow.span, Family::Spine.word())
}

fn not_covered(follow: Spanned<Family>, part: Span) -> Diagnostic {
    Diagnostic::new(
        Code::CannotFollow,
        match follow.node {
            Family::Fan => "no straight lines cover this part",
            _ => "no curves that a blade can follow cover this part",
        },
        follow.span,
        match follow.node {
            Family::Fan => "every cut follows the straight line that covers the part in its place",
            _ => "every cut follows the curve that covers the part in its place",
        },
    )
    .and(
        part,
        match follow.node {
            Family::Fan => "this surface has a gap along y",
            _ => "this surface is steeper than 45 degrees along y",
        },
    )
    .help(match follow.node {
        Family::Fan => "close the gap, or use `follow = straight`",
        _ => "use `follow = straight`",
    })
    .fix("cut level: `straight`", follow.span, Family::Straight.word())
}

fn too_few_axes(follow: Spanned<Family>, machine: &Machine) -> Diagnostic {
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
    .fix("cut level: `straight`", follow.span, Family::Straight.word())
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
