//! The sections of a DXF file: what the head says of units, the names of layers, the blocks, and what is drawn.

use super::super::drawing::{Place, Unit, Why};
use super::super::{DataError, shortened};
use super::entity;
use super::fields::{Fields, Value};
use super::groups::{Group, Groups};
use super::types::{Block, Entity, File, Layer, folded};
use crate::point::Point2;
use std::collections::BTreeMap;

/// Flag of a layer: it is frozen.
const FROZEN: i64 = 1;

/// Reads all sections.
pub(super) fn read<'t>(groups: &mut Groups<'t>) -> Result<File<'t>, DataError> {
    let mut file = File {
        unit: Unit::Unsaid(Place { start: 0, end: 0 }),
        layers: Vec::new(),
        blocks: BTreeMap::new(),
        entities: Vec::new(),
    };
    let mut has_entities = false;
    let start = begin(groups)?;
    file.unit = Unit::Unsaid(start);
    loop {
        let group = groups.take()?;
        match (group.code, groups.value(group)) {
            (0, "EOF") => break,
            (0, "SECTION") => {}
            _ => return Err(misplaced(group, groups)),
        }
        let name = groups.take()?;
        match (name.code, groups.value(name)) {
            (2, "HEADER") => header(groups, &mut file)?,
            (2, "TABLES") => tables(groups, &mut file)?,
            (2, "BLOCKS") => blocks(groups, &mut file)?,
            (2, "ENTITIES") => {
                has_entities = true;
                file.entities.append(&mut entities(groups, "ENDSEC")?);
            }
            (2, _) => while !ends(groups.take()?, groups, "ENDSEC") {},
            _ => return Err(misplaced(name, groups)),
        }
    }
    if has_entities {
        Ok(file)
    } else {
        Err(start.error("this DXF has no ENTITIES section, so it draws nothing"))
    }
}

/// Where the first section begins.
fn begin(groups: &mut Groups<'_>) -> Result<Place, DataError> {
    let no_dxf = "a DXF begins with `0` and `SECTION` on two lines; this is something else";
    let first = match groups.peek() {
        Ok(Some(group)) => group,
        Ok(None) => return Err(DataError::new(0..0, "the file is empty")),
        Err(error) => {
            return Err(DataError {
                message: no_dxf.to_owned(),
                ..error
            });
        }
    };
    match (first.code, groups.value(first)) {
        (0, "SECTION" | "EOF") => Ok(first.place),
        _ => Err(first.place.error(no_dxf)),
    }
}

fn misplaced(group: Group, groups: &Groups<'_>) -> DataError {
    let value = shortened(groups.value(group));
    group
        .place
        .error(format!("`{value}` instead of a section or `EOF`"))
}

/// Whether a group is the end of something.
fn ends(group: Group, groups: &Groups<'_>, end: &str) -> bool {
    group.code == 0 && groups.value(group) == end
}

fn header<'t>(groups: &mut Groups<'t>, file: &mut File<'t>) -> Result<(), DataError> {
    let mut variable = "";
    loop {
        let group = groups.take()?;
        let value = groups.value(group);
        match group.code {
            0 if value == "ENDSEC" => return Ok(()),
            9 => variable = value,
            70 if variable == "$INSUNITS" => {
                let value = Value {
                    text: value,
                    place: group.place,
                };
                file.unit = super::unit(value.whole()?, group.place);
            }
            _ => {}
        }
    }
}

fn tables<'t>(groups: &mut Groups<'t>, file: &mut File<'t>) -> Result<(), DataError> {
    loop {
        let group = groups.take()?;
        match (group.code, groups.value(group)) {
            (0, "ENDSEC") => return Ok(()),
            (0, "LAYER") => file.layers.extend(layer(&Fields::take(group, groups)?)?),
            _ => {}
        }
    }
}

/// A layer, if it has a name. One that is off has a colour below 0.
fn layer<'t>(fields: &Fields<'t>) -> Result<Option<Layer<'t>>, DataError> {
    let hidden = if fields.whole(70)? & FROZEN != 0 {
        Some(Why::Frozen)
    } else if fields.whole(62)? < 0 {
        Some(Why::Off)
    } else {
        None
    };
    let name = fields.get(2).map(|value| value.text);
    Ok(name.map(|name| Layer { name, hidden }))
}

fn blocks<'t>(groups: &mut Groups<'t>, file: &mut File<'t>) -> Result<(), DataError> {
    loop {
        let group = groups.take()?;
        match (group.code, groups.value(group)) {
            (0, "ENDSEC") => return Ok(()),
            (0, "BLOCK") => {
                let fields = Fields::take(group, groups)?;
                let name = fields.get(2);
                let name = name.ok_or_else(|| fields.error("this BLOCK has no name"))?;
                let flags = fields.whole(70)?;
                let block = Block {
                    name: name.text,
                    base: Point2::new(fields.number_or(10, 0.0)?, fields.number_or(20, 0.0)?),
                    // External references, and their overlays.
                    is_external: flags & (4 | 8) != 0,
                    entities: entities(groups, "ENDBLK")?,
                };
                if file.blocks.insert(folded(name.text), block).is_some() {
                    let message = format!("the block `{}` is defined twice", shortened(name.text));
                    return Err(name.place.error(message));
                }
            }
            // The groups of an ENDBLK.
            (code, _) if code != 0 => {}
            _ => {
                return Err(group
                    .place
                    .error("only BLOCK and ENDBLK are allowed between blocks"));
            }
        }
    }
}

/// Entities up to a word that ends them.
fn entities<'t>(groups: &mut Groups<'t>, end: &str) -> Result<Vec<Entity<'t>>, DataError> {
    let mut found = Vec::new();
    loop {
        let group = groups.take()?;
        match (group.code, groups.value(group)) {
            (0, word) if word == end => return Ok(found),
            (0, "ENDSEC" | "EOF" | "SECTION") => {
                let message = format!("the file goes on here without `{end}`");
                return Err(group.place.error(message));
            }
            (0, _) => found.extend(entity::take(group, groups)?),
            _ => return Err(group.place.error("an entity begins with group 0")),
        }
    }
}
