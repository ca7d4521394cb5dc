//! What a DXF file holds: layers, blocks and entities.

use super::super::drawing::{Affine, Place, Shape, Unit, Why};
use crate::point::Point2;
use std::collections::BTreeMap;

/// All of a file that matters to outlines.
pub(super) struct File<'t> {
    pub(super) unit: Unit,
    /// Layers that the file defines.
    pub(super) layers: Vec<Layer<'t>>,
    /// Blocks by name in small letters.
    pub(super) blocks: BTreeMap<String, Block<'t>>,
    /// What stands in the model, and on sheets.
    pub(super) entities: Vec<Entity<'t>>,
}

/// A layer of the table of layers.
pub(super) struct Layer<'t> {
    pub(super) name: &'t str,
    /// Why what stands on it is not seen; none if it is.
    pub(super) hidden: Option<Why>,
}

/// A block: entities that are drawn by being inserted.
pub(super) struct Block<'t> {
    pub(super) name: &'t str,
    /// The point of the block that an insertion puts in its place.
    pub(super) base: Point2,
    /// Whether what it holds stands in another file.
    pub(super) is_external: bool,
    pub(super) entities: Vec<Entity<'t>>,
}

/// A name as blocks and layers are compared: capitals make no difference.
pub(super) fn folded(name: &str) -> String {
    name.to_lowercase()
}

pub(super) struct Entity<'t> {
    pub(super) kind: &'t str,
    pub(super) place: Place,
    pub(super) layer: &'t str,
    pub(super) content: Content<'t>,
}

/// What an entity is to outlines.
pub(super) enum Content<'t> {
    /// A connected line.
    Stroke(&'static str, Vec<Shape>),
    /// The same, of points that a spline passes through.
    Fitted(&'static str, Vec<Shape>),
    /// A block once more.
    Insert(Insert<'t>),
    Unread(Why),
}

/// A block once more.
pub(super) struct Insert<'t> {
    pub(super) block: &'t str,
    /// From the block, its base point at the origin, to where the insertion stands; of the first column and row.
    pub(super) map: Affine,
    pub(super) columns: Repeat,
    pub(super) rows: Repeat,
}

/// Columns or rows.
pub(super) struct Repeat {
    pub(super) count: usize,
    /// From one to the next, along the turned axis.
    pub(super) step: Point2,
}
