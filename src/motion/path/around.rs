//! What the axes of an arm do at all poses around one.
//!
//! From the pose that axis values `q` give, a constant twist `v` about the tip leads to any other pose in one unit of time. As on
//! a span of a course ([`super::serial`]), the axes follow `q' = A v + N q'` with `A` near the inverse of the Jacobian at `q`
//! and `N = I - A J`. Here little is known of the direction of `v`, so all is bounded by absolute values: with `|v|` and `|N|`
//! the largest on a box `Q` around `q`, `|q'| <= |A v| + |N| |q'|`. Let `h` be half the size of `Q`, axis by axis. If `|A v| + |N| h`
//! is at most `h`, then `|N|` contracts in the norm with the weights `h`, so that the Jacobian is regular on `Q`, and no
//! axis is faster than `h`: the axes are in `Q` at all these poses.
//!
//! **How the Jacobian changes.** The column of a joint is `c_i = (a_i x u_i, a_i)` with its axis `a_i` and with `u_i` from a point of
//! that axis to the tip. When joint `k` turns, what is behind it turns with it:
//!
//! - `dc_i / dk = (a_k x (a_i x u_i), a_k x a_i)` for a joint `k` up to `i`,
//! - `dc_i / dk = (a_i x (a_k x u_k), 0)` for one behind it.
//!
//! These are put together with `A` before absolute values are taken, as near a singular pose `A` is large in some directions only.
//! What is left is of the second order. Second derivatives are such products with one more axis, so they are no longer than
//! the tip's distance from the last of the axes in them, and 1 for directions; while the joints turn by at most `h_k` either
//! way, that is half of the sum of `h_k h_l` times such distances. A distance is at most what it is at the pose and how far the
//! joints behind that axis move the tip.

use super::serial::{Lines, Square, UNCERTAIN, Vector, inverse_at};
use glam::DVec3;
use vcutc_backend_api::ir::MOST_AXES;
use vcutc_geometry::number::Interval;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::kinematics::serial::SerialArm;

/// What the axes do around a pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around {
    /// Where they are.
    pub(super) value: [Interval; MOST_AXES],
    /// How fast they move, a second.
    pub(super) rate: [Interval; MOST_AXES],
}

/// Poses around one, and how the flange moves there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Poses {
    /// How far away the tip is at most, in mm.
    pub(super) away: f64,
    /// How the flange is turned, in rad: as a vector, between nothing and these.
    pub(super) turned: [DVec3; 2],
    /// The tip's velocity is between nothing and these, in mm/s.
    pub(super) velocities: [DVec3; 2],
    /// By how much it may be off, in mm/s.
    pub(super) bends: f64,
    /// So is how the flange turns, in rad/s.
    pub(super) spins: [DVec3; 2],
}

/// What an inverse of floating point numbers may leave of `I - A J`.
const ROUNDING: f64 = 1e-6;
/// How often the box is widened before it is given up.
const MOST_WIDENINGS: u32 = 24;
/// By how much it is widened beyond what was found.
const WIDER: f64 = 1.1;
/// Farther than that, in rad, nothing around a pose is enclosed.
const FARTHEST: f64 = 1.0;

/// What the axes do at the poses around that of `joints`. None where that cannot be enclosed: next to a singular pose, or when the
/// poses are too far apart.
pub(super) fn around(
    arm: &SerialArm,
    tip_in_flange: DVec3,
    joints: &Joints,
    poses: &Poses,
) -> Option<Around> {
    let inverse = inverse_at(arm, joints, tip_in_flange)?;
    let lines = Lines::of(arm, &joints.map(Interval::exactly), tip_in_flange);
    let arm = Nearby::new(arm, &lines, &inverse);
    let most = |row: DVec3, vectors: [DVec3; 2]| {
        let [one, other] = vectors.map(|vector| row.dot(vector).abs());
        one.max(other)
    };
    let away: Joints = core::array::from_fn(|i| {
        arm.linear[i].length() * poses.away + most(arm.angular[i], poses.turned) + UNCERTAIN
    });
    let mut room = away.map(|away| away * WIDER);
    let mut tries = 0;
    let defect = loop {
        let defect = arm.defect(&room);
        let reached = following(&defect, &away, &room);
        if reached.iter().zip(room).all(|(reached, room)| *reached <= room) {
            break defect;
        }
        tries += 1;
        if tries > MOST_WIDENINGS || !reached.iter().all(|reached| *reached <= FARTHEST) {
            return None;
        }
        room = reached.map(|reached| reached * WIDER);
    };
    let reached = solved(&defect, &away, &room)?;
    let speeds: Joints = core::array::from_fn(|i| {
        let at_joint = most(arm.linear[i], poses.velocities) + most(arm.angular[i], poses.spins);
        at_joint + arm.linear[i].length() * poses.bends
    });
    let rates = solved(&defect, &speeds, &room)?;
    Some(Around {
        value: core::array::from_fn(|i| Interval::around(joints[i], reached[i])),
        rate: rates.map(|rate| Interval::around(0.0, rate)),
    })
}

/// `wanted + defect x`.
fn following(defect: &Square, wanted: &Joints, x: &Joints) -> Joints {
    core::array::from_fn(|i| {
        let more: f64 = defect[i].iter().zip(x).map(|(share, part)| share * part).sum();
        wanted[i] + more
    })
}

/// A bound of all `x >= 0` with `x <= wanted + defect x`, from some `room` with `defect room < room`: a multiple of it that
/// leaves enough for what is wanted, and what follows from that. None where the room leaves nothing.
fn solved(defect: &Square, wanted: &Joints, room: &Joints) -> Option<Joints> {
    let used = following(defect, &[0.0; MOST_AXES], room);
    let mut times = 0.0_f64;
    for ((room, used), wanted) in room.iter().zip(used).zip(wanted) {
        let left = room - used;
        if left.is_nan() || left <= 0.0 {
            return None;
        }
        times = times.max(wanted / left);
    }
    let mut x = room.map(|room| room * times);
    for _ in 0..8 {
        let next = following(defect, wanted, &x);
        x = core::array::from_fn(|i| next[i].min(x[i]));
    }
    Some(x)
}

/// An arm at a pose.
struct Nearby {
    /// The rows of the inverse of the Jacobian: what belongs to the velocity of the tip, and to the turn of the flange.
    linear: [DVec3; MOST_AXES],
    angular: [DVec3; MOST_AXES],
    /// How the joints turn with each axis.
    turns: Square,
    /// Of each joint: its axis, and how it moves the tip.
    axes: [DVec3; MOST_AXES],
    moves: [DVec3; MOST_AXES],
}

/// What a column of the Jacobian, or its change, has for the tip and for the flange.
type Column = [DVec3; 2];

impl Nearby {
    fn new(arm: &SerialArm, lines: &Lines, inverse: &Square) -> Self {
        let tip = middle(&lines.tip);
        let axes = lines.directions.each_ref().map(middle);
        let by_axis = unit_axes().map(|only| arm.turns_of(only, |third, second| third - second));
        Self {
            linear: inverse.map(|row| DVec3::new(row[0], row[1], row[2])),
            angular: inverse.map(|row| DVec3::new(row[3], row[4], row[5])),
            turns: core::array::from_fn(|i| core::array::from_fn(|axis| by_axis[axis][i])),
            axes,
            moves: core::array::from_fn(|i| axes[i].cross(tip - middle(&lines.points[i]))),
        }
    }

    /// The largest `|I - A J|` while each axis is away from its value by at most `room`.
    fn defect(&self, room: &Joints) -> Square {
        let turns: Joints = core::array::from_fn(|i| dot(&self.turns[i], room));
        let rest = self.second_order(&turns);
        core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                let first = (0..MOST_AXES).map(|m| room[m] * self.changes(i, j, m).abs());
                let second = (0..MOST_AXES).map(|k| {
                    let [moves, tilts] = rest[k];
                    self.turns[k][j].abs()
                        * (self.linear[i].length() * moves + self.angular[i].length() * tilts)
                });
                ROUNDING + first.sum::<f64>() + second.sum::<f64>()
            })
        })
    }

    /// How the entry `i`, `j` of `A J` changes with axis `m`.
    fn changes(&self, i: usize, j: usize, m: usize) -> f64 {
        let mut sum = 0.0;
        for joint in (0..MOST_AXES).filter(|joint| self.turns[*joint][j] != 0.0) {
            for turned in (0..MOST_AXES).filter(|turned| self.turns[*turned][m] != 0.0) {
                let [moves, tilts] = self.change(joint, turned);
                let share = self.turns[joint][j] * self.turns[turned][m];
                sum += share * (self.linear[i].dot(moves) + self.angular[i].dot(tilts));
            }
        }
        sum
    }

    /// How the column of a joint changes when another turns.
    fn change(&self, joint: usize, turned: usize) -> Column {
        if turned <= joint {
            let about = self.axes[turned];
            [about.cross(self.moves[joint]), about.cross(self.axes[joint])]
        } else {
            [self.axes[joint].cross(self.moves[turned]), DVec3::ZERO]
        }
    }

    /// What the columns of joints that turn by so much are off the first order by.
    fn second_order(&self, turns: &Joints) -> [[f64; 2]; MOST_AXES] {
        let mut distances = [0.0; MOST_AXES];
        let mut moved = 0.0;
        for i in (0..MOST_AXES).rev() {
            distances[i] = self.moves[i].length() + moved;
            moved += turns[i] * distances[i];
        }
        core::array::from_fn(|i| {
            let each = |k: usize, l: usize| turns[k] * turns[l] * distances[k.max(l).max(i)];
            let moves: f64 = (0..MOST_AXES)
                .flat_map(|k| (0..MOST_AXES).map(move |l| (k, l)))
                .map(|(k, l)| each(k, l))
                .sum();
            let before: f64 = turns.iter().take(i).sum();
            [moves / 2.0, before * before / 2.0]
        })
    }
}

/// One axis at a time.
fn unit_axes() -> Square {
    core::array::from_fn(|axis| core::array::from_fn(|i| if i == axis { 1.0 } else { 0.0 }))
}

fn dot(shares: &Joints, room: &Joints) -> f64 {
    shares
        .iter()
        .zip(room)
        .map(|(share, room)| share.abs() * room)
        .sum()
}

fn middle(vector: &Vector) -> DVec3 {
    DVec3::from_array(vector.map(Interval::middle))
}
