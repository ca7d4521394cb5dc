//! Values of layers, for programs that make them one after the other.

use core::num::NonZeroU32;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::OperationId;

/// A layer of an operation.
pub(crate) type LayerKey = (OperationId, NonZeroU32);

/// A value for each layer. The latest one is kept apart: nearly always the next op is of the same layer.
#[derive(Clone, Debug, Default)]
pub(crate) struct ByLayer<V> {
    latest: Option<(LayerKey, V)>,
    others: BTreeMap<LayerKey, V>,
}

impl<V: Default> ByLayer<V> {
    /// The value of a layer.
    pub(crate) fn of(&mut self, layer: LayerKey) -> &mut V {
        let is_latest = self.latest.as_ref().is_some_and(|(key, _)| *key == layer);
        if !is_latest {
            self.others.extend(self.latest.take());
        }
        let others = &mut self.others;
        let latest = || (layer, others.remove(&layer).unwrap_or_default());
        &mut self.latest.get_or_insert_with(latest).1
    }

    /// All of them, operation by operation, from the top.
    pub(crate) fn into_all(mut self) -> impl Iterator<Item = (LayerKey, V)> {
        self.others.extend(self.latest);
        self.others.into_iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// As a map alone counts.
        #[test]
        fn layers_in_any_order_are_counted_as_by_a_map(
            layers in prop::collection::vec((0..3_u16, 1..5_u32), 0..60),
        ) {
            let mut counted = ByLayer::<usize>::default();
            let mut map = BTreeMap::new();
            for (operation, layer) in layers {
                let layer = (OperationId(operation), NonZeroU32::new(layer).unwrap());
                *counted.of(layer) += 1;
                *map.entry(layer).or_insert(0) += 1;
            }
            let all: Vec<_> = counted.into_all().collect();
            prop_assert_eq!(all, map.into_iter().collect::<Vec<_>>());
        }
    }
}
