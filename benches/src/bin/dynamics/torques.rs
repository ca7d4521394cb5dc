//! Torques of the arms of the catalogue beside phyz-rigid: the same states, in turn, least time of many rounds.

use phyz_math::{DVec, Mat3, SpatialInertia, SpatialTransform, Vec3};
use phyz_model::{Model as Peer, ModelBuilder};
use std::hint::black_box;
use std::time::{Duration, Instant};
use vcutc::dynamics::arm::{Arm, State};
use vcutc::machine::catalogue;
use vcutc::machine::kinematics::linkage::Linkage;
use vcutc_benches::peer::Random;
use vcutc_machine::Model;

const STATES: usize = 2048;
const ROUNDS: usize = 300;
/// The standard acceleration of free fall, as the compiler has it.
const GRAVITY: f64 = 9.80665;

/// Angles, rates and accelerations of six joints.
type Drawn = [[f64; 6]; 3];

/// Prints the rows of the table.
pub(crate) fn table() {
    println!("| Arm | ours, ns | with known sines, ns | phyz-rigid, ns | ratio |");
    println!("| --- | --- | --- | --- | --- |");
    for name in catalogue::names() {
        let model = catalogue::find(name).expect("a name of the catalogue");
        if let Some(arm) = Arm::of(&model, None) {
            row(name, &model, &arm);
        }
    }
}

fn row(name: &str, model: &Model, arm: &Arm) {
    let peer = peer(model);
    let mut random = Random(1);
    let mut six = |most: f64| core::array::from_fn(|_| most * (2.0 * random.next() - 1.0));
    let drawn: Vec<Drawn> = (0..STATES).map(|_| [six(3.0), six(4.0), six(20.0)]).collect();
    let states: Vec<State<f64>> = drawn.iter().map(|drawn| state(arm, drawn)).collect();
    let peers: Vec<_> = drawn.iter().map(|drawn| peer_state(&peer, drawn)).collect();
    agree(arm, &states, &peer, &peers);
    let mut least = [Duration::MAX; 3];
    for _ in 0..ROUNDS {
        let ours = timed(|| {
            for drawn in &drawn {
                black_box(arm.torques(&state(arm, black_box(drawn))));
            }
        });
        let known = timed(|| {
            for state in &states {
                black_box(arm.torques(black_box(state)));
            }
        });
        let theirs = timed(|| {
            for (state, accelerations) in &peers {
                black_box(phyz_rigid::rnea(&peer, black_box(state), accelerations));
            }
        });
        for (least, found) in least.iter_mut().zip([ours, known, theirs]) {
            *least = (*least).min(found);
        }
    }
    let [ours, known, theirs] = least.map(|time| time.as_secs_f64() * 1e9 / STATES as f64);
    println!(
        "| {name} | {ours:.0} | {known:.0} | {theirs:.0} | {:.1} |",
        theirs / ours
    );
}

fn timed(work: impl FnOnce()) -> Duration {
    let begun = Instant::now();
    work();
    begun.elapsed()
}

fn state(arm: &Arm, [joints, rates, accelerations]: &Drawn) -> State<f64> {
    State {
        turns: arm.turns(joints),
        rates: *rates,
        accelerations: *accelerations,
    }
}

fn peer_state(peer: &Peer, [joints, rates, accelerations]: &Drawn) -> (phyz_model::State, DVec) {
    let mut state = peer.default_state();
    for axis in 0..6 {
        state.q[axis] = joints[axis];
        state.v[axis] = rates[axis];
    }
    (state, DVec::from_fn(6, |axis| accelerations[axis]))
}

/// The same bodies on the same lines.
fn peer(model: &Model) -> Peer {
    let vector = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
    let masses = model.masses.as_ref().expect("masses");
    let links = masses.carried().expect("all links");
    let linkage = Linkage::from(&model.mechanism);
    let mut builder = ModelBuilder::new().gravity(Vec3::new(0.0, 0.0, -GRAVITY));
    let mut before = [0.0; 3];
    let lines: Vec<_> = linkage.tool.iter().map(|joint| joint.line).collect();
    for (number, (line, link)) in lines.iter().zip(links).enumerate() {
        let origin: [f64; 3] = (line.point / 1000.0).to_array();
        let offset = core::array::from_fn(|part| origin[part] - before[part]);
        let centre = (link.centre_mm / 1000.0).to_array();
        let centre = core::array::from_fn(|part| centre[part] - origin[part]);
        let [x, y, z] = link.inertia.to_cols_array_2d();
        let inertia = Mat3::new(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]);
        builder = builder.add_revolute_body(
            &link.name,
            number as i32 - 1,
            SpatialTransform::from_translation(vector(offset)),
            SpatialInertia::new(link.mass, vector(centre), inertia),
        );
        before = origin;
    }
    let mut peer = builder.build();
    for (joint, line) in peer.joints.iter_mut().zip(&lines) {
        joint.axis = vector(line.direction.to_array());
    }
    peer
}

/// Both must find the same, or there is nothing to compare.
fn agree(arm: &Arm, states: &[State<f64>], peer: &Peer, peers: &[(phyz_model::State, DVec)]) {
    for (state, (theirs, accelerations)) in states.iter().zip(peers) {
        let ours = arm.torques(state);
        let theirs = phyz_rigid::rnea(peer, theirs, accelerations);
        for axis in 0..6 {
            let apart = (ours[axis] - theirs[axis]).abs();
            assert!(apart < 1e-8 * (1.0 + theirs[axis].abs()), "{apart}");
        }
    }
}
