//! The surface against its definition, and against published and simulated numbers.

use super::*;
use proptest::prelude::*;

/// The envelope by its definition.
fn lowest(top: f64, vees: &[Vee], x: f64) -> f64 {
    vees.iter().map(|vee| vee.height(x)).fold(top, f64::min)
}

/// Where a flank comes out, by looking every hundredth of a millimetre, and at the older tips, whose Vs may be
/// narrower than that where the flank passes just above them.
fn exit_by_sampling(width: f64, top: f64, vees: &[Vee], vee: Vee, side: Side) -> f64 {
    let (sense, room) = match side {
        Side::Left => (-1.0, vee.tip.x),
        Side::Right => (1.0, width - vee.tip.x),
    };
    let steps = (0..10_001).map(|step| f64::from(step) * 0.01);
    let tips = vees.iter().map(|older| (older.tip.x - vee.tip.x) * sense);
    let mut distances: Vec<f64> = steps
        .chain(tips)
        .filter(|far| (0.0..=room).contains(far))
        .collect();
    distances.sort_by(f64::total_cmp);
    let x_at = |far: f64| vee.tip.x + sense * far;
    let comes_out = |&far: &f64| lowest(top, vees, x_at(far)) <= vee.height(x_at(far));
    let exit = distances.into_iter().find(comes_out).unwrap_or(room);
    vee.height(x_at(exit)) - vee.tip.z
}

fn a_vee() -> impl Strategy<Value = Vee> {
    (
        0.0..100.0_f64,
        1.0..40.0_f64,
        prop::sample::select(vec![0.7, 1.0, 1.5]),
    )
        .prop_map(|(x, z, slope)| Vee::even(Point2 { x, z }, slope))
}

/// Releases the Vs that a program may release: tip in the material, blade's body clear. Gives those back.
fn release_possible(surface: &mut Surface, vees: &[Vee]) -> Vec<Vee> {
    let possible = |surface: &mut Surface, vee: Vee| {
        surface.covers(vee.tip)
            && [Side::Left, Side::Right]
                .into_iter()
                .all(|side| surface.flank(vee, side).blocked_at.is_none())
    };
    let mut released = Vec::new();
    for &vee in vees {
        if possible(surface, vee) {
            surface.release(vee);
            released.push(vee);
        }
    }
    released
}

proptest! {
    #[test]
    fn is_the_lower_envelope(vees in prop::collection::vec(a_vee(), 0..60), xs in prop::collection::vec(0.0..=100.0_f64, 20)) {
        let mut surface = Surface::flat(100.0, 40.0);
        let vees = release_possible(&mut surface, &vees);
        for x in xs {
            prop_assert!((surface.height(x) - lowest(40.0, &vees, x)).abs() < 1e-5);
        }
        let corners: Vec<_> = surface.corners().collect();
        prop_assert!(corners.windows(2).all(|pair| pair[0].x < pair[1].x));
        prop_assert!(corners[0].x.abs() < 1e-9 && (corners[corners.len() - 1].x - 100.0).abs() < 1e-9);
    }

    #[test]
    fn flanks_come_out_where_the_surface_is_below(vees in prop::collection::vec(a_vee(), 0..30), vee in a_vee()) {
        let mut surface = Surface::flat(100.0, 40.0);
        let vees = release_possible(&mut surface, &vees);
        prop_assume!(surface.covers(vee.tip));
        for side in [Side::Left, Side::Right] {
            let sampled = exit_by_sampling(100.0, 40.0, &vees, vee, side);
            let run = surface.flank(vee, side);
            // Looking from hundredth to hundredth passes over narrower gaps: it may find the exit later, not earlier.
            prop_assert!(run.reach < sampled + 0.04, "{:?} {}", run, sampled);
            let at_side = !(1e-9..=100.0 - 1e-9).contains(&run.exit.x);
            let below = lowest(40.0, &vees, run.exit.x) - run.exit.z;
            prop_assert!(at_side || below < 1e-5, "{:?} is {} below", run, below);
        }
    }
}

/// Places in a stretch as shares of it.
fn shares(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.0..=1.0_f64, count)
}

proptest! {
    #[test]
    fn a_part_of_it_is_the_same_there(
        vees in prop::collection::vec(a_vee(), 0..30),
        ends in [0.0..100.0_f64, 0.0..100.0],
        later in prop::collection::vec((0.0..=1.0_f64, 1.0..40.0_f64), 0..8),
        looked_at in shares(20),
    ) {
        let mut whole = Surface::flat(100.0, 40.0);
        release_possible(&mut whole, &vees);
        let [from, to] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        prop_assume!(to - from > 0.01);
        let mut part = whole.part(from, to);
        let at = |share: f64| from + share * (to - from);
        // As steep as any: what such Vs take out here depends on nothing beyond.
        for (share, z) in later {
            let vee = Vee::even(Point2 { x: at(share), z }, 1.5);
            whole.release(vee);
            part.release(vee);
        }
        for share in looked_at {
            let [one, other] = [&mut whole, &mut part].map(|surface| surface.height(at(share)));
            prop_assert!((one - other).abs() < 1e-5, "{one} {other} at {}", at(share));
        }
        prop_assert!(part.corners().all(|corner| (from..=to).contains(&corner.x)));
    }
}

#[test]
fn cuts_at_the_sides_of_the_stock() {
    let mut surface = Surface::flat(10.0, 10.0);
    for x in [0.0, 10.0] {
        let vee = Vee::even(Point2 { x, z: 5.0 }, 1.0);
        assert_eq!(
            surface
                .flank(vee, if x > 0.0 { Side::Right } else { Side::Left })
                .reach,
            0.0
        );
        surface.release(vee);
    }
    assert_eq!(surface.height(0.0), 5.0);
    assert_eq!(surface.height(10.0), 5.0);
    assert_eq!(surface.height(5.0), 10.0);
    assert_eq!(surface.height(2.0), 7.0);
}

#[test]
fn a_wide_cut_next_to_a_steep_wall_is_blocked_above_its_exit() {
    let mut surface = Surface::flat(100.0, 40.0);
    // A narrow slot leaves a steep wall; a wide V beside it comes out in the slot, but its blade runs on into the wall.
    surface.release(Vee::even(Point2 { x: 50.0, z: 10.0 }, 10.0));
    let wide = Vee::even(Point2 { x: 45.0, z: 12.0 }, 1.0);
    let run = surface.flank(wide, Side::Right);
    assert!(run.exit.x < 50.0);
    assert_eq!(run.blocked_at, Some(Point2 { x: 53.0, z: 40.0 }));
    assert_eq!(surface.flank(wide, Side::Left).blocked_at, None);
}

/// Cuts every lattice point of the 85 x 50 mm block above z = 13.1: cuts, layers, removed area, longest edge needed by
/// a blade with rake - half apex = 52.87 degrees.
fn block(layer: f64, step: f64, swing: f64, first: f64, shift: f64) -> (usize, u32, f64, f64) {
    let swing = vcutc_backend_api::units::Angle::deg(swing);
    let lead = vcutc_backend_api::units::Angle::deg(52.87);
    let mut surface = Surface::flat(85.0, 50.0);
    let (mut cuts, mut reach, mut j) = (0, 0.0_f64, 0);
    while 50.0 - f64::from(j + 1) * layer >= 13.1 {
        j += 1;
        let mut x = if j % 2 == 0 { first + shift } else { first };
        while x <= 85.0 {
            let z = 50.0 - f64::from(j) * layer;
            let vee = Vee::even(Point2 { x, z }, 1.0 / swing.tan());
            reach = reach
                .max(surface.flank(vee, Side::Left).reach)
                .max(surface.flank(vee, Side::Right).reach);
            surface.release(vee);
            cuts += 1;
            x += step;
        }
    }
    let corners: Vec<_> = surface.corners().collect();
    let removed = corners
        .windows(2)
        .map(|p| (p[1].x - p[0].x) * (50.0 - (p[0].z + p[1].z) / 2.0))
        .sum();
    (cuts, j, removed, reach / (swing.cos() * lead.sin()))
}

/// The table of `docs/process.md`, "Lattices and reach", which a simulation of polygons confirmed.
#[test]
fn agrees_with_the_polygon_simulation() {
    let (cuts, layers, removed, edge) = block(4.40, 5.97, 34.16, 5.97 / 2.0, 0.0);
    assert_eq!((cuts, layers), (112, 8));
    assert!((removed - 2799.0).abs() < 2.0 && edge < 10.01, "{removed} {edge}");
    let (cuts, layers, removed, edge) = block(6.470, 4.658, 35.75, 4.658 / 2.0, 0.0);
    assert_eq!((cuts, layers), (90, 5));
    assert!((removed - 2609.0).abs() < 1.0 && edge <= 10.0, "{removed} {edge}");
    // Interlaced: the step of 11.909 is rounded down from 2 h tan(50 deg) = 11.9105, a hair over works.
    let (cuts, layers, removed, edge) = block(4.997, 11.911, 50.0, 0.0, 11.911 / 2.0);
    assert_eq!((cuts, layers), (53, 7));
    assert!((removed - 2764.0).abs() < 1.0 && edge <= 10.0, "{removed} {edge}");
    let (cuts, layers, removed, edge) = block(6.0, 10.07, 40.0, 0.0, 10.07 / 2.0);
    assert_eq!((cuts, layers), (51, 6));
    assert!((removed - 2780.0).abs() < 1.0 && edge <= 10.0, "{removed} {edge}");
    // One per cent of overlap makes interlaced cuts pass under their neighbours and need about 2h.
    let (_, _, _, edge) = block(6.0, 9.97, 40.0, 0.0, 9.97 / 2.0);
    assert!((edge - 2.0 * 9.82).abs() < 0.5, "{edge}");
}
