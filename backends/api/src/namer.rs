//! Names that a dialect accepts, made from names that people wrote.

use crate::ir::AIR_ENDING;
use std::collections::BTreeSet;

/// What a dialect takes as a name.
#[derive(Clone, Copy, Debug)]
pub struct NameRules {
    /// Longest name, in characters.
    pub max_length: usize,
    /// Put before a name that would start with a digit, collide with a reserved word, or be empty.
    pub prefix: &'static str,
    /// Words the dialect keeps for itself, in upper case.
    pub reserved: &'static [&'static str],
}

/// Hands out names that obey the rules and differ from one another, whatever their case.
#[derive(Clone, Debug)]
pub struct Namer {
    rules: NameRules,
    taken: BTreeSet<String>,
}

impl Namer {
    /// No name given yet.
    #[must_use]
    pub const fn new(rules: NameRules) -> Self {
        Self {
            rules,
            taken: BTreeSet::new(),
        }
    }

    /// Keeps names from being given, whatever their case.
    pub fn avoid(&mut self, names: &[String]) {
        self.taken
            .extend(names.iter().map(|name| name.to_ascii_uppercase()));
    }

    /// A name like `wanted`: ASCII letters, digits and `_`, not reserved, short enough, and new.
    pub fn name(&mut self, wanted: &str) -> String {
        let plain = self.sanitise(wanted);
        let mut candidate = plain.clone();
        let mut count = 1_u32;
        while !self.taken.insert(candidate.to_ascii_uppercase()) {
            count += 1;
            let suffix = format!("_{count}");
            candidate = fitted(&plain, self.rules.max_length.saturating_sub(suffix.len())) + &suffix;
        }
        candidate
    }

    fn sanitise(&self, wanted: &str) -> String {
        let mut name = String::new();
        for c in wanted.chars() {
            if c.is_ascii_alphanumeric() || c == '_' {
                name.push(c);
            } else if !name.ends_with('_') {
                name.push('_');
            }
        }
        let name = name.trim_matches('_');
        let reserved = self.rules.reserved.contains(&name.to_ascii_uppercase().as_str());
        let needs_prefix = reserved || !name.starts_with(|c: char| c.is_ascii_alphabetic());
        let prefix = if needs_prefix { self.rules.prefix } else { "" };
        fitted(&format!("{prefix}{name}"), self.rules.max_length)
    }
}

/// A name of ASCII cut to length. That of an air cut keeps its ending: without it, it would be the name of the program that
/// cuts, and take its place.
fn fitted(name: &str, most: usize) -> String {
    let (stem, ending) = match name.strip_suffix(AIR_ENDING) {
        Some(stem) => (stem, AIR_ENDING),
        None => (name, ""),
    };
    let room = most.saturating_sub(ending.len());
    stem.chars().take(room).chain(ending.chars()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const RULES: NameRules = NameRules {
        max_length: 8,
        prefix: "v_",
        reserved: &["LIN", "END"],
    };

    #[test]
    fn keeps_good_names_and_mends_bad_ones() {
        let mut namer = Namer::new(RULES);
        assert_eq!(namer.name("rib"), "rib");
        assert_eq!(namer.name("RIB"), "RIB_2");
        assert_eq!(namer.name("spoiler rib 12"), "spoiler_");
        assert_eq!(namer.name("spoiler rib 13"), "spoile_2");
        assert_eq!(namer.name("lin"), "v_lin");
        assert_eq!(namer.name("12"), "v_12");
        assert_eq!(namer.name("Flügel"), "Fl_gel");
        assert_eq!(namer.name(""), "v_");
        assert_eq!(namer.name("spoiler rib_air"), "spoi_air");
        assert_eq!(namer.name("spoiler rob_air"), "sp_air_2");
    }

    proptest! {
        #[test]
        fn every_name_obeys_the_rules(wanted in prop::collection::vec(".{0,12}", 1..40)) {
            let mut namer = Namer::new(RULES);
            let mut seen = BTreeSet::new();
            for name in wanted.iter().map(|w| namer.name(w)) {
                prop_assert!(name.len() <= 8 && name.is_ascii());
                prop_assert!(name.starts_with(|c: char| c.is_ascii_alphabetic()), "{}", name);
                prop_assert!(!RULES.reserved.contains(&name.to_ascii_uppercase().as_str()));
                prop_assert!(seen.insert(name.to_ascii_uppercase()));
            }
        }
    }
}
