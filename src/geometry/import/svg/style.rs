//! Styles, as far as they decide what is shown and where: attributes `style`, and style sheets that speak of classes.
//!
//! Drawing programs hide layers by `display:none`, in the attribute (Inkscape) or by a class of a sheet (Illustrator). Of
//! sheets only selectors that are one class are read. What other selectors hide, and what any style moves, would be
//! missed; it is refused.

use super::super::drawing::Place;
use super::super::{DataError, shortened};
use super::tree::{attribute, place};
use roxmltree::{Document, Node};
use std::collections::BTreeMap;

/// Properties that decide where things lie or what shape they have, in the place of attributes that are read.
const OF_GEOMETRY: &[&str] = &[
    "transform",
    "-webkit-transform",
    "-moz-transform",
    "-ms-transform",
    "-o-transform",
    "translate",
    "rotate",
    "scale",
    "transform-origin",
    "transform-box",
    "offset-path",
    "d",
    "cx",
    "cy",
    "r",
    "rx",
    "ry",
    "x",
    "y",
];

/// What hides, all of a thing or a part of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Property {
    Display,
    Visibility,
    ClipPath,
    Mask,
}

impl Property {
    const ALL: [Self; 4] = [Self::Display, Self::Visibility, Self::ClipPath, Self::Mask];

    /// Its word.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Display => "display",
            Self::Visibility => "visibility",
            Self::ClipPath => "clip-path",
            Self::Mask => "mask",
        }
    }

    /// Whether it hides all of a thing with this value.
    fn hides(self, value: &str) -> bool {
        match self {
            Self::Display | Self::Visibility => matches!(value, "none" | "hidden" | "collapse"),
            Self::ClipPath | Self::Mask => false,
        }
    }

    fn of(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|property| name.eq_ignore_ascii_case(property.name()))
    }
}

/// What the style sheets of a document say of classes: the value and which rule said so, counted from the first.
pub(super) struct Sheet<'d> {
    classes: BTreeMap<(&'d str, Property), (usize, &'d str)>,
    rules: usize,
    /// Sheets in other files: how they are named, and where.
    elsewhere: Vec<(&'static str, Place)>,
}

impl<'d> Sheet<'d> {
    /// Reads all sheets, and refuses what is not read of them and of attributes.
    pub(super) fn of(document: &'d Document<'_>) -> Result<Self, DataError> {
        let mut sheet = Self {
            classes: BTreeMap::new(),
            rules: 0,
            elsewhere: document.descendants().filter_map(sheet_elsewhere).collect(),
        };
        for node in document.descendants().filter(Node::is_element) {
            if attribute(node, "style").is_some_and(|style| declarations(style.text).any(is_of_geometry)) {
                return Err(geometry(place(node)));
            }
            if node.tag_name().name() == "style" {
                for text in node
                    .children()
                    .filter(Node::is_text)
                    .filter_map(|text| text.text())
                {
                    if text.contains(IMPORT) {
                        sheet.elsewhere.push((IMPORT, place(node)));
                    }
                    sheet.read(text, place(node))?;
                }
            }
        }
        Ok(sheet)
    }

    /// Sheets in other files, which are not read.
    pub(super) fn elsewhere(&self) -> &[(&'static str, Place)] {
        &self.elsewhere
    }

    fn read(&mut self, text: &'d str, place: Place) -> Result<(), DataError> {
        let mut rest = text;
        while let Some((prelude, after)) = rest.split_once('{') {
            let (body, after) = block(after);
            rest = after;
            self.rules += 1;
            // Rules without a block, such as `@import`, and comments stand before selectors.
            let selectors = prelude.rsplit([';', '/']).next().unwrap_or_default().trim();
            if declarations(body).any(is_of_geometry) {
                return Err(geometry(place));
            }
            for (property, value) in declarations(body).filter_map(|(name, value)| {
                Some((Property::of(name.rsplit(['{', '}']).next()?.trim())?, value))
            }) {
                for selector in selectors.split(',').map(str::trim) {
                    match class(selector) {
                        Some(class) => {
                            self.classes.insert((class, property), (self.rules, value));
                        }
                        None if property.hides(value) => {
                            return Err(place.error(format!(
                                "the style sheet hides items by `{}`, which is not supported: only single classes are",
                                shortened(selector)
                            )));
                        }
                        None => {}
                    }
                }
            }
        }
        Ok(())
    }

    /// What is said of a property of an element: by its style, by the last rule for one of its classes, by an attribute.
    pub(super) fn said(&self, node: Node<'d, '_>, property: Property) -> Option<&'d str> {
        let own = node.attribute("style").and_then(|style| {
            let of_it = declarations(style).filter(|(name, _)| Property::of(name) == Some(property));
            of_it.map(|(_, value)| value).last()
        });
        let by_class = || {
            let classes = node.attribute("class")?.split_whitespace();
            let rules = classes.filter_map(|class| self.classes.get(&(class, property)));
            rules.max_by_key(|(rule, _)| *rule).map(|(_, value)| *value)
        };
        own.or_else(by_class)
            .or_else(|| node.attribute(property.name()).map(str::trim))
    }
}

/// The rule with which a sheet takes in another.
const IMPORT: &str = "@import";

/// What a node that takes in a sheet of another file is called.
fn sheet_elsewhere(node: Node<'_, '_>) -> Option<(&'static str, Place)> {
    let is_processed = node.pi().is_some_and(|pi| pi.target == "xml-stylesheet");
    let is_linked = node.tag_name().name() == "link" && node.attribute("rel") == Some("stylesheet");
    match (is_processed, is_linked) {
        (true, _) => Some(("xml-stylesheet", place(node))),
        (false, true) => Some(("link", place(node))),
        (false, false) => None,
    }
}

/// The name of the class that a selector is.
fn class(selector: &str) -> Option<&str> {
    let name = selector.strip_prefix('.')?;
    let is_name = name
        .chars()
        .all(|c| c.is_alphanumeric() || matches!(c, '-' | '_'));
    (is_name && !name.is_empty()).then_some(name)
}

/// A block up to the brace that closes it, and what follows.
fn block(text: &str) -> (&str, &str) {
    let mut depth: usize = 1;
    for (at, brace) in text.match_indices(['{', '}']) {
        match brace {
            "{" => depth += 1,
            _ => depth -= 1,
        }
        if depth == 0 {
            return (
                text.get(..at).unwrap_or_default(),
                text.get(at + 1..).unwrap_or_default(),
            );
        }
    }
    (text, "")
}

/// Names and values of a style.
fn declarations(style: &str) -> impl Iterator<Item = (&str, &str)> {
    style.split(';').filter_map(|part| {
        let (name, value) = part.split_once(':')?;
        // The last value of a block ends with its brace.
        let value = value.split(['!', '}']).next().unwrap_or_default();
        Some((name.trim(), value.trim()))
    })
}

fn is_of_geometry((name, value): (&str, &str)) -> bool {
    let name = name.rsplit(['{', '}', '/']).next().unwrap_or_default().trim();
    value != "none"
        && OF_GEOMETRY
            .iter()
            .any(|property| name.eq_ignore_ascii_case(property))
}

fn geometry(place: Place) -> DataError {
    place.error("a style moves or shapes items here, which is not supported: use the attribute `transform`, or those of the shape")
}
