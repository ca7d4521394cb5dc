//! Blocks drawn by INSERT, unfolded.
//!
//! An insertion puts the base point of a block to its own place, stretches the block, turns it, and may repeat it in
//! columns and rows. Entities of a block on layer `0` take the layer of the insertion.
//!
//! What stands on a layer that is off or frozen is not seen, nor is what is inserted on a frozen one, whatever its own layer.
//! So it is left out and listed, unless its layer is the one that is asked for.

use super::super::drawing::{Affine, Drawing, MOST_STROKES, Place, Remark, Shape, Stroke, UnreadList, Why};
use super::super::{DataError, shortened};
use super::facing::Facing;
use super::fields::Fields;
use super::types::{Block, Content, Entity, File, Insert, Repeat, folded};
use crate::point::Point2;
use std::collections::BTreeMap;

/// How deep blocks may be nested.
const DEEPEST: usize = 32;

/// Most entities that are looked at while blocks are unfolded.
const MOST_ENTITIES: usize = 2_000_000;

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
        return Err(fields.error("this INSERT scales its block to zero"));
    }
    let repeat = |count: i32, way: Point2| -> Result<Repeat, DataError> {
        let stated = fields.get(count).map_or(Ok(1), |value| value.whole())?;
        let count = usize::try_from(stated).unwrap_or(1).max(1);
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
        hidden: BTreeMap::new(),
        strokes: Vec::new(),
        unread: UnreadList::default(),
        layers: BTreeMap::new(),
        remarks: Vec::new(),
        looked_at: 0,
        path: Vec::new(),
    };
    for layer in &file.layers {
        let key = folded(layer.name);
        if unfolding.wanted.as_ref() != Some(&key) {
            unfolding
                .hidden
                .extend(layer.hidden.map(|why| (key.clone(), why)));
        }
        unfolding.layers.entry(key).or_insert((layer.name, 0));
    }
    let model = Host {
        map: Affine::IDENTITY,
        layer: None,
        hidden: None,
    };
    unfolding.entities(&file.entities, model)?;
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
    /// Layers that are not seen, by name in small letters, but for the wanted one.
    hidden: BTreeMap<String, Why>,
    strokes: Vec<Stroke>,
    unread: UnreadList,
    /// Layers by name in small letters: their names, and how many strokes they have.
    layers: BTreeMap<String, (&'t str, usize)>,
    remarks: Vec<Remark>,
    looked_at: usize,
    /// Blocks that are being unfolded, the outermost first.
    path: Vec<&'f str>,
}

/// Where entities are drawn: in the model, or by an insertion.
#[derive(Clone, Copy)]
struct Host<'t> {
    map: Affine,
    /// The layer of the insertion.
    layer: Option<&'t str>,
    /// Why nothing of it is seen, if so.
    hidden: Option<Why>,
}

impl<'f, 't> Unfolding<'f, 't> {
    fn entities(&mut self, entities: &'f [Entity<'t>], host: Host<'t>) -> Result<(), DataError> {
        for entity in entities {
            self.looked_at += 1;
            if self.looked_at > MOST_ENTITIES {
                let message = format!("the blocks of this file expand to more than {MOST_ENTITIES} entities");
                return Err(entity.place.error(message));
            }
            let layer = match host.layer {
                Some(inserted) if entity.layer == "0" => inserted,
                Some(_) | None => entity.layer,
            };
            self.entity(entity, host, layer)?;
        }
        Ok(())
    }

    /// Why an entity is not seen where it is drawn.
    fn hidden(&self, host: Host<'_>, layer: &str) -> Option<Why> {
        let own = || self.hidden.get(&folded(layer)).copied();
        if self.hidden.is_empty() {
            host.hidden
        } else {
            host.hidden.or_else(own)
        }
    }

    fn entity(&mut self, entity: &'f Entity<'t>, host: Host<'t>, layer: &'t str) -> Result<(), DataError> {
        let map = host.map;
        if let (Some(why), Content::Stroke(..) | Content::Fitted(..) | Content::Unread(_)) =
            (self.hidden(host, layer), &entity.content)
        {
            if let Content::Stroke(..) | Content::Fitted(..) = entity.content {
                self.count(layer);
            }
            self.leave_out(entity.kind, why, entity.place, layer);
            return Ok(());
        }
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
            Content::Insert(insert) => self.insert(insert, entity, host, layer)?,
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

    fn count(&mut self, layer: &'t str) {
        self.layers.entry(folded(layer)).or_insert((layer, 0)).1 += 1;
    }

    fn stroke(&mut self, stroke: Stroke, layer: &'t str) -> Result<Taken, DataError> {
        self.count(layer);
        if !self.is_wanted(layer) {
            return Ok(Taken::No);
        }
        if self.strokes.len() >= MOST_STROKES {
            let message = format!("more than {MOST_STROKES} lines are drawn, too many for an outline");
            return Err(stroke.place.error(message));
        }
        self.strokes.push(stroke);
        Ok(Taken::Yes)
    }

    fn insert(
        &mut self,
        insert: &Insert<'t>,
        entity: &Entity<'t>,
        host: Host<'t>,
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
        // On a layer that is off it hides only what is on that layer too.
        let frozen = self.hidden(host, layer).filter(|why| *why == Why::Frozen);
        let to_base = Affine::shift(-block.base.x, -block.base.z);
        self.path.push(block.name);
        for row in 0..insert.rows.count {
            for column in 0..insert.columns.count {
                // Empty blocks repeated without end are bounded too.
                self.looked_at += 1;
                let (c, r) = (column as f64, row as f64);
                let aside = Affine::shift(
                    insert.columns.step.x * c + insert.rows.step.x * r,
                    insert.columns.step.z * c + insert.rows.step.z * r,
                );
                let inner = Host {
                    map: host.map.after(aside).after(insert.map).after(to_base),
                    layer: Some(layer),
                    hidden: host.hidden.or(frozen),
                };
                self.entities(&block.entities, inner)?;
                if self.looked_at > MOST_ENTITIES {
                    return Err(place.error("this INSERT repeats its block too often"));
                }
            }
        }
        self.path.pop();
        Ok(())
    }
}

/// The message about a spline without control points.
const FITTED: &str = "this SPLINE has no control points; a natural cubic spline over the length of its chords is drawn \
                      through its fit points; another program may draw another curve";

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
