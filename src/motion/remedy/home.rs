//! A home above the first cut.

use super::{Case, Remedy, trial, wording};
use crate::moves::above_first_pose;
use crate::rig::Rig;
use vcutc_backend_api::ir::AxisValues;
use vcutc_job::Machine;

/// How far above the first pose of the program the blade is at home, in mm.
const RAISED: [f64; 3] = [100.0, 300.0, 0.0];
/// Most homes that are tried.
const MOST_HOMES: usize = 6;

/// A home from which the blade comes to the work from above, in whole degrees.
pub(super) fn raised(case: &mut Case<'_>) -> Option<Remedy> {
    let now = case.machine.home?;
    let program = case.unreachable.program.program();
    let model = case.machine.model.clone();
    let rig = Rig::new(
        &model,
        case.machine.tool.value.frame,
        case.machine.base.value.frame,
    );
    let mut homes = 0;
    for raised in RAISED {
        let above = above_first_pose(program, raised)?;
        for solution in rig.mechanism.all(&rig.flange_in_root(&above)).iter() {
            let within = model
                .axes
                .iter()
                .zip(solution.joints)
                .all(|(axis, value)| (axis.min..=axis.max).contains(&value));
            if !within {
                continue;
            }
            if homes == MOST_HOMES || !case.may_try() {
                return None;
            }
            homes += 1;
            let home = wording::rounded_home(&model.axes, &AxisValues(solution.joints));
            let raise = |machine: &mut Machine| {
                if let Some(stated) = &mut machine.home {
                    stated.value = home;
                }
            };
            let works = trial::with_machine(case.plan, raise, case.wanted);
            if let Some(Ok(_)) = works {
                let text = wording::home_text(&model, &home);
                let advice = format!("begin above the work: `home = {text}`");
                return Some(Remedy::replace(advice, now.span, text));
            }
        }
    }
    None
}
