//! What a person has to check because the compiler did not: a line for every check that was not made, so that a list of them and
//! the verdict cannot disagree.

use super::words::{bodies_of, listed};
use super::{Check, Checks, Outcome, Reason};

impl Checks {
    /// A sentence for each check that was not made, in a fixed order; the speeds of all axes share one.
    #[must_use]
    pub fn by_hand(&self) -> Vec<String> {
        let (_, unknown) = self.axes();
        let mut list: Vec<String> = Vec::new();
        for checked in self.iter() {
            if let Outcome::NotMade(reason) = checked.outcome {
                // Forces that are not stated cannot be compared. Other lines ask to measure the first part, which shows their effect.
                if reason == Reason::NoForces {
                    continue;
                }
                let line = format!("{} ({}).", checked.check.by_hand(&unknown), reason.why_by_hand());
                if !list.contains(&line) {
                    list.push(line);
                }
            }
        }
        list
    }
}

impl Check {
    /// What a person does in its place.
    fn by_hand(&self, unknown: &[&str]) -> String {
        let what = match self {
            Self::Chips => "Every chip comes free: watch the first part",
            Self::Part => "No cut enters the part: measure the first part",
            Self::Tracks => "The disc follows the surface and frees its strips: watch the first part",
            Self::Pockets => "The tool keeps off the walls and floors of pockets: measure the first part",
            Self::Walls => {
                "The blade keeps off the walls that it slits, and slits them to the floor: measure the first part"
            }
            Self::BetweenSections => {
                "Strips come free and little stays between the sections that were looked at, too: watch and measure the first part"
            }
            Self::AboveStock => "The tip stays above the stock: step through it slowly",
            Self::AxisLimits => {
                "Every pose is within reach and within the limits of the axes: simulate the program on the control"
            }
            Self::AxisRate(_) => {
                return format!(
                    "The control keeps the programmed speeds, although the speed limits are unknown for {}: watch for slow-downs in the air",
                    listed(unknown)
                );
            }
            Self::SingularPoses => {
                "No axis spins where the arm comes near a singularity: run it slowly first"
            }
            Self::Branch => "The arm keeps its configuration through every cut: run it slowly first",
            Self::ElbowAngle => {
                "The angle between the arms, J3 - J2, stays within the maker's range: see the data sheet"
            }
            Self::Turns => {
                "The edge clears the work where the blade turns beside it: watch the turns in the air"
            }
            Self::Torques => {
                "The drives give the torques that the program needs: watch the loads of the axes on the control"
            }
            Self::Deviation => {
                "The forces of the blade do not push it off by more than the part allows: measure the first part"
            }
            Self::Unloaded => {
                "Compensated cuts stay out of the part where the edge comes in and goes out: measure the first part there"
            }
            Self::Accelerations => "Time of the first part: computed without speeding up and slowing down",
            Self::Holder(blades) => {
                return format!(
                    "Shank and holder of {} clear the work, at the deepest cut too: run it in the air first",
                    bodies_of(blades)
                );
            }
            Self::Collisions => {
                "Arm, table, fixture and cables clear each other on every way: run it in the air first"
            }
            Self::ReadBack => "The written program is the planned one: compare positions on the control",
        };
        what.to_owned()
    }
}

impl Reason {
    /// Why it is left to a person.
    const fn why_by_hand(self) -> &'static str {
        match self {
            Self::NoMachine => "the job has no machine",
            Self::NotStated => "the compiler does not know the numbers of this machine",
            Self::NoPlaceForIt => "a machine's description has no field for the range",
            Self::NotMeasured => "not measured for an arm without a closed-form solution",
            Self::NoBody => "the compiler does not know their shapes",
            Self::AirCut => "an air cut is compared with nothing but the top of the stock",
            Self::SectionsOnly => {
                "the compiler looks at sections across the tracks, not at what lies between them"
            }
            Self::NoLoad => "the job does not state the load on the flange",
            Self::NotComputed => "the compiler does not compute it for such a machine",
            Self::Disc => "the compiler does not compute it for surfaces under a disc",
            Self::NoForces => "not all blades state their forces",
            Self::PlacesOnly => {
                "the compiler looks at places along the program, not at what lies between them"
            }
            Self::NoHome => "the job states no home, so where the first motion starts is not known",
            Self::Indicative => "the compiler does not know all numbers of this machine",
            Self::NoReader => "this target's programs are not read back",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::not_made;
    use super::*;

    #[test]
    fn each_check_that_was_not_made_has_a_line_of_its_own() {
        let all = [
            Check::Chips,
            Check::Part,
            Check::Tracks,
            Check::Pockets,
            Check::Walls,
            Check::BetweenSections,
            Check::AboveStock,
            Check::AxisLimits,
            Check::AxisRate("A1".to_owned()),
            Check::AxisRate("A2".to_owned()),
            Check::SingularPoses,
            Check::Branch,
            Check::ElbowAngle,
            Check::Turns,
            Check::Torques,
            Check::Deviation,
            Check::Unloaded,
            Check::Accelerations,
            Check::Holder(Vec::new()),
            Check::Collisions,
            Check::ReadBack,
        ];
        let count = all.len();
        let checks = Checks(
            all.into_iter()
                .map(|check| not_made(check, Reason::NotStated))
                .collect(),
        );
        let lines = checks.by_hand();
        assert_eq!(lines.len(), count - 1, "the rates share a line: {lines:#?}");
        assert!(lines.iter().any(|line| line.contains("A1 and A2")), "{lines:#?}");
    }

    #[test]
    fn what_was_checked_is_not_left_to_be_checked() {
        let checks = Checks(vec![
            super::super::made(Check::Chips),
            super::super::made(Check::Part),
        ]);
        assert!(checks.by_hand().is_empty());
    }
}
