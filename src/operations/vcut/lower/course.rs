//! The way of the tip along the work, from one side of the stock to the other and as far beyond as cuts extend: level, along a spine,
//! or along the column of its place.

use crate::asked::RoughVcut;
use std::sync::Arc;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_geometry::columns::Columns;
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
    /// Each along the column of its place, from one y to another.
    Columns(Arc<Columns>, [f64; 2]),
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
            Some(Guide::Columns(columns)) => Self::Columns(Arc::clone(columns), [-extension, back]),
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
            Self::Columns(columns, ends) => match columns.stations(x, *ends).as_slice() {
                [first, .., last] => of([*first, *last]),
                [..] => level(0.0),
            },
        }
    }

    /// The height of a tip at a station, whose cut is planned at that height.
    pub(super) fn height(&self, z: f64, station: Station) -> f64 {
        match self {
            Self::Level(_) => z,
            Self::Spine(_) | Self::Columns(..) if station.rise == 0.0 => z,
            // Stations of columns are on the grid.
            Self::Spine(_) | Self::Columns(..) => grid::nearest(z + station.rise),
        }
    }

    /// The places of a cut at an x with that feed, in its order; none of a level one.
    pub(super) fn stations(&self, x: f64, feed: Feed) -> Option<Vec<Station>> {
        let mut stations = match self {
            Self::Level(_) => return None,
            Self::Spine(stations) => stations.clone(),
            Self::Columns(columns, ends) => columns.stations(x, *ends),
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
