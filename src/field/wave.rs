//! The wave surface of a field, for pictures.

use crate::domain::{Domain, Grid, Ground};
use crate::field::Field;
use crate::lines::{LinesError, sampled};
use vcutc_region::region::Region;

/// Heights of a wave over a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Where the heights are.
    pub grid: Grid,
    /// Row by row: the real part of the field, zero along its lines; none outside of the region. At the length t of a ray its
    /// amplitude is about `sqrt(reference / t)`, see [`crate::source::Tuning`]; next to sources it is within 2 %.
    pub heights: Vec<Option<f64>>,
}

/// The wave of a field over a region, at the points of a grid of this pitch, in mm, for the lines of a tool of this radius.
///
/// # Errors
/// Where the pitch is unsound, or the points or the sources are too many.
pub fn surface(region: &Region, field: &Field, radius: f64, pitch: f64) -> Result<Surface, LinesError> {
    let domain = Domain::new(region);
    let grid = domain.grid(pitch).map_err(LinesError::Grid)?;
    let mut grounds = domain.grounds(&grid, 0.0);
    for ground in &mut grounds {
        if *ground == Ground::Beyond {
            *ground = Ground::Outside;
        }
    }
    let values = sampled(field, field.turned_to(radius), &grid, &grounds)?;
    let heights = values.iter().zip(&grounds);
    let heights = heights.map(|(value, ground)| (*ground == Ground::Free).then_some(value.re));
    Ok(Surface {
        grid,
        heights: heights.collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::{Detail, axis};
    use crate::source::Tuning;
    use vcutc_region::testkit::pocket;

    /// In the arm, whose axis is at y = 25, the wave is `-sin(k (d - r)) sqrt(reference / ray)`.
    #[test]
    fn a_wave_runs_square_to_straight_walls() {
        let region = pocket(2);
        let axis = axis(&region, Detail::True, 0.04).unwrap();
        let tuning = Tuning {
            step: 4.0,
            lift: 0.2,
            reference: 12.0,
        };
        let field = Field::new(&axis.segments, &tuning).unwrap();
        let surface = surface(&region, &field, 5.0, 1.0).unwrap();
        assert_eq!(surface.heights.len(), surface.grid.columns * surface.grid.rows);
        let mut count = 0;
        for row in 0..surface.grid.rows {
            let place = surface.grid.place(75, row);
            let height = surface.heights[row * surface.grid.columns + 75];
            // On the walls either may be said.
            if (place.y - 25.0).abs() != 25.0 {
                assert_eq!(height.is_some(), (place.y - 25.0).abs() < 25.0, "{place:?}");
            }
            if let Some(height) = height
                && place.y < 20.0
            {
                let ray = 25.0 - place.y;
                let expected = -libm::sin(tuning.wave_number() * (place.y - 5.0)) * (12.0 / ray).sqrt();
                assert!((height - expected).abs() < 0.2, "{place:?}: {height} {expected}");
                count += 1;
            }
        }
        assert!(count > 15);
    }
}
