//! The moves of rectangular roughing (`docs/process.md`, "Rectangular roughing").
//!
//! Both blades cut to and fro along y. They begin and end beside the work, far enough out that they may turn there: the shank of
//! either leans along its feed, so between two cuts it goes over to the other side. From one stage to the next the blade goes up,
//! generator and spindle stop, and another blade is put in.
//!
//! In each layer slits are numbered from left to right, and after them strips, whatever the order in which they are cut. A slit
//! through several layers belongs to the highest of them.

use crate::asked::RoughRect;
use crate::decided::Planned;
use crate::plan::{PlannedRect, Slit, Stage, Strip};
use core::num::NonZeroU32;
use std::collections::BTreeMap;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{
    Action, Edges, FeedId, Flank, Joint, OperationId, OperationKind, RateId, Site, SourceRef, Switch,
};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_process::posture::{Feed, Holder};

/// What programs call it.
const KIND: OperationKind = OperationKind::named("rough_rect").unwrap();

/// Appends the ops of one operation.
pub(crate) fn lower(planned: &Planned, source: SourceRef, builder: &mut ProgramBuilder) {
    let asked = &planned.asked;
    let operation = builder.operation(KIND, asked.blade.in_program(), source);
    let numbers = Numbers::of(&planned.plan);
    for stage in &planned.plan.stages {
        match stage {
            Stage::Slits { layers, slits } => {
                builder.change(asked.blade.in_program());
                let held = Held::for_slits(planned, builder);
                let mut writer = Writer::new(planned, operation, held, builder);
                let layer = *layers.start();
                for slit in slits {
                    writer.slit(slit, layer, numbers.slit(layer, slit));
                }
                writer.leave();
            }
            Stage::Strips { strips, .. } => {
                builder.change(asked.disc.in_program());
                let held = Held::for_strips(planned, builder);
                let mut writer = Writer::new(planned, operation, held, builder);
                for strip in strips {
                    writer.strip(strip, numbers.strip(strip));
                }
                writer.leave();
            }
        }
    }
}

/// A place in the plan: a layer, and an x in nanometres.
type Place = (u32, i64);

/// The number of each slit and each strip in its layer.
pub(crate) struct Numbers {
    slits: BTreeMap<Place, NonZeroU32>,
    strips: BTreeMap<Place, NonZeroU32>,
}

impl Numbers {
    pub(crate) fn of(plan: &PlannedRect) -> Self {
        let slits = numbered(slits(plan).map(|(layer, slit)| place(layer, slit.x)), |_| 0);
        let before = |layer: u32| slits.range((layer, i64::MIN)..=(layer, i64::MAX)).count();
        let strips = plan.strips().map(|strip| place(strip.layer, strip.left));
        let strips = numbered(strips, before);
        Self { slits, strips }
    }

    fn slit(&self, layer: u32, slit: &Slit) -> NonZeroU32 {
        let number = self.slits.get(&place(layer, slit.x));
        number.copied().unwrap_or(NonZeroU32::MIN)
    }

    fn strip(&self, strip: &Strip) -> NonZeroU32 {
        let number = self.strips.get(&place(strip.layer, strip.left));
        number.copied().unwrap_or(NonZeroU32::MIN)
    }
}

/// Numbers places in each layer from left to right, after so many that come before.
fn numbered(
    places: impl Iterator<Item = Place>,
    before: impl Fn(u32) -> usize,
) -> BTreeMap<Place, NonZeroU32> {
    let sorted: std::collections::BTreeSet<Place> = places.collect();
    let mut numbers = BTreeMap::new();
    let (mut layer, mut count) = (0, 0);
    for at in sorted {
        if at.0 != layer {
            (layer, count) = (at.0, before(at.0));
        }
        let index = u32::try_from(count).unwrap_or(u32::MAX);
        numbers.insert(at, NonZeroU32::MIN.saturating_add(index));
        count += 1;
    }
    numbers
}

/// The slits of a plan with their layers.
pub(crate) fn slits(plan: &PlannedRect) -> impl Iterator<Item = (u32, &Slit)> {
    plan.stages.iter().flat_map(|stage| match stage {
        Stage::Slits { layers, slits } => {
            let layer = *layers.start();
            slits.iter().map(move |slit| (layer, slit)).collect::<Vec<_>>()
        }
        Stage::Strips { .. } => Vec::new(),
    })
}

fn place(layer: u32, x: f64) -> Place {
    (layer, (x * 1e6).round() as i64)
}

/// How a blade of a stage is held, and how far beside the work it turns.
struct Held {
    holder: Holder,
    feed: FeedId,
    extension: Length,
    /// How far it reaches below its tip while it turns.
    hang: Length,
    drives: &'static [Drive],
}

/// What makes a blade cut.
#[derive(Clone, Copy)]
enum Drive {
    Spindle,
    Generator,
}

impl Drive {
    const fn switched(self, state: Switch) -> Action {
        match self {
            Self::Spindle => Action::Spin { state },
            Self::Generator => Action::Ultrasonic { state },
        }
    }
}

impl Held {
    fn for_slits(planned: &Planned, builder: &mut ProgramBuilder) -> Self {
        Self {
            holder: slit_holder(&planned.asked),
            feed: builder.feed(planned.asked.setup.cut_feed.value),
            extension: planned.extensions.slits,
            hang: Length::ZERO,
            drives: &[Drive::Generator],
        }
    }

    fn for_strips(planned: &Planned, builder: &mut ProgramBuilder) -> Self {
        Self {
            holder: strip_holder(&planned.asked),
            feed: builder.feed(planned.asked.free_feed.value),
            extension: planned.extensions.strips,
            hang: planned.asked.disc.radius.value * planned.asked.lead.value.sin(),
            drives: &[Drive::Spindle, Drive::Generator],
        }
    }
}

/// How the straight blade is held: upright across the feed.
pub(crate) const fn slit_holder(asked: &RoughRect) -> Holder {
    Holder {
        swing: Angle::ZERO,
        rake: asked.setup.rake.value,
        edges: asked.blade.edges,
    }
}

/// How the disc is held: its axis leans along the feed by the lead.
pub(crate) fn strip_holder(asked: &RoughRect) -> Holder {
    Holder {
        swing: Angle::ZERO,
        rake: Angle::deg(90.0) - asked.lead.value,
        edges: Edges::Double,
    }
}

/// A cut along y: where its tip runs.
struct Pass {
    site: Site,
    at: Point2,
    cut: Cut,
}

#[derive(Clone, Copy)]
enum Cut {
    Slit,
    Strip,
}

/// Where the blade is between cuts.
#[derive(Clone, Copy)]
enum At {
    Above,
    /// Beside the work, about to cut this way.
    Beside(Feed),
}

/// Writes one stage.
struct Writer<'b> {
    builder: &'b mut ProgramBuilder,
    operation: OperationId,
    held: Held,
    travel: FeedId,
    rate: RateId,
    /// y of the tip in front of the stock and beyond it, and z of the safe plane.
    front: f64,
    back: f64,
    safe: f64,
    at: At,
    tip: Point3,
    layer: Option<Site>,
}

impl<'b> Writer<'b> {
    fn new(planned: &Planned, operation: OperationId, held: Held, builder: &'b mut ProgramBuilder) -> Self {
        let setup = &planned.asked.setup;
        let stock = builder.stock();
        let out = held.extension.to_mm();
        let above = stock.height + setup.clearance.value + held.hang;
        let safe = grid::up(above.to_mm());
        Self {
            travel: builder.feed(setup.travel_feed.value),
            rate: builder.rate(setup.reorient_rate.value),
            front: -grid::up(out),
            back: grid::up(stock.depth.to_mm() + out),
            safe,
            at: At::Above,
            tip: Point3::new(0.0, -out, safe),
            layer: None,
            builder,
            operation,
            held,
        }
    }

    fn slit(&mut self, slit: &Slit, layer: u32, number: NonZeroU32) {
        let site = self.site(layer, number);
        let at = Point2::new(slit.x, slit.bottom);
        self.pass(&Pass {
            site,
            at,
            cut: Cut::Slit,
        });
    }

    fn strip(&mut self, strip: &Strip, number: NonZeroU32) {
        let site = self.site(strip.layer, number);
        let at = strip.centre;
        self.pass(&Pass {
            site,
            at,
            cut: Cut::Strip,
        });
    }

    fn site(&self, layer: u32, cut: NonZeroU32) -> Site {
        Site::Cut {
            operation: self.operation,
            layer: NonZeroU32::MIN.saturating_add(layer.saturating_sub(1)),
            cut,
        }
    }

    /// Cuts from wherever the blade is.
    fn pass(&mut self, pass: &Pass) {
        let feed = match self.at {
            At::Above => {
                self.come_down(pass);
                Feed::Forward
            }
            At::Beside(feed) => {
                self.go_beside(pass, feed);
                feed
            }
        };
        let y = match feed {
            Feed::Forward => self.back,
            Feed::Backward => self.front,
        };
        let to = Point3 { y, ..self.tip };
        let orientation = self.builder.orientation(self.posture(feed));
        let action = match pass.cut {
            Cut::Slit => Action::Cut {
                flank: Flank::Left,
                to,
                feed: self.held.feed,
            },
            Cut::Strip => Action::Follow {
                to,
                orientation,
                via: None,
                feed: self.held.feed,
                rate: self.rate,
                joint: Joint::Stop,
            },
        };
        self.go(pass.site, to, action);
        self.at = At::Beside(feed.reversed());
        self.layer = layer_of(pass.site);
    }

    /// From wherever the program is to the start of the first cut of the stage.
    fn come_down(&mut self, pass: &Pass) {
        let way = layer_of(pass.site).unwrap_or(pass.site);
        let above = Point3::new(pass.at.x, self.front, self.safe);
        self.travel(way, above, Feed::Forward);
        for drive in self.held.drives {
            self.builder.op(way, drive.switched(Switch::On));
        }
        self.builder.op(way, Action::AwaitReady);
        let start = Point3 {
            z: pass.at.z,
            ..above
        };
        let feed = self.travel;
        self.go(pass.site, start, Action::Approach { to: start, feed });
    }

    /// Beside the work to the start of the next cut: up if it begins higher, across, and down if it begins lower.
    fn go_beside(&mut self, pass: &Pass, feed: Feed) {
        let travel = self.travel;
        let level = self.tip.z.max(pass.at.z);
        if level > self.tip.z {
            let to = Point3 { z: level, ..self.tip };
            self.go(pass.site, to, Action::Retract { to, feed: travel });
        }
        let across = Point3::new(pass.at.x, self.tip.y, level);
        self.travel(pass.site, across, feed);
        if pass.at.z < level {
            let to = Point3 {
                z: pass.at.z,
                ..across
            };
            self.go(pass.site, to, Action::Approach { to, feed: travel });
        }
    }

    /// A straight way, with the blade turned for this feed. Where it comes near half a revolution it goes by a posture between.
    fn travel(&mut self, site: Site, to: Point3, feed: Feed) {
        let posture = self.posture(feed);
        if let Some(held) = self.builder.held()
            && let Some(between) = self.held.holder.by_way_of(held, posture)
        {
            let to = self.builder.orientation(between);
            self.builder.op(site, Action::Turn { to, rate: self.rate });
        }
        let orientation = self.builder.orientation(posture);
        let action = if self.builder.knows_tip() {
            Action::Travel {
                to,
                orientation,
                feed: self.travel,
                rate: self.rate,
            }
        } else {
            Action::AxisTravel { to, orientation }
        };
        self.go(site, to, action);
    }

    fn go(&mut self, site: Site, to: Point3, action: Action) {
        self.builder.op(site, action);
        self.tip = to;
    }

    fn posture(&self, feed: Feed) -> Orientation {
        // A slit is the left flank of a V without swing.
        self.held.holder.cutting(Flank::Left, feed)
    }

    /// Straight up to the safe plane; what drives the blade stops.
    fn leave(&mut self) {
        let site = self.layer.unwrap_or(Site::Operation(self.operation));
        if let At::Beside(_) = self.at {
            let to = Point3 {
                z: self.safe,
                ..self.tip
            };
            let feed = self.travel;
            self.go(site, to, Action::Retract { to, feed });
        }
        for drive in self.held.drives {
            let off = drive.switched(Switch::Off);
            self.builder.op(Site::Operation(self.operation), off);
        }
    }
}

/// The layer that a cut belongs to.
const fn layer_of(site: Site) -> Option<Site> {
    match site {
        Site::Cut { operation, layer, .. } => Some(Site::Layer { operation, layer }),
        Site::Program | Site::Operation(_) | Site::Layer { .. } => None,
    }
}
