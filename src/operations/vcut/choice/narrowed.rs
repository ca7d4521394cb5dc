//! A swing held narrower than the job allows, because the machine does not follow a wider one.

use crate::asked::RoughVcut;
use crate::plan::PlannedVcut;
use crate::plan::decision::{Candidate, Decision, Standing};
use crate::plan::optimum::Bound;
use vcutc_backend_api::ir::AxisKind;
use vcutc_backend_api::units::Angle;
use vcutc_diagnostics::number::show;
use vcutc_job::search::{Followed, Lack, Narrowed};
use vcutc_job::{Auto, Bounds, Machine, Sourced};

/// What the swing of an operation is held within in addition to the job's limits.
pub(super) fn narrowed(asked: &RoughVcut, swing: Option<Narrowed>) -> Option<Narrowed> {
    let limits = asked.limits.swing;
    swing.filter(|swing| {
        asked.swing.value == Auto::Auto
            && limits.least.is_none_or(|least| least.value <= swing.widest)
            && limits.most.is_none_or(|most| most.value > swing.widest)
    })
}

/// The operation with a narrower limit on its swing.
pub(super) fn within(asked: &RoughVcut, swing: Option<Narrowed>) -> RoughVcut {
    let mut asked = asked.clone();
    if let Some(swing) = narrowed(&asked, swing) {
        asked.limits.swing.most = Some(Sourced {
            value: swing.widest,
            span: None,
        });
    }
    asked
}

/// Gives a planned operation the job's own limits on the swing back.
pub(super) fn restore(vcut: &mut PlannedVcut, limits: Bounds<Angle>) {
    vcut.asked.limits.swing = limits;
    vcut.parameters.binding.retain(|&bound| bound != Bound::SwingMost);
}

/// Says what narrowed the swing of a planned operation.
pub(super) fn explain(vcut: &mut PlannedVcut, swing: Narrowed, machine: Option<&Machine>) {
    let most = format!("at most {}", degrees(swing.widest));
    let decision = decision((most, Standing::Narrowed), (swing.lack, swing.refused), machine);
    vcut.decisions.insert(0, decision);
}

/// Says why the swing of a planned operation is narrower than the best one without a machine, where plans were compared on the machine.
pub(super) fn explain_on_machine(vcut: &mut PlannedVcut, followed: Followed, machine: Option<&Machine>) {
    let is_open = vcut.asked.swing.value == Auto::Auto;
    let swing = vcut.parameters.swing;
    if let Some(refused) = followed.refused.filter(|&refused| is_open && swing < refused) {
        let decision = decision(
            (degrees(swing), Standing::OnMachine),
            (followed.lack, refused),
            machine,
        );
        vcut.decisions.insert(0, decision);
    }
}

fn decision(
    (what, standing): (String, Standing),
    (lack, refused): (Lack, Angle),
    machine: Option<&Machine>,
) -> Decision {
    Decision {
        field: "swing",
        taken: Candidate { what, standing },
        others: vec![Candidate {
            what: format!("{} at {}", lack_in_words(lack, machine), degrees(refused)),
            standing: Standing::NotFollowed,
        }],
    }
}

fn degrees(swing: Angle) -> String {
    format!("{} deg", show(swing.to_deg()))
}

/// `A4 too slow`, with how fast it would have to be.
fn lack_in_words(lack: Lack, machine: Option<&Machine>) -> String {
    let axis = |index: usize| machine.and_then(|machine| machine.model.axes.get(index));
    match lack {
        Lack::Reach => "out of reach".to_owned(),
        Lack::Clearance => "too close to a singularity".to_owned(),
        Lack::Range { axis: index } => match axis(index) {
            Some(axis) => format!("{} leaves its range", axis.name),
            None => "an axis leaves its range".to_owned(),
        },
        Lack::Rate { axis: index, needed } => match axis(index) {
            Some(axis) => {
                let shown = |rate: f64| match axis.kind {
                    AxisKind::Rotary => format!("{:.1} deg/s", rate.to_degrees()),
                    AxisKind::Linear => format!("{rate:.1} mm/s"),
                };
                let limit = axis
                    .rate
                    .map_or_else(String::new, |limit| format!(" of {}", shown(limit)));
                format!("{} would need {}{limit}", axis.name, shown(needed))
            }
            None => "an axis is too slow".to_owned(),
        },
    }
}
