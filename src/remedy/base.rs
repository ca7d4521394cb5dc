//! The base moved or turned by the least that helps.
//!
//! Places around the present one are judged by the taught poses and a few telling motions, the nearest first; the first that promise
//! something are put to the whole proof. A place that fails there makes its neighbours unlikely, so the next to be proven is some way further.

use super::{Case, Remedy, trial, wording};
use crate::plan::parameters::show;
use crate::reach::place::score::{Effort, Judge};
use crate::reach::place::search::ask_all;
use crate::reach::place::strokes::Strokes;
use crate::reach::place::taught::TaughtPoses;
use crate::reach::rig::Rig;
use crate::reach::trouble::Trouble;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::{MachineKind, PlacedFrame};
use vcutc_backend_api::units::{Angle, Length};

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
struct Shift {
    by: [f64; 3],
    turn: f64,
}

impl Shift {
    /// How far it is, in mm or deg: shifts of one kind are compared only.
    fn size(&self) -> f64 {
        let [x, y, z] = self.by;
        (x * x + y * y + z * z).sqrt() + self.turn.abs()
    }

    /// What a move of the base is called.
    fn how(&self) -> String {
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

    fn of(&self, base: &Frame) -> Frame {
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
pub(super) fn moved(case: &mut Case<'_>) -> Option<Remedy> {
    let elsewhere = moved_to(case)?;
    Some(remedy(case, &elsewhere))
}

/// Distances of the work's middle from the first axis of an arm, as shares of its reach, the farthest first.
const AWAY: [f64; 6] = [0.74, 0.66, 0.58, 0.5, 0.42, 0.35];
/// How far the work is lifted or lowered there, in mm.
const LIFTS: [f64; 5] = [0.0, 200.0, -200.0, 400.0, -400.0];

/// The base straight towards an arm that the work is far away from: so far that steps around the present place lead nowhere.
pub(super) fn nearer(case: &mut Case<'_>) -> Option<Remedy> {
    let model = &case.machine.model;
    let (middle, reach) = (middle_in_root(case), model.reach());
    let distance = libm::hypot(middle.x, middle.y);
    if model.kind() != MachineKind::Robot || distance <= reach {
        return None;
    }
    // Whole centimetres: nobody measures a place of the work in its cell finer than that.
    let tens = |value: f64| (value / 10.0).round() * 10.0;
    let towards = |share: f64| {
        let way = (share * reach - distance) / distance;
        [tens(middle.x * way), tens(middle.y * way)]
    };
    let shifts = AWAY.map(towards).into_iter().flat_map(|[x, y]| {
        LIFTS.map(|lift| Shift {
            by: [x, y, lift],
            turn: 0.0,
        })
    });
    let (shift, base) = nearest(case, shifts.collect(), |mut shifts| {
        shifts.retain(|shift| shift.by[2] == 0.0);
        shifts
    })?;
    let elsewhere = Elsewhere {
        how: shift.how(),
        base,
    };
    Some(remedy(case, &elsewhere))
}

/// The middle of the stock, seen from the machine's root.
fn middle_in_root(case: &Case<'_>) -> Point3 {
    let stock = case.unreachable.program.program().stock;
    let half = |size: Length| size.to_mm() / 2.0;
    let middle = Point3::new(half(stock.width), half(stock.depth), half(stock.height));
    rig(case).point_in_root(middle)
}

fn rig<'c>(case: &Case<'c>) -> Rig<'c> {
    let machine = case.machine;
    Rig::new(&machine.model, machine.tool.value.frame, machine.base.value.frame)
}

/// The base turned about the root's z by the least.
pub(super) fn turned(case: &mut Case<'_>) -> Option<Remedy> {
    let elsewhere = turned_to(case)?;
    Some(remedy(case, &elsewhere))
}

/// Another place for the base.
#[derive(Clone, Debug, PartialEq)]
pub struct Elsewhere {
    /// How it comes there, in the imperative.
    pub how: String,
    /// The place, as it is written.
    pub base: PlacedFrame,
}

/// Where the base comes to when it is moved by the least.
pub(super) fn moved_to(case: &mut Case<'_>) -> Option<Elsewhere> {
    let ways = || [-1.0, 0.0, 1.0].into_iter();
    let directions = ways().flat_map(|x| ways().flat_map(move |y| ways().map(move |z| [x, y, z])));
    let shifts = directions
        .filter(|direction| *direction != [0.0; 3])
        .flat_map(|direction| DISTANCES.map(|distance| direction.map(|part| part * distance)))
        .map(|by| Shift { by, turn: 0.0 });
    let (shift, base) = nearest(case, shifts.collect(), along_one_axis)?;
    Some(Elsewhere {
        how: shift.how(),
        base,
    })
}

/// Where the base comes to when it is turned by the least.
pub(super) fn turned_to(case: &mut Case<'_>) -> Option<Elsewhere> {
    let turns = TURNS.into_iter().flat_map(|turn| [turn, -turn]);
    let shifts = turns.map(|turn| Shift { by: [0.0; 3], turn });
    let (shift, base) = nearest(case, shifts.collect(), along_one_axis)?;
    let turn = show(shift.turn);
    Some(Elsewhere {
        how: format!("turn the base by {turn} deg about z"),
        base,
    })
}

fn remedy(case: &Case<'_>, elsewhere: &Elsewhere) -> Remedy {
    let Elsewhere { how, base } = elsewhere;
    let text = wording::frame_text(base);
    Remedy::replace(format!("{how}: `base = {text}`"), case.machine.base.span, text)
}

/// The motion that fails.
fn failing(case: &Case<'_>) -> Strokes {
    let program = case.unreachable.program.program();
    match &case.unreachable.trouble {
        Trouble::Motion { failing, .. } | Trouble::NoCommonBranch { failing, .. } => {
            Strokes::only(program, failing.op)
        }
        Trouble::Way { .. } | Trouble::Sweep(_) | Trouble::Nowhere => Strokes::default(),
    }
}

/// A third of the shifts, and only those along one axis.
fn along_one_axis(shifts: Vec<Shift>) -> Vec<Shift> {
    let one = |shift: &Shift| shift.by.iter().filter(|part| **part != 0.0).count() <= 1;
    shifts.into_iter().filter(one).step_by(3).collect()
}

/// The nearest of these places that carries out the whole program. `thinned` leaves the few of them, in order, that are worth asking
/// a machine about whose poses are searched for numerically.
fn nearest(
    case: &mut Case<'_>,
    mut shifts: Vec<Shift>,
    thinned: impl FnOnce(Vec<Shift>) -> Vec<Shift>,
) -> Option<(Shift, PlacedFrame)> {
    // Stable, so that of equally near ones the first stays first.
    shifts.sort_by(|a, b| a.size().total_cmp(&b.size()));
    let now = case.machine.base.value;
    let rig = rig(case);
    let poses = TaughtPoses::of(&case.unreachable.program);
    let judge = Judge::new(
        rig.mechanism,
        rig.axes,
        &rig.flange_in_blade,
        poses.telling(SPREAD),
    );
    if judge.effort() == Effort::Sparing {
        shifts = thinned(shifts);
    }
    let (failing, others) = (failing(case), Strokes::of(case.unreachable.program.program()));
    let mut proofs = 0;
    let mut failed_at = 0.0;
    for batch in shifts.chunks(JUDGED) {
        if case.wanted.is_needless() {
            return None;
        }
        let promising = ask_all(batch, |shift| {
            let there = Rig {
                work_in_root: shift.of(&now.frame).into(),
                ..rig.clone()
            };
            // The motion that fails first: nearly always it says no, and it costs least.
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
            let base = PlacedFrame {
                frame: shift.of(&now.frame),
                ..now
            };
            if let Some(Ok(_)) = trial::with_base(case.plan, base, case.wanted) {
                return Some((*shift, base));
            }
            failed_at = shift.size();
        }
    }
    None
}
