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
            candidate = cut(&plain, self.rules.max_length.saturating_sub(suffix.len())) + &suffix;
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

/// A name of ASCII cut to length. Names that begin alike would be the same one then, and the program of one job take the place
/// of another's, so a cut name ends in a mark of all that it was. That of an air cut keeps its ending, too: without it, it would
/// be the name of the program that cuts.
fn fitted(name: &str, most: usize) -> String {
    let (stem, ending) = parted(name);
    let room = most.saturating_sub(ending.len());
    if stem.len() <= room {
        return name.to_owned();
    }
    let mark = format!("_{}", mark(stem));
    if room < 2 * mark.len() {
        return cut(name, most);
    }
    let start: String = stem.chars().take(room - mark.len()).collect();
    format!("{}{mark}{ending}", start.trim_end_matches('_'))
}

/// A name of ASCII with no more than so many characters, and the ending of an air cut.
fn cut(name: &str, most: usize) -> String {
    let (stem, ending) = parted(name);
    let room = most.saturating_sub(ending.len());
    stem.chars().take(room).chain(ending.chars()).collect()
}

/// The ending of an air cut apart from the rest.
fn parted(name: &str) -> (&str, &str) {
    match name.strip_suffix(AIR_ENDING) {
        Some(stem) => (stem, AIR_ENDING),
        None => (name, ""),
    }
}

/// How many characters distinguish names that were cut: one in 1.7 million pairs is the same.
const MARK: usize = 4;

/// Digits and letters that are the same in lower and upper case for who ignores case.
const DIGITS: &[u8; 36] = b"0123456789abcdefghijklmnopqrstuvwxyz";

/// A few characters that depend on all of a name, whatever its case: FNV-1a (Fowler, Noll and Vo), to the base 36.
fn mark(name: &str) -> String {
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte.to_ascii_lowercase())).wrapping_mul(0x0100_0000_01b3)
    });
    // The low bits alone would depend on the low bits of the name's characters alone.
    let mut rest = hash ^ (hash >> 32);
    let mut mark = String::new();
    for _ in 0..MARK {
        let digit = usize::try_from(rest % 36).unwrap_or_default();
        mark.extend(DIGITS.get(digit).map(|&digit| char::from(digit)));
        rest /= 36;
    }
    mark
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

    /// Names as long as controls take.
    const LONG: NameRules = NameRules {
        max_length: 18,
        ..RULES
    };

    fn alone(wanted: &str) -> String {
        Namer::new(LONG).name(wanted)
    }

    #[test]
    fn names_that_are_cut_differ() {
        let two = ["p_kuka_kr210_r3100_2", "p_kuka_kr210_r3100_ultra"].map(alone);
        assert_ne!(two[0], two[1]);
        for name in &two {
            assert!(name.starts_with("p_kuka_kr210_") && name.len() <= 18, "{name}");
        }
        assert_eq!(two[0], alone("p_kuka_kr210_r3100_2"), "the same in every run");
        assert_eq!(alone("p_kuka_kr210_r3100"), "p_kuka_kr210_r3100");
        let air = alone("p_kuka_kr210_r3100_2_air");
        assert!(
            air.starts_with("p_kuka") && air.ends_with("_air") && air.len() <= 18,
            "{air}"
        );
        assert_ne!(air, alone("p_kuka_kr210_r3100_ultra_air"));
        let many: BTreeSet<String> = (0..200)
            .map(|n| alone(&format!("spoiler_rib_of_the_wing_{n}")))
            .collect();
        assert_eq!(many.len(), 200);
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
