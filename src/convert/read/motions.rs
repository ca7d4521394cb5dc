//! Where the motions of a program lead.
//!
//! What a target leaves out keeps the value that it had. Positions behind axis moves are not known, for no arm is known;
//! those of relative motions are, where the one before is. Axes outside of the arm carry the work or the arm itself: while they
//! stand still they are none of a job's business, and when they move the positions mean something else.

use super::frames::Framing;
use super::{Reader, Told};
use crate::arc::CircularArc;
use crate::asked::LONGEST;
use crate::complaints;
use crate::milling::{Move, Way, Written};
use vcutc_backend_api::geometry::{Orientation, Zyx};
use vcutc_backend_api::units::Angle;
use vcutc_backend_krl::read::syntax::{
    Arc, ArcPoints, Component, Coordinates, Directions, Motion, MotionWord, Setting, SettingValue, Tail,
    Target, Value, is_same_name,
};
use vcutc_backend_krl::read::variables::Asker;
use vcutc_diagnostics::source::Span;

/// Where the tool is, as far as the program has said it.
#[derive(Debug, Default)]
pub(crate) struct Tool {
    /// What targets have said so far of the tool and of external axes.
    last: Coordinates,
    /// Where external axes are while it is led to points, and which motion said so first.
    held: Option<(Coordinates, Span)>,
    /// Where they were told to move, if that was said.
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

/// How targets are told.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Telling {
    Absolute,
    /// From where the motion begins.
    Relative(Directions),
}

impl Tool {
    /// External axes that were said, with where they stand while the tool is led to points.
    pub(crate) fn external(&self) -> Vec<(&'static str, f64)> {
        let held = self.held.as_ref();
        let stands = |(name, axis): (&'static str, Component)| Some((name, held?.0.get(axis)?));
        EXTERNAL.into_iter().filter_map(stands).collect()
    }

    /// Forgets where the tool is; external axes stay.
    fn lose(&mut self) {
        let mut left = Coordinates::default();
        for (_, axis) in EXTERNAL {
            if let Some(value) = self.last.get(axis) {
                left.set(axis, value);
            }
        }
        self.last = left;
    }

    /// The place and the angles after a target; none where not all that is needed has been said.
    fn after(&self, target: &Coordinates, telling: Telling) -> Option<Coordinates> {
        let mut after = self.last;
        match telling {
            Telling::Absolute => take(&mut after, target, |_| Some(0.0))?,
            Telling::Relative(Directions::Base) => {
                take(&mut after, target, |component| self.last.get(component))?
            }
            Telling::Relative(Directions::Tool) => {
                if Component::ANGLES
                    .iter()
                    .any(|&angle| target.get(angle).unwrap_or(0.0) != 0.0)
                {
                    return None;
                }
                let held = orientation(self.last.all(Component::ANGLES)?);
                let [x, y, z] = Component::TIP.map(|component| target.get(component).unwrap_or(0.0));
                let [x0, y0, z0] = self.last.all(Component::TIP)?;
                let along = |[a, b, c]: [f64; 3]| a * x + b * y + c * z;
                let [dx, dy, dz] = held.matrix().map(along);
                for (component, value) in Component::TIP.into_iter().zip([x0 + dx, y0 + dy, z0 + dz]) {
                    after.set(component, value);
                }
            }
        }
        Some(after)
    }
}

/// Sets the components of a target, each on top of what it is told from.
fn take(
    after: &mut Coordinates,
    target: &Coordinates,
    from: impl Fn(Component) -> Option<f64>,
) -> Option<()> {
    let components = Component::TIP.into_iter().chain(Component::ANGLES);
    for component in components.chain(Component::EXTERNAL) {
        if let Some(value) = target.get(component) {
            after.set(component, from(component)? + value);
        }
    }
    Some(())
}

/// `R = Rz(A) Ry(B) Rx(C)`, from degrees.
fn orientation([a, b, c]: [f64; 3]) -> Orientation {
    Orientation::from_zyx(Zyx {
        a: Angle::deg(a),
        b: Angle::deg(b),
        c: Angle::deg(c),
    })
}

impl Reader<'_, '_> {
    /// A motion to a point.
    pub(crate) fn motion(&mut self, asker: Asker<'_>, motion: &Motion<'_>, place: Span) {
        if self.depends(place) {
            return;
        }
        let (way, is_relative) = match motion.word {
            MotionWord::Lin | MotionWord::Slin => (Way::Straight, false),
            MotionWord::Ptp | MotionWord::Sptp => (Way::Joint, false),
            MotionWord::LinRel | MotionWord::SlinRel => (Way::Straight, true),
            MotionWord::PtpRel | MotionWord::SptpRel => (Way::Joint, true),
        };
        if is_where_it_is(&motion.target) {
            return self.milling.settings.push(place);
        }
        let framing = self.frames_of(asker, &motion.tail, way, place);
        let target = self.coordinates(asker, &motion.target);
        let Some(target) = target.filter(|target| !target.has_any(&Component::AXES)) else {
            return self.elsewhere(way, target, place);
        };
        let telling = match (is_relative, motion.tail.directions) {
            (false, _) => Telling::Absolute,
            (true, directions) => Telling::Relative(directions.unwrap_or(Directions::Base)),
        };
        let Some(after) = self.tool.after(&target, telling) else {
            return self.push(complaints::unknown_start(place));
        };
        self.arrive(after, way, &motion.tail, place);
        if let (Framing::Other, Some(made)) = (framing, self.milling.moves.last_mut()) {
            made.to = None;
            self.tool.lose();
        }
    }

    /// A motion on an arc.
    pub(crate) fn arc(&mut self, asker: Asker<'_>, arc: &Arc<'_>, place: Span) {
        if self.depends(place) {
            return;
        }
        self.frames_of(asker, &arc.tail, Way::Arc { course: None }, place);
        let telling = match arc.points {
            ArcPoints::Absolute => Telling::Absolute,
            ArcPoints::Relative => Telling::Relative(arc.tail.directions.unwrap_or(Directions::Base)),
        };
        let place_after = |target: &Target<'_>| {
            let target = self.coordinates(asker, target)?;
            self.tool.after(&target, telling)
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
        let mut course = circle([&self.tool.last, &on_the_way, &after]);
        if let Some(degrees) = arc.angle {
            let Some(circle) = course else {
                return self.push(complaints::unknown_arc(place));
            };
            let turned = circle.turned_by(Angle::deg(degrees));
            for (component, value) in Component::TIP.into_iter().zip(turned.end()) {
                after.set(component, value);
            }
            course = Some(turned);
        }
        self.arrive(after, Way::Arc { course }, &arc.tail, place);
    }

    /// Whether a motion is made is decided while the program runs: then it is told, once for what decides.
    fn depends(&mut self, place: Span) -> bool {
        let Some(fork) = self.forks.last_mut() else {
            return false;
        };
        let decides = fork.place;
        match core::mem::replace(&mut fork.told, Told::Once) {
            Told::Not => self.push(complaints::fork(place, decides)),
            Told::Once => {}
        }
        true
    }

    fn coordinates(&self, asker: Asker<'_>, target: &Target<'_>) -> Option<Coordinates> {
        match target {
            Target::Literal(coordinates) => Some(*coordinates),
            Target::Variable(variable) => self.variables.get(asker, variable),
        }
    }

    /// The tool has been led to a point.
    fn arrive(&mut self, after: Coordinates, way: Way, tail: &Tail<'_>, place: Span) {
        if let Some(far) = farthest(&after) {
            return self.push(complaints::too_far(place, far));
        }
        self.tool.last = after;
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
        let now = self.tool.last;
        let Some((held, first)) = &self.tool.held else {
            self.tool.held = Some((now, place));
            return;
        };
        let moves = EXTERNAL.into_iter().find_map(|(name, axis)| {
            // What is not said stays where it is, and nobody says where that is: 0 as in all programs that do not use it.
            let (from, to) = (held.get(axis).unwrap_or(0.0), now.get(axis).unwrap_or(0.0));
            ((to - from).abs() > STANDS).then_some((name, from, to))
        });
        if let (Some(moves), None) = (moves, self.tool.moved) {
            let first = *first;
            self.tool.moved = Some(place);
            self.push(complaints::external_axis(place, first, moves));
        }
    }

    /// The speed of a motion, with what `WITH` sets for it alone.
    fn speed_of(&mut self, tail: &Tail<'_>, place: Span) -> Option<Written> {
        let mut speed = self.speed;
        for setting in &tail.with {
            let sets_speed = setting.to.is("$VEL") || setting.to.is_field("$VEL", "CP");
            if sets_speed {
                speed = own_speed(setting).map(|value| Written { value, place });
            } else if !is_of_motions(setting) {
                self.push(complaints::with(place, setting.to.name));
            }
        }
        speed
    }

    /// A motion to axis values, or to a position that nobody knows.
    fn elsewhere(&mut self, way: Way, target: Option<Coordinates>, place: Span) {
        self.tool.lose();
        for (_, axis) in EXTERNAL {
            if let Some(value) = target.and_then(|target| target.get(axis)) {
                self.tool.last.set(axis, value);
            }
        }
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
fn farthest(place: &Coordinates) -> Option<f64> {
    let mut known = Component::TIP
        .into_iter()
        .filter_map(|component| place.get(component));
    known.find(|value| value.abs() > LONGEST)
}

/// The arc through three places, where all of them are known and lie on a circle.
fn circle(places: [&Coordinates; 3]) -> Option<CircularArc> {
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
        SettingValue::Plain(Value::Number(number)) => Some(*number),
        SettingValue::Plain(Value::Structure(fields)) => fields.iter().find_map(|field| match &field.value {
            Value::Number(number) if is_same_name(field.name, "CP") => Some(*number),
            _ => None,
        }),
        SettingValue::Plain(_) => None,
    }
}

/// Whether a value behind `WITH` is one of those that set up motions.
fn is_of_motions(setting: &Setting<'_>) -> bool {
    super::frames::SETUP
        .iter()
        .any(|name| is_same_name(setting.to.name, name))
}
