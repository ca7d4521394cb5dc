//! Bodies of discs against circles sampled in space.

use super::super::body::{Stand, contacts};
use super::*;
use crate::disc::PassFault;
use crate::rim::Drift;
use crate::surface::Vee;
use proptest::prelude::*;

proptest! {
    #[test]
    fn a_body_enters_the_section_as_deep_as_any_point_of_its_circles(
        cuts in prop::collection::vec((0.0..100.0_f64, 5.0..40.0_f64, 0.3..3.0_f64), 0..5),
        (x, z) in (-10.0..110.0_f64, 0.0..45.0_f64),
        lead in prop_oneof![Just(0.0), 0.1..8.0_f64],
        stages in prop::collection::vec((0.0..15.0_f64, 3.0..40.0_f64), 1..3),
    ) {
        let mut surface = Surface::flat(100.0, 40.0);
        for (x, z, slope) in cuts {
            surface.release(Vee::even(at(x, z), slope));
        }
        let stage = |(from, radius)| BodyStage { from: Length::mm(from), radius: Length::mm(radius) };
        let disc = Disc { body: stages.into_iter().map(stage).collect(), ..disc(25.0) };
        let pass = pass(at(x, z), Side::Right, lead);
        let mut found = Vec::new();
        let stand = Stand {
            centre: pass.centre,
            lead: pass.lead,
            roll: Angle::ZERO,
            drift: Drift::NONE,
            clearance: pass.clearance,
            cover: Some(pass.rim(&disc).cover()),
        };
        contacts(&mut surface, &disc, &stand, &mut found);
        for (number, stage) in disc.body.iter().enumerate() {
            // The axis leans along y.
            let (sine, cosine) = libm::sincos(lead.to_radians());
            let radius = stage.radius.to_mm() + 1.0;
            let mut sampled = 0.0_f64;
            for i in 0..=20_000_u32 {
                let off = radius * (f64::from(i) / 10_000.0 - 1.0);
                let low = z + stage.from.to_mm() * cosine - sine * (radius * radius - off * off).max(0.0).sqrt();
                // The rim takes off what is below the centre.
                let low = if off.abs() <= 25.0 { low.max(z) } else { low };
                if (0.0..=100.0).contains(&(x + off)) {
                    sampled = sampled.max(surface.height(x + off) - low);
                }
            }
            let depth = found.iter().find_map(|fault| match fault {
                PassFault::Body { stage, depth, .. } if *stage == number => Some(depth.to_mm()),
                _ => None,
            });
            let depth = depth.unwrap_or(0.0);
            // The body is narrower by a nanometre, so on the steepest flank it is three nanometres less deep.
            prop_assert!(depth >= sampled - 4e-6, "{number}: {depth} {sampled}");
            prop_assert!(depth <= sampled + 0.05, "{number}: {depth} {sampled}");
        }
    }
}
