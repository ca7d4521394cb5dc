//! How deep a disc may enter a surface on its way from one pose to the next.
//!
//! On the way the centre moves on a straight line, evenly, and the tool turns evenly by an angle phi, about one fixed axis. It may turn
//! about its own axis too, as its frame asks for: that moves no disc, but then its axis leaves the shortest way. Let f be how far a
//! point of the disc lies below the surface p, along z. It is bounded by what is known at both ends.
//!
//! 1. The way X(t) of a point at a distance Rb from the centre stays within `Rb phi^2/8` of its chord, and is no longer than
//!    `l = |dC| + Rb phi` in plan. Where p is continuous along the way, f is the integral of its slope along the chord, plus what
//!    the way deviates from it. A function whose derivatives differ by at most G over a length l rises above the greater of its
//!    values at both ends by at most `G l/4`. So with slopes g of p in a window as large as the way,
//!    `f <= max(f(0), f(1)) + (spread of g.dC + Rb phi * spread of g)/4 + (sqrt(1 + g^2) + 8/3 spread of g) Rb phi^2/8`.
//!    The last term bounds the integral of `g.(X' - V)` with V the chord's velocity: the mean slope moves through the deviation, and
//!    the rest through `|X' - V|`, whose integral is at most `|X''| t^2/3`.
//! 2. Slopes are those of the triangles in a bin and in the bins that a way from it may reach ([`slopes`]). Bins that lie well below
//!    the disc at both ends cannot matter, by the planes above them.
//! 3. Where a sheet begins or ends, where it is steep, and beyond the plan, f jumps. At such a place x the lower plane of the disc
//!    is `h(t) = Cz + m.(x - C)`, and changes nearly evenly: it stays above its chord less `max |h''|/8`, so that f there is bounded by
//!    that of both planes, extended as far as the disc comes ([`jumps`]). Between jumps rule 1 holds, with these in place of ends.
//!
//! Rounding of corners by a controller, and what a five-axis machine deviates from such a way, come on top, `sqrt(1 + g^2)` times.

mod jumps;
mod member;
mod slopes;

use crate::coverage::Tangled;
use crate::disc::{Disc, Pose};
use crate::drop::{Dropper, Part};
use crate::surface::Cell;
use jumps::Outline;
use member::{Member, Turn};
use slopes::{Box2, Slopes};
use vcutc_backend_api::units::{Angle, Length};

/// Stages that are clear by this, in mm, are not brought any nearer.
const CLEAR: f64 = 1.0;

/// A surface over which discs move.
#[derive(Clone, Debug)]
pub struct Moves<'d, 's> {
    dropper: &'d Dropper<'s>,
    slopes: Slopes,
    outline: Outline,
}

/// A disc in a pose, and how far each of its parts enters the surface there, along z.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    pose: Pose,
    /// Of the face, then of each stage, in mm; below 0 what it is clear by: of stages up to 1 mm. None of a face over nothing.
    depths: Vec<Option<f64>>,
}

impl Placed {
    /// The pose.
    #[must_use]
    pub const fn pose(&self) -> Pose {
        self.pose
    }

    /// How far the disc enters the surface, along z; below 0 what it is clear by. None of a disc without stages over nothing.
    #[must_use]
    pub fn depth(&self) -> Option<Length> {
        let deepest = self.depths.iter().copied().flatten().reduce(f64::max);
        deepest.map(Length::mm)
    }
}

/// The deepest that a disc may come on a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// At no time does it enter the surface by more, along z. Not below 0.
    pub depth: Length,
    /// The part of the disc that this is of.
    pub part: Part,
    /// The steepest slope below the face, and below stages that may come near, without what counts as steep: height for length.
    pub slope: f64,
}

impl<'d, 's> Moves<'d, 's> {
    /// Looks once at all triangles and edges.
    ///
    /// # Errors
    /// If triangles lie over each other in such numbers that this takes too long.
    pub fn new(dropper: &'d Dropper<'s>) -> Result<Self, Tangled> {
        Ok(Self {
            dropper,
            slopes: Slopes::new(dropper.surface())?,
            outline: Outline::new(),
        })
    }

    /// The surface that discs come down on.
    #[must_use]
    pub const fn dropper(&self) -> &'d Dropper<'s> {
        self.dropper
    }

    /// A disc in a pose. None if the pose is not finite.
    #[must_use]
    pub fn place(&self, disc: &Disc, pose: Pose) -> Option<Placed> {
        let centre = pose.centre;
        if !centre.is_finite() {
            return None;
        }
        let place = [centre.x, centre.y];
        let face = self.dropper.face(disc.radius(), place, pose.axis);
        let face = face.map(|rest| rest.height.to_mm() - centre.z);
        let floor = centre.z - CLEAR;
        let stages = disc.stages().iter().enumerate().map(|(index, stage)| {
            let rest = self.dropper.stage(*stage, index, place, pose.axis, floor);
            Some(rest.map_or(-CLEAR, |rest| rest.height.to_mm() - centre.z))
        });
        Some(Placed {
            pose,
            depths: core::iter::once(face).chain(stages).collect(),
        })
    }

    /// The deepest that a disc may come on its way between two poses, ends included, while it turns by an angle; by that between its
    /// axes if that is larger. A bound below `enough` is not made better.
    #[must_use]
    pub fn between(&self, disc: &Disc, [from, to]: [&Placed; 2], angle: Angle, enough: Length) -> Entry {
        let mut entry = Entry {
            depth: Length::ZERO,
            part: Part::Face,
            slope: 0.0,
        };
        let members = core::iter::once((Part::Face, Member::face(disc)));
        let stages = disc.stages().iter().enumerate();
        let members = members.chain(stages.map(|(index, stage)| (Part::Stage(index), Member::stage(stage))));
        for ((part, member), depths) in members.zip(from.depths.iter().zip(&to.depths)) {
            let turn = Turn::new(member, [from.pose, to.pose], angle);
            if part != Part::Face && self.is_far(&turn, [*depths.0, *depths.1]) {
                continue;
            }
            let (depth, slope) = self.deepest(&turn, [*depths.0, *depths.1], enough.to_mm());
            if depth > entry.depth.to_mm() {
                entry = Entry {
                    depth: Length::mm(depth),
                    part,
                    ..entry
                };
            }
            entry.slope = entry.slope.max(slope);
        }
        entry
    }

    /// Whether a part is so far from the surface at both ends that it cannot enter it, by all slopes of the surface and where it does
    /// not jump.
    fn is_far(&self, turn: &Turn, depths: [Option<f64>; 2]) -> bool {
        let nearest = depths.into_iter().flatten().reduce(f64::max);
        let sag = turn.sag(self.slopes.all());
        nearest.is_none_or(|nearest| nearest + sag <= 0.0)
            && self
                .dropper
                .surface()
                .bins()
                .cells(turn.bounds())
                .all(|cell| !self.slopes.jumps(cell))
    }

    /// The bound for a part of a disc, and the steepest slope below it.
    fn deepest(&self, turn: &Turn, depths: [Option<f64>; 2], enough: f64) -> (f64, f64) {
        let bins = self.dropper.surface().bins();
        let [first, last] = bins.touched(turn.bounds());
        let (columns, rows) = (last.column - first.column + 1, last.row - first.row + 1);
        let known: Vec<Known> = bins
            .cells(turn.bounds())
            .map(|cell| {
                let jump = self.jump(turn, cell);
                let at = |end: usize| self.at_end(turn, end, cell, depths[end]);
                let [start, end] = [at(0), at(1)];
                Known {
                    start: greater(start, jump),
                    end: greater(end, jump),
                    slopes: self.slopes.of(cell),
                }
            })
            .collect();
        let [across, along] = turn.window(bins.bounds(first));
        // The greatest within the window, along one axis after the other.
        let wide = slide(&known, [rows, columns], [columns, 1], across);
        let whole = slide(&wide, [columns, rows], [1, columns], along);
        let mut places = Places {
            known: vec![None; known.len()],
            first,
            columns,
            rows,
        };
        let mut deepest = depths.into_iter().flatten().fold(0.0, f64::max);
        let mut steepest = 0.0_f64;
        for (index, (here, window)) in known.iter().zip(&whole).enumerate() {
            let slopes = window.slopes.unwrap_or(Box2::LEVEL);
            steepest = steepest.max(slopes.steepest());
            let Some(start) = here.start else { continue };
            let mut bound = start.max(window.end.unwrap_or(start)) + turn.sag(slopes);
            if bound > enough && bound > deepest {
                let within = places.window(index, [across, along]);
                let place = within.filter_map(|(index, cell)| {
                    *places
                        .known
                        .get_mut(index)?
                        .get_or_insert_with(|| self.at_places(turn, cell, enough))
                });
                // Nothing lies there without a triangle.
                bound = place.reduce(f64::max).map_or(0.0, |place| place.min(bound));
            }
            deepest = deepest.max(bound);
        }
        (deepest, steepest)
    }

    /// How far at most a part of a disc enters triangles of a bin, at any time, by its plane at both ends.
    fn at_places(&self, turn: &Turn, cell: Cell, enough: f64) -> Option<f64> {
        let surface = self.dropper.surface();
        let bend = turn.bend();
        let depth = |&number: &u32| {
            let face = surface.triangle(number);
            let at_corners = face
                .iter()
                .map(|corner| turn.depth(*corner))
                .fold(f64::NEG_INFINITY, f64::max);
            if at_corners + bend <= enough {
                Some(at_corners)
            } else {
                self.outline.deepest(turn, face.to_vec())
            }
        };
        let numbers = surface.bins().triangles(cell).iter();
        Some(numbers.filter_map(depth).reduce(f64::max)? + bend)
    }

    /// How far at most a part of a disc enters what lies in a bin, at one end of its move.
    fn at_end(&self, turn: &Turn, end: usize, cell: Cell, depth: Option<f64>) -> Option<f64> {
        let depth = depth?;
        let bin = self.dropper.roofed(cell)?;
        let (middle, half) = (bin.middle, bin.half);
        if !turn.is_over(end, middle, half) {
            return None;
        }
        let (height, slope) = turn.plane(end, middle);
        let rise = [0, 1].map(|axis| half[axis] * (bin.slope[axis] - slope[axis]).abs());
        Some((bin.height - height + rise[0] + rise[1]).min(depth))
    }

    /// How far at most a part of a disc enters at places of a bin at which the surface jumps, at any time.
    fn jump(&self, turn: &Turn, cell: Cell) -> Option<f64> {
        let surface = self.dropper.surface();
        let steep = self
            .slopes
            .steep(cell)
            .iter()
            .map(|&number| surface.triangle(number).to_vec());
        let borders = self
            .slopes
            .borders(cell)
            .iter()
            .map(|&edge| self.slopes.edge(edge).to_vec());
        let pieces = steep.chain(borders);
        let deepest = pieces
            .filter_map(|piece| self.outline.deepest(turn, piece))
            .reduce(f64::max)?;
        Some(deepest + turn.bend())
    }
}

/// What is known of a bin.
#[derive(Clone, Copy, Debug)]
struct Known {
    start: Option<f64>,
    end: Option<f64>,
    slopes: Option<Box2>,
}

/// What is known of bins by their places, as far as it was asked for: none without a triangle under the disc.
struct Places {
    known: Vec<Option<Option<f64>>>,
    first: Cell,
    columns: usize,
    rows: usize,
}

impl Places {
    /// The bins in a window about one of them.
    fn window(
        &self,
        index: usize,
        [across, along]: [[usize; 2]; 2],
    ) -> impl Iterator<Item = (usize, Cell)> + use<> {
        let (columns, first) = (self.columns, self.first);
        let (column, row) = (index % columns, index / columns);
        let range = |at: usize, [back, forth]: [usize; 2], count: usize| {
            at.saturating_sub(back)..=at.saturating_add(forth).min(count - 1)
        };
        let across = range(column, across, columns);
        range(row, along, self.rows).flat_map(move |row| {
            across.clone().map(move |column| {
                let cell = Cell {
                    column: first.column + column,
                    row: first.row + row,
                };
                (row * columns + column, cell)
            })
        })
    }
}

fn greater(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.max(b)),
        (a, b) => a.or(b),
    }
}

/// Of all bins what is greatest in a window of bins about them, in lines of bins: so many lines of so many bins, the steps from line to
/// line and from bin to bin, and how far the window reaches to either side.
fn slide(
    known: &[Known],
    [lines, count]: [usize; 2],
    [line, step]: [usize; 2],
    reach: [usize; 2],
) -> Vec<Known> {
    let mut out = known.to_vec();
    for start in (0..lines).map(|number| number * line) {
        for place in 0..count {
            let window = place.saturating_sub(reach[0])..=place.saturating_add(reach[1]).min(count - 1);
            let within = window.filter_map(|other| known.get(start + other * step));
            if let Some(slot) = out.get_mut(start + place * step) {
                for other in within {
                    slot.end = greater(slot.end, other.end);
                    slot.slopes = Box2::both(slot.slopes, other.slopes);
                }
            }
        }
    }
    out
}

#[cfg(test)]
mod tests;
