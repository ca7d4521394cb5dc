//! B-spline surfaces and curves of STEP files (ISO 10303-42, clauses 4.4 and 4.5).
//!
//! An entity of one kind has all values in one record, after its name. One of several kinds at once, which is how weights
//! are given, has a record for each kind: degrees and control points stand in `B_SPLINE_SURFACE`, knots and weights in
//! records of their own.

use super::super::{DataError, fault};
use super::Reading;
use super::file::{Instance, Item, Record, Reference, shown};
use crate::patch::{Curve, MOST_CONTROL, MOST_DEGREE, Nurbs, PatchError};
use vcutc_backend_api::geometry::Point3;

/// The kinds of surfaces that are read, by how their knots are given.
const SURFACES: [(&str, Spacing); 4] = [
    ("B_SPLINE_SURFACE_WITH_KNOTS", Spacing::Given),
    ("BEZIER_SURFACE", Spacing::Bezier),
    ("UNIFORM_SURFACE", Spacing::Uniform),
    ("QUASI_UNIFORM_SURFACE", Spacing::QuasiUniform),
];

/// The same for curves.
const CURVES: [(&str, Spacing); 4] = [
    ("B_SPLINE_CURVE_WITH_KNOTS", Spacing::Given),
    ("BEZIER_CURVE", Spacing::Bezier),
    ("UNIFORM_CURVE", Spacing::Uniform),
    ("QUASI_UNIFORM_CURVE", Spacing::QuasiUniform),
];

/// How the knots of a spline are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Spacing {
    /// As they are.
    Given,
    /// By pieces of one polynomial each.
    Bezier,
    /// At equal distances.
    Uniform,
    /// At equal distances, and as often at the ends as the spline reaches its last control points.
    QuasiUniform,
}

/// Whether a keyword is one of a surface that is read.
pub(super) fn is_surface(keyword: super::super::words::Word<'_>) -> bool {
    SURFACES.iter().any(|(kind, _)| keyword.is(kind))
}

/// The records of a spline.
struct Parts<'i, 'a> {
    /// The record that holds degrees and control points, and where they begin in it.
    base: (&'i Record<'a>, usize),
    /// The record with the knots, and where they begin in it.
    knots: (&'i Record<'a>, usize),
    spacing: Spacing,
    weights: Option<&'i Item<'a>>,
}

impl<'i, 'a> Parts<'i, 'a> {
    /// The records of a spline of one of these kinds. `base` and `rational` are the kinds that all of them are, and that
    /// those with weights are; degrees, control points and flags are so many values.
    fn of(
        instance: &'i Instance<'a>,
        kinds: &[(&str, Spacing)],
        [base, rational]: [&str; 2],
        values: usize,
    ) -> Result<Option<Self>, DataError> {
        let found = kinds
            .iter()
            .find_map(|(kind, spacing)| Some((instance.record(kind)?, *spacing)));
        let Some((knots, spacing)) = found else {
            return Ok(None);
        };
        if instance.records.len() == 1 {
            // The name is the first value.
            return Ok(Some(Self {
                base: (knots, 1),
                knots: (knots, 1 + values),
                spacing,
                weights: None,
            }));
        }
        let Some(record) = instance.record(base) else {
            let message = format!("this {} lacks its {base}", shown(knots.keyword));
            return Err(fault(instance.range.clone(), message));
        };
        let weights = instance.record(rational).map(|record| record.at(0)).transpose()?;
        Ok(Some(Self {
            base: (record, 0),
            knots: (knots, 0),
            spacing,
            weights,
        }))
    }

    fn base(&self, place: usize) -> Result<&'i Item<'a>, DataError> {
        let (record, start) = self.base;
        record.at(start + place)
    }

    /// The knots in a direction, from 0, of so many.
    fn knots(
        &self,
        [direction, directions]: [usize; 2],
        degree: usize,
        count: usize,
    ) -> Result<Vec<f64>, DataError> {
        let (record, start) = self.knots;
        match self.spacing {
            Spacing::Given => {
                let multiplicities = record.at(start + direction)?;
                let knots = record.at(start + directions + direction)?;
                given(multiplicities, knots, degree, count)
            }
            Spacing::Bezier => {
                let pieces = (count - 1) / degree;
                if pieces == 0 || pieces * degree + 1 != count {
                    let message = format!("{count} control points do not make pieces of degree {degree}");
                    return Err(fault(record.keyword.range(), message));
                }
                Ok(repeated(pieces, degree, degree))
            }
            Spacing::Uniform => Ok((0..=count + degree)
                .map(|knot| knot as f64 - degree as f64)
                .collect()),
            Spacing::QuasiUniform => Ok(repeated(count.saturating_sub(degree).max(1), degree, 1)),
        }
    }
}

/// The knots 0, 1, ... up to a number: the ends as often as clamps a spline, the others so often.
fn repeated(end: usize, degree: usize, inner: usize) -> Vec<f64> {
    let times = |knot: usize| {
        if knot == 0 || knot == end {
            degree + 1
        } else {
            inner
        }
    };
    (0..=end)
        .flat_map(|knot| core::iter::repeat_n(knot as f64, times(knot)))
        .collect()
}

/// Knots that are given once each, with how often each counts.
fn given(
    multiplicities: &Item<'_>,
    knots: &Item<'_>,
    degree: usize,
    count: usize,
) -> Result<Vec<f64>, DataError> {
    let (times, values) = (multiplicities.list()?, knots.list()?);
    if times.len() != values.len() {
        let message = format!("{} multiplicities for {} knots", times.len(), values.len());
        return Err(fault(multiplicities.word.range(), message));
    }
    let expected = count + degree + 1;
    let mut all = Vec::new();
    for (times, value) in times.iter().zip(values) {
        let repeats = times.whole(1..=degree + 1)?;
        let knot = value.number()?;
        if all.last().is_some_and(|last| *last >= knot) {
            return Err(fault(
                value.word.range(),
                "this knot is not greater than the one before",
            ));
        }
        all.extend(core::iter::repeat_n(knot, repeats));
        if all.len() > expected {
            break;
        }
    }
    if all.len() == expected {
        Ok(all)
    } else {
        let message = format!(
            "{count} control points of degree {degree} take {expected} knots, multiplicities counted, and these are {}",
            if all.len() > expected {
                "more".to_owned()
            } else {
                all.len().to_string()
            }
        );
        Err(fault(multiplicities.word.range(), message))
    }
}

impl<'a> Reading<'a> {
    /// The surface of an entity, in mm; none if it is of another kind.
    pub(super) fn surface(&mut self, instance: &Instance<'a>) -> Result<Option<Nurbs>, DataError> {
        let kinds = ["B_SPLINE_SURFACE", "RATIONAL_B_SPLINE_SURFACE"];
        let Some(parts) = Parts::of(instance, &SURFACES, kinds, 7)? else {
            return Ok(None);
        };
        let degree = |place| parts.base(place)?.whole(1..=MOST_DEGREE);
        let degrees = [degree(0)?, degree(1)?];
        let rows = parts.base(2)?;
        let listed = rows.list()?;
        let columns = listed.first().map_or(Ok(0), |row| row.list().map(<[_]>::len))?;
        if listed.len() <= degrees[0] || columns <= degrees[1] {
            let message = format!(
                "{} by {columns} control points are too few for degrees {} and {}",
                listed.len(),
                degrees[0],
                degrees[1]
            );
            return Err(fault(rows.word.range(), message));
        }
        let mut control = Vec::new();
        for row in listed {
            let points = row.list()?;
            if points.len() != columns {
                let message = format!(
                    "{} control points stand in this row, and {columns} in the first",
                    points.len()
                );
                return Err(fault(row.word.range(), message));
            }
            self.points(points, &mut control)?;
        }
        let knots = [
            parts.knots([0, 2], degrees[0], listed.len())?,
            parts.knots([1, 2], degrees[1], columns)?,
        ];
        let mut weights = Vec::new();
        for row in parts.weights.map_or(Ok([].as_slice()), Item::list)? {
            weights.extend(row.list()?.iter().map(weight).collect::<Result<Vec<_>, _>>()?);
        }
        checked_weights(&parts, &weights, control.len())?;
        Ok(Some(Nurbs {
            degrees,
            knots,
            control,
            weights,
        }))
    }

    /// The curve of an entity, in mm; none if it is of another kind.
    pub(super) fn curve(&mut self, instance: &Instance<'a>) -> Result<Option<Curve>, DataError> {
        let kinds = ["B_SPLINE_CURVE", "RATIONAL_B_SPLINE_CURVE"];
        let Some(parts) = Parts::of(instance, &CURVES, kinds, 5)? else {
            return Ok(None);
        };
        let degree = parts.base(0)?.whole(1..=MOST_DEGREE)?;
        let points = parts.base(1)?;
        let listed = points.list()?;
        if listed.len() <= degree {
            let message = format!("{} control points are too few for degree {degree}", listed.len());
            return Err(fault(points.word.range(), message));
        }
        let mut control = Vec::new();
        self.points(listed, &mut control)?;
        let knots = parts.knots([0, 1], degree, listed.len())?;
        let weights = parts.weights.map_or(Ok([].as_slice()), Item::list)?;
        let weights = weights.iter().map(weight).collect::<Result<Vec<_>, _>>()?;
        checked_weights(&parts, &weights, control.len())?;
        Ok(Some(Curve {
            degree,
            knots,
            control,
            weights,
        }))
    }

    fn points(&mut self, listed: &[Item<'a>], into: &mut Vec<Point3>) -> Result<(), DataError> {
        for item in listed {
            if into.len() == MOST_CONTROL {
                let message = format!("there are more than {MOST_CONTROL} control points up to here");
                return Err(fault(item.word.range(), message));
            }
            into.push(self.point(&item.reference()?)?);
        }
        Ok(())
    }

    /// The point that is referred to, in mm.
    pub(super) fn point(&mut self, reference: &Reference) -> Result<Point3, DataError> {
        let instance = self.file.named(reference)?;
        let record = instance.must_be("CARTESIAN_POINT")?;
        let coordinates = record.at(1)?;
        match coordinates.list()? {
            [x, y, z] => {
                let parts = [x.number()?, y.number()?, z.number()?];
                Ok(parts.map(|part| part * self.unit).into())
            }
            other => {
                let message = format!("a point in space has three coordinates, not {}", other.len());
                Err(fault(coordinates.word.range(), message))
            }
        }
    }
}

fn weight(item: &Item<'_>) -> Result<f64, DataError> {
    let weight = item.number()?;
    if weight > 0.0 {
        Ok(weight)
    } else {
        Err(fault(item.word.range(), "weights are above 0"))
    }
}

fn checked_weights(parts: &Parts<'_, '_>, weights: &[f64], count: usize) -> Result<(), DataError> {
    match parts.weights {
        Some(item) if weights.len() != count => {
            let message = format!("{} weights for {count} control points", weights.len());
            Err(fault(item.word.range(), message))
        }
        Some(_) | None => Ok(()),
    }
}

/// What is wrong with a spline as a whole.
pub(super) fn impossible(error: PatchError, instance: &Instance<'_>) -> DataError {
    fault(instance.range.clone(), error.to_string())
}
