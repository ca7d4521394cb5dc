//! A length that carries the blade so far out of the stock that no machine follows: its unit is the likelier cause than the place of
//! the work.

use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Op;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{Auto, BladeRef, CheckedJob, Operation};

/// How far out of the stock a tip is carried by lengths that are meant, at most, in mm.
const MEANT: f64 = 1000.0;

/// What is reported of an op that leads to such a tip. None where the tip is near the stock, or nothing says that the machine cannot
/// reach the stock itself. `place` says which op it is, such as `layer 7, cut 12`.
pub(super) fn far_outside(job: &CheckedJob, place: &str, op: &Op, tip: Point3) -> Option<Diagnostic> {
    let operation = job.operations.get(usize::from(op.site.operation()?.0))?;
    let asked = operation.setup();
    let above = tip.z - job.stock.height.to_mm();
    let beside = (-tip.y).max(tip.y - job.stock.depth.to_mm());
    let (far, side, field, span) = if above >= beside {
        (above, "above", "`clearance`", asked.clearance.span)
    } else {
        let (field, span) = run_out(&**operation);
        (beside, "beside", field, span)
    };
    let span = span.filter(|_| far > MEANT)?;
    let far = show((far / 10.0).round() * 10.0);
    let diagnostic = Diagnostic::new(
        Code::OutOfReach,
        format!("the machine does not reach {place}, {far} mm {side} the stock"),
        span,
        format!("the blade goes that far {side} the stock because of this length"),
    );
    Some(diagnostic.help(format!("check the unit of {field}")))
}

/// The field that makes cuts run out so far, and where it stands.
fn run_out(operation: &dyn Operation) -> (&'static str, Option<Span>) {
    let setup = operation.setup();
    let measure = |blade: &BladeRef<'_>| match blade {
        BladeRef::Straight(blade) => ("`cutting_length`", blade.cutting_length),
        BladeRef::Disc(disc) => ("`radius`", disc.radius),
        BladeRef::Crusher(crusher) => ("`radius`", crusher.radius),
    };
    let measures = operation.blades();
    let longest = measures
        .iter()
        .map(measure)
        .max_by(|(_, one), (_, other)| one.value.total_cmp(&other.value));
    match (setup.extension().value, longest) {
        (Auto::Given(_), _) => ("`extension`", setup.extension().span),
        (Auto::Auto, Some((field, longest))) if setup.run_out.value <= longest.value => (field, longest.span),
        (Auto::Auto, _) => ("`run_out`", setup.run_out.span),
    }
}
