//! The work as strips are laid over it: the heights of layers, columns, and how low each place may be cut.
//!
//! Both the side of a slit and the rim of the disc run a little beyond a strip. So the floor of a strip is the highest place of the
//! part over the strip *and* that margin on either side: on a rising part they would enter it otherwise.

use super::blades::{Extent, Knife, TOUCH, Wheel};
use super::terrain::Terrain;
use super::{Rounding, Work};
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_geometry::profile::Profile;
use vcutc_simulation::contour::farthest;

/// Ratios this close to a whole number are whole, so that 60 / 10 makes six strips whatever the last bit says.
const WHOLE: f64 = 1e-9;

/// Layer and step of a plan, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sizes {
    pub(crate) layer: f64,
    pub(crate) step: f64,
}

/// What strips are laid over. All in mm.
#[derive(Clone, Debug)]
pub(crate) struct Ground<'w> {
    work: Work<'w>,
    pub(crate) width: f64,
    pub(crate) top: f64,
    pub(crate) sizes: Sizes,
    /// How far a strip keeps from the part sideways.
    margin: f64,
    /// Nothing below is cut.
    down_to: f64,
    /// How far above its floor a strip leaves material.
    rise: f64,
    /// How far above its floor the slits beside a strip may end: rounding may bring the centre of the disc a little nearer.
    slit_rise: f64,
    rounding: Rounding,
    /// The smallest share of a layer or a step that is worth a strip on the part.
    worth: f64,
}

/// A stretch of x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    pub(crate) left: f64,
    pub(crate) right: f64,
}

impl Stretch {
    fn length(self) -> f64 {
        self.right - self.left
    }
}

/// What a plan is made for, without its sizes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Terms<'w> {
    pub(crate) work: Work<'w>,
    pub(crate) knife: &'w Knife,
    pub(crate) wheel: &'w Wheel,
    pub(crate) down_to: Length,
    pub(crate) rounding: Rounding,
    pub(crate) worth: f64,
}

impl<'w> Ground<'w> {
    pub(crate) fn new(terms: Terms<'w>, sizes: Sizes) -> Self {
        let (knife, wheel) = (terms.knife, terms.wheel);
        // Rounded up, the centre lies so much higher than its edge wants it.
        let (sink, spacing) = (wheel.sink().to_mm(), terms.rounding.spacing());
        let raised = terms.rounding.up(sink) - sink;
        Self {
            work: terms.work,
            width: terms.work.stock.width.to_mm(),
            top: top(terms.work.before),
            sizes,
            margin: knife.standoff.max(wheel.beyond).to_mm(),
            down_to: terms.down_to.to_mm(),
            rise: wheel.rise().to_mm() + raised,
            slit_rise: wheel.rise_within(wheel.beyond + Length::mm(spacing)).to_mm() + raised,
            rounding: terms.rounding,
            worth: terms.worth,
        }
    }

    /// The heights of the layers from the top, the last one at the lowest place of the part.
    pub(crate) fn levels(&self) -> Vec<f64> {
        let lowest = self.up(self.work.bound.lowest().z.max(self.down_to));
        let count = whole((self.top - lowest) / self.sizes.layer);
        let level = |k: u32| self.nearest(self.top - f64::from(k) * self.sizes.layer);
        (1..=count).map(|k| level(k).max(lowest)).collect()
    }

    /// The columns from x = 0, a step wide each, the last one narrower. Where it would be too narrow, the last two are as wide as
    /// each other.
    pub(crate) fn columns(&self) -> Vec<Stretch> {
        let count = whole(self.width / self.sizes.step).max(1);
        let last = self.width - f64::from(count - 1) * self.sizes.step;
        let edge = |i: u32| {
            if i == count {
                self.width
            } else if i + 1 == count && i > 0 && last < self.least_width() {
                self.nearest(self.width - (self.sizes.step + last) / 2.0)
            } else {
                self.nearest(f64::from(i) * self.sizes.step)
            }
        };
        (0..count)
            .map(|i| Stretch {
                left: edge(i),
                right: edge(i + 1),
            })
            .collect()
    }

    /// What stands before the first strip.
    pub(crate) fn before(&self) -> Terrain {
        Terrain::of(self.work.before, self.width)
    }

    /// What stands before the first strip over a stretch, and level beside it.
    pub(crate) fn before_over(&self, over: Stretch) -> Terrain {
        let corners = self.work.before;
        let first = corners
            .partition_point(|corner| corner.x < over.left)
            .saturating_sub(1);
        let last = corners.partition_point(|corner| corner.x <= over.right) + 1;
        let within = corners.get(first..last.min(corners.len())).unwrap_or_default();
        let side = |corner: Option<&Point2>, x: f64| corner.map(|corner| Point2::new(x, corner.z));
        let all: Vec<Point2> = side(within.first(), 0.0)
            .into_iter()
            .chain(within.iter().copied())
            .chain(side(within.last(), self.width))
            .collect();
        Terrain::of(&all, self.width)
    }

    /// How many strips a plan may come to, more or less.
    pub(crate) fn most_strips(&self) -> f64 {
        let lowest = self.work.bound.lowest().z.max(self.down_to);
        let layers = ((self.top - lowest) / self.sizes.layer).ceil().max(0.0);
        layers * ((self.width / self.sizes.step).ceil() + 1.0)
    }

    /// The lowest floor of a strip over a stretch.
    pub(crate) fn floor(&self, over: Stretch) -> f64 {
        let highest = highest(self.work.bound, over.left - self.margin, over.right + self.margin);
        self.up(highest.max(self.down_to))
    }

    /// The stretches over which a strip may lie at a height, from left to right.
    pub(crate) fn open_at(&self, level: f64) -> Vec<Stretch> {
        let sets = self.work.bound.level_set(level).into_iter();
        let kept = sets.map(|(left, right)| Stretch {
            left: if left > TOUCH {
                self.up(left + self.margin)
            } else {
                0.0
            },
            right: if right < self.width - TOUCH {
                self.down(right - self.margin)
            } else {
                self.width
            },
        });
        kept.filter(|stretch| stretch.length() > TOUCH.max(self.least_width()))
            .collect()
    }

    /// A stretch in equal strips, none wider than a step.
    pub(crate) fn spread(&self, over: Stretch) -> Vec<Stretch> {
        let count = whole(over.length() / self.sizes.step).max(1);
        let edge = |i: u32| {
            if i == count {
                over.right
            } else {
                self.nearest(over.left + over.length() * f64::from(i) / f64::from(count))
            }
        };
        (0..count)
            .map(|i| Stretch {
                left: edge(i),
                right: edge(i + 1),
            })
            .collect()
    }

    /// Whether it is worth a strip to lower a place so much.
    pub(crate) fn is_worth(&self, gain: f64) -> bool {
        gain > TOUCH.max(self.worth * self.sizes.layer)
    }

    /// The narrowest strip that is worth it, and that the rim of its neighbour's pass does not free too.
    pub(crate) fn least_width(&self) -> f64 {
        (self.worth * self.sizes.step).max(2.0 * self.margin)
    }

    /// Whether nothing of a strip stands any more.
    pub(crate) fn is_gone(&self, strip: Extent, terrain: &Terrain) -> bool {
        let highest = terrain.highest(strip.left, strip.right);
        highest.is_none_or(|height| height <= self.stands(strip.floor) + TOUCH)
    }

    /// Whether so little of a strip stands that it is not worth a pass: operations before have taken the rest.
    pub(crate) fn is_scrap(&self, strip: Extent, terrain: &Terrain) -> bool {
        let Extent { left, right, floor } = strip;
        let layer = (right - left) * self.sizes.layer;
        terrain.area_above(left, right, self.stands(floor)) <= self.worth * layer
    }

    /// What a strip leaves standing.
    pub(crate) fn stands(&self, floor: f64) -> f64 {
        floor + self.rise
    }

    /// The bottom of the slits beside a strip: on the grid, and no higher than the edge of the disc there.
    pub(crate) fn slit_bottom(&self, floor: f64) -> f64 {
        self.down(floor + self.slit_rise)
    }

    /// The most that a contour leaves on the part.
    pub(crate) fn left_by(&self, contour: &[Point2]) -> f64 {
        farthest(contour, self.work.part).height.to_mm()
    }

    /// What the better one of lifting and shifting leaves on a straight slope at most: the altitude of a strip's cross-section,
    /// with what keeps it from the part *(derived here)*.
    pub(crate) fn unavoidable(&self) -> f64 {
        let Sizes { layer, step } = self.sizes;
        let altitude = layer * step / (layer * layer + step * step).sqrt();
        altitude + self.margin + self.rise + self.work.allowance.to_mm()
    }

    /// The grid point nearest to an x or a height.
    pub(crate) fn nearest(&self, mm: f64) -> f64 {
        match self.rounding {
            Rounding::Exact => mm,
            Rounding::Grid => grid::nearest(mm),
        }
    }

    /// The spacing of the grid that places lie on; nothing where they are exact.
    pub(crate) const fn spacing(&self) -> f64 {
        self.rounding.spacing()
    }

    pub(crate) fn up(&self, mm: f64) -> f64 {
        self.rounding.up(mm)
    }

    pub(crate) fn down(&self, mm: f64) -> f64 {
        match self.rounding {
            Rounding::Exact => mm,
            Rounding::Grid => grid::down(mm),
        }
    }
}

impl Rounding {
    pub(crate) const fn spacing(self) -> f64 {
        match self {
            Self::Exact => 0.0,
            Self::Grid => grid::SPACING,
        }
    }

    fn up(self, mm: f64) -> f64 {
        match self {
            Self::Exact => mm,
            Self::Grid => grid::up(mm),
        }
    }
}

/// The highest place of a profile over a range, in closed form: at a corner or at an end.
pub(crate) fn highest(profile: &Profile, from: f64, to: f64) -> f64 {
    let points = profile.points();
    let first = points.partition_point(|point| point.x <= from);
    let last = points.partition_point(|point| point.x < to);
    let corners = points.get(first..last.max(first)).unwrap_or_default();
    let ends = [profile.height(from), profile.height(to)];
    corners
        .iter()
        .map(|point| point.z)
        .chain(ends)
        .fold(f64::NEG_INFINITY, f64::max)
}

/// The highest of some corners.
pub(crate) fn top(corners: &[Point2]) -> f64 {
    corners.iter().map(|corner| corner.z).fold(0.0, f64::max)
}

/// How many pieces of at most one a ratio makes.
fn whole(ratio: f64) -> u32 {
    let pieces = (ratio * (1.0 - WHOLE) - WHOLE).ceil().max(0.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative; saturates"
    )]
    let pieces = pieces as u32;
    pieces
}
