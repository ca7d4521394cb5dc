//! The last lines about a program that differs from its job and of which nothing was found to be wrong.
//!
//! They must not read as a clearance to cut: the differences remain, speeds that are not the job's are proven for the machine
//! only, and some of what a program says was never judged.

use super::rebuild::Rebuilt;
use vcutc_backend_api::ir::{ActionKind, Op, Program, Purpose};
use vcutc_backend_api::readback::Resolution;
use vcutc_diagnostics::number::show;

/// Most kinds of changed speeds that are named.
const MOST_NAMED: usize = 3;

/// Speeds that agree within this share of their size are the same: a rate that is computed back from the words of a program
/// has the rounding of several of them.
const SAME_SHARE: f64 = 1e-5;

/// What moves at a speed, in the order in which it is reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Moved {
    /// The blade in a cut.
    Cut,
    /// The tip through the air.
    Travel,
    /// The blade about its tip.
    Turn,
}

/// Motions of one kind whose speed is not that of the job.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct OtherSpeed {
    moved: Moved,
    /// In the unit of what moves.
    is: f64,
    /// None where the job has no such motion.
    should: Option<f64>,
    count: usize,
}

/// The speeds of a rebuilt program that are not those of its job: cuts first, then in the order of the program.
pub(super) fn other_speeds(rebuilt: &Rebuilt, fresh: &Program, resolution: Resolution) -> Vec<OtherSpeed> {
    let mut found: Vec<OtherSpeed> = Vec::new();
    for (op, partner) in rebuilt.program.ops.iter().zip(&rebuilt.partners) {
        let partner = partner.and_then(|partner| fresh.op(partner));
        let should = partner.map_or([None, None], |partner| stated(fresh, partner));
        let is = stated(&rebuilt.program, op);
        for (is, should) in is.into_iter().zip(should) {
            let Some((moved, is)) = is else { continue };
            let should = should.map(|(_, should)| should);
            if should.is_some_and(|should| is_same(moved, is, should, resolution)) {
                continue;
            }
            let of_kind =
                |other: &&mut OtherSpeed| (other.moved, other.is, other.should) == (moved, is, should);
            match found.iter_mut().find(of_kind) {
                Some(known) => known.count += 1,
                None => found.push(OtherSpeed {
                    moved,
                    is,
                    should,
                    count: 1,
                }),
            }
        }
    }
    found.sort_by_key(|other| other.moved);
    found
}

/// The speeds of an op: of its tip, in mm/s, and of its turn, in deg/s.
fn stated(program: &Program, op: &Op) -> [Option<(Moved, f64)>; 2] {
    let moved = match op.action.kind() {
        ActionKind::CutLeft | ActionKind::CutRight => Moved::Cut,
        _ => Moved::Travel,
    };
    let feed = op.action.feed().and_then(|id| program.feed(id));
    let rate = op.action.rate().and_then(|id| program.rate(id));
    [
        feed.map(|feed| (moved, feed.to_mm_per_s())),
        rate.map(|rate| (Moved::Turn, rate.to_rad_per_s().to_degrees())),
    ]
}

fn is_same(moved: Moved, is: f64, should: f64, resolution: Resolution) -> bool {
    let resolution = match moved {
        Moved::Cut | Moved::Travel => resolution.speed.to_mm_per_s(),
        Moved::Turn => resolution.rate.to_rad_per_s().to_degrees(),
    };
    (is - should).abs() <= resolution + SAME_SHARE * should.abs()
}

/// The lines: what was proven, what differs in speed, what was not judged, and what to do.
pub(super) fn lines(purpose: Purpose, others: &[OtherSpeed]) -> Vec<String> {
    let proven = match purpose {
        Purpose::Work => {
            "proven at the speeds it states: the program frees every chip, stays out of the part, and is within \
             reach of the machine"
        }
        Purpose::AirCut { .. } => {
            "proven at the speeds it states: the air cut stays above the stock, leaves the generator off, and is \
             within reach of the machine"
        }
    };
    let mut lines = vec![proven.to_owned()];
    if !others.is_empty() {
        lines.push(format!(
            "its speeds are not those of the job: {}; whether blade and core can take them was not checked",
            words(others)
        ));
    }
    lines.push(
        "not checked: outputs other than the generator's, settings that only the controller uses, speeds of axis moves, and \
         what the controller does between two lines"
            .to_owned(),
    );
    lines.push(
        "the differences remain: before this program cuts, restore the job's lines, or change the job and compile it"
            .to_owned(),
    );
    lines
}

fn words(others: &[OtherSpeed]) -> String {
    let mut named: Vec<String> = others.iter().take(MOST_NAMED).map(in_words).collect();
    let rest = others
        .iter()
        .skip(MOST_NAMED)
        .map(|other| other.count)
        .sum::<usize>();
    match rest {
        0 => {}
        1 => named.push("1 more motion".to_owned()),
        rest => named.push(format!("{rest} more motions")),
    }
    named.join(", ")
}

fn in_words(other: &OtherSpeed) -> String {
    let (one, many, unit) = match other.moved {
        Moved::Cut => ("cut", "cuts", "mm/s"),
        Moved::Travel => ("motion", "motions", "mm/s"),
        Moved::Turn => ("turn", "turns", "deg/s"),
    };
    let kind = if other.count == 1 { one } else { many };
    let is = format!("{} {kind} at {} {unit}", other.count, show(other.is));
    match other.should {
        Some(should) => format!("{is} instead of {} {unit}", show(should)),
        None => format!("{is} that the job does not have"),
    }
}
