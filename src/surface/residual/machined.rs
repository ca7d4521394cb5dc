//! A height over x that may step, or what the Vs of columns leave.

use super::ruled::Ruled;
use core::fmt;
use std::sync::Arc;
use vcutc_backend_api::units::Length;
use vcutc_geometry::columns::Column;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::height_between;
use vcutc_geometry::spine::Spine;

/// The surface that straight cuts along y leave: a polyline whose x never decrease. Beyond its ends it goes on level. Or the surface that
/// the Vs of columns leave.
#[derive(Clone, Debug, PartialEq)]
pub struct Machined {
    points: Vec<Point2>,
    lid: Option<Lid>,
    ruled: Option<Arc<Ruled>>,
}

/// The top of the stock as it is seen with the spine of the cuts taken off: nothing is left above it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lid {
    spine: Arc<Spine>,
    /// In mm.
    top: f64,
}

impl Lid {
    /// Its height over a place, in mm.
    pub(crate) fn height(&self, place: [f64; 2]) -> f64 {
        self.top - self.spine.rise(place[1])
    }
}

/// Why points are not a machined profile. Indices count them from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MachinedError {
    /// Fewer than two points, or all over one place.
    TooFew,
    /// A coordinate is not a number or out of range.
    OutOfRange {
        /// The point.
        index: usize,
    },
    /// It turns back.
    TurnsBack {
        /// The first point that lies before the one before it.
        index: usize,
    },
}

impl fmt::Display for MachinedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew => write!(f, "a machined profile takes two places or more"),
            Self::OutOfRange { index } => write!(f, "point {index} is out of range"),
            Self::TurnsBack { index } => write!(f, "point {index} lies before the one before it"),
        }
    }
}

impl core::error::Error for MachinedError {}

impl Machined {
    /// The machined surface over a polyline from left to right, in mm.
    ///
    /// # Errors
    /// See [`MachinedError`].
    pub fn new(points: Vec<Point2>) -> Result<Self, MachinedError> {
        if let Some(index) = points.iter().position(|point| !point.is_in_range()) {
            return Err(MachinedError::OutOfRange { index });
        }
        if let Some(index) = points.windows(2).position(|pair| pair[1].x < pair[0].x) {
            return Err(MachinedError::TurnsBack { index: index + 1 });
        }
        match (points.first(), points.last()) {
            (Some(first), Some(last)) if first.x < last.x => Ok(Self {
                points,
                lid: None,
                ruled: None,
            }),
            _ => Err(MachinedError::TooFew),
        }
    }

    /// The same of cuts along a spine in a stock of that height: it stands so over each y with the spine taken off, but nowhere
    /// higher than the stock. What is left is measured from the part with the spine taken off ([`crate::surface::Surface::levelled`]).
    #[must_use]
    pub fn along(self, spine: Arc<Spine>, top: Length) -> Self {
        let top = top.to_mm();
        let lid = Some(Lid { spine, top });
        Self { lid, ..self }
    }

    /// The surface that these Vs leave of a stock of that height, whatever the polyline is: the least of all of them. Slabs end at the
    /// knots.
    #[must_use]
    pub fn ruled(self, vees: Vec<Column>, knots: &[f64], top: Length) -> Self {
        let ruled = Ruled::new(vees, knots.to_vec(), top.to_mm());
        let ruled = Some(Arc::new(ruled));
        Self { ruled, ..self }
    }

    pub(crate) fn vees(&self) -> Option<&Ruled> {
        self.ruled.as_deref()
    }

    pub(crate) const fn lid(&self) -> Option<&Lid> {
        self.lid.as_ref()
    }

    /// What Vs of columns leave at a y, from x = 0 to a width, in mm; none where the surface is another one.
    #[must_use]
    pub fn section(&self, y: f64, width: f64) -> Option<Vec<Point2>> {
        self.ruled.as_ref().map(|ruled| ruled.section(y, width))
    }

    /// How high it stands over a place of the stock, in mm; at a wall its upper end.
    #[must_use]
    pub fn height_over(&self, x: f64, y: f64) -> f64 {
        if let Some(ruled) = &self.ruled {
            return ruled.height([x, y]);
        }
        let height = self.height(x);
        match &self.lid {
            None => height,
            Some(lid) => (height + lid.spine.rise(y)).min(lid.top),
        }
    }

    /// The polyline.
    #[must_use]
    pub fn points(&self) -> &[Point2] {
        &self.points
    }

    /// Its height at an x in mm; of a wall its upper end.
    #[must_use]
    pub fn height(&self, x: f64) -> f64 {
        let heights = self.between(x, x).map(|[a, b]| height_between(a, b, x));
        heights.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Its segments that reach over places from one x to another, without upright ones, and level ones beyond its ends.
    pub(crate) fn between(&self, from: f64, to: f64) -> impl Iterator<Item = [Point2; 2]> + '_ {
        let level = |x: f64, z: f64, other: f64| [Point2::new(x.min(other), z), Point2::new(x.max(other), z)];
        let first = self.points.first().filter(|first| from < first.x);
        let last = self.points.last().filter(|last| to > last.x);
        let start = self
            .points
            .partition_point(|point| point.x < from)
            .saturating_sub(1);
        let inner = self.points.get(start..).unwrap_or_default().windows(2);
        let inner = inner
            .take_while(move |pair| pair[0].x <= to)
            .filter(|pair| pair[0].x < pair[1].x)
            .map(|pair| [pair[0], pair[1]]);
        let before = first.map(|first| level(first.x, first.z, from));
        let after = last.map(|last| level(last.x, last.z, to));
        before.into_iter().chain(inner).chain(after)
    }

    /// All its segments from one x to another, cut there, upright ones too.
    pub(super) fn clipped(&self, from: f64, to: f64) -> Vec<[Point2; 2]> {
        let upright = self
            .points
            .windows(2)
            .filter(|pair| pair[0].x == pair[1].x && (from..=to).contains(&pair[0].x));
        let upright = upright.map(|pair| [pair[0], pair[1]]);
        let cut = |[a, b]: [Point2; 2]| {
            let at = |x: f64| Point2::new(x, height_between(a, b, x));
            [at(a.x.max(from)), at(b.x.min(to))]
        };
        self.between(from, to).map(cut).chain(upright).collect()
    }
}
