//! What the limits of a pocket ask of passes, before they are a program: how much stays uncut, and where the tool has to be slow
//! because more of its rim is in the material than may be at the speed of cutting. The proof says both again, of the program.

use super::{Kind, Leg, Run};
use crate::asked::ClearPocket;
use vcutc_backend_api::units::Angle;
use vcutc_process::from_above::reaching;
use vcutc_region::coverage::{Tool, coverage};
use vcutc_region::engagement::{Stretch, engagement};
use vcutc_region::pass::Pass;

/// How passes stand to the limit on what stays uncut, the worse first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Standing {
    /// They break it, or it is not known.
    Breaks,
    /// They keep it.
    Keeps,
}

/// How the runs of a layer stand.
pub(super) fn standing(runs: &[Run], asked: &ClearPocket, keep: f64) -> Standing {
    let radius = asked.crusher.radius.value.to_mm();
    let left = coverage(
        &asked.region.region,
        &passes(runs),
        reaching(Tool { radius, keep }),
    );
    match left {
        Ok(left) if left.uncut <= asked.limits.uncut.value.to_mm2() => Standing::Keeps,
        Ok(_) | Err(_) => Standing::Breaks,
    }
}

fn passes(runs: &[Run]) -> Vec<Pass> {
    let passes = runs.iter().map(|run| Pass {
        level: 0,
        pieces: run.legs.iter().map(|leg| leg.piece).collect(),
    });
    passes.collect()
}

/// By how much less than the limit the engagement stays at the speed of cutting: a program's points are rounded.
const CARE: Angle = Angle::deg(1.5);

/// What counts as half of the rim where there is no limit.
const HALF: Angle = Angle::deg(176.0);

/// How far before and after a place of much engagement the tool is slow, in mm.
const AROUND: f64 = 0.3;

/// Between slow stretches that are nearer to each other than this, in mm, the tool stays slow, and shorter pieces are not made.
const APART: f64 = 1.0;

/// Runs in which the tool is slow wherever more of its rim is in the material than the limit allows, or half of it where there is no
/// limit; as they are where too many passes keep from saying how much that is.
pub(super) fn slowed(runs: Vec<Run>, asked: &ClearPocket) -> Vec<Run> {
    let radius = asked.crusher.radius.value.to_mm();
    let Ok(found) = engagement(&asked.region.region, &passes(&runs), radius) else {
        return runs;
    };
    let limit = asked.limits.engagement.map_or(HALF, |limit| limit.value);
    let most = (limit - CARE).to_rad();
    let profiled = runs.into_iter().zip(&found.profiles);
    profiled
        .map(|(run, profile)| {
            let mut begun = 0.0;
            let mut legs = Vec::with_capacity(run.legs.len());
            for (number, leg) in run.legs.into_iter().enumerate() {
                let long = leg.piece.length();
                match leg.kind {
                    Kind::Link => legs.push(leg),
                    Kind::Opening | Kind::Pass => {
                        let slow = slow(profile, number, [begun, long], most);
                        split(leg, long, &slow, &mut legs);
                    }
                }
                begun += long;
            }
            Run { legs, ..run }
        })
        .collect()
}

/// Where on a leg the tool has to be slow, in mm from its beginning.
fn slow(profile: &[Stretch], number: usize, [begun, long]: [f64; 2], most: f64) -> Vec<[f64; 2]> {
    let first = profile.partition_point(|stretch| stretch.piece < number);
    let own = profile
        .iter()
        .skip(first)
        .take_while(|stretch| stretch.piece == number);
    let mut found: Vec<[f64; 2]> = Vec::new();
    for stretch in own.filter(|stretch| stretch.bound > most) {
        let [from, to] = stretch.way.map(|way| way - begun);
        let (from, to) = (from - AROUND, to + AROUND);
        match found.last_mut() {
            Some(last) if from - last[1] < APART => last[1] = to,
            _ => found.push([from, to]),
        }
    }
    // No shorter piece is left over at the ends.
    for stretch in &mut found {
        if stretch[0] < APART {
            stretch[0] = 0.0;
        }
        if stretch[1] > long - APART {
            stretch[1] = long;
        }
    }
    found
}

/// A leg in pieces, slow ones among them.
fn split(leg: Leg, long: f64, slow: &[[f64; 2]], legs: &mut Vec<Leg>) {
    let mut at = 0.0;
    let mut push = |from: f64, to: f64, kind: Kind| {
        if to > from {
            let piece = leg.piece.part(from / long, to / long);
            legs.push(Leg { piece, kind });
        }
    };
    for &[from, to] in slow {
        push(at, from, Kind::Pass);
        push(from, to, Kind::Opening);
        at = to;
    }
    push(at, long, Kind::Pass);
}
