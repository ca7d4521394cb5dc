//! Tracks: their poses and moves against drops on the way.

use super::*;
use crate::disc::Stage;
use crate::drop::Dropper;
use crate::mesh::Mesh;
use crate::section::Upright;
use crate::surface::Surface;
use crate::testkit::{FIXED, sampled, surface_over, with_needle};

const SIZE: f64 = 120.0;

fn disc() -> Disc {
    let stage = Stage {
        radius: Length::mm(8.0),
        from: Length::mm(1.2),
        to: Length::mm(40.0),
    };
    Disc::new(Length::mm(25.0), vec![stage]).unwrap()
}

fn demand() -> Demand {
    Demand {
        side: Angle::ZERO,
        least: Angle::deg(3.0),
        most: Angle::deg(30.0),
        rate: Angle::deg(0.5),
        lift: Length::mm(0.01),
        gouge: Length::mm(0.02),
        widest: Length::mm(8.0),
        finest: Length::mm(0.05),
        beyond: Length::ZERO,
    }
}

fn laid(surface: &Surface, plane: Upright, demand: &Demand) -> Result<Track, NoTrack> {
    let dropper = Dropper::new(surface);
    let moves = Moves::new(&dropper).unwrap();
    let (normals, disc) = (Normals::new(surface), disc());
    let layer = Layer {
        moves: &moves,
        normals: &normals,
        disc: &disc,
    };
    layer.track(&surface.section_by(plane).unwrap().unwrap(), demand)
}

/// The deepest that the disc enters on a track, by drops on the way.
fn deepest(surface: &Surface, track: &Track) -> f64 {
    let (dropper, disc) = (Dropper::new(surface), disc());
    let mut deepest = 0.0_f64;
    for pair in track.stops.windows(2) {
        let [a, b] = [pair[0].placed.pose(), pair[1].placed.pose()];
        for k in 0..=8 {
            let share = f64::from(k) / 8.0;
            let between = |a: f64, b: f64| a + (b - a) * share;
            // Axes so near to each other turn evenly enough along their chord.
            let (p, q) = (a.axis.to_array(), b.axis.to_array());
            let axis = Axis::new(core::array::from_fn(|i| between(p[i], q[i]))).unwrap();
            let place = [between(a.centre.x, b.centre.x), between(a.centre.y, b.centre.y)];
            if let Some(rest) = dropper.disc(&disc, place, axis) {
                deepest = deepest.max(rest.height.to_mm() - between(a.centre.z, b.centre.z));
            }
        }
    }
    deepest
}

/// What every track keeps.
fn assert_kept(surface: &Surface, track: &Track, demand: &Demand) {
    let found = deepest(surface, track);
    assert!(
        found <= track.entry.to_mm() + 1e-9,
        "{found} above {:?}",
        track.entry
    );
    for stop in &track.stops {
        assert!(stop.placed.depth().unwrap().to_mm() <= 1e-9);
        assert!(stop.lean.lead >= demand.least);
    }
    for pair in track.stops.windows(2) {
        let [from, to] = [&pair[0], &pair[1]];
        let way = (to.along - from.along).to_mm();
        assert!(way > 0.0 && way <= demand.widest.to_mm() + 1e-9);
        let turned = (to.lean.lead - from.lean.lead).to_rad().abs();
        assert!(turned <= demand.rate.to_rad() * way + 1e-12);
    }
}

#[test]
fn a_track_over_a_hollow_leans_more_there() {
    // Hollow with a radius of 150 about its middle, level beside it.
    let height = |x: f64, _: f64| {
        let x = (x - 60.0).abs().min(30.0);
        x * x / 300.0
    };
    let surface = surface_over(&sampled(SIZE, SIZE, [60, 60], &height), FIXED, SIZE, SIZE);
    for heading in [0.0, 25.0] {
        let plane = Upright::new(Angle::deg(heading), Length::mm(60.0 - heading));
        let track = laid(&surface, plane, &demand()).unwrap();
        assert_kept(&surface, &track, &demand());
        let leads = || track.stops.iter().map(|stop| stop.lean.lead.to_deg());
        let most = leads().fold(0.0, f64::max);
        assert!(most > 7.0 && most < 12.0, "{most}");
        assert!(leads().fold(90.0, f64::min) < 3.5);
        assert!(track.stops.iter().all(|stop| stop.lift.to_mm() < 0.5));
    }
}

#[test]
fn a_track_over_a_dome_stays_on_it() {
    let height = |x: f64, y: f64| -((x - 60.0) * (x - 60.0) + (y - 60.0) * (y - 60.0)) / 800.0;
    let surface = surface_over(&sampled(SIZE, SIZE, [90, 90], &height), FIXED, SIZE, SIZE);
    let plane = Upright::new(Angle::deg(90.0), Length::mm(-40.0));
    let track = laid(&surface, plane, &demand()).unwrap();
    assert_kept(&surface, &track, &demand());
    assert!(track.entry <= demand().gouge, "{:?}", track.entry);
    assert!(
        track
            .stops
            .iter()
            .all(|stop| (stop.lean.lead.to_deg() - 3.0).abs() < 1e-9)
    );
    assert!(track.stops.iter().all(|stop| stop.lift.to_mm() <= 0.01));
    assert!(track.stops.len() < 150, "{}", track.stops.len());
}

#[test]
fn triangles_in_another_order_give_the_same_track() {
    let height = |x: f64, y: f64| 3.0 * libm::sin(x / 25.0 + 0.3) * libm::cos(y / 30.0);
    let mesh = sampled(SIZE, SIZE, [50, 50], &height);
    let plane = Upright::new(Angle::deg(20.0), Length::mm(30.0));
    let track = |mesh: &Mesh| laid(&surface_over(mesh, FIXED, SIZE, SIZE), plane, &demand()).unwrap();
    let straight = track(&mesh);
    let mut triangles = mesh.triangles().to_vec();
    triangles.reverse();
    triangles.rotate_left(777);
    let shuffled = Mesh::new(mesh.corners().to_vec(), triangles).unwrap();
    assert_eq!(track(&shuffled), straight);
}

#[test]
fn a_needle_lifts_the_disc_and_what_cannot_be_proven_is_said() {
    let flat = sampled(SIZE, SIZE, [60, 60], &|_, _| 0.0);
    let surface = surface_over(
        &with_needle(&flat, [60.3, 52.0, 0.0], [60.3, 52.0, 5.0]),
        FIXED,
        SIZE,
        SIZE,
    );
    let demand = Demand {
        lift: Length::mm(6.0),
        finest: Length::mm(0.2),
        ..demand()
    };
    let track = laid(&surface, Upright::new(Angle::ZERO, Length::mm(60.0)), &demand).unwrap();
    assert_kept(&surface, &track, &demand);
    assert!(track.stops.iter().any(|stop| stop.lift.to_mm() > 1.0));
    assert!(track.entry > demand.gouge);
}

#[test]
fn demands_that_make_no_sense_are_refused() {
    let surface = surface_over(&sampled(SIZE, SIZE, [4, 4], &|_, _| 0.0), FIXED, SIZE, SIZE);
    let plane = Upright::new(Angle::ZERO, Length::mm(60.0));
    for bad in [
        Demand {
            finest: Length::ZERO,
            ..demand()
        },
        Demand {
            finest: Length::mm(9.0),
            ..demand()
        },
        Demand {
            gouge: Length::ZERO,
            ..demand()
        },
        Demand {
            widest: Length::mm(f64::NAN),
            ..demand()
        },
        Demand {
            rate: Angle::ZERO,
            ..demand()
        },
    ] {
        assert_eq!(laid(&surface, plane, &bad), Err(NoTrack::Demand));
    }
    let trough = |_: f64, y: f64| (y - 60.0) * (y - 60.0) / 40.0;
    let surface = surface_over(&sampled(SIZE, SIZE, [60, 60], &trough), FIXED, SIZE, SIZE);
    assert!(matches!(
        laid(&surface, plane, &demand()),
        Err(NoTrack::Lead { .. })
    ));
}
