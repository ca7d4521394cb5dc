//! One plan: with layer, step, slits and strategy decided.

use super::access::{Access, first_run, nearer_side};
use super::blades::{Cover, TOUCH};
use super::ground::{Ground, Sizes, Terms};
use super::layout::{Layout, Piece};
use super::mixed::{self, Tolerated};
use super::model::RectCut;
use super::refusal::{Closed, Refusal};
use super::shank::{self, Shank};
use super::slits::{self, Through};
use super::terrain::Terrain;
use super::{Blades, PlannedRect, Room, Slit, Stage};
use crate::asked::Residual;
use core::ops::RangeInclusive;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_simulation::surface::Side;

/// Every choice of a plan.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choice {
    pub(crate) sizes: Sizes,
    pub(crate) through: u32,
    pub(crate) residual: Residual,
    /// What may stay on the part, in mm, if that is limited.
    pub(crate) limit: Option<f64>,
    /// Most strips.
    pub(crate) most: usize,
}

/// Plans with these choices.
///
/// # Errors
/// What is in the way.
pub(crate) fn plan(terms: Terms<'_>, blades: &Blades, choice: Choice) -> Result<PlannedRect, Refusal> {
    let ground = Ground::new(terms, choice.sizes);
    let strips = ground.most_strips();
    if strips.is_nan() || strips > choice.most as f64 {
        return Err(Refusal::TooMany { strips });
    }
    let layouts = layouts(&ground, choice)?;
    let trial = Trial {
        ground: &ground,
        terms,
        blades,
        choice,
    };
    let mut first: Option<Refusal> = None;
    for layout in layouts {
        match trial
            .without_scraps(&layout)
            .unwrap_or_else(|| trial.planned(&layout))
        {
            Ok(plan) => return Ok(plan),
            Err(refusal) => first = first.or(Some(refusal)),
        }
    }
    Err(first.unwrap_or(Refusal::Nothing))
}

fn layouts(ground: &Ground<'_>, choice: Choice) -> Result<Vec<Layout>, Refusal> {
    let through = if choice.through > 1 {
        Through::Several
    } else {
        Through::One
    };
    match (choice.residual, through) {
        (Residual::Discard, _) => Ok(vec![Layout::discard(ground)]),
        (Residual::Lift, _) => Ok(vec![Layout::lift(ground)]),
        (Residual::Shift, Through::One) => Ok(vec![Layout::shift(ground)]),
        (Residual::Shift, Through::Several) => Err(Refusal::NoColumns {
            through: choice.through,
        }),
        (Residual::Mixed, _) => {
            let tolerated = choice.limit.unwrap_or_else(|| ground.unavoidable());
            Ok(mixed::layouts(ground, Tolerated(tolerated), through))
        }
    }
}

/// A plan in the making.
struct Trial<'t> {
    ground: &'t Ground<'t>,
    terms: Terms<'t>,
    blades: &'t Blades,
    choice: Choice,
}

impl Trial<'_> {
    /// A plan that leaves scraps of earlier operations where they are: none where there are no scraps, where they would stay as
    /// more than the part may keep, and where they are in the way of other strips.
    fn without_scraps(&self, layout: &Layout) -> Option<Result<PlannedRect, Refusal>> {
        let rest = layout.without_scraps(self.ground)?;
        if let Some(limit) = self.choice.limit {
            let contour = rest.after(self.ground).corners(0.0, self.ground.width);
            if self.ground.left_by(&contour) > limit {
                return None;
            }
        }
        match self.planned(&rest) {
            Err(Refusal::Nothing) => Some(Err(Refusal::Nothing)),
            planned => planned.ok().map(Ok),
        }
    }

    /// A plan in which the body of the straight blade stays clear of what stands beside its slits; where there is none, one without
    /// a look at it, of which the proof says what is in the way.
    fn planned(&self, layout: &Layout) -> Result<PlannedRect, Refusal> {
        let planned = self.laid(layout);
        let (Ok(plan), Some(shank)) = (&planned, &self.blades.shank) else {
            return planned;
        };
        let cleared = self.cleared(layout, plan, shank);
        cleared.map_or_else(
            || {
                planned.map(|plan| PlannedRect {
                    room: Room::Lacking,
                    ..plan
                })
            },
            Ok,
        )
    }

    /// The plan without the strips whose slits take the body into what stands.
    fn cleared(&self, layout: &Layout, plan: &PlannedRect, shank: &Shank) -> Option<PlannedRect> {
        let (mut layout, mut plan) = (layout.clone(), plan.clone());
        let pieces = layout.pieces.len();
        loop {
            let met = shank.meets(&plan, self.ground, self.terms.work.stock);
            if met.is_empty() {
                let left_out = pieces - layout.pieces.len();
                if left_out > 0 {
                    plan.room = Room::Without(left_out);
                }
                return Some(plan);
            }
            let fewer = shank::without(&layout, &met, self.ground);
            if fewer.pieces.len() == layout.pieces.len() {
                return None;
            }
            layout = fewer;
            plan = self.laid(&layout).ok()?;
        }
    }

    fn laid(&self, layout: &Layout) -> Result<PlannedRect, Refusal> {
        if layout.pieces.is_empty() {
            return Err(Refusal::Nothing);
        }
        self.check_sizes(layout)?;
        let mut standing = self.ground.before();
        let mut slit = standing.clone();
        let mut stages: Vec<Stage> = Vec::new();
        let mut start = Side::Left;
        let through = self.choice.through.max(1);
        for group in layout
            .pieces
            .chunk_by(|one, next| (one.layer - 1) / through == (next.layer - 1) / through)
        {
            let layers = layers(group);
            let slits = self.slits(group, &mut slit, stages.len())?;
            let mut strips = Vec::with_capacity(group.len());
            for layer in group.chunk_by(|one, next| one.layer == next.layer) {
                let ordered = self.access().order(layer, start, &mut standing);
                if !ordered.stuck.is_empty() {
                    return Err(self.closed(layout, &ordered.stuck, &standing));
                }
                strips.extend(ordered.strips);
                start = nearer_side(&strips, self.ground.width);
            }
            push(
                &mut stages,
                Stage::Slits {
                    layers: layers.clone(),
                    slits,
                },
            );
            push(&mut stages, Stage::Strips { layers, strips });
        }
        Ok(self.finished(layout, stages, &standing))
    }

    /// The slits of a group, every other time from right to left.
    fn slits(&self, group: &[Piece], terrain: &mut Terrain, stages: usize) -> Result<Vec<Slit>, Refusal> {
        let mut slits = slits::of_group(self.ground, group, terrain);
        for &slit in &slits {
            self.check_edge(slit)?;
            if let Some(entry) = slits::entry(slit, self.terms.work.bound, self.terms.knife) {
                return Err(Refusal::SlitInPart {
                    x: Length::mm(slit.x),
                    bottom: Length::mm(slit.bottom),
                    entry: Length::mm(entry),
                });
            }
        }
        if stages % 4 == 2 {
            slits.reverse();
        }
        Ok(slits)
    }

    const fn access(&self) -> Access<'_> {
        Access {
            ground: self.ground,
            wheel: self.terms.wheel,
            bound: self.terms.work.bound,
        }
    }

    /// Whether the blades take layers so thick and strips so wide.
    fn check_sizes(&self, layout: &Layout) -> Result<(), Refusal> {
        let (knife, wheel) = (self.terms.knife, self.terms.wheel);
        let layer = Length::mm(layout.thickest(self.ground));
        let through = self.choice.through.min(layout.layers()).max(1);
        let needed = knife.edge_for(layer * f64::from(through));
        let touch = self.touch();
        if needed > knife.edge + touch {
            return Err(Refusal::TooDeepForSlits {
                layer,
                through,
                needed,
                edge: knife.edge,
                most: self.thickest_layer(through),
            });
        }
        let chip = layer + wheel.sink();
        if chip > wheel.depth + touch {
            return Err(Refusal::TooThick {
                layer,
                chip,
                depth: wheel.depth,
            });
        }
        let widest = Length::mm(layout.widest());
        let (limit, bound) = wheel.widest_strip(layer);
        // Rounding may make a strip wider than its step, but it does not excuse a step that is too wide itself.
        let is_step = self.choice.sizes.step > limit.to_mm() + TOUCH;
        let spare = if is_step { Length::mm(TOUCH) } else { touch };
        if widest > limit + spare {
            return Err(Refusal::TooWide { widest, limit, bound });
        }
        Ok(())
    }

    /// The thickest layer that both blades take where slits go through so many.
    fn thickest_layer(&self, through: u32) -> Length {
        let (knife, wheel) = (self.terms.knife, self.terms.wheel);
        let deepest = knife.deepest() - wheel.slit_excess(Length::mm(self.ground.spacing()));
        (deepest * (1.0 / f64::from(through))).min(wheel.thickest_layer())
    }

    /// Whether the edge covers what it must beside a slit.
    fn check_edge(&self, slit: Slit) -> Result<(), Refusal> {
        let knife = self.terms.knife;
        let covered = match knife.covers {
            Cover::Standing => slit.top,
            Cover::Uncut => slit.uncut,
        };
        let needed = knife.edge_for(Length::mm(covered - slit.bottom));
        if needed > knife.edge + self.touch() {
            return Err(Refusal::TooHighForSlit {
                x: Length::mm(slit.x),
                bottom: Length::mm(slit.bottom),
                top: Length::mm(slit.top),
                needed,
                edge: knife.edge,
            });
        }
        Ok(())
    }

    /// What rounding may add to a length.
    fn touch(&self) -> Length {
        Length::mm(TOUCH + self.ground.spacing())
    }

    /// All that is stuck, with the layers below.
    fn closed(&self, layout: &Layout, stuck: &[Piece], standing: &Terrain) -> Refusal {
        let mut terrain = standing.clone();
        let layer = stuck.first().map_or(0, |piece| piece.layer);
        let below = layout.pieces.chunk_by(|one, next| one.layer == next.layer);
        let below = below.filter(|pieces| pieces.first().is_some_and(|piece| piece.layer > layer));
        let strips = stuck.len()
            + below
                .map(|pieces| self.access().order(pieces, Side::Left, &mut terrain).stuck.len())
                .sum::<usize>();
        let (left, right) = first_run(stuck).unwrap_or((0.0, self.ground.width));
        Refusal::Closed(Closed {
            layer,
            left: Length::mm(left),
            right: Length::mm(right),
            strips,
            down_to: None,
        })
    }

    fn finished(&self, layout: &Layout, stages: Vec<Stage>, standing: &Terrain) -> PlannedRect {
        let contour = standing.corners(0.0, self.ground.width);
        let mut plan = PlannedRect {
            layer: Length::mm(self.choice.sizes.layer),
            step: Length::mm(self.choice.sizes.step),
            through: self.choice.through,
            residual: self.choice.residual,
            levels: layout.levels.clone(),
            stages,
            room: Room::Enough,
            left: Length::mm(self.ground.left_by(&contour)),
            contour,
            time: Duration::ZERO,
        };
        let cut = RectCut::of(
            plan.counts(),
            &self.blades.knife,
            &self.blades.wheel,
            &self.blades.pace,
        );
        plan.time = cut.planned_time(self.terms.work, plan.step, &self.blades.pace);
        plan
    }
}

/// Appends a stage, if it does anything; to the one before where that has the same blade.
fn push(stages: &mut Vec<Stage>, stage: Stage) {
    match (stages.last_mut(), stage) {
        (_, Stage::Slits { slits, .. }) if slits.is_empty() => {}
        (
            Some(Stage::Strips { layers, strips }),
            Stage::Strips {
                layers: more,
                strips: further,
            },
        ) => {
            *layers = *layers.start()..=*more.end();
            strips.extend(further);
        }
        (_, stage) => stages.push(stage),
    }
}

fn layers(group: &[Piece]) -> RangeInclusive<u32> {
    let first = group.first().map_or(0, |piece| piece.layer);
    let last = group.last().map_or(0, |piece| piece.layer);
    first..=last
}
