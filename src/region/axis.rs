//! Where a region is widest, and where it is narrow between wide places.
//!
//! Both are found from levels, without an axis: a circle fits where the level of its radius is not empty, and a neck lies where one
//! part of a level becomes two. The value is halved into between two levels; the centre of a circle that touches three walls is
//! then where three distances are alike, by Newton's method.

use crate::curve::Curve;
use crate::distance::{Walls, between};
use crate::offset::{Kind, OffsetFault, Offsets, Way};
use crate::place::Place;
use crate::region::{Region, toggles};

/// Values are found to this, in mm.
const FINE: f64 = 1e-7;

/// Most levels that are computed for one answer.
const MOST_LEVELS: u32 = 20_000;

/// Steps of Newton's method.
const STEPS: u32 = 20;

/// A circle within a region that touches its walls. Lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    /// Its centre.
    pub centre: Place,
    /// Its radius.
    pub radius: f64,
}

/// The narrowest place between two wide ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neck {
    /// Its middle.
    pub at: Place,
    /// How wide it is there, in mm.
    pub width: f64,
}

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AxisFault {
    /// A step that is not above 0, or so many levels that they are not looked at.
    Step,
    /// A level could not be computed.
    Offset(OffsetFault),
}

impl From<OffsetFault> for AxisFault {
    fn from(fault: OffsetFault) -> Self {
        Self::Offset(fault)
    }
}

/// The largest circle within a region. Where several are as large, one of them. Open sides do not bound it: they are led on for
/// `reach` mm.
///
/// # Errors
/// A level could not be computed; see [`OffsetFault`].
pub fn largest_circle(region: &Region, reach: f64) -> Result<Circle, AxisFault> {
    let mut axis = Axis::of(region, reach);
    // No circle is wider than the box around.
    let bounds = region.bounds();
    let most = bounds.low.distance(bounds.high) + reach;
    axis.largest(most)
}

/// The necks between basins: where parts that are apart at one of the distances `step`, `2 step` .. and up to `radius`, in mm, hang
/// together nearer to the walls. A tool of that radius passes none of them.
///
/// # Errors
/// A level could not be computed, or there are too many.
pub fn necks(region: &Region, reach: f64, radius: f64, step: f64) -> Result<Vec<Neck>, AxisFault> {
    let mut axis = Axis::of(region, reach);
    let mut necks = Vec::new();
    let mut low = FINE * 10.0;
    let mut above = axis.parts(low)?;
    for level in levels(step)? {
        let high = (step * f64::from(level)).min(radius);
        let here = axis.parts(high)?;
        for part in &above {
            let inner = here.iter().map(|deeper| deeper.place);
            let inner: Vec<Place> = inner.filter(|&place| part.encloses(place)).collect();
            axis.split(&inner, low, high, &mut necks)?;
        }
        if here.is_empty() || high >= radius {
            break;
        }
        (above, low) = (here, high);
    }
    Ok(necks)
}

fn levels(step: f64) -> Result<core::ops::RangeInclusive<u32>, AxisFault> {
    if step > 0.0 && step.is_finite() {
        Ok(1..=MOST_LEVELS)
    } else {
        Err(AxisFault::Step)
    }
}

/// A connected part of a level.
struct Part {
    outline: Way,
    /// A place of its outline.
    place: Place,
}

impl Part {
    fn encloses(&self, place: Place) -> bool {
        let crossed = self.outline.pieces.iter().filter(|piece| toggles(piece, place));
        self.outline.kind == Kind::Loop && crossed.count() % 2 == 1
    }

    fn twice_area(&self) -> f64 {
        self.outline.pieces.iter().map(|piece| piece.twice_area()).sum()
    }
}

struct Axis {
    offsets: Offsets,
    left: u32,
}

impl Axis {
    fn of(region: &Region, reach: f64) -> Self {
        Self {
            offsets: Offsets::of(region, reach),
            left: MOST_LEVELS,
        }
    }

    /// The parts of a level: its outlines, not what bounds islands.
    fn parts(&mut self, distance: f64) -> Result<Vec<Part>, AxisFault> {
        self.left = self.left.checked_sub(1).ok_or(AxisFault::Step)?;
        let ways = self.offsets.closed_level(distance)?;
        let parts = ways.into_iter().filter_map(|outline| {
            let place = outline.pieces.first()?.at(0.5);
            Some(Part { outline, place })
        });
        Ok(parts
            .filter(|part| part.outline.kind == Kind::Tie || part.twice_area() >= 0.0)
            .collect())
    }

    /// The largest circle, with a radius up to so much.
    fn largest(&mut self, most: f64) -> Result<Circle, AxisFault> {
        let (mut low, mut high) = (0.0, most);
        let mut centre = None;
        while high - low > FINE {
            let middle = f64::midpoint(low, high);
            let parts = self.parts(middle)?;
            match parts.first() {
                Some(part) => {
                    low = middle;
                    centre = Some(middle_of(&part.outline));
                }
                None => high = middle,
            }
        }
        let centre = centre.ok_or(OffsetFault::NoWalls)?;
        Ok(touching(self.offsets.walls(), centre))
    }

    /// Finds where places, apart at the distance `high` and together at `low`, come apart.
    fn split(
        &mut self,
        places: &[Place],
        low: f64,
        high: f64,
        necks: &mut Vec<Neck>,
    ) -> Result<(), AxisFault> {
        // Each entry: places, and between which distances they come apart.
        let mut open = vec![(places.to_vec(), low, high)];
        while let Some((places, low, high)) = open.pop() {
            if places.len() < 2 {
                continue;
            }
            if high - low <= FINE {
                necks.extend(self.neck(&places, high)?);
                continue;
            }
            let middle = f64::midpoint(low, high);
            let parts = self.parts(middle)?;
            let mut groups: Vec<Vec<Place>> = parts.iter().map(|_| Vec::new()).collect();
            for &place in &places {
                let around =
                    (0..parts.len()).filter(|&at| parts.get(at).is_some_and(|part| part.encloses(place)));
                let area = |at: &usize| parts.get(*at).map_or(f64::INFINITY, Part::twice_area);
                let group = around.min_by(|a, b| area(a).total_cmp(&area(b)));
                if let Some(group) = group.and_then(|at| groups.get_mut(at)) {
                    group.push(place);
                }
            }
            let first: Vec<Place> = groups.iter().filter_map(|group| group.first().copied()).collect();
            open.push((first, low, middle));
            open.extend(groups.into_iter().map(|group| (group, middle, high)));
        }
        Ok(())
    }

    /// The necks between parts that have just come apart: where each comes nearest to those before it.
    fn neck(&mut self, places: &[Place], distance: f64) -> Result<Vec<Neck>, AxisFault> {
        let parts = self.parts(distance)?;
        let apart: Vec<&Part> = parts
            .iter()
            .filter(|part| {
                places
                    .iter()
                    .any(|&place| part.encloses(place) || part.place == place)
            })
            .collect();
        let mut necks = Vec::new();
        for (number, part) in apart.iter().enumerate().skip(1) {
            let curves: Vec<Curve> = part
                .outline
                .pieces
                .iter()
                .map(|&piece| Curve::of(piece))
                .collect();
            let others = apart.iter().take(number).flat_map(|part| &part.outline.pieces);
            let mut best = (f64::INFINITY, part.place, part.place);
            for other in others.map(|&piece| Curve::of(piece)) {
                for curve in &curves {
                    let found = between(curve, &other);
                    if found.0 < best.0 {
                        best = found;
                    }
                }
            }
            let at = best.1.lerp(best.2, 0.5);
            necks.push(Neck {
                at,
                width: 2.0 * self.offsets.walls().distance(at),
            });
        }
        Ok(necks)
    }
}

/// The middle of the box around a way.
fn middle_of(way: &Way) -> Place {
    let boxes = way.pieces.iter().map(|&piece| Curve::of(piece).extent());
    let middle = boxes
        .reduce(crate::boxes::Extent::with)
        .map(crate::boxes::Extent::middle);
    middle.unwrap_or(Place::new(0.0, 0.0))
}

/// The circle near a place that touches three walls, if there is one that is no smaller than the one about the place itself.
fn touching(walls: &Walls, place: Place) -> Circle {
    let found = Circle {
        centre: place,
        radius: walls.distance(place),
    };
    let Some(three) = three_walls(walls, found) else {
        return found;
    };
    let mut centre = place;
    for _ in 0..STEPS {
        // Distances di with gradients gi: (gi - g0) . step = d0 - di.
        let feet = three.map(|wall| wall.nearest(centre));
        let away = feet.map(|foot| centre.minus(foot.at).times(1.0 / foot.distance));
        let (a, b) = (away[1].minus(away[0]), away[2].minus(away[0]));
        let (c, d) = (
            feet[0].distance - feet[1].distance,
            feet[0].distance - feet[2].distance,
        );
        let size = a.cross(b);
        if size.abs() < FINE {
            return found;
        }
        centre = centre.plus(Place::new(c * b.y - d * a.y, a.x * d - b.x * c).times(1.0 / size));
    }
    let radius = walls.distance(centre);
    if radius >= found.radius - FINE && centre.distance(place) < found.radius {
        Circle { centre, radius }
    } else {
        found
    }
}

/// Three walls that a circle touches, in places that are well apart.
fn three_walls(walls: &Walls, circle: Circle) -> Option<[Curve; 3]> {
    let slack = circle.radius * 1e-3;
    let mut near: Vec<(f64, Place, Curve)> = Vec::new();
    walls.around(circle.centre, circle.radius + slack, &mut |number| {
        if let Some(&wall) = walls.curve(number) {
            let foot = wall.nearest(circle.centre);
            if foot.distance <= circle.radius + slack {
                near.push((foot.distance, foot.at, wall));
            }
        }
    });
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut chosen: Vec<(Place, Curve)> = Vec::new();
    for (_, at, wall) in near {
        if chosen.iter().all(|(other, _)| other.distance(at) > 10.0 * slack) {
            chosen.push((at, wall));
        }
    }
    let mut chosen = chosen.into_iter().map(|(_, wall)| wall);
    Some([chosen.next()?, chosen.next()?, chosen.next()?])
}

#[cfg(test)]
mod tests;
