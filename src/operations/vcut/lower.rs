//! The moves of V-cutting (`docs/process.md`, "One V-cut").
//!
//! Cuts start and end an extension away from the stock, where the blade may turn. In `point` order both flanks of a V are
//! cut before the next one: there with the shank leaning left, turn about the still tip, back with the shank leaning right,
//! and over to the next V while turning back [Cui 2020]. In `layer` order all left flanks of a run come first, to and fro,
//! then all right flanks on the way back [Yu 2019]. With one feed direction only, every cut is followed by a way back over the
//! safe plane.
//!
//! A layer's cuts are numbered from left to right whatever the order in which they are made, so that a number is a place in
//! the plan. From one run to the next the blade goes over the safe plane, or where the plan says so beside the work: across
//! at the higher of both tips, and straight down to the lower one.
//!
//! Along a spine a cut is a chain through its stations, and all places beside the work are as much higher or lower as the spine is
//! there. Along a column it is a chain through the stations of its own; in a fan that is one piece.
//!
//! Where a plan is compensated, each V is cut at its offset, and so are the ways to and from it.
//!
//! From home the blade comes by a move of all axes, which alone can say how the arm is to stand there; everything after it
//! moves on straight lines.

mod course;
mod postures;
#[cfg(test)]
mod tests;

use crate::plan::route::{self, Heading, Run};
use crate::plan::{PlannedCut, PlannedVcut, Way};
use core::num::NonZeroU32;
use course::Course;
use postures::Postures;
use std::borrow::Cow;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{
    Action, FeedId, Flank, Joint, OperationId, OperationKind, OrientationId, RateId, Site, SourceRef, Switch,
};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_geometry::spine::Station;
use vcutc_job::{Direction, Order};
use vcutc_process::lower::BLEND;
use vcutc_process::posture::{Feed, Holder};
use vcutc_simulation::prove::VNumber;

/// What programs call it.
const KIND: OperationKind = OperationKind::named("rough_vcut").unwrap();

/// Appends the ops of one operation.
pub(crate) fn lower(planned: &PlannedVcut, source: SourceRef, builder: &mut ProgramBuilder) {
    let operation = builder.operation(KIND, planned.asked.blade.in_program(), source);
    if let Some(compensated) = &planned.compensation {
        let largest = compensated.by.largest();
        builder.compensated(Length::mm(largest.map_or(0.0, |(_, size)| size)));
    }
    let mut writer = Writer::new(planned, operation, builder);
    let numbers = numbers(&planned.cuts);
    let cuts = offset_cuts(planned, &numbers);
    for run in &planned.runs {
        let cuts = cuts.get(run.cuts.clone()).unwrap_or_default();
        let numbers = numbers.get(run.cuts.clone()).unwrap_or_default();
        writer.run(run, cuts, numbers);
    }
    writer.leave();
    writer.builder.op(
        Site::Operation(operation),
        Action::Ultrasonic { state: Switch::Off },
    );
}

/// The cuts with their tips where the program has them.
fn offset_cuts<'p>(planned: &'p PlannedVcut, numbers: &[VNumber]) -> Cow<'p, [PlannedCut]> {
    let Some(compensated) = &planned.compensation else {
        return Cow::Borrowed(&planned.cuts);
    };
    let each = planned.cuts.iter().zip(numbers);
    let each = each.map(|(cut, &vee)| {
        let offset = compensated.by.offset(vee);
        PlannedCut {
            tip: Point2 {
                x: grid::nearest(cut.tip.x + offset.x),
                z: grid::nearest(cut.tip.z + offset.z),
            },
            ..*cut
        }
    });
    Cow::Owned(each.collect())
}

/// Layer and number of each cut, counted from left to right in each layer.
pub(crate) fn numbers(cuts: &[PlannedCut]) -> Vec<VNumber> {
    let mut numbers = Vec::with_capacity(cuts.len());
    for layer in route::layers(cuts) {
        for (index, cut) in (0_u32..).zip(cuts.get(layer).unwrap_or_default()) {
            let counted = |before| NonZeroU32::MIN.saturating_add(before);
            numbers.push((counted(cut.layer.saturating_sub(1)), counted(index)));
        }
    }
    numbers
}

/// One pass of the blade: which flank of which V.
#[derive(Clone, Copy)]
struct Pass {
    site: Site,
    x: f64,
    z: f64,
    flank: Flank,
    swing: Angle,
    entrance: Entrance,
}

/// How the blade gets to the start of a pass.
#[derive(Clone, Copy, PartialEq)]
enum Entrance {
    /// Over the safe plane.
    Over,
    /// Straight there, beside the work.
    Straight,
    /// Across at the higher of both tips, and straight down or up, beside the work.
    Level,
}

/// Where the blade is between passes.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// Above the work, at the safe plane or wherever the program begins.
    Above,
    /// Beside the work, the tip at working height, about to cut this way if it goes on.
    Beside(Feed),
}

/// How the blade is held at the stations of a flank with that feed and swing.
struct HeldAlong {
    flank: Flank,
    feed: Feed,
    swing: Angle,
    held: Vec<(Orientation, OrientationId)>,
}

struct Writer<'b> {
    builder: &'b mut ProgramBuilder,
    operation: OperationId,
    postures: Postures,
    order: Order,
    direction: Direction,
    cut_feed: FeedId,
    travel_feed: FeedId,
    rate: RateId,
    /// The way of the tip, from beside the stock to beside it.
    course: Course,
    /// How the blade is held along flanks, each computed once.
    along: Vec<HeldAlong>,
    safe: f64,
    at: Place,
    tip: Point3,
    /// How the blade is held, first of all by the operation before.
    held: Option<Orientation>,
    /// The cut made last.
    last: Option<Site>,
    running: Switch,
}

impl<'b> Writer<'b> {
    fn new(planned: &PlannedVcut, operation: OperationId, builder: &'b mut ProgramBuilder) -> Self {
        let asked = &planned.asked;
        let stock = builder.stock();
        let extension = planned.parameters.extension.to_mm();
        let holder = Holder {
            swing: planned.parameters.swing,
            rake: asked.setup.rake.value,
            edges: asked.blade.edges,
        };
        let (cut_feed, travel_feed) = (
            builder.feed(asked.setup.cut_feed.value),
            builder.feed(asked.setup.travel_feed.value),
        );
        let rate = builder.rate(asked.setup.reorient_rate.value);
        let safe = grid::up((stock.height + asked.setup.clearance.value).to_mm());
        let held = builder.held();
        Self {
            builder,
            operation,
            postures: Postures::of(holder),
            order: planned.order,
            direction: asked.setup.direction().value,
            cut_feed,
            travel_feed,
            rate,
            course: Course::of(asked, stock, planned.parameters.extension),
            along: Vec::new(),
            safe,
            at: Place::Above,
            tip: Point3::new(0.0, -extension, safe),
            held,
            last: None,
            running: Switch::Off,
        }
    }

    /// Makes the cuts of a run.
    fn run(&mut self, run: &Run, cuts: &[PlannedCut], numbers: &[VNumber]) {
        let operation = self.operation;
        let mut places: Vec<(&PlannedCut, Site)> = cuts
            .iter()
            .zip(numbers)
            .map(|(planned, &(layer, cut))| {
                let site = Site::Cut {
                    operation,
                    layer,
                    cut,
                };
                (planned, site)
            })
            .collect();
        // The way between two neighbours is that of the right one.
        let mut ways: Vec<Way> = cuts.iter().skip(1).map(|cut| cut.way).collect();
        match run.heading {
            Heading::Rightwards => {}
            Heading::Leftwards => {
                places.reverse();
                ways.reverse();
            }
        }
        let first = match run.way {
            Way::Over => Entrance::Over,
            Way::Beside => Entrance::Level,
        };
        let between = ways.iter().map(|way| match way {
            Way::Over => Entrance::Over,
            Way::Beside => Entrance::Straight,
        });
        let entrances: Vec<Entrance> = core::iter::once(first).chain(between).collect();
        let pass = |flank| {
            move |(&(cut, site), &entrance): (&(&PlannedCut, Site), &Entrance)| Pass {
                site,
                x: cut.tip.x,
                z: cut.tip.z,
                flank,
                swing: cut.swings.of(flank),
                entrance,
            }
        };
        let lefts = places.iter().zip(&entrances).map(pass(Flank::Left));
        // A right flank of its own is cut where the blade is; on the way back, a cut is reached by the way that led from it
        // to the next one.
        let here = core::iter::repeat(&Entrance::Straight);
        match self.order {
            Order::Point => {
                let rights = places.iter().zip(here).map(pass(Flank::Right));
                for (left, right) in lefts.zip(rights) {
                    self.pass(left);
                    self.pass(right);
                }
            }
            Order::Layer => {
                lefts.for_each(|left| self.pass(left));
                let back = here.take(1).chain(entrances.iter().skip(1).rev());
                let rights = places.iter().rev().zip(back).map(pass(Flank::Right));
                rights.for_each(|right| self.pass(right));
            }
        }
    }

    /// Up from the last cut.
    fn leave(&mut self) {
        if let Some(site) = self.layer_at_hand() {
            self.retract(site);
        }
    }

    /// The layer of the cut made last.
    fn layer_at_hand(&self) -> Option<Site> {
        match self.last? {
            Site::Cut { operation, layer, .. } => Some(Site::Layer { operation, layer }),
            Site::Program | Site::Operation(_) | Site::Layer { .. } => None,
        }
    }

    /// Cuts one flank, from wherever the blade is.
    fn pass(&mut self, pass: Pass) {
        let feed = match (self.direction, self.at) {
            (Direction::Alternate, Place::Beside(feed)) => feed,
            (Direction::Alternate | Direction::Forward, _) => Feed::Forward,
            (Direction::Backward, _) => Feed::Backward,
        };
        let over = match self.direction {
            Direction::Alternate => pass.entrance == Entrance::Over,
            Direction::Forward | Direction::Backward => true,
        };
        if over && self.at != Place::Above {
            let site = self.way_up_to(pass);
            self.retract(site);
        }
        match (self.at, pass.entrance) {
            (Place::Above, _) => self.descend(pass, feed),
            (Place::Beside(_), Entrance::Level) => self.go_level(pass, feed),
            (Place::Beside(_), Entrance::Over | Entrance::Straight) => self.go_beside(pass, feed),
        }
        match self.course.stations(pass.x, feed) {
            None => self.cut_level(pass, feed),
            Some(stations) => self.cut_along(pass, feed, &stations),
        }
        self.last = Some(pass.site);
        self.at = Place::Beside(feed.reversed());
    }

    fn cut_level(&mut self, pass: Pass, feed: Feed) {
        let end = Point3 {
            y: self.course.end(pass.x, feed.reversed()).y,
            ..self.tip
        };
        self.builder.op(
            pass.site,
            Action::Cut {
                flank: pass.flank,
                to: end,
                feed: self.cut_feed,
            },
        );
        self.tip = end;
    }

    /// A cut from station to station of its spine, from the first of which the blade begins.
    fn cut_along(&mut self, pass: Pass, feed: Feed, stations: &[Station]) {
        self.builder.blend(BLEND);
        let held = self.held_along(pass, feed, stations);
        let last = stations.len() - 1;
        for (number, (station, (posture, orientation))) in stations.iter().zip(held).enumerate().skip(1) {
            let to = Point3::new(pass.x, station.y, self.course.height(pass.z, *station));
            let action = Action::Follow {
                to,
                orientation,
                via: None,
                feed: self.cut_feed,
                rate: self.rate,
                joint: if number == last {
                    Joint::Stop
                } else {
                    Joint::Through
                },
            };
            self.builder.op(pass.site, action);
            self.tip = to;
            self.held = Some(posture);
        }
    }

    /// How the blade is held at each station.
    fn held_along(
        &mut self,
        pass: Pass,
        feed: Feed,
        stations: &[Station],
    ) -> Vec<(Orientation, OrientationId)> {
        let is_same =
            |known: &&HeldAlong| (known.flank, known.feed, known.swing) == (pass.flank, feed, pass.swing);
        if let Some(known) = self.along.iter().find(is_same) {
            return known.held.clone();
        }
        let held = stations.iter().map(|station| {
            let posture = self
                .postures
                .cutting_along(pass.swing, pass.flank, feed, station.slope);
            (posture, self.builder.orientation(posture))
        });
        let held: Vec<(Orientation, OrientationId)> = held.collect();
        // Every column has slopes of its own.
        if let Course::Spine(_) = self.course {
            self.along.push(HeldAlong {
                flank: pass.flank,
                feed,
                swing: pass.swing,
                held: held.clone(),
            });
        }
        held
    }

    /// Where a pass starts.
    fn start(&self, pass: Pass, feed: Feed) -> Point3 {
        let beside = self.course.end(pass.x, feed);
        Point3::new(pass.x, beside.y, self.course.height(pass.z, beside))
    }

    /// How the blade is held there.
    fn posture(&self, pass: Pass, feed: Feed) -> Orientation {
        let slope = self.course.end(pass.x, feed).slope;
        self.postures.cutting_along(pass.swing, pass.flank, feed, slope)
    }

    /// From above the work to the start of a cut.
    fn descend(&mut self, pass: Pass, feed: Feed) {
        // The way to another V serves its layer; the way back between the flanks of one V serves that V.
        let way = match pass.site {
            Site::Cut { operation, layer, .. } if self.last != Some(pass.site) => {
                Site::Layer { operation, layer }
            }
            Site::Program | Site::Operation(_) | Site::Layer { .. } | Site::Cut { .. } => pass.site,
        };
        let start = self.start(pass, feed);
        let above = Point3 {
            z: self.safe,
            ..start
        };
        self.travel(way, above, self.posture(pass, feed));
        if self.running == Switch::Off {
            // The generator starts at the safe plane over the first cut and runs until the operation's end: it must be up
            // before the blade enters, and idling between layers costs nothing but waiting for it again would.
            self.builder.op(way, Action::Ultrasonic { state: Switch::On });
            self.builder.op(way, Action::AwaitReady);
            self.running = Switch::On;
        }
        self.lower(pass.site, start);
    }

    /// Straight down to the start of a cut.
    fn lower(&mut self, site: Site, start: Point3) {
        self.builder.op(
            site,
            Action::Approach {
                to: start,
                feed: self.travel_feed,
            },
        );
        self.tip = start;
    }

    /// From beside the work to the start of a cut on the same side.
    fn go_beside(&mut self, pass: Pass, feed: Feed) {
        let start = self.start(pass, feed);
        self.go_to(pass.site, start, self.posture(pass, feed));
    }

    fn go_to(&mut self, site: Site, start: Point3, posture: Orientation) {
        if start == self.tip {
            self.pass_between(site, posture);
            self.turn(site, posture);
        } else {
            self.travel(site, start, posture);
        }
    }

    /// From beside the work to the start of a cut of another run on the same side.
    fn go_level(&mut self, pass: Pass, feed: Feed) {
        let start = self.start(pass, feed);
        if start.z > self.tip.z {
            self.rise(pass.site, start.z);
        }
        let level = Point3 {
            z: self.tip.z.max(start.z),
            ..start
        };
        self.go_to(pass.site, level, self.posture(pass, feed));
        if start.z < self.tip.z {
            self.lower(pass.site, start);
        }
    }

    /// What the way up before a pass serves: the layer that it leaves for good or for now, else the pass.
    fn way_up_to(&self, pass: Pass) -> Site {
        let layer = |site: Site| match site {
            Site::Cut { operation, layer, .. } => Some((operation, layer)),
            Site::Program | Site::Operation(_) | Site::Layer { .. } => None,
        };
        match self.layer_at_hand() {
            Some(left) if self.last.and_then(layer) != layer(pass.site) => left,
            Some(_) | None => pass.site,
        }
    }

    fn travel(&mut self, site: Site, to: Point3, posture: Orientation) {
        self.pass_between(site, posture);
        let orientation = self.builder.orientation(posture);
        let action = if self.builder.knows_tip() {
            Action::Travel {
                to,
                orientation,
                feed: self.travel_feed,
                rate: self.rate,
            }
        } else {
            Action::AxisTravel { to, orientation }
        };
        self.builder.op(site, action);
        self.tip = to;
        self.held = Some(posture);
    }

    /// A turn that comes near half a revolution goes by way of the posture in between.
    fn pass_between(&mut self, site: Site, posture: Orientation) {
        if let Some(between) = self.held.and_then(|held| self.postures.by_way_of(held, posture)) {
            self.turn(site, between);
        }
    }

    fn turn(&mut self, site: Site, posture: Orientation) {
        if self.held != Some(posture) {
            let to = self.builder.orientation(posture);
            self.builder.op(site, Action::Turn { to, rate: self.rate });
            self.held = Some(posture);
        }
    }

    /// Straight up to the safe plane.
    fn retract(&mut self, site: Site) {
        self.rise(site, self.safe);
        self.at = Place::Above;
    }

    /// Straight up.
    fn rise(&mut self, site: Site, z: f64) {
        let to = Point3 { z, ..self.tip };
        self.builder.op(
            site,
            Action::Retract {
                to,
                feed: self.travel_feed,
            },
        );
        self.tip = to;
    }
}
