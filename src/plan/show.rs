//! A plan as text, for people who want to see what was decided (`--emit plan`).

use super::{PlannedJob, PlannedOperation, PlannedVcut, TipOrigin};
use std::fmt::Write as _;

/// The plan, one line a parameter and one line a cut.
#[must_use]
pub fn show(plan: &PlannedJob) -> String {
    let mut text = String::new();
    let stock = plan.stock;
    line(&mut text, format_args!("job {:?}", plan.name));
    line(
        &mut text,
        format_args!("stock {} x {} x {} mm", stock.width.to_mm(), stock.depth.to_mm(), stock.height.to_mm()),
    );
    line(&mut text, format_args!("profile of {} corners", plan.profile.points().len()));
    for operation in &plan.operations {
        match operation {
            PlannedOperation::RoughVcut(vcut) => show_vcut(&mut text, vcut),
        }
    }
    text
}

fn show_vcut(text: &mut String, vcut: &PlannedVcut) {
    let p = &vcut.parameters;
    line(text, format_args!("rough vcut"));
    line(text, format_args!("  swing      {:.4} deg", p.swing.to_deg()));
    for (name, length) in [
        ("layer", p.layer),
        ("step", p.step),
        ("extension", p.extension),
        ("standoff", p.standoff),
        ("drop", p.drop),
        ("reach", p.flanks.reach),
    ] {
        line(text, format_args!("  {name:<10} {:.3} mm", length.to_mm()));
    }
    line(text, format_args!("  estimate   {:.1} s", vcut.estimate.to_s()));
    for layer in vcut.cuts.chunk_by(|a, b| a.layer == b.layer) {
        for (number, cut) in (1..).zip(layer) {
            let origin = match cut.origin {
                TipOrigin::Lattice => "",
                TipOrigin::Lifted => "  lifted",
                TipOrigin::Shifted => "  shifted",
                TipOrigin::Relieved => "  relieved",
            };
            line(
                text,
                format_args!("  layer {} cut {number}  x {:.3}  z {:.3}{origin}", cut.layer, cut.tip.x, cut.tip.z),
            );
        }
    }
}

fn line(text: &mut String, line: std::fmt::Arguments<'_>) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{line}");
}
