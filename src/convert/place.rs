//! Where the blank lies in a milling program, and along which axis the program cuts.
//!
//! Programs do not say where their blank is. Three places are usual for their zero: a corner of the blank, the middle of it,
//! and either at the bottom or at the top. Where the passes leave one of them only, that one is taken and reported; where they
//! leave several, the user is asked, with the option for each of them.

use super::Inference;
use super::asked::Asked;
use super::axes::{Axes, Axis, Direction, Sense};
use super::complaints;
use super::milling::{Milling, Way};
use super::offers::{Choice, Offer, Unsettled};
use super::runs::{Run, runs};
use super::types::Blank;
use super::types::SAME;

use vcutc_diagnostics::number::show;

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
) -> Result<Axes, Unsettled> {
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
        return Err(Unsettled::from(complaints::nothing_straight(milling)).offering(other_ways_up(asked)));
    }
    if longer < shorter * CLEARLY {
        let complaint = complaints::both_ways(
            milling,
            (one, first, longest(&ones)),
            (other, second, longest(&others)),
        );
        return Err(Unsettled::from(complaint).offering([one, other].map(runs_along)));
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

fn runs_along(axis: Axis) -> Offer {
    Offer {
        when: format!("if its passes run along {}", axis.letter()),
        option: Choice::Along(axis),
    }
}

/// Directions that may point up instead.
pub(super) fn other_ways_up(asked: &Asked) -> Vec<Offer> {
    let senses = [Sense::Positive, Sense::Negative];
    let all = Axis::ALL
        .into_iter()
        .flat_map(|axis| senses.map(|sense| Direction { axis, sense }));
    all.filter(|&up| up != asked.up && asked.along != Some(up.axis))
        .map(|up| Offer {
            when: "if another axis points up".to_owned(),
            option: Choice::Up(up),
        })
        .collect()
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
) -> Result<Blank, Unsettled> {
    if let Some(origin) = asked.origin {
        return Ok(blank_at(origin, axes, asked.stock));
    }
    let along = runs(milling, axes, asked.tolerance.to_mm());
    let field = Field {
        axes,
        sizes: asked.stock,
        along: &along,
    };
    let [width, depth, height] = field.sizes;
    let levels = Levels::of(milling, axes, &along, depth);
    let bottom = bottom(milling, &levels, &field)?;
    let passes = field.passes(bottom.low);
    let (Some(xs), Some(ys)) = (sideways(&passes), lengthways(&passes)) else {
        return Err(complaints::no_passes(milling, lowest(&along), bottom.low + height).into());
    };
    let front = match front(ys, (axes.along, depth)) {
        Some(front) => front,
        None => return Err(too_short(milling, &passes, ys, asked)),
    };
    let side = match sides(xs, (axes.across, width)).as_slice() {
        [side] => *side,
        _ => return Err(field.unclear_side(milling, &passes, xs, [front.low, bottom.low])),
    };
    inferences.push(placed((side, xs), (front, ys), &bottom));
    Ok(Blank {
        width,
        depth,
        height,
        corner: [side.low, front.low, bottom.low],
    })
}

/// The blank with its lowest corner at a place of the file.
fn blank_at(origin: [f64; 3], axes: Axes, [width, depth, height]: [f64; 3]) -> Blank {
    let low = |direction: Direction, size: f64| match direction.sense {
        Sense::Positive => direction.of(origin),
        Sense::Negative => direction.of(origin) - size,
    };
    Blank {
        width,
        depth,
        height,
        corner: [
            low(axes.across, width),
            low(axes.along, depth),
            low(axes.up, height),
        ],
    }
}

/// The place in the file of the lowest corner of a blank that begins there in the axes of a job.
fn origin_of(low: [f64; 3], axes: Axes, sizes: [f64; 3]) -> [f64; 3] {
    let mut origin = [0.0; 3];
    for ((direction, low), size) in [axes.across, axes.along, axes.up].into_iter().zip(low).zip(sizes) {
        let value = match direction.sense {
            Sense::Positive => low,
            Sense::Negative => -(low + size),
        };
        for (slot, axis) in origin.iter_mut().zip(Axis::ALL) {
            if axis == direction.axis {
                *slot = value;
            }
        }
    }
    origin
}

/// The same blank, so much lower.
pub(super) fn lower(axes: Axes, blank: Blank, by: f64, asked: &Asked) -> Option<Offer> {
    let [x, y, z] = blank.corner;
    Some(Offer {
        when: "if the blank lies lower, with its bottom at the lowest pass".to_owned(),
        option: Choice::Origin(origin_of([x, y, z - by], axes, asked.stock)),
    })
}

/// Other heights of a blank whose place was inferred.
pub(super) fn other_heights(milling: &Milling, axes: Axes, blank: Blank, asked: &Asked) -> Vec<Offer> {
    let along = runs(milling, axes, asked.tolerance.to_mm());
    let field = Field {
        axes,
        sizes: asked.stock,
        along: &along,
    };
    let others = field.usual_heights().into_iter();
    let others: Vec<Height> = others
        .filter(|height| (height.low - blank.corner[2]).abs() > SAME)
        .collect();
    field.offers(&others)
}

/// What is known before the blank is placed.
#[derive(Clone, Copy)]
struct Field<'r> {
    axes: Axes,
    sizes: [f64; 3],
    /// All that runs along the cuts.
    along: &'r [Run],
}

/// A height for the bottom of the blank, and when it is right.
struct Height {
    low: f64,
    when: &'static str,
}

impl Field<'_> {
    /// What lies below the top of a blank that begins at a height.
    fn passes(&self, low: f64) -> Vec<Run> {
        let top = low + self.sizes[2] - SAME;
        let below = self.along.iter().filter(|run| run.height() < top);
        below.copied().collect()
    }

    /// With the file's zero at the bottom of the blank, in the middle and at the top.
    fn usual_heights(&self) -> [Height; 3] {
        let height = self.sizes[2];
        [
            (-height, "if the file's zero lies at the blank's top"),
            (
                -height / 2.0,
                "if the file's zero lies at half the blank's height",
            ),
            (0.0, "if the file's zero lies at the blank's bottom"),
        ]
        .map(|(low, when)| Height { low, when })
    }

    /// Places for the blank with its bottom at these heights, wherever it may lie across.
    fn offers(&self, heights: &[Height]) -> Vec<Offer> {
        let [width, depth, _] = self.sizes;
        let mut offers = Vec::new();
        for Height { low, when } in heights {
            let passes = self.passes(*low);
            let (Some(xs), Some(ys)) = (sideways(&passes), lengthways(&passes)) else {
                continue;
            };
            let Some(front) = front(ys, (self.axes.along, depth)) else {
                continue;
            };
            let sides = sides(xs, (self.axes.across, width));
            let is_one = sides.len() == 1;
            offers.extend(sides.into_iter().map(|side| Offer {
                when: if is_one {
                    (*when).to_owned()
                } else {
                    format!("{when}, and {} in {}", side.words, self.axes.across.axis.letter())
                },
                option: self.origin([side.low, front.low, *low]),
            }));
        }
        offers
    }

    fn origin(&self, low: [f64; 3]) -> Choice {
        Choice::Origin(origin_of(low, self.axes, self.sizes))
    }

    /// Passes that lie over a blank at several places, or at none.
    fn unclear_side(
        &self,
        milling: &Milling,
        passes: &[Run],
        xs: [f64; 2],
        [front, bottom]: [f64; 2],
    ) -> Unsettled {
        let axis = (self.axes.across, self.sizes[0]);
        let ends = [most(passes, |run| -run.across()), most(passes, Run::across)];
        let offer = |when: String, end: End| Offer {
            when,
            option: self.origin([end.low, front, bottom]),
        };
        let letter = self.axes.across.axis.letter();
        let sides = sides(xs, axis);
        if sides.is_empty() {
            let when = format!("if the passes lie in the middle of the blank in {letter}");
            let complaint = complaints::unclear_place(milling, axis, xs, ends);
            return Unsettled::from(complaint).offering([offer(when, centred(xs, axis.1))]);
        }
        let offers = sides.into_iter().map(|end| {
            let when = format!("if the file's zero lies {} in {letter}", end.words);
            offer(when, end)
        });
        Unsettled::from(complaints::two_places(milling, axis, xs, ends)).offering(offers)
    }
}

/// Passes that are shorter than the blank is deep.
fn too_short(milling: &Milling, passes: &[Run], [least, most]: [f64; 2], asked: &Asked) -> Unsettled {
    let [width, depth, height] = asked.stock;
    let complaint = complaints::too_short(milling, longest(passes), most - least, depth);
    Unsettled::from(complaint).offering([Offer {
        when: "if width and depth are the other way round".to_owned(),
        option: Choice::Stock([depth, width, height]),
    }])
}

/// The message about a place that was found.
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

    /// Whether what lies above zero are ways back in the air, all at one height: as high as the program goes,
    /// or one after every pass and not slower than that. Passes of another layer would come layer by layer.
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
fn bottom(milling: &Milling, levels: &Levels, field: &Field<'_>) -> Result<Bottom, Unsettled> {
    let [width, depth, height] = field.sizes;
    if let Some(deepest) = lowest(&levels.below) {
        if deepest.height() < -height - SAME {
            let offers = field.offers(&[Height {
                low: deepest.height(),
                when: "if the blank's bottom is at the lowest pass",
            }]);
            let taller = Offer {
                when: "if the blank is that tall".to_owned(),
                option: Choice::Stock([width, depth, libm::ceil(-deepest.height())]),
            };
            return Err(Unsettled::from(complaints::too_low(deepest, height))
                .offering(offers)
                .offering([taller]));
        }
        let returns = levels.returns();
        return match (returns, lowest(&levels.above)) {
            (None, Some(above)) => Err(Unsettled::from(complaints::both_sides(
                [deepest, above],
                [levels.below.len(), levels.above.len()],
            ))
            .offering(field.offers(&field.usual_heights()))),
            (Some(_), _) | (None, None) => Ok(Bottom {
                low: -height,
                words: "at its top in z",
                returns,
            }),
        };
    }
    let Some(deepest) = lowest(&levels.above) else {
        return Err(complaints::nothing_straight(milling).into());
    };
    if deepest.height() < height - SAME {
        Ok(Bottom {
            low: 0.0,
            words: "at its bottom in z",
            returns: None,
        })
    } else {
        Err(complaints::no_passes(milling, Some(deepest), height).into())
    }
}

/// One end of the blank, and where the file's zero is on that axis.
#[derive(Clone, Copy)]
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

/// Whether a blank that begins at an end lies within a range.
fn covers([least, most]: [f64; 2], end: &End, size: f64) -> bool {
    least <= end.low + SAME && most >= end.low + size - SAME
}

/// The sides that the blank may have: those from which on all passes lie over it. Where passes lie farther out on both sides,
/// they are taken to run beside it.
fn sides(xs: [f64; 2], axis: (Direction, f64)) -> Vec<End> {
    let ([least, most], size) = (xs, axis.1);
    let holds = |end: &End| least >= end.low - SAME && most <= end.low + size + SAME;
    let fits = |end: &End| holds(end) || covers(xs, end, size);
    ends(axis).into_iter().filter(fits).collect()
}

/// The blank with passes as far from one side of it as from the other.
fn centred([least, most]: [f64; 2], size: f64) -> End {
    End {
        low: f64::midpoint(least, most) - size / 2.0,
        words: "so that passes run out as far on either side",
    }
}

/// The front of the blank: passes run over all of it, and where the zero is not at an edge as far out on either side. None where
/// they are too short.
fn front(ys: [f64; 2], axis: (Direction, f64)) -> Option<End> {
    let size = axis.1;
    let at_zero = ends(axis).into_iter().find(|end| covers(ys, end, size));
    let is_long = ys[1] - ys[0] >= size - SAME;
    at_zero.or_else(|| is_long.then(|| centred(ys, size)))
}
