//! The proof of slits along the walls of regions, from the lines and arcs of a finished program.
//!
//! Nothing of it comes from the plan but the region and what the operation is held to ([`Slitting`]). The walls and the plane of
//! the blade are upright, so what the blade passes is seen from above, where it is widest: at the top of the walls.

mod stated;

use crate::clearing::sides;
use core::num::NonZeroU32;
use stated::{Motion, Stated, stated};
use vcutc_backend_api::ir::{Blade, OperationId, Program, Straight};
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_job::{PlannedJob, Slitting};
use vcutc_region::clearance::clearance;
use vcutc_region::distance::Walls;
use vcutc_region::foot::{Left, Sides, foot};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::plate::{Reach, Stroke};
use vcutc_region::region::Side;
use vcutc_simulation::prove::{CutFault, Finding, Findings, Slit, SlitFault};
use vcutc_simulation::surface::Surface;

/// How far a number of a program may be beyond its limit by rounding, in mm.
const ROUNDING: f64 = 1e-6;

/// Judges the slits along walls of a program, in what its other cuts leave: adds what is wrong, and says what they do.
#[must_use]
pub fn judged(
    plan: &PlannedJob,
    before: &mut Surface,
    program: &Program,
    findings: &mut Findings,
) -> Vec<Slit> {
    let numbered = (0..).map(OperationId).zip(&plan.operations);
    let held = numbered.filter_map(|(operation, planned)| Some((operation, planned.slitting()?)));
    let judged = held.filter_map(|(operation, held)| {
        let first = program
            .segments()
            .find(|segment| segment.op.site.operation() == Some(operation))?;
        let tool = program
            .operation(operation)?
            .tools
            .first()
            .copied()
            .unwrap_or(first.before.tool);
        let blade = program.blade(tool)?;
        let straight = blade.straight()?;
        let judge = Judge {
            operation,
            held: &held,
            program,
            blade,
            straight,
            walls: Walls::of(&held.region),
            findings,
        };
        Some(judge.all(before))
    });
    judged.collect()
}

/// Slits along the walls of a region for pictures: the ways of the tip, slit by slit, with the walls.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    pub walls: Vec<Piece>,
    pub ways: Vec<Vec<Piece>>,
}

/// The slits along walls of a program, operation by operation.
#[must_use]
pub fn shown(plan: &PlannedJob, program: &Program) -> Vec<Shown> {
    let numbered = (0..).map(OperationId).zip(&plan.operations);
    let shown = numbered.filter_map(|(operation, planned)| {
        let held = planned.slitting()?;
        let tool = program.operation(operation)?.tools.first().copied()?;
        let blade = program.blade(tool)?.straight()?;
        let top = program.stock.height.to_mm();
        let mut ways: Vec<Vec<Piece>> = Vec::new();
        let mut last = None;
        for stated in stated(program, operation, blade, top) {
            let Motion::Along(stroke) = stated.motion else {
                continue;
            };
            let cut = (stated.layer, stated.cut);
            match ways.last_mut() {
                Some(way) if last == Some(cut) => way.push(stroke.way),
                _ => ways.push(vec![stroke.way]),
            }
            last = Some(cut);
        }
        let walls = held.region.edges().filter(|edge| edge.side == Side::Wall);
        Some(Shown {
            walls: walls.map(|edge| edge.piece).collect(),
            ways,
        })
    });
    shown.collect()
}

struct Judge<'j> {
    operation: OperationId,
    held: &'j Slitting,
    program: &'j Program,
    blade: &'j Blade,
    straight: Straight,
    walls: Walls,
    findings: &'j mut Findings,
}

impl Judge<'_> {
    fn all(mut self, before: &mut Surface) -> Slit {
        let bounds = self.held.region.bounds();
        let beside = self.beside();
        let top = before.highest(bounds.low.x - beside, bounds.high.x + beside);
        let moves = stated(self.program, self.operation, self.straight, top);
        let mut done = Slit {
            operation: self.operation,
            slits: 0,
            way: Length::ZERO,
            to_wall: Length::mm(f64::INFINITY),
            stays: Length::ZERO,
            in_corners: Length::ZERO,
            edge: Length::ZERO,
        };
        let sides = Walls::of_pieces(
            sides::closed(&self.held.region, self.program.stock)
                .into_iter()
                .enumerate(),
        );
        let mut ways: Vec<Pass> = Vec::new();
        let mut all: Vec<(&Stated, Piece)> = Vec::new();
        let mut last: Option<(NonZeroU32, NonZeroU32)> = None;
        for stated in &moves {
            self.heights(stated, top);
            done.edge = done.edge.max(Length::mm(stated.edge));
            let Some(near) = self.clear(stated, &sides) else {
                continue;
            };
            done.to_wall = done.to_wall.min(Length::mm(near));
            let stroke = match &stated.motion {
                Motion::Along(stroke) => *stroke,
                Motion::Down(stroke) => standing(*stroke),
                Motion::Above | Motion::Otherwise => continue,
            };
            all.push((stated, stroke.way));
            if !matches!(stated.motion, Motion::Along(_)) {
                continue;
            }
            if stated.floor > self.held.floor.to_mm() + ROUNDING {
                continue;
            }
            done.way += Length::mm(stroke.way.length());
            let cut = (stated.layer, stated.cut);
            match ways.last_mut() {
                Some(pass) if last == Some(cut) => pass.pieces.push(stroke.way),
                _ => ways.push(Pass {
                    level: 0,
                    pieces: vec![stroke.way],
                }),
            }
            last = Some(cut);
        }
        done.slits = ways.len();
        self.astray(&all);
        self.foot(&ways, &moves, &mut done);
        done
    }

    /// How far beside its tip the blade reaches at most.
    fn beside(&self) -> f64 {
        let bodies = self.blade.body.iter().flatten().map(|stage| stage.radius.to_mm());
        bodies.fold(self.straight.cutting_length.to_mm(), f64::max)
    }

    fn note(&mut self, stated: &Stated, at: Place, fault: SlitFault) {
        self.findings.note_of_region(Finding {
            operation: self.operation,
            layer: stated.layer,
            kind: self.program.cut_kind(self.operation, stated.tool),
            cut: stated.cut,
            tip: Point2::new(at.x, stated.floor),
            y: Some(at.y),
            fault: CutFault::Slit(fault),
        });
    }

    /// Floor, edge and body.
    fn heights(&mut self, stated: &Stated, top: f64) {
        let at = stated.at;
        let below = self.held.floor.to_mm() - stated.floor;
        if below > ROUNDING {
            self.note(
                stated,
                at,
                SlitFault::Floor {
                    by: Length::mm(below),
                },
            );
        }
        let available = self.straight.cutting_length;
        if stated.edge > available.to_mm() + ROUNDING {
            let needed = Length::mm(stated.edge);
            self.note(stated, at, SlitFault::Edge { needed, available });
        }
        let upright = stated.least_upright;
        let leaning = libm::sqrt((1.0 - upright * upright).max(0.0));
        let lowest = self.blade.body.iter().flatten().map(|stage| {
            let over_tip = stage.from.to_mm() * upright - stage.radius.to_mm() * leaning;
            (top - stated.floor - over_tip, stage.from)
        });
        if let Some((by, above)) = lowest.max_by(|(one, _), (other, _)| one.total_cmp(other))
            && by > ROUNDING
        {
            self.note(
                stated,
                at,
                SlitFault::Body {
                    above,
                    by: Length::mm(by),
                },
            );
        }
    }

    /// How near the sides of the blade come to walls on a move; none where nothing of it is in the work.
    fn clear(&mut self, stated: &Stated, sides: &Walls) -> Option<f64> {
        let (outline, stroke) = match &stated.motion {
            Motion::Above => return None,
            Motion::Otherwise => {
                self.note(stated, stated.at, SlitFault::Strays);
                return None;
            }
            Motion::Along(stroke) => (stroke.outline(), *stroke),
            Motion::Down(stroke) => (stroke.stand(0.0).to_vec(), standing(*stroke)),
        };
        if let Some(at) = self.passed_whole(&stroke) {
            let by = Length::mm(2.0 * stroke.half);
            self.note(stated, at, SlitFault::Wall { by });
        }
        self.beside_stock(stated, &stroke, sides);
        let near = outline.into_iter().filter_map(|side| self.walls.nearest_to(side));
        let near = near.min_by(|(_, one), (_, other)| one.distance.total_cmp(&other.distance));
        let Some((at, near)) = near else {
            return Some(f64::INFINITY);
        };
        let free = near.distance - stated.slack - self.program.blend.to_mm();
        let by = self.held.allowance.to_mm() - free;
        // Where sides of a blade cross a wall, that is nearest at 0, however deep they are.
        let by = if near.distance == 0.0 {
            by + 2.0 * stroke.half
        } else {
            by
        };
        if by > ROUNDING {
            self.note(stated, at, SlitFault::Wall { by: Length::mm(by) });
        }
        Some(free)
    }

    /// A place of a wall that the blade passes without crossing its own outline.
    fn passed_whole(&self, stroke: &Stroke) -> Option<Place> {
        let middle = stroke.way.at(0.5);
        let far = stroke
            .outline()
            .iter()
            .map(|side| side.from.distance(middle))
            .fold(0.0, f64::max);
        let mut found = None;
        self.walls.around(middle, far + stroke.way.length(), &mut |wall| {
            if let Some(curve) = self.walls.curve(wall)
                && found.is_none()
                && stroke.passes(curve.piece.from)
            {
                found = Some(curve.piece.from);
            }
        });
        found
    }

    /// From beside the stock the blade enters it by open sides only.
    fn beside_stock(&mut self, stated: &Stated, stroke: &Stroke, sides: &Walls) {
        let ends = [stroke.way.from, stroke.way.to];
        if ends.iter().all(|end| self.is_over_the_stock(*end)) {
            return;
        }
        if let Some((at, near)) = stroke.nearest_to(sides)
            && near.distance <= ROUNDING
        {
            let by = Length::mm(2.0 * stroke.half);
            self.note(stated, at, SlitFault::Wall { by });
        }
    }

    fn is_over_the_stock(&self, at: Place) -> bool {
        let stock = self.program.stock;
        let within = |at: f64, length: Length| at > ROUNDING && at < length.to_mm() - ROUNDING;
        within(at.x, stock.width) && within(at.y, stock.depth)
    }

    /// Ways of the blade over the stock without a place in the region: what crosses no wall is not in it as a whole.
    fn astray(&mut self, all: &[(&Stated, Piece)]) {
        let passes: Vec<Pass> = all
            .iter()
            .map(|(_, way)| Pass {
                level: 0,
                pieces: vec![*way],
            })
            .collect();
        let astray = clearance(&self.held.region, &passes).astray;
        let over = astray.into_iter().filter_map(|pass| all.get(pass));
        let Some(&(stated, way)) = over
            .into_iter()
            .find(|(_, way)| self.is_over_the_stock(way.at(0.5)))
        else {
            return;
        };
        let by = self.straight.thickness;
        self.note(stated, way.at(0.5), SlitFault::Wall { by });
    }

    fn foot(&mut self, ways: &[Pass], moves: &[Stated], done: &mut Slit) {
        let Some(first) = moves.first() else { return };
        let pieces: Vec<Piece> = ways.iter().flat_map(|pass| pass.pieces.iter().copied()).collect();
        let thickness = self.straight.thickness.to_mm();
        let allowance = self.held.allowance.to_mm();
        let blade = Sides { thickness, allowance };
        let Ok(found) = foot(&self.held.region, &pieces, blade) else {
            self.note(first, first.at, SlitFault::Undecided);
            return;
        };
        let beyond = |left: Option<Left>, kept: f64| {
            let far = left.map_or(0.0, |left| left.distance);
            Length::mm((far - thickness / 2.0 - kept).max(0.0))
        };
        done.stays = beyond(found.walls, allowance);
        done.in_corners = beyond(found.corners, 0.0);
        let limit = self.held.residual;
        if done.stays > limit
            && let Some(left) = found.walls
        {
            let by = done.stays;
            self.note(first, left.at, SlitFault::Stays { by, limit });
        }
    }
}

/// A blade that goes straight down, as a way along which it goes no farther than it reaches.
fn standing(stroke: Stroke) -> Stroke {
    let [reach, _] = stroke.reaches;
    let ahead = stroke.way.direction(0.0);
    let [from, to] = [-reach.behind, reach.ahead].map(|along| stroke.way.from.plus(ahead.times(along)));
    let long = reach.behind + reach.ahead;
    let way = if long > LEAST {
        Piece::line(from, to)
    } else {
        stroke.way.part(0.0, LEAST)
    };
    let none = Reach {
        behind: 0.0,
        ahead: 0.0,
    };
    Stroke {
        way,
        reaches: [none; 2],
        half: stroke.half,
    }
}

/// The shortest way that has a direction, in mm.
const LEAST: f64 = 1e-6;
