//! Where the blank lies in a milling program, and along which axis the program cuts.
//!
//! Programs do not say where their blank is. Three places are usual for their zero: a corner of the blank, the middle of it,
//! and either at the bottom or at the top. Where the passes leave one of them only, that one is taken and told; where they
//! leave several, the user is asked.

use super::Inference;
use super::asked::Asked;
use super::axes::{Axes, Axis, Direction, Sense};
use super::complaints;
use super::milling::{Milling, Way};
use super::raster::SAME;
use super::runs::{Run, runs};
use crate::diag::Diagnostic;
use crate::plan::parameters::show;

/// A blank in the axes of a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blank {
    /// Across the cuts, in mm.
    pub width: f64,
    /// Along them.
    pub depth: f64,
    /// Up.
    pub height: f64,
    /// Its lowest corner, in the axes of the job, seen from the program's origin.
    pub corner: [f64; 3],
}

impl Blank {
    /// A point as seen from the corner.
    pub(super) fn seen_from_corner(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [x0, y0, z0] = self.corner;
        [x - x0, y - y0, z - z0]
    }
}

/// How much longer the way along one axis must be than along the other for it to be the axis of the cuts.
const CLEARLY: f64 = 2.0;

/// The axis that the program cuts along.
///
/// # Errors
/// Where it goes about as far along both.
pub(super) fn axes(
    milling: &Milling,
    asked: &Asked,
    inferences: &mut Vec<Inference>,
) -> Result<Axes, Box<Diagnostic>> {
    let up = asked.up;
    let level: Vec<Axis> = Axis::ALL.into_iter().filter(|&axis| axis != up.axis).collect();
    let (one, other) = match level.as_slice() {
        [one, other] => (*one, *other),
        _ => (Axis::X, Axis::Y),
    };
    if let Some(along) = asked.along {
        return Ok(Axes::new(along, up));
    }
    let [ones, others] = [one, other].map(|axis| runs(milling, Axes::new(axis, up), asked.tolerance.to_mm()));
    let way = |runs: &[Run]| -> f64 { runs.iter().map(|run| run.travelled).sum() };
    let (first, second) = (way(&ones), way(&others));
    let (along, longer, shorter) = if first > second {
        (one, first, second)
    } else {
        (other, second, first)
    };
    if longer <= 0.0 {
        return Err(complaints::nothing_straight(milling));
    }
    if longer < shorter * CLEARLY {
        return Err(complaints::both_ways(
            milling,
            (one, first, longest(&ones)),
            (other, second, longest(&others)),
        ));
    }
    let axes = Axes::new(along, up);
    if along != Axis::Y || up != Direction::along(Axis::Z) {
        inferences.push(Inference::new(
            "axes",
            format!(
                "the job's x, y, z are the file's {}, {}, {}",
                axes.across.words(),
                axes.along.words(),
                axes.up.words()
            ),
            format!("its passes run along {}", along.letter()),
        ));
    }
    Ok(axes)
}

/// Where the blank lies.
///
/// # Errors
/// Where the passes do not say.
pub(super) fn blank(
    milling: &Milling,
    axes: Axes,
    asked: &Asked,
    inferences: &mut Vec<Inference>,
) -> Result<Blank, Box<Diagnostic>> {
    let [width, depth, height] = asked.stock;
    let mut blank = Blank {
        width,
        depth,
        height,
        corner: [0.0; 3],
    };
    if let Some(origin) = asked.origin {
        let low = |direction: Direction, size: f64| match direction.sense {
            Sense::Positive => direction.of(origin),
            Sense::Negative => direction.of(origin) - size,
        };
        blank.corner = [
            low(axes.across, width),
            low(axes.along, depth),
            low(axes.up, height),
        ];
        return Ok(blank);
    }
    let along = runs(milling, axes, asked.tolerance.to_mm());
    let levels = Levels::of(milling, axes, &along, depth);
    let bottom = bottom(milling, &levels, height)?;
    let passes: Vec<Run> = along
        .iter()
        .copied()
        .filter(|run| run.height() < bottom.low + height - SAME)
        .collect();
    let (side, front) = match (sideways(&passes), lengthways(&passes)) {
        (Some(xs), Some(ys)) => (
            (side(milling, &passes, xs, (axes.across, width))?, xs),
            (front(milling, &passes, ys, (axes.along, depth))?, ys),
        ),
        _ => {
            return Err(complaints::no_passes(
                milling,
                lowest(&along),
                bottom.low + height,
            ));
        }
    };
    blank.corner = [side.0.low, front.0.low, bottom.low];
    inferences.push(placed(side, front, &bottom));
    Ok(blank)
}

/// What is told of a place that was found.
fn placed((side, xs): (End, [f64; 2]), (front, ys): (End, [f64; 2]), bottom: &Bottom) -> Inference {
    let returns = match bottom.returns {
        None => String::new(),
        Some(height) => format!(
            "; what runs along them at z {} mm are ways back in the air",
            show(height)
        ),
    };
    Inference::new(
        "blank",
        format!(
            "the file's zero lies {} in x, {} in y, {}",
            side.words, front.words, bottom.words
        ),
        format!(
            "passes lie at x from {} to {} mm and run from y {} to {} mm of the job{returns}",
            show(xs[0] - side.low),
            show(xs[1] - side.low),
            show(ys[0] - front.low),
            show(ys[1] - front.low)
        ),
    )
}

/// From where to where runs lie across.
fn sideways(runs: &[Run]) -> Option<[f64; 2]> {
    range(runs.iter().map(Run::across))
}

/// From where to where they lead.
fn lengthways(runs: &[Run]) -> Option<[f64; 2]> {
    range(runs.iter().flat_map(|run| run.y))
}

/// The run that is farthest by a measure.
fn most(runs: &[Run], measure: impl Fn(&Run) -> f64) -> Option<&Run> {
    runs.iter()
        .max_by(|one, other| measure(one).total_cmp(&measure(other)))
}

fn longest(runs: &[Run]) -> Option<&Run> {
    most(runs, Run::length)
}

fn lowest(runs: &[Run]) -> Option<&Run> {
    most(runs, |run| -run.height())
}

fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |range, value| match range {
        None => Some([value; 2]),
        Some([low, high]) => Some([low.min(value), high.max(value)]),
    })
}

/// Runs as long as the blank, by their heights; all runs where none is so long.
struct Levels {
    /// Those below the file's zero.
    below: Vec<Run>,
    /// Those above it, and at it.
    above: Vec<Run>,
    /// How often the program goes from one kind to the other.
    changes: usize,
    /// The highest place that the program goes to.
    highest: f64,
}

impl Levels {
    fn of(milling: &Milling, axes: Axes, along: &[Run], depth: f64) -> Self {
        let is_long = |run: &&Run| run.length() >= depth - SAME;
        let any_long = along.iter().any(|run| is_long(&run));
        let counted = along.iter().copied().filter(|run| !any_long || is_long(&run));
        let (below, above): (Vec<Run>, Vec<Run>) = counted.clone().partition(|run| run.height() < -SAME);
        let sides: Vec<bool> = counted.map(|run| run.height() < -SAME).collect();
        let places = milling.moves.iter().filter_map(|step| step.to);
        Self {
            below,
            above,
            changes: sides
                .windows(2)
                .filter(|pair| pair.first() != pair.last())
                .count(),
            highest: places
                .map(|to| axes.point(to)[2])
                .fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// Whether what lies above zero are ways back in the air, all at one height: as high as the program goes, or one behind
    /// every pass and not slower than that. Passes of another layer would come layer by layer.
    fn returns(&self) -> Option<f64> {
        let [low, high] = range(self.above.iter().map(Run::height))?;
        let speeds = |runs: &[Run]| range(runs.iter().filter_map(|run| run.speed).map(|speed| speed.value));
        let is_level = high - low <= SAME;
        let is_highest = low >= self.highest - SAME;
        let takes_turns = self.changes + 1 >= self.above.len() + self.below.len();
        let is_slower = match (speeds(&self.above), speeds(&self.below)) {
            (Some([slowest, _]), Some([_, fastest])) => slowest < fastest,
            (None, _) | (_, None) => false,
        };
        let in_air = self.above.iter().all(|run| run.way == Way::Joint);
        (is_level && (is_highest || takes_turns && !is_slower) || in_air).then_some(high)
    }
}

/// The bottom of the blank, and where the file's zero is.
struct Bottom {
    low: f64,
    words: &'static str,
    /// The height of ways back above a zero at the top.
    returns: Option<f64>,
}

/// The height of the blank's bottom. Passes on one side of zero leave one place for it; on both sides they may be those of a
/// program that cuts through a blank from the bottom up, or ways back in the air.
fn bottom(milling: &Milling, levels: &Levels, height: f64) -> Result<Bottom, Box<Diagnostic>> {
    if let Some(deepest) = lowest(&levels.below) {
        if deepest.height() < -height - SAME {
            return Err(complaints::too_low(deepest, height));
        }
        let returns = levels.returns();
        return match (returns, lowest(&levels.above)) {
            (None, Some(above)) => Err(complaints::both_sides(
                [deepest, above],
                [levels.below.len(), levels.above.len()],
                height,
            )),
            (Some(_), _) | (None, None) => Ok(Bottom {
                low: -height,
                words: "at its top in z",
                returns,
            }),
        };
    }
    let Some(deepest) = lowest(&levels.above) else {
        return Err(complaints::nothing_straight(milling));
    };
    if deepest.height() < height - SAME {
        Ok(Bottom {
            low: 0.0,
            words: "at its bottom in z",
            returns: None,
        })
    } else {
        Err(complaints::no_passes(milling, Some(deepest), height))
    }
}

/// One end of the blank, and where the file's zero is on that axis.
struct End {
    low: f64,
    words: &'static str,
}

/// A blank with its zero at a corner, and one with its zero in the middle.
fn ends((direction, size): (Direction, f64)) -> [End; 2] {
    let corner = match direction.sense {
        Sense::Positive => 0.0,
        Sense::Negative => -size,
    };
    [
        End {
            low: corner,
            words: "at an edge",
        },
        End {
            low: -size / 2.0,
            words: "in the middle",
        },
    ]
}

/// The side of the blank: from an edge where all passes lie over the blank then, else from the middle; passes that lie farther
/// out on both sides are taken to run beside it.
fn side(
    milling: &Milling,
    passes: &[Run],
    [least, most]: [f64; 2],
    axis: (Direction, f64),
) -> Result<End, Box<Diagnostic>> {
    let size = axis.1;
    let holds = |end: &End| least >= end.low - SAME && most <= end.low + size + SAME;
    let covers = |end: &End| least <= end.low + SAME && most >= end.low + size - SAME;
    let [corner, middle] = ends(axis);
    match (
        holds(&corner) || covers(&corner),
        holds(&middle) || covers(&middle),
    ) {
        (true, _) => Ok(corner),
        (false, true) => Ok(middle),
        (false, false) => {
            let ends = [
                self::most(passes, |run| -run.across()),
                self::most(passes, Run::across),
            ];
            Err(complaints::unclear_place(milling, axis, [least, most], ends))
        }
    }
}

/// The front of the blank: passes run over all of it, and where the zero is not at an edge as far out on either side.
fn front(
    milling: &Milling,
    passes: &[Run],
    [least, most]: [f64; 2],
    axis: (Direction, f64),
) -> Result<End, Box<Diagnostic>> {
    let size = axis.1;
    let covers = |end: &End| least <= end.low + SAME && most >= end.low + size - SAME;
    let [corner, middle] = ends(axis);
    if covers(&corner) {
        Ok(corner)
    } else if covers(&middle) {
        Ok(middle)
    } else if most - least >= size - SAME {
        Ok(End {
            low: f64::midpoint(least, most) - size / 2.0,
            words: "so that passes run out as far on either side",
        })
    } else {
        Err(complaints::too_short(
            milling,
            longest(passes),
            most - least,
            size,
        ))
    }
}
