//! A swing held narrower than the job allows, because the machine does not follow a wider one.

use crate::asked::RoughVcut;
use crate::plan::PlannedVcut;
use crate::plan::decision::{Candidate, Decision, Standing};
use crate::plan::optimum::Bound;
use vcutc_backend_api::ir::AxisKind;
use vcutc_backend_api::units::Angle;
use vcutc_diagnostics::number::show;
use vcutc_job::search::{Lack, Narrowed};
use vcutc_job::{Auto, Bounds, Machine, Sourced};

/// What the swing of an operation is held within besides the job's limits.
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

/// Gives a planned operation the job's own limits back, and says what narrowed its swing.
pub(super) fn told(
    vcut: &mut PlannedVcut,
    limits: Bounds<Angle>,
    swing: Narrowed,
    machine: Option<&Machine>,
) {
    vcut.asked.limits.swing = limits;
    vcut.parameters.binding.retain(|&bound| bound != Bound::SwingMost);
    let degrees = |swing: Angle| format!("{} deg", show(swing.to_deg()));
    let decision = Decision {
        field: "swing",
        taken: Candidate {
            what: format!("at most {}", degrees(swing.widest)),
            standing: Standing::Narrowed,
        },
        others: vec![Candidate {
            what: format!(
                "{} at {}",
                lack_in_words(swing.lack, machine),
                degrees(swing.refused)
            ),
            standing: Standing::NotFollowed,
        }],
    };
    vcut.decisions.insert(0, decision);
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
