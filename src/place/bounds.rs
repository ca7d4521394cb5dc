//! Where the base may stand, as people write it: `1000..2500`, `-0.5 m .. 0.5 m`, `650 mm`.

use crate::Placement;
use crate::score::Objective;
use crate::search::Bounds;
use crate::spot::Spot;
use core::f64::consts::PI;
use core::fmt;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::MachineKind;
use vcutc_job::Machine;
use vcutc_job::sema::units;

/// What the user asks for; what is left out is a box around where the base is now.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked<'a> {
    /// x of the base in the machine's root.
    pub x: Option<&'a str>,
    pub y: Option<&'a str>,
    pub z: Option<&'a str>,
    /// Turn about z against now.
    pub yaw: Option<&'a str>,
    /// What the place is to be best in.
    pub objective: Objective,
}

/// How far from now the base may go where the user sets no bounds: mm in x, y and z.
pub const AROUND: [i32; 3] = [500, 500, 300];
/// How far it may turn, in degrees.
pub const TURN_AROUND: i32 = 90;
/// The same in the steps of a [`Spot`].
const STEPS_AROUND: [i32; 4] = [AROUND[0], AROUND[1], AROUND[2], TURN_AROUND * 10];
/// Which of these is the turn.
const TURN: usize = 3;
/// Half a turn in those steps: beyond it come the same places again.
const HALF_TURN: i32 = 1800;
/// Farthest from the machine's root that a base can be asked for, in mm.
const FARTHEST: i32 = 100_000;

/// Bounds that cannot be understood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadBounds {
    /// The option, such as `--x`.
    pub option: &'static str,
    pub given: String,
    /// What is wrong with it, and what would be right.
    pub why: String,
}

impl fmt::Display for BadBounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{} {}`: {}", self.option, self.given, self.why)
    }
}

/// What the numbers of an option are.
#[derive(Clone, Copy)]
enum Kind {
    /// Lengths, in whole mm.
    Length,
    /// Angles, in tenths of a degree.
    Angle,
}

impl Asked<'_> {
    /// The bounds, around where the base is now.
    ///
    /// # Errors
    /// The first option that cannot be understood.
    pub fn bounds(&self, base: &Frame) -> Result<Bounds, BadBounds> {
        let now = Spot::near(base);
        let around = |value: i32, by: i32| (value.saturating_sub(by), value.saturating_add(by));
        let [dx, dy, dz, turn] = STEPS_AROUND;
        let x = read("--x", self.x, Kind::Length)?.unwrap_or(around(now.x, dx));
        let y = read("--y", self.y, Kind::Length)?.unwrap_or(around(now.y, dy));
        let z = read("--z", self.z, Kind::Length)?.unwrap_or(around(now.z, dz));
        let yaw = read("--yaw", self.yaw, Kind::Angle)?.unwrap_or(around(0, turn));
        Ok(Bounds {
            least: Spot::from_parts([x.0, y.0, z.0, yaw.0]),
            most: Spot::from_parts([x.1, y.1, z.1, yaw.1]),
        })
    }

    /// Wider bounds where the user set none: beyond the edges that the best place lies at. None where it lies at none of them.
    #[must_use]
    pub fn widened(&self, bounds: &Bounds, best: Spot) -> Option<Bounds> {
        let is_open = [self.x, self.y, self.z, self.yaw].map(|given| given.is_none());
        let (mut least, mut most) = (bounds.least.parts(), bounds.most.parts());
        let mut is_wider = false;
        for part in 0..STEPS_AROUND.len() {
            let (low, high) = (least[part], most[part]);
            let step = STEPS_AROUND[part];
            let (below, above) = if part == TURN {
                (step.min(low + HALF_TURN), step.min(HALF_TURN - high))
            } else {
                (step, step)
            };
            let lies_at = |edge: i32| best.parts()[part] == edge;
            if !is_open[part] {
                continue;
            }
            if lies_at(low) && below > 0 {
                least[part] = low.saturating_sub(below);
                is_wider = true;
            }
            if lies_at(high) && above > 0 {
                most[part] = high.saturating_add(above);
                is_wider = true;
            }
        }
        is_wider.then(|| Bounds {
            least: Spot::from_parts(least),
            most: Spot::from_parts(most),
        })
    }
}

impl Asked<'_> {
    /// Where to look on when nothing was found and no bounds were given: all around an arm, wherever the work
    /// is now.
    pub(super) fn farther(&self, machine: &Machine, found: &Placement) -> Option<Bounds> {
        let is_asked = [self.x, self.y, self.z, self.yaw].iter().any(Option::is_some);
        let is_found = found.best.is_some() || found.now.room.is_ok();
        let is_arm = machine.model.kind() == MachineKind::Robot;
        (!is_asked && !is_found && is_arm).then(|| all_around(machine.model.reach()))
    }
}

/// A box around an arm of that reach, in mm.
fn all_around(reach: f64) -> Bounds {
    /// Heights of the work over the foot of an arm, as shares of its reach.
    const HEIGHTS: (f64, f64) = (-0.1, 0.4);
    let share = |share: f64| (share * reach).round() as i32;
    Bounds {
        least: Spot {
            x: -share(1.0),
            y: -share(1.0),
            z: share(HEIGHTS.0),
            yaw: -HALF_TURN,
        },
        most: Spot {
            x: share(1.0),
            y: share(1.0),
            z: share(HEIGHTS.1),
            yaw: HALF_TURN,
        },
    }
}

fn read(option: &'static str, given: Option<&str>, kind: Kind) -> Result<Option<(i32, i32)>, BadBounds> {
    let Some(text) = given else { return Ok(None) };
    range(text, kind).map(Some).map_err(|why| BadBounds {
        option,
        given: text.to_owned(),
        why,
    })
}

/// A range, both ends included, in the kind's steps. A unit after the second number holds for both.
fn range(text: &str, kind: Kind) -> Result<(i32, i32), String> {
    let (first, second) = text.split_once("..").unwrap_or((text, text));
    let ((first, own), (second, unit)) = (split(first), split(second));
    let unit = if unit.is_empty() { own } else { unit };
    let own = if own.is_empty() { unit } else { own };
    let (least, most) = (steps(first, own, kind)?, steps(second, unit, kind)?);
    // Products such as 0.3 m are a hair off the millimetre.
    let (low, high) = ((least - 1e-6).ceil(), (most + 1e-6).floor());
    if least > most {
        return Err("the first number is above the second".to_owned());
    }
    if low > high {
        return Err(match kind {
            Kind::Length => "there is no whole millimetre in between".to_owned(),
            Kind::Angle => "there is no whole tenth of a degree in between".to_owned(),
        });
    }
    let (reach, words) = match kind {
        Kind::Length => (f64::from(FARTHEST), "100 m at most"),
        Kind::Angle => (3600.0, "360 deg at most"),
    };
    if low < -reach || high > reach {
        return Err(format!("it goes too far ({words})"));
    }
    Ok((low as i32, high as i32))
}

/// A number and what stands after it.
fn split(text: &str) -> (&str, &str) {
    let text = text.trim();
    let end = text
        .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '+' | '-')))
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    (number.trim(), unit.trim())
}

fn steps(number: &str, unit: &str, kind: Kind) -> Result<f64, String> {
    let (usual, example, step) = match kind {
        Kind::Length => ("mm", "1000..2500", 1.0),
        Kind::Angle => ("deg", "-30..30", PI / 1800.0),
    };
    let unit = if unit.is_empty() { usual } else { unit };
    let wrong = || format!("write a range such as `{example}`; without a unit it is in {usual}");
    let number: f64 = number.parse().map_err(|_| wrong())?;
    let quantity = units::quantity(number, unit).ok_or_else(wrong)?;
    let one = units::quantity(1.0, usual).ok_or_else(wrong)?;
    if quantity.dimension == one.dimension && quantity.value.is_finite() {
        Ok(quantity.value / step)
    } else {
        Err(wrong())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::geometry::{Orientation, Point3};

    #[test]
    fn ranges_are_read_with_units_or_without() {
        let lengths = [
            ("1000..2500", (1000, 2500)),
            ("-500..500 mm", (-500, 500)),
            ("1..2.5m", (1000, 2500)),
            ("100mm .. 0.3m", (100, 300)),
            ("650", (650, 650)),
            (" 0.5..1.5 ", (1, 1)),
        ];
        for (text, expected) in lengths {
            assert_eq!(range(text, Kind::Length), Ok(expected), "{text}");
        }
        assert_eq!(range("-30..30", Kind::Angle), Ok((-300, 300)));
        assert_eq!(range("0..0.5rad", Kind::Angle), Ok((0, 286)));
    }

    #[test]
    fn what_is_not_a_range_is_refused_with_one_that_is() {
        for text in [
            "", "..", "a..b", "1..2..3", "1..2 deg", "2..1", "0.2..0.8", "0..1e9", "0..200 m", "NaN..1",
        ] {
            assert!(range(text, Kind::Length).is_err(), "{text}");
        }
        assert!(range("0..10 mm", Kind::Angle).is_err());
        assert!(range("x", Kind::Length).unwrap_err().contains("1000..2500"));
    }

    #[test]
    fn bounds_that_are_not_set_widen_where_the_best_place_lies_at_them() {
        let base = Frame {
            origin: Point3::new(1000.0, 0.0, 500.0),
            orientation: Orientation::IDENTITY,
        };
        let asked = Asked {
            y: Some("-100..100"),
            ..Asked::default()
        };
        let bounds = asked.bounds(&base).unwrap();
        let widened = |spot: [i32; 4]| {
            asked
                .widened(&bounds, Spot::from_parts(spot))
                .map(|wider| (wider.least.parts(), wider.most.parts()))
        };
        // Inside, or at an edge that the user set.
        assert_eq!(widened([900, 50, 450, 20]), None);
        assert_eq!(widened([900, 100, 450, 20]), None);
        let at_an_edge = widened([1500, 100, 450, -900]);
        assert_eq!(at_an_edge, Some(([500, -100, 200, -1800], [2000, 100, 800, 900])));
        let all_given = Asked {
            x: Some("0..1"),
            y: Some("0..1"),
            z: Some("0..1"),
            yaw: Some("0"),
            objective: Objective::Margin,
        };
        let kept = all_given.bounds(&base).unwrap();
        assert_eq!(all_given.widened(&kept, kept.most), None);
    }

    #[test]
    fn without_bounds_it_is_a_box_around_now() {
        let base = Frame {
            origin: Point3::new(1700.4, -600.0, 650.0),
            orientation: Orientation::IDENTITY,
        };
        let asked = Asked {
            z: Some("600..700"),
            ..Asked::default()
        };
        let bounds = asked.bounds(&base).unwrap();
        assert_eq!(
            bounds.least,
            Spot {
                x: 1200,
                y: -1100,
                z: 600,
                yaw: -900
            }
        );
        assert_eq!(
            bounds.most,
            Spot {
                x: 2200,
                y: -100,
                z: 700,
                yaw: 900
            }
        );
    }
}
