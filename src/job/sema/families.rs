//! The families of ways in which all cuts of a job may follow its part: what each asks of part, machine and operations, and the job with
//! its cuts made so.

use super::part::Part;
use crate::follow::{Family, Guide};
use crate::{BladeRef, CheckedJob, Machine, Operation};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::Span;
use vcutc_surface::columns::Each;
use vcutc_surface::spine::Rising;
use vcutc_surface::surface::Surface;

/// How much more counts as hardly more than what stays otherwise: so many times as much, or so much more, in mm.
const HARDLY_MORE: (f64, f64) = (1.1, 0.25);

/// As much as hardly counts as more than that, in mm.
#[must_use]
pub fn hardly_more(than: f64) -> f64 {
    let (times, more) = HARDLY_MORE;
    (times * than).max(than + more)
}

/// A family that a job may be cut in, where it leaves that open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    pub family: Family,
    /// How high material stays on the part at most where cuts are infinitely close, in mm, as a grid of heights shows it.
    pub expected: f64,
}

/// An operation in all ways that the job leaves open for it.
pub(super) type EachWay<'a> = Vec<&'a mut Box<dyn Operation>>;

/// What cuts are made from.
#[derive(Clone, Copy)]
pub(super) struct Work<'a> {
    pub(super) part: &'a Part,
    pub(super) stock: Stock,
    pub(super) machine: Option<&'a Machine>,
}

/// Why cuts cannot follow a part so.
pub(super) enum Misfit<'a> {
    /// The machine cannot hold the plane of the blade.
    TooFewAxes(&'a Machine),
    /// There is another operation.
    NotAlone,
    /// The body of a blade is stated here.
    StatedBody(Span),
    /// No such ways cover the part.
    NotCovered,
    /// An operation asks for what does not go with it.
    Asked(Box<Diagnostic>),
}

/// Makes the cuts of all operations follow the part so, and gives the part as they see it.
pub(super) fn follow<'a>(
    work: Work<'a>,
    family: Family,
    operations: &mut [EachWay<'_>],
) -> Result<Part, Misfit<'a>> {
    for operation in operations.iter_mut().flatten() {
        **operation = operation.following(family).map_err(Misfit::Asked)?;
    }
    match family {
        Family::Straight => Ok(work.part.clone()),
        Family::Pitched => alike(work, Rising::Evenly, operations),
        Family::Spine => alike(work, Rising::Freely, operations),
        Family::Fan => own(work, Each::Straight, operations),
        Family::Columns => own(work, Each::Curved, operations),
    }
}

/// The part with all cuts along one spine.
fn alike<'a>(work: Work<'a>, rising: Rising, operations: &mut [EachWay<'_>]) -> Result<Part, Misfit<'a>> {
    // Where nothing is better than level cuts, these are taken.
    if work.part.fitted(rising).is_none() {
        return Ok(work.part.clone());
    }
    turns_planes(work)?;
    // A surface that covers the stock does so with its spine taken off.
    let Some(part) = work.part.along(rising, work.stock) else {
        return Ok(work.part.clone());
    };
    if let Some(guide) = part.guide() {
        let longest: Vec<Option<Length>> = operations.iter().map(|each| longest_edge(each)).collect();
        for (number, each) in operations.iter_mut().enumerate() {
            let others = longest.iter().enumerate().filter(|(other, _)| *other != number);
            let others = others.filter_map(|(_, edge)| *edge).reduce(Length::max);
            for operation in each.iter_mut() {
                operation.go_along(guide, others);
            }
        }
    }
    Ok(part)
}

/// The part with every cut along the way of its place.
fn own<'a>(work: Work<'a>, each: Each, operations: &mut [EachWay<'_>]) -> Result<Part, Misfit<'a>> {
    may_differ(work, operations)?;
    let part = work.part.along_columns(each, work.stock);
    let part = part.ok_or(Misfit::NotCovered)?;
    if part.guide().map_or(0.0, Guide::steepest) == 0.0 {
        return Ok(work.part.clone());
    }
    if let Some(guide) = part.guide() {
        for operation in operations.iter_mut().flatten() {
            operation.go_along(guide, None);
        }
    }
    Ok(part)
}

fn turns_planes(work: Work<'_>) -> Result<(), Misfit<'_>> {
    match work.machine {
        Some(machine) if !machine.turns_planes() => Err(Misfit::TooFewAxes(machine)),
        Some(_) | None => Ok(()),
    }
}

/// That cuts may have ways of their own.
fn may_differ<'a>(work: Work<'a>, operations: &[EachWay<'_>]) -> Result<(), Misfit<'a>> {
    turns_planes(work)?;
    if operations.len() > 1 {
        return Err(Misfit::NotAlone);
    }
    match stated_body(operations) {
        Some(body) => Err(Misfit::StatedBody(body)),
        None => Ok(()),
    }
}

/// Where the body of a blade is stated.
fn stated_body(operations: &[EachWay<'_>]) -> Option<Span> {
    let blades = operations
        .iter()
        .flatten()
        .flat_map(|operation| operation.blades());
    blades.filter_map(BladeRef::body).map(|body| body.span).next()
}

/// The longest edge of the straight blades of an operation, if it has some.
fn longest_edge(each: &EachWay<'_>) -> Option<Length> {
    let blades = each.iter().flat_map(|operation| operation.blades());
    blades.filter_map(BladeRef::edge).reduce(Length::max)
}

/// The families that may be taken, in the order in which they are tried: first those that are expected to leave hardly more than the
/// best, the simplest first, then the others by what they are expected to leave.
pub(super) fn candidates(work: Work<'_>, surface: &Surface, operations: &[EachWay<'_>]) -> Vec<Candidate> {
    let goes_with = |family: Family| {
        let mut all = operations.iter().flatten();
        all.all(|operation| operation.following(family).is_ok())
    };
    let families = Family::WORDS.iter().map(|(_, family)| *family);
    let mut found: Vec<Candidate> = families
        .filter(|family| goes_with(*family))
        .filter_map(|family| {
            let expected = expected(work, surface, family, operations)?;
            Some(Candidate { family, expected })
        })
        .collect();
    let least = found.iter().map(|one| one.expected).fold(f64::INFINITY, f64::min);
    let enough = hardly_more(least);
    // The sort keeps the order of the families among equals.
    let rank = |one: &Candidate| {
        if one.expected <= enough {
            least
        } else {
            one.expected
        }
    };
    found.sort_by(|one, other| rank(one).total_cmp(&rank(other)));
    found
}

/// What a family is expected to leave; none where its cuts would be level ones, or cannot be.
fn expected(work: Work<'_>, surface: &Surface, family: Family, operations: &[EachWay<'_>]) -> Option<f64> {
    let alike = |rising| {
        turns_planes(work).ok()?;
        Some(work.part.fitted(rising)?.leaves)
    };
    let own = |each| {
        may_differ(work, operations).ok()?;
        let covered = work.part.covered(each)?;
        (covered.columns.steepest() > 0.0).then_some(covered.leaves)
    };
    match family {
        Family::Straight => Some(surface.left_by_straight_cuts()),
        Family::Pitched => alike(Rising::Evenly),
        Family::Spine => alike(Rising::Freely),
        Family::Fan => own(Each::Straight),
        Family::Columns => own(Each::Curved),
    }
}

impl CheckedJob {
    /// The same job with its cuts made to follow its part so; none where they cannot.
    #[must_use]
    pub fn following(&self, family: Family) -> Option<Self> {
        let mut job = self.clone();
        job.families.clear();
        let mut operations: Vec<EachWay<'_>> = job.operations.iter_mut().map(|one| vec![one]).collect();
        for choice in &mut job.open {
            let ways = choice.ways.iter_mut().map(|way| &mut way.operation);
            operations.get_mut(choice.operation)?.extend(ways);
        }
        let work = Work {
            part: &self.part,
            stock: self.stock,
            machine: self.machine.as_ref(),
        };
        let part = follow(work, family, &mut operations).ok()?;
        job.part = part;
        Some(job)
    }

    /// The same job with it left open how its cuts follow the part, and what to write where for that; none where its cuts are not level,
    /// or only one family may be taken.
    #[must_use]
    pub fn following_best(&self) -> Option<(Self, Vec<(Span, String)>)> {
        let surface = self.part.surface().filter(|_| self.part.guide().is_none())?;
        if !(self.families.is_empty() && self.open.is_empty()) {
            return None;
        }
        let mut job = self.clone();
        let mut edits = Vec::new();
        for operation in &mut job.operations {
            if let Some(variant) = operation.following_best() {
                *operation = variant.operation;
                edits.extend(variant.edits);
            } else if operation.follows().is_some() {
                return None;
            }
        }
        let work = Work {
            part: &self.part,
            stock: self.stock,
            machine: self.machine.as_ref(),
        };
        let operations: Vec<EachWay<'_>> = job.operations.iter_mut().map(|one| vec![one]).collect();
        let families = candidates(work, surface, &operations);
        job.families = families;
        (job.families.len() > 1 && !edits.is_empty()).then_some((job, edits))
    }
}
