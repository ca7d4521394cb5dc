//! The groups of one entity, by code.

use super::super::drawing::Place;
use super::super::{DataError, Piece, coordinate, number, shortened};
use super::groups::{Group, Groups};
use crate::point::Point2;

/// The groups of an entity after its name.
pub(super) struct Fields<'t> {
    /// Its name: `LINE`.
    pub(super) kind: &'t str,
    pub(super) place: Place,
    text: Vec<(Group, &'t str)>,
}

/// A group's value and place.
#[derive(Clone, Copy)]
pub(super) struct Value<'t> {
    pub(super) text: &'t str,
    pub(super) place: Place,
}

impl<'t> Fields<'t> {
    /// Takes the groups of the entity whose name is the group at hand, up to the next code 0.
    pub(super) fn take(name: Group, groups: &mut Groups<'t>) -> Result<Self, DataError> {
        let mut text = Vec::new();
        while groups.peek()?.is_none_or(|group| group.code != 0) {
            let group = groups.take()?;
            text.push((group, groups.value(group)));
        }
        Ok(Self {
            kind: groups.value(name),
            place: name.place,
            text,
        })
    }

    /// All values, in the order of the file.
    pub(super) fn all(&self) -> impl Iterator<Item = (i32, Value<'t>)> + '_ {
        self.text.iter().map(|&(group, text)| {
            let place = group.place;
            (group.code, Value { text, place })
        })
    }

    /// The first value of a code.
    pub(super) fn get(&self, code: i32) -> Option<Value<'t>> {
        self.all().find(|(c, _)| *c == code).map(|(_, value)| value)
    }

    /// The number of a code, if it is there.
    pub(super) fn number(&self, code: i32) -> Result<Option<f64>, DataError> {
        self.get(code).map(Value::number).transpose()
    }

    /// The number of a code, or what it is when it is left out.
    pub(super) fn number_or(&self, code: i32, otherwise: f64) -> Result<f64, DataError> {
        Ok(self.number(code)?.unwrap_or(otherwise))
    }

    /// The number of a code that must be there.
    pub(super) fn required(&self, code: i32) -> Result<f64, DataError> {
        let value = self.number(code)?;
        value.ok_or_else(|| self.error(format!("this {} lacks its group {code}", shortened(self.kind))))
    }

    /// The whole number of a code, or 0.
    pub(super) fn whole(&self, code: i32) -> Result<i64, DataError> {
        self.get(code).map_or(Ok(0), Value::whole)
    }

    /// The point whose x has this code, and y one 10 higher.
    pub(super) fn point(&self, code: i32) -> Result<Point2, DataError> {
        Ok(Point2::new(self.required(code)?, self.required(code + 10)?))
    }

    /// The layer it stands on; `0` when it does not say.
    pub(super) fn layer(&self) -> &'t str {
        self.get(8).map_or("0", |value| value.text)
    }

    /// Something wrong with the entity as a whole.
    pub(super) fn error(&self, message: impl Into<String>) -> DataError {
        self.place.error(message)
    }
}

impl Value<'_> {
    /// A number within the range of coordinates.
    pub(super) fn number(self) -> Result<f64, DataError> {
        coordinate(
            Piece {
                text: self.text,
                start: self.place.start as usize,
            },
            self.text,
        )
    }

    /// A whole number. Some programs write it with a decimal point.
    pub(super) fn whole(self) -> Result<i64, DataError> {
        let parsed = self.text.parse().ok();
        let rounded = || {
            number(self.text)
                .filter(|value| value.abs() < 1e9 && value.fract().abs() < 1e-9)
                .map(|value| value as i64)
        };
        parsed.or_else(rounded).ok_or_else(|| {
            self.place
                .error(format!("`{}` is not a whole number", shortened(self.text)))
        })
    }
}
