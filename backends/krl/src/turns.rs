//! The rates of swivel and twist at which each turn takes the time for which its axes were proven.
//!
//! Most turns of a program are the same turn forward and back, so that the two rates are written once or a few times.

use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Action, Joint, OrientationId, Program, RateId};
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::script::Lead;
use vcutc_backend_api::swivel::Apart;
use vcutc_backend_api::units::AngularSpeed;

/// Decimals of both rates, in deg/s: KRL's `REAL` has seven digits, and the highest rate three before the point.
pub(crate) const RATES: FixedDecimal = FixedDecimal::new(4);

/// Two lines say the rates.
const LINES: u64 = 2;

/// Rates of swivel and twist in deg/s, as printed.
pub(crate) type Rates = Apart<f64>;

/// The rates of a program's turns.
pub(crate) struct Turns {
    /// For each op that turns the blade.
    of: Vec<Option<Rates>>,
    /// For each op how many lines its chain takes in addition to the op's own: of speeds and rounding, there
    /// and back.
    of_chains: Vec<u8>,
    /// For each op whether they are others than those of the turn before. The first ones stand at the head of the part.
    changes: Vec<bool>,
}

impl Turns {
    pub(crate) fn of(program: &Program) -> Self {
        let mut known: BTreeMap<(OrientationId, OrientationId, RateId), Option<Rates>> = BTreeMap::new();
        let mut last = None;
        let mut turns = Self {
            of: Vec::with_capacity(program.ops.len()),
            of_chains: program.ops.iter().map(|op| lines_of_chain(&op.action)).collect(),
            changes: Vec::with_capacity(program.ops.len()),
        };
        let mut held = None;
        for (_, op, after) in program.ends() {
            let before = held;
            held = after.place.pose().map(|pose| pose.orientation);
            let rates = match (before, held, op.action.rate()) {
                (Some(from), Some(to), Some(rate)) if from != to => {
                    let new = || rates(program, (from, to), rate);
                    *known.entry((from, to, rate)).or_insert_with(new)
                }
                (_, _, _) => None,
            };
            turns
                .changes
                .push(rates.is_some() && last.is_some() && rates != last);
            turns.of.push(rates);
            last = rates.or(last);
        }
        turns
    }

    /// Those of the op at a place; none when it turns nothing.
    pub(crate) fn at(&self, index: usize) -> Option<Rates> {
        self.of.get(index).copied().flatten()
    }

    /// How many lines stand before the op at a place. A part states its first rates whatever was stated
    /// before it.
    pub(crate) fn lines(&self, index: usize, lead: Lead) -> u64 {
        let changes = self.changes.get(index).copied().unwrap_or(false);
        let of_chain = self.of_chains.get(index).copied().unwrap_or(0);
        lead.lines(0) + u64::from(of_chain) + if changes || lead.rate.is_some() { LINES } else { 0 }
    }
}

/// At most: the speed on an arc and after it, the distance of a joint and of corners in the air after it.
const fn lines_of_chain(action: &Action) -> u8 {
    let on_arc = if action.via().is_some() { 2 } else { 0 };
    let at_joint = match action {
        Action::Follow {
            joint: Joint::Through,
            ..
        } => 2,
        _ => 0,
    };
    on_arc + at_joint
}

fn rates(program: &Program, (from, to): (OrientationId, OrientationId), rate: RateId) -> Option<Rates> {
    let (from, to) = (program.orientation(from)?, program.orientation(to)?);
    let Apart { swivel, twist } = Apart::rates(from, to, program.rate(rate)?);
    Some(Apart {
        swivel: rounded_down(swivel),
        twist: rounded_down(twist),
    })
}

/// In deg/s, so that no turn is faster than proven.
pub(crate) fn rounded_down(rate: AngularSpeed) -> f64 {
    RATES.floored(rate.to_deg_per_s())
}
