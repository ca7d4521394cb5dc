//! Tips that the job gives: cut as they stand, in the order in which they are written.
//!
//! Nothing is moved and nothing left out but tips that have no material above them when their turn comes. Tips that follow
//! one another at one height and in one direction are a layer, so that layers are cut from side to side as elsewhere. A tip
//! whose V would enter the part is refused here, where its place in the job is known; whether chips come free is for the
//! proof.

use super::avoid::Swings;
use super::chip::way;
use super::lattice::Layout;
use super::parameters::VcutParameters;
use super::route::Heading;
use super::{MOST_CUTS, PlannedCut, TipOrigin, Way};
use crate::asked::{Tip, Tips};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_job::CheckedJob;
use vcutc_simulation::surface::{Surface, Vee};

/// What is cut of given tips, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Which way each layer goes.
    pub headings: Vec<Heading>,
    /// Tips that have no material above them when their turn comes.
    pub idle: Vec<Tip>,
}

/// The cuts of given tips, layer by layer, each layer from left to right.
pub(super) fn cuts(
    tips: &Tips,
    parameters: &VcutParameters,
    surface: &mut Surface,
) -> (Vec<PlannedCut>, Course) {
    let mut planner = Planner {
        parameters,
        surface,
        cuts: Vec::with_capacity(tips.tips.len()),
        course: Course {
            headings: Vec::new(),
            idle: Vec::new(),
        },
    };
    let on_grid: Vec<Tip> = tips.tips.iter().map(to_grid).collect();
    let mut rest = on_grid.as_slice();
    while let Some((row, heading)) = first_row(rest) {
        planner.row(row, heading);
        rest = rest.get(row.len()..).unwrap_or_default();
    }
    (planner.cuts, planner.course)
}

fn to_grid(tip: &Tip) -> Tip {
    Tip {
        point: Point2 {
            x: grid::nearest(tip.point.x),
            z: grid::nearest(tip.point.z),
        },
        ..*tip
    }
}

/// The tips in front that lie at one height and follow one another in one direction, and which way.
fn first_row(tips: &[Tip]) -> Option<(&[Tip], Heading)> {
    let first = tips.first()?;
    let heading = match tips.get(1) {
        Some(second) if second.point.x < first.point.x => Heading::Leftwards,
        Some(_) | None => Heading::Rightwards,
    };
    let goes_on = |pair: &[Tip]| match pair {
        [a, b] => {
            let onwards = match heading {
                Heading::Rightwards => b.point.x > a.point.x,
                Heading::Leftwards => b.point.x < a.point.x,
            };
            onwards && (b.point.z - a.point.z).abs() < grid::SPACING / 2.0
        }
        _ => false,
    };
    let length = 1 + tips.windows(2).take_while(|pair| goes_on(pair)).count();
    tips.get(..length).map(|row| (row, heading))
}

struct Planner<'p> {
    parameters: &'p VcutParameters,
    surface: &'p mut Surface,
    cuts: Vec<PlannedCut>,
    course: Course,
}

impl Planner<'_> {
    /// Decides a row as a whole against the surface before it, as layers of a lattice are.
    fn row(&mut self, row: &[Tip], heading: Heading) {
        let mut kept: Vec<Point2> = Vec::with_capacity(row.len());
        for tip in row {
            if self.surface.covers(tip.point) {
                kept.push(tip.point);
            } else {
                self.course.idle.push(*tip);
            }
        }
        match heading {
            Heading::Rightwards => {}
            Heading::Leftwards => kept.reverse(),
        }
        if kept.is_empty() {
            return;
        }
        self.course.headings.push(heading);
        let layer = u32::try_from(self.course.headings.len()).unwrap_or(u32::MAX);
        let mut before: Option<Point2> = None;
        for &tip in &kept {
            let way = before.map_or(Way::Over, |before| {
                way(self.parameters, self.surface, before, tip)
            });
            self.cuts.push(PlannedCut {
                layer,
                tip,
                swings: Swings::even(self.parameters.swing),
                origin: TipOrigin::Given,
                way,
            });
            before = Some(tip);
        }
        let slope = self.parameters.flanks.slope;
        for tip in kept {
            self.surface.release(Vee::even(tip, slope));
        }
    }
}

/// Tips whose V would enter the part, reported at the one that goes deepest.
pub(super) fn in_the_part(job: &CheckedJob, tips: &Tips, layout: &Layout<'_>) -> Option<Diagnostic> {
    let depth = |tip: &Tip| {
        let tip = to_grid(tip);
        layout.floor(tip.point.x) - tip.point.z
    };
    // The floor is rounded up to the grid, so a tip on the part itself may be below it by as much.
    let entering = |tip: &&Tip| depth(tip) > grid::SPACING * 1.5;
    let count = tips.tips.iter().filter(entering).count();
    let deepest = tips
        .tips
        .iter()
        .max_by(|one, other| depth(one).total_cmp(&depth(other)))
        .filter(entering)?;
    let floor = show(layout.floor(grid::nearest(deepest.point.x)));
    let diagnostic = Diagnostic::new(
        Code::TipInPart,
        format!(
            "a cut with its tip at x {} mm, z {} mm would enter the part by {} mm",
            show(deepest.point.x),
            show(deepest.point.z),
            show(depth(deepest))
        ),
        deepest.span,
        format!("at this x, tips must lie at z {floor} mm or higher"),
    )
    .and(job.profile_span, "the part");
    let diagnostic = match count {
        1 => diagnostic,
        count => diagnostic.note(format!(
            "{count} of the {} tips enter the part, this one deepest",
            tips.tips.len()
        )),
    };
    Some(
        diagnostic.help("raise or delete such tips; a smaller `swing` helps beside steep places of the part"),
    )
}

/// About how many corners of the surface are passed while the tips are cut: on the way from tip to tip, and under flanks.
pub(super) fn passed_corners(tips: &Tips, parameters: &VcutParameters) -> f64 {
    let mut columns: Vec<f64> = tips.tips.iter().map(|tip| tip.point.x).collect();
    columns.sort_by(f64::total_cmp);
    columns.dedup_by(|a, b| (*a - *b).abs() < grid::SPACING / 2.0);
    let rank = |x: f64| columns.partition_point(|&column| column < x);
    let half_width = parameters.flanks.reach.to_mm() / parameters.flanks.slope;
    let between = |from: f64, to: f64| rank(to).abs_diff(rank(from)) as f64;
    let under: f64 = tips
        .tips
        .iter()
        .map(|tip| between(tip.point.x - half_width, tip.point.x + half_width))
        .sum();
    let on_the_way: f64 = tips
        .tips
        .windows(2)
        .map(|pair| match pair {
            [a, b] => between(a.point.x, b.point.x),
            _ => 0.0,
        })
        .sum();
    under + on_the_way
}

/// More tips than are planned.
pub(super) fn too_many(tips: &Tips) -> Diagnostic {
    Diagnostic::new(
        Code::TooManyCuts,
        format!(
            "the {} tips of this operation are too many, or lie too close together to be planned",
            tips.tips.len()
        ),
        tips.span,
        format!("a program may have {MOST_CUTS} cuts"),
    )
    .help("split the job, or delete tips")
}

/// Tips none of which has material above it.
pub(super) fn nothing_to_cut(job: &CheckedJob, tips: &Tips) -> Diagnostic {
    Diagnostic::new(
        Code::NothingToCut,
        "this operation leaves nothing to cut",
        tips.span,
        "no tip has material above it",
    )
    .and(job.stock_span, "of this stock")
    .help("delete the operation, or lower its tips")
}

/// Tips that cut nothing, in one warning at the first of them.
#[must_use]
pub fn idle(course: &Course, tips: &Tips) -> Option<Diagnostic> {
    let first = course.idle.first()?;
    let (x, z) = (show(first.point.x), show(first.point.z));
    let headline = match course.idle.len() {
        1 => format!("the tip at x {x} mm, z {z} mm cuts nothing and is left out"),
        count => format!(
            "{count} of the {} tips cut nothing and are left out, the first at x {x} mm, z {z} mm",
            tips.tips.len()
        ),
    };
    Some(
        Diagnostic::new(
            Code::TipCutsNothing,
            headline,
            first.span,
            "when the program reaches it, no material is above it",
        )
        .help("delete such tips, or put them before the cuts that removed their material"),
    )
}
