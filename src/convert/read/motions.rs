//! Where the motions of a program lead.
//!
//! What a target leaves out keeps the value that it had. Positions after axis moves are not known, because no
//! arm is known; those of relative motions are, where the one before is. Axes outside of the arm carry the
//! work or the arm itself: while they stand still they do not matter to a job, and when they move the
//! positions mean something else.

use super::frames::Framing;
use super::{Reader, Reported, is_setting};
use crate::asked::LONGEST;
use crate::complaints;
use crate::milling::{Move, Way, Written};
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::units::Angle;
use vcutc_backend_krl::interpreter::Context;
use vcutc_backend_krl::interpreter::position::{Position, orientation};
use vcutc_backend_krl::interpreter::speeds::{Velocity, velocities};
use vcutc_backend_krl::syntax::{
    Arc, Component, Coordinates, Directions, Motion, Path, Points, Setting, SettingValue, Tail, Target,
    is_same_name,
};
use vcutc_diagnostics::source::Span;

/// What external axes do.
#[derive(Debug, Default)]
pub(crate) struct ExternalAxes {
    /// Where they are while the tool is led to points, and which motion said so first.
    held: Option<(Position, Span)>,
    /// Where they were commanded to move, if the program states it.
    moved: Option<Span>,
}

/// Names of external axes.
const EXTERNAL: [(&str, Component); 6] = [
    ("E1", Component::E1),
    ("E2", Component::E2),
    ("E3", Component::E3),
    ("E4", Component::E4),
    ("E5", Component::E5),
    ("E6", Component::E6),
];

/// How far an external axis may stray and still stand, in mm or degrees: programs are printed with two or three decimals.
const STANDS: f64 = 0.01;

impl ExternalAxes {
    /// External axes that were said, with where they stand while the tool is led to points.
    pub(crate) fn standing(&self) -> Vec<(&'static str, f64)> {
        let held = self.held.as_ref();
        let stands = |(name, axis): (&'static str, Component)| Some((name, held?.0.get(axis)?));
        EXTERNAL.into_iter().filter_map(stands).collect()
    }
}

impl Reader<'_> {
    /// A motion to a point.
    pub(crate) fn motion(&mut self, context: Context<'_>, motion: &Motion<'_>, place: Span) {
        if self.depends(place) {
            return;
        }
        let way = match motion.path {
            Path::Straight => Way::Straight,
            Path::Axes => Way::Joint,
        };
        if is_where_it_is(&motion.target) {
            return self.milling.settings.push(place);
        }
        let framing = self.frames_of(context, &motion.tail, way, place);
        let target = self.state.coordinates(context, &motion.target);
        let Some(target) = target.filter(|target| !target.has_any(&Component::AXES)) else {
            return self.elsewhere(way, target, place);
        };
        let Some(after) = self.at_pose(&target, motion.points, &motion.tail) else {
            return self.push(complaints::unknown_start(place));
        };
        self.arrive(after, way, &motion.tail, place);
        if let (Framing::Other, Some(made)) = (framing, self.milling.moves.last_mut()) {
            made.to = None;
            self.state.position = self.state.position.lost();
        }
    }

    /// Where a target leads.
    fn at_pose(&self, target: &Coordinates, points: Points, tail: &Tail<'_>) -> Option<Position> {
        let directions = tail.directions.unwrap_or(Directions::Base);
        self.state.position.at_pose(target, points, directions)
    }

    /// A motion on an arc.
    pub(crate) fn arc(&mut self, context: Context<'_>, arc: &Arc<'_>, place: Span) {
        if self.depends(place) {
            return;
        }
        self.frames_of(context, &arc.tail, Way::Arc { course: None }, place);
        let place_after = |target: &Target<'_>| {
            let target = self.state.coordinates(context, target)?;
            self.at_pose(&target, arc.points, &arc.tail)
        };
        let (Some(on_the_way), Some(mut after)) = (place_after(&arc.through), place_after(&arc.target))
        else {
            return self.push(complaints::unknown_end(
                place,
                "a point of this arc is not known: it has a name that is not declared in the files given, or leaves a coordinate out",
            ));
        };
        if let Some(far) = farthest(&on_the_way).or_else(|| farthest(&after)) {
            return self.push(complaints::too_far(place, far));
        }
        let mut course = circle([&self.state.position, &on_the_way, &after]);
        if let Some(degrees) = arc.angle {
            let Some(circle) = course else {
                return self.push(complaints::unknown_arc(place));
            };
            let turned = circle.turned_by(Angle::deg(degrees));
            after.set_tip(turned.end());
            course = Some(turned);
        }
        self.arrive(after, Way::Arc { course }, &arc.tail, place);
    }

    /// Whether a motion is made is decided while the program runs: then it is reported, once for what decides.
    fn depends(&mut self, place: Span) -> bool {
        let Some(fork) = self.forks.last_mut() else {
            return false;
        };
        let decides = fork.place;
        match core::mem::replace(&mut fork.reported, Reported::Once) {
            Reported::Not => self.push(complaints::fork(place, decides)),
            Reported::Once => {}
        }
        true
    }

    /// The tool has been led to a point.
    fn arrive(&mut self, after: Position, way: Way, tail: &Tail<'_>, place: Span) {
        if let Some(far) = farthest(&after) {
            return self.push(complaints::too_far(place, far));
        }
        self.state.position = after;
        let to = after.all(Component::TIP);
        match way {
            Way::Straight | Way::Arc { .. } => {
                self.stand_still(place);
                if to.is_none() {
                    self.push(complaints::unknown_end(
                        place,
                        "not all of X, Y and Z have been said so far",
                    ));
                }
            }
            Way::Joint => {}
        }
        let attitude = after.all(Component::ANGLES).map(orientation);
        let speed = self.speed_of(tail, place);
        self.milling.moves.push(Move {
            place,
            way,
            to,
            attitude,
            speed,
        });
    }

    /// External axes have to stand while the tool is led.
    fn stand_still(&mut self, place: Span) {
        let now = self.state.position;
        let Some((held, first)) = &self.external.held else {
            self.external.held = Some((now, place));
            return;
        };
        let moves = EXTERNAL.into_iter().find_map(|(name, axis)| {
            // What is not said stays where it is, and the program does not say where that is: 0 as in all
            // programs that do not use it.
            let (from, to) = (held.get(axis).unwrap_or(0.0), now.get(axis).unwrap_or(0.0));
            ((to - from).abs() > STANDS).then_some((name, from, to))
        });
        if let (Some(moves), None) = (moves, self.external.moved) {
            let first = *first;
            self.external.moved = Some(place);
            self.push(complaints::external_axis(place, first, moves));
        }
    }

    /// The speed of a motion, with what `WITH` sets for it alone.
    fn speed_of(&mut self, tail: &Tail<'_>, place: Span) -> Option<Written> {
        let mut speed = self.speed;
        for setting in &tail.with {
            if setting.to.is("$VEL") || setting.to.is_field("$VEL", "CP") {
                speed = own_speed(setting).map(|value| Written { value, place });
            } else if !is_setting(setting.to.name) {
                self.push(complaints::with(place, setting.to.name));
            }
        }
        speed
    }

    /// A motion to axis values, or to a position that is not known.
    fn elsewhere(&mut self, way: Way, target: Option<Coordinates>, place: Span) {
        let position = &mut self.state.position;
        *position = target.map_or(position.lost(), |target| position.at_axes(&target));
        if target.is_some() || way == Way::Joint {
            self.milling.axis_moves += 1;
            self.milling.settings.push(place);
            self.milling.moves.push(Move {
                place,
                way: Way::Joint,
                to: None,
                attitude: None,
                speed: self.speed,
            });
        } else {
            self.push(complaints::unknown_end(
                place,
                "no position of this name is declared in the files given, or it was changed in a way that is not followed",
            ));
        }
    }
}

/// `PTP $POS_ACT`, with which inline forms go to where the robot is.
fn is_where_it_is(target: &Target<'_>) -> bool {
    match target {
        Target::Literal(_) => false,
        Target::Variable(variable) => ["$POS_ACT", "$AXIS_ACT"].iter().any(|name| variable.is(name)),
    }
}

/// A coordinate that no cell holds, in mm.
fn farthest(place: &Position) -> Option<f64> {
    let mut known = Component::TIP
        .into_iter()
        .filter_map(|component| place.get(component));
    known.find(|value| value.abs() > LONGEST)
}

/// The arc through three places, where all of them are known and lie on a circle.
fn circle(places: [&Position; 3]) -> Option<CircularArc> {
    let [from, through, to] = places.map(|place| place.all(Component::TIP));
    CircularArc::through([from?, through?, to?])
}

/// `$VEL.CP=0.2`, `$VEL={CP 0.2}`, `$VEL=SVEL_CP(0.2, , LCPDAT1)`.
fn own_speed(setting: &Setting<'_>) -> Option<f64> {
    match &setting.value {
        SettingValue::Function { name, arguments } if is_same_name(name, "SVEL_CP") => arguments
            .split(',')
            .next()?
            .trim()
            .parse()
            .ok()
            .filter(|speed: &f64| speed.is_finite()),
        SettingValue::Function { .. } => None,
        SettingValue::Plain(value) => velocities(&setting.to, value)?
            .find_map(|(velocity, number)| number.filter(|_| velocity == Some(Velocity::Path))),
    }
}
