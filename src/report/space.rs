//! The surface of the part in space, in the colours of any of its maps.
//!
//! The page has the height of the part at the corners of the maps' cells, and of each map a number for each cell. The viewer
//! (`src/report/assets/space`, on the camera and the canvas of the playback) draws a face for each cell, so that a place has the
//! colour that it has in the map from above. Without scripts the figure stays hidden: the maps from above show the same values.
//!
//! A map has at most 120 by 120 cells ([`vcutc_picture::plan_map::cells`]), and each number has 16 bits. So heights and each map take
//! at most 39 kB in base64, and with script and style the page grows by at most 320 kB for six maps.

use crate::Material;
use crate::html::Html;
use crate::packing::{column, document};
use crate::pictures::{ClassMap, SurfaceMap};
use serde_json::{Value, json};
use vcutc_picture::plan_map::{Class, Classed};
use vcutc_surface::map::Cells;
use vcutc_surface::surface::Surface;

/// Most maps that a reader can choose from: each adds up to 39 kB to a page that may be mailed.
const MOST_MAPS: usize = 6;

/// The number of a place that has no value.
const NONE: u16 = u16::MAX;

/// The largest number of a height.
const HIGHEST: f64 = 65_534.0;

/// The least step between two heights, in mm: of a level part all are the same.
const FINEST: f64 = 1e-9;

/// Into how many parts a class of colours is divided. With nine classes their numbers fit 16 bits, and a number has the class exactly, which
/// a value rounded by itself would not at a border.
const PARTS: u16 = 7000;

/// A map that the surface can have the colours of.
#[derive(Clone, Copy)]
pub(crate) enum Shown<'a> {
    /// Values in steps.
    Values(&'a SurfaceMap),
    /// Classes.
    Classes(&'a ClassMap),
}

impl Shown<'_> {
    fn packed(self) -> Value {
        match self {
            Self::Values(map) => packed(map),
            Self::Classes(map) => packed_classes(map),
        }
    }
}

/// The figure, of maps with the cells of the first one; none of a part without maps.
pub(crate) fn figure(material: &Material<'_>, first: &SurfaceMap, others: &[Shown<'_>]) -> Option<Html> {
    let surface = material.job.part.surface()?;
    let cells = first.cells();
    let stock = material.job.stock;
    let size = [stock.width, stock.depth, stock.height].map(|length| length.to_mm());
    let maps = [Shown::Values(first)]
        .into_iter()
        .chain(others.iter().copied())
        .take(MOST_MAPS);
    let data = json!({
        "size": size,
        "cells": [cells.columns, cells.rows],
        "heights": heights(surface, cells),
        "parts": PARTS,
        "maps": maps.map(Shown::packed).collect::<Vec<_>>(),
    });
    Some(html!(
        "space.html",
        style = Html::trusted(include_str!("assets/space/space.css")),
        data = Html::trusted(document(&data)),
        script = Html::trusted(SCRIPT),
    ))
}

/// The heights at the corners of cells, row by row from the least y, each from the least x, in steps above the lowest one.
fn heights(surface: &Surface, cells: Cells) -> Value {
    let plan = surface.plan();
    let [width, depth] = [plan.width, plan.depth].map(|length| length.to_mm());
    let at = |length: f64, number: u32, count: u32| length * f64::from(number) / f64::from(count.max(1));
    let corners: Vec<Option<f64>> = (0..=cells.rows)
        .flat_map(|row| (0..=cells.columns).map(move |column| [column, row]))
        .map(|[column, row]| surface.height(at(width, column, cells.columns), at(depth, row, cells.rows)))
        .collect();
    let low = corners
        .iter()
        .flatten()
        .copied()
        .reduce(f64::min)
        .unwrap_or_default();
    let high = corners
        .iter()
        .flatten()
        .copied()
        .reduce(f64::max)
        .unwrap_or_default();
    let step = ((high - low) / HIGHEST).max(FINEST);
    // The bounds make the conversion exact.
    let number = |height: f64| ((height - low) / step).round().clamp(0.0, HIGHEST) as u16;
    let numbers: Vec<u16> = corners.iter().map(|height| height.map_or(NONE, number)).collect();
    json!({ "low": low, "step": step, "values": column(&numbers) })
}

/// A map: its words, its classes, and of each cell how many parts of a class its value is above the least class.
fn packed(map: &SurfaceMap) -> Value {
    let Classed {
        classes,
        from,
        step,
        cells,
        decimals,
    } = map.classed();
    let classified = cells.iter().zip(map.values());
    let numbers: Vec<u16> = classified
        .map(|(class, value)| match (class, value) {
            (Some(class), Some(value)) => number(*class, (value - from) / step),
            (None, _) | (_, None) => NONE,
        })
        .collect();
    let class = |Class { colour, words }: &Class| json!([colour, words]);
    json!({
        "what": map.what(),
        "unit": map.unit(),
        "figures": map.figures(),
        "limit": map.limit(),
        "decimals": decimals,
        "from": from,
        "step": step,
        "classes": classes.iter().map(class).collect::<Vec<_>>(),
        "values": column(&numbers),
    })
}

/// A map of classes: it has no decimals, and the number of a cell is where its class begins.
fn packed_classes(map: &ClassMap) -> Value {
    let numbers = map
        .classes()
        .iter()
        .map(|class| class.map_or(NONE, |class| number(class, f64::from(class))));
    json!({
        "what": ClassMap::what(),
        "unit": "",
        "figures": map.figures(),
        "limit": null,
        "decimals": null,
        "from": 0,
        "step": 1,
        "classes": ClassMap::legend(),
        "values": column(&numbers.collect::<Vec<_>>()),
    })
}

/// The number of a value in a class: in parts of a class above the least one, and never beyond its own class.
fn number(class: u32, classes_above_least: f64) -> u16 {
    let within = (classes_above_least - f64::from(class)) * f64::from(PARTS);
    // The bounds make the conversion exact.
    let within = within.clamp(0.0, f64::from(PARTS - 1)) as u16;
    let below = u16::try_from(class).unwrap_or(NONE).saturating_mul(PARTS);
    below.saturating_add(within)
}

/// The viewer, file by file, as one script: what stands between its tags, to the byte. It has its own camera and canvas, because a page
/// of a long program has no playback.
pub const SCRIPT: &str = concat!(
    "\n(() => {\n\"use strict\";\n",
    include_str!("assets/player/matrix.js"),
    include_str!("assets/player/bytes.js"),
    include_str!("assets/player/triangles.js"),
    include_str!("assets/player/canvas.js"),
    include_str!("assets/player/camera.js"),
    include_str!("assets/player/pointers.js"),
    include_str!("assets/space/relief.js"),
    include_str!("assets/space/view.js"),
    include_str!("assets/space/start.js"),
    "})();\n",
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_the_class_of_its_value() {
        // At a border rounding may put a value on either side; its class decides.
        for (class, value, wanted) in [
            (0, -1e-12, 0),
            (2, 2.5, 2 * PARTS + PARTS / 2),
            (2, 2.0 - 1e-9, 2 * PARTS),
            (1, 2.0, 2 * PARTS - 1),
            // The highest of all, below what stands for none.
            (8, 9.0, 62_999),
        ] {
            assert_eq!(number(class, value), wanted, "{value}");
        }
    }
}
