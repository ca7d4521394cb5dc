//! What a target does not take, gathered before anything is written.
//!
//! Of each kind of problem only the first is reported, with its op: a stock placed too far away would
//! otherwise be reported a million times.

use crate::backend::{BackendIssue, Exceeded, MachineMismatch};
use crate::geometry::Point3;
use crate::ir::{Action, Blade, Cell, OpId};
use crate::motion::ReachableProgram;
use crate::script::trimmed_text;
use crate::units::Duration;
use core::ops::RangeInclusive;
use std::collections::BTreeSet;

/// Longest wait, in s: a day.
const LONGEST_WAIT_S: f64 = 86_400.0;

const GENERATOR_MISSING: BackendIssue = BackendIssue::MissingMachineField {
    field: "ultrasonic",
    why: "the program switches the generator on before the blade enters; a blade that does not vibrate breaks",
};

/// The machine of a program, if a dialect drives it.
///
/// # Errors
/// What sets it apart from those that the dialect drives.
pub fn driven_cell<'p>(
    program: &'p ReachableProgram,
    drives: &'static str,
    mismatch: impl FnOnce(&Cell) -> Option<MachineMismatch>,
) -> Result<&'p Cell, Vec<BackendIssue>> {
    let wrong = |mismatch| Err(vec![BackendIssue::WrongMachine { mismatch, drives }]);
    // No program is assembled without a machine; if one were, it would have no axes to drive.
    let Some(cell) = &program.program().cell else {
        return wrong(MachineMismatch::Arm);
    };
    mismatch(cell).map_or(Ok(cell), wrong)
}

/// The problems found so far.
#[derive(Debug, Default)]
pub struct Findings {
    issues: Vec<BackendIssue>,
    /// The kinds that were reported, so that each is reported once.
    reported: BTreeSet<&'static str>,
}

/// A number with its unit, to be checked.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// What it is, such as `tip speed`.
    pub what: &'static str,
    /// Its value.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
}

impl Findings {
    /// Reports a problem, unless one of its kind was reported.
    pub fn report(&mut self, what: &'static str, issue: BackendIssue) {
        if self.reported.insert(what) {
            self.issues.push(issue);
        }
    }

    /// A number must lie within limits, or be printed as one that does.
    ///
    /// Inlined, because it is asked for every number of every op and nearly always says yes.
    #[inline]
    pub fn range(&mut self, op: Option<OpId>, number: &Number, limits: (f64, f64)) {
        let allowed = |value: f64| (limits.0..=limits.1).contains(&value);
        if !(allowed(number.value) || allowed(as_printed(number.value))) {
            self.out_of_range(op, number, limits);
        }
    }

    #[cold]
    fn out_of_range(&mut self, op: Option<OpId>, number: &Number, (low, high): (f64, f64)) {
        let &Number { what, value, unit } = number;
        self.report(
            what,
            BackendIssue::OutOfRange {
                op,
                what,
                value: format!("{} {unit}", trimmed_text(value)),
                allowed: format!("{} to {} {unit}", trimmed_text(low), trimmed_text(high)),
                range: Some(Exceeded {
                    value,
                    least: low,
                    most: high,
                }),
            },
        );
    }

    /// A number in a table, or of a signal, must lie within a range.
    pub fn number(&mut self, what: &'static str, value: u32, allowed: RangeInclusive<u32>) {
        if allowed.contains(&value) {
            return;
        }
        self.report(
            what,
            BackendIssue::OutOfRange {
                op: None,
                what,
                value: value.to_string(),
                allowed: format!("{} to {}", allowed.start(), allowed.end()),
                range: None,
            },
        );
    }

    /// Coordinates, called by these names, must not be farther from zero than this, in mm.
    pub fn point(&mut self, op: Option<OpId>, names: [&'static str; 3], point: Point3, farthest: f64) {
        for (what, value) in names.into_iter().zip([point.x, point.y, point.z]) {
            let unit = "mm";
            self.range(op, &Number { what, value, unit }, (-farthest, farthest));
        }
    }

    /// A wait must not be longer than a day.
    pub fn wait(&mut self, op: Option<OpId>, what: &'static str, time: Duration) {
        let value = time.to_s();
        let unit = "s";
        self.range(op, &Number { what, value, unit }, (0.0, LONGEST_WAIT_S));
    }

    /// A machine must have a generator that can be switched, where one of these blades vibrates.
    pub fn generator(&mut self, cell: &Cell, blades: &[Blade]) {
        if cell.ultrasonic.is_none() && blades.iter().any(Blade::vibrates) {
            self.report("ultrasonic", GENERATOR_MISSING);
        }
    }

    /// An op may not wait for longer than a day.
    pub fn op(&mut self, id: OpId, action: &Action) {
        if let Action::Dwell { time } = action {
            self.wait(Some(id), "waiting time", *time);
        }
    }

    /// Problems that were found elsewhere.
    #[must_use]
    pub const fn beginning_with(issues: Vec<BackendIssue>) -> Self {
        Self {
            issues,
            reported: BTreeSet::new(),
        }
    }

    /// Whether all is well.
    ///
    /// # Errors
    /// Everything that was reported, in that order.
    pub fn result(self) -> Result<(), Vec<BackendIssue>> {
        if self.issues.is_empty() {
            Ok(())
        } else {
            Err(self.issues)
        }
    }
}

/// A value as it will be printed at best, with six decimals: 400 deg/s kept in radians comes back a hair above 400.
fn as_printed(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_each_kind_is_reported() {
        let mut findings = Findings::default();
        for (op, x) in [(1, 5.0), (2, 50.0), (3, 500.0)] {
            findings.point(Some(OpId(op)), ["X", "Y", "Z"], Point3::new(x, -x, 0.0), 10.0);
        }
        let reported: Vec<_> = findings
            .result()
            .unwrap_err()
            .into_iter()
            .map(|issue| match issue {
                BackendIssue::OutOfRange { op, what, value, .. } => (op, what, value),
                other => panic!("{other:?}"),
            })
            .collect();
        let op = Some(OpId(2));
        assert_eq!(
            reported,
            [(op, "X", "50.0 mm".to_owned()), (op, "Y", "-50.0 mm".to_owned())]
        );
    }

    #[test]
    fn a_value_that_is_printed_as_its_limit_is_within() {
        let mut findings = Findings::default();
        let number = |value| Number {
            what: "rate",
            value,
            unit: "deg/s",
        };
        findings.range(None, &number(400.000_000_1), (0.0, 400.0));
        assert_eq!(findings.result(), Ok(()));
    }
}
