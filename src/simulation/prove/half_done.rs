//! Vs of which one flank is cut.

use super::Cut;
use crate::by_layer::ByLayer;

/// Slopes of the flanks that are done, of Vs of which one is: by layer, and there by the number of the cut, which the verifier has
/// found to go up from 1 without gaps.
#[derive(Default)]
pub(super) struct HalfDone(ByLayer<Vec<Option<f64>>>);

impl HalfDone {
    /// The slope of the other flank, where it is done; else that of this flank is kept for it.
    pub(super) fn other_of(&mut self, cut: &Cut, slope: f64) -> Option<f64> {
        let slopes = self.0.of((cut.operation, cut.layer));
        let number = cut.cut.get() as usize - 1;
        if slopes.len() <= number {
            slopes.resize(number + 1, None);
        }
        let place = slopes.get_mut(number)?;
        let other = place.take();
        if other.is_none() {
            *place = Some(slope);
        }
        other
    }
}
