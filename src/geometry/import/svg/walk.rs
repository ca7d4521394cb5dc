//! The walk over an SVG's elements: groups, references, transformations, layers.

use super::super::drawing::{Affine, Drawing, MOST_STROKES, Place, Stroke, UnreadList, Why};
use super::super::{DataError, shortened};
use super::page::{self, Page, length_or};
use super::style::{Property, Sheet};
use super::tree::{attribute, place};
use super::{shapes, transform};
use roxmltree::{Document, Node};
use std::collections::BTreeMap;

/// How deep elements and references may be nested.
const DEEPEST: usize = 64;

/// Most elements that are looked at while references are followed.
const MOST_ELEMENTS: usize = 2_000_000;

const SVG: &str = "http://www.w3.org/2000/svg";
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// Elements that show nothing where they stand, nor does what they hold.
const SHOW_NOTHING: &[&str] = &[
    "animate",
    "animateMotion",
    "animateTransform",
    "clipPath",
    "cursor",
    "defs",
    "desc",
    "filter",
    "font",
    "hatch",
    "linearGradient",
    "marker",
    "mask",
    "mesh",
    "meshgradient",
    "metadata",
    "pattern",
    "radialGradient",
    "script",
    "set",
    "solidcolor",
    "style",
    "symbol",
    "title",
    "view",
];

/// The drawing of a document, of one layer or of all.
pub(super) fn drawing(
    document: &Document<'_>,
    page: &Page,
    layer: Option<&str>,
) -> Result<Drawing, DataError> {
    let mut ids = BTreeMap::new();
    for node in document.descendants().filter(Node::is_element) {
        if let Some(id) = node.attribute("id") {
            ids.entry(id).or_insert(node);
        }
    }
    let mut walk = Walk {
        ids,
        sheet: Sheet::of(document)?,
        wanted: layer,
        strokes: Vec::new(),
        unread: UnreadList::default(),
        layers: BTreeMap::new(),
        path: Vec::new(),
        looked_at: 0,
        depth: 0,
        taken: 0,
    };
    let state = State {
        map: page.map,
        shown: Shown::Yes,
        is_wanted: layer.is_none(),
    };
    for &(name, place) in walk.sheet.elsewhere() {
        walk.unread.add(name, Why::OtherFile, place);
    }
    walk.note_parts_hidden(document.root_element(), state);
    walk.children(document.root_element(), state)?;
    Ok(Drawing {
        unit: page.unit,
        strokes: walk.strokes,
        unread: walk.unread.finish(),
        layers: walk
            .layers
            .into_iter()
            .map(|(name, count)| (name.to_owned(), count))
            .collect(),
        remarks: Vec::new(),
    })
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Shown {
    Yes,
    /// It is invisible, but what it holds need not be.
    Invisible,
    /// Neither it nor what it holds.
    No,
}

/// What elements hand down.
#[derive(Clone, Copy)]
struct State {
    /// From user units to the drawing.
    map: Affine,
    shown: Shown,
    /// Whether it stands on the wanted layer.
    is_wanted: bool,
}

struct Walk<'d, 't, 'w> {
    ids: BTreeMap<&'d str, Node<'d, 't>>,
    sheet: Sheet<'d>,
    wanted: Option<&'w str>,
    strokes: Vec<Stroke>,
    unread: UnreadList,
    layers: BTreeMap<&'d str, usize>,
    /// Names of the layers around the element at hand.
    path: Vec<&'d str>,
    looked_at: usize,
    depth: usize,
    /// Strokes of all layers.
    taken: usize,
}

impl<'d, 't> Walk<'d, 't, '_> {
    fn children(&mut self, node: Node<'d, 't>, state: State) -> Result<(), DataError> {
        if self.depth >= DEEPEST {
            let message = format!("elements are nested more than {DEEPEST} deep here, or contain themselves");
            return Err(place(node).error(message));
        }
        self.depth += 1;
        for child in node.children().filter(Node::is_element) {
            self.element(child, state)?;
        }
        self.depth -= 1;
        Ok(())
    }

    fn element(&mut self, node: Node<'d, 't>, outer: State) -> Result<(), DataError> {
        self.looked_at += 1;
        if self.looked_at > MOST_ELEMENTS {
            let message = format!("the references of this file expand to more than {MOST_ELEMENTS} elements");
            return Err(place(node).error(message));
        }
        let name = node.tag_name().name();
        let is_svg = node.tag_name().namespace().is_none_or(|space| space == SVG);
        if !is_svg || SHOW_NOTHING.contains(&name) {
            return Ok(());
        }
        let mut state = self.enter(node, outer)?;
        self.note_parts_hidden(node, state);
        match name {
            "g" | "a" | "switch" => self.group(node, state),
            "svg" => {
                state.map = state.map.after(page::viewport(node, None)?);
                self.group(node, state)
            }
            "use" => self.reference(node, state),
            _ => self.shape(node, state),
        }
    }

    /// What an element makes of what it was handed.
    fn enter(&self, node: Node<'d, 't>, outer: State) -> Result<State, DataError> {
        let map = match attribute(node, "transform") {
            Some(text) => {
                if let Some(origin) = attribute(node, "transform-origin") {
                    return Err(origin
                        .place(0..origin.text.len())
                        .error("`transform-origin` is not supported: write the `transform` without it"));
                }
                outer.map.after(transform::transform(text)?)
            }
            None => outer.map,
        };
        let is_named = self
            .wanted
            .is_some_and(|wanted| names(node).any(|name| name == wanted));
        Ok(State {
            map,
            // A layer that is asked for is read though it is hidden.
            shown: if is_named {
                Shown::Yes
            } else {
                self.shown(node, outer.shown)
            },
            is_wanted: outer.is_wanted || is_named,
        })
    }

    /// Clips and masks, which are not applied.
    fn note_parts_hidden(&mut self, node: Node<'d, 't>, state: State) {
        for property in [Property::ClipPath, Property::Mask] {
            let is_cut = self
                .sheet
                .said(node, property)
                .is_some_and(|value| value != "none");
            if is_cut && state.is_wanted && state.shown != Shown::No {
                self.unread.add(property.name(), Why::NotApplied, place(node));
            }
        }
    }

    /// What a group holds. Only groups are layers, but the wanted one may be a shape.
    fn group(&mut self, node: Node<'d, 't>, state: State) -> Result<(), DataError> {
        let name = names(node).next();
        if let Some(name) = name {
            self.layers.entry(name).or_insert(0);
            self.path.push(name);
        }
        self.children(node, state)?;
        if name.is_some() {
            self.path.pop();
        }
        Ok(())
    }

    /// What a `use` refers to, moved by its x and y.
    fn reference(&mut self, node: Node<'d, 't>, mut state: State) -> Result<(), DataError> {
        let target = node
            .attribute("href")
            .or_else(|| node.attribute((XLINK, "href")))
            .unwrap_or_default();
        let Some(id) = target.strip_prefix('#') else {
            self.leave_out(node, Why::OtherFile, state);
            return Ok(());
        };
        let Some(&target) = self.ids.get(id) else {
            let message = format!("there is no element with the id `{}` to use", shortened(id));
            return Err(place(node).error(message));
        };
        let aside = Affine::shift(length_or(node, "x", 0.0)?, length_or(node, "y", 0.0)?);
        state.map = state.map.after(aside);
        if target.tag_name().name() != "symbol" {
            if self.depth >= DEEPEST {
                return Err(place(node).error("this `use` refers to itself, or to one that does"));
            }
            self.depth += 1;
            self.element(target, state)?;
            self.depth -= 1;
            return Ok(());
        }
        state.map = state.map.after(page::viewport(target, Some(node))?);
        self.children(target, state)
    }

    fn shape(&mut self, node: Node<'d, 't>, state: State) -> Result<(), DataError> {
        if state.shown != Shown::Yes {
            self.leave_out(node, Why::Hidden, state);
            return Ok(());
        }
        let Some((kind, strokes)) = shapes::strokes(node)? else {
            self.leave_out(node, Why::Kind, state);
            return Ok(());
        };
        if strokes.is_empty() {
            self.leave_out(node, Why::NoExtent, state);
        }
        for shapes in strokes {
            self.taken += 1;
            if self.taken > MOST_STROKES {
                let message = format!("more than {MOST_STROKES} lines are drawn, too many for an outline");
                return Err(place(node).error(message));
            }
            for name in &self.path {
                *self.layers.entry(name).or_insert(0) += 1;
            }
            // A shape that is wanted by its own name counts as a layer.
            if let Some(own) = names(node).find(|name| Some(*name) == self.wanted) {
                *self.layers.entry(own).or_insert(0) += 1;
            }
            if state.is_wanted {
                self.strokes.push(Stroke {
                    kind,
                    place: place(node),
                    shapes: shapes.into_iter().map(|shape| shape.mapped(state.map)).collect(),
                });
            }
        }
        Ok(())
    }

    fn shown(&self, node: Node<'d, 't>, outer: Shown) -> Shown {
        let said = |property| self.sheet.said(node, property);
        match (outer, said(Property::Display), said(Property::Visibility)) {
            (Shown::No, _, _) | (_, Some("none"), _) => Shown::No,
            (_, _, Some("hidden" | "collapse")) => Shown::Invisible,
            (_, _, Some("visible")) => Shown::Yes,
            (Shown::Yes | Shown::Invisible, _, _) => outer,
        }
    }

    fn leave_out(&mut self, node: Node<'d, 't>, why: Why, state: State) {
        if state.is_wanted {
            let place: Place = place(node);
            self.unread.add(node.tag_name().name(), why, place);
        }
    }
}

/// The names of an element: its label, then its id.
fn names<'d>(node: Node<'d, '_>) -> impl Iterator<Item = &'d str> {
    let label = node.attribute((INKSCAPE, "label"));
    [label, node.attribute("id")].into_iter().flatten()
}
