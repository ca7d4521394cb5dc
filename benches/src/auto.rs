//! Random jobs that leave all parameters of their V cuts to the compiler.
//!
//! Of one number always comes the same job. Parts are waves, hollows, humps and lines of a few corners; blades, speeds and
//! limits are of the size that shops have. All jobs are right, and nothing says that they can be cut, or that their robot can cut
//! them.

use std::fmt::Write as _;

/// A sequence of numbers that look random (splitmix64).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// From 0 to below 1.
    fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / 9_007_199_254_740_992.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    /// A whole number.
    fn whole(&mut self, low: f64, high: f64) -> f64 {
        self.between(low, high).round()
    }

    fn one_of<T: Copy, const N: usize>(&mut self, all: [T; N]) -> T {
        let place = self.next() % N as u64;
        all[usize::try_from(place).unwrap_or(0)]
    }

    fn is(&mut self, share: f64) -> bool {
        self.share() < share
    }
}

/// The part over a stock of that width and height: its `profile` block.
fn profile(dice: &mut Dice, width: f64, height: f64) -> String {
    let low = dice.whole(0.12 * height, 0.45 * height);
    let rise = dice.whole(0.15 * height, 0.45 * height);
    let middle = width / 2.0;
    match dice.next() % 6 {
        0 => {
            let length = dice.whole(0.5 * width, 2.0 * width);
            wave(low + rise / 2.0, rise / 2.0, length)
        }
        1 => wave(low + rise / 2.0, -rise / 2.0, width),
        2 => {
            let bend = 4.0 * rise / (width * width);
            let top = low + rise;
            format!("profile {{ z(x) = {top} mm - {bend:.8} / 1 mm * (x - {middle} mm)^2 }}")
        }
        3 => {
            let bend = 4.0 * rise / (width * width);
            format!("profile {{ z(x) = {low} mm + {bend:.8} / 1 mm * (x - {middle} mm)^2 }}")
        }
        4 => {
            let ends = if dice.is(0.5) {
                [low, low + rise]
            } else {
                [low + rise, low]
            };
            corners(&[(0.0, ends[0]), (width, ends[1])])
        }
        _ => {
            let parts = 2 + u32::try_from(dice.next() % 3).unwrap_or(0);
            let each = width / f64::from(parts);
            let all: Vec<(f64, f64)> = (0..=parts)
                .map(|number| {
                    let off = if number == 0 || number == parts {
                        0.0
                    } else {
                        dice.between(-0.25, 0.25)
                    };
                    let x = (each * (f64::from(number) + off)).round();
                    (x.min(width), (low + rise * dice.share()).round())
                })
                .collect();
            corners(&all)
        }
    }
}

fn wave(middle: f64, height: f64, length: f64) -> String {
    format!("profile {{ z(x) = {middle} mm + {height} mm * cos(360 deg * x / {length} mm) }}")
}

fn corners(all: &[(f64, f64)]) -> String {
    let mut text = String::from("profile {\n");
    for (number, (x, z)) in all.iter().enumerate() {
        let word = if number == 0 { "start" } else { "line to" };
        let _ = writeln!(text, "  {word} ({x} mm, {z} mm)");
    }
    text + "}"
}

/// The robot that cuts the job of a number: a large one or a small one, with the work somewhere in front of it.
#[must_use]
pub fn robot(number: u64) -> String {
    const OF_KUKA: &str = "joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)";
    const OF_ABB: &str = "joints(0 deg, 0 deg, 0 deg, 0 deg, 45 deg, 0 deg)";
    const NEAR: [(f64, f64); 3] = [(550.0, 800.0), (-200.0, 50.0), (50.0, 350.0)];
    const FAR: [(f64, f64); 3] = [(1300.0, 2100.0), (-800.0, 200.0), (500.0, 1300.0)];
    // Other numbers than those of the job.
    let mut dice = Dice(!number);
    let (model, home, place) = match dice.next() % 3 {
        0 => ("kuka/kr10_r1100_2", OF_KUKA, NEAR),
        1 => ("kuka/kr210_r3100_ultra", OF_KUKA, FAR),
        _ => ("abb/irb6700_155_285", OF_ABB, FAR),
    };
    let [x, y, z] = place.map(|(low, high)| dice.whole(low, high));
    let turned = dice.one_of([90.0, 90.0, 90.0, 80.0, 100.0]);
    format!(
        "\nmachine cell = robot \"{model}\" {{\n  \
         tool       = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)\n  \
         base       = frame(x = {x} mm, y = {y} mm, z = {z} mm, a = {turned} deg, b = 0 deg, c = 0 deg)\n  \
         home       = {home}\n  \
         ultrasonic = output(12)\n  \
         ready      = after(0.8 s)\n}}\n"
    )
}

/// The job of a number with one of its choices made, for each of these choices: its name, and the job.
#[must_use]
pub fn fixed(number: u64) -> Vec<(&'static str, String)> {
    // Other numbers than those of the job and the robot.
    let mut dice = Dice(number.rotate_left(32));
    let text = text(number);
    let edge = stated(&text, "cutting_length = ").unwrap_or_default();
    let widest = stated(&text, "swing <= ").unwrap_or(60.0);
    let choices = [
        ("lattice = free", "lattice = free".to_owned()),
        ("lattice = interlaced", "lattice = interlaced".to_owned()),
        ("lattice = fitted", "lattice = fitted".to_owned()),
        (
            "swing",
            format!("swing = {} deg", dice.whole(0.4 * widest, widest)),
        ),
        (
            "layer",
            format!("layer = {:.1} mm", edge * dice.between(0.3, 0.95)),
        ),
        ("step", format!("step = {:.1} mm", edge * dice.between(0.3, 1.5))),
        (
            "residual",
            format!(
                "residual = {}",
                dice.one_of(["mixed", "discard", "lift", "shift"])
            ),
        ),
        ("objective = cuts", "objective = cuts".to_owned()),
    ];
    let with = |line: String| text.replace("rough vcut {\n", &format!("rough vcut {{\n  {line}\n"));
    choices
        .into_iter()
        .map(|(name, line)| (name, with(line)))
        .collect()
}

/// The number that follows a word of a job.
fn stated(text: &str, word: &str) -> Option<f64> {
    let (_, rest) = text.split_once(word)?;
    rest.split(' ').next()?.parse().ok()
}

/// The job of a number.
#[must_use]
pub fn text(number: u64) -> String {
    let mut dice = Dice(number);
    let (width, depth, height) = (
        dice.whole(60.0, 320.0),
        dice.whole(50.0, 500.0),
        dice.whole(35.0, 90.0),
    );
    let profile = profile(&mut dice, width, height);
    let edge = dice.whole(10.0, 40.0);
    let half_apex = dice.whole(50.0, 120.0) / 10.0;
    let thickness = dice.one_of([0.0, 0.0, 0.5, 1.0, 1.6]);
    let rake = dice.whole(50.0, 75.0);
    let cut = dice.whole(60.0, 300.0);
    let travel = (cut * dice.between(1.0, 2.0)).round();
    let reorient = dice.whole(25.0, 150.0);
    let allowance = dice.one_of([0.0, 0.0, 0.3, 0.5, 1.0]);
    let clearance = dice.whole(5.0, 20.0);
    // Programs that leave different amounts cannot be compared by their times.
    let scallop = thickness + dice.whole(15.0, 80.0) / 10.0;
    let mut limits = format!("scallop <= {scallop:.1} mm");
    if dice.is(0.6) {
        let _ = write!(limits, ", swing <= {} deg", dice.whole(30.0, 55.0));
    }
    format!(
        "job \"random_{number}\"\n\n\
         stock {{ size = ({width} mm, {depth} mm, {height} mm) }}\n\n\
         {profile}\n\n\
         blade dagger {{\n  cutting_length = {edge} mm\n  half_apex      = {half_apex} deg\n  \
         thickness      = {thickness} mm\n  edges          = double\n}}\n\n\
         rough vcut {{\n  blade     = dagger\n  rake      = {rake} deg\n  allowance = {allowance} mm\n  \
         limits    {{ {limits} }}\n  \
         feed      {{ cut = {cut} mm/s, travel = {travel} mm/s, reorient = {reorient} deg/s }}\n  \
         clearance = {clearance} mm\n}}\n"
    )
}
