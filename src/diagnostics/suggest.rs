//! Near names for "did you mean".

/// The names among `known` that `wanted` is likely to be a misspelling of: the best first, three at most.
///
/// Near means no more than a third of the letters inserted, left out, changed or swapped with their neighbour, but one
/// such change is always near. Capitals make no difference.
#[must_use]
pub fn nearest<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let near = ranked(wanted, known);
    near.into_iter().take(MOST).map(|(_, name)| name).collect()
}

/// Those of the [`nearest`] names that no other one is nearer than: for long names, of which many share most letters.
#[must_use]
pub fn closest<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let near = ranked(wanted, known);
    let least = near.first().map(|(distance, _)| *distance);
    near.into_iter()
        .take_while(|(distance, _)| Some(*distance) == least)
        .take(MOST)
        .map(|(_, name)| name)
        .collect()
}

/// Most names that are offered.
const MOST: usize = 3;

/// Near names with the number of changes that lead to them, the best first.
fn ranked<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<(usize, &'a str)> {
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
    // A slip of a finger leaves the first letter and the length more often than not.
    let key = |&(distance, name): &(usize, &'a str)| {
        let begins_else = name.to_lowercase().chars().next() != wanted.chars().next();
        (distance, begins_else, name.chars().count().abs_diff(length), name)
    };
    near.sort_unstable_by(|one, other| key(one).cmp(&key(other)));
    near.dedup();
    near
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
        assert_eq!(nearest("mn", ["in", "m", "min", "mm"]), ["mm", "m", "min"]);
        assert!(nearest("rake", known).is_empty());
        assert!(nearest("", known).is_empty());
    }

    #[test]
    fn the_best_come_first_and_only_three() {
        let known = ["cuts", "cat", "cut", "cot", "cup"];
        assert_eq!(nearest("cut", known), ["cut", "cat", "cot"]);
    }

    #[test]
    fn the_closest_leave_out_what_is_farther() {
        let known = ["kr210_r2700", "kr210_r3100", "kr240_r3330"];
        assert_eq!(closest("kr210_r3101", known), ["kr210_r3100"]);
        assert_eq!(closest("kr220_r3100", known), ["kr210_r3100"]);
        assert!(closest("m20", known).is_empty());
    }
}
