//! Chains of known shape against an integration by small steps of its own.

use super::*;
use proptest::prelude::*;

/// A line along x, an arc to the left, and a line: in mm.
#[derive(Clone, Copy, Debug)]
struct Shape {
    lines: [f64; 2],
    radius: f64,
    sweep: f64,
    rates: [f64; 3],
    /// Whether the blade follows the way.
    turns: bool,
}

impl Shape {
    fn lengths(&self) -> [f64; 3] {
        [self.lines[0], self.radius * self.sweep, self.lines[1]]
    }

    /// Direction of the way and its bend after so much of a piece.
    fn heading(&self, piece: usize, way: f64) -> (f64, f64) {
        match piece {
            0 => (0.0, 0.0),
            1 => (way / self.radius, 1.0 / self.radius),
            _ => (self.sweep, 0.0),
        }
    }

    fn pieces(&self) -> Vec<Piece> {
        let lengths = self.lengths();
        let piece = |index: usize| {
            let length = lengths[index];
            let count = 60_u32;
            let part = length / f64::from(count);
            let parts = (0..count).map(|k| {
                let (angle, bend) = self.heading(index, (f64::from(k) + 0.5) * part);
                let (sin, cos) = libm::sincos(angle);
                let mut axes = [Slopes::default(); MOST_AXES];
                axes[0] = slopes(cos, -bend * sin, -bend * bend * cos);
                axes[1] = slopes(sin, bend * cos, -bend * bend * sin);
                Part { length: part, axes }
            });
            let (_, bend) = self.heading(index, 0.0);
            Piece {
                length,
                feed: self.rates[index],
                rate: None,
                bend,
                spin: [0.0, 0.0, if self.turns { bend } else { 0.0 }],
                parts: parts.collect(),
            }
        };
        (0..3).map(piece).collect()
    }
}

fn slopes(first: f64, second: f64, third: f64) -> Slopes {
    Slopes { first, second, third }
}

#[derive(Clone, Copy, Debug)]
struct Machine {
    /// Of X and Y.
    axis: f64,
    tip: f64,
    blade: Option<f64>,
    jerk: Option<f64>,
}

fn axes() -> Vec<Axis> {
    let axis = |name: &str| Axis {
        name: name.to_owned(),
        kind: AxisKind::Linear,
        min: -1e4,
        max: 1e4,
        rate: None,
        acceleration: None,
        jerk: None,
    };
    vec![axis("X"), axis("Y")]
}

fn limits(axes: &[Axis], machine: Machine, blend: f64) -> Limits<'_> {
    let bounds = Bounds {
        rate: None,
        acceleration: Some(machine.axis),
        jerk: machine.jerk,
    };
    let path = PathLimits {
        acceleration: Some(machine.tip),
        turning_acceleration: machine.blade,
        jerk: machine.jerk,
        turning_jerk: None,
    };
    let mut own = [Bounds::default(); MOST_AXES];
    (own[0], own[1]) = (bounds, bounds);
    Limits {
        axes,
        tracks: tracks(&own, &path),
        blend,
        kept: if machine.jerk.is_some() {
            Kept::Jerks
        } else {
            Kept::Accelerations
        },
    }
}

fn total(shape: &Shape, machine: Machine, blend: f64) -> f64 {
    let axes = axes();
    times(&shape.pieces(), &limits(&axes, machine, blend))
        .unwrap()
        .iter()
        .sum()
}

/// The sum of the times of the pieces, each from rest to rest.
fn with_rests(shape: &Shape, machine: Machine) -> f64 {
    let axes = axes();
    let limits = limits(&axes, machine, 0.0);
    let alone = |piece: &Piece| times(core::slice::from_ref(piece), &limits).unwrap()[0];
    shape.pieces().iter().map(alone).sum()
}

/// The fastest way by small steps, forwards and backwards: the tip's acceleration in its circle, the turn of the blade smoothed
/// over the joints by the mean of its rate over a window.
fn integrated(shape: &Shape, machine: Machine, blend: f64) -> f64 {
    let lengths = shape.lengths();
    let all: f64 = lengths.iter().sum();
    let count = 60_000_u32;
    let step = all / f64::from(count);
    let piece_at = |way: f64| {
        let ends = [lengths[0], lengths[0] + lengths[1]];
        if way < ends[0] {
            (0, way)
        } else if way < ends[1] {
            (1, way - ends[0])
        } else {
            (2, way - ends[1])
        }
    };
    // The blade's rate a mm at a place, and how it changes.
    let spin = |way: f64| {
        let blended = |joint: f64| {
            let share = ((way - joint) / (2.0 * blend) + 0.5).clamp(0.0, 1.0);
            share * share * (3.0 - 2.0 * share)
        };
        if shape.turns {
            (blended(lengths[0]) - blended(lengths[0] + lengths[1])) / shape.radius
        } else {
            0.0
        }
    };
    // Along the way: what acceleration is left at a rate, up or down.
    let room = |way: f64, z: f64, up: f64| -> f64 {
        let (piece, there) = piece_at(way);
        let (angle, bend) = shape.heading(piece, there);
        let across = bend * z;
        let mut room = (machine.tip * machine.tip - across * across).max(0.0).sqrt();
        let (sin, cos) = libm::sincos(angle);
        for (first, second) in [(cos, -bend * sin), (sin, bend * cos)] {
            if first.abs() > 1e-9 {
                // first * up * a + second * z within the bound.
                let against = second * z * up * first.signum();
                room = room.min((machine.axis - against) / first.abs());
            }
        }
        if let Some(most) = machine.blade {
            let (here, h) = (spin(way), 1e-4);
            let change = (spin(way + h) - spin(way - h)).abs() / (2.0 * h);
            if here > 1e-9 {
                room = room.min((most - change * z) / here);
            }
        }
        room
    };
    let cap = |way: f64| {
        let (piece, _) = piece_at(way);
        let rate = shape.rates[piece];
        let (mut low, mut high) = (0.0, rate * rate);
        if room(way, high, 1.0) >= 0.0
            && room(way, high, -1.0) >= 0.0
            && shape.heading(piece, 0.0).1 * high <= machine.tip
        {
            return high;
        }
        for _ in 0..60 {
            let z = f64::midpoint(low, high);
            let keeps = room(way, z, 1.0) >= 0.0
                && room(way, z, -1.0) >= 0.0
                && shape.heading(piece, 0.0).1 * z <= machine.tip;
            if keeps {
                low = z;
            } else {
                high = z;
            }
        }
        low
    };
    let places: Vec<f64> = (0..count).map(|k| (f64::from(k) + 0.5) * step).collect();
    let caps: Vec<f64> = places.iter().map(|way| cap(*way)).collect();
    let mut back = vec![0.0; caps.len() + 1];
    for k in (0..caps.len()).rev() {
        let z: f64 = back[k + 1];
        back[k] = (z + 2.0 * step * room(places[k], z.min(caps[k]), -1.0).max(0.0)).min(caps[k]);
    }
    back[0] = 0.0;
    let (mut z, mut time) = (0.0_f64, 0.0);
    for k in 0..caps.len() {
        let next = (z + 2.0 * step * room(places[k], z.min(caps[k]), 1.0).max(0.0))
            .min(back[k + 1])
            .min(caps[k]);
        time += 2.0 * step / (z.sqrt() + next.sqrt());
        z = next;
    }
    time
}

fn shapes() -> impl Strategy<Value = Shape> {
    (
        prop::array::uniform2(20.0..200.0_f64),
        10.0..80.0_f64,
        0.3..2.5_f64,
        prop::array::uniform3(30.0..300.0_f64),
        any::<bool>(),
    )
        .prop_map(|(lines, radius, sweep, rates, turns)| Shape {
            lines,
            radius,
            sweep,
            rates,
            turns,
        })
}

fn machines() -> impl Strategy<Value = Machine> {
    (
        300.0..4000.0_f64,
        300.0..4000.0_f64,
        prop::option::of(2.0..60.0_f64),
    )
        .prop_map(|(axis, tip, blade)| Machine {
            axis,
            tip,
            blade,
            jerk: None,
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_chain_takes_as_long_as_by_small_steps(shape in shapes(), machine in machines(), blend in 0.5..8.0_f64) {
        // Of an arc shorter than that the joints at its ends round most, so that the axes follow another way.
        let blend = blend.min(shape.lengths()[1] / 8.0);
        let (found, fine) = (total(&shape, machine, blend), integrated(&shape, machine, blend));
        // The octagon has 92 % of the circle at least, and acceleration counts for a part of the way only.
        prop_assert!(found >= fine * 0.99 && found <= fine * 1.06, "{found} {fine}");
    }

    #[test]
    fn no_rests_and_wider_bounds_never_take_longer(
        shape in shapes(), machine in machines(), blend in 0.5..8.0_f64,
        jerk in prop::option::of(2000.0..200_000.0_f64), by in 1.0..4.0_f64,
    ) {
        let machine = Machine { jerk, ..machine };
        let found = total(&shape, machine, blend);
        let at_rates: f64 = shape.lengths().iter().zip(shape.rates).map(|(length, rate)| length / rate).sum();
        prop_assert!(found >= at_rates * (1.0 - 1e-9), "{found} {at_rates}");
        let rests = with_rests(&shape, machine);
        // Rounding a joint takes a little of what rests would not ask for.
        prop_assert!(found <= rests * (1.0 + 1e-3), "{found} {rests}");
        if let Some(jerk) = jerk {
            let free = total(&shape, Machine { jerk: None, ..machine }, blend);
            prop_assert!(found >= free * (1.0 - 2e-3), "{found} {free}");
            let wider = total(&shape, Machine { jerk: Some(jerk * by), ..machine }, blend);
            prop_assert!(wider <= found * 1.02, "{wider} {found}");
        }
    }
}

/// Where the blade has to turn at once and nothing may be rounded the machine rests, and where it need not it does not.
#[test]
fn without_a_blend_only_jumps_take_a_rest() {
    let shape = Shape {
        lines: [100.0, 80.0],
        radius: 40.0,
        sweep: 1.5,
        rates: [200.0; 3],
        turns: true,
    };
    let machine = Machine {
        axis: 2000.0,
        tip: 2000.0,
        blade: Some(20.0),
        jerk: None,
    };
    let rests = with_rests(&shape, machine);
    assert!((total(&shape, machine, 0.0) - rests).abs() < 1e-9);
    assert!(total(&shape, machine, 4.0) < 0.95 * rests);
    let straight = Shape {
        turns: false,
        ..shape
    };
    assert!(total(&straight, machine, 0.0) < 0.95 * with_rests(&straight, machine));
    // What has no bound may jump.
    let free = Machine {
        blade: None,
        ..machine
    };
    assert!((total(&shape, free, 0.0) - total(&straight, free, 0.0)).abs() < 1e-9);
}

#[test]
fn an_arc_is_as_slow_as_its_tip_may_be() {
    // At most sqrt(a R) on the arc, sqrt(1000 * 40) = 200 mm/s, of which long lines let the tip have nearly all.
    let shape = Shape {
        lines: [150.0, 150.0],
        radius: 40.0,
        sweep: 3.0,
        rates: [400.0; 3],
        turns: false,
    };
    let machine = Machine {
        axis: 1e6,
        tip: 1000.0,
        blade: None,
        jerk: None,
    };
    let axes = axes();
    let times = times(&shape.pieces(), &limits(&axes, machine, 0.0)).unwrap();
    let arc = times[1];
    assert!(arc > 120.0 / 200.0 - 1e-6 && arc < 1.05 * 120.0 / 200.0, "{arc}");
}
