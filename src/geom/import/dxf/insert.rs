//! Blocks drawn by INSERT, unfolded.
//!
//! An insertion puts the base point of a block to its own place, stretches the block, turns it, and may repeat it in
//! columns and rows. Entities of a block on layer `0` take the layer of the insertion.

use super::super::drawing::{Affine, Drawing, MOST_STROKES, Place, Remark, Shape, Stroke, UnreadList, Why};
use super::super::{DataError, shortened};
use super::entity::{Content, Entity, Facing};
use super::fields::Fields;
use super::sections::{Block, File, folded};
use crate::geom::point::Point2;
use std::collections::BTreeMap;

/// How deep blocks may be nested.
const DEEPEST: usize = 32;

/// Most entities that are looked at while blocks are unfolded.
const MOST_ENTITIES: usize = 2_000_000;

/// A block once more.
pub(super) struct Insert<'t> {
    block: &'t str,
    /// From the block, its base point at the origin, to where the insertion stands; of the first column and row.
    map: Affine,
    columns: Repeat,
    rows: Repeat,
}

/// Columns or rows.
struct Repeat {
    count: usize,
    /// From one to the next, along the turned axis.
    step: Point2,
}

/// The content of an INSERT.
pub(super) fn read<'t>(fields: &Fields<'t>) -> Result<Content<'t>, DataError> {
    let Some(facing) = Facing::of(fields)?.map() else {
        return Ok(Content::Unread(Why::Tilted));
    };
    let name = fields.get(2);
    let name = name.ok_or_else(|| fields.error("this INSERT does not say which block"))?;
    let at = fields.point(10)?;
    let (x, z) = (fields.number_or(41, 1.0)?, fields.number_or(42, 1.0)?);
    let turn = Affine::turn(fields.number_or(50, 0.0)?);
    let map = facing
        .after(Affine::shift(at.x, at.z))
        .after(turn)
        .after(Affine::stretch(x, z));
    if !map.is_proper() {
        return Err(fields.error("this INSERT stretches its block to nothing"));
    }
    let repeat = |count: i32, way: Point2| -> Result<Repeat, DataError> {
        let told = fields.get(count).map_or(Ok(1), |value| value.whole())?;
        let count = usize::try_from(told).unwrap_or(1).max(1);
        Ok(Repeat {
            count,
            step: facing.vector(turn.vector(way)),
        })
    };
    Ok(Content::Insert(Insert {
        block: name.text,
        map,
        columns: repeat(70, Point2::new(fields.number_or(44, 0.0)?, 0.0))?,
        rows: repeat(71, Point2::new(0.0, fields.number_or(45, 0.0)?))?,
    }))
}

/// The drawing that a file makes, of one layer or of all.
pub(super) fn unfold(file: File<'_>, layer: Option<&str>) -> Result<Drawing, DataError> {
    let unit = file.unit;
    let mut unfolding = Unfolding {
        blocks: &file.blocks,
        wanted: layer.map(folded),
        strokes: Vec::new(),
        unread: UnreadList::default(),
        layers: BTreeMap::new(),
        remarks: Vec::new(),
        looked_at: 0,
        path: Vec::new(),
    };
    for &name in &file.layers {
        unfolding.layers.entry(folded(name)).or_insert((name, 0));
    }
    unfolding.entities(&file.entities, Affine::IDENTITY, None)?;
    Ok(Drawing {
        unit,
        strokes: unfolding.strokes,
        unread: unfolding.unread.finish(),
        layers: unfolding
            .layers
            .into_values()
            .map(|(name, count)| (name.to_owned(), count))
            .collect(),
        remarks: unfolding.remarks,
    })
}

struct Unfolding<'f, 't> {
    blocks: &'f BTreeMap<String, Block<'t>>,
    wanted: Option<String>,
    strokes: Vec<Stroke>,
    unread: UnreadList,
    /// Layers by name in small letters: their names, and how many strokes they have.
    layers: BTreeMap<String, (&'t str, usize)>,
    remarks: Vec<Remark>,
    looked_at: usize,
    /// Blocks that are being unfolded, the outermost first.
    path: Vec<&'f str>,
}

impl<'f, 't> Unfolding<'f, 't> {
    /// Adds entities, after a map. `layer` is that of the insertion, if they stand in a block.
    fn entities(
        &mut self,
        entities: &'f [Entity<'t>],
        map: Affine,
        layer: Option<&'t str>,
    ) -> Result<(), DataError> {
        for entity in entities {
            self.looked_at += 1;
            if self.looked_at > MOST_ENTITIES {
                let message = format!("the blocks of this file unfold to more than {MOST_ENTITIES} entities");
                return Err(entity.place.error(message));
            }
            let layer = match layer {
                Some(inserted) if entity.layer == "0" => inserted,
                Some(_) | None => entity.layer,
            };
            self.entity(entity, map, layer)?;
        }
        Ok(())
    }

    fn entity(&mut self, entity: &'f Entity<'t>, map: Affine, layer: &'t str) -> Result<(), DataError> {
        match &entity.content {
            Content::Stroke(kind, shapes) => {
                self.stroke(drawn(kind, shapes, entity.place, map), layer)?;
            }
            Content::Fitted(kind, shapes) => {
                let taken = self.stroke(drawn(kind, shapes, entity.place, map), layer)?;
                if taken == Taken::Yes {
                    self.remarks.push(Remark {
                        place: entity.place,
                        message: FITTED.to_owned(),
                    });
                }
            }
            Content::Insert(insert) => self.insert(insert, entity, map, layer)?,
            Content::Unread(why) => self.leave_out(entity.kind, *why, entity.place, layer),
        }
        Ok(())
    }

    fn is_wanted(&self, layer: &str) -> bool {
        self.wanted.as_ref().is_none_or(|wanted| *wanted == folded(layer))
    }

    fn leave_out(&mut self, kind: &str, why: Why, place: Place, layer: &'t str) {
        self.layers.entry(folded(layer)).or_insert((layer, 0));
        if self.is_wanted(layer) {
            self.unread.add(kind, why, place);
        }
    }

    fn stroke(&mut self, stroke: Stroke, layer: &'t str) -> Result<Taken, DataError> {
        self.layers.entry(folded(layer)).or_insert((layer, 0)).1 += 1;
        if !self.is_wanted(layer) {
            return Ok(Taken::No);
        }
        if self.strokes.len() >= MOST_STROKES {
            let message = format!("more than {MOST_STROKES} lines are drawn; no outline has so many");
            return Err(stroke.place.error(message));
        }
        self.strokes.push(stroke);
        Ok(Taken::Yes)
    }

    fn insert(
        &mut self,
        insert: &Insert<'t>,
        entity: &Entity<'t>,
        map: Affine,
        layer: &'t str,
    ) -> Result<(), DataError> {
        let place = entity.place;
        let name = shortened(insert.block);
        let Some(block) = self.blocks.get(&folded(insert.block)) else {
            return Err(place.error(format!("there is no block `{name}` in this file")));
        };
        if block.is_external {
            self.leave_out(entity.kind, Why::OtherFile, place, layer);
            return Ok(());
        }
        if self.path.contains(&block.name) {
            return Err(place.error(format!("the block `{name}` is inserted into itself")));
        }
        if self.path.len() >= DEEPEST {
            return Err(place.error(format!("blocks are nested more than {DEEPEST} deep here")));
        }
        let to_base = Affine::shift(-block.base.x, -block.base.z);
        self.path.push(block.name);
        for row in 0..insert.rows.count {
            for column in 0..insert.columns.count {
                // Empty blocks repeated for ever are bounded too.
                self.looked_at += 1;
                let (c, r) = (column as f64, row as f64);
                let aside = Affine::shift(
                    insert.columns.step.x * c + insert.rows.step.x * r,
                    insert.columns.step.z * c + insert.rows.step.z * r,
                );
                let whole = map.after(aside).after(insert.map).after(to_base);
                self.entities(&block.entities, whole, Some(layer))?;
                if self.looked_at > MOST_ENTITIES {
                    return Err(place.error("this INSERT repeats its block too often"));
                }
            }
        }
        self.path.pop();
        Ok(())
    }
}

/// What is told of a spline that the file gives no control points of.
const FITTED: &str = "this SPLINE has no control points; a natural cubic spline over the length of its chords is laid \
                      through its fit points, where another program may draw another curve";

/// A stroke after a map.
fn drawn(kind: &'static str, shapes: &[Shape], place: Place, map: Affine) -> Stroke {
    Stroke {
        kind,
        place,
        shapes: shapes.iter().map(|shape| shape.clone().mapped(map)).collect(),
    }
}

/// Whether something stands on the wanted layer.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Taken {
    Yes,
    No,
}
