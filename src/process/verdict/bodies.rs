//! A blade's body that enters the work, in the user's words, and which change keeps it out.
//!
//! At most one change of each kind is offered: for ways, the extension that the compiler chooses; a smaller swing, smaller swings only
//! where the blade does not fit, a steeper rake, a body that begins higher. Each was tried: all but the last planned and proven again, the last replayed on the same program.

use super::attempts::Attempts;
use super::changes::{with_chosen_extension, with_narrower_flanks, with_smaller_swing, with_steeper_rake};
use super::words::point;
use super::{Proven, bodies};
use vcutc_backend_api::ir::{BodyStage, Program, Site, ToolId};
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::{VerifiedProgram, verify};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::grid;
use vcutc_job::operation::{Operation, WorksThere};
use vcutc_job::{BladeRef, Body, PlannedJob};
use vcutc_simulation::body::{Contact, During};

/// How often the height that a body begins at is doubled or halved in search of one that is clear.
const MOST_HEIGHTS: usize = 16;

/// What is wrong, with what helps; so many motions take a body into the work.
pub(super) fn explained(
    plan: &PlannedJob,
    proven: &Proven,
    (count, contact): (usize, Contact),
    attempts: &mut Attempts<'_>,
    works_there: &mut WorksThere<'_>,
) -> Option<Diagnostic> {
    let planned = plan.operation(contact.passage.operation)?;
    let program = proven.program.program();
    let blade = blade_of(planned.asked(), program, contact)?;
    let diagnostic = enters(planned.asked(), blade, count, contact)?;
    // First, because replays take the least work.
    let higher = higher_body(plan, proven, (blade, contact), attempts);
    let diagnostic = match contact.during {
        // Longer cuts change nothing in them.
        During::Cut => diagnostic,
        During::Way => with_chosen_extension(diagnostic, planned.asked(), attempts, works_there),
    };
    let diagnostic = with_smaller_swing(diagnostic, planned, attempts, works_there);
    let diagnostic = with_narrower_flanks(diagnostic, planned, attempts, works_there);
    let diagnostic = with_steeper_rake(diagnostic, planned.asked(), attempts, works_there);
    Some(match higher {
        Some(higher) => higher.offered(diagnostic, attempts),
        None if diagnostic.fixes.is_empty() && diagnostic.help.is_empty() => {
            diagnostic.help("use a blade with a longer or thinner shank")
        }
        None => diagnostic,
    })
}

/// The blade of an operation whose body enters the work.
fn blade_of<'a>(asked: &'a dyn Operation, program: &Program, contact: Contact) -> Option<BladeRef<'a>> {
    let name = &program.blade(contact.passage.tool)?.name;
    asked.blades().into_iter().find(|blade| blade.name() == name)
}

fn enters(asked: &dyn Operation, blade: BladeRef<'_>, count: usize, contact: Contact) -> Option<Diagnostic> {
    let setup = asked.setup();
    let body = blade.body()?;
    let stage = body.stages.get(contact.passage.stage)?;
    let place = stage.radius.span.unwrap_or(body.span);
    let diagnostic = Diagnostic::new(
        Code::BodyInWork,
        headline(blade.name(), contact),
        stage.from.span.map_or(place, |from| from.to(place)),
        format!("this stage goes deepest at {}", point(contact.passage.at)),
    )
    .and(setup.head_span, "this operation holds the blade like that");
    let diagnostic = match contact.in_part {
        Some(depth) => diagnostic.note(format!(
            "there it enters the part or its allowance by {} mm",
            show(depth.to_mm())
        )),
        None => diagnostic,
    };
    Some(match count {
        0 | 1 => diagnostic,
        2 => diagnostic.note("one more motion takes the body into the stock"),
        _ => diagnostic.note(format!("{} more motions take the body into the stock", count - 1)),
    })
}

/// `the body of `dagger` enters the stock by 3.2 mm in layer 7, cut 12`.
#[must_use]
pub fn headline(blade: &str, contact: Contact) -> String {
    let depth = show(-contact.passage.clearance.to_mm());
    let kind = contact.passage.kind.noun();
    let place = match (contact.during, contact.passage.site) {
        (During::Cut, Site::Cut { layer, cut, .. }) => format!("in layer {layer}, {kind} {cut}"),
        (During::Way, Site::Cut { layer, cut, .. }) => format!("on the way to layer {layer}, {kind} {cut}"),
        (_, Site::Layer { layer, .. }) => format!("on the way to or from layer {layer}"),
        (_, Site::Program | Site::Operation(_)) => "on the way to or from the work".to_owned(),
    };
    format!("the body of `{blade}` enters the stock by {depth} mm {place}")
}

/// A body that is clear of the work, being the same but higher.
struct Higher {
    advice: String,
    /// None where a height has no place in a text.
    edits: Option<Vec<(Span, String)>>,
}

impl Higher {
    /// As a change that others try once more; as mere advice where nothing is tried any more.
    fn offered(self, diagnostic: Diagnostic, attempts: &Attempts<'_>) -> Diagnostic {
        match self.edits {
            Some(edits) if attempts.are_wanted() => diagnostic.fix_all(self.advice, &edits),
            Some(_) | None => diagnostic.help(self.advice),
        }
    }
}

/// The body with the least height that was found to be clear of the work.
fn higher_body(
    plan: &PlannedJob,
    proven: &Proven,
    (blade, contact): (BladeRef<'_>, Contact),
    attempts: &mut Attempts<'_>,
) -> Option<Higher> {
    let body = blade.body()?;
    let program = proven.program.program();
    let tool = contact.passage.tool;
    let mut is_clear = |stages: &[BodyStage]| {
        attempts.spend(plan.cuts())
            && with_body(program, tool, stages)
                .is_some_and(|program| bodies(plan, &program).contact.is_none())
    };
    let stages = least_clear(body, Length::ZERO - contact.passage.clearance, &mut is_clear)?;
    let text = |height: Length| format!("{} mm", show(height.to_mm()));
    let heights: Vec<String> = stages.iter().map(|stage| text(stage.from)).collect();
    let advice = match heights.as_slice() {
        [only] => format!("use a longer blade, whose body begins at {only}"),
        [first @ .., last] => format!(
            "use a longer blade, whose stages begin at {} and {last}",
            first.join(", ")
        ),
        [] => "use a longer blade".to_owned(),
    };
    let given = body.stages.iter().zip(heights);
    let edits = given.map(|(stage, height)| Some((stage.from.span?, height)));
    Some(Higher {
        advice,
        edits: edits.collect(),
    })
}

/// The stages of a body moved up the axis until they are clear: to a tenth of a millimetre or so, as they are written.
fn least_clear(
    body: &Body,
    depth: Length,
    is_clear: &mut dyn FnMut(&[BodyStage]) -> bool,
) -> Option<Vec<BodyStage>> {
    let (mut too_low, mut raise, mut found) = (Length::ZERO, depth.max(LEAST_RAISE), None);
    for _ in 0..MOST_HEIGHTS {
        let stages = raised(body, raise);
        let next = if is_clear(&stages) {
            found = Some((raise, stages));
            (too_low + raise) / 2.0
        } else {
            too_low = raise;
            match &found {
                Some((clear, _)) => (raise + *clear) / 2.0,
                None => raise * 2.0,
            }
        };
        let is_near = |(clear, _): &(Length, Vec<BodyStage>)| *clear - too_low <= NEAR_ENOUGH;
        if found.as_ref().is_some_and(is_near) {
            break;
        }
        raise = next;
    }
    found.map(|(_, stages)| stages)
}

/// By how much a body is raised at first, at least.
const LEAST_RAISE: Length = Length::mm(1.0);

/// A gap between heights that is no wider than this is not halved.
const NEAR_ENOUGH: Length = Length::mm(0.1);

/// A body moved up the axis, its heights rounded up to a tenth of a millimetre.
fn raised(body: &Body, by: Length) -> Vec<BodyStage> {
    let stages = body.stages.iter();
    stages
        .map(|stage| BodyStage {
            from: Length::mm(grid::up((stage.from.value + by).to_mm() * 0.01) * 100.0),
            radius: stage.radius.value,
        })
        .collect()
}

/// A program with another body on one of its blades.
fn with_body(program: &Program, tool: ToolId, stages: &[BodyStage]) -> Option<VerifiedProgram> {
    let mut changed = program.clone();
    changed.blades.get_mut(usize::from(tool.0))?.body = Some(stages.to_vec());
    verify(changed).ok()
}
