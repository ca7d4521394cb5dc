//! Vs of which one flank is cut.

use super::Cut;
use crate::by_layer::{ByLayer, LayerKey};
use core::num::NonZeroU32;

/// Slopes of the flanks that are done, of Vs of which one is. The other one mostly comes next, so the latest is kept apart.
#[derive(Default)]
pub(super) struct HalfDone {
    latest: Option<(Place, f64)>,
    /// By layer, and there by the number of the cut, which the verifier has found to go up from 1 without gaps.
    others: ByLayer<Vec<Option<f64>>>,
    /// How many of them there are.
    count: usize,
}

/// A V by its layer and its cut.
type Place = (LayerKey, NonZeroU32);

impl HalfDone {
    /// The slope of the other flank, where it is done; else that of this flank is kept for it.
    pub(super) fn other_of(&mut self, cut: &Cut, slope: f64) -> Option<f64> {
        let place = ((cut.operation, cut.layer), cut.cut);
        if let Some((_, other)) = self.latest.take_if(|(latest, _)| *latest == place) {
            return Some(other);
        }
        let other = self.take(place);
        if other.is_none()
            && let Some((before, slope)) = self.latest.replace((place, slope))
        {
            self.put(before, slope);
        }
        other
    }

    fn take(&mut self, (layer, cut): Place) -> Option<f64> {
        if self.count == 0 {
            return None;
        }
        let slopes = self.others.of(layer);
        let other = slopes.get_mut(cut.get() as usize - 1)?.take()?;
        self.count -= 1;
        Some(other)
    }

    fn put(&mut self, (layer, cut): Place, slope: f64) {
        let slopes = self.others.of(layer);
        let number = cut.get() as usize - 1;
        if slopes.len() <= number {
            slopes.resize(number + 1, None);
        }
        if let Some(place) = slopes.get_mut(number)
            && place.replace(slope).is_none()
        {
            self.count += 1;
        }
    }
}
