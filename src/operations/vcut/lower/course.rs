//! The way of the tip along the work, from one side of the stock to the other and as far beyond as cuts extend: level, along a spine,
//! or in a fan along the straight line of its place.

use crate::asked::RoughVcut;
use std::sync::Arc;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_geometry::fan::Fan;
use vcutc_geometry::grid;
use vcutc_geometry::spine::Station;
use vcutc_job::follow::Guide;
use vcutc_process::posture::Feed;

/// The way of tips.
pub(super) enum Course {
    /// From beyond y = 0 to beyond the depth of the stock.
    Level([Station; 2]),
    /// All places from one end to the other, two or more.
    Spine(Vec<Station>),
    /// Each along the line of its place, from one y to another.
    Fan(Arc<Fan>, [f64; 2]),
}

impl Course {
    pub(super) fn of(asked: &RoughVcut, stock: Stock, extension: Length) -> Self {
        let extension = extension.to_mm();
        let back = grid::up(stock.depth.to_mm() + extension);
        match asked.along.as_ref().map(|along| &along.guide) {
            None => Self::Level([level(-extension), level(back)]),
            Some(Guide::Spine(spine)) => {
                let mut stations = spine.stations(extension);
                if let Some(last) = stations.last_mut() {
                    *last = Station {
                        y: back,
                        rise: spine.rise(back),
                        ..*last
                    };
                }
                Self::Spine(stations)
            }
            Some(Guide::Fan(fan)) => Self::Fan(Arc::clone(fan), [-extension, back]),
        }
    }

    /// Where a cut at an x with that feed starts.
    pub(super) fn end(&self, x: f64, feed: Feed) -> Station {
        let of = |[front, back]: [Station; 2]| match feed {
            Feed::Forward => front,
            Feed::Backward => back,
        };
        match self {
            Self::Level(ends) => of(*ends),
            Self::Spine(stations) => match stations.as_slice() {
                [first, .., last] => of([*first, *last]),
                [..] => level(0.0),
            },
            Self::Fan(fan, ys) => of(ys.map(|y| Station {
                y,
                rise: fan.rise(x, y),
                slope: fan.slope(x),
            })),
        }
    }

    /// The height of a tip at a station, whose cut is planned at that height. A line of a fan is put on the grid so that it lies
    /// nowhere below its plan.
    pub(super) fn height(&self, z: f64, station: Station) -> f64 {
        match self {
            Self::Level(_) => z,
            Self::Spine(_) if station.rise == 0.0 => z,
            Self::Spine(_) => grid::nearest(z + station.rise),
            Self::Fan(..) => grid::up(z + station.rise),
        }
    }

    /// The places of a cut at an x with that feed, in its order; none of a level one.
    pub(super) fn stations(&self, x: f64, feed: Feed) -> Option<Vec<Station>> {
        let mut stations = match self {
            Self::Level(_) => return None,
            Self::Spine(stations) => stations.clone(),
            Self::Fan(..) => [Feed::Forward, Feed::Backward]
                .map(|feed| self.end(x, feed))
                .to_vec(),
        };
        match feed {
            Feed::Forward => {}
            Feed::Backward => stations.reverse(),
        }
        Some(stations)
    }
}

const fn level(y: f64) -> Station {
    Station {
        y,
        rise: 0.0,
        slope: 0.0,
    }
}
