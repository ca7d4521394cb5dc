//! Named positions and frames, and their scope.

use crate::syntax::{Component, Coordinates, Declaration, Scope, Value, Variable, meaning};
use std::collections::BTreeMap;

/// Where a name is known. A controller looks in this order.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Routine(usize),
    /// In one module, by its name in upper case.
    Module(String),
    /// Everywhere.
    All,
}

/// Where a statement stands that names something.
#[derive(Clone, Copy, Debug)]
pub struct Context<'t> {
    /// The routine, unless it is a data list.
    pub routine: Option<usize>,
    /// The module's name.
    pub module: &'t str,
}

impl Context<'_> {
    fn places(self) -> impl Iterator<Item = Place> {
        let own = self.routine.map(Place::Routine);
        let module = Place::Module(self.module.to_ascii_uppercase());
        own.into_iter().chain([module, Place::All])
    }

    fn own(self) -> Place {
        match self.routine {
            Some(routine) => Place::Routine(routine),
            None => Place::Module(self.module.to_ascii_uppercase()),
        }
    }
}

/// What a statement about variables came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It is known from now on.
    Known,
    /// It is not of the part of KRL that is read.
    Unknown,
}

/// All positions and frames that have names.
#[derive(Debug, Default)]
pub struct Variables {
    values: BTreeMap<(Place, String), Coordinates>,
}

impl Variables {
    /// The value of a variable, as it is now.
    #[must_use]
    pub fn get(&self, context: Context<'_>, variable: &Variable<'_>) -> Option<Coordinates> {
        if variable.index.is_some() || variable.field.is_some() {
            return None;
        }
        let key = self.key(context, variable.name)?;
        self.values.get(&key).copied()
    }

    /// Where a name is known, as it is seen from a place.
    fn key(&self, context: Context<'_>, name: &str) -> Option<(Place, String)> {
        let name = name.to_ascii_uppercase();
        let mut keys = context.places().map(|place| (place, name.clone()));
        keys.find(|key| self.values.contains_key(key))
    }

    /// Takes a declaration. Only positions and frames are kept; numbers, texts and the data of inline forms move nothing by
    /// themselves, and who uses one is not understood.
    pub fn declare(&mut self, context: Context<'_>, declaration: &Declaration<'_>) -> Outcome {
        let Declaration {
            scope,
            kind,
            name,
            ref value,
            ..
        } = *declaration;
        if name.name.starts_with('$') || name.field.is_some() {
            return Outcome::Unknown;
        }
        let Some(shape) = Shape::of(kind) else {
            return Outcome::Unknown;
        };
        let value = match (shape.components(), value) {
            (None, _) => return Outcome::Known,
            (Some(_), None) => Coordinates::default(),
            (Some(components), Some(value)) => match self.value(context, value) {
                Some(value) if is_of(&value, components) => value,
                Some(_) | None => return Outcome::Unknown,
            },
        };
        let own = name.index.is_none().then_some(name.name);
        for name in own.into_iter().chain(declaration.further_names()) {
            let place = match scope {
                Scope::Module => context.own(),
                Scope::Global => Place::All,
            };
            self.values.insert((place, name.to_ascii_uppercase()), value);
        }
        Outcome::Known
    }

    /// Takes an assignment to a variable that was declared.
    pub fn assign(&mut self, context: Context<'_>, to: &Variable<'_>, value: &Value<'_>) -> Outcome {
        let new = self.value(context, value);
        let key = self.key(context, to.name);
        let old = key.and_then(|key| self.values.get_mut(&key));
        let (Some(old), None) = (old, to.index) else {
            return Outcome::Unknown;
        };
        match (to.field, value, new) {
            (Some(field), Value::Number(number), _) => match Component::named(field) {
                Some(component) => old.set(component, *number),
                None => return Outcome::Unknown,
            },
            // What the literal leaves out the variable keeps.
            (None, _, Some(new)) => {
                for component in Component::ALL {
                    if let Some(value) = new.get(component) {
                        old.set(component, value);
                    }
                }
            }
            (Some(_) | None, _, _) => return Outcome::Unknown,
        }
        Outcome::Known
    }

    /// Takes from a variable that was declared what is known of it: it has been changed in a way that is not followed.
    pub fn forget(&mut self, context: Context<'_>, name: &str) {
        if let Some(key) = self.key(context, name) {
            self.values.remove(&key);
        }
    }

    /// The coordinates that a value stands for.
    #[must_use]
    pub fn value(&self, context: Context<'_>, value: &Value<'_>) -> Option<Coordinates> {
        match value {
            Value::Coordinates(coordinates) => Some(*coordinates),
            Value::Variable(variable) => self.get(context, variable),
            Value::Number(_) | Value::Bool(_) | Value::Enum(_) | Value::Text(_) | Value::Structure(_) => None,
        }
    }
}

/// What a type is made of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    Pose,
    Axes,
    /// Nothing that is kept.
    Other,
}

impl Shape {
    fn of(kind: &str) -> Option<Self> {
        let kinds = [
            ("E6POS", Self::Pose),
            ("POS", Self::Pose),
            ("FRAME", Self::Pose),
            ("E3POS", Self::Pose),
            ("E6AXIS", Self::Axes),
            ("AXIS", Self::Axes),
            ("E3AXIS", Self::Axes),
            ("INT", Self::Other),
            ("REAL", Self::Other),
            ("BOOL", Self::Other),
            ("CHAR", Self::Other),
            ("FDAT", Self::Other),
            ("PDAT", Self::Other),
            ("LDAT", Self::Other),
            ("LOAD", Self::Other),
        ];
        meaning(kind, &kinds)
    }

    const fn components(self) -> Option<&'static [Component]> {
        const POSE: [Component; 8] = [
            Component::X,
            Component::Y,
            Component::Z,
            Component::A,
            Component::B,
            Component::C,
            Component::S,
            Component::T,
        ];
        match self {
            Self::Pose => Some(&POSE),
            Self::Axes => Some(&Component::AXES),
            Self::Other => None,
        }
    }
}

/// Whether a value is made of these components, and external axes.
fn is_of(value: &Coordinates, components: &[Component]) -> bool {
    let mut given = Component::ALL.iter().filter(|&&component| value.has(component));
    given.all(|component| components.contains(component) || Component::EXTERNAL.contains(component))
}
