//! Passes of a raster: stretches along y below the top of the blank, and all other motions beside them [Cui III.A].
//!
//! What runs along y, however many points the program divides it into, is a run (the module `runs`). Runs below the top of the
//! blank are passes, and those that follow one another in one place are one. Everything else has to be in the air or beside the
//! blank: what cuts across, obliquely, along a slope or on an arc is not a pass, and is refused. What goes
//! straight down into it is sorted by the passes around it (the module [`plunges`]).

use super::axes::Axes;
use super::complaints;
use super::milling::{Milling, Way, Written};
use super::plunges;
use super::runs::{Course, Kind, Run, Stretch, courses};
use super::types::{Blank, Plunge, Start};
use super::types::{Pass, SAME};
use vcutc_backend_api::units::Angle;
use vcutc_diagnostics::Diagnostic;
use vcutc_geometry::grid;

/// What a milling program does to a blank.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Raster {
    /// The passes in the order of the program.
    pub passes: Vec<Pass>,
    /// Passes beside the blank, which cut nothing.
    pub beside: Vec<Pass>,
    /// What is as long as a pass and as slow, and lies above the blank.
    pub above: Vec<Pass>,
    /// Motions straight down into material that a pass cuts later.
    pub plunges: Vec<Plunge>,
    /// How many passes follow another one in the same place.
    pub repeated: usize,
    /// Of how many motions the passes are made.
    pub pieces: usize,
    /// How far points of passes lie from them, at most, in mm.
    pub stray: f64,
    /// How many motions are not passes.
    pub other_moves: usize,
    /// How many of them are arcs.
    pub arcs: usize,
    /// The highest place that the tool goes to.
    pub highest: Option<f64>,
    /// Speeds on straight lines that are not passes.
    pub travel: Vec<Written>,
    /// The path of the tool, broken where the tool's place is not known.
    pub path: Vec<Vec<[f64; 3]>>,
}

/// The passes of a program over a blank whose place is known, of which points lie so close to one line, for V-cuts of that
/// swing.
///
/// # Errors
/// Motions in the material that are not passes, reported one by one.
pub(super) fn recognise(
    milling: &Milling,
    axes: Axes,
    blank: Blank,
    (tolerance, swing): (f64, Angle),
) -> Result<Raster, Vec<Diagnostic>> {
    let mut builder = Builder {
        blank,
        tolerance,
        raster: Raster::default(),
        plunges: Vec::new(),
        complaints: Vec::new(),
    };
    builder.raster.path = path(milling, axes, blank);
    let all = builder.raster.path.iter().flatten();
    builder.raster.highest = all.map(|point| point[2]).reduce(f64::max);
    courses(milling, axes, tolerance, &mut |course| match course {
        Course::Run(run) => builder.run(&run),
        Course::Other(stretch) => builder.other(stretch.seen_from(&blank)),
    });
    builder.sort_plunges(1.0 / swing.tan());
    if builder.complaints.is_empty() {
        builder.raster.keep_slow();
        Ok(builder.raster)
    } else {
        Err(builder.complaints)
    }
}

/// Points that stand for an arc in a picture.
const POINTS_OF_ARC: u32 = 16;

fn path(milling: &Milling, axes: Axes, blank: Blank) -> Vec<Vec<[f64; 3]>> {
    let seen = |place: [f64; 3]| blank.seen_from_corner(axes.point(place));
    milling
        .moves
        .split(|step| step.to.is_none())
        .map(|known| {
            let mut points: Vec<[f64; 3]> = Vec::with_capacity(known.len());
            for step in known {
                let Some(to) = step.to else { continue };
                match step.way {
                    Way::Arc { course: Some(arc) } => {
                        let arc = arc.seen(|direction| axes.point(direction), seen);
                        points.extend(arc.points(POINTS_OF_ARC));
                    }
                    Way::Arc { course: None } | Way::Straight | Way::Joint => points.push(seen(to)),
                }
            }
            points
        })
        .filter(|points| !points.is_empty())
        .collect()
}

impl Raster {
    /// Leaves out of what lies above the blank the ways back of a raster that always cuts the same way: what is faster than the
    /// passes, or as high as the program goes.
    fn keep_slow(&mut self) {
        let fastest = self
            .passes
            .iter()
            .filter_map(|pass| pass.speed)
            .map(|speed| speed.value)
            .reduce(f64::max);
        let highest = self.highest.unwrap_or(f64::INFINITY) - SAME;
        self.above.retain(|run| {
            let is_fast = match (run.speed, fastest) {
                (Some(speed), Some(fastest)) => speed.value > fastest,
                (None, _) | (_, None) => false,
            };
            !is_fast && run.z < highest
        });
    }

    fn note_travel(&mut self, way: Way, speed: Option<Written>) {
        if let (Way::Straight, Some(speed)) = (way, speed) {
            let is_new = self.travel.iter().all(|known| known.value != speed.value);
            if is_new && self.travel.len() < MOST_SPEEDS {
                self.travel.push(speed);
            }
        }
    }
}

/// Most motions that are reported as not being passes.
const MOST_COMPLAINTS: usize = 5;

struct Builder {
    blank: Blank,
    tolerance: f64,
    raster: Raster,
    /// Motions that end in the blank or begin there, and run along no axis but z.
    plunges: Vec<Plunge>,
    complaints: Vec<Diagnostic>,
}

impl Builder {
    fn run(&mut self, run: &Run) {
        let pass = self.pass(run);
        let is_over = (0.0..=self.blank.width).contains(&pass.x);
        if pass.z >= self.blank.height - SAME {
            self.raster.other_moves += run.pieces;
            self.raster.note_travel(run.way, run.speed);
            let is_long = pass.y[0] <= SAME && pass.y[1] >= self.blank.depth - SAME;
            if is_over && is_long && run.way == Way::Straight {
                self.raster.above.push(pass);
            }
            return;
        }
        let raster = &mut self.raster;
        let is_before_or_behind = pass.y[1] <= SAME || pass.y[0] >= self.blank.depth - SAME;
        if is_before_or_behind {
            raster.other_moves += run.pieces;
            raster.note_travel(run.way, run.speed);
            return;
        }
        raster.pieces += run.pieces;
        raster.stray = raster.stray.max(run.stray());
        if !is_over {
            raster.beside.push(pass);
            return;
        }
        let tolerance = self.tolerance;
        let is_again =
            |last: &Pass| (last.x - pass.x).abs() <= tolerance && (last.z - pass.z).abs() <= tolerance;
        if raster.passes.last().is_some_and(is_again) {
            raster.repeated += 1;
        } else {
            raster.passes.push(pass);
        }
    }

    /// A run as seen from the blank's corner.
    fn pass(&self, run: &Run) -> Pass {
        let (x, y, z) = run.line();
        let [low, high] = y.map(|y| self.blank.seen_from_corner([x, y, z]));
        let z = grid::nearest(low[2]);
        Pass {
            x: grid::nearest(low[0]),
            // A hair below the bottom is the bottom.
            z: if (-SAME..0.0).contains(&z) { 0.0 } else { z },
            y: [low[1], high[1]],
            places: run.places,
            speed: run.speed,
            second_speed: run.second_speed,
            way: run.way,
        }
    }

    fn other(&mut self, stretch: Stretch<'_>) {
        self.raster.other_moves += 1;
        self.raster.note_travel(stretch.said.way, stretch.said.speed);
        let meets = match stretch.kind {
            Kind::Still | Kind::Along => false,
            Kind::Upright => return self.plunge(&stretch, Start::Above),
            Kind::Landing => return self.plunge(&stretch, Start::Unknown),
            Kind::Across | Kind::Oblique => self.meets_the_blank(&stretch),
            Kind::Curve => self.curve_meets_the_blank(&stretch),
        };
        if meets {
            self.complain(|| complaints::no_pass(&stretch));
        }
    }

    fn complain(&mut self, words: impl FnOnce() -> Diagnostic) {
        if self.complaints.len() < MOST_COMPLAINTS {
            self.complaints.push(words());
        }
    }

    fn plunge(&mut self, stretch: &Stretch<'_>, start: Start) {
        if !self.meets_the_blank(stretch) {
            return;
        }
        let is_down = stretch.to[2] <= stretch.from[2];
        let plunge = Plunge {
            place: stretch.said.place,
            start,
            low: if is_down { stretch.to } else { stretch.from },
            before: self.raster.passes.len(),
        };
        if !self.plunges.last().is_some_and(|last| plunge.follows(last)) {
            self.plunges.push(plunge);
        }
    }

    fn sort_plunges(&mut self, slope: f64) {
        let plunges = core::mem::take(&mut self.plunges);
        let sorted = plunges::sorted(&plunges, &self.raster.passes, self.blank, slope);
        self.raster.plunges = sorted.cut_later;
        for plunge in &sorted.alone {
            self.complain(|| complaints::plunge(plunge));
        }
    }

    /// Whether an arc comes near the blank. It does where it is not known which way it takes.
    fn curve_meets_the_blank(&mut self, stretch: &Stretch<'_>) -> bool {
        self.raster.arcs += 1;
        let Some(arc) = stretch.course else {
            return true;
        };
        let [low, high] = arc.room();
        self.raster.highest = self.raster.highest.map(|highest| highest.max(high[2]));
        let sizes = [self.blank.width, self.blank.depth, self.blank.height];
        low.into_iter()
            .zip(high)
            .zip(sizes)
            .all(|((low, high), size)| high > SAME && low < size - SAME)
    }

    /// Whether a motion leads through the blank, its faces left out.
    fn meets_the_blank(&self, stretch: &Stretch<'_>) -> bool {
        let sizes = [self.blank.width, self.blank.depth, self.blank.height];
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for ((from, to), size) in stretch.from.into_iter().zip(stretch.to).zip(sizes) {
            let (low, high) = (SAME, size - SAME);
            let run = to - from;
            if run.abs() < 1e-9 {
                if from <= low || from >= high {
                    return false;
                }
            } else {
                let (first, second) = ((low - from) / run, (high - from) / run);
                enters = enters.max(first.min(second));
                leaves = leaves.min(first.max(second));
            }
        }
        enters < leaves
    }
}

/// Most different speeds between passes that are remembered.
const MOST_SPEEDS: usize = 64;
