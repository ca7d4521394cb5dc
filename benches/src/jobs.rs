//! Jobs of a given size.
//!
//! All have the same cut: 0.5 mm layers, 1 mm steps, 45 degrees of swing and no overlap, so that larger jobs are larger
//! and nothing else. Stock and number of layers grow alike, as they would in a deeper and wider part; the part's profile
//! is a wave of 50 mm near the bottom, on which the last layers end.

/// Height of the part's mean line above the stock's bottom, in mm.
const PART: f64 = 3.0;

/// Layer spacing in mm.
const LAYER: f64 = 0.5;

/// A job with about this many cuts, which should be a square number.
#[must_use]
pub fn text(cuts: u32) -> String {
    let side = cuts.isqrt();
    // A step is 1 mm, so columns are millimetres.
    let width = side;
    let height = PART + f64::from(side) * LAYER;
    format!(
        r#"job "bench_{cuts}"

stock {{ size = ({width} mm, 50 mm, {height} mm) }}

profile {{ z(x) = {PART} mm + 1 mm * cos(360 deg * x / 50 mm) }}

blade dagger {{
  cutting_length = 10 mm
  half_apex      = 7.13 deg
  thickness      = 0 mm
  edges          = double
}}

rough vcut {{
  blade     = dagger
  lattice   = orthogonal
  rake      = 60 deg
  swing     = 45 deg
  layer     = {LAYER} mm
  step      = 1 mm
  residual  = mixed
  order     = point
  sequence  = rows
  feed      {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
  clearance = 10 mm
}}

machine cell = robot "kuka/kr210_r3100_ultra" {{
  tool       = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base       = frame(x = 1800 mm, y = -25 mm, z = 700 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  home       = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  ultrasonic = output(12)
  ready      = input(7)
}}
"#
    )
}

/// What a job is cut on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Machine {
    /// A large robot.
    Robot,
    /// Nothing.
    None,
}

/// A job like a spoiler of 300 mm chord and 400 mm span, cut in layers and steps that give about so many cuts.
#[must_use]
pub fn spoiler(cuts: u32, machine: Machine) -> String {
    // Layers by steps of 1.24 layers in some 5950 mm2 above the part.
    let layer = (5950.0 / 1.24 / f64::from(cuts)).sqrt();
    let machine = match machine {
        Machine::None => "",
        Machine::Robot => {
            r#"
machine cell = robot "kuka/kr210_r3100_ultra" {
  tool       = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base       = frame(x = 1700 mm, y = -700 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)
  home       = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  ultrasonic = output(12)
}
"#
        }
    };
    format!(
        r#"job "bench_spoiler_{cuts}"

stock {{ size = (300 mm, 400 mm, 45 mm) }}

profile {{ z(x) = 30 mm - 10 mm * cos(180 deg * (x - 150 mm) / 300 mm) }}

blade long_dagger {{
  cutting_length = 32 mm
  half_apex      = 9 deg
  thickness      = 1.6 mm
  edges          = double
}}

rough vcut {{
  blade     = long_dagger
  lattice   = orthogonal
  rake      = 60 deg
  swing     = 40 deg
  layer     = {layer:.3} mm
  step      = {step:.3} mm
  residual  = mixed
  order     = point
  sequence  = rows
  feed      {{ cut = 12 m/min, travel = 18 m/min, reorient = 90 deg/s }}
  clearance = 20 mm
}}
{machine}"#,
        step = 1.24 * layer,
    )
}

/// What blocks before a robot are cut for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// Cuts of 1 m before a large arm.
    OfReach,
    /// Cuts of 0.6 m before an arm whose masses and load are known.
    OfWeight,
    /// Cuts of 0.6 m by a blade whose forces are stated, before an arm whose stiffness is known.
    OfForces,
}

/// A block of 500 mm by 140 mm before a robot, cut in layers and steps that give about so many cuts.
#[must_use]
pub fn block(cuts: u32, block: Block) -> String {
    // The width by steps of nine tenths of a layer, the height to remove by layers.
    let layer = (500.0 * 120.0 / 0.9 / f64::from(cuts)).sqrt();
    let (long, blade, robot) = match block {
        Block::OfReach => (
            1000,
            "cutting_length = 30 mm",
            r#"robot "kuka/kr210_r3100_ultra" {
  base       = frame(x = 1500 mm, y = -500 mm, z = 900 mm, a = 0 deg, b = 0 deg, c = 0 deg)"#,
        ),
        Block::OfWeight => (
            600,
            "cutting_length = 60 mm",
            r#"robot "kuka/kr210_r3100_ultra" {
  base       = frame(x = 1500 mm, y = -300 mm, z = 900 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  load       = load(mass = 14.5 kg, x = 0 mm, y = 0 mm, z = 140 mm)"#,
        ),
        Block::OfForces => (
            600,
            r#"cutting_length = 60 mm
  forces {
    drag = 1.1 N/mm, axial = 0.4 N/mm, side = 0.3 N/mm, spread = 20 %
    measured { feed = 200 mm/s, rake = 80 deg, swing = 25 deg }
    source = "made up for this benchmark"
  }"#,
            r#"robot "kuka/kr210_r2700_prime" {
  base       = frame(x = 1300 mm, y = -300 mm, z = 900 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  load       = load(mass = 14.5 kg, x = 0 mm, y = 0 mm, z = 140 mm)"#,
        ),
    };
    format!(
        r#"job "bench_block_{cuts}"

stock {{ size = (500 mm, {long} mm, 140 mm) }}

profile {{
  start (0 mm, 20 mm)
  line to (500 mm, 20 mm)
}}

blade dagger {{
  {blade}
  half_apex      = 7.13 deg
  thickness      = 1 mm
  edges          = double
}}

rough vcut {{
  blade     = dagger
  lattice   = orthogonal
  rake      = 80 deg
  swing     = 25 deg
  layer     = {layer:.3} mm
  step      = {step:.3} mm
  residual  = mixed
  order     = point
  sequence  = rows
  feed      {{ cut = 200 mm/s, travel = 300 mm/s, reorient = 60 deg/s }}
  clearance = 20 mm
}}

machine cell = {robot}
  tool       = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  home       = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  ultrasonic = output(12)
}}
"#,
        step = 0.9 * layer,
    )
}
