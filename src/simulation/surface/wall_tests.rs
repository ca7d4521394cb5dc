//! Walls, flanks of different swings and single flanks, against polygons: the material is a polygon, every cut a line
//! that slices it, and the pieces that have nothing of the bottom are free. That is done by `i_overlay`, which knows nothing of
//! stacks, corners or flanks.

use super::{Side, Single, Surface, TOUCH, Vee};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use i_overlay::float::slice::FloatSlice;
use proptest::prelude::*;
use proptest::sample::select;
use vcutc_geometry::curve::Point2;

const WALL: f64 = f64::INFINITY;

const fn at(x: f64, z: f64) -> Point2 {
    Point2 { x, z }
}

fn corners(surface: &Surface) -> Vec<(f64, f64)> {
    surface.corners().map(|corner| (corner.x, corner.z)).collect()
}

pub(crate) type Polygon = Vec<[f64; 2]>;

/// All of the material, as polygons.
#[derive(Clone, Debug)]
pub(crate) struct Material(Vec<Vec<Polygon>>);

impl Material {
    pub(crate) fn block(width: f64, top: f64) -> Self {
        Self(vec![vec![vec![
            [0.0, 0.0],
            [width, 0.0],
            [width, top],
            [0.0, top],
        ]]])
    }

    pub(crate) fn below(surface: &Surface) -> Self {
        let mut outline: Polygon = surface.corners().map(|corner| [corner.x, corner.z]).collect();
        outline.extend([[surface.width(), 0.0], [0.0, 0.0]]);
        Self(vec![vec![outline]])
    }

    /// Slices along the flanks of a cut, far up, and drops the pieces that do not reach down to the bottom.
    pub(crate) fn cut(&mut self, vee: Vee) {
        self.cut_beside(vee, &mut Vec::new());
    }

    /// The same with upright slits that are there: what lies between them and the cut comes free too. One whose flanks are
    /// upright is one more of them.
    pub(crate) fn cut_beside(&mut self, vee: Vee, slits: &mut Vec<Polygon>) {
        let far = |slope: Option<f64>, sense: f64| {
            slope.map(|slope| [vee.tip.x + sense * 200.0 / slope, vee.tip.z + 200.0])
        };
        let tip = [vee.tip.x, vee.tip.z];
        // A single flank begins a nanometre before its tip, so that one on the surface does not end in it by rounding.
        let before = |slope: Option<f64>, sense: f64| {
            slope.map(|slope| {
                let run = (TOUCH / slope).min(TOUCH);
                [
                    tip[0] - sense * run,
                    tip[1] - if run > 0.0 { run * slope } else { TOUCH },
                ]
            })
        };
        let start = |this, other: Option<f64>, sense| far(this, sense).or(before(other, -sense));
        let line: Polygon = start(vee.left, vee.right, -1.0)
            .into_iter()
            .chain([tip])
            .chain(start(vee.right, vee.left, 1.0))
            .collect();
        let is_slit = [vee.left, vee.right].into_iter().flatten().all(f64::is_infinite);
        let mut lines = slits.clone();
        lines.push(line.clone());
        if is_slit {
            slits.push(line);
        }
        let pieces = self.0.slice_by_as::<i64>(&lines, FillRule::EvenOdd);
        let stands = |piece: &Vec<Polygon>| piece.iter().flatten().any(|[_, z]| z.abs() < 1e-9);
        self.0 = pieces.into_iter().filter(stands).collect();
    }

    pub(crate) fn area(&self) -> f64 {
        let of = |polygon: &Polygon| {
            let next = polygon.iter().cycle().skip(1);
            let cross = |([x, z], [u, w]): (&[f64; 2], &[f64; 2])| x * w - u * z;
            polygon.iter().zip(next).map(cross).sum::<f64>() / 2.0
        };
        // Holes go the other way round.
        self.0.iter().flatten().map(of).sum::<f64>().abs()
    }

    /// Area of what only one of two has.
    pub(crate) fn differs_by(&self, other: &Self) -> f64 {
        Self(
            self.0
                .overlay_as::<i64>(&other.0, OverlayRule::Xor, FillRule::EvenOdd),
        )
        .area()
    }
}

/// Whether a program may make a cut: nothing of the blade's way is blocked.
pub(crate) fn is_possible(surface: &mut Surface, vee: Vee) -> bool {
    if vee.is_single() {
        return match surface.single(vee) {
            Single::Outside => true,
            Single::Inside => [Side::Left, Side::Right]
                .into_iter()
                .all(|side| surface.flank(vee, side).blocked_at.is_none()),
            Single::Frees(run) => run.blocked_at.is_none(),
        };
    }
    let sides = [Side::Left, Side::Right];
    surface.covers(vee.tip)
        && sides
            .into_iter()
            .all(|side| surface.flank(vee, side).blocked_at.is_none())
}

/// Coarse places, so that tips come to lie at walls, at their feet and at the sides of the stock.
fn a_cut() -> impl Strategy<Value = Vee> {
    let slope = || {
        select(vec![
            Some(WALL),
            Some(WALL),
            Some(0.7),
            Some(1.0),
            Some(1.5),
            Some(20.0),
            None,
        ])
    };
    let x = prop_oneof![
        3 => (0..=20_u32).prop_map(|x| f64::from(x) * 5.0),
        1 => (0..=20_u32).prop_map(|x| f64::from(x) * 5.0 + 0.0005),
        2 => -10.0..110.0_f64,
    ];
    let z = prop_oneof![2 => (1..=8_u32).prop_map(|z| f64::from(z) * 5.0), 1 => 1.0..45.0_f64];
    (x, z, slope(), slope()).prop_map(|(x, z, left, right)| {
        // At least one flank, and only tips of single ones beside the stock.
        let left = if right.is_none() { left.or(Some(1.0)) } else { left };
        let is_single = left.is_none() || right.is_none();
        let x = if is_single { x } else { x.clamp(0.0, 100.0) };
        Vee {
            tip: at(x, z),
            left,
            right,
        }
    })
}

/// A surface that starts with walls, and single flanks that begin there: slots with a wall on either side.
fn a_start() -> impl Strategy<Value = Vec<Vee>> {
    let single = (
        select(vec![0.4, 1.0, 3.0]),
        select(vec![-5.0, 0.0, 2.5]),
        prop::bool::ANY,
    );
    let slot = (
        0..=19_u32,
        1..=7_u32,
        select(vec![0.0, 0.0004, 3.0]),
        prop::option::of(single),
    );
    prop::collection::vec(slot, 0..4).prop_map(|slots| {
        let cuts = slots.into_iter().flat_map(|(x, z, inset, single)| {
            let tip = at(f64::from(x) * 5.0 + inset, f64::from(z) * 5.0);
            let other = at(tip.x + 5.0, tip.z);
            let single = single.map(|(slope, above, from_left)| {
                let (from, side) = if from_left {
                    (tip, Side::Left)
                } else {
                    (other, Side::Right)
                };
                Vee::one(at(from.x, from.z + above), side, slope)
            });
            let slot = [
                Vee::even(tip, 1.0).with(Side::Left, WALL),
                Vee::even(other, 1.0).with(Side::Right, WALL),
            ];
            slot.into_iter().chain(single)
        });
        cuts.filter(|vee| vee.tip.x <= 100.0).collect()
    })
}

proptest! {
    #[test]
    fn leaves_what_slicing_polygons_leaves(start in a_start(), cuts in prop::collection::vec(a_cut(), 0..25)) {
        let mut surface = Surface::flat(100.0, 40.0);
        let mut material = Material::block(100.0, 40.0);
        for vee in start.into_iter().chain(cuts) {
            if !is_possible(&mut surface, vee) {
                continue;
            }
            let before = surface.clone();
            let chip = surface.chip(vee);
            surface.release(vee);
            material.cut(vee);
            let left = Material::below(&surface);
            let apart = left.differs_by(&material);
            prop_assert!(apart < 1e-3, "{vee:?} on {:?} leaves {:?}, {apart} off", corners(&before), corners(&surface));
            // What comes out is the chip.
            let freed = Material::below(&before).area() - left.area();
            let chip = chip.map_or(0.0, |chip| Material(vec![vec![chip.iter().map(|p| [p.x, p.z]).collect()]]).area());
            prop_assert!((chip - freed).abs() < 1e-3, "{vee:?} on {:?}: {chip} {freed}", corners(&before));
            // Exactly the polygon, but for rounding, from now on: errors do not add up.
            material = left;
        }
        let corners: Vec<Point2> = surface.corners().collect();
        prop_assert!(corners.windows(2).all(|pair| pair[0].x <= pair[1].x));
        prop_assert!(corners[0].x.abs() < TOUCH && (corners[corners.len() - 1].x - 100.0).abs() < TOUCH);
        prop_assert!(corners.windows(3).all(|three| three[2].x - three[0].x > TOUCH), "{corners:?}");
    }

    /// The tree finds the same corner as looking at all of them.
    #[test]
    fn what_stands_beyond_a_flank_is_found(
        start in a_start(),
        cuts in prop::collection::vec(a_cut(), 0..40),
        asked in prop::collection::vec((0.0..100.0_f64, 1.0..40.0_f64, 0.3..3.0_f64), 8),
    ) {
        let mut surface = Surface::flat(100.0, 40.0);
        for vee in start.into_iter().chain(cuts) {
            surface.release(vee);
            for &(x, z, slope) in &asked {
                let vee = Vee::even(at(x, z), slope);
                if !surface.covers(vee.tip) || surface.is_final_for(slope) {
                    continue;
                }
                let run = surface.flank(vee, Side::Right);
                let above = |corner: &Point2| corner.z > vee.height(corner.x) + TOUCH;
                // Which corners of a wall a flank has passed that comes out there is another question.
                if surface.corners().any(|corner| (corner.x - run.exit.x).abs() <= 2.0 * TOUCH) {
                    continue;
                }
                let after = surface.corners().filter(|corner| corner.x > run.exit.x);
                let expected = after.into_iter().find(above);
                prop_assert_eq!(run.blocked_at, expected, "{:?} {:?}", vee, corners(&surface));
            }
        }
    }
}

#[test]
fn a_flank_that_ends_in_a_wall_keeps_the_upper_corner() {
    let mut surface = Surface::flat(100.0, 40.0);
    surface.release(Vee {
        tip: at(30.0, 10.0),
        left: Some(1.0),
        right: Some(WALL),
    });
    assert_eq!(
        corners(&surface),
        [(0.0, 40.0), (30.0, 10.0), (30.0, 40.0), (100.0, 40.0)]
    );
    // From the right through the wall: its upper half stays as it is but for what is above the flank.
    let vee = Vee::even(at(40.0, 10.0), 1.0);
    let run = surface.flank(vee, Side::Left);
    assert_eq!((run.exit, run.met), (at(30.0, 20.0), 30.0));
    surface.release(vee);
    let expected = [
        (0.0, 40.0),
        (30.0, 10.0),
        (30.0, 20.0),
        (40.0, 10.0),
        (70.0, 40.0),
        (100.0, 40.0),
    ];
    assert_eq!(corners(&surface), expected);
    assert_eq!(surface.heights(30.0), [10.0, 20.0]);
    assert_eq!(surface.height(30.0), 20.0);
}

#[test]
fn a_flank_ends_at_the_foot_and_at_the_head_of_a_wall() {
    for (foot, expected) in [
        // Its left flank meets the foot.
        (
            10.0,
            vec![
                (0.0, 40.0),
                (30.0, 10.0),
                (40.0, 0.0),
                (80.0, 40.0),
                (100.0, 40.0),
            ],
        ),
        // The head.
        (
            5.0,
            vec![
                (0.0, 40.0),
                (30.0, 5.0),
                (30.0, 10.0),
                (40.0, 0.0),
                (80.0, 40.0),
                (100.0, 40.0),
            ],
        ),
    ] {
        let mut surface = Surface::flat(100.0, 40.0);
        surface.release(Vee {
            tip: at(30.0, foot),
            left: Some((40.0 - foot) / 30.0),
            right: Some(WALL),
        });
        if foot < 10.0 {
            surface.release(Vee {
                tip: at(30.0, 10.0),
                left: Some(WALL),
                right: Some(3.0),
            });
        }
        let vee = Vee::even(at(40.0, 0.0), 1.0);
        let run = surface.flank(vee, Side::Left);
        assert_eq!((run.exit, run.blocked_at), (at(30.0, 10.0), None));
        surface.release(vee);
        assert_eq!(corners(&surface), expected);
    }
}

#[test]
fn two_walls_less_than_a_micrometre_apart() {
    let mut surface = Surface::flat(100.0, 40.0);
    surface.release(Vee {
        tip: at(50.0, 10.0),
        left: Some(1.0),
        right: Some(WALL),
    });
    surface.release(Vee {
        tip: at(50.0004, 10.0),
        left: Some(WALL),
        right: Some(1.0),
    });
    // A leaf of 0.4 um stands.
    let leaf = [
        (20.0, 40.0),
        (50.0, 10.0),
        (50.0, 40.0),
        (50.0004, 40.0),
        (50.0004, 10.0),
        (80.0004, 40.0),
    ];
    assert_eq!(&corners(&surface)[1..7], leaf);
    assert_eq!(surface.heights(50.0), [10.0, 40.0]);
    assert_eq!(surface.heights(50.0004), [40.0, 10.0]);
    assert_eq!(surface.height(50.0002), 40.0);
    // A flank that leads through it comes out at its other face, and leaves a stump.
    let vee = Vee::one(at(52.0, 14.0), Side::Left, 0.5);
    let Single::Frees(run) = surface.single(vee) else {
        panic!()
    };
    assert!((run.exit.x - 50.0).abs() < 1e-12 && (run.exit.z - 15.0).abs() < 1e-9);
}

#[test]
fn walls_at_the_sides_of_the_stock_are_the_sides() {
    let mut surface = Surface::flat(100.0, 40.0);
    let left = Vee {
        tip: at(0.0, 10.0),
        left: Some(WALL),
        right: Some(1.0),
    };
    assert_eq!(surface.flank(left, Side::Left).reach, 0.0);
    surface.release(left);
    surface.release(Vee {
        tip: at(100.0, 20.0),
        left: Some(1.0),
        right: Some(WALL),
    });
    let expected = [(0.0, 10.0), (30.0, 40.0), (80.0, 40.0), (100.0, 20.0)];
    assert_eq!(corners(&surface), expected);
    // Upwards along a side is nothing.
    surface.release(Vee {
        tip: at(0.0, 5.0),
        left: Some(1.0),
        right: Some(WALL),
    });
    assert_eq!(corners(&surface), expected);
}

#[test]
fn a_single_flank_frees_from_outside_and_not_from_within() {
    let mut surface = Surface::flat(100.0, 40.0);
    let within = Vee::one(at(50.0, 10.0), Side::Left, 1.0);
    assert_eq!(surface.single(within), Single::Inside);
    surface.release(within);
    assert_eq!(corners(&surface), [(0.0, 40.0), (100.0, 40.0)]);
    // From the side of the stock, and from beside it.
    for vee in [
        Vee::one(at(0.0, 30.0), Side::Right, 1.0),
        Vee::one(at(-20.0, 10.0), Side::Right, 1.0),
    ] {
        let mut surface = surface.clone();
        let Single::Frees(run) = surface.single(vee) else {
            panic!()
        };
        assert_eq!((run.exit, run.reach), (at(10.0, 40.0), 40.0 - vee.tip.z));
        surface.release(vee);
        assert_eq!(corners(&surface), [(0.0, 30.0), (10.0, 40.0), (100.0, 40.0)]);
    }
    // From the foot of a wall, and from the air before it.
    surface.release(Vee {
        tip: at(30.0, 10.0),
        left: Some(WALL),
        right: Some(1.0),
    });
    for vee in [
        Vee::one(at(30.0, 10.0), Side::Left, 3.0),
        Vee::one(at(31.0, 13.0), Side::Left, 3.0),
    ] {
        let mut surface = surface.clone();
        assert!(matches!(surface.single(vee), Single::Frees(_)), "{vee:?}");
        surface.release(vee);
        assert!((surface.height(25.0) - if vee.tip.x > 30.0 { 31.0 } else { 25.0 }).abs() < 1e-9);
    }
    // Away from it there is only air.
    assert_eq!(
        surface.single(Vee::one(at(30.0, 20.0), Side::Right, 2.0)),
        Single::Outside
    );
    // A wall frees nothing, and within the material it is a slit.
    assert_eq!(
        surface.single(Vee::one(at(50.0, 5.0), Side::Left, WALL)),
        Single::Inside
    );
    assert_eq!(
        surface.single(Vee::one(at(30.0, 20.0), Side::Left, WALL)),
        Single::Outside
    );
}
