//! Frames of a machine: `frame(x = , y = , z = , ...)` with angles or a quaternion, and `number(3, frame(...))` for one
//! that the controller keeps too.

use super::arguments::{Arguments, Parameter, calls};
use super::field_ranges::{COORDINATE, FRAME_ANGLE, QUATERNION_PART, TABLE_NUMBER};
use super::fields::Fields;
use super::quantity::number;
use super::read::{Reader, looks_like, sourced};
use super::report::Checked;
use crate::Sourced;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::PlacedFrame;
use vcutc_backend_api::units::Angle;
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Argument, Expr};

/// How a frame is written.
pub(crate) const FRAME: &str = "frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)";
const KEPT: &str = "number(3, frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg))";

/// Where a mesh lies, as it is written.
pub(crate) const PLACE: &str = "frame(x = 0 mm, y = 0 mm, z = 0 mm, a = 0 deg, b = 0 deg, c = 0 deg)";

/// The call that says where a mesh lies.
pub(crate) const PLACES: &[(&str, &str)] = &[("frame", PLACE)];

/// The calls that a field of a frame takes.
pub(crate) const CALLS: &[(&str, &str)] = &[("frame", FRAME), ("number", KEPT)];

/// A coordinate of a frame's origin or a load's centre.
pub(crate) const fn coordinate(name: &str) -> Parameter<'_> {
    Parameter {
        name,
        range: COORDINATE,
        typical: "0 mm",
    }
}

const fn angle(name: &str) -> Parameter<'_> {
    Parameter {
        name,
        range: FRAME_ANGLE,
        typical: "0 deg",
    }
}

const ORIGIN: &[Parameter<'_>; 3] = &[coordinate("x"), coordinate("y"), coordinate("z")];
/// The values of a frame with angles.
pub(crate) const WITH_ANGLES: &[Parameter<'_>; 6] = &[
    coordinate("x"),
    coordinate("y"),
    coordinate("z"),
    angle("a"),
    angle("b"),
    angle("c"),
];

/// A number of the controller's own table, from 1.
pub(crate) fn table_number(expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<u32> {
    reader.whole(expr, TABLE_NUMBER, "a number of the controller's table")
}

/// A frame that no controller keeps.
pub(crate) fn plain(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<Frame> {
    let call = calls(field, expr, PLACES, reader.reports)?;
    frame(call, reader)
}

/// The field of a frame.
pub(crate) fn read(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<PlacedFrame> {
    let call = calls(field, expr, CALLS, reader.reports)?;
    if call.function == "number" {
        return kept(field, &call, reader);
    }
    Ok(PlacedFrame {
        frame: frame(call, reader)?,
        number: None,
    })
}

/// A frame that the controller keeps: its number and its values.
fn kept(field: &str, call: &Arguments<'_>, reader: &mut Reader<'_>) -> Checked<PlacedFrame> {
    match call.all() {
        [
            Argument {
                name: None,
                value: number,
            },
            Argument {
                name: None,
                value: frame_expr,
            },
        ] => {
            let number = table_number(number, reader);
            let call = calls(field, frame_expr, &[("frame", FRAME)], reader.reports);
            let frame = call.and_then(|call| frame(call, reader));
            Ok(PlacedFrame {
                number: Some(number?),
                frame: frame?,
            })
        }
        [Argument { name: None, value }] => {
            let number = table_number(value, reader)?;
            let diagnostic = Diagnostic::new(
                Code::BadCall,
                format!("`number({number})` alone does not say where the frame is"),
                call.span,
                "its values are missing",
            )
            .note(
                "the program takes the frame from the controller's table, but reach cannot be proven without its values",
            )
            .help(format!(
                "write the values that the controller shows: `{field} = number({number}, {FRAME})`"
            ));
            Err(reader.reports.push(diagnostic))
        }
        _ => {
            let diagnostic = call.misfit(
                "`number` takes a number of the controller's table and a frame".to_owned(),
                call.span,
                "expected two values here",
            );
            Err(reader.reports.push(diagnostic))
        }
    }
}

/// The values of a frame.
fn frame(mut call: Arguments<'_>, reader: &mut Reader<'_>) -> Checked<Frame> {
    let quaternions = call.take(&["q"]);
    let (origin, orientation) = match quaternions.as_slice() {
        [] => {
            let [x, y, z, a, b, c] = call.named(WITH_ANGLES, reader)?;
            let angles = Zyx {
                a: Angle::rad(a),
                b: Angle::rad(b),
                c: Angle::rad(c),
            };
            (Point3::new(x, y, z), Orientation::from_zyx(angles))
        }
        [quaternion, surplus @ ..] => {
            let angles = call.take(&["a", "b", "c"]);
            if let Some(other) = angles.iter().chain(surplus).next() {
                let diagnostic = Diagnostic::new(
                    Code::BadCall,
                    "the orientation of the frame is given twice",
                    other.value.span,
                    "given again here",
                )
                .and(quaternion.value.span, "first given here")
                .help("write either `q = (w, x, y, z)` or `a`, `b` and `c`");
                return Err(reader.reports.push(diagnostic));
            }
            let origin = call.named(ORIGIN, reader);
            let orientation = rotation(&quaternion.value, reader);
            let [x, y, z] = origin?;
            (Point3::new(x, y, z), orientation?)
        }
    };
    Ok(Frame { origin, orientation })
}

/// How far the length of a quaternion may be from 1. Pendants show four to six digits.
const LENGTH_TOLERANCE: f64 = 1e-3;

/// The orientation of a quaternion `(w, x, y, z)`, the order of ABB's controllers.
fn rotation(expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<Orientation> {
    let parts = match &expr.node {
        Expr::Tuple(parts) => parts.as_slice(),
        Expr::Number { .. }
        | Expr::Text(_)
        | Expr::Name(_)
        | Expr::Call { .. }
        | Expr::Negate(_)
        | Expr::Binary { .. } => {
            let found = looks_like(&expr.node).to_owned();
            return Err(reader.reports.push(no_quaternion(expr, &found)));
        }
    };
    let values: Vec<Checked<f64>> = parts
        .iter()
        .map(|part| reader.within(part, QUATERNION_PART, "a part of a quaternion", None))
        .collect();
    let values: Vec<f64> = values.into_iter().collect::<Checked<_>>()?;
    let &[w, x, y, z] = values.as_slice() else {
        let found = format!("{} values", values.len());
        return Err(reader.reports.push(no_quaternion(expr, &found)));
    };
    let length = libm::sqrt(w * w + x * x + y * y + z * z);
    match Orientation::from_quaternion(w, x, y, z) {
        Some(orientation) if (length - 1.0).abs() <= LENGTH_TOLERANCE => Ok(orientation),
        unit => {
            let diagnostic = Diagnostic::new(
                Code::NotARotation,
                format!("a quaternion of length {} is not a rotation", number(length)),
                expr.span,
                format!("its length is {}, not 1", number(length)),
            );
            Err(reader.reports.push(match unit {
                Some(unit) => {
                    let text = format!("({})", unit.quaternion().map(number).join(", "));
                    diagnostic.fix(format!("scale it to length 1: `q = {text}`"), expr.span, text)
                }
                None => diagnostic.help("for no rotation write `q = (1, 0, 0, 0)`"),
            }))
        }
    }
}

fn no_quaternion(expr: &Spanned<Expr>, found: &str) -> Diagnostic {
    Diagnostic::new(
        Code::WrongKind,
        format!("`q` takes the four parts of a quaternion, not {found}"),
        expr.span,
        "expected four numbers in brackets here",
    )
    .help("write it like `q = (1, 0, 0, 0)`, with w first")
}

/// The frame of a field that must be there.
pub(crate) fn required_frame(
    fields: &Fields<'_>,
    name: &str,
    reader: &mut Reader<'_>,
) -> Checked<Sourced<PlacedFrame>> {
    let expr = fields.required_value(name, reader.reports)?;
    Ok(sourced(read(name, expr, reader)?, expr.span))
}
