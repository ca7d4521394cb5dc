//! What is open: layer, step, and how many layers slits go through.
//!
//! The largest layer that both blades take and the widest strip that the disc frees make the fewest strips. Only where they leave
//! more on the part than may stay, smaller ones are planned too, those with the largest sections first. How many layers slits go
//! through is decided by the time of the plans.

use super::blades::TOUCH;
use super::ground::{Sizes, Terms};
use super::refusal::{Closed, Exceeded, Over, Refusal, SizeField};
use super::trial::{self, Choice};
use super::{Blades, PlannedRect, Room, Rounding, Span, Wish, Work};
use crate::asked::Residual;
use vcutc_backend_api::units::Length;
use vcutc_geometry::grid;
use vcutc_job::Auto;

/// By what share sizes shrink from one try to the next.
const SHRINKING: f64 = 0.8;

/// How often a size shrinks at most: to about a sixth.
const SHRUNK: u32 = 8;

/// So many smaller sizes are tried where the body of the straight blade has no room beside slits.
const TRIES_FOR_ROOM: u32 = 24;

/// How often a limit on the scallop is raised to one that a plan keeps.
const RAISES: u32 = 3;

/// Most layers that slits go through where that is open.
const MOST_THROUGH: u32 = 8;

/// A last layer thinner than this share of the others is not offered: a judgement, from no source.
const THIN: f64 = 0.25;

/// At the ends of so many layers it is tried to stop above a closed place.
const LAYERS_TRIED: usize = 8;

/// Thinner layers are not chosen: a judgement, from no source. Where blades do no thicker ones, something else is to be changed.
pub const LEAST_LAYER: Length = Length::mm(0.1);

/// By how much a plan may be over its limit by rounding, in mm.
const OVER_LIMIT: f64 = 1e-3;

/// Plans rectangular roughing, with at most so many strips.
///
/// # Errors
/// What is in the way.
pub fn plan(work: Work<'_>, blades: &Blades, wish: &Wish, most: usize) -> Result<PlannedRect, Refusal> {
    if blades.knife.deepest() <= Length::ZERO {
        return Err(Refusal::NoEdge {
            rake: blades.knife.rake,
            half_apex: blades.knife.half_apex,
        });
    }
    let search = Search {
        work,
        blades,
        wish,
        most,
    };
    match search.best(wish.down_to) {
        Err(Refusal::Closed(closed)) => Err(Refusal::Closed(search.opened(closed))),
        Err(Refusal::Over(over)) => Err(Refusal::Over(search.with_a_limit_that_works(over))),
        Err(Refusal::Scallop {
            left,
            limit,
            left_out,
            ..
        }) => Err(Refusal::Scallop {
            left,
            limit,
            left_out,
            works: search.scallop_that_works(left),
        }),
        planned => planned,
    }
}

/// Whether a plan is faster, the body of the straight blade having no less room.
fn is_better(plan: &PlannedRect, other: &PlannedRect) -> bool {
    let order = plan.room.cmp(&other.room).then(plan.time.total_cmp(&other.time));
    order.is_lt()
}

struct Search<'s> {
    work: Work<'s>,
    blades: &'s Blades,
    wish: &'s Wish,
    most: usize,
}

impl Search<'_> {
    /// The fastest plan over how many layers slits go through.
    fn best(&self, down_to: Length) -> Result<PlannedRect, Refusal> {
        let most = match self.wish.through {
            Auto::Given(through) => return self.through(through.max(1), down_to),
            Auto::Auto => MOST_THROUGH,
        };
        let mut best = self.through(1, down_to);
        for through in 2..=most {
            let may_help = match &best {
                Ok(best) => self.is_worth_trying(through, best),
                Err(refusal) => refusal.is_about_the_whole(),
            };
            if !may_help {
                break;
            }
            let further = self.through(through, down_to);
            best = match (best, further) {
                (Ok(best), Ok(further)) if is_better(&further, &best) => Ok(further),
                (Ok(best), _) => Ok(best),
                (Err(_), Ok(further)) => Ok(further),
                (Err(refusal), Err(other)) => Err(refusal.or_less(other)),
            };
        }
        best
    }

    /// Whether slits through so many layers may be faster than a plan: a layer at most half as thick makes twice the strips, which
    /// fewer changes hardly outweigh. A judgement, from no source.
    fn is_worth_trying(&self, through: u32, best: &PlannedRect) -> bool {
        let thickest = self.blades.knife.deepest() * (1.0 / f64::from(through));
        match self.wish.layer {
            Auto::Given(layer) => thickest + Length::mm(OVER_LIMIT) >= layer,
            Auto::Auto => thickest > best.layer * 0.5,
        }
    }

    /// The plan with the largest sections that keeps all limits.
    fn through(&self, through: u32, down_to: Length) -> Result<PlannedRect, Refusal> {
        let layers = self.layers(through)?;
        let mut tries = Vec::new();
        for &layer in &layers {
            tries.extend(self.steps(layer)?.into_iter().map(|step| (layer, step)));
        }
        tries.sort_by(|(layer, step), (other, wide)| {
            let section = layer.to_mm() * step.to_mm();
            let further = other.to_mm() * wide.to_mm();
            further.total_cmp(&section)
        });
        let mut best: Option<Refusal> = None;
        let mut cramped: Option<PlannedRect> = None;
        let mut further = TRIES_FOR_ROOM;
        for (layer, step) in tries {
            if cramped.is_some() {
                if further == 0 {
                    break;
                }
                further -= 1;
            }
            match self.tried(layer, step, through, down_to) {
                Ok(plan) if plan.room == Room::Enough => return Ok(plan),
                Ok(plan) => {
                    let is_better = cramped.as_ref().is_none_or(|known| {
                        let order = plan.room.cmp(&known.room);
                        order.then(plan.left.total_cmp(&known.left)).is_lt()
                    });
                    if is_better {
                        cramped = Some(plan);
                    }
                }
                // With smaller sizes nothing else is in the way but what was before.
                Err(_) if cramped.is_some() => {}
                Err(refusal @ Refusal::Scallop { .. }) => {
                    best = Some(match best {
                        Some(best) => best.or_less(refusal),
                        None => refusal,
                    });
                }
                // What this leaves is within the limit on scallop, so that is not what is in the way.
                Err(refusal) if refusal.is_about_the_whole() => return Err(refusal),
                Err(refusal) => return Err(best.unwrap_or(refusal)),
            }
        }
        cramped.ok_or_else(|| best.unwrap_or(Refusal::Nothing))
    }

    fn tried(
        &self,
        layer: Length,
        step: Length,
        through: u32,
        down_to: Length,
    ) -> Result<PlannedRect, Refusal> {
        let terms = Terms {
            work: self.work,
            knife: &self.blades.knife,
            wheel: &self.blades.wheel,
            down_to,
            rounding: self.wish.rounding,
            worth: self.wish.worth,
        };
        let choice = Choice {
            sizes: Sizes {
                layer: layer.to_mm(),
                step: step.to_mm(),
            },
            through,
            residual: self.wish.residual.or(Residual::Mixed),
            limit: self.wish.limits.scallop.map(Length::to_mm),
            most: self.most,
        };
        let plan = trial::plan(terms, self.blades, choice)?;
        self.within_limits(plan)
    }

    fn within_limits(&self, plan: PlannedRect) -> Result<PlannedRect, Refusal> {
        let limits = &self.wish.limits;
        if let Some(limit) = limits.scallop
            && plan.left.to_mm() > limit.to_mm() + OVER_LIMIT
        {
            return Err(Refusal::Scallop {
                left: plan.left,
                limit,
                left_out: plan.room.left_out(),
                works: None,
            });
        }
        let counts = plan.counts();
        let changes = u32::try_from(counts.changes).unwrap_or(u32::MAX);
        let over = Exceeded::of(changes, limits.changes)
            .map(Over::Changes)
            .or_else(|| Exceeded::of(counts.cuts(), limits.cuts).map(Over::Cuts))
            .or_else(|| Exceeded::of(plan.time, limits.time).map(Over::Time));
        if let Some(over) = over {
            return Err(Refusal::Over(over));
        }
        Ok(plan)
    }

    /// The layers that are tried, the largest first.
    fn layers(&self, through: u32) -> Result<Vec<Length>, Refusal> {
        let (knife, wheel) = (&self.blades.knife, &self.blades.wheel);
        let deepest = knife.deepest() - wheel.slit_excess(Length::mm(self.wish.rounding.spacing()));
        let by_blades = (deepest * (1.0 / f64::from(through))).min(wheel.thickest_layer());
        if let (Auto::Auto, true) = (self.wish.layer, wheel.thickest_layer() < LEAST_LAYER) {
            return Err(Refusal::TooThick {
                layer: Length::ZERO,
                chip: wheel.sink(),
                depth: wheel.depth,
            });
        }
        if let (Auto::Auto, true) = (self.wish.layer, by_blades < LEAST_LAYER) {
            return Err(Refusal::TooDeepForSlits {
                layer: LEAST_LAYER,
                through,
                needed: knife.edge_for(LEAST_LAYER * f64::from(through)),
                edge: knife.edge,
                most: by_blades,
            });
        }
        self.sizes(
            self.wish.layer,
            by_blades,
            self.wish.limits.layer,
            SizeField::Layer,
        )
    }

    /// The steps that are tried with a layer, the largest first.
    fn steps(&self, layer: Length) -> Result<Vec<Length>, Refusal> {
        let (limit, bound) = self.blades.wheel.widest_strip(layer);
        if let (Auto::Auto, true) = (self.wish.step, limit <= Length::ZERO) {
            return Err(Refusal::TooWide {
                widest: Length::ZERO,
                limit,
                bound,
            });
        }
        self.sizes(self.wish.step, limit, self.wish.limits.step, SizeField::Step)
    }

    fn sizes(
        &self,
        wished: Auto<Length>,
        largest: Length,
        span: Span,
        field: SizeField,
    ) -> Result<Vec<Length>, Refusal> {
        let largest = match wished {
            Auto::Given(size) => return Ok(vec![size]),
            Auto::Auto => span.most.map_or(largest, |most| most.min(largest)),
        };
        let least = span.least.unwrap_or(Length::ZERO);
        // Smaller sizes leave less, and give the body of the straight blade more room.
        let tries = if self.wish.limits.scallop.is_some() || self.blades.shank.is_some() {
            SHRUNK
        } else {
            0
        };
        let sizes = (0..=tries).scan(largest, |size, _| {
            let this = *size;
            *size = *size * SHRINKING;
            Some(this)
        });
        let sizes: Vec<Length> = sizes
            .map(|size| self.on_grid(size))
            .filter(|&size| size >= least && size > Length::ZERO)
            .collect();
        if sizes.is_empty() {
            return Err(Refusal::Bounds {
                field,
                least,
                most: largest,
            });
        }
        Ok(sizes)
    }

    fn on_grid(&self, size: Length) -> Length {
        match self.wish.rounding {
            Rounding::Exact => size,
            Rounding::Grid => Length::mm(grid::down(size.to_mm())),
        }
    }

    /// A limit on the scallop, no less than this, that a plan keeps: with another limit other sizes are tried.
    fn scallop_that_works(&self, left: Length) -> Option<Length> {
        let mut limit = left;
        for _ in 0..RAISES {
            limit = Length::mm(grid::up(limit.to_mm()));
            let mut raised = self.wish.clone();
            raised.limits.scallop = Some(limit);
            let search = Search {
                wish: &raised,
                ..*self
            };
            match search.best(raised.down_to) {
                Ok(_) => return Some(limit),
                Err(Refusal::Scallop { left, .. }) if left > limit => limit = left,
                Err(_) => return None,
            }
        }
        None
    }

    /// A broken limit on the whole with one in its place that was tried: what is in the way may be another limit too.
    fn with_a_limit_that_works(&self, over: Over) -> Over {
        let mut raised = self.wish.clone();
        match over {
            Over::Changes(changes) => raised.limits.changes = Some(changes.found),
            Over::Cuts(cuts) => raised.limits.cuts = Some(cuts.found),
            Over::Time(time) => raised.limits.time = Some(time.found),
        }
        let search = Search {
            wish: &raised,
            ..*self
        };
        let plan = search.best(raised.down_to).ok();
        match over {
            Over::Changes(changes) => Over::Changes(Exceeded {
                works: plan.and_then(|plan| u32::try_from(plan.counts().changes).ok()),
                ..changes
            }),
            Over::Cuts(cuts) => Over::Cuts(Exceeded {
                works: plan.map(|plan| plan.counts().cuts()),
                ..cuts
            }),
            Over::Time(time) => Over::Time(Exceeded {
                works: plan.map(|plan| plan.time),
                ..time
            }),
        }
    }

    /// A closed place with a height down to which the job can be planned: the lowest one of those that are tried.
    fn opened(&self, closed: Closed) -> Closed {
        let top = Length::mm(super::ground::top(self.work.before));
        let is_below_top = |height: &Length| *height > self.wish.down_to && *height < top;
        let heights = self.heights_above(&closed, top);
        let down_to = (heights.into_iter())
            .filter(is_below_top)
            .find(|&height| self.best(height).is_ok());
        Closed { down_to, ..closed }
    }

    /// Where layers may end above a closed place: at the lower one of the crests beside it, without a thin layer above that, and
    /// at the ends of the layers above it.
    fn heights_above(&self, closed: &Closed, top: Length) -> Vec<Length> {
        let bound = self.work.bound;
        let (start, end) = bound.span();
        let beside = [
            super::ground::highest(bound, start, closed.left.to_mm()),
            super::ground::highest(bound, closed.right.to_mm(), end),
        ];
        let crest = Length::mm(grid::up(beside[0].min(beside[1])));
        let layer = match self.wish.layer {
            Auto::Given(layer) => Some(layer),
            Auto::Auto => self.layers(1).ok().and_then(|layers| layers.first().copied()),
        };
        let Some(layer) = layer else {
            return vec![crest];
        };
        let end_of = |layers: f64| Length::mm(grid::up((top - layer * layers).to_mm()));
        let whole = ((top - crest).to_mm() / layer.to_mm() + TOUCH).floor();
        let rest = end_of(whole) - crest;
        let at_crest = if whole >= 1.0 && rest < layer * THIN {
            [end_of(whole), crest]
        } else {
            [crest, end_of(whole)]
        };
        let above = (1..closed.layer).rev().take(LAYERS_TRIED);
        at_crest
            .into_iter()
            .chain(above.map(|layers| end_of(f64::from(layers))))
            .collect()
    }
}
