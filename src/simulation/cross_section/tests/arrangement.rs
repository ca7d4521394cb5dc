//! Random slits, passes and Vs against an arrangement of lines: the block is sliced along all that was cut, by `i_overlay`,
//! and the faces without a piece of the bottom are free. The order of cuts does not count there.

use super::*;
use crate::surface::wall_tests::is_possible;
use crate::surface::{Single, Vee};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::slice::FloatSlice;
use proptest::prelude::*;
use proptest::sample::select;

/// Lines go on by so much, in mm, so that those that end in others do so in spite of rounding.
const NEAR: f64 = 1e-5;

/// All that was cut into a block.
pub(super) struct Arrangement {
    width: f64,
    top: f64,
    lines: Vec<Vec<[f64; 2]>>,
}

impl Arrangement {
    pub(super) const fn of(width: f64, top: f64) -> Self {
        Self {
            width,
            top,
            lines: Vec::new(),
        }
    }

    pub(super) fn slit(&mut self, x: f64, bottom: f64) {
        self.lines.push(vec![[x, bottom - NEAR], [x, self.top + 1.0]]);
    }

    /// Corners so near to each other that chords are below a fifth of a micrometre above the rim.
    pub(super) fn pass(&mut self, disc: &Disc, pass: &DiscPass) {
        let radius = disc.radius.to_mm();
        let lean = libm::sin(pass.lead.to_rad());
        let ends = [-1.0, 1.0].map(|sense| {
            let x = pass.centre.x + sense * (radius + NEAR);
            [x.clamp(-1.0, self.width + 1.0), pass.centre.z]
        });
        if lean == 0.0 {
            self.lines.push(ends.to_vec());
            return;
        }
        let corners = (0..=300_u32).map(|i| {
            // Denser at the ends, where the rim is steep.
            let share = f64::from(i) / 300.0;
            let turn = share * share * (3.0 - 2.0 * share) * core::f64::consts::PI;
            let (sine, cosine) = libm::sincos(turn);
            [
                pass.centre.x - radius * cosine,
                pass.centre.z - lean * radius * sine,
            ]
        });
        // The ends are in line with the rim's own where those are over the block.
        let first = Some(ends[0]).filter(|end| end[0] > -1.0);
        let last = Some(ends[1]).filter(|end| end[0] < self.width + 1.0);
        self.lines
            .push(first.into_iter().chain(corners).chain(last).collect());
    }

    pub(super) fn vee(&mut self, vee: Vee) {
        // No farther out of the block than need be: the finer are the whole numbers that `i_overlay` counts with.
        let far = |slope: f64, sense: f64| {
            let aside = if sense < 0.0 {
                vee.tip.x
            } else {
                self.width - vee.tip.x
            };
            let up = (self.top + 1.0 - vee.tip.z).min((aside + 1.0) * slope);
            [vee.tip.x + sense * up / slope, vee.tip.z + up]
        };
        let tip = [vee.tip.x, vee.tip.z];
        let left = vee.left.map(|slope| far(slope, -1.0));
        let right = vee.right.map(|slope| far(slope, 1.0));
        self.lines
            .push([left, Some(tip), right].into_iter().flatten().collect());
    }

    /// What stands, as contours.
    pub(super) fn rest(&self) -> Vec<Vec<[f64; 2]>> {
        let block = vec![
            [0.0, 0.0],
            [self.width, 0.0],
            [self.width, self.top],
            [0.0, self.top],
        ];
        let faces = block.slice_by_as::<i64>(&self.lines, FillRule::EvenOdd);
        let stands = |face: &Vec<Vec<[f64; 2]>>| face.iter().flatten().any(|[_, z]| z.abs() < 1e-9);
        faces.into_iter().filter(stands).flatten().collect()
    }

    /// Where the section is another at one of many places away from walls, if it is anywhere.
    pub(super) fn differs(&self, section: &mut CrossSection, tolerance: f64) -> Option<(f64, f64, f64)> {
        let rest = self.rest();
        let mut walls: Vec<f64> = section.surface().corners().map(|corner| corner.x).collect();
        walls.extend(rest.iter().flatten().map(|[x, _]| *x));
        walls.sort_by(f64::total_cmp);
        // Between all corners of both, and a little beside them.
        let places = walls
            .windows(2)
            .flat_map(|pair| [0.01, 0.5, 0.99].map(|share| pair[0] + (pair[1] - pair[0]) * share));
        let wide = places
            .zip(walls.windows(2).flat_map(|pair| [pair[1] - pair[0]; 3]))
            .filter(|(_, width)| *width > 1e-3);
        wide.map(|(x, _)| (x, section.surface().height(x), height(&rest, x)))
            .find(|(_, ours, theirs)| (ours - theirs).abs() > tolerance)
    }
}

/// The height of some contours over x.
fn height(contours: &[Vec<[f64; 2]>], x: f64) -> f64 {
    let mut highest = 0.0_f64;
    for contour in contours {
        for (a, b) in contour.iter().zip(contour.iter().cycle().skip(1)) {
            if (a[0] < x) != (b[0] < x) {
                highest = highest.max(a[1] + (b[1] - a[1]) * ((x - a[0]) / (b[0] - a[0])));
            }
        }
    }
    highest
}

#[derive(Clone, Copy, Debug)]
enum Step {
    Slit(f64, f64),
    Pass(DiscPass),
    Vee(Vee),
}

/// Slits 5 mm apart, so that undercuts of 0.5 mm make no lenses.
fn a_slit() -> impl Strategy<Value = Step> {
    let bottom = prop_oneof![3 => (0..=7_u32).prop_map(|z| f64::from(z) * 5.0), 1 => 1.0..39.0_f64];
    ((1..=19_u32).prop_map(|x| f64::from(x) * 5.0), bottom).prop_map(|(x, bottom)| Step::Slit(x, bottom))
}

/// The rim goes beyond a multiple of 5 mm by one of these.
fn a_pass(beyond: &'static [f64]) -> impl Strategy<Value = Step> {
    let z = prop_oneof![3 => (1..=7_u32).prop_map(|z| f64::from(z) * 5.0), 1 => 5.0..39.0_f64];
    let side = select(vec![Side::Left, Side::Right]);
    let beyond = select(beyond);
    (0..=20_u32, z, side, beyond).prop_map(|(x, z, side, beyond)| {
        let inset = 25.0 - beyond;
        let x = f64::from(x) * 5.0;
        let x = match side {
            Side::Left => x + inset,
            Side::Right => x - inset,
        };
        Step::Pass(pass(at(x, z), side, 0.0))
    })
}

fn a_vee() -> impl Strategy<Value = Step> {
    let slope = || select(vec![Some(0.7), Some(1.0), Some(1.5), Some(f64::INFINITY), None]);
    let x = prop_oneof![1 => (1..=19_u32).prop_map(|x| f64::from(x) * 5.0), 1 => 1.0..99.0_f64];
    let z = prop_oneof![1 => (1..=7_u32).prop_map(|z| f64::from(z) * 5.0), 1 => 1.0..39.0_f64];
    (x, z, slope(), slope()).prop_map(|(x, z, left, right)| {
        let left = if right.is_none() { left.or(Some(1.0)) } else { left };
        Step::Vee(Vee {
            tip: at(x, z),
            left,
            right,
        })
    })
}

/// Cuts a V if a program may: nothing is in the blade's way, and a single flank leaves no stump of a slit in the material.
fn cut(section: &mut CrossSection, arrangement: &mut Arrangement, vee: Vee) {
    if !is_possible(section.surface(), vee) {
        return;
    }
    let is_upright = |slope: Option<f64>| slope.is_none_or(f64::is_infinite);
    if vee.is_single()
        && !is_upright(vee.left.or(vee.right))
        && section.surface().single(vee) == Single::Inside
    {
        let is_at_crack = section
            .cracks()
            .iter()
            .any(|crack| crack.x == vee.tip.x && crack.bottom <= vee.tip.z);
        if !is_at_crack {
            return;
        }
    }
    section.release(vee);
    arrangement.vee(vee);
}

fn agrees(steps: Vec<Step>) -> Result<(), TestCaseError> {
    let mut section = block(100.0, 40.0);
    let mut arrangement = Arrangement::of(100.0, 40.0);
    for step in &steps {
        let before = corners(&mut section);
        match *step {
            Step::Slit(x, bottom) => {
                section.slit(x, bottom);
                arrangement.slit(x, bottom);
            }
            Step::Pass(pass) => {
                free(&mut section, &disc(25.0), pass);
                arrangement.pass(&disc(25.0), &pass);
            }
            Step::Vee(vee) => cut(&mut section, &mut arrangement, vee),
        }
        let differs = arrangement.differs(&mut section, 1e-6);
        prop_assert!(
            differs.is_none(),
            "{differs:?} after {step:?} on {before:?}: {:?}",
            corners(&mut section)
        );
    }
    let corners: Vec<Point2> = section.surface().corners().collect();
    prop_assert!(
        corners.windows(2).all(|pair| pair[0].x <= pair[1].x),
        "{corners:?}"
    );
    prop_assert!(
        corners.windows(3).all(|three| three[2].x - three[0].x > 1e-6),
        "{corners:?}"
    );
    Ok(())
}

proptest! {
    #[test]
    fn slits_and_passes_in_any_order_leave_what_an_arrangement_leaves(
        steps in prop::collection::vec(prop_oneof![a_slit(), a_pass(&[0.5, 0.5, 0.0, -0.001])], 0..30),
    ) {
        agrees(steps)?;
    }

    #[test]
    fn vs_among_slits_and_passes_leave_what_an_arrangement_leaves(
        steps in prop::collection::vec(prop_oneof![2 => a_slit(), 2 => a_pass(&[0.5, 0.501, -0.001]), 1 => a_vee()], 0..25),
    ) {
        agrees(steps)?;
    }
}
