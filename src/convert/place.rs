//! Where the blank lies in a milling program, and along which axis the program cuts.
//!
//! Programs do not say where their blank is. Three places are usual for their zero: a corner of the blank, the middle of it,
//! and either at the bottom or at the top. Where the passes leave one of them only, that one is taken and told; where they
//! leave several, the user is asked.

use super::Inference;
use super::asked::Asked;
use super::axes::{Axes, Axis, Direction, Sense};
use super::complaints;
use super::milling::Milling;
use super::raster::{Kind, SAME, Stretch, stretches};
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
    let way = |axis: Axis| -> f64 {
        stretches(milling, Axes::new(axis, up))
            .filter(|stretch| stretch.kind() == Kind::Along)
            .map(|stretch| (stretch.to[1] - stretch.from[1]).abs())
            .sum()
    };
    let (first, second) = (way(one), way(other));
    let (along, longer, shorter) = if first > second {
        (one, first, second)
    } else {
        (other, second, first)
    };
    if longer <= 0.0 {
        return Err(complaints::nothing_straight(milling));
    }
    if longer < shorter * CLEARLY {
        return Err(complaints::both_ways(milling, (one, first), (other, second)));
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
    let along: Vec<Stretch<'_>> = stretches(milling, axes)
        .filter(|stretch| stretch.kind() == Kind::Along)
        .collect();
    let (bottom, bottom_words) = bottom(milling, &along, height)?;
    let passes: Vec<Stretch<'_>> = along
        .into_iter()
        .filter(|stretch| stretch.lowest() < bottom + height - SAME)
        .collect();
    let xs = range(passes.iter().map(|pass| pass.to[0]));
    let ys = range(passes.iter().flat_map(|pass| [pass.from[1], pass.to[1]]));
    let (Some(xs), Some(ys)) = (xs, ys) else {
        return Err(complaints::no_passes(milling, bottom + height));
    };
    let side = side(milling, xs, (axes.across, width))?;
    let front = front(milling, ys, (axes.along, depth))?;
    blank.corner = [side.low, front.low, bottom];
    inferences.push(Inference::new(
        "blank",
        format!(
            "the file's zero lies {} in x, {} in y, {bottom_words}",
            side.words, front.words
        ),
        format!(
            "passes lie at x from {} to {} mm and run from y {} to {} mm of the job",
            show(xs[0] - side.low),
            show(xs[1] - side.low),
            show(ys[0] - front.low),
            show(ys[1] - front.low)
        ),
    ));
    Ok(blank)
}

fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |range, value| match range {
        None => Some([value; 2]),
        Some([low, high]) => Some([low.min(value), high.max(value)]),
    })
}

/// The height of the blank's bottom. What goes below zero cuts from a zero at the top, for nobody mills the table.
fn bottom(
    milling: &Milling,
    along: &[Stretch<'_>],
    height: f64,
) -> Result<(f64, &'static str), Box<Diagnostic>> {
    let Some([lowest, _]) = range(along.iter().map(Stretch::lowest)) else {
        return Err(complaints::nothing_straight(milling));
    };
    if lowest < -height - SAME {
        return Err(complaints::too_low(milling, lowest, height));
    }
    if lowest < -SAME {
        Ok((-height, "at its top in z"))
    } else if lowest < height - SAME {
        Ok((0.0, "at its bottom in z"))
    } else {
        Err(complaints::no_passes(milling, height))
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
fn side(milling: &Milling, [least, most]: [f64; 2], axis: (Direction, f64)) -> Result<End, Box<Diagnostic>> {
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
        (false, false) => Err(complaints::unclear_place(milling, axis, [least, most])),
    }
}

/// The front of the blank: passes run over all of it, and where the zero is not at an edge as far out on either side.
fn front(milling: &Milling, [least, most]: [f64; 2], axis: (Direction, f64)) -> Result<End, Box<Diagnostic>> {
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
        Err(complaints::too_short(milling, most - least, size))
    }
}
