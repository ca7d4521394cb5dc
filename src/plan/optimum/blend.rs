//! A bound from below that is tight along kinks and along bounds that bind.
//!
//! The best shape often lies where two functions cross: where reach and scallop allow the same layer, or where the largest
//! layer that reach allows is the least that is asked for. Across the crossing the objective falls steeply, along it hardly,
//! so that the enclosure of either function alone says little. The objective is no less than either, and no less than any
//! mean of the two; nor than itself less any multiple of a slack that must not be negative (weak duality, Lagrange).
//! With the weights that cancel the slopes at the best shape known, the blend is flat there and its enclosure tight.

use super::formulas::{Keeping, Tooth};
use super::number::{Interval, Number, Slopes};
use super::search::{Found, Ground, swing};

/// Functions this close to the best value, as a share of it, meet there.
const MEET: f64 = 1e-6;

/// The objective with the layer as thick as some of the bounds allow, with weights of sum 1, less a multiple of a slack.
#[derive(Clone, Copy, Debug)]
pub(super) struct Blend {
    parts: [(Keeping, f64); 2],
    slack: Option<(usize, f64)>,
}

type Gradient = [f64; 2];

fn dot(one: Gradient, other: Gradient) -> f64 {
    one[0] * other[0] + one[1] * other[1]
}

/// What is left of a gradient when a multiple of another is taken away.
fn less(one: Gradient, other: Gradient, multiple: f64) -> Gradient {
    [one[0] - multiple * other[0], one[1] - multiple * other[1]]
}

impl Blend {
    /// For the best shape known; none if it is not where functions cross.
    pub(super) fn at(ground: &Ground<'_>, found: &Found) -> Option<Self> {
        let here = found.place.map(Interval::exactly);
        // At a side the slope along the coordinate need not vanish.
        let free = [0, 1].map(|i| {
            let side = ground.chart.sides[i];
            found.place[i] > side.low && found.place[i] < side.high
        });
        let gradient =
            |function: &Slopes| [0, 1].map(|i| if free[i] { function.by[i].middle() } else { 0.0 });
        let tooth = Tooth::Behind(ground.model.behind(found.shape.share));
        let meeting: Vec<(Keeping, Gradient)> = [Keeping::Neither, Keeping::Reach, Keeping::Scallop]
            .into_iter()
            .map(|keeping| (keeping, ground.enclosed(here, tooth, keeping).0))
            .filter(|(_, function)| function.value.middle() >= found.value * (1.0 - MEET))
            .map(|(keeping, function)| (keeping, gradient(&function)))
            .collect();
        let (_, slacks) = ground.enclosed(here, tooth, Keeping::Both);
        let binding = slacks
            .into_iter()
            .enumerate()
            .filter(|(_, slack)| slack.value.middle().abs() <= MEET)
            .map(|(number, slack)| (number, gradient(&slack)));
        let binding: Vec<(usize, Gradient)> = binding.collect();
        let pairs = meeting.iter().enumerate().flat_map(|(i, &one)| {
            let means = meeting[i + 1..].iter().map(move |&two| Self::mean(one, two));
            let multiples = binding.iter().map(move |&slack| Self::relaxed(one, slack));
            means.chain(multiples)
        });
        pairs
            .min_by(|one, two| one.1.total_cmp(&two.1))
            .map(|(blend, _)| blend)
    }

    /// The mean with the least slope, and its square.
    fn mean(one: (Keeping, Gradient), two: (Keeping, Gradient)) -> (Self, f64) {
        let across = less(one.1, two.1, 1.0);
        let weight = (dot(one.1, across) / dot(across, across).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let left = less(one.1, across, weight);
        let blend = Self {
            parts: [(one.0, 1.0 - weight), (two.0, weight)],
            slack: None,
        };
        (blend, dot(left, left))
    }

    /// The multiple of a slack that leaves the least slope, and its square.
    fn relaxed(one: (Keeping, Gradient), slack: (usize, Gradient)) -> (Self, f64) {
        let multiple = (dot(one.1, slack.1) / dot(slack.1, slack.1).max(f64::MIN_POSITIVE)).max(0.0);
        let left = less(one.1, slack.1, multiple);
        let blend = Self {
            parts: [(one.0, 1.0), (one.0, 0.0)],
            slack: Some((slack.0, multiple)),
        };
        (blend, dot(left, left))
    }

    /// What shapes of a box that keep all bounds come to at least.
    pub(super) fn least(&self, ground: &Ground<'_>, tooth: Tooth, sides: [Interval; 2]) -> f64 {
        let middle = sides.map(|side| Interval::exactly(side.middle()));
        self.over(ground, tooth, middle).value.low - swing(&self.over(ground, tooth, sides), sides)
    }

    fn over(&self, ground: &Ground<'_>, tooth: Tooth, sides: [Interval; 2]) -> Slopes {
        let nothing = Slopes::constant(0.0);
        let parts = self.parts.into_iter().filter(|(_, weight)| *weight > 0.0).fold(
            nothing,
            |sum, (keeping, weight)| {
                sum + Slopes::constant(weight) * ground.enclosed(sides, tooth, keeping).0
            },
        );
        match self.slack {
            None => parts,
            Some((number, multiple)) => {
                let (_, slacks) = ground.enclosed(sides, tooth, Keeping::Both);
                let slack = slacks.get(number).copied().unwrap_or(nothing);
                parts - Slopes::constant(multiple) * slack
            }
        }
    }
}
