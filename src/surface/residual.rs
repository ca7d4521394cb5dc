//! What straight cuts leave over a surface.
//!
//! After straight cuts along y the stock ends at heights `E(x)`, the same at every y: a polyline that may step. Between it and
//! the upper side `p(x, y)` of the surface lies what is left. Over each part of a triangle that no other one covers, and each
//! segment of the polyline, `E - p` is linear: the largest height is at a corner, and the volume is that of prisms. Both are
//! exact up to rounding.
//!
//! The largest *distance* from the machined surface to the part is bounded: distances change no faster than places do, so
//! that a patch of the machined surface of radius r holds none above that at its middle plus r (Shubert: A sequential
//! method seeking the global maximum of a function, 1972, in two parameters). The patch with the highest bound is halved
//! next, within a budget.

mod distance;
mod machined;
mod ruled;

pub use machined::{Machined, MachinedError};

use crate::coverage::Tangled;
use crate::region::{Half, twice_area, width, within};
use crate::surface::Surface;
use crate::visible::{Part, Plane};
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::height_between;

/// A volume.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Volume(f64);

impl Volume {
    /// So many cubic millimetres.
    pub(crate) const fn mm3(volume: f64) -> Self {
        Self(volume)
    }

    /// Cubic millimetres.
    #[must_use]
    pub const fn to_mm3(self) -> f64 {
        self.0
    }

    /// Litres.
    #[must_use]
    pub const fn to_litres(self) -> f64 {
        self.0 / 1e6
    }
}

/// A height over a place of the plan, or what else there is to say of the place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Over<V = Length> {
    /// The height.
    pub height: V,
    /// The place, along x and y.
    pub place: [Length; 2],
}

/// A length that lies between two others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Between {
    /// It is at least this.
    pub least: Length,
    /// It is at most this.
    pub most: Length,
}

/// How much is left over a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// The largest height of the machined surface above the part, and where.
    pub highest: Over,
    /// What is left.
    pub volume: Volume,
}

/// What is left over a surface. The surface counts as its triangles, without their tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The largest height of the machined surface above the part, and where.
    pub highest: Over,
    /// The least one, and where; below 0 it was cut into the part.
    pub lowest: Over,
    /// The largest distance from the machined surface to the part.
    pub farthest: Between,
    /// What is left. Where it was cut into the part nothing is; nor where the surface has a gap.
    pub volume: Volume,
}

impl Surface {
    /// What a machined profile that stands the same at every y leaves over the surface. Of triangles over each other the
    /// highest count. Strips of lower ones, seen past the border of higher ones, count for the largest height only if they are
    /// wider than the surface's `weld`: narrower ones are cracks.
    ///
    /// None when the surface has no area in plan.
    ///
    /// # Errors
    /// If triangles lie over each other in such numbers that this takes too long.
    pub fn residual(&self, machined: &Machined) -> Result<Option<Residual>, Tangled> {
        let sum = self.sum_below(machined)?;
        let (Some(highest), Some(lowest)) = (sum.highest, sum.lowest) else {
            return Ok(None);
        };
        let start = Point2::new(highest.1[0], highest.1[1]);
        let [least, most] = match machined.vees() {
            // What lies straight below bounds it.
            Some(_) => [0.0, f64::INFINITY],
            None => distance::farthest(self, machined, start),
        };
        // Something of the part lies straight below.
        let most = most.min(highest.0.max(-lowest.0)).max(least);
        let over = |(height, place): (f64, [f64; 2])| Over {
            height: Length::mm(height),
            place: place.map(Length::mm),
        };
        Ok(Some(Residual {
            highest: over(highest),
            lowest: over(lowest),
            farthest: Between {
                least: Length::mm(least),
                most: Length::mm(most),
            },
            volume: Volume(sum.volume),
        }))
    }

    /// What [`Surface::residual`] says without distances, which take it longest.
    ///
    /// # Errors
    /// As there.
    pub fn standing(&self, machined: &Machined) -> Result<Option<Standing>, Tangled> {
        let sum = self.sum_below(machined)?;
        Ok(sum.highest.map(|(height, place)| Standing {
            highest: Over {
                height: Length::mm(height),
                place: place.map(Length::mm),
            },
            volume: Volume(sum.volume),
        }))
    }

    fn sum_below(&self, machined: &Machined) -> Result<Sum, Tangled> {
        let mut sum = Sum::default();
        let mut looks = 0;
        let mut parts = Vec::new();
        let weld = self.accuracy().weld.to_mm();
        for cell in self.bins().all() {
            self.visible(cell, &mut looks, &mut parts)?;
            for part in &parts {
                let is_crack = part.is_cut && width(&part.region) <= weld;
                sum.add(
                    part,
                    machined,
                    if is_crack { Counts::Volume } else { Counts::All },
                );
            }
        }
        Ok(sum)
    }
}

/// What a part counts for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Counts {
    All,
    Volume,
}

#[derive(Debug, Default)]
struct Sum {
    highest: Option<(f64, [f64; 2])>,
    lowest: Option<(f64, [f64; 2])>,
    volume: f64,
}

impl Sum {
    fn add(&mut self, part: &Part, machined: &Machined, counts: Counts) {
        let xs = || part.region.iter().map(|place| place[0]);
        let from = xs().fold(f64::INFINITY, f64::min);
        let to = xs().fold(f64::NEG_INFINITY, f64::max);
        let pieces: Vec<Heights> = match machined.vees() {
            Some(ruled) => ruled.above(&part.region, part.plane),
            None => {
                let segments = machined.between(from, to);
                segments
                    .flat_map(|segment| machined.above(segment, &part.region, part.plane))
                    .collect()
            }
        };
        for corners in pieces {
            if counts == Counts::All {
                for &(place, height) in &corners {
                    if self.highest.is_none_or(|(most, _)| height > most) {
                        self.highest = Some((height, place));
                    }
                    if self.lowest.is_none_or(|(least, _)| height < least) {
                        self.lowest = Some((height, place));
                    }
                }
            }
            self.volume += volume(&above(&corners));
        }
    }
}

/// Corners in plan, each with a height over it that is linear.
pub(crate) type Heights = Vec<([f64; 2], f64)>;

impl Machined {
    /// What of a region lies under a segment of it, with its heights above a plane: one polygon, or where the top of the stock cuts
    /// it off two.
    pub(crate) fn above(&self, [a, b]: [Point2; 2], region: &[[f64; 2]], plane: Plane) -> Vec<Heights> {
        let left = within(region, Half::new([-1.0, 0.0], -a.x));
        let strip = within(&left, Half::new([1.0, 0.0], b.x));
        let height = |place: [f64; 2]| height_between(a, b, place[0]);
        let over = |place: [f64; 2], height: f64| (place, height - plane.at(place));
        let Some(lid) = self.lid() else {
            let whole = strip.into_iter().map(|place| over(place, height(place)));
            return vec![whole.collect()].into_iter().filter(has_area).collect();
        };
        // How far it is below the lid, and how far above.
        let below: Heights = strip
            .iter()
            .map(|&place| (place, lid.height(place) - height(place)))
            .collect();
        let higher: Heights = below.iter().map(|&(place, room)| (place, -room)).collect();
        let open = above(&below)
            .into_iter()
            .map(|(place, _)| over(place, height(place)));
        let closed = above(&higher)
            .into_iter()
            .map(|(place, _)| over(place, lid.height(place)));
        [open.collect(), closed.collect()]
            .into_iter()
            .filter(has_area)
            .collect()
    }
}

fn has_area(corners: &Heights) -> bool {
    corners.len() >= 3
}

/// The part of a polygon where a linear height over it is not below 0, with the heights.
fn above(corners: &[([f64; 2], f64)]) -> Heights {
    if corners.iter().all(|&(_, height)| height >= 0.0) {
        return corners.to_vec();
    }
    let mut out = Vec::with_capacity(corners.len() + 1);
    let Some(&(mut last)) = corners.last() else {
        return out;
    };
    for &(place, height) in corners {
        if (last.1 >= 0.0) != (height >= 0.0) {
            let share = last.1 / (last.1 - height);
            let at = |axis: usize| last.0[axis] + (place[axis] - last.0[axis]) * share;
            out.push(([at(0), at(1)], 0.0));
        }
        if height >= 0.0 {
            out.push((place, height));
        }
        last = (place, height);
    }
    out
}

/// The volume of a prism with a linear height over a convex polygon.
pub(crate) fn volume(corners: &[([f64; 2], f64)]) -> f64 {
    let Some(&(first, low)) = corners.first() else {
        return 0.0;
    };
    corners
        .windows(2)
        .skip(1)
        .map(|pair| {
            let [(a, u), (b, v)] = [pair[0], pair[1]];
            twice_area([first, a, b]).abs() / 6.0 * (low + u + v)
        })
        .sum()
}

#[cfg(test)]
mod tests;
