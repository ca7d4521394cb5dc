//! Near names for "did you mean".

/// The names among `known` that `wanted` is likely to be a misspelling of: the best first, three at most.
///
/// Near means no more than a third of the letters inserted, left out, changed or swapped with their neighbour, but one
/// such change is always near. Capitals make no difference.
#[must_use]
pub fn nearest<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    const MOST: usize = 3;
    let wanted = wanted.to_lowercase();
    let length = wanted.chars().count();
    let allowed = (length / 3).max(1);
    let mut near: Vec<(usize, &str)> = known
        .into_iter()
        // The distance takes time in both lengths; names too different in length need none of it.
        .filter(|name| name.chars().count().abs_diff(length) <= allowed)
        .map(|name| (strsim::damerau_levenshtein(&wanted, &name.to_lowercase()), name))
        .filter(|&(distance, _)| distance <= allowed)
        .collect();
    near.sort_unstable();
    near.dedup();
    near.into_iter().take(MOST).map(|(_, name)| name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspellings_find_their_names() {
        let known = ["layer", "step", "swing", "scallop", "clearance"];
        assert_eq!(nearest("layr", known), ["layer"]);
        assert_eq!(nearest("lyaer", known), ["layer"]);
        assert_eq!(nearest("Swing", known), ["swing"]);
        assert_eq!(nearest("claerence", known), ["clearance"]);
        assert_eq!(nearest("stop", known), ["step"]);
        assert!(nearest("rake", known).is_empty());
        assert!(nearest("", known).is_empty());
    }

    #[test]
    fn the_best_come_first_and_only_three() {
        let known = ["cuts", "cat", "cut", "cot", "cup"];
        assert_eq!(nearest("cut", known), ["cut", "cat", "cot"]);
    }
}
