//! The words of the language for editors: what can be written where.
//!
//! Everything here is taken from the tables that the checks read by, so that nothing is offered that they refuse.

use super::arguments::Parameter;
pub use super::dimension::Dimension;
pub use super::eval::walk;
pub(crate) use super::field_ranges::Range;
use super::field_ranges::{AXIS_ANGLE, COORDINATE, QUATERNION_PART, SIGNAL, TABLE_NUMBER, WAIT};
pub use super::functions::Signature;
use super::heads::{self, Kind};
use super::kind::Operations;
use super::profile::{data, drawing};
use super::region;
use super::surface::{file, nurbs, step};
use super::{Part, blade, cell, frame, functions, load, machine, names, stock, units};
use crate::BladeKind;
use vcutc_backend_api::ir::MachineKind;
pub use vcutc_diagnostics::schema::field::{BlockSpec, FieldSpec, Form, Inner, Leaving, Need, Takes};
use vcutc_syntax::ast::{Block, SurfaceFile};

/// What can be at the top of a file: its first word, and how all of it looks.
pub fn items(operations: Operations) -> impl Iterator<Item = (&'static str, String)> {
    const PLAIN: &[(&str, &str)] = &[
        ("job", "job \"NAME\""),
        ("use", "use \"PATH\""),
        ("let", "let NAME = VALUE"),
    ];
    let plain = PLAIN.iter().map(|(word, form)| (*word, (*form).to_owned()));
    plain.chain(heads::forms(operations))
}

/// Words that can follow the first word of a block's head.
pub fn head_words(first: &str, operations: Operations) -> Vec<&'static str> {
    match first {
        "machine" => heads::MACHINES.iter().map(|(word, _)| *word).collect(),
        "blade" => BladeKind::WORDS.iter().map(|(word, _)| *word).collect(),
        first => heads::second_words(first, operations),
    }
}

/// The fields of the block whose head consists of these words, with the equals sign as one of them.
pub fn block(head: &[&str], operations: Operations) -> Option<&'static BlockSpec> {
    match head {
        ["stock", ..] => Some(&stock::SPEC),
        ["blade", ..] => Some(blade::spec(blade_kind(head)?)),
        ["machine", ..] => Some(&machine::SPEC),
        ["cell", ..] => Some(&cell::SPEC),
        [first, rest @ ..] => Some(operations.find(first, rest.first().copied())?.spec()),
        [] => None,
    }
}

/// What the block of a disc or a crusher is called in the reference, by the words of its head; none for other blocks.
pub fn kind_of_blade(head: &[&str]) -> Option<&'static str> {
    match (head.first(), blade_kind(head)?) {
        (Some(&"blade"), kind @ (BladeKind::Disc | BladeKind::Crusher)) => Some(kind.word()),
        (_, BladeKind::Straight | BladeKind::Disc | BladeKind::Crusher) => None,
    }
}

/// The kind of blade that a head of a blade's block means: straight where it states none, and none for an unknown word.
fn blade_kind(head: &[&str]) -> Option<BladeKind> {
    let ["blade", _, "=", kind, ..] = head else {
        return Some(BladeKind::Straight);
    };
    let mut known = BladeKind::WORDS.iter();
    known.find(|(word, _)| word == kind).map(|(_, kind)| *kind)
}

/// The fields after a file of a profile or of a surface.
pub fn any_file(word: &str) -> Option<&'static BlockSpec> {
    data_file(word).or_else(|| surface_file(word))
}

/// The fields after a file of a profile: points, airfoils and drawings.
pub fn data_file(word: &str) -> Option<&'static BlockSpec> {
    match word {
        "points" => Some(&data::POINTS),
        "airfoil" => Some(&data::AIRFOIL),
        "dxf" => Some(&drawing::DXF.spec),
        "svg" => Some(&drawing::SVG.spec),
        _ => None,
    }
}

/// The fields after a drawing of a region.
pub fn region_file(word: &str) -> Option<&'static BlockSpec> {
    match word {
        "dxf" => Some(&region::drawing::DXF.spec),
        "svg" => Some(&region::drawing::SVG.spec),
        _ => None,
    }
}

/// The fields after a file of a surface.
pub fn surface_file(word: &str) -> Option<&'static BlockSpec> {
    Some(match SurfaceFile::named(word)? {
        SurfaceFile::Mesh => &file::MESH,
        SurfaceFile::Grid => &file::GRID,
        SurfaceFile::Step => &step::SPEC,
    })
}

/// The fields of a surface by control points.
pub const fn nurbs() -> &'static BlockSpec {
    &nurbs::SPEC
}

/// A row of control points: its first word, and how all of it looks.
pub const CONTROL_ROW: (&str, &str) = ("row", "row (0 mm, 0 mm, 20 mm) (0 mm, 1000 mm, 30 mm)");

/// A profile of a loft: its first word, and how all of it looks.
pub const STATION: (&str, &str) = ("at", "at 1000 mm { start (0 mm, 20 mm) line to (600 mm, 30 mm) }");

/// What a surface is: the first word, and how all of it looks.
pub const SURFACES: &[(&str, &str)] = &[
    ("mesh", "mesh \"fairing.stl\" { unit = mm }"),
    ("grid", "grid \"heights.csv\""),
    ("step", "step \"wing.stp\""),
    (
        "loft",
        "loft { at 0 mm { start (0 mm, 20 mm) line to (600 mm, 30 mm) } at 1000 mm { z(x) = 20 mm } }",
    ),
    (
        "nurbs",
        "nurbs { degree = (1, 1) row (0 mm, 0 mm, 20 mm) (0 mm, 1000 mm, 30 mm) row (600 mm, 0 mm, 30 mm) (600 mm, 1000 mm, 20 mm) }",
    ),
];

/// The pieces of a profile: the first word, and how all of it looks.
pub const CURVES: &[(&str, &str)] = &[
    ("start", "start (0 mm, 18 mm)"),
    ("line", "line to (10 mm, 10 mm)"),
    ("arc", "arc to (30 mm, 12 mm) radius 20 mm"),
    ("bezier", "bezier (20 mm, 30 mm) (60 mm, 34 mm) to (85 mm, 14 mm)"),
    (
        "spline",
        "spline (90 mm, 16 mm) (95 mm, 13 mm) to (100 mm, 14 mm)",
    ),
    (
        "polyline",
        "polyline (105 mm, 13 mm) (110 mm, 15 mm) to (120 mm, 12 mm)",
    ),
    ("points", "points \"heights.csv\""),
    (
        "airfoil",
        "airfoil \"clarky.dat\" { side = upper, chord = 300 mm }",
    ),
    ("dxf", "dxf \"rib.dxf\" { layer = \"SKIN\" }"),
    ("svg", "svg \"rib.svg\" { side = upper }"),
];

/// The pieces that a region has and a profile has not: the first word, and how all of it looks.
pub const SIDES: &[(&str, &str)] = &[
    ("open", "open to (120 mm, 80 mm)"),
    ("circle", "circle (60 mm, 45 mm) radius 10 mm"),
];

/// The pieces of a region: the first word, and how all of it looks.
pub const LOOPS: &[(&str, &str)] = &[
    ("start", "start (0 mm, 0 mm)"),
    ("line", "line to (120 mm, 0 mm)"),
    ("arc", "arc to (120 mm, 45 mm) radius 75 mm"),
    (
        "polyline",
        "polyline (120 mm, 0 mm) (120 mm, 45 mm) to (0 mm, 45 mm)",
    ),
    SIDES[0],
    SIDES[1],
    ("island", "island { circle (60 mm, 45 mm) radius 10 mm }"),
    ("dxf", "dxf \"tray.dxf\" { layer = \"SEAT\" }"),
    ("svg", "svg \"tray.svg\" { layer = \"SEAT\" }"),
];

/// Whether a word begins a piece of a profile or of a region.
pub fn begins_a_piece(word: &str) -> bool {
    CURVES.iter().chain(SIDES).any(|(known, _)| *known == word)
}

/// A profile in its short form, for each kind of file: its word, and how all of it looks.
pub fn short_forms() -> impl Iterator<Item = (&'static str, String)> {
    CURVES.iter().filter_map(|(word, form)| {
        data_file(word)?;
        let rest = form.strip_prefix(word)?.trim_start();
        let short = match rest.split_once(" { ") {
            Some((path, fields)) => format!("{word}({path}, {})", fields.trim_end_matches(" }")),
            None => format!("{word}({rest})"),
        };
        Some((*word, short))
    })
}

/// Words within a piece of a profile.
pub const JOINTS_OF_CURVES: &[&str] = &["to", "radius", "center", "through"];

/// Functions, each with a call of it.
pub fn functions() -> impl Iterator<Item = (&'static str, &'static str)> {
    functions::examples()
}

/// What a function takes and gives.
pub fn signature(function: &str) -> Option<Signature> {
    functions::signature(function)
}

/// A value within a call that a field of a machine takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// A quantity.
    Of(Dimension),
    /// Another call, with an example.
    Call(&'static str, &'static str),
}

/// The values with names of a call that a field of a machine takes, each with a typical value.
pub fn labels(call: &str) -> Vec<(&'static str, &'static str)> {
    parameters(call)
        .iter()
        .map(|parameter| (parameter.name, parameter.typical))
        .collect()
}

fn parameters(call: &str) -> &'static [Parameter<'static>] {
    match call {
        "frame" => frame::WITH_ANGLES,
        "load" => &load::PARAMETERS,
        _ => &[],
    }
}

/// What a value of a call is that a field of a machine takes: by its name, or by its place among those without names.
pub fn inside(call: &str, label: Option<&str>, place: usize) -> Option<Inside> {
    let of = |range: Range| Some(Inside::Of(range.dimension));
    match (call, label) {
        ("frame", Some("q")) => of(QUATERNION_PART),
        ("number", None) if place > 0 => Some(Inside::Call("frame", frame::FRAME)),
        ("number", None) => of(TABLE_NUMBER),
        ("joints", None) => of(AXIS_ANGLE),
        // Axes are called as on the control: X, Y and Z are straight, A, B and C turn (ISO 841).
        ("axes", Some("a" | "b" | "c")) => of(AXIS_ANGLE),
        ("axes", Some(_)) => of(COORDINATE),
        ("output" | "input", None) => of(SIGNAL),
        ("after", None) => of(WAIT),
        (_, Some(label)) => {
            let known = parameters(call)
                .iter()
                .find(|parameter| parameter.name == label)?;
            of(known.range)
        }
        (_, None) => None,
    }
}

/// Words with a meaning of their own in values.
pub const RESERVED: &[&str] = names::RESERVED;

/// Whether a text can be a name.
pub fn is_name(text: &str) -> bool {
    let mut letters = text.chars();
    letters
        .next()
        .is_some_and(|first| first == '_' || first.is_alphabetic())
        && letters.all(|letter| letter == '_' || letter.is_alphanumeric())
}

/// The units of a dimension, the usual one first.
pub fn units_for(dimension: Dimension) -> Vec<String> {
    let usual = dimension.unit();
    let rest = units::fitting(dimension)
        .into_iter()
        .filter(|unit| *unit != usual);
    let first = (!usual.is_empty()).then(|| usual.clone());
    first.into_iter().chain(rest).collect()
}

/// All simple units, each with what it is and what it comes to: `("in", "a length", "25.4 mm")`.
pub fn units() -> impl Iterator<Item = (&'static str, String, String)> {
    units::UNITS.iter().map(|unit| {
        let one = super::quantity::Quantity::new(unit.size, unit.dimension);
        (unit.name, unit.dimension.words(), one.text())
    })
}

/// The size of a unit as written: `25.4 mm`; none for an unknown unit.
pub fn unit_in_words(unit: &str) -> Option<(String, String)> {
    let one = units::quantity(1.0, unit)?;
    Some((one.dimension.words(), one.text()))
}

/// The name of a unit as written: `metre per minute`; none for an unknown unit.
pub fn unit_spoken(unit: &str) -> Option<String> {
    units::spoken(unit)
}

/// Where a block may be: in a job only, or in a library as well; none if its head is not right.
pub fn standing(block: &Block, operations: Operations) -> Option<Part> {
    Some(match heads::classify(block, operations).ok()? {
        Kind::Stock | Kind::Profile | Kind::Surface | Kind::Region(_) | Kind::Cell | Kind::Operation(_) => {
            Part::Job
        }
        Kind::Blade(_) | Kind::Machine(_) => Part::Library,
    })
}

/// The kind of machine that a word of a head means.
pub fn machine_kind(word: &str) -> Option<MachineKind> {
    let found = heads::MACHINES.iter().find(|(known, _)| *known == word);
    found.map(|(_, kind)| *kind)
}
