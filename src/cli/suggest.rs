//! "Did you mean ...?"

/// The candidate that was most likely meant: at most a third of the letters (and at least one) may differ.
pub(super) fn nearest<'c>(word: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    let allowed = (word.chars().count() / 3).max(1);
    let word = word.to_ascii_lowercase();
    candidates
        .into_iter()
        .map(|candidate| {
            let distance = strsim::damerau_levenshtein(&word, &candidate.to_ascii_lowercase());
            (distance, candidate)
        })
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn swapped_letters_are_one_slip() {
        assert_eq!(nearest("klr", ["gcode", "krl", "rapid"]), Some("krl"));
        assert_eq!(nearest("KRL", ["gcode", "krl"]), Some("krl"));
    }

    #[test]
    fn what_is_far_from_everything_has_no_suggestion() {
        assert_eq!(nearest("fanuc", ["gcode", "krl", "rapid"]), None);
        assert_eq!(nearest("", ["krl"]), None);
    }
}
