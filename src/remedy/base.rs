//! The base moved or turned by the least that helps.
//!
//! Places around the present one are judged by the taught poses and the critical motions, the nearest first; the first that promise
//! something are put to the whole proof. A place that fails there makes its neighbours unlikely, so the next to be proven is some way further.

use crate::case::Case;
use crate::change::{Change, Elsewhere};
use crate::wording;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::PlacedFrame;
use vcutc_backend_api::units::Angle;
use vcutc_diagnostics::number::show;
use vcutc_motion::critical::ask_all;
use vcutc_motion::critical::margin::{Effort, Judge};
use vcutc_motion::critical::motions::CriticalMotions;
use vcutc_motion::critical::poses::TaughtPoses;
use vcutc_motion::rig::Rig;

/// How far the base is moved along a direction, in mm.
const DISTANCES: [f64; 14] = [
    10.0, 20.0, 40.0, 60.0, 80.0, 100.0, 150.0, 200.0, 250.0, 300.0, 400.0, 500.0, 700.0, 1000.0,
];
/// By how much the work is turned, in degrees.
const TURNS: [f64; 12] = [
    5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0,
];
/// Least margin at the taught poses that makes a place worth proving.
const PROMISING: f64 = 0.01;
/// Most places that are proven for one remedy.
const MOST_PROOFS: usize = 5;
/// How much further the next place to be proven is.
const FURTHER: f64 = 1.2;
/// Places that are judged at once.
const JUDGED: usize = 52;
/// Poses beside the outermost ones, for each orientation.
const SPREAD: usize = 4;

/// A change of the base: by these mm along the root's axes, and turned by these degrees about its z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shift {
    pub(crate) by: [f64; 3],
    pub(crate) turn: f64,
}

impl Shift {
    /// How far it is, in mm or deg: shifts of one kind are compared only.
    fn size(&self) -> f64 {
        let [x, y, z] = self.by;
        (x * x + y * y + z * z).sqrt() + self.turn.abs()
    }

    /// What it is called, in the imperative.
    pub(crate) fn how(&self) -> String {
        if self.turn != 0.0 {
            return format!("turn the base by {} deg about z", show(self.turn));
        }
        let parts = ["x", "y", "z"]
            .into_iter()
            .zip(self.by)
            .filter(|(_, part)| *part != 0.0);
        let parts: Vec<String> = parts
            .map(|(axis, part)| {
                let sign = if part > 0.0 { "+" } else { "" };
                format!("{axis} {sign}{} mm", show(part))
            })
            .collect();
        format!("move the base by {}", parts.join(", "))
    }

    pub(crate) fn of(&self, base: &Frame) -> Frame {
        let [x, y, z] = self.by;
        let now = base.orientation.to_zyx();
        wording::rounded(&Frame {
            origin: Point3::new(base.origin.x + x, base.origin.y + y, base.origin.z + z),
            orientation: Orientation::from_zyx(Zyx {
                a: now.a + Angle::deg(self.turn),
                ..now
            }),
        })
    }
}

/// The base moved by the least, along one axis or several.
pub(crate) fn moved(case: &mut Case<'_>) -> Option<Change> {
    moved_to(case).and_then(|elsewhere| confirmed(case, &elsewhere))
}

/// The base turned about the root's z by the least.
pub(crate) fn turned(case: &mut Case<'_>) -> Option<Change> {
    turned_to(case).and_then(|elsewhere| confirmed(case, &elsewhere))
}

pub(crate) fn confirmed(case: &mut Case<'_>, elsewhere: &Elsewhere) -> Option<Change> {
    case.confirmed(Change::base(case.job, elsewhere))
}

/// Where the base comes to when it is moved by the least.
pub(crate) fn moved_to(case: &mut Case<'_>) -> Option<Elsewhere> {
    let ways = || [-1.0, 0.0, 1.0].into_iter();
    let directions = ways().flat_map(|x| ways().flat_map(move |y| ways().map(move |z| [x, y, z])));
    let shifts = directions
        .filter(|direction| *direction != [0.0; 3])
        .flat_map(|direction| DISTANCES.map(|distance| direction.map(|part| part * distance)))
        .map(|by| Shift { by, turn: 0.0 });
    nearest(case, shifts.collect(), along_one_axis)
}

/// Where the base comes to when it is turned by the least.
pub(crate) fn turned_to(case: &mut Case<'_>) -> Option<Elsewhere> {
    let turns = TURNS.into_iter().flat_map(|turn| [turn, -turn]);
    let shifts = turns.map(|turn| Shift { by: [0.0; 3], turn });
    nearest(case, shifts.collect(), along_one_axis)
}

/// A third of the shifts, and only those along one axis.
fn along_one_axis(shifts: Vec<Shift>) -> Vec<Shift> {
    let one = |shift: &Shift| shift.by.iter().filter(|part| **part != 0.0).count() <= 1;
    shifts.into_iter().filter(one).step_by(3).collect()
}

/// The nearest of these places that carries out the whole program. `thinned` leaves the few of them, in order, that are worth asking
/// a machine about whose poses are searched for numerically.
pub(crate) fn nearest(
    case: &mut Case<'_>,
    mut shifts: Vec<Shift>,
    thinned: impl FnOnce(Vec<Shift>) -> Vec<Shift>,
) -> Option<Elsewhere> {
    // Stable, so that of equally near ones the first stays first.
    shifts.sort_by(|a, b| a.size().total_cmp(&b.size()));
    let now = case.machine.base.value;
    let program = &case.unreachable.program;
    let rig = Rig::of(case.machine);
    let judge = Judge::new(&rig, TaughtPoses::of(program).outermost(SPREAD));
    if judge.effort() == Effort::Sparing {
        shifts = thinned(shifts);
    }
    // The motion that fails first: nearly always it says no, and it costs least.
    let failing = case.unreachable.trouble.failing();
    let failing = failing.map_or_else(CriticalMotions::default, |failing| {
        CriticalMotions::only(program.program(), failing.op)
    });
    let others = CriticalMotions::of(program.program());
    let mut proofs = 0;
    let mut failed_at = 0.0;
    for batch in shifts.chunks(JUDGED) {
        if case.budget.wanted.is_needless() {
            return None;
        }
        let promising = ask_all(batch, |shift| {
            let there = rig.with_work(shift.of(&now.frame).into());
            failing.are_followed(&there)
                && judge
                    .score(&there.work_in_root)
                    .reached()
                    .is_some_and(|margin| margin >= PROMISING)
                && others.are_each_followed(&there)
        });
        for (shift, _) in batch.iter().zip(promising).filter(|(_, promising)| *promising) {
            if shift.size() < failed_at * FURTHER {
                continue;
            }
            if proofs == MOST_PROOFS || !case.may_try() {
                return None;
            }
            proofs += 1;
            let elsewhere = Elsewhere {
                how: shift.how(),
                base: PlacedFrame {
                    frame: shift.of(&now.frame),
                    ..now
                },
            };
            let change = Change::base(case.job, &elsewhere);
            // There, the job may fall back in another way than here.
            if case.passes(&change) || case.compiles(&change) {
                return Some(elsewhere);
            }
            failed_at = shift.size();
        }
    }
    None
}
