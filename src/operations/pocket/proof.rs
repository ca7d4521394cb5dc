//! The proof of passes over regions, from the lines and arcs of a finished program.
//!
//! It uses the region and the limits that the job asks for, nothing that the planner chose. Walls are upright, so all is seen from
//! above: the tool is a circle, its way at each floor is lines and arcs, and its ways down and up keep from the walls as its passes do.

pub(crate) mod stated;

use crate::asked::ClearPocket;
use core::num::NonZeroU32;
use stated::{Layer, layers};
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Blade, BodyStage, Crusher, OpId, OperationId, Program, Shape, ToolId};
use vcutc_backend_api::units::{Angle, Area, Length};
use vcutc_geometry::curve::Point2;
use vcutc_job::operation::judged::Judged;
use vcutc_process::from_above::{beyond_a_side, highest, is_over, reaching};
use vcutc_region::clearance::{Clearance, clearance};
use vcutc_region::coverage::{Coverage, Tool, coverage, unreachable};
use vcutc_region::engagement::{Engagement, engagement, on_pieces};
use vcutc_region::place::Place;
use vcutc_simulation::prove::{
    Cleared, ClearingFault, CutFault, Finding, Findings, Passes, Replay, UsedEdge,
};
use vcutc_simulation::surface::Surface;

/// How far a number of a program may be beyond its limit by rounding, in mm.
const ROUNDING: f64 = 1e-6;

/// Judges the passes over a region of a program, in what its other cuts leave: adds what is wrong, and what they do.
pub(crate) fn judge(asked: &ClearPocket, judged: Judged<'_>, replay: &mut Replay) {
    let later = judged
        .plan
        .operations
        .iter()
        .skip(usize::from(judged.operation.0) + 1);
    let mut later = later.map(|planned| planned.bound().passes);
    let judge = Judge {
        is_last_on_the_stock: later.all(|passes| matches!(passes, Some(Passes::Region))),
        operation: judged.operation,
        asked,
        program: judged.program,
        findings: &mut replay.findings,
        edges: &mut replay.edges,
    };
    replay.cleared.extend(judge.all(&mut replay.surface));
    replay.edges.sort_by_key(|used| used.op);
}

struct Judge<'j> {
    operation: OperationId,
    /// Whether no later operation changes what a section shows of the stock.
    is_last_on_the_stock: bool,
    asked: &'j ClearPocket,
    program: &'j Program,
    findings: &'j mut Findings,
    edges: &'j mut Vec<UsedEdge>,
}

/// What the passes of a layer do in the plan.
#[derive(Clone, Debug)]
struct Seen {
    clearance: Clearance,
    coverage: Coverage,
    engagement: Engagement,
}

impl Judge<'_> {
    fn all(mut self, before: &mut Surface) -> Option<Cleared> {
        let layers = layers(self.program, self.operation);
        let at_hand = *self.program.operation(self.operation)?.tools.first()?;
        let blade = self.program.blade(at_hand)?;
        let Shape::Crusher(crusher) = blade.shape else {
            return None;
        };
        let tool = Tool {
            radius: crusher.radius.to_mm(),
            keep: (crusher.radius + self.asked.allowance.value + self.program.blend).to_mm(),
        };
        let mut done = Cleared {
            operation: self.operation,
            layers: layers.len(),
            pieces: 0,
            way: Length::ZERO,
            to_wall: Length::mm(f64::INFINITY),
            uncut: Area::mm2(0.0),
            widest: Length::ZERO,
            beyond_reach: self.beyond_reach(tool.radius),
            mean_engagement: Angle::ZERO,
            engagement: Angle::ZERO,
            standing: None,
        };
        let mut above = highest(before, &self.asked.region.region, tool.radius);
        // What later operations rough is gone from the surface, but stands while this one cuts.
        let stands = if self.is_last_on_the_stock {
            above
        } else {
            self.program.stock.height.to_mm()
        };
        let top = stands;
        let mut begins = stands;
        let mut known: Option<(Layer, Seen)> = None;
        if let Some(first) = layers.first() {
            self.is_open(first);
        }
        for layer in layers {
            self.stands(&layer);
            self.depth(&layer, above, crusher);
            above = layer.floor();
            let seen = match known {
                Some((same, seen)) if same.flat() == layer.flat() => seen,
                _ => match self.seen(&layer, tool) {
                    Some(seen) => seen,
                    None => {
                        self.note(&layer, Place::new(0.0, 0.0), ClearingFault::Undecided);
                        return Some(done);
                    }
                },
            };
            self.judge(&layer, &seen, tool);
            let used = engaged(&layer, &seen.engagement, begins).into_iter();
            self.edges
                .extend(used.map(|(op, length)| UsedEdge { op, length }));
            begins = layer.floor();
            self.bodies(&layer, &seen, (blade, top));
            done.pieces += layer.flat().iter().map(|pass| pass.pieces.len()).sum::<usize>();
            done.way += Length::mm(layer.flat().iter().map(|pass| pass.length()).sum());
            done.uncut = done.uncut.max(Area::mm2(seen.coverage.uncut));
            let widths = seen.coverage.spots.iter().map(|spot| Length::mm(spot.width));
            done.widest = widths.fold(done.widest, Length::max);
            if let Some(near) = seen.clearance.least {
                done.to_wall = done.to_wall.min(Length::mm(near.distance - tool.radius));
            }
            done.mean_engagement = Angle::rad(seen.engagement.mean);
            if let Some((angle, _)) = self.most_engaged(&layer, &seen.engagement) {
                done.engagement = done.engagement.max(angle);
            }
            known = Some((layer, seen));
        }
        if above > self.asked.floor.value.to_mm() + ROUNDING {
            self.stops_short(above, at_hand);
        }
        Some(done)
    }
}

/// How much of the height of the teeth is in the material on each way of a layer that begins at this height: all that is below it, and
/// nothing on the floor where none of the rim is in the material.
fn engaged(layer: &Layer, engagement: &Engagement, above: f64) -> BTreeMap<OpId, Length> {
    let below = |lowest: f64| Length::mm((above - lowest).max(0.0));
    let sloping = layer.sloping_moves.iter();
    let mut all: BTreeMap<OpId, Length> = sloping.map(|way| (way.op, below(way.lowest))).collect();
    for (number, (pass, profile)) in layer.flat().iter().zip(&engagement.profiles).enumerate() {
        for (stretch, ..) in on_pieces(pass, profile) {
            if let Some(along) = layer.along(number, stretch.piece) {
                let is_in = stretch.bound > 0.0;
                let length = if is_in { below(layer.floor()) } else { Length::ZERO };
                let known = all.entry(along.op).or_insert(length);
                *known = known.max(length);
            }
        }
    }
    all
}

impl Judge<'_> {
    fn seen(&self, layer: &Layer, tool: Tool) -> Option<Seen> {
        let region = &self.asked.region.region;
        let passes = layer.flat();
        Some(Seen {
            clearance: clearance(region, &layer.all()),
            coverage: coverage(region, passes, reaching(tool)).ok()?,
            engagement: engagement(region, passes, tool.radius).ok()?,
        })
    }

    /// How much of the region no tool reaches that keeps the allowance; none where that is beyond what is looked at.
    fn beyond_reach(&self, radius: f64) -> Area {
        let keep = radius + self.asked.allowance.value.to_mm();
        let left = unreachable(&self.asked.region.region, Tool { radius, keep });
        Area::mm2(left.map_or(0.0, |left| left.uncut))
    }

    fn note(&mut self, layer: &Layer, at: Place, fault: ClearingFault) {
        let finding = Finding {
            operation: self.operation,
            layer: layer.number,
            kind: self.program.cut_kind(self.operation, layer.tool),
            cut: layer.cut,
            tip: Point2::new(at.x, layer.floor()),
            y: Some(at.y),
            fault: CutFault::Clearing(fault),
        };
        self.findings.note_of_region(finding);
    }

    /// The last layer ends above the floor, so all of the region stays there.
    fn stops_short(&mut self, height: f64, tool: ToolId) {
        let region = &self.asked.region.region;
        let bounds = region.bounds();
        let size = bounds.high.minus(bounds.low);
        let middle = bounds.low.lerp(bounds.high, 0.5);
        let fault = ClearingFault::Uncut {
            area: Area::mm2(region.area()),
            places: 1,
            widest: Length::mm(size.x.min(size.y)),
            limit: self.asked.limits.uncut.value,
        };
        self.findings.note_of_region(Finding {
            operation: self.operation,
            layer: NonZeroU32::MIN,
            kind: self.program.cut_kind(self.operation, tool),
            cut: NonZeroU32::MIN,
            tip: Point2::new(middle.x, height),
            y: Some(middle.y),
            fault: CutFault::Clearing(fault),
        });
    }

    fn stands(&mut self, layer: &Layer) {
        if let Some(at) = layer.leaning {
            self.note(layer, at, ClearingFault::Leans);
        }
    }

    /// The program goes straight down only into holes that the job names.
    fn is_open(&mut self, layer: &Layer) {
        let named = self.asked.opening_in_program();
        let operation = self.program.operation(self.operation);
        let mut openings = operation.into_iter().flat_map(|operation| &operation.openings);
        if openings.any(|hole| Some(*hole) != named) {
            self.note(layer, layer.lowest, ClearingFault::Unopened);
        }
    }

    fn depth(&mut self, layer: &Layer, above: f64, crusher: Crusher) {
        let at = layer.lowest;
        let below = self.asked.floor.value.to_mm() - layer.floor();
        if below > ROUNDING {
            self.note(
                layer,
                at,
                ClearingFault::Floor {
                    by: Length::mm(below),
                },
            );
        }
        let thick = above - layer.floor();
        let limit = crusher.height;
        if thick > limit.to_mm() + ROUNDING {
            let layer_of = Length::mm(thick);
            self.note(
                layer,
                at,
                ClearingFault::Thick {
                    layer: layer_of,
                    limit,
                },
            );
        }
    }

    fn judge(&mut self, layer: &Layer, seen: &Seen, tool: Tool) {
        let Seen {
            clearance,
            coverage,
            engagement,
        } = seen;
        if let Some(near) = clearance.least {
            let by = tool.keep + layer.slack - near.distance;
            if by > ROUNDING {
                self.note(layer, near.on_pass, ClearingFault::Wall { by: Length::mm(by) });
            }
        }
        let all = layer.all();
        let astray = clearance
            .astray
            .iter()
            .filter_map(|&astray| all.get(astray)?.pieces.first());
        if let Some(at) = astray
            .map(|piece| piece.from)
            .find(|at| is_over(self.program.stock, *at))
        {
            let by = Length::mm(tool.radius);
            self.note(layer, at, ClearingFault::Wall { by });
        }
        let region = &self.asked.region.region;
        if let Some((by, at)) = beyond_a_side(region, self.program.stock, &all, tool.radius) {
            self.note(layer, at, ClearingFault::Wall { by: Length::mm(by) });
        }
        let limit = self.asked.limits.uncut.value;
        if coverage.uncut > limit.to_mm2()
            && let Some(widest) = coverage.spots.iter().max_by(|a, b| a.width.total_cmp(&b.width))
        {
            let fault = ClearingFault::Uncut {
                area: Area::mm2(coverage.uncut),
                places: coverage.spots.len(),
                widest: Length::mm(widest.width),
                limit,
            };
            self.note(layer, widest.at, fault);
        }
        if let (Some(limit), Some((angle, at))) =
            (self.asked.limits.engagement, self.most_engaged(layer, engagement))
            && angle > limit.value + Angle::rad(ROUNDING)
        {
            let limit = limit.value;
            self.note(layer, at, ClearingFault::Engaged { angle, limit });
        }
    }

    /// How much of the rim is in the material at most where the tool is not slow, and where that is.
    fn most_engaged(&self, layer: &Layer, engagement: &Engagement) -> Option<(Angle, Place)> {
        let mut most: Option<(f64, Place)> = None;
        for (number, (pass, profile)) in layer.flat().iter().zip(&engagement.profiles).enumerate() {
            for (stretch, piece, begun) in on_pieces(pass, profile) {
                let is_slow = layer
                    .along(number, stretch.piece)
                    .and_then(|along| along.feed)
                    .is_none_or(|speed| speed <= self.asked.plunge_feed.value);
                if is_slow || most.is_some_and(|(known, _)| known >= stretch.bound) {
                    continue;
                }
                let middle = f64::midpoint(stretch.way[0], stretch.way[1]) - begun;
                most = Some((stretch.bound, piece.at(middle / piece.length())));
            }
        }
        most.map(|(angle, at)| (Angle::rad(angle), at))
    }

    /// Bodies wider than the edge have to keep from the walls that are beside them.
    fn bodies(&mut self, layer: &Layer, seen: &Seen, (blade, top): (&Blade, f64)) {
        let Some(near) = seen.clearance.least else { return };
        let stages: &[BodyStage] = blade.body.as_deref().unwrap_or_default();
        let within = stages
            .iter()
            .filter(|stage| layer.floor() + stage.from.to_mm() < top - ROUNDING);
        let widest = within.max_by(|a, b| a.radius.total_cmp(&b.radius));
        if let Some(stage) = widest {
            let by = stage.radius.to_mm() + layer.slack - near.distance;
            if by > ROUNDING {
                let (above, by) = (stage.from, Length::mm(by));
                self.note(layer, near.on_pass, ClearingFault::Body { above, by });
            }
        }
    }
}
