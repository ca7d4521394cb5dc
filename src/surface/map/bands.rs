//! Maps of angles that change along bands of the plan, such as the tilt of a disc along its tracks.

use super::{Cells, Grid, Map, Piece, Tally};
use crate::coverage::Tangled;
use vcutc_backend_api::units::Angle;

/// A band of the plan along y.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// From where to where along x, in mm.
    pub x: [f64; 2],
    /// Angles at places along y, in mm, by growing y. Between two places the angle changes evenly, and is the same all across the band.
    pub angles: Vec<(f64, Angle)>,
}

impl Map<Angle> {
    /// A map over a plan of this size along x and y, in mm. A cell has the greatest angle of all bands in it; where no band lies, there is
    /// none. None where no band has an area in the plan.
    ///
    /// # Errors
    /// If bands have so many places that this takes too long.
    pub fn of_bands(bands: &[Band], cells: Cells, size: [f64; 2]) -> Result<Option<Self>, Tangled> {
        let grid = Grid::new(cells, size);
        let mut tally = Tally::new(&grid);
        for band in bands {
            // What lies beside the plan is not shown.
            let [left, right] = band.x.map(|x| x.clamp(0.0, size[0]));
            for pair in band.angles.windows(2) {
                let &[(from, first), (to, last)] = pair else {
                    continue;
                };
                let [low, high] = [from, to].map(|y| y.clamp(0.0, size[1]));
                if left >= right || low >= high {
                    continue;
                }
                let at = |y: f64| (first + (last - first) * ((y - from) / (to - from))).to_rad();
                let region = vec![[left, low], [right, low], [right, high], [left, high]];
                grid.split(&region, |place, corners| {
                    tally.pieces += 1;
                    let piece: Piece = corners.iter().map(|&corner| (corner, at(corner[1]))).collect();
                    tally.add(place, &piece);
                });
                tally.is_bearable(region.first())?;
            }
        }
        Ok(tally.map(Angle::rad))
    }
}

#[cfg(test)]
mod tests;
