//! Where the file of a machine states the limits of its axes, so that a message about a limit can point at its line.

use vcutc_diagnostics::source::Span;

/// Where the limits of an axis are, none for a limit that the file does not state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LimitPlaces {
    /// The range of its values.
    pub range: Option<Span>,
    /// Its highest rate.
    pub rate: Option<Span>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FileKind, limit_places, read};
    use vcutc_diagnostics::source::FileId;

    fn stated(kind: FileKind, text: &str) -> Vec<(String, Option<&str>, Option<&str>)> {
        let axes = read("machine", kind, FileId::ALONE, text)
            .map_or_else(|flaws| panic!("{flaws:?}"), |model| model.axes);
        let places = limit_places(kind, FileId::ALONE, text, &axes);
        let stated = |place: Option<Span>| place.and_then(|place| text.get(place.bytes()));
        axes.iter()
            .zip(places)
            .map(|(axis, places)| (axis.name.clone(), stated(places.range), stated(places.rate)))
            .collect()
    }

    #[test]
    fn a_sheet_of_a_robot_has_a_list_of_ranges() {
        let text = include_str!("robots/kuka/kr10_r1100_2.toml");
        let found = stated(FileKind::Sheet, text);
        assert_eq!(found[1].0, "A2");
        let range = found[1].1.unwrap_or_default();
        assert!(
            range.starts_with('[') && range.ends_with(']') && range.contains(','),
            "{range}"
        );
        assert_eq!(found.len(), 6);
    }

    #[test]
    fn a_sheet_of_a_five_axis_machine_has_a_table_an_axis() {
        let text = include_str!("generic/head_head_ba.toml");
        for (name, range, rate) in stated(FileKind::Sheet, text) {
            assert!(range.is_some_and(|range| range.starts_with('[')), "{name}");
            assert!(rate.is_some_and(|rate| rate.parse::<f64>().is_ok()), "{name}");
        }
    }
}
