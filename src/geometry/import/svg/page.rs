//! Lengths, view boxes, and the page: where its origin is and what its unit is.
//!
//! A user unit is a pixel, unless a `viewBox` says how many of them the page is wide. Pixels are 1/96 in by CSS, but
//! programs differ (72 and 90 have been usual); so a unit counts as known only when the page is measured in one that has a
//! length: mm, cm, in, pt, pc or Q.

use super::super::DataError;
use super::super::drawing::{Affine, Unit};
use super::scan::Scan;
use super::tree::{Text, attribute, place};
use roxmltree::Node;

/// A pixel of CSS, in mm.
const PIXEL: f64 = 25.4 / 96.0;

/// A length as written.
#[derive(Clone, Copy)]
enum Length {
    /// User units, or pixels.
    User(f64),
    /// A real length, in mm.
    Real(f64),
    /// A share of something else.
    Share,
}

/// A length in user units.
pub(super) fn user_units(text: Text<'_>) -> Result<f64, DataError> {
    match length(text)? {
        Length::User(value) => Ok(value),
        Length::Real(mm) => Ok(mm / PIXEL),
        Length::Share => Err(text
            .place(0..text.text.len())
            .error("percentages and font sizes are not supported here: give a number, or a length in mm")),
    }
}

/// A length in user units, or what it is when the attribute is left out.
pub(super) fn length_or(node: Node<'_, '_>, name: &str, otherwise: f64) -> Result<f64, DataError> {
    attribute(node, name).map_or(Ok(otherwise), user_units)
}

fn length(text: Text<'_>) -> Result<Length, DataError> {
    let mut scan = Scan::new(text);
    if text.text.trim() == "auto" {
        return Ok(Length::Share);
    }
    let value = scan.number()?;
    let mm = match scan.word() {
        "" | "px" => return Ok(Length::User(value)),
        "%" | "em" | "ex" | "rem" | "vw" | "vh" => return Ok(Length::Share),
        "mm" => 1.0,
        "cm" => 10.0,
        "in" => 25.4,
        "pt" => 25.4 / 72.0,
        "pc" => 25.4 / 6.0,
        "Q" | "q" => 0.25,
        _ => {
            return Err(text
                .place(0..text.text.len())
                .error("this is not a length of SVG"));
        }
    };
    Ok(Length::Real(value * mm))
}

/// A view box: where it begins, and its width and height above 0.
#[derive(Clone, Copy)]
struct ViewBox {
    x: f64,
    y: f64,
    width: f64,
    height: f64,
}

impl ViewBox {
    fn of(node: Node<'_, '_>) -> Result<Option<Self>, DataError> {
        let Some(text) = attribute(node, "viewBox") else {
            return Ok(None);
        };
        let mut scan = Scan::new(text);
        let (x, y) = (scan.number()?, scan.number()?);
        let (width, height) = (scan.number()?, scan.number()?);
        if width > 0.0 && height > 0.0 {
            Ok(Some(Self { x, y, width, height }))
        } else {
            Err(text
                .place(0..text.text.len())
                .error("the width and height of a view box must be above 0"))
        }
    }
}

/// How a view box is fitted into a rectangle.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fit {
    /// Both axes by themselves.
    Stretch,
    /// All of it is seen.
    Meet,
    /// All of the rectangle is filled.
    Slice,
}

impl Fit {
    fn of(node: Node<'_, '_>) -> Self {
        let words = attribute(node, "preserveAspectRatio").map_or("", |text| text.text);
        if words.contains("none") {
            Self::Stretch
        } else if words.contains("slice") {
            Self::Slice
        } else {
            Self::Meet
        }
    }

    /// The factors of both axes.
    fn factors(self, x: f64, y: f64) -> (f64, f64) {
        match self {
            Self::Stretch => (x, y),
            Self::Meet => (x.min(y), x.min(y)),
            Self::Slice => (x.max(y), x.max(y)),
        }
    }
}

/// Where in a rectangle a view box lies that does not fill it: the share of what is left over that comes before it, and for
/// one that is cut off of what stands out.
#[derive(Clone, Copy)]
struct Alignment {
    /// From the left.
    x: f64,
    /// From above.
    y: f64,
}

impl Alignment {
    fn of(node: Node<'_, '_>) -> Self {
        let words = attribute(node, "preserveAspectRatio").map_or("", |text| text.text);
        let share = |least: &str, most: &str| {
            if words.contains(least) {
                0.0
            } else if words.contains(most) {
                1.0
            } else {
                0.5
            }
        };
        Self {
            x: share("xMin", "xMax"),
            y: share("YMin", "YMax"),
        }
    }
}

pub(super) struct Page {
    /// The unit of the drawing.
    pub(super) unit: Unit,
    /// From user units, y downwards, to the drawing: x from the left edge of the page, z from its lower one.
    pub(super) map: Affine,
}

impl Page {
    /// The page of the root element.
    pub(super) fn of(root: Node<'_, '_>) -> Result<Self, DataError> {
        let side = |name| attribute(root, name).map(length).transpose();
        let (width, height) = (side("width")?, side("height")?);
        let real = |length: Option<Length>| match length {
            Some(Length::Real(mm)) if mm > 0.0 => Some(mm),
            Some(Length::Real(_) | Length::User(_) | Length::Share) | None => None,
        };
        let (wide, high) = (real(width), real(height));
        let Some(view) = ViewBox::of(root)? else {
            let bottom = match height {
                Some(Length::Real(mm)) => mm / PIXEL,
                Some(Length::User(units)) => units,
                Some(Length::Share) | None => 0.0,
            };
            let is_known = wide.is_some() || high.is_some();
            return Ok(Self {
                unit: if is_known {
                    Unit::Known(PIXEL)
                } else {
                    Unit::Unsaid(place(root))
                },
                map: Affine::new([1.0, 0.0, 0.0, -1.0, 0.0, bottom]),
            });
        };
        let upright = Affine::new([1.0, 0.0, 0.0, -1.0, -view.x, view.y + view.height]);
        let factors = match (wide, high) {
            (Some(w), Some(h)) => Some(Fit::of(root).factors(w / view.width, h / view.height)),
            (Some(w), None) => Some((w / view.width, w / view.width)),
            (None, Some(h)) => Some((h / view.height, h / view.height)),
            (None, None) => None,
        };
        Ok(match factors {
            Some((x, z)) => {
                // What the page has beyond the view box, in its user units; upwards from below.
                let aligned = Alignment::of(root);
                let left = wide.map_or(0.0, |wide| (wide / x - view.width) * aligned.x);
                let below = high.map_or(0.0, |high| (high / z - view.height) * (1.0 - aligned.y));
                Self {
                    unit: Unit::Known(x),
                    map: Affine::stretch(1.0, z / x)
                        .after(Affine::shift(left, below))
                        .after(upright),
                }
            }
            None => Self {
                unit: Unit::Unsaid(place(root)),
                map: upright,
            },
        })
    }
}

/// From within an inner `svg` or a `symbol` to where it stands; sizes that are left out are those of its view box.
pub(super) fn viewport(node: Node<'_, '_>, used_by: Option<Node<'_, '_>>) -> Result<Affine, DataError> {
    let (x, y) = (length_or(node, "x", 0.0)?, length_or(node, "y", 0.0)?);
    let corner = Affine::shift(x, y);
    let Some(view) = ViewBox::of(node)? else {
        return Ok(corner);
    };
    let size = |name: &str, own: f64| -> Result<f64, DataError> {
        match used_by
            .and_then(|user| attribute(user, name))
            .or_else(|| attribute(node, name))
        {
            Some(text) => user_units(text),
            None => Ok(own),
        }
    };
    let (width, height) = (size("width", view.width)?, size("height", view.height)?);
    let (sx, sy) = Fit::of(node).factors(width / view.width, height / view.height);
    if !(sx > 0.0 && sy > 0.0) {
        return Err(place(node).error("this has a size of 0"));
    }
    let aligned = Alignment::of(node);
    let spare = Affine::shift(
        (width - view.width * sx) * aligned.x,
        (height - view.height * sy) * aligned.y,
    );
    Ok(corner
        .after(spare)
        .after(Affine::stretch(sx, sy))
        .after(Affine::shift(-view.x, -view.y)))
}
