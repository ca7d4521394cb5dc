//! The way of the tip along the work, from one side of the stock to the other and as far beyond as cuts extend.

use crate::asked::RoughVcut;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_geometry::grid;
use vcutc_geometry::spine::Station;
use vcutc_process::posture::Feed;

/// The way of all tips: level, or along a spine.
pub(super) struct Course {
    /// Beyond y = 0, and beyond the depth of the stock.
    ends: [Station; 2],
    /// All places from one end to the other, where the way is not level.
    stations: Option<Vec<Station>>,
}

impl Course {
    pub(super) fn of(asked: &RoughVcut, stock: Stock, extension: Length) -> Self {
        let extension = extension.to_mm();
        let back = grid::up(stock.depth.to_mm() + extension);
        let along = asked.along.as_ref();
        let stations = along.map(|along| {
            let mut stations = along.spine.stations(extension);
            if let Some(last) = stations.last_mut() {
                *last = Station {
                    y: back,
                    rise: along.spine.rise(back),
                    ..*last
                };
            }
            stations
        });
        let level = |y: f64| Station {
            y,
            rise: 0.0,
            slope: 0.0,
        };
        let ends = match stations.as_deref() {
            Some([first, .., last]) => [*first, *last],
            Some(_) | None => [level(-extension), level(back)],
        };
        Self { ends, stations }
    }

    /// Where a cut with that feed starts.
    pub(super) const fn end(&self, feed: Feed) -> Station {
        let [front, back] = self.ends;
        match feed {
            Feed::Forward => front,
            Feed::Backward => back,
        }
    }

    /// The places of a cut with that feed, in its order; none of a level one.
    pub(super) fn stations(&self, feed: Feed) -> Option<Vec<Station>> {
        let mut stations = self.stations.clone()?;
        match feed {
            Feed::Forward => {}
            Feed::Backward => stations.reverse(),
        }
        Some(stations)
    }
}
