//! The error gallery of the README is what the compiler prints.

use super::vcutc;
use crate::repository::root;
use std::fs;

#[test]
fn the_readme_shows_what_the_compiler_prints() {
    let run = vcutc(
        root(),
        &[
            "check",
            "examples/broken.vcut",
            "examples/too_deep.vcut",
            "examples/out_of_reach.vcut",
        ],
    );
    assert_eq!(run.code, Some(1));
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let gallery = readme
        .split("<!-- gallery:begin -->\n")
        .nth(1)
        .and_then(|rest| rest.split("<!-- gallery:end -->").next())
        .expect("the README has a gallery");
    let shown = gallery.trim_start_matches("```text\n").trim_end_matches("```\n");
    assert_eq!(
        shown.trim_end(),
        run.stderr.trim_end(),
        "copy what the compiler prints into the README"
    );
}
