//! The proof of slits along the walls of regions, from the lines and arcs of a finished program.
//!
//! It uses the region and the limits that the job asks for, nothing that the planner chose. The walls and the plane of the blade are
//! upright, so what the blade passes is seen from above, where it is widest: at the top of the walls.

use super::stated::{Motion, Stated, stated};
use crate::from_above::{closed_sides, highest, is_over};
use core::num::NonZeroU32;
use vcutc_backend_api::ir::{Blade, OperationId, Program, Straight, ToolId};
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_region::boxes::Dense;
use vcutc_region::clearance::clearance;
use vcutc_region::distance::Walls;
use vcutc_region::foot::{Foot, Left, Sides, foot};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::plate::Stroke;
use vcutc_region::region::Region;
use vcutc_simulation::prove::{CutFault, Finding, Findings, Slit, SlitFault};
use vcutc_simulation::surface::Surface;

/// How far a number of a program may be beyond its limit by rounding, in mm.
const ROUNDING: f64 = 1e-6;

/// What slits are held to.
#[derive(Clone, Copy, Debug)]
pub struct Held<'a> {
    pub region: &'a Region,
    /// The height of the floor.
    pub floor: Length,
    /// How far the sides of the blade keep from walls.
    pub allowance: Length,
    /// How much may stay at the foot of walls.
    pub residual: Length,
}

/// A straight blade of an operation of a program.
#[derive(Clone, Copy, Debug)]
pub struct OfBlade<'p> {
    pub program: &'p Program,
    pub operation: OperationId,
    pub tool: ToolId,
}

/// Judges the slits of a blade, in what the other cuts of its program leave: adds what is wrong, and returns what they do; none of a blade
/// that is not straight.
pub fn judge(held: Held<'_>, of: OfBlade<'_>, findings: &mut Findings, before: &mut Surface) -> Option<Slit> {
    let blade = of.program.blade(of.tool)?;
    let judge = Judge {
        operation: of.operation,
        asked: held,
        program: of.program,
        tool: of.tool,
        blade,
        straight: blade.straight()?,
        walls: Walls::of(held.region),
        findings,
    };
    Some(judge.all(before))
}

/// The ways along walls among some moves, slit by slit.
pub fn ways<'s>(moves: impl Iterator<Item = &'s Stated>) -> Vec<Vec<Piece>> {
    let mut ways: Vec<Vec<Piece>> = Vec::new();
    let mut last = None;
    for stated in moves {
        let Motion::Along(stroke) = &stated.motion else {
            continue;
        };
        let slit = (stated.layer, stated.cut);
        match ways.last_mut() {
            Some(way) if last == Some(slit) => way.push(stroke.way),
            _ => ways.push(vec![stroke.way]),
        }
        last = Some(slit);
    }
    ways
}

struct Judge<'j> {
    operation: OperationId,
    asked: Held<'j>,
    program: &'j Program,
    tool: ToolId,
    blade: &'j Blade,
    straight: Straight,
    walls: Walls,
    findings: &'j mut Findings,
}

impl Judge<'_> {
    fn all(mut self, before: &mut Surface) -> Slit {
        let top = highest(before, self.asked.region, self.beside());
        let moves = stated(self.program, (self.operation, self.tool), self.straight, top);
        let sides = closed_sides(self.asked.region, self.program.stock);
        let mut to_wall = f64::INFINITY;
        for stated in &moves {
            self.heights(stated, top);
            to_wall = to_wall.min(self.clear(stated, &sides));
        }
        self.astray(&moves);
        let floor = self.asked.floor.to_mm() + ROUNDING;
        let all = ways(moves.iter());
        // What stays at the foot of walls is up to the deepest ones.
        let deepest = ways(moves.iter().filter(|stated| stated.floor <= floor));
        let pieces: Vec<Piece> = deepest.into_iter().flatten().collect();
        let edge = moves.iter().map(|stated| stated.edge).fold(0.0, f64::max);
        let [stays, in_corners] = self.foot(&pieces);
        Slit {
            operation: self.operation,
            slits: all.len(),
            way: Length::mm(all.iter().flatten().map(|piece| piece.length()).sum()),
            to_wall: Length::mm(to_wall),
            stays,
            in_corners,
            edge: Length::mm(edge),
        }
    }

    /// How far beside its tip the blade reaches at most.
    fn beside(&self) -> f64 {
        let bodies = self.blade.body.iter().flatten().map(|stage| stage.radius.to_mm());
        bodies.fold(self.straight.cutting_length.to_mm(), f64::max)
    }

    fn note(&mut self, stated: &Stated, at: Place, fault: SlitFault) {
        let tip = Point2::new(at.x, stated.floor);
        self.note_of_cut((stated.layer, stated.cut), tip, at.y, fault);
    }

    fn note_of_cut(&mut self, (layer, cut): (NonZeroU32, NonZeroU32), tip: Point2, y: f64, fault: SlitFault) {
        self.findings.note_of_region(Finding {
            operation: self.operation,
            layer,
            kind: self.program.cut_kind(self.operation, self.tool),
            cut,
            tip,
            y: Some(y),
            fault: CutFault::Slit(fault),
        });
    }

    /// Floor, edge and body.
    fn heights(&mut self, stated: &Stated, top: f64) {
        let at = stated.at;
        let below = self.asked.floor.to_mm() - stated.floor;
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

    /// How near the sides of the blade come to walls on a move, in mm; endless where nothing of it is in the work.
    fn clear(&mut self, stated: &Stated, sides: &Walls) -> f64 {
        let stroke = match stated.motion {
            Motion::Along(stroke) | Motion::Down(stroke) => stroke,
            Motion::Above => return f64::INFINITY,
            Motion::Otherwise => {
                self.note(stated, stated.at, SlitFault::Strays);
                return f64::INFINITY;
            }
        };
        if let Some(at) = self.passed_whole(&stroke) {
            let by = Length::mm(2.0 * stroke.half);
            self.note(stated, at, SlitFault::Wall { by });
        }
        self.beside_stock(stated, &stroke, sides);
        let Some((at, near)) = stroke.nearest_to(&self.walls) else {
            return f64::INFINITY;
        };
        let free = near.distance - stated.slack - self.program.blend.to_mm();
        let by = self.asked.allowance.to_mm() - free;
        // Where sides of a blade cross a wall, that is nearest at 0, however deep they are.
        let by = if near.distance == 0.0 {
            by + 2.0 * stroke.half
        } else {
            by
        };
        if by > ROUNDING {
            self.note(stated, at, SlitFault::Wall { by: Length::mm(by) });
        }
        free
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
        if ends.iter().all(|end| is_over(self.program.stock, *end)) {
            return;
        }
        if let Some((at, near)) = stroke.nearest_to(sides)
            && near.distance <= ROUNDING
        {
            let by = Length::mm(2.0 * stroke.half);
            self.note(stated, at, SlitFault::Wall { by });
        }
    }

    /// Strokes over the stock without a place in the region: what crosses no wall lies on one side of it as a whole.
    fn astray(&mut self, moves: &[Stated]) {
        let strokes = moves.iter().filter_map(|stated| match stated.motion {
            Motion::Along(stroke) | Motion::Down(stroke) => Some((stated, stroke.way)),
            Motion::Above | Motion::Otherwise => None,
        });
        let strokes: Vec<(&Stated, Piece)> = strokes.collect();
        let pass = |way: Piece| Pass {
            level: 0,
            pieces: vec![way],
        };
        let passes: Vec<Pass> = strokes.iter().map(|(_, way)| pass(*way)).collect();
        let astray = clearance(self.asked.region, &passes).astray;
        let mut astray = astray.into_iter().filter_map(|number| strokes.get(number));
        let found = astray.find(|(_, way)| is_over(self.program.stock, way.at(0.5)));
        if let Some(&(stated, way)) = found {
            let by = self.straight.thickness;
            self.note(stated, way.at(0.5), SlitFault::Wall { by });
        }
    }

    /// What stays at the foot of walls, and in acute corners, beyond what must.
    fn foot(&mut self, ways: &[Piece]) -> [Length; 2] {
        let thickness = self.straight.thickness.to_mm();
        let allowance = self.asked.allowance.to_mm();
        let found = foot(self.asked.region, ways, Sides { thickness, allowance });
        let beyond = |left: Option<Left>, kept: f64| {
            let far = left.map_or(0.0, |left| left.distance);
            Length::mm((far - thickness / 2.0 - kept).max(0.0))
        };
        let (fault, at, left) = match found {
            Err(Dense) => (Some(SlitFault::Undecided), None, [Length::ZERO; 2]),
            Ok(Foot { walls, corners }) => {
                let (by, limit) = (beyond(walls, allowance), self.asked.residual);
                let fault = (by > limit).then_some(SlitFault::Stays { by, limit });
                (fault, walls, [by, beyond(corners, 0.0)])
            }
        };
        if let Some(fault) = fault {
            let at = at.map_or(self.asked.region.bounds().low, |left| left.at);
            let tip = Point2::new(at.x, self.asked.floor.to_mm());
            // It is not a single slit that leaves something: the first one stands for all.
            self.note_of_cut((NonZeroU32::MIN, NonZeroU32::MIN), tip, at.y, fault);
        }
        left
    }
}
