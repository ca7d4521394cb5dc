//! The machine's axes as the words of a block, and the frame in which the tip is stated.
//!
//! The words X, Y, Z of a tip with tool-centre-point control are seen from the work offset: a frame parallel to the machine's
//! axes (all rotary axes at zero) whose origin is that of the workpiece frame W. Rotary axes are stated by
//! their values, as the controller counts them and never wrapped.

use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{Axis, AxisKind, AxisValues, Cell};

/// The axis of an orientable spindle in a machine's sheet. In G-code S is a speed.
const SPINDLE: &str = "S";

/// An axis of the machine as a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Word {
    pub(crate) letter: u8,
    /// How it moves.
    pub(crate) kind: AxisKind,
    /// Its place among the machine's axes.
    pub(crate) place: usize,
}

/// Why axes cannot be written as words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum NoWord {
    /// The axis turns the spindle, and the job does not say the letter.
    Spindle,
    /// The letter for the spindle is that of another axis.
    Taken(char),
    /// The names are not those of a five-axis machine.
    Name,
}

/// The words of a machine's axes, in their order: X, Y, Z first.
///
/// # Errors
/// When an axis has none.
pub(crate) fn words(cell: &Cell, spindle: Option<u8>) -> Result<Vec<Word>, NoWord> {
    let mut words: Vec<Word> = Vec::with_capacity(cell.axes.len());
    for (place, axis) in cell.axes.iter().enumerate() {
        let letter = letter(axis, spindle)?;
        if words.iter().any(|word| word.letter == letter) {
            return Err(NoWord::Taken(char::from(letter)));
        }
        words.push(Word {
            letter,
            kind: axis.kind,
            place,
        });
    }
    let linear = words.iter().filter(|word| word.kind == AxisKind::Linear);
    let starts_with = words.get(..3).unwrap_or_default().iter();
    let is_xyz = starts_with.map(|word| word.letter).eq(*b"XYZ");
    if linear.count() == 3 && is_xyz {
        Ok(words)
    } else {
        Err(NoWord::Name)
    }
}

fn letter(axis: &Axis, spindle: Option<u8>) -> Result<u8, NoWord> {
    match (axis.name.as_bytes(), axis.kind) {
        ([letter @ (b'X' | b'Y' | b'Z')], AxisKind::Linear) => Ok(*letter),
        ([letter @ (b'A' | b'B' | b'C')], AxisKind::Rotary) => Ok(*letter),
        (_, AxisKind::Rotary) if axis.name == SPINDLE => spindle.ok_or(NoWord::Spindle),
        (_, AxisKind::Linear | AxisKind::Rotary) => Err(NoWord::Name),
    }
}

/// The value of an axis as it is printed: mm or degrees.
pub(crate) fn printed(word: Word, axes: &AxisValues) -> Option<f64> {
    let value = *axes.0.get(word.place)?;
    Some(match word.kind {
        AxisKind::Linear => value,
        AxisKind::Rotary => value.to_degrees(),
    })
}

/// From the workpiece frame W to the frame of the work offset: the way W is turned against the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WorkInOffset {
    rows: [[f64; 3]; 3],
}

impl WorkInOffset {
    /// For a workpiece frame that is turned so against the machine.
    pub(crate) fn new(work: Orientation) -> Self {
        Self { rows: work.matrix() }
    }

    /// A point of W, seen from the frame of the work offset.
    pub(crate) fn in_offset(&self, Point3 { x, y, z }: Point3) -> Point3 {
        let [a, b, c] = self.rows.map(|row| row[0] * x + row[1] * y + row[2] * z);
        Point3::new(a, b, c)
    }

    /// A point of the frame of the work offset, seen from W.
    pub(crate) fn in_work(&self, Point3 { x, y, z }: Point3) -> Point3 {
        let column = |at: usize| {
            let [first, second, third] = self.rows.map(|row| row.get(at).copied().unwrap_or_default());
            first * x + second * y + third * z
        };
        Point3::new(column(0), column(1), column(2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use vcutc_backend_api::geometry::Zyx;
    use vcutc_backend_api::testkit::{CellRecipe, Recipe};
    use vcutc_backend_api::units::Angle;

    fn cell() -> Cell {
        let recipe = Recipe {
            cell: CellRecipe::five_axis(),
            ..Recipe::default()
        };
        recipe.program().cell.unwrap()
    }

    fn letters(cell: &Cell, spindle: Option<u8>) -> Result<String, NoWord> {
        let words = words(cell, spindle)?;
        Ok(words.iter().map(|word| char::from(word.letter)).collect())
    }

    #[test]
    fn axes_are_their_own_words_and_a_spindle_needs_a_letter() {
        let mut cell = cell();
        assert_eq!(letters(&cell, None), Ok("XYZBA".to_owned()));
        cell.axes.push(Axis {
            name: "S".to_owned(),
            ..cell.axes[4].clone()
        });
        assert_eq!(letters(&cell, None), Err(NoWord::Spindle));
        assert_eq!(letters(&cell, Some(b'C')), Ok("XYZBAC".to_owned()));
        assert_eq!(letters(&cell, Some(b'B')), Err(NoWord::Taken('B')));
        cell.axes[0].name = "U".to_owned();
        assert_eq!(letters(&cell, Some(b'C')), Err(NoWord::Name));
    }

    /// The one that turns about z alone is worked out by hand.
    #[test]
    fn work_that_is_turned_a_quarter_about_z() {
        let turned = Orientation::from_zyx(Zyx {
            a: Angle::deg(90.0),
            b: Angle::ZERO,
            c: Angle::ZERO,
        });
        let tip = WorkInOffset::new(turned).in_offset(Point3::new(10.0, 2.0, 3.0));
        for (is, should) in [(tip.x, -2.0), (tip.y, 10.0), (tip.z, 3.0)] {
            assert!((is - should).abs() < 1e-12, "{tip:?}");
        }
    }

    proptest! {
        #[test]
        fn there_and_back_is_where_it_was(
            angles in [-3.0..3.0_f64, -1.5..1.5, -3.0..3.0],
            point in [-5e3..5e3_f64, -5e3..5e3, -5e3..5e3],
        ) {
            let turned = Orientation::from_zyx(Zyx {
                a: Angle::rad(angles[0]),
                b: Angle::rad(angles[1]),
                c: Angle::rad(angles[2]),
            });
            let frame = WorkInOffset::new(turned);
            let point = Point3::new(point[0], point[1], point[2]);
            let again = frame.in_work(frame.in_offset(point));
            prop_assert!(again.distance(point).to_mm() < 1e-9);
        }
    }
}
