//! The best shape near one: Newton's method on the conditions that hold there.
//!
//! What is made least is the greatest of a few smooth functions (the terms), under bounds that are smooth functions too. At
//! the best shape some of them meet, and each has a multiplier that is not negative (Karush, Kuhn and Tucker). The set of
//! those that meet is guessed on the way: one is taken up where a step runs into it, and let go where its multiplier
//! turns negative (Nocedal and Wright: Numerical Optimization, 2006, chapter 16). With two coordinates at most two meet with the
//! first. Nothing here needs to be certain: what is found is tried as any other shape, and proven or not in `certain`.

use super::ground::{Ground, KEPT, Term};
use vcutc_geometry::number::OnPlane;

const MOST_STEPS: u32 = 40;

/// A step this short, as a share of the place, is the last.
const SHORT: f64 = 1e-9;

/// No step is longer than this share of the place.
const LONG: f64 = 0.4;

/// What holds at the best shape beside its first term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meets {
    /// Another term is as great.
    Term(Term),
    /// A bound is touched.
    Bound(Term),
    /// A coordinate (by number) is at the low end of its range.
    Low(usize),
    /// A coordinate is at the high end of its range.
    High(usize),
}

/// Where a descent came to rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    pub(super) place: [f64; 2],
    /// The greatest term.
    pub(super) top: Term,
    /// What meets there, each with its multiplier.
    pub(super) meets: [Option<(Meets, f64)>; 2],
}

type Vector = [f64; 2];

fn dot(one: Vector, other: Vector) -> f64 {
    one[0] * other[0] + one[1] * other[1]
}

fn applied(curve: [f64; 3], to: Vector) -> Vector {
    [
        curve[0] * to[0] + curve[1] * to[1],
        curve[1] * to[0] + curve[2] * to[1],
    ]
}

/// A condition at a place: what is to vanish, and its slope and curvature, by coordinates as shares of their places.
#[derive(Clone, Copy)]
struct Condition {
    off: f64,
    normal: Vector,
    curve: [f64; 3],
}

/// A step and the multipliers of the conditions.
struct Step {
    by: Vector,
    multipliers: [f64; 2],
}

/// In shares of the place, so that both coordinates count alike.
fn scaled(jet: OnPlane<f64>, place: [f64; 2]) -> Condition {
    let [x, y] = place;
    Condition {
        off: jet.value,
        normal: [jet.by[0] * x, jet.by[1] * y],
        curve: [jet.curve[0] * x * x, jet.curve[1] * x * y, jet.curve[2] * y * y],
    }
}

/// Descends from a place; none where it does not come to rest.
pub(super) fn descend(ground: &Ground<'_>, start: [f64; 2]) -> Option<Rest> {
    let mut rest = Rest {
        place: start,
        top: ground.top(start),
        meets: [None; 2],
    };
    for &coordinate in &[0, 1] {
        let side = ground.chart.sides[coordinate];
        if side.width() <= 0.0 {
            rest.take_up(ground, Meets::Low(coordinate));
        }
    }
    for _ in 0..MOST_STEPS {
        let step = rest.step(ground)?;
        for (meets, multiplier) in rest.meets.iter_mut().zip(step.multipliers) {
            if let Some(meets) = meets {
                meets.1 = multiplier;
            }
        }
        if rest.let_go(ground) {
            continue;
        }
        let longest = step.by[0].abs().max(step.by[1].abs());
        if !longest.is_finite() {
            return None;
        }
        let ran_into = rest.go(ground, step.by, (LONG / longest).min(1.0));
        match ran_into {
            Some(meets) if !rest.take_up(ground, meets) => return None,
            Some(_) => {}
            None if longest < SHORT => return Some(rest),
            None => {}
        }
    }
    None
}

impl Rest {
    fn holds(&self, meets: Meets) -> bool {
        self.meets.iter().flatten().any(|(held, _)| *held == meets)
    }

    /// Holds one more condition; where there is no room, instead of the one without which the multipliers come out best.
    fn take_up(&mut self, ground: &Ground<'_>, meets: Meets) -> bool {
        if let Some(free) = self.meets.iter_mut().find(|held| held.is_none()) {
            *free = Some((meets, 0.0));
            return true;
        }
        let exchanged = |number: usize| {
            let fixed = match self.meets[number] {
                Some((Meets::Low(i) | Meets::High(i), _)) => ground.chart.sides[i].width() <= 0.0,
                Some((Meets::Term(_) | Meets::Bound(_), _)) | None => false,
            };
            let mut other = *self;
            other.meets[number] = Some((meets, 0.0));
            let step = (!fixed).then(|| other.step(ground)).flatten()?;
            Some((other, step.multipliers[0].min(step.multipliers[1])))
        };
        let best = match (exchanged(0), exchanged(1)) {
            (Some(one), Some(two)) => Some(if two.1 > one.1 { two } else { one }),
            (one, two) => one.or(two),
        };
        if let Some((other, _)) = best {
            *self = other;
        }
        best.is_some()
    }

    fn condition(&self, ground: &Ground<'_>, top: &Condition, meets: Meets) -> Condition {
        let place = self.place;
        let along = |coordinate: usize, sign: f64, off: f64| {
            let mut normal = [0.0; 2];
            normal[coordinate] = sign;
            Condition {
                off: off / place[coordinate],
                normal,
                curve: [0.0; 3],
            }
        };
        let sides = ground.chart.sides;
        match meets {
            Meets::Term(term) => {
                let other = scaled(ground.jet(term, place), place);
                Condition {
                    off: top.off - other.off,
                    normal: [0, 1].map(|i| top.normal[i] - other.normal[i]),
                    curve: [0, 1, 2].map(|k| top.curve[k] - other.curve[k]),
                }
            }
            Meets::Bound(term) => {
                let bound = scaled(ground.jet(term, place), place);
                Condition {
                    off: -bound.off,
                    normal: bound.normal.map(|x| -x),
                    curve: bound.curve.map(|x| -x),
                }
            }
            Meets::Low(i) => along(i, 1.0, place[i] - sides[i].low),
            Meets::High(i) => along(i, -1.0, sides[i].high - place[i]),
        }
    }

    /// The step to where the conditions hold and, of those places, the least is.
    fn step(&self, ground: &Ground<'_>) -> Option<Step> {
        let top = scaled(ground.jet(self.top, self.place), self.place);
        let conditions = self
            .meets
            .map(|meets| meets.map(|(meets, multiplier)| (self.condition(ground, &top, meets), multiplier)));
        // The curvature of the whole, with the multipliers that balance the slopes here.
        let pulls = match &conditions {
            [Some((one, _)), Some((two, _))] => {
                crossing(&top, [0.0; 3], one, two).map_or([0.0; 2], |step| step.multipliers)
            }
            [Some((one, _)), None] | [None, Some((one, _))] => {
                [dot(top.normal, one.normal) / dot(one.normal, one.normal).max(f64::MIN_POSITIVE); 2]
            }
            [None, None] => [0.0; 2],
        };
        let curve = conditions
            .iter()
            .zip(pulls)
            .filter_map(|(condition, pull)| condition.as_ref().map(|(one, _)| (one, pull)))
            .fold(top.curve, |sum, (one, pull)| {
                [0, 1, 2].map(|k| sum[k] - pull * one.curve[k])
            });
        match conditions {
            [None, None] => {
                let determinant = curve[0] * curve[2] - curve[1] * curve[1];
                let by = if curve[0] > 0.0 && determinant > 0.0 {
                    [
                        (curve[1] * top.normal[1] - curve[2] * top.normal[0]) / determinant,
                        (curve[1] * top.normal[0] - curve[0] * top.normal[1]) / determinant,
                    ]
                } else {
                    downhill(top.normal)
                };
                Some(Step {
                    by,
                    multipliers: [0.0; 2],
                })
            }
            [Some((one, _)), None] | [None, Some((one, _))] => {
                let step = along(&top, curve, &one)?;
                let multipliers = if conditions[0].is_some() {
                    [step.1, 0.0]
                } else {
                    [0.0, step.1]
                };
                Some(Step {
                    by: step.0,
                    multipliers,
                })
            }
            [Some((one, _)), Some((two, _))] => crossing(&top, curve, &one, &two),
        }
    }

    /// Lets go of a condition that keeps from what is better, or changes the first term.
    fn let_go(&mut self, ground: &Ground<'_>) -> bool {
        let mut others = 0.0;
        for held in &mut self.meets {
            let Some((meets, multiplier)) = *held else {
                continue;
            };
            let fixed = match meets {
                Meets::Low(i) | Meets::High(i) => ground.chart.sides[i].width() <= 0.0,
                Meets::Term(_) | Meets::Bound(_) => false,
            };
            if multiplier < 0.0 && !fixed {
                *held = None;
                return true;
            }
            if let Meets::Term(_) = meets {
                others += multiplier;
            }
        }
        if others <= 1.0 {
            return false;
        }
        for held in &mut self.meets {
            if let Some((Meets::Term(term), _)) = *held {
                self.top = term;
                *held = None;
                return true;
            }
        }
        false
    }

    /// Goes a part of a step, as far as the sides; and what it runs into.
    fn go(&mut self, ground: &Ground<'_>, by: Vector, part: f64) -> Option<Meets> {
        let mut into = None;
        let mut part = part;
        for i in [0, 1] {
            let side = ground.chart.sides[i];
            let way = by[i] * self.place[i];
            let (end, meets) = if way < 0.0 {
                (side.low, Meets::Low(i))
            } else {
                (side.high, Meets::High(i))
            };
            if self.holds(Meets::Low(i)) || self.holds(Meets::High(i)) || way == 0.0 {
                continue;
            }
            let room = ((end - self.place[i]) / way).max(0.0);
            if room < part {
                part = room;
                into = Some((i, end, meets));
            }
        }
        for i in [0, 1] {
            let side = ground.chart.sides[i];
            self.place[i] = (self.place[i] * (1.0 + part * by[i])).clamp(side.low, side.high);
        }
        if let Some((i, end, meets)) = into {
            self.place[i] = end;
            return Some(meets);
        }
        let (top, least) = (ground.value(self.top, self.place), 1e-12);
        let other = ground.top(self.place);
        if other != self.top
            && !self.holds(Meets::Term(other))
            && ground.value(other, self.place) > top + least * top.abs()
        {
            return Some(Meets::Term(other));
        }
        let (bound, broken) = ground.most_broken(self.place)?;
        (broken > 0.5 * KEPT && !self.holds(Meets::Bound(bound))).then_some(Meets::Bound(bound))
    }
}

/// A step of a tenth of the place.
fn downhill(slope: Vector) -> Vector {
    let length = dot(slope, slope).sqrt().max(f64::MIN_POSITIVE);
    slope.map(|x| -0.1 * x / length)
}

/// The step onto one condition and along it, and the multiplier.
fn along(top: &Condition, curve: [f64; 3], one: &Condition) -> Option<(Vector, f64)> {
    let square = dot(one.normal, one.normal);
    if square <= 0.0 {
        return None;
    }
    let onto = one.normal.map(|x| -one.off * x / square);
    let length = square.sqrt();
    let tangent = [-one.normal[1] / length, one.normal[0] / length];
    let bent = dot(tangent, applied(curve, tangent));
    let slope = dot(tangent, top.normal) + dot(tangent, applied(curve, onto));
    let far = if bent > 0.0 {
        -slope / bent
    } else {
        -0.1 * slope.signum()
    };
    let by = [onto[0] + far * tangent[0], onto[1] + far * tangent[1]];
    let bend = applied(curve, by);
    let left = [top.normal[0] + bend[0], top.normal[1] + bend[1]];
    Some((by, dot(left, one.normal) / square))
}

/// The step to where two conditions hold, and their multipliers.
fn crossing(top: &Condition, curve: [f64; 3], one: &Condition, two: &Condition) -> Option<Step> {
    let ([a, b], [c, d]) = (one.normal, two.normal);
    let determinant = a * d - b * c;
    if determinant.abs() <= 1e-9 * (dot(one.normal, one.normal) * dot(two.normal, two.normal)).sqrt() {
        return None;
    }
    let by = [
        (two.off * b - one.off * d) / determinant,
        (one.off * c - two.off * a) / determinant,
    ];
    let bend = applied(curve, by);
    let [p, q] = [top.normal[0] + bend[0], top.normal[1] + bend[1]];
    Some(Step {
        by,
        multipliers: [(p * d - q * c) / determinant, (q * a - p * b) / determinant],
    })
}
