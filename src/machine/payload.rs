//! What the flange of an arm may carry.
//!
//! ```toml
//! rated_payload_kg = 3.0
//!
//! [payload]
//! wrist_inertia_limit_kg_m2 = [0.175, 0.085]
//! source = "ABB product specification 3HAC035960-001, section 1.4.3"
//! ```
//!
//! Makers bound what axes 5 and 6 turn: with the centre of a load at (x, y, z) seen from the flange and c4 from the wrist centre to the
//! flange, `m ((z + c4)^2 + x^2 + y^2) + max(Jx, Jy)` for axis 5 and `m (x^2 + y^2) + Jz` for axis 6.

use super::body::MILLIMETRES;
use super::facts::Sources;
use super::ranges::INERTIA_LIMIT;
use vcutc_backend_api::ir::{Inertia, Load};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::schema::field::{FieldSpec, optional, value};

/// The heading of the limits of the wrist.
pub(super) const KEY: &str = "payload";

/// What an arm may carry, as far as its description says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Payload {
    /// What it is rated for, in kg.
    pub rated: Option<f64>,
    pub wrist: Option<WristLimits>,
}

/// What the axes of a wrist may turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WristLimits {
    /// The most about axis 5, in kg m2.
    pub axis_5: f64,
    /// The most about axis 6, in kg m2.
    pub axis_6: f64,
    /// From the wrist centre to the flange, in mm.
    pub to_flange: f64,
}

/// By what a load is more than an arm may carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Excess {
    /// It is heavier than this, in kg.
    Mass { rated: f64 },
    /// It is harder to turn, about this axis.
    Inertia(Turned),
}

/// A load as an axis of the wrist turns it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    /// The axis as people count.
    pub axis: u8,
    /// The inertia of the load about it, in kg m2.
    pub inertia: f64,
    /// The most that it takes, in kg m2.
    pub most: f64,
    /// How far from it the centre of the load is, in mm.
    pub from_axis: f64,
    /// The inertia of the load about its own centre that counts, in kg m2.
    pub own: f64,
    /// The heaviest load with this centre that the arm may carry, in kg; none where the inertia about the centre is too much already.
    pub heaviest: Option<f64>,
}

const FIELDS: &[FieldSpec] = &[
    value("wrist_inertia_limit_kg_m2", "[0.175, 0.085]")
        .required()
        .within(INERTIA_LIMIT),
    value("source", "\"product specification, section 1.4.3\"").required(),
    optional("note"),
];

/// Reads the limits of the wrist of an arm, when its sheet has some. `to_flange` is from the wrist centre to the flange, in mm.
pub(super) fn read(
    root: &Table<'_>,
    to_flange: f64,
    sources: &mut Vec<Sources>,
    faults: &mut Vec<Diagnostic>,
) -> Option<WristLimits> {
    let table = root.table(KEY, FIELDS, faults)?;
    table.text("note", faults);
    sources.push(Sources::read("limits of the wrist", &table, "source", faults));
    let [axis_5, axis_6] = table.numbers("wrist_inertia_limit_kg_m2", faults)?;
    Some(WristLimits {
        axis_5,
        axis_6,
        to_flange,
    })
}

impl Payload {
    /// By what a load is more than it; the first of mass, axis 5 and axis 6. A load without stated inertia counts as a point.
    #[must_use]
    pub fn excess(&self, load: &Load) -> Option<Excess> {
        let mass = load.mass.to_kg();
        if let Some(rated) = self.rated.filter(|rated| is_above(mass, *rated)) {
            return Some(Excess::Mass { rated });
        }
        let turned = self.wrist?.turned(load);
        let heaviest = turned
            .iter()
            .try_fold(self.rated.unwrap_or(f64::INFINITY), |least, turned| {
                Some(turned.heaviest?.min(least))
            });
        let excess = turned
            .iter()
            .find(|turned| is_above(turned.inertia, turned.most))?;
        Some(Excess::Inertia(Turned { heaviest, ..*excess }))
    }
}

impl WristLimits {
    /// A load as axes 5 and 6 turn it.
    fn turned(&self, load: &Load) -> [Turned; 2] {
        let mass = load.mass.to_kg();
        let [x, y, z] = load.centre.to_array();
        let own = load.inertia.unwrap_or(Inertia::POINT);
        let aside = libm::hypot(x, y);
        let axes = [
            (
                5,
                libm::hypot(aside, z + self.to_flange),
                own.x.max(own.y),
                self.axis_5,
            ),
            (6, aside, own.z, self.axis_6),
        ];
        axes.map(|(axis, from_axis, own, most)| {
            let square = (from_axis / MILLIMETRES) * (from_axis / MILLIMETRES);
            let left = Some(most - own).filter(|left| *left > 0.0);
            Turned {
                axis,
                inertia: mass * square + own,
                most,
                from_axis,
                own,
                heaviest: left.map(|left| left / square),
            }
        })
    }
}

/// By which share of itself a number may pass its limit: rounding.
const ROUNDING: f64 = 1e-9;

fn is_above(number: f64, limit: f64) -> bool {
    number > limit * (1.0 + ROUNDING)
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::geometry::Point3;
    use vcutc_backend_api::units::Mass;

    /// IRB 120: 0.175 and 0.085 kg m2, and 72 mm from wrist centre to flange.
    const SMALL_ARM: Payload = Payload {
        rated: Some(3.0),
        wrist: Some(WristLimits {
            axis_5: 0.175,
            axis_6: 0.085,
            to_flange: 72.0,
        }),
    };

    fn load(mass: f64, centre: [f64; 3], inertia: Option<Inertia>) -> Load {
        let [x, y, z] = centre;
        Load {
            mass: Mass::kg(mass),
            centre: Point3::new(x, y, z),
            inertia,
        }
    }

    fn turned(load: &Load) -> Turned {
        match SMALL_ARM.excess(load) {
            Some(Excess::Inertia(turned)) => turned,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn masses_above_the_rating_are_too_much() {
        assert_eq!(SMALL_ARM.excess(&load(3.0, [0.0; 3], None)), None);
        assert_eq!(SMALL_ARM.excess(&load(3.0 * (1.0 + 1e-12), [0.0; 3], None)), None);
        let heavy = load(3.01, [0.0; 3], None);
        assert_eq!(SMALL_ARM.excess(&heavy), Some(Excess::Mass { rated: 3.0 }));
        assert_eq!(Payload::default().excess(&heavy), None);
    }

    #[test]
    fn a_centre_far_out_is_too_much_for_axis_5() {
        // 2.5 kg at 210 + 72 mm: 2.5 * 0.282^2 = 0.19881 kg m2.
        let turned = turned(&load(2.5, [0.0, 0.0, 210.0], None));
        assert_eq!(turned.axis, 5);
        assert!((turned.inertia - 0.198_81).abs() < 1e-9);
        let heaviest = turned.heaviest.expect("a lighter load");
        assert_eq!(
            SMALL_ARM.excess(&load(heaviest - 1e-6, [0.0, 0.0, 210.0], None)),
            None
        );
        assert!(
            SMALL_ARM
                .excess(&load(heaviest + 1e-6, [0.0, 0.0, 210.0], None))
                .is_some()
        );
    }

    #[test]
    fn a_centre_aside_is_too_much_for_axis_6() {
        // 2 kg, 220 mm aside, in the plane of the wrist centre: 0.0968 kg m2 about both axes.
        let turned = turned(&load(2.0, [132.0, 176.0, -72.0], None));
        assert_eq!((turned.axis, turned.from_axis), (6, 220.0));
        assert!((turned.inertia - 0.0968).abs() < 1e-12);
    }

    #[test]
    fn the_heaviest_load_is_one_for_both_axes() {
        // Too much for axis 5, and axis 6 takes even less.
        let centre = [270.0, 0.0, -215.0];
        let turned = turned(&load(2.8, centre, None));
        let heaviest = turned.heaviest.expect("a lighter load");
        assert_eq!(turned.axis, 5);
        assert!((heaviest - 0.085 / (0.27 * 0.27)).abs() < 1e-9);
        assert_eq!(SMALL_ARM.excess(&load(heaviest - 1e-6, centre, None)), None);
    }

    #[test]
    fn the_inertia_of_the_load_itself_counts() {
        let own = Inertia {
            x: 0.05,
            y: 0.10,
            z: 0.09,
        };
        let near = [0.0, 0.0, -72.0];
        assert_eq!(turned(&load(1.0, near, Some(own))).axis, 6);
        let wide = Inertia { y: 0.18, ..own };
        let turned = turned(&load(1.0, near, Some(wide)));
        assert_eq!((turned.axis, turned.inertia), (5, 0.18));
        assert_eq!(turned.heaviest, None);
    }
}
