//! PLY: a head that says what follows, then elements as text or as bytes.
//!
//! The head names the form (`ascii`, `binary_little_endian`, `binary_big_endian`), the elements in their order with their
//! number, and the properties of each: numbers of eight types, or lists of them (G. Turk: The PLY polygon file format, 1994).
//! Corners are `x`, `y`, `z` of the element `vertex`, polygons the list `vertex_indices` (or `vertex_index`) of the element
//! `face`. All other elements are counted and passed over, other properties are passed over.

mod head;
mod values;

use super::gather::Gather;
use super::{DataError, ReadMesh, fault};
use head::{Element, Property, Shape, head};
use values::{Values, values};

/// What is made of an element.
#[derive(Clone, Copy, Debug)]
enum Use {
    /// A corner, from the properties at these places.
    Corner([usize; 3]),
    /// A polygon, from the list at this place.
    Polygon(usize),
    Nothing,
}

/// Reads the polygons of a PLY file as fans of triangles.
///
/// # Errors
/// An invalid head, data that ends too early, corners out of range, faces that name corners which do not
/// exist before them, that pass a corner twice, or that are concave; a file without a triangle that has an
/// area.
pub fn ply(bytes: &[u8]) -> Result<ReadMesh, DataError> {
    let head = head(bytes)?;
    let mut values = values(bytes, head.form, head.end);
    let mut gather = Gather::default();
    for element in &head.elements {
        let r#use = usage(element)?;
        match r#use {
            Use::Corner(_) => {
                // No more room than the data that is left can fill.
                let room = values.left() / element.least_size(head.form).max(1);
                let count = usize::try_from(element.count).unwrap_or(usize::MAX);
                gather.corners.reserve_exact(count.min(room));
            }
            Use::Polygon(_) => {}
            Use::Nothing => {
                let count = usize::try_from(element.count).unwrap_or(usize::MAX);
                gather.remarks.pass_over(&element.name, count);
            }
        }
        // Elements without properties take no room, and there may be any number of them.
        if !element.properties.is_empty() {
            let mut scratch = Scratch::default();
            for _ in 0..element.count {
                item(element, r#use, &mut values, &mut gather, &mut scratch)?;
            }
        }
    }
    gather.finish(bytes.len())
}

/// What an element is for.
fn usage(element: &Element) -> Result<Use, DataError> {
    let single = |name: &str| {
        element
            .properties
            .iter()
            .position(|property| property.name == name && matches!(property.shape, Shape::Single(_)))
    };
    let missing = |what: &str| {
        Err(fault(
            element.range.clone(),
            format!("the element `{}` has no {what}", element.name),
        ))
    };
    match element.name.as_str() {
        "vertex" => match [single("x"), single("y"), single("z")] {
            [Some(x), Some(y), Some(z)] => Ok(Use::Corner([x, y, z])),
            _ => missing("properties x, y and z"),
        },
        "face" => {
            let is_list = |property: &Property| {
                matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
                    && matches!(property.shape, Shape::List { .. })
            };
            match element.properties.iter().position(is_list) {
                Some(place) => Ok(Use::Polygon(place)),
                None => missing("list vertex_indices"),
            }
        }
        _ => Ok(Use::Nothing),
    }
}

/// Room that is used again for each item.
#[derive(Default)]
struct Scratch {
    named: Vec<u32>,
}

/// Reads one item of an element.
fn item(
    element: &Element,
    r#use: Use,
    values: &mut Values<'_>,
    gather: &mut Gather,
    scratch: &mut Scratch,
) -> Result<(), DataError> {
    let start = values.place();
    let mut point = [0.0; 3];
    scratch.named.clear();
    for (place, property) in element.properties.iter().enumerate() {
        match property.shape {
            Shape::Single(kind) => {
                let part = match r#use {
                    Use::Corner(parts) => parts.iter().position(|&part| part == place),
                    Use::Polygon(_) | Use::Nothing => None,
                };
                match part.and_then(|part| point.get_mut(part)) {
                    Some(part) => *part = values.coordinate(kind)?,
                    None => values.skip(kind, 1)?,
                }
            }
            Shape::List { count, kind } => {
                let count = values.whole(count)?;
                let is_wanted = match r#use {
                    Use::Polygon(list) => list == place,
                    Use::Corner(_) | Use::Nothing => false,
                };
                if is_wanted {
                    for _ in 0..count {
                        scratch.named.push(index(values, kind, gather.corners.len())?);
                    }
                } else {
                    values.skip(kind, count)?;
                }
            }
        }
    }
    match r#use {
        Use::Corner(_) => gather.corners.push(point.into()),
        Use::Polygon(_) => gather.polygon(&mut scratch.named, start..values.place())?,
        Use::Nothing => {}
    }
    Ok(())
}

fn index(values: &mut Values<'_>, kind: head::Kind, corners: usize) -> Result<u32, DataError> {
    let start = values.place();
    let number = values.whole(kind)?;
    if number >= corners as u64 {
        return Err(fault(
            start..values.place(),
            format!("corner {number} is not among the {corners} up to here"),
        ));
    }
    // There are fewer corners than that.
    Ok(u32::try_from(number).unwrap_or(u32::MAX))
}
