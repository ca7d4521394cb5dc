//! Drawings in SVG 1.1 and 2.
//!
//! What is read: `path`, `line`, `polyline`, `polygon`, `rect`, `circle` and `ellipse`, in groups and by `use`, with all
//! transformations. Everything else that would be shown is listed. A layer is a group with a name: the label that
//! Inkscape gives its layers, or an `id`. What is hidden is left out, unless it is the layer that is asked for ([`style`]).
//!
//! SVG counts y downwards from the upper left corner of the page. Here z is counted upwards from the lower left corner, so
//! that a page of the size of the stock lies on it. The unit follows from the width of the page ([`page`]).

mod page;
mod path;
mod scan;
mod shapes;
mod style;
mod transform;
mod tree;
mod walk;

use super::DataError;
use super::drawing::Drawing;

/// Reads a drawing: what stands on a layer, or all of it.
///
/// # Errors
/// A text that is not SVG, or has elements that cannot be understood; references without end.
pub fn svg(text: &str, layer: Option<&str>) -> Result<Drawing, DataError> {
    let document = tree::document(text)?;
    let page = page::Page::of(document.root_element())?;
    walk::drawing(&document, &page, layer)
}

#[cfg(test)]
mod tests;
