//! How much of a rim is in the material, against points of its circle in space, each of which cuts what those ahead of it left.

use super::*;
use crate::rim::{Drift, Rim, axis};
use crate::surface::Vee;
use proptest::prelude::*;

/// Points of the circle that are looked at.
const POINTS: u32 = 40_000;

#[derive(Clone, Copy, Debug)]
struct Held {
    centre: Point2,
    radius: f64,
    lead: f64,
    roll: f64,
}

impl Held {
    fn rim(&self) -> Rim {
        Rim::rolled(
            self.centre,
            Length::mm(self.radius),
            Angle::deg(self.lead),
            Angle::deg(self.roll),
        )
    }

    fn pass(&self) -> crate::disc::SkinPass {
        crate::disc::SkinPass {
            centre: self.centre,
            contact: self.centre.x,
            lead: Angle::deg(self.lead),
            roll: Angle::deg(self.roll),
            drift: Drift::NONE,
            over_hub: Length::mm(100.0),
            clearance: Length::ZERO,
        }
    }

    /// The share of its circle that meets material on its way along +y, times its length.
    fn in_material(&self, surface: &mut Surface) -> f64 {
        let [x, y, z] = axis(Angle::deg(self.lead), Angle::deg(self.roll));
        // Two directions square to the axis, of which the first one is level along x and z.
        let u = [z, 0.0, -x].map(|part| part / libm::hypot(x, z));
        let v = [y * u[2] - z * u[1], z * u[0] - x * u[2], x * u[1] - y * u[0]];
        let at = |turn: f64| {
            let (sine, cosine) = libm::sincos(turn);
            [0, 1, 2].map(|part| self.radius * (cosine * u[part] + sine * v[part]))
        };
        // The two points over one x lie at turns that are mirrored about that of the greatest x.
        let mirror = 2.0 * libm::atan2(v[0], u[0]);
        let cutting = (0..POINTS).filter(|&number| {
            let turn = (f64::from(number) + 0.5) / f64::from(POINTS) * core::f64::consts::TAU;
            let ([x, y, z], [_, other_y, other_z]) = (at(turn), at(mirror - turn));
            let place = self.centre.x + x;
            if !(0.0..=surface.width()).contains(&place) {
                return false;
            }
            let is_first = y > other_y || z < other_z;
            is_first && surface.height(place) > self.centre.z + z
        });
        cutting.count() as f64 / f64::from(POINTS) * core::f64::consts::TAU * self.radius
    }
}

fn any_held() -> impl Strategy<Value = Held> {
    (
        -10.0..110.0_f64,
        5.0..30.0_f64,
        5.0..40.0_f64,
        0.5..15.0_f64,
        -30.0..30.0_f64,
    )
        .prop_map(|(x, z, radius, lead, roll)| Held {
            centre: at(x, z),
            radius,
            lead,
            roll,
        })
}

proptest! {
    /// In a section with grooves, with walls and with what earlier discs left.
    #[test]
    fn the_material_is_met_by_as_much_of_a_rim_as_by_points_of_its_circle(
        grooves in prop::collection::vec((0.0..100.0_f64, 4.0..24.0_f64), 0..8),
        earlier in prop::collection::vec(any_held(), 0..4),
        held in any_held(),
    ) {
        let mut surface = Surface::flat(100.0, 25.0);
        for (x, bottom) in grooves {
            surface.release(Vee::even(at(x, bottom), 2.0));
        }
        let mut section = CrossSection::new(surface);
        for before in earlier {
            section.skim(&disc(before.radius), &before.pass());
        }
        let found = section.engaged(&held.rim(), Length::mm(held.radius)).to_mm();
        let wanted = held.in_material(section.surface());
        // Each end of a stretch is found to a point.
        let room = 24.0 * core::f64::consts::TAU * held.radius / f64::from(POINTS);
        prop_assert!((found - wanted).abs() <= room, "{found} {wanted}");
    }
}

/// A level disc beside a wall: `R acos(1 - a / R)` of it is in a strip of the width `a`.
#[test]
fn a_strip_at_the_side_of_a_level_disc_meets_the_known_arc() {
    for width in [4.0, 25.0, 31.0] {
        let mut section = block(width, 20.0);
        let rim = Rim::new(at(width - 25.0, 10.0), Length::mm(25.0), Angle::ZERO);
        let found = section.engaged(&rim, Length::mm(25.0)).to_mm();
        let wanted = 25.0 * libm::acos(1.0 - width / 25.0);
        assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
        let above = Rim::new(at(width - 25.0, 20.0), Length::mm(25.0), Angle::ZERO);
        assert_eq!(section.engaged(&above, Length::mm(25.0)), Length::ZERO);
    }
}

/// Between two tracks on a plane only what they leave is met, whatever the disc could take: half of their distance on either side.
#[test]
fn between_two_tracks_a_disc_meets_little_more_than_the_step() {
    let mut section = block(100.0, 9.0);
    let met = [20.0, 40.0, 30.0].map(|x| {
        let held = Held {
            centre: at(x, 10.0),
            radius: 25.0,
            lead: 5.0,
            roll: 0.0,
        };
        let met = section.engaged(&held.rim(), Length::mm(25.0)).to_mm();
        section.skim(&disc(25.0), &held.pass());
        met
    });
    let wanted = 25.0 * (libm::acos(-0.2) - libm::acos(0.2));
    // Floors are chords a little above their rims.
    let more = met[2] - wanted;
    assert!(
        (-1e-9..0.2).contains(&more) && met[0] > 3.0 * wanted,
        "{met:?} {wanted}"
    );
}
