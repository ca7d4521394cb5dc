//! Cuts along y, to and fro. Each begins and ends beside the work, far enough out that the blade may turn there; from one to the
//! next the blade goes up, across and down beside the work. With one feed direction only, it goes back over the safe plane.

use crate::pen::{Pace, Stretch};
use crate::posture::{Feed, Holder};
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{Action, FeedId, Flank, Joint, OperationId, RateId, Site, Switch};
use vcutc_backend_api::units::{Length, Speed};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_job::{Direction, Setup};

/// What makes a blade cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
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

/// What the cuts with one blade have in common.
#[derive(Clone, Copy, Debug)]
pub struct Stage {
    pub operation: OperationId,
    /// The speed in the material.
    pub feed: FeedId,
    /// How far beside the work the blade turns.
    pub extension: Length,
    /// How far it reaches below its tip while it turns.
    pub hang: Length,
    /// What makes it cut, in the order in which it is started.
    pub drives: &'static [Drive],
}

/// A cut along y: where its tip runs, and how the blade is held.
#[derive(Clone, Copy, Debug)]
pub struct Pass {
    pub site: Site,
    /// The tip in the section, in mm.
    pub at: Point2,
    pub holder: Holder,
    /// The flank whose posture the blade has.
    pub flank: Flank,
    pub motion: Motion,
}

/// What a cut is in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// A flank.
    Cut,
    /// A piece of a chain.
    Follow,
}

/// A pose on a chain: where the tip is, and how the blade is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    pub tip: Point3,
    pub held: Orientation,
    /// How the piece ends that leads here.
    pub joint: Joint,
}

/// A piece of a path at a speed of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    pub to: Point3,
    /// A point on the way of an arc; none of a line.
    pub via: Option<Point3>,
    /// How the blade is held there.
    pub held: Orientation,
    pub feed: FeedId,
    pub joint: Joint,
}

/// The speeds of stretches.
#[derive(Clone, Copy, Debug)]
pub struct Paces {
    travel: FeedId,
    plunge: FeedId,
    cut: FeedId,
}

impl Paces {
    /// A stretch as a piece of a path, at whose end the blade is held so.
    #[must_use]
    pub const fn step(self, stretch: &Stretch, held: Orientation) -> Step {
        Step {
            to: stretch.to,
            via: stretch.via,
            held,
            feed: match stretch.pace {
                Pace::Travel => self.travel,
                Pace::Plunge => self.plunge,
                Pace::Cut => self.cut,
            },
            joint: stretch.joint,
        }
    }
}

/// Where a chain begins, and how the blade gets there.
#[derive(Clone, Copy, Debug)]
pub struct Entrance<'e> {
    pub tip: Point3,
    /// How the blade is held there.
    pub held: Orientation,
    /// Postures through which it turns before, where one turn would not say which way round.
    pub by_way_of: &'e [Orientation],
}

impl Entrance<'_> {
    /// With one turn.
    #[must_use]
    pub const fn of(tip: Point3, held: Orientation) -> Self {
        Self {
            tip,
            held,
            by_way_of: &[],
        }
    }
}

/// Where the blade is between cuts.
#[derive(Clone, Copy)]
enum At {
    Above,
    /// Beside the work, about to cut this way.
    Beside(Feed),
    /// Beside the work, after a chain.
    AfterChain,
}

impl Pass {
    fn posture(&self, feed: Feed) -> Orientation {
        self.holder.cutting(self.flank, feed)
    }
}

/// Writes the cuts with one blade.
pub struct Writer<'b> {
    builder: &'b mut ProgramBuilder,
    stage: Stage,
    travel: FeedId,
    rate: RateId,
    /// y of the tip in front of the stock and beyond it, and z of the safe plane.
    front: f64,
    back: f64,
    safe: f64,
    direction: Direction,
    at: At,
    tip: Point3,
    layer: Option<Site>,
}

impl<'b> Writer<'b> {
    pub fn new(stage: Stage, setup: &Setup, builder: &'b mut ProgramBuilder) -> Self {
        let stock = builder.stock();
        let out = stage.extension.to_mm();
        let above = stock.height + setup.clearance.value + stage.hang;
        let safe = grid::up(above.to_mm());
        Self {
            travel: builder.feed(setup.travel_feed.value),
            rate: builder.rate(setup.reorient_rate.value),
            front: -grid::up(out),
            back: grid::up(stock.depth.to_mm() + out),
            safe,
            direction: setup.direction().value,
            at: At::Above,
            tip: Point3::new(0.0, -out, safe),
            layer: None,
            builder,
            stage,
        }
    }

    /// Cuts from wherever the blade is.
    pub fn pass(&mut self, pass: &Pass) {
        let feed = self.feed();
        match self.at {
            At::Above => self.begin(pass, feed),
            At::Beside(here) if here == feed => self.go_beside(pass, feed),
            At::Beside(_) | At::AfterChain => {
                self.rise();
                self.come_down(pass, feed);
            }
        }
        let y = match feed {
            Feed::Forward => self.back,
            Feed::Backward => self.front,
        };
        let to = Point3 { y, ..self.tip };
        let orientation = self.builder.orientation(pass.posture(feed));
        let action = match pass.motion {
            Motion::Cut => Action::Cut {
                flank: pass.flank,
                to,
                feed: self.stage.feed,
            },
            Motion::Follow => Action::Follow {
                to,
                orientation,
                via: None,
                feed: self.stage.feed,
                rate: self.rate,
                joint: Joint::Stop,
            },
        };
        self.go(pass.site, to, action);
        self.at = At::Beside(feed.reversed());
        self.layer = layer_of(pass.site);
    }

    /// A chain through all of its poses, of which the first and the last are beside the work, over the safe plane from wherever the blade
    /// is.
    pub fn chain(&mut self, site: Site, poses: &[Stand]) {
        let Some((first, rest)) = poses.split_first() else {
            return;
        };
        self.begin_chain(site, Entrance::of(first.tip, first.held));
        for stand in rest {
            let action = Action::Follow {
                to: stand.tip,
                orientation: self.builder.orientation(stand.held),
                via: None,
                feed: self.stage.feed,
                rate: self.rate,
                joint: stand.joint,
            };
            self.go(site, stand.tip, action);
        }
        self.end_chain(site);
    }

    /// A chain of lines and arcs from a place in the air, over the safe plane from wherever the tool is. It ends where the way up is
    /// free.
    pub fn path(&mut self, site: Site, from: Entrance<'_>, steps: &[Step]) {
        self.begin_chain(site, from);
        for step in steps {
            let action = Action::Follow {
                to: step.to,
                orientation: self.builder.orientation(step.held),
                via: step.via.map(|via| self.builder.via(via)),
                feed: step.feed,
                rate: self.rate,
                joint: step.joint,
            };
            self.go(site, step.to, action);
        }
        self.end_chain(site);
    }

    /// The speeds of an operation whose blade goes down into the material.
    pub fn paces(&mut self, setup: &Setup, plunge: Speed) -> Paces {
        let mut feed = |speed| self.builder.feed(speed);
        Paces {
            travel: feed(setup.travel_feed.value),
            plunge: feed(plunge),
            cut: feed(setup.cut_feed.value),
        }
    }

    /// Over the safe plane to where a chain begins, and straight down.
    fn begin_chain(&mut self, site: Site, from: Entrance<'_>) {
        let Entrance { tip, held, by_way_of } = from;
        let above = Point3 { z: self.safe, ..tip };
        match self.at {
            At::Above => {
                let way = layer_of(site).unwrap_or(site);
                self.rise_to_turn(way);
                self.turn(way, by_way_of);
                self.travel_to(way, above, held);
                self.start(way);
            }
            At::Beside(_) | At::AfterChain => {
                self.rise();
                self.turn(site, by_way_of);
                self.travel_to(site, above, held);
            }
        }
        let feed = self.travel;
        self.go(site, tip, Action::Approach { to: tip, feed });
    }

    /// Turns from posture to posture, if it is known where the blade is.
    fn turn(&mut self, site: Site, postures: &[Orientation]) {
        if !self.builder.knows_tip() {
            return;
        }
        for posture in postures {
            let to = self.builder.orientation(*posture);
            self.builder.op(site, Action::Turn { to, rate: self.rate });
        }
    }

    fn end_chain(&mut self, site: Site) {
        self.at = At::AfterChain;
        self.layer = layer_of(site);
    }

    /// The way of the next cut.
    fn feed(&self) -> Feed {
        match (self.direction, self.at) {
            (Direction::Alternate, At::Beside(feed)) => feed,
            (Direction::Alternate, At::Above | At::AfterChain) | (Direction::Forward, _) => Feed::Forward,
            (Direction::Backward, _) => Feed::Backward,
        }
    }

    /// From wherever the program is to the start of the first cut of the stage.
    fn begin(&mut self, pass: &Pass, feed: Feed) {
        let way = layer_of(pass.site).unwrap_or(pass.site);
        self.rise_to_turn(way);
        self.travel(way, self.above(pass, feed), pass, feed);
        self.start(way);
        self.approach(pass);
    }

    /// Starts what drives the blade.
    fn start(&mut self, way: Site) {
        for drive in self.stage.drives {
            self.builder.op(way, drive.switched(Switch::On));
        }
        self.builder.op(way, Action::AwaitReady);
    }

    /// An operation before with the same blade may have left it where it has no room to turn: then straight up first.
    fn rise_to_turn(&mut self, way: Site) {
        let Some(tip) = self.builder.tip() else { return };
        let top = self.builder.stock().height;
        if Length::mm(tip.z) - self.stage.hang < top && tip.z < self.safe {
            let to = Point3 { z: self.safe, ..tip };
            let feed = self.travel;
            self.go(way, to, Action::Retract { to, feed });
        }
    }

    /// On the safe plane to the start of a cut.
    fn come_down(&mut self, pass: &Pass, feed: Feed) {
        self.travel(pass.site, self.above(pass, feed), pass, feed);
        self.approach(pass);
    }

    /// The place on the safe plane above the start of a cut.
    const fn above(&self, pass: &Pass, feed: Feed) -> Point3 {
        let y = match feed {
            Feed::Forward => self.front,
            Feed::Backward => self.back,
        };
        Point3::new(pass.at.x, y, self.safe)
    }

    fn approach(&mut self, pass: &Pass) {
        let to = Point3 {
            z: pass.at.z,
            ..self.tip
        };
        let feed = self.travel;
        self.go(pass.site, to, Action::Approach { to, feed });
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
        self.travel(pass.site, across, pass, feed);
        if pass.at.z < level {
            let to = Point3 {
                z: pass.at.z,
                ..across
            };
            self.go(pass.site, to, Action::Approach { to, feed: travel });
        }
    }

    /// A straight way, with the blade turned for this feed. Where it comes near half a revolution it goes by a posture between.
    fn travel(&mut self, site: Site, to: Point3, pass: &Pass, feed: Feed) {
        let posture = pass.posture(feed);
        if let Some(held) = self.builder.held()
            && let Some(between) = pass.holder.by_way_of(held, posture)
        {
            let to = self.builder.orientation(between);
            self.builder.op(site, Action::Turn { to, rate: self.rate });
        }
        self.travel_to(site, to, posture);
    }

    /// A straight way, with the blade turned to a posture that is less than half a revolution away.
    fn travel_to(&mut self, site: Site, to: Point3, posture: Orientation) {
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

    /// Straight up to the safe plane.
    fn rise(&mut self) {
        let site = self.layer.unwrap_or(Site::Operation(self.stage.operation));
        let to = Point3 {
            z: self.safe,
            ..self.tip
        };
        let feed = self.travel;
        self.go(site, to, Action::Retract { to, feed });
    }

    /// Straight up to the safe plane; what drives the blade stops.
    pub fn leave(&mut self) {
        match self.at {
            At::Above => {}
            At::Beside(_) | At::AfterChain => self.rise(),
        }
        for drive in self.stage.drives {
            let off = drive.switched(Switch::Off);
            self.builder.op(Site::Operation(self.stage.operation), off);
        }
    }
}

impl Writer<'_> {
    /// As [`Writer::leave`], and turns on from posture to posture up there: another operation finds the blade as it holds it.
    pub fn leave_turned(&mut self, postures: &[Orientation]) {
        self.leave();
        self.turn(Site::Operation(self.stage.operation), postures);
    }
}

/// The layer that a cut belongs to.
const fn layer_of(site: Site) -> Option<Site> {
    match site {
        Site::Cut { operation, layer, .. } => Some(Site::Layer { operation, layer }),
        Site::Program | Site::Operation(_) | Site::Layer { .. } => None,
    }
}
