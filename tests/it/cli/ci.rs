//! The page about repositories, `docs/ci.md`: its list is a list, its workflows are well formed, and their commands run.

use super::jobs::RIB;
use super::{folder, vcutc};
use crate::repository::{files, read, root};
use std::fs;

/// The blocks of a page in one language.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    page.split(&fence)
        .skip(1)
        .map(|rest| rest.split("\n```").next().unwrap().to_owned() + "\n")
        .collect()
}

/// The part of YAML that the page uses: indentation by two, keys, lists, plain values.
fn assert_is_plain_yaml(text: &str) {
    let mut open = vec![0];
    for line in text.lines().filter(|line| !line.trim_start().starts_with('#')) {
        let body = line.trim_start();
        let depth = line.len() - body.len();
        assert!(
            !line.contains('\t') && depth % 2 == 0 && !body.is_empty(),
            "{line}"
        );
        assert!(depth <= open.last().unwrap() + 2, "{line}");
        let item = body.strip_prefix("- ").unwrap_or(body);
        let has_key = item.split_once(':').is_some_and(|(key, rest)| {
            !key.is_empty() && !key.contains(['"', '{']) && (rest.is_empty() || rest.starts_with(' '))
        });
        assert!(has_key || body.starts_with("- "), "{line}");
        let extra = if body.starts_with("- ") { 2 } else { 0 };
        open.push(depth + extra);
    }
}

/// The commands of the compiler in workflows and consoles.
fn commands(text: &str) -> impl Iterator<Item = Vec<&str>> {
    text.lines().filter_map(|line| {
        let line = line
            .trim_start()
            .trim_start_matches("- ")
            .trim_start_matches("run: ")
            .trim_start_matches("entry: ");
        let words = line.split('#').next()?.strip_prefix("vcutc ")?;
        Some(words.split_whitespace().collect())
    })
}

#[test]
fn workflows_are_well_formed_and_their_commands_run() {
    let page = read("docs/ci.md");
    let folder = folder();
    let path = folder.path();
    for job in ["rib.vcut", "jobs/left.vcut", "special/rib.vcut"] {
        fs::create_dir_all(path.join(job).parent().unwrap()).unwrap();
        fs::write(path.join(job), RIB).unwrap();
    }
    // The list, and what holds its programs to figures.
    let list = blocks(&page, "toml");
    assert_eq!(list.len(), 2);
    fs::write(path.join("vcut.toml"), list.concat()).unwrap();
    assert_eq!(vcutc(path, &["build", "--accept"]).code, Some(0));
    let mut count = 0;
    let workflows = blocks(&page, "yaml");
    assert_eq!(workflows.len(), 3);
    workflows.iter().for_each(|text| assert_is_plain_yaml(text));
    for text in blocks(&page, "console").iter().chain(&workflows) {
        for command in commands(text) {
            let run = vcutc(path, &command);
            assert_eq!(run.code, Some(0), "{command:?}: {}", run.stderr);
            count += 1;
        }
    }
    assert_eq!(count, 7);
}

/// The hook that checks jobs leaves out only files that are not jobs.
#[test]
fn the_hook_for_jobs_gets_jobs_only() {
    let hooks = read(".pre-commit-hooks.yaml");
    let page = read("docs/ci.md");
    for text in [&hooks, &page] {
        let exclude = text
            .lines()
            .find_map(|line| line.trim().strip_prefix("exclude: "));
        let pattern = exclude.and_then(|said| said.split_whitespace().next());
        assert_eq!(pattern, Some("(^|/)shop/"));
    }
    let is_left_out = |path: &str| path.split('/').rev().skip(1).any(|folder| folder == "shop");
    let mut left_out = 0;
    for file in files("examples", ".vcut") {
        let is_job = file.text.lines().any(|line| line.starts_with("job \""));
        assert_eq!(is_left_out(&file.path), !is_job, "{}", file.path);
        left_out += usize::from(!is_job);
    }
    assert!(left_out > 0);
    // What it leaves out would have failed.
    let examples = root().join("examples");
    let run = vcutc(&examples, &["check", "shop/blades.vcut"]);
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("VC0208"), "{}", run.stderr);
}

#[test]
fn hooks_are_those_of_the_page() {
    let hooks = read(".pre-commit-hooks.yaml");
    let page = read("docs/ci.md");
    for id in hooks.lines().filter_map(|line| line.strip_prefix("- id: ")) {
        assert!(page.contains(&format!("- id: {id}\n")), "{id}");
    }
    assert_is_plain_yaml(&hooks);
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    let list = "[[program]]\njobs = \"rib.vcut\"\ntarget = \"krl\"\noutput = \"out\"\n";
    fs::write(folder.path().join("vcut.toml"), list).unwrap();
    assert_eq!(vcutc(folder.path(), &["build"]).code, Some(0));
    let entries: Vec<_> = commands(&hooks).collect();
    assert_eq!(entries.len(), 3);
    for mut entry in entries {
        if entry == ["check"] {
            entry.push("rib.vcut");
        }
        assert_eq!(vcutc(folder.path(), &entry).code, Some(0), "{entry:?}");
    }
}
