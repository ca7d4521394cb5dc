//! The proof of slits and passes of a disc over a region, from the lines and arcs of a finished program.
//!
//! It uses the region and the limits that the job asks for, nothing that the planner chose. Walls are upright, slits go up to the top of
//! the layer, and the disc stands upright: so all is seen from above, layer by layer. The slits of a layer are those that reach its floor
//! before the disc comes to it.

pub(crate) mod stated;

use crate::asked::{AIR, FreePocket};
use stated::{Layer, layers};
use vcutc_backend_api::ir::{Blade, BodyStage, OperationId, Program, Shape, ToolId};
use vcutc_backend_api::units::{Angle, Area, Length};
use vcutc_geometry::curve::Point2;
use vcutc_job::operation::judged::Judged;
use vcutc_process::from_above::{beyond_a_side, highest, is_over, reaching};
use vcutc_process::slits::proof::{Held, OfBlade, judge as judge_slits};
use vcutc_region::clearance::{Clearance, clearance};
use vcutc_region::coverage::{Coverage, Tool, coverage, unreachable};
use vcutc_region::engagement::{Engagement, engagement};
use vcutc_region::freed::{Freed, Slits, Wheel, freed};
use vcutc_region::pass::Pass;
use vcutc_region::place::Place;
use vcutc_simulation::prove::{
    Cleared, ClearingFault, CutFault, Finding, Findings, Passes, Replay, Standing,
};
use vcutc_simulation::surface::Surface;

/// How far a number of a program may be beyond its limit by rounding, in mm.
const ROUNDING: f64 = 1e-6;

/// Judges slits and passes of a program, in what its other cuts leave: adds what is wrong, and what they do.
pub(crate) fn judge(asked: &FreePocket, judged: Judged<'_>, replay: &mut Replay) {
    let (program, operation) = (judged.program, judged.operation);
    let later = judged.plan.operations.iter().skip(usize::from(operation.0) + 1);
    let mut later = later.map(|planned| planned.bound().passes);
    let Some(tools) = tools(program, operation) else {
        return;
    };
    let held = Held {
        region: &asked.region.region,
        floor: asked.floor.value,
        allowance: asked.allowance.value,
        residual: asked.limits.residual.value,
    };
    let of = OfBlade {
        program,
        operation,
        tool: tools.straight,
    };
    let slit = judge_slits(held, of, &mut replay.findings, &mut replay.surface);
    replay.slit.extend(slit);
    let judge = Judge {
        is_last_on_the_stock: later.all(|passes| matches!(passes, Some(Passes::Region))),
        operation,
        asked,
        program,
        tools,
        findings: &mut replay.findings,
    };
    replay.cleared.extend(judge.all(&mut replay.surface));
}

/// The blades of an operation that has both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tools {
    pub(crate) straight: ToolId,
    pub(crate) disc: ToolId,
}

pub(crate) fn tools(program: &Program, operation: OperationId) -> Option<Tools> {
    let tools = &program.operation(operation)?.tools;
    let find = |is_it: fn(&Shape) -> bool| {
        let mut tools = tools.iter().copied();
        tools.find(|tool| program.blade(*tool).is_some_and(|blade| is_it(&blade.shape)))
    };
    Some(Tools {
        straight: find(|shape| matches!(shape, Shape::Straight(_)))?,
        disc: find(|shape| matches!(shape, Shape::Disc(_)))?,
    })
}

struct Judge<'j> {
    operation: OperationId,
    /// Whether no later operation changes what a section shows of the stock.
    is_last_on_the_stock: bool,
    asked: &'j FreePocket,
    program: &'j Program,
    tools: Tools,
    findings: &'j mut Findings,
}

/// What slits and passes of a layer do in the plan.
#[derive(Clone, Debug)]
struct Seen {
    clearance: Clearance,
    coverage: Coverage,
    engagement: Engagement,
    freed: Freed,
}

impl Judge<'_> {
    fn all(mut self, before: &mut Surface) -> Option<Cleared> {
        let blade = self.program.blade(self.tools.disc)?;
        let Shape::Disc(disc) = blade.shape else {
            return None;
        };
        let radius = disc.radius.to_mm();
        let tool = Tool {
            radius,
            keep: (disc.radius + self.asked.allowance.value + self.program.blend).to_mm(),
        };
        let layers = layers(self.program, self.operation, self.tools);
        // An allowance moves corners, and is not a pillar.
        let corners = self.beyond_reach(radius, radius);
        let beyond_reach = self.beyond_reach(radius, radius + self.asked.allowance.value.to_mm());
        let mut done = self.nothing_yet(layers.len(), beyond_reach);
        let mut above = highest(before, &self.asked.region.region, radius);
        // What later operations rough is gone from the surface, but stands while this one cuts.
        let top = if self.is_last_on_the_stock {
            above
        } else {
            self.program.stock.height.to_mm()
        };
        let mut known: Option<(Layer, Seen, f64)> = None;
        for layer in layers {
            self.depth(&layer, above);
            let shank = self.shank(blade, above - layer.floor());
            above = layer.floor();
            let seen = match known {
                Some((same, seen, wide)) if same.is_alike(&layer) && wide >= shank => seen,
                _ => match self.seen(&layer, (tool, shank)) {
                    Some(seen) => seen,
                    None => {
                        self.note(&layer, Place::new(0.0, 0.0), ClearingFault::Undecided);
                        return Some(done);
                    }
                },
            };
            self.judge(&layer, &seen, tool);
            self.stands(&layer, &seen, corners);
            self.bodies(&layer, &seen, (blade, top, radius));
            done.add(&layer, &seen, radius);
            known = Some((layer, seen, shank));
        }
        if above > self.asked.floor.value.to_mm() + ROUNDING {
            self.stops_short(above);
        }
        self.pillars(corners, above);
        Some(done)
    }

    /// What is done before the first layer.
    fn nothing_yet(&self, layers: usize, beyond_reach: Area) -> Cleared {
        Cleared {
            operation: self.operation,
            layers,
            pieces: 0,
            way: Length::ZERO,
            to_wall: Length::mm(f64::INFINITY),
            uncut: Area::mm2(0.0),
            widest: Length::ZERO,
            beyond_reach,
            mean_engagement: Angle::ZERO,
            engagement: Angle::ZERO,
            standing: Some(Standing {
                area: Area::mm2(0.0),
                pillars: 0,
            }),
        }
    }

    /// The widest of the body below the top of a layer, with the air that it keeps, in mm.
    fn shank(&self, blade: &Blade, thick: f64) -> f64 {
        let stages: &[BodyStage] = blade.body.as_deref().unwrap_or_default();
        let low = stages
            .iter()
            .filter(|stage| stage.from.to_mm() < thick - ROUNDING);
        let widest = low.map(|stage| stage.radius.to_mm()).fold(0.0, f64::max);
        // Points of programs are rounded.
        widest + AIR.to_mm() - self.program.blend.to_mm()
    }

    fn seen(&self, layer: &Layer, (tool, shank): (Tool, f64)) -> Option<Seen> {
        let region = &self.asked.region.region;
        let straight = self.program.blade(self.tools.straight)?.straight()?;
        let half = straight.thickness.to_mm() / 2.0;
        let slits = Slits {
            ways: layer.slits(),
            half,
            beside_walls: self.asked.allowance.value.to_mm()
                + self.asked.limits.residual.value.to_mm()
                + half,
        };
        let wheel = Wheel {
            radius: tool.radius,
            shank,
        };
        Some(Seen {
            clearance: clearance(region, layer.passes()),
            coverage: coverage(region, layer.passes(), reaching(tool)).ok()?,
            engagement: engagement(region, layer.passes(), tool.radius).ok()?,
            freed: freed(region, slits, layer.passes(), wheel).ok()?,
        })
    }

    /// How much of the region no disc of this radius reaches whose centre keeps so far from walls; all of it where that is not found out.
    fn beyond_reach(&self, radius: f64, keep: f64) -> Area {
        let region = &self.asked.region.region;
        let left = unreachable(region, Tool { radius, keep });
        // Where that is not found out, all of the region counts.
        let bounds = region.bounds();
        let all = (bounds.high.x - bounds.low.x) * (bounds.high.y - bounds.low.y);
        Area::mm2(left.map_or(all, |left| left.uncut))
    }

    fn note(&mut self, layer: &Layer, at: Place, fault: ClearingFault) {
        self.findings.note_of_region(Finding {
            operation: self.operation,
            layer: layer.number,
            kind: self.program.cut_kind(self.operation, self.tools.disc),
            cut: layer.cut,
            tip: Point2::new(at.x, layer.floor()),
            y: Some(at.y),
            fault: CutFault::Clearing(fault),
        });
    }

    /// A fault of no single pass: the first one stands for all.
    fn note_of_all(&mut self, at: Place, height: f64, fault: ClearingFault) {
        let first = core::num::NonZeroU32::MIN;
        self.findings.note_of_region(Finding {
            operation: self.operation,
            layer: first,
            kind: self.program.cut_kind(self.operation, self.tools.disc),
            cut: first,
            tip: Point2::new(at.x, height),
            y: Some(at.y),
            fault: CutFault::Clearing(fault),
        });
    }

    /// The last layer ends above the floor, so all of the region stays there.
    fn stops_short(&mut self, height: f64) {
        let region = &self.asked.region.region;
        let bounds = region.bounds();
        let size = bounds.high.minus(bounds.low);
        let fault = ClearingFault::Uncut {
            area: Area::mm2(region.area()),
            places: 1,
            widest: Length::mm(size.x.min(size.y)),
            limit: self.asked.limits.uncut.value,
        };
        self.note_of_all(bounds.low.lerp(bounds.high, 0.5), height, fault);
    }

    fn pillars(&mut self, area: Area, height: f64) {
        if let Some(limit) = self.asked.limits.pillars.map(|limit| limit.value)
            && area > limit
        {
            let at = self.asked.region.region.bounds().low;
            self.note_of_all(at, height, ClearingFault::Pillars { area, limit });
        }
    }

    fn depth(&mut self, layer: &Layer, above: f64) {
        if let Some(at) = layer.astray {
            self.note(layer, at, ClearingFault::Leans);
        }
        let Some(at) = layer.first() else { return };
        let below = self.asked.floor.value.to_mm() - layer.floor();
        if below > ROUNDING {
            let by = Length::mm(below);
            self.note(layer, at, ClearingFault::Floor { by });
        }
        let thick = above - layer.floor();
        let limit = self.asked.disc.depth.value;
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

    /// What passes do to walls, and what they leave.
    fn judge(&mut self, layer: &Layer, seen: &Seen, tool: Tool) {
        let (region, stock) = (&self.asked.region.region, self.program.stock);
        if let Some(near) = seen.clearance.least {
            let by = tool.keep - near.distance;
            if by > ROUNDING {
                self.note(layer, near.on_pass, ClearingFault::Wall { by: Length::mm(by) });
            }
        }
        let strays = seen.clearance.astray.iter();
        let mut strays = strays.filter_map(|&astray| Some(layer.passes().get(astray)?.pieces.first()?.from));
        if let Some(at) = strays.find(|at| is_over(stock, *at)) {
            let by = Length::mm(tool.radius);
            self.note(layer, at, ClearingFault::Wall { by });
        }
        if let Some((by, at)) = beyond_a_side(region, stock, layer.passes(), tool.radius) {
            self.note(layer, at, ClearingFault::Wall { by: Length::mm(by) });
        }
        let limit = self.asked.limits.uncut.value;
        let spots = seen.coverage.spots.iter();
        if seen.coverage.uncut > limit.to_mm2()
            && let Some(widest) = spots.max_by(|a, b| a.width.total_cmp(&b.width))
        {
            let fault = ClearingFault::Uncut {
                area: Area::mm2(seen.coverage.uncut),
                places: seen.coverage.spots.len(),
                widest: Length::mm(widest.width),
                limit,
            };
            self.note(layer, widest.at, fault);
        }
    }

    /// What stands where the shank goes, and in the end.
    fn stands(&mut self, layer: &Layer, seen: &Seen, corners: Area) {
        if let Some(met) = seen.freed.met {
            let by = Length::mm(met.by);
            self.note(layer, met.at, ClearingFault::Shank { by });
        }
        let area = Area::mm2(seen.freed.stands);
        let limit = corners + self.asked.limits.uncut.value;
        if area > limit
            && let Some(at) = seen.freed.at
        {
            self.note(layer, at, ClearingFault::Attached { area, limit });
        }
    }

    /// Bodies wider than the edge have to keep from walls, and from pillars in their corners.
    fn bodies(&mut self, layer: &Layer, seen: &Seen, (blade, top, radius): (&Blade, f64, f64)) {
        let Some(near) = seen.clearance.least else { return };
        let stages: &[BodyStage] = blade.body.as_deref().unwrap_or_default();
        let within = stages
            .iter()
            .filter(|stage| layer.floor() + stage.from.to_mm() < top - ROUNDING);
        let widest = within.max_by(|a, b| a.radius.total_cmp(&b.radius));
        if let Some(stage) = widest {
            // Pillars end where the rim does, and slits around them are as wide as the blade.
            let thickness = self.asked.blade.thickness.value.to_mm();
            let by = stage.radius.to_mm() - near.distance.min(radius - thickness);
            if by > ROUNDING {
                let (above, by) = (stage.from, Length::mm(by));
                self.note(layer, near.on_pass, ClearingFault::Body { above, by });
            }
        }
    }
}

/// What a layer adds.
trait Add {
    fn add(&mut self, layer: &Layer, seen: &Seen, radius: f64);
}

impl Add for Cleared {
    fn add(&mut self, layer: &Layer, seen: &Seen, radius: f64) {
        self.pieces += layer.passes().iter().map(|pass| pass.pieces.len()).sum::<usize>();
        self.way += Length::mm(layer.passes().iter().map(Pass::length).sum());
        self.uncut = self.uncut.max(Area::mm2(seen.coverage.uncut));
        let widths = seen.coverage.spots.iter().map(|spot| Length::mm(spot.width));
        self.widest = widths.fold(self.widest, Length::max);
        if let Some(near) = seen.clearance.least {
            self.to_wall = self.to_wall.min(Length::mm(near.distance - radius));
        }
        self.mean_engagement = Angle::rad(seen.engagement.mean);
        let profiles = seen.engagement.profiles.iter().flatten();
        let most = profiles.map(|stretch| stretch.bound).fold(0.0, f64::max);
        self.engagement = self.engagement.max(Angle::rad(most));
        if let Some(standing) = &mut self.standing {
            standing.area = standing.area.max(Area::mm2(seen.freed.stands));
            standing.pillars = standing.pillars.max(seen.freed.pieces);
        }
    }
}
