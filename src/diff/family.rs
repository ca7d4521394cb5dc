//! Which files of a folder belong to a program although it does not have them any more.
//!
//! Long programs are written in parts: `rib.src`, `rib_p001.src`, `rib_p002.src`. When the job becomes shorter, parts of
//! earlier runs stay behind, and a controller that is handed the whole folder gets them too. A name is taken for such a part
//! when it is the main file's with an underscore, a few letters and three or more digits after it, and an
//! extension that the program has: `rib_2.src` may be another job, `rib_p007.src` is not.

/// Most letters between the underscore and the number of a part.
const MOST_LETTERS: usize = 4;
/// Least digits of the number of a part.
const LEAST_DIGITS: usize = 3;

/// Files of a folder that are parts of an earlier version of a program, in order.
///
/// `files` are the program's own, the main one first; `folder` are all names of the folder.
#[must_use]
pub fn stale(files: &[String], folder: &[String]) -> Vec<String> {
    let Some((main, _)) = files.first().and_then(|main| main.rsplit_once('.')) else {
        return Vec::new();
    };
    let extensions: Vec<&str> = files
        .iter()
        .filter_map(|file| Some(file.rsplit_once('.')?.1))
        .collect();
    let is_own = |name: &str| files.iter().any(|file| file.eq_ignore_ascii_case(name));
    let mut stale: Vec<String> = folder
        .iter()
        .filter(|name| is_part(name, main, &extensions) && !is_own(name))
        .cloned()
        .collect();
    stale.sort_unstable();
    stale
}

fn is_part(name: &str, main: &str, extensions: &[&str]) -> bool {
    let Some((stem, extension)) = name.rsplit_once('.') else {
        return false;
    };
    let after = stem
        .get(..main.len())
        .filter(|head| head.eq_ignore_ascii_case(main))
        .and_then(|_| stem.get(main.len()..))
        .and_then(|rest| rest.strip_prefix('_'));
    let Some(part) = after else { return false };
    let digits = part.trim_start_matches(|letter: char| letter.is_ascii_alphabetic());
    let letters = part.len() - digits.len();
    (1..=MOST_LETTERS).contains(&letters)
        && digits.len() >= LEAST_DIGITS
        && digits.bytes().all(|byte| byte.is_ascii_digit())
        && extensions
            .iter()
            .any(|known| known.eq_ignore_ascii_case(extension))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(names: &[&str]) -> Vec<String> {
        names.iter().map(|&name| name.to_owned()).collect()
    }

    #[test]
    fn parts_that_a_program_does_not_have_any_more_are_stale() {
        let files = names(&["rib.src", "rib.dat", "rib_p001.src"]);
        let folder = names(&[
            "RIB_P003.SRC",
            "rib_p001.src",
            "rib_p002.src",
            "rib.src",
            "rib_p002.dat",
            "rib_m0010.src",
        ]);
        let expected = ["RIB_P003.SRC", "rib_m0010.src", "rib_p002.dat", "rib_p002.src"];
        assert_eq!(stale(&files, &folder), expected);
    }

    #[test]
    fn other_programs_are_left_alone() {
        let files = names(&["rib.src"]);
        let folder = names(&[
            "rib_2.src",
            "rib_002.src",
            "rib_p02.src",
            "rib_p001.nc",
            "rib_p001",
            "ribs_p001.src",
            "rib_left_p001.src",
            "ri",
            "r\u{ef}b_p001.src",
        ]);
        assert_eq!(stale(&files, &folder), Vec::<String>::new());
        assert_eq!(stale(&[], &folder), Vec::<String>::new());
    }
}
