//! The data of a program: what names stand for, and values as the types that moves take.

use super::sentence::Value;
use crate::speeds::EXTERNAL;
use std::collections::{BTreeMap, BTreeSet};
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{AxisValues, Inertia, Load, ToolId};
use vcutc_backend_api::units::Mass;

/// The number that stands for an external axis that is not there [A-INS].
const NO_AXIS: f64 = 9e9;

/// How far the length of a quaternion may be from 1; controllers refuse more.
const OFF_LENGTH: f64 = 1e-5;

/// Where a name is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Scope {
    Task,
    /// In a module, counted from 0.
    Module(usize),
    /// In a routine, counted from 0 over all modules.
    Routine(usize),
}

/// What data are.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Datum {
    /// A value of any type but the two below; each use says of which.
    Value(Value),
    /// A tool of the machine.
    Tool(ToolId),
    WorkObject,
    /// Something whose value is not known.
    Unclear,
}

/// The data of a program by their names, which are in upper case.
#[derive(Debug, Default)]
pub(super) struct Data {
    all: BTreeMap<Scope, BTreeMap<String, Datum>>,
    /// Where each name was declared first.
    homes: BTreeMap<String, Scope>,
    /// Names that stand for something else elsewhere. Which of them an aggregate of a third place means depends on rules that
    /// are not modelled here, so nothing is said of them.
    ambiguous: BTreeSet<String>,
}

static UNCLEAR: Datum = Datum::Unclear;

/// Where names are looked up: the innermost first.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<'d> {
    pub(super) data: &'d Data,
    pub(super) module: usize,
    pub(super) routine: Option<usize>,
}

impl Data {
    /// Keeps what a name stands for; whether the name is new there.
    pub(super) fn declare(&mut self, scope: Scope, name: &str, datum: Datum) -> bool {
        if *self.homes.entry(name.to_owned()).or_insert(scope) != scope {
            self.ambiguous.insert(name.to_owned());
        }
        let names = self.all.entry(scope).or_default();
        names.insert(name.to_owned(), datum).is_none()
    }

    /// What the name stands for in a scope is not known any more.
    pub(super) fn forget(&mut self, scopes: [Option<Scope>; 3], name: &str) {
        for scope in scopes.into_iter().flatten() {
            if let Some(datum) = self.all.get_mut(&scope).and_then(|names| names.get_mut(name)) {
                *datum = Datum::Unclear;
                return;
            }
        }
    }
}

/// The scopes that a routine of a module sees, the innermost first.
pub(super) fn seen_from(module: usize, routine: Option<usize>) -> [Option<Scope>; 3] {
    [
        routine.map(Scope::Routine),
        Some(Scope::Module(module)),
        Some(Scope::Task),
    ]
}

/// A target with the way to stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RobTarget {
    pub(super) tip: Point3,
    pub(super) held: Orientation,
    pub(super) conf: [i32; 4],
}

/// A `zonedata`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Zone {
    /// A stop point.
    Fine,
    /// The members after the first.
    Fly([f64; 6]),
}

/// A `speeddata`: mm/s and deg/s. External axes have those of ABB's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SpeedData {
    pub(super) tip: f64,
    pub(super) turn: f64,
}

impl View<'_> {
    /// What a name stands for.
    pub(super) fn find(&self, name: &str) -> Option<&Datum> {
        if self.data.ambiguous.contains(name) {
            return Some(&UNCLEAR);
        }
        seen_from(self.module, self.routine)
            .into_iter()
            .flatten()
            .find_map(|scope| self.data.all.get(&scope)?.get(name))
    }

    /// A value, or what its name stands for. Names that stand for names are not followed: RAPID has none.
    fn literal<'v>(&'v self, value: &'v Value) -> Option<&'v Value> {
        match value {
            Value::Name(name) => match self.find(name)? {
                Datum::Value(value) => Some(value),
                Datum::Tool(_) | Datum::WorkObject | Datum::Unclear => None,
            },
            Value::Number(_) | Value::Text(_) | Value::List(_) | Value::Other => Some(value),
        }
    }

    fn list<'v, const N: usize>(&'v self, value: &'v Value) -> Option<&'v [Value; N]> {
        match self.literal(value)? {
            Value::List(values) => values.as_slice().try_into().ok(),
            Value::Number(_) | Value::Name(_) | Value::Text(_) | Value::Other => None,
        }
    }

    pub(super) fn number(&self, value: &Value) -> Option<f64> {
        match self.literal(value)? {
            Value::Number(number) => Some(*number),
            Value::Name(_) | Value::Text(_) | Value::List(_) | Value::Other => None,
        }
    }

    fn numbers<const N: usize>(&self, value: &Value) -> Option<[f64; N]> {
        let mut numbers = [0.0; N];
        for (number, value) in numbers.iter_mut().zip(self.list::<N>(value)?) {
            *number = self.number(value)?;
        }
        Some(numbers)
    }

    fn has_no_external_axes(&self, value: &Value) -> bool {
        self.numbers::<6>(value)
            .is_some_and(|axes| axes.iter().all(|axis| *axis == NO_AXIS))
    }

    fn point(&self, value: &Value) -> Option<Point3> {
        self.numbers(value).map(|[x, y, z]| Point3::new(x, y, z))
    }

    fn orientation(&self, value: &Value) -> Option<Orientation> {
        let [w, x, y, z] = self.numbers(value)?;
        let length = (w * w + x * x + y * y + z * z).sqrt();
        let is_unit = (length - 1.0).abs() <= OFF_LENGTH;
        Orientation::from_quaternion(w, x, y, z).filter(|_| is_unit)
    }

    fn frame(&self, value: &Value) -> Option<Frame> {
        let [origin, orientation] = self.list(value)?;
        Some(Frame {
            origin: self.point(origin)?,
            orientation: self.orientation(orientation)?,
        })
    }

    /// `[[x,y,z],[q1,q2,q3,q4],[cf1,cf4,cf6,cfx],[9E9, ..]]`.
    pub(super) fn robtarget(&self, value: &Value) -> Option<RobTarget> {
        let [tip, held, conf, external] = self.list(value)?;
        let mut quarters = [0; 4];
        for (quarter, number) in quarters.iter_mut().zip(self.numbers::<4>(conf)?) {
            *quarter = whole(number)?;
        }
        self.has_no_external_axes(external).then_some(())?;
        Some(RobTarget {
            tip: self.point(tip)?,
            held: self.orientation(held)?,
            conf: quarters,
        })
    }

    /// `[[j1, .. j6],[9E9, ..]]`, as rad.
    pub(super) fn jointtarget(&self, value: &Value) -> Option<AxisValues> {
        let [axes, external] = self.list(value)?;
        self.has_no_external_axes(external).then_some(())?;
        Some(AxisValues(self.numbers::<6>(axes)?.map(f64::to_radians)))
    }

    /// A `speeddata`, also one of ABB's own.
    pub(super) fn speed(&self, value: &Value) -> Option<SpeedData> {
        if let Value::Name(name) = value
            && self.find(name).is_none()
        {
            return predefined_speed(name);
        }
        let [tip, turn, linear, rotary] = self.numbers(value)?;
        ([linear, rotary] == EXTERNAL.map(f64::from)).then_some(SpeedData { tip, turn })
    }

    /// A `zonedata`, also the stop point.
    pub(super) fn zone(&self, value: &Value) -> Option<Zone> {
        if let Value::Name(name) = value
            && self.find(name).is_none()
        {
            return (name == "FINE").then_some(Zone::Fine);
        }
        let [stops, members @ ..] = self.list::<7>(value)?;
        let mut numbers = [0.0; 6];
        for (number, member) in numbers.iter_mut().zip(members) {
            *number = self.number(member)?;
        }
        Some(if is_true(stops)? {
            Zone::Fine
        } else {
            Zone::Fly(numbers)
        })
    }

    /// The frame and load of a `tooldata` on the flange.
    pub(super) fn tool(&self, value: &Value) -> Option<(Frame, Load)> {
        let [held, frame, load] = self.list(value)?;
        is_true(held)?.then_some(())?;
        Some((self.frame(frame)?, self.load(load)?))
    }

    /// A `loaddata` whose moments of inertia are those along the axes of the flange.
    fn load(&self, value: &Value) -> Option<Load> {
        let [mass, centre, axes, x, y, z] = self.list(value)?;
        let is_straight = self.numbers(axes) == Some([1.0, 0.0, 0.0, 0.0]);
        is_straight.then_some(())?;
        let inertia = Inertia {
            x: self.number(x)?,
            y: self.number(y)?,
            z: self.number(z)?,
        };
        Some(Load {
            mass: Mass::kg(self.number(mass)?),
            centre: self.point(centre)?,
            inertia: Some(inertia).filter(|inertia| *inertia != Inertia::POINT),
        })
    }

    /// The frame of a `wobjdata` that stands still in the world and has no frame of an object within it.
    pub(super) fn work_object(&self, value: &Value) -> Option<Frame> {
        let [held, fixed, unit, user, object] = self.list(value)?;
        let stands = !is_true(held)? && is_true(fixed)? && *unit == Value::Text("\"\"".to_owned());
        let within = self.frame(object)?;
        let is_whole =
            within.origin == Point3::new(0.0, 0.0, 0.0) && within.orientation == Orientation::IDENTITY;
        (stands && is_whole).then_some(())?;
        self.frame(user)
    }
}

/// A truth value as written.
fn is_true(value: &Value) -> Option<bool> {
    match value {
        Value::Name(name) if name == "TRUE" => Some(true),
        Value::Name(name) if name == "FALSE" => Some(false),
        Value::Name(_) | Value::Number(_) | Value::Text(_) | Value::List(_) | Value::Other => None,
    }
}

/// A whole number of some size.
fn whole(number: f64) -> Option<i32> {
    let is_whole = number.fract() == 0.0 && number.abs() <= 1e6;
    #[expect(clippy::cast_possible_truncation, reason = "whole, and at most a million")]
    is_whole.then_some(number as i32)
}

/// `v5` to `v7000` [A-INS].
fn predefined_speed(name: &str) -> Option<SpeedData> {
    let is_known = crate::names::RESERVED.contains(&name);
    let tip: u32 = name.strip_prefix('V').filter(|_| is_known)?.parse().ok()?;
    Some(SpeedData {
        tip: f64::from(tip),
        turn: 500.0,
    })
}
