//! KUKA's status: which of its ways to reach a pose an arm takes, in three bits.
//!
//! It stands here and not in a backend because the compiler's own commands about single poses print it too.
//!
//! Bits with the weights 1, 2, 4: the wrist centre behind axis 1; the forearm folded forward (`A3 > phi`); A5 negative
//! (Beckhoff TF5200 "Status & Turn"; KUKA's expert manual as quoted on robot-forum.com, threads 7173 and 45777).

use crate::motion::{Branch, Elbow, Shoulder, Wrist};

/// `S` of an arm on a branch; none for branches that are not of such an arm.
#[must_use]
pub const fn kuka_status(branch: Branch) -> Option<u8> {
    let Branch::Arm {
        shoulder,
        elbow,
        wrist,
    } = branch
    else {
        return None;
    };
    let behind = match shoulder {
        Shoulder::Front => 0,
        Shoulder::Back => 1,
    };
    let forward = match elbow {
        Elbow::Forward => 2,
        Elbow::Backward => 0,
    };
    let negative = match wrist {
        Wrist::Positive => 0,
        Wrist::Negative => 4,
    };
    Some(behind + forward + negative)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_has_a_status_of_its_own() {
        let mut found = Vec::new();
        for shoulder in [Shoulder::Front, Shoulder::Back] {
            for elbow in [Elbow::Backward, Elbow::Forward] {
                for wrist in [Wrist::Positive, Wrist::Negative] {
                    found.extend(kuka_status(Branch::Arm {
                        shoulder,
                        elbow,
                        wrist,
                    }));
                }
            }
        }
        assert_eq!(found, [0, 4, 2, 6, 1, 5, 3, 7]);
        assert_eq!(kuka_status(Branch::Numbered(0)), None);
    }
}
