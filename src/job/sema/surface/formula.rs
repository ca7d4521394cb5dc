//! `z(x, y) = ...`: a surface by formula.

use super::Drawn;
use super::enclosure::Compiled;
use crate::sema::dimension::Dimension;
use crate::sema::eval::{Scope, walk};
use crate::sema::part::{Part, Sampling, Strip};
use crate::sema::quantity::{Quantity, mm};
use crate::sema::report::{Checked, Reported, Reports};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::profile::Profile;
use vcutc_surface::formula::{FormulaError, formula};
use vcutc_surface::surface::Surface;
use vcutc_syntax::ast::Expr;

/// A formula as it is written.
pub(super) struct Written<'a> {
    pub(super) variables: [&'a Spanned<String>; 2],
    pub(super) value: &'a Spanned<Expr>,
    pub(super) span: Span,
}

impl Written<'_> {
    /// The height at a place, both in mm.
    fn height(&self, [x, y]: [f64; 2], scope: Scope<'_>, reports: &mut Reports) -> Checked<f64> {
        let [across, along] = self.variables.map(|name| name.node.as_str());
        let variables = [(across, Quantity::length(x)), (along, Quantity::length(y))];
        let scope = Scope {
            variables: &variables,
            ..scope
        };
        scope.expect(self.value, Dimension::LENGTH, "`z`", Some("10 mm"), reports)
    }

    fn place(&self, [x, y]: [f64; 2]) -> String {
        let [across, along] = self.variables;
        format!("{} = {}, {} = {}", across.node, mm(x), along.node, mm(y))
    }

    /// Says why there is no height at a place, both in mm.
    fn without_value(&self, place: [f64; 2], scope: Scope<'_>, reports: &mut Reports) -> Reported {
        // The reason is the same wherever the formula fails first.
        let mut why = Reports::default();
        let outcome = self.height(place, scope, &mut why);
        let diagnostic = match (outcome, why.into_vec().into_iter().next()) {
            (Err(_), Some(reason)) => reason.note(format!("this is so at {}", self.place(place))),
            _ => Diagnostic::new(
                Code::NotFinite,
                format!("the formula has no value near {}", self.place(place)),
                self.value.span,
                "this gives no height",
            )
            .help("check what is divided, and what roots, powers and arcs are taken of"),
        };
        reports.push(diagnostic)
    }
}

pub(super) fn drawn(
    written: &Written<'_>,
    stock: Spanned<Stock>,
    scope: Scope<'_>,
    reports: &mut Reports,
) -> Checked<Drawn> {
    Ok(Drawn {
        surface: surface(written, stock, scope, reports)?,
        profile: profile(written, stock.node.width, scope),
    })
}

/// The profile of a formula without its second variable, as `profile { z(x) = ... }` has it.
fn profile(written: &Written<'_>, width: Length, scope: Scope<'_>) -> Option<Profile> {
    let [across, along] = written.variables;
    let changes =
        walk(written.value).any(|part| matches!(&part.node, Expr::Name(name) if *name == along.node));
    if changes {
        return None;
    }
    let sampling = Sampling {
        variable: &across.node,
        value: written.value,
        scope,
    };
    let points = sampling.points(width.to_mm(), Part::TOLERANCE).ok()?;
    Strip::cut(&points, width.to_mm()).profile(width.to_mm()).ok()
}

fn surface(
    written: &Written<'_>,
    stock: Spanned<Stock>,
    scope: Scope<'_>,
    reports: &mut Reports,
) -> Checked<Surface> {
    // Names and dimensions are the same everywhere, so one place shows what is wrong with them.
    let middle = [stock.node.width.to_mm() / 2.0, stock.node.depth.to_mm() / 2.0];
    let mut found = Reports::default();
    if written.height(middle, scope, &mut found).is_err() {
        return Err(written.without_value(middle, scope, reports));
    }
    let compiled = Compiled::of(
        written.value,
        written.variables.map(|name| name.node.as_str()),
        scope,
    );
    let Some(compiled) = compiled else {
        return Err(written.without_value(middle, scope, reports));
    };
    let meter = compiled.metered();
    let mesh = formula(
        &|x, y| meter.value(x, y),
        super::plan_of(stock.node),
        Part::SURFACE_TOLERANCE,
    );
    let span = written.value.span;
    match mesh {
        Ok(mesh) => {
            super::made(&mesh, stock.node).map_err(|error| reports.push(super::not_made(error, span)))
        }
        Err(_) if meter.is_used_up() => Err(too_rough(span, reports)),
        Err(FormulaError::NoValue { x, y }) => Err(written.without_value([x, y], scope, reports)),
        Err(FormulaError::Jump { x, y }) => Err(reports.push(
            Diagnostic::new(
                Code::ImpossibleSurface,
                format!("the formula steps at {}", written.place([x, y])),
                span,
                "a surface by formula has no vertical steps",
            )
            .help("replace the step by a steep ramp, for example over 0.1 mm"),
        )),
        Err(FormulaError::BadPlan | FormulaError::TooFine) => Err(too_rough(span, reports)),
    }
}

fn too_rough(span: Span, reports: &mut Reports) -> Reported {
    super::impossible(
        "the formula is too rough to follow within 10 um",
        span,
        "millions of triangles are not enough for it",
        reports,
    )
}
