//! The unit of lengths in a STEP file (ISO 10303-41, clause 21).
//!
//! A context of representations names its units; that of lengths is metres with a prefix, or converted from such a unit
//! by a factor, as inches are.

use super::super::{DataError, fault};
use super::file::{Entity, File, Instance, Reference, shown};

/// Units that are defined by others, one by the next.
const MOST_CONVERSIONS: usize = 4;

/// Units whose ratio differs from 1 by less are the same.
const SAME_UNIT: f64 = 1e-9;

/// Prefixes of metres, in mm.
const METRES: [(&str, f64); 8] = [
    ("KILO", 1e6),
    ("HECTO", 1e5),
    ("DECA", 1e4),
    ("DECI", 100.0),
    ("CENTI", 10.0),
    ("MILLI", 1.0),
    ("MICRO", 1e-3),
    ("NANO", 1e-6),
];

/// The unit of all contexts that state one, in mm.
pub(super) fn of_lengths(file: &mut File<'_>, contexts: &[Entity]) -> Result<Option<f64>, DataError> {
    let mut found: Option<f64> = None;
    for &context in contexts {
        let instance = file.read(context)?;
        let Some(record) = instance.record("GLOBAL_UNIT_ASSIGNED_CONTEXT") else {
            continue;
        };
        let Some(units) = record.items.last() else {
            continue;
        };
        for item in units.list()? {
            let reference = item.reference()?;
            let unit = file.named(&reference)?;
            if let Some(length) = length(file, &unit, MOST_CONVERSIONS)? {
                match found {
                    Some(first) if (length / first - 1.0).abs() > SAME_UNIT => {
                        let message =
                            format!("lengths are in units of {length} mm here, and of {first} mm before");
                        return Err(fault(reference.range, message));
                    }
                    Some(_) => {}
                    None => found = Some(length),
                }
            }
        }
    }
    Ok(found)
}

/// A unit of length in mm; none for one of something else.
fn length(
    file: &mut File<'_>,
    unit: &Instance<'_>,
    conversions_left: usize,
) -> Result<Option<f64>, DataError> {
    if let Some(record) = unit.record("SI_UNIT") {
        // Alone, the dimensions come before prefix and name.
        let [prefix, name] = match record.items.as_slice() {
            [prefix, name] | [_, prefix, name] => [prefix, name],
            _ => {
                let message = format!("{} has a prefix and a name", shown(record.keyword));
                return Err(fault(record.keyword.range(), message));
            }
        };
        if !name.is_word("METRE") {
            return Ok(None);
        }
        if prefix.word.bytes == b"$" {
            return Ok(Some(1000.0));
        }
        let known = METRES.iter().find(|(word, _)| prefix.is_word(word));
        return match known {
            Some(&(_, size)) => Ok(Some(size)),
            None => {
                let message = format!("the prefix `{}` of metres is not read", prefix.word.shown());
                Err(fault(prefix.word.range(), message))
            }
        };
    }
    let (Some(_), Some(record)) = (unit.record("LENGTH_UNIT"), unit.record("CONVERSION_BASED_UNIT")) else {
        return Ok(None);
    };
    let factor = record.at(1)?.reference()?;
    let Some(left) = conversions_left.checked_sub(1) else {
        return Err(fault(factor.range, "this unit is defined by too many others"));
    };
    converted(file, &factor, left).map(Some)
}

/// What a measure comes to in mm.
fn converted(file: &mut File<'_>, measure: &Reference, left: usize) -> Result<f64, DataError> {
    let instance = file.named(measure)?;
    let kinds = ["LENGTH_MEASURE_WITH_UNIT", "MEASURE_WITH_UNIT"];
    let mut records = kinds.iter().filter_map(|kind| instance.record(kind));
    let Some(record) = records.find(|record| record.items.len() == 2) else {
        let message = format!(
            "a unit is converted by {}, which is not a length with its unit",
            instance.kind()
        );
        return Err(fault(instance.range.clone(), message));
    };
    let value = record.at(0)?;
    let factor = value.number()?;
    let by = record.at(1)?.reference()?;
    let unit = file.named(&by)?;
    let Some(unit) = length(file, &unit, left)? else {
        return Err(fault(
            by.range,
            "a length is converted from a unit of something else",
        ));
    };
    let size = factor * unit;
    // From a nanometre to a kilometre.
    if (1e-6..=1e6).contains(&size) {
        Ok(size)
    } else {
        Err(fault(
            value.word.range(),
            format!("a unit of {size} mm is not read"),
        ))
    }
}
