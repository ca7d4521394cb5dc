//! `nurbs { ... }`: a B-spline surface by its control points, in rows.
//!
//! A row holds the points along v for one place in u; weights stand beside their points. Knots that are not given are
//! uniform and clamped. Counts, orders and ranges are checked here, where each fault has its place in the text.

mod knots;

use super::Drawn;
use crate::sema::eval::Scope;
use crate::sema::field_ranges::COORDINATE;
use crate::sema::fields::{BlockSpec, ControlRow, Fields, Inner, Place, head_span, value};
use crate::sema::part::Part;
use crate::sema::quantity::number;
use crate::sema::read::{Reader, looks_like};
use crate::sema::report::Checked;
use crate::sema::session::Session;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::schema::dimension::Dimension;
use vcutc_diagnostics::schema::range::Range;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_surface::patch::{self, MOST_CONTROL, MOST_DEGREE, Nurbs, PatchError};
use vcutc_syntax::ast::{Block, Expr};

pub(crate) const SPEC: BlockSpec = BlockSpec {
    title: "`nurbs`",
    fields: &[
        value("degree", "(1, 1)").required(),
        value("u_knots", "(0, 0, 1, 1)"),
        value("v_knots", "(0, 0, 1, 1)"),
    ],
    inner: Inner::Rows,
};

const DEGREE: Range = Range::closed(Dimension::PURE, 1.0, MOST_DEGREE as f64);
/// The ratio of the ends is the largest that patches take.
const WEIGHT: Range = Range::closed(Dimension::PURE, 1e-3, 1e3);

/// A direction of a surface.
#[derive(Clone, Copy)]
enum Direction {
    /// From row to row.
    U,
    /// Along a row.
    V,
}

impl Direction {
    const fn knots(self) -> &'static str {
        match self {
            Self::U => "u_knots",
            Self::V => "v_knots",
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::U => "from row to row",
            Self::V => "along a row",
        }
    }

    /// So many control points in words.
    fn counted(self, count: usize) -> String {
        match self {
            Self::U => format!("{count} rows"),
            Self::V => format!("{count} points in a row"),
        }
    }
}

/// A point, and its weight if it has one.
type Control = (Point3, Option<f64>);

pub(super) fn drawn(
    block: &Block,
    stock: Spanned<Stock>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Drawn> {
    let head = head_span(block);
    let place = Place {
        head,
        whole: block.span,
    };
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    let damage = session.damage_at(block.span);
    let mut reader = Reader::new(scope, &mut session.reports);
    let control = control(&fields.rows, &mut reader);
    let columns = match damage {
        // A row that cannot be read is missing from those that are.
        Some(reported) => Err(reported),
        None => columns(&fields.rows, head, &mut reader),
    };
    let counts = columns.map(|columns| [fields.rows.len(), columns]);
    let degrees = degrees(&fields, counts, &mut reader);
    let (counts, degrees) = (counts?, degrees?);
    let mut knots = |direction: Direction, degree: usize, count: usize| {
        knots::read(&fields, direction, [degree, count], session.sources, &mut reader)
    };
    let knots = [
        knots(Direction::U, degrees[0], counts[0]),
        knots(Direction::V, degrees[1], counts[1]),
    ];
    let [u, v] = knots;
    let control = control?;
    let is_weighted = control.iter().any(|(_, weight)| weight.is_some());
    let surface = Nurbs {
        degrees,
        knots: [u?, v?],
        control: control.iter().map(|(point, _)| *point).collect(),
        weights: match is_weighted {
            true => control.iter().map(|(_, weight)| weight.unwrap_or(1.0)).collect(),
            false => Vec::new(),
        },
    };
    let made = match patch::nurbs(&surface, Part::SURFACE_TOLERANCE) {
        Ok(mesh) => super::made(&mesh, stock.node).map_err(|error| super::not_made(error, head)),
        Err(error) => Err(impossible(error, head)),
    };
    match made {
        Ok(surface) => Ok(Drawn {
            surface,
            profile: None,
            exact: None,
        }),
        Err(diagnostic) => Err(session.reports.push(diagnostic)),
    }
}

/// What is wrong with a surface as a whole.
pub(super) fn impossible(error: PatchError, span: Span) -> Diagnostic {
    match error {
        PatchError::Tolerance => Diagnostic::new(
            Code::ImpossibleSurface,
            "the surface is too curved to follow within 10 um",
            span,
            "20 million triangles are not enough for it",
        )
        .help("check the units of its points and its weights, or describe the part by a mesh"),
        PatchError::Degree
        | PatchError::ControlCount
        | PatchError::Knots
        | PatchError::NoExtent
        | PatchError::TooMany
        | PatchError::OutOfRange { .. }
        | PatchError::Weights => Diagnostic::new(
            Code::ImpossibleSurface,
            "there is no such surface",
            span,
            error.to_string(),
        )
        .help("check its degrees, knots and control points"),
    }
}

/// The number of points in each row.
fn columns(rows: &[ControlRow<'_>], head: Span, reader: &mut Reader<'_>) -> Checked<usize> {
    let [first, rest @ ..] = rows else {
        return Err(reader
            .reports
            .push(too_few_rows(head, "no row of control points")));
    };
    let count = first.points.len();
    let mut fault = None;
    if rest.is_empty() {
        fault = Some(too_few_rows(first.word, "the only row"));
    }
    if count < 2 {
        fault = Some(
            Diagnostic::new(
                Code::ImpossibleSurface,
                "a row of control points has two points or more",
                first.word,
                "a single point follows",
            )
            .help("write the points along the row one after the other: `row (0 mm, 0 mm, 20 mm) (0 mm, 1000 mm, 30 mm)`"),
        );
    }
    let mut reported = fault.map(|fault| reader.reports.push(fault));
    for row in rest.iter().filter(|row| row.points.len() != count) {
        let diagnostic = Diagnostic::new(
            Code::ImpossibleSurface,
            format!(
                "this row has {}, and the first one {count}",
                counted(row.points.len(), "point")
            ),
            row.word,
            "not as many points as the first row",
        )
        .and(first.word, format!("{} follow", counted(count, "point")))
        .help("write as many points in each row");
        reported = Some(reader.reports.push(diagnostic));
    }
    let all = rows.len().checked_mul(count).filter(|all| *all <= MOST_CONTROL);
    match (reported, all) {
        (Some(reported), _) => Err(reported),
        (None, Some(_)) => Ok(count),
        (None, None) => Err(reader.reports.push(
            Diagnostic::new(
                Code::ImpossibleSurface,
                "the surface has too many control points",
                head,
                format!("a surface has {} at most", number(MOST_CONTROL as f64)),
            )
            .help("describe the part by a mesh"),
        )),
    }
}

fn too_few_rows(span: Span, label: &str) -> Diagnostic {
    Diagnostic::new(
        Code::MissingField,
        "a surface by control points needs two rows or more",
        span,
        label,
    )
    .help("write a row for each place in u: `row (0 mm, 0 mm, 20 mm) (0 mm, 1000 mm, 30 mm)`")
}

/// The control points of all rows.
fn control(rows: &[ControlRow<'_>], reader: &mut Reader<'_>) -> Checked<Vec<Control>> {
    let points = rows.iter().flat_map(|row| row.points);
    let points: Vec<Checked<Control>> = points.map(|expr| point(expr, reader)).collect();
    points.into_iter().collect()
}

fn point(expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<Control> {
    let Expr::Tuple(parts) = &expr.node else {
        return Err(reader.reports.push(no_point(expr.span, looks_like(&expr.node))));
    };
    let ([x, y, z], weight) = match parts.as_slice() {
        [x, y, z] => ([x, y, z], None),
        [x, y, z, weight] => ([x, y, z], Some(weight)),
        parts => {
            let found = format!("{} values", parts.len());
            let diagnostic = crate::sema::decimal_comma::between(parts);
            return Err(reader
                .reports
                .push(diagnostic.unwrap_or_else(|| no_point(expr.span, &found))));
        }
    };
    let mut coordinate =
        |expr: &Spanned<Expr>, taker: &str| reader.within(expr, COORDINATE, taker, Some("10 mm"));
    let x = coordinate(x, "the x of a control point");
    let y = coordinate(y, "the y of a control point");
    let z = coordinate(z, "the z of a control point");
    let weight =
        weight.map(|weight| reader.within(weight, WEIGHT, "the weight of a control point", Some("1")));
    Ok((Point3::new(x?, y?, z?), weight.transpose()?))
}

fn no_point(span: Span, found: &str) -> Diagnostic {
    Diagnostic::new(
        Code::WrongKind,
        format!("a control point takes x, y and z, not {found}"),
        span,
        "expected three lengths here",
    )
    .help("write it like `(0 mm, 1000 mm, 30 mm)`, or with a weight: `(0 mm, 1000 mm, 30 mm, 0.7)`")
}

/// Degrees in u and v that there are enough control points for.
fn degrees(fields: &Fields<'_>, counts: Checked<[usize; 2]>, reader: &mut Reader<'_>) -> Checked<[usize; 2]> {
    let expr = fields.required_value("degree", reader.reports)?;
    let parts = match &expr.node {
        Expr::Tuple(parts) => parts.as_slice(),
        _ => &[],
    };
    let [u, v] = parts else {
        let found = match &expr.node {
            Expr::Tuple(parts) => format!("a list of {}", parts.len()),
            other => looks_like(other).to_owned(),
        };
        let diagnostic = Diagnostic::new(
            Code::WrongKind,
            format!("`degree` takes two degrees, not {found}"),
            expr.span,
            "expected two whole numbers here",
        )
        .help("give the degree from row to row and the one along a row, like `degree = (3, 3)`");
        return Err(reader.reports.push(diagnostic));
    };
    let counts = counts.ok();
    let mut degree = |expr: &Spanned<Expr>, direction: Direction, count: Option<usize>| {
        let taker = format!("the degree {}", direction.words());
        let degree = reader.whole(expr, DEGREE, &taker)? as usize;
        match count {
            Some(count) if count <= degree => {
                let most = count.saturating_sub(1);
                let diagnostic = Diagnostic::new(
                    Code::ImpossibleSurface,
                    format!(
                        "{} are too few for degree {degree} {}",
                        direction.counted(count),
                        direction.words()
                    ),
                    expr.span,
                    format!("takes {} or more", degree + 1),
                );
                Err(reader.reports.push(diagnostic.fix(
                    format!("lower the degree to {most}"),
                    expr.span,
                    most.to_string(),
                )))
            }
            Some(_) | None => Ok(degree),
        }
    };
    let u = degree(u, Direction::U, counts.map(|[rows, _]| rows));
    let v = degree(v, Direction::V, counts.map(|[_, columns]| columns));
    Ok([u?, v?])
}
