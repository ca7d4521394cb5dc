//! Narrower flanks: for a V that does not fit, the largest swing of each flank that does (`docs/process.md`, "Narrower flanks").
//!
//! A flank is clear when the blade edge-on stays out of the part with its allowance, comes out within its reach with nothing
//! beyond in its way, and the body above it, where the job states one, misses both the part and what stands. The first holds
//! for all smaller swings too, the others need not: so the first clear swing is looked for in a few steps down from the
//! operation's, and then by halving up to the one above it that is not clear [Yu 2019, 3.3].

#[cfg(test)]
mod tests;

use super::parameters::{VcutParameters, usable_edge};
use crate::asked::{Avoid, RoughVcut};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{BodyStage, Flank, Stock};
use vcutc_backend_api::units::Angle;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_geometry::profile::Profile;
use vcutc_process::posture::{Feed, Holder};
use vcutc_simulation::body;
use vcutc_simulation::prove::below_top;
use vcutc_simulation::sides::ThickFlank;
use vcutc_simulation::surface::{Side, Surface, Vee};

/// The swings of the two flanks of a V, each from 0 to the operation's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swings {
    pub left: Angle,
    pub right: Angle,
}

impl Swings {
    /// Both the same.
    #[must_use]
    pub const fn even(swing: Angle) -> Self {
        Self {
            left: swing,
            right: swing,
        }
    }

    /// That of a flank.
    #[must_use]
    pub const fn of(self, flank: Flank) -> Angle {
        match flank {
            Flank::Left => self.left,
            Flank::Right => self.right,
        }
    }

    /// The narrower one.
    #[must_use]
    pub const fn least(self) -> Angle {
        self.left.min(self.right)
    }

    /// Neither larger than this.
    #[must_use]
    pub const fn within(self, most: Angle) -> Self {
        Self {
            left: self.left.min(most),
            right: self.right.min(most),
        }
    }

    /// The V that they make.
    #[must_use]
    pub fn vee(self, tip: Point2) -> Vee {
        Vee {
            tip,
            left: Some(slope(self.left)),
            right: Some(slope(self.right)),
        }
    }
}

/// Rise of a flank over x; infinite for a wall.
fn slope(swing: Angle) -> f64 {
    if swing.to_rad() > 0.0 {
        1.0 / swing.tan()
    } else {
        f64::INFINITY
    }
}

/// Swings are found to so many parts of a degree, which programs print.
const PER_DEGREE: f64 = 10_000.0;

/// Into how many steps the swings from 0 to the operation's are divided to find a clear one.
const STEPS: u32 = 16;

/// Less than this below the part is rounding, in mm. The proof allows a thousand times as much.
const ROUNDING: f64 = 1e-9;

/// Determines how narrow flanks must be.
pub(super) struct Avoidance<'p> {
    parameters: &'p VcutParameters,
    /// The part with its allowance, up to the stock's top.
    part: Vec<Point2>,
    body: Option<Vec<BodyStage>>,
    stock: Stock,
    /// The blade as regular flanks hold it.
    holder: Holder,
    /// Vertical reach of an upright blade.
    upright: f64,
}

impl<'p> Avoidance<'p> {
    /// Of an operation that narrows flanks; none of one that does not. Nor where the lattice as a whole needs more than the blade
    /// has: the user has to fix that.
    pub(super) fn of(
        asked: &RoughVcut,
        parameters: &'p VcutParameters,
        bound: &Profile,
        stock: Stock,
    ) -> Option<Self> {
        match asked.avoid.value {
            Avoid::Lift => None,
            Avoid::Swing if !parameters.lattice_fits() => None,
            Avoid::Swing => Some(Self {
                parameters,
                part: below_top(bound, stock.height.to_mm()),
                body: asked.blade.in_program().body,
                stock,
                holder: Holder {
                    swing: parameters.swing,
                    rake: asked.setup.rake.value,
                    edges: asked.blade.edges,
                },
                upright: (usable_edge(asked) * (asked.setup.rake.value - asked.blade.half_apex.value).sin())
                    .to_mm(),
            }),
        }
    }

    /// The lowest height of a tip there that some swing may keep out of the part: the blade upright, its end on the part, and the
    /// tip as far above it as all tips are.
    pub(super) fn floor(&self, x: f64) -> f64 {
        let half = self.parameters.standoff.to_mm();
        let upright = [Side::Left, Side::Right].map(|side| {
            let wall = ThickFlank {
                tip: Point2 { x, z: 0.0 },
                side,
                slope: f64::INFINITY,
                half,
            };
            -self.gap(wall)
        });
        let end = upright.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let middle = self.middle_gap(Point2 { x, z: 0.0 }, Side::Right, f64::INFINITY);
        grid::up(end.max(-middle))
    }

    /// The largest swing of each flank of a tip that is clear; none where for one of them there is none.
    pub(super) fn swings(&self, tip: Point2, surface: &mut Surface) -> Option<Swings> {
        Some(Swings {
            left: self.widest(tip, Flank::Left, surface)?,
            right: self.widest(tip, Flank::Right, surface)?,
        })
    }

    /// The largest clear swing of a flank.
    fn widest(&self, tip: Point2, flank: Flank, surface: &mut Surface) -> Option<Angle> {
        let most = self.parameters.swing;
        if self.is_clear(tip, flank, most, surface) {
            return Some(most);
        }
        let parts = most.to_deg() * PER_DEGREE;
        let at = |share: u32| (parts * f64::from(share) / f64::from(STEPS)).floor();
        let clear = (0..STEPS)
            .rev()
            .find(|&share| self.is_clear(tip, flank, in_parts(at(share)), surface))?;
        let (mut clear, mut fails) = (at(clear), at(clear + 1));
        while fails - clear > 1.5 {
            let middle = f64::midpoint(clear, fails).floor();
            if self.is_clear(tip, flank, in_parts(middle), surface) {
                clear = middle;
            } else {
                fails = middle;
            }
        }
        Some(in_parts(clear))
    }

    /// Whether a flank with that swing is clear of the part and of what stands, and comes out.
    fn is_clear(&self, tip: Point2, flank: Flank, swing: Angle, surface: &mut Surface) -> bool {
        self.clears_part(tip, flank, swing)
            && self.comes_out(tip, flank, swing, surface)
            && self.body_clears(tip, flank, swing, surface)
    }

    /// Whether the blade edge-on stays out of the part. Its middle plane keeps as far above it as that of regular flanks does, so
    /// that a swing as wide as theirs asks for what theirs ask for.
    fn clears_part(&self, tip: Point2, flank: Flank, swing: Angle) -> bool {
        let (side, slope) = (side_of(flank), slope(swing));
        let thick = ThickFlank {
            tip,
            side,
            slope,
            half: self.parameters.standoff.to_mm(),
        };
        self.gap(thick).min(self.middle_gap(tip, side, slope)) >= -ROUNDING
    }

    /// How far the middle plane of a flank, lowered as those of regular flanks are, stays above the part.
    fn middle_gap(&self, tip: Point2, side: Side, slope: f64) -> f64 {
        let lowered = ThickFlank {
            tip: Point2 {
                z: tip.z - self.parameters.drop.to_mm(),
                ..tip
            },
            side,
            slope,
            half: 0.0,
        };
        self.gap(lowered)
    }

    /// How far a flank stays above the part. Beyond where it comes out of the stock's top there is no part to look at.
    fn gap(&self, flank: ThickFlank) -> f64 {
        let rise = (self.stock.height.to_mm() - flank.tip.z).max(0.0);
        let far = if flank.slope.is_infinite() {
            flank.half
        } else {
            (rise + flank.drop()) / flank.slope
        };
        let (left, right) = match flank.side {
            Side::Left => (flank.tip.x - far, flank.tip.x),
            Side::Right => (flank.tip.x, flank.tip.x + far),
        };
        // With a corner more on either side, which what is between ends at.
        let first = self
            .part
            .partition_point(|corner| corner.x < left)
            .saturating_sub(1);
        let last = self.part.partition_point(|corner| corner.x <= right) + 1;
        let near = self.part.get(first..last.min(self.part.len()));
        let nearest = flank.nearest(near.unwrap_or_default());
        nearest.map_or(f64::INFINITY, |(_, gap)| gap)
    }

    /// Whether a flank comes out within the blade's reach, `L sin(theta - beta) cos(s)`, with nothing in its way beyond.
    fn comes_out(&self, tip: Point2, flank: Flank, swing: Angle, surface: &mut Surface) -> bool {
        let run = surface.flank(Swings::even(swing).vee(tip), side_of(flank));
        run.blocked_at.is_none() && run.reach <= self.upright * swing.cos()
    }

    /// Whether the body misses them with both flanks as they are.
    pub(super) fn bodies_clear(&self, tip: Point2, surface: &Surface) -> bool {
        let swing = self.parameters.swing;
        [Flank::Left, Flank::Right]
            .into_iter()
            .all(|flank| self.body_clears(tip, flank, swing, surface))
    }

    /// Whether the body above the edge misses the part and what stands.
    fn body_clears(&self, tip: Point2, flank: Flank, swing: Angle, surface: &Surface) -> bool {
        let Some(body) = &self.body else {
            return true;
        };
        let extension = self.parameters.extension.to_mm();
        let held = Holder { swing, ..self.holder };
        let stands: Vec<Point2> = surface.corners().collect();
        let (front, back) = (-extension, self.stock.depth.to_mm() + extension);
        let way = [front, back].map(|y| Point3::new(tip.x, y, tip.z));
        // On both ways the body is as far up the flank: the lean along the feed does not show in the section.
        let held = held.cutting(flank, Feed::Forward);
        [stands.as_slice(), self.part.as_slice()]
            .into_iter()
            .all(|section| body::clears(body, held, way, self.stock, section))
    }
}

/// Parts of a degree as an angle.
const fn in_parts(parts: f64) -> Angle {
    Angle::deg(parts / PER_DEGREE)
}

/// The side that a flank is on.
const fn side_of(flank: Flank) -> Side {
    match flank {
        Flank::Left => Side::Left,
        Flank::Right => Side::Right,
    }
}
