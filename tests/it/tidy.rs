//! The rules of `ARCHITECTURE.md` and `CONTRIBUTING.md` that no compiler checks, by reading the sources.
//!
//! A rule reports all breaches in one run, each with file and line.

use crate::repository::{TextFile, files, paths, read, root};
use std::collections::{BTreeMap, BTreeSet};
use vcutc::diagnostics::Code;

/// Longest source file. Beyond it a file is about more than one subject.
const MOST_LINES: usize = 700;

/// Most bytes of a file. Larger ones are results of a build or packages, which have no place here.
const MOST_BYTES: u64 = 1 << 20;

/// Packages and library modules, and the only files (or folders) of `src` that may name them.
const ONLY_IN: &[(&str, &[&str])] = &[
    ("ariadne::", &["src/diagnostics/render.rs"]),
    ("pest::", &["src/syntax/"]),
    ("pest_derive::", &["src/syntax/"]),
    (
        "rayon::",
        &[
            "src/dynamics/deviation/compensation.rs",
            "src/dynamics/deviation/each.rs",
            "src/dynamics/peaks.rs",
            "src/field/",
            "src/operations/vcut/choice/",
            "src/motion/",
            "src/place/",
        ],
    ),
    (
        "hmac_sha256::",
        &["src/syntax/fingerprint.rs", "src/report/digest.rs"],
    ),
    ("strsim::", &["src/diagnostics/suggest.rs"]),
    (
        "glam::",
        &[
            "src/machine/",
            "src/process/posture.rs",
            "src/dynamics/",
            "src/motion/",
            "src/place/",
        ],
    ),
    (
        "nalgebra::",
        &["src/machine/kinematics/", "src/dynamics/modes.rs"],
    ),
    ("roxmltree::", &["src/geometry/import/svg/", "src/machine/urdf/"]),
    (
        "pulp::",
        &[
            "src/field/lanes.rs",
            "src/machine/kinematics/lanes.rs",
            "src/machine/kinematics/batch.rs",
            "src/motion/path/arm.rs",
            "src/motion/path/wide.rs",
        ],
    ),
    ("anstream::", &["src/cli/"]),
    ("clap::", &["src/cli/"]),
    ("clap_complete::", &["src/cli/"]),
    ("clap_mangen::", &["src/cli/"]),
    ("indicatif::", &["src/cli/"]),
    ("lsp_types::", &["src/lsp/"]),
    ("tempfile::", &["src/cli/"]),
    ("toml::", &["src/diagnostics/document/"]),
    ("std::fs", &["src/cli/"]),
    ("std::net", &["src/cli/watch/server.rs"]),
    ("ctrlc::", &["src/cli/watch/"]),
    ("std::env::", &["src/cli/"]),
    ("std::process", &["src/cli/", "src/main.rs"]),
    ("std::thread", &["src/cli/"]),
    ("std::time", &["src/cli/"]),
];

#[test]
fn modules_of_a_folder_import_in_one_direction() {
    let mut found = Vec::new();
    let rooms = files("src", "Cargo.toml").into_iter();
    let rooms = rooms.map(|manifest| manifest.path.replace("/Cargo.toml", ""));
    let backends = files("backends", "Cargo.toml").into_iter();
    let backends = backends.map(|manifest| manifest.path.replace("Cargo.toml", "src"));
    for room in rooms.chain(backends) {
        for folder in folders(&room) {
            let mut imports = imports(&room, &folder);
            // What serves tests uses what the tests are of.
            for serves_tests in ["testkit", "tests"] {
                imports.remove(serves_tests);
                for used in imports.values_mut() {
                    used.remove(serves_tests);
                }
            }
            for knot in knots(&imports) {
                found.push(format!("{folder}: {}", knot.join(", ")));
            }
        }
    }
    assert_none(&found);
}

#[test]
fn packages_stay_where_they_belong() {
    let mut breaches = Vec::new();
    for file in files("src", ".rs") {
        for (number, line) in file.code() {
            for (name, places) in ONLY_IN {
                let allowed = places.iter().any(|place| is_in(&file.path, place));
                if names(line, name) && !allowed {
                    breaches.push(format!("{}:{number}: {name} belongs in {places:?}", file.path));
                }
            }
        }
    }
    assert_none(&breaches);
}

#[test]
fn backends_know_the_api_only() {
    let mut breaches = Vec::new();
    for manifest in files("backends", "Cargo.toml") {
        let is_api = manifest.path == "backends/api/Cargo.toml";
        for line in dependencies(&manifest.text) {
            if line.starts_with("vcutc") && (is_api || !line.starts_with("vcutc-backend-api.")) {
                breaches.push(format!("{}: {line}", manifest.path));
            }
        }
    }
    for file in files("backends", ".rs") {
        let outside = [
            "std::fs",
            "std::env::",
            "std::net",
            "std::process",
            "std::time",
            "std::thread",
        ];
        for (number, line) in file.code() {
            breaches.extend(
                outside
                    .iter()
                    .filter(|name| names(line, name))
                    .map(|name| format!("{}:{number}: {name} in a backend", file.path)),
            );
        }
    }
    assert_none(&breaches);
}

#[test]
fn files_are_short_and_say_what_they_are_about() {
    let mut breaches = Vec::new();
    for file in sources() {
        let lines = file.text.lines().count();
        if lines > MOST_LINES {
            breaches.push(format!("{}: {lines} lines, at most {MOST_LINES}", file.path));
        }
        let first = file.text.lines().next().unwrap_or_default();
        let is_documented = first.starts_with("//! ") && first.len() > "//! ".len() + 8;
        if !is_documented && !first.starts_with("#![doc = include_str!(") {
            breaches.push(format!("{}: no module comment in the first line", file.path));
        }
    }
    assert_none(&breaches);
}

#[test]
fn nothing_is_left_for_later() {
    // In pieces, so that this file does not find itself.
    let marks = [concat!("TO", "DO"), concat!("FIX", "ME"), concat!("X", "XX")];
    let mut breaches = Vec::new();
    for file in sources().into_iter().chain(documents()) {
        for (number, line) in (1..).zip(file.text.lines()) {
            for mark in marks {
                let mut words = line.split(|c: char| !c.is_ascii_alphanumeric());
                if words.any(|word| word == mark) {
                    breaches.push(format!("{}:{number}: {mark}", file.path));
                }
            }
        }
    }
    assert_none(&breaches);
}

#[test]
fn every_code_has_a_page_that_teaches() {
    let breaches: Vec<_> = Code::ALL
        .iter()
        .map(|code| (code.number(), missing_on_page(code.number(), code.page())))
        .filter(|(_, missing)| !missing.is_empty())
        .map(|(number, missing)| format!("docs/diagnostics/{number}.md: no {}", missing.join(", no ")))
        .collect();
    assert_none(&breaches);
}

/// What a page of a code lacks. The codes about programs (07) show lines of one.
fn missing_on_page(number: &str, page: &str) -> Vec<&'static str> {
    let (meaning, rest) = page.split_once("\n## Example\n").unwrap_or((page, ""));
    let (example, remedy) = rest.split_once("\n## What to do\n").unwrap_or((rest, ""));
    let words = |text: &str| text.split_whitespace().count();
    let wanted = [
        ("title with the code", page.starts_with(&format!("# {number}: "))),
        ("explanation of a few sentences", words(meaning) >= 20),
        (
            "example in a ```vcut block, or a ```krl or ```toml one",
            ["```vcut\n", "```krl\n", "```toml\n"]
                .iter()
                .any(|block| example.contains(block)),
        ),
        ("section `## What to do` with advice", words(remedy) >= 8),
    ];
    wanted
        .into_iter()
        .filter(|(_, is_there)| !is_there)
        .map(|(what, _)| what)
        .collect()
}

#[test]
fn the_index_of_pages_is_complete() {
    let index = read("docs/diagnostics.md");
    let breaches: Vec<_> = Code::ALL
        .iter()
        .map(|code| format!("- [{0}](diagnostics/{0}.md): {1}", code.number(), code.title()))
        .filter(|entry| !index.lines().any(|line| line == entry))
        .collect();
    assert_none(&breaches);
}

#[test]
fn every_page_has_its_code() {
    let breaches: Vec<_> = files("docs/diagnostics", ".md")
        .into_iter()
        .filter(|page| {
            let name = page
                .path
                .trim_start_matches("docs/diagnostics/")
                .trim_end_matches(".md");
            Code::from_number(name).is_none()
        })
        .map(|page| format!("{}: no such code", page.path))
        .collect();
    assert_none(&breaches);
}

#[test]
fn the_readme_says_what_is_run() {
    let (readme, run) = (read("README.md"), read(".ci/run"));
    let commands: Vec<_> = readme.lines().filter(|line| line.starts_with("cargo ")).collect();
    let tests: Vec<_> = commands
        .iter()
        .filter(|line| line.starts_with("cargo test"))
        .collect();
    let [test] = tests.as_slice() else {
        panic!("the README has one command that runs all tests, not {tests:?}");
    };
    assert_eq!(
        run.lines().last(),
        Some(**test),
        "the last command of .ci/run is the README's"
    );
    let job = commands
        .iter()
        .find_map(|line| line.strip_prefix("cargo run --release -- "))
        .and_then(|rest| rest.split(' ').next())
        .expect("the README has a command that compiles a job");
    assert!(root().join(job).is_file(), "{job}");
}

#[test]
fn links_between_documents_lead_somewhere() {
    let mut breaches = Vec::new();
    for document in documents() {
        let folder = document.path.rsplit_once('/').map_or("", |(folder, _)| folder);
        for (number, line) in (1..).zip(document.text.lines()) {
            for target in link_targets(line) {
                if !root().join(folder).join(target).exists() {
                    breaches.push(format!("{}:{number}: {target}", document.path));
                }
            }
        }
    }
    assert_none(&breaches);
}

/// Comments say `docs/process.md`, documents `src/geometry/grid.rs`: what stands so in backquotes is a file or a folder.
#[test]
fn no_file_is_large() {
    let paths = paths("").into_iter();
    let sizes = paths.map(|path| (std::fs::metadata(&path).unwrap().len(), path));
    let large = sizes.filter(|(bytes, _)| *bytes > MOST_BYTES);
    let words = large.map(|(bytes, path)| format!("{}: {bytes} bytes", path.display()));
    assert_none(&words.collect::<Vec<_>>());
}

#[test]
fn files_that_are_cited_exist() {
    let mut breaches = Vec::new();
    for file in sources().into_iter().chain(documents()) {
        for (number, line) in (1..).zip(file.text.lines()) {
            for cited in cited_files(line) {
                if !root().join(cited).exists() {
                    breaches.push(format!("{}:{number}: {cited}", file.path));
                }
            }
        }
    }
    assert_none(&breaches);
}

/// What stands in square brackets as a letter, a hyphen and capitals is a source.
#[test]
fn sources_that_are_cited_are_among_the_references() {
    let references = read("docs/references.md");
    let mut found = Vec::new();
    let mut count = 0;
    for file in sources().iter().chain(&documents()) {
        for (line, text) in (1..).zip(file.text.lines()) {
            for key in cited_keys(text) {
                count += 1;
                if !references.contains(&format!("[{key}]")) {
                    found.push(format!("{}:{line}: [{key}]", file.path));
                }
            }
        }
    }
    assert!(count > 50, "{count} keys: are they looked for where they are?");
    assert_none(&found);
}

fn assert_none(breaches: &[String]) {
    assert!(breaches.is_empty(), "\n{}\n", breaches.join("\n"));
}

/// All sources of the workspace.
fn sources() -> Vec<TextFile> {
    ["src", "backends", "tests"]
        .into_iter()
        .flat_map(|folder| files(folder, ".rs"))
        .collect()
}

/// All documents of the workspace.
fn documents() -> Vec<TextFile> {
    files("", ".md")
}

/// A room and all folders of sources in it.
fn folders(room: &str) -> BTreeSet<String> {
    let parents = files(room, ".rs")
        .into_iter()
        .filter_map(|file| Some(file.path.rsplit_once('/')?.0.to_owned()));
    parents.collect()
}

/// The modules of a folder of a room, and those that each of them names.
fn imports(room: &str, folder: &str) -> BTreeMap<String, BTreeSet<String>> {
    let mut imports: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let within = folder.trim_start_matches(room).trim_start_matches('/');
    let from_the_root = format!(
        "crate::{}",
        within.replace('/', "::") + if within.is_empty() { "" } else { "::" }
    );
    for file in files(folder, ".rs") {
        let inside = file.path.trim_start_matches(folder).trim_start_matches('/');
        let parts: Vec<&str> = inside.split('/').collect();
        let module = parts[0].trim_end_matches(".rs");
        // `super` leads to the room from a module's own file, and from deeper ones as often as they are deep.
        let depth = parts.len() - usize::from(parts.len() > 1 && inside.ends_with("/mod.rs"));
        let code: Vec<&str> = file.code().map(|(_, line)| line).collect();
        let code = code.join("\n");
        let used = imports.entry(module.to_owned()).or_default();
        for root in [from_the_root.clone(), "super::".repeat(depth)] {
            for (at, found) in code.match_indices(&root) {
                let is_whole = !code[..at].ends_with(|c: char| c.is_alphanumeric() || "_$:".contains(c));
                if is_whole {
                    used.extend(first_names(&code[at + found.len()..]));
                }
            }
        }
    }
    let modules: BTreeSet<String> = imports.keys().cloned().collect();
    for (module, used) in &mut imports {
        used.retain(|name| name != module && modules.contains(name));
    }
    imports
}

/// The names that a path goes on with: one, or several in braces.
fn first_names(rest: &str) -> Vec<String> {
    let name = |text: &str| {
        let is_word = |c: &char| c.is_alphanumeric() || *c == '_';
        text.trim_start().chars().take_while(is_word).collect::<String>()
    };
    let Some(group) = rest.strip_prefix('{') else {
        return vec![name(rest)];
    };
    let mut depth = 1;
    let mut names = vec![name(group)];
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => names.push(name(&group[at + 1..])),
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    names
}

/// Sets of modules each of which leads to all others of its set.
fn knots(imports: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<Vec<String>> {
    let reached = |from: &String| {
        let mut reached = BTreeSet::new();
        let mut open: Vec<&String> = imports[from].iter().collect();
        while let Some(module) = open.pop() {
            if reached.insert(module.clone()) {
                open.extend(&imports[module]);
            }
        }
        reached
    };
    let all: BTreeMap<&String, BTreeSet<String>> =
        imports.keys().map(|module| (module, reached(module))).collect();
    let circle = |module: &String| -> Vec<String> {
        let others = all[module].iter().filter(|other| all[*other].contains(module));
        others.cloned().collect()
    };
    imports
        .keys()
        .map(circle)
        .filter(|circle| circle.len() > 1)
        .collect()
}

/// Whether a file is a place, or in the folder that is the place. The folder's own module lies beside it.
fn is_in(path: &str, place: &str) -> bool {
    path.starts_with(place) || path.strip_suffix(".rs") == place.strip_suffix('/')
}

/// Whether a line names a path such as `std::fs`, and not one that merely ends or begins alike.
fn names(line: &str, name: &str) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(name).any(|(at, found)| {
        let before = line[..at].chars().next_back();
        let after = line[at + found.len()..].chars().next();
        let free_before = before.is_none_or(|c| !is_word(c) && c != ':');
        let free_after = name.ends_with(':') || after.is_none_or(|c| !is_word(c));
        free_before && free_after
    })
}

/// The lines of `[dependencies]` (not those for tests).
fn dependencies(manifest: &str) -> impl Iterator<Item = &str> {
    manifest
        .lines()
        .skip_while(|line| *line != "[dependencies]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
}

/// Paths below the root that stand in backquotes; patterns such as `docs/diagnostics/VCnnnn.md` do not count.
fn cited_keys(line: &str) -> impl Iterator<Item = &str> {
    let brackets = line.split('[').skip(1).filter_map(|rest| rest.split(']').next());
    brackets
        .flat_map(|keys| keys.split(", "))
        .filter(|key| match key.split_once('-') {
            Some((maker, work)) => {
                let is_capital = |letter: char| letter.is_ascii_uppercase();
                maker.len() == 1
                    && maker.starts_with(is_capital)
                    && work.len() > 1
                    && work
                        .chars()
                        .all(|letter| is_capital(letter) || letter.is_ascii_digit() || letter == 'b')
            }
            None => false,
        })
}

fn cited_files(line: &str) -> impl Iterator<Item = &str> {
    let quoted = line.split('`').skip(1).step_by(2);
    quoted.filter(|text| {
        let top = text.split('/').next().unwrap_or_default();
        let is_plain = text
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || "/._-".contains(c));
        let is_pattern = ["nnnn", "NAME"].iter().any(|part| text.contains(part));
        text.contains('/')
            && ["backends", "docs", "examples", "src", "tests"].contains(&top)
            && is_plain
            && !is_pattern
    })
}

/// Where the links of a line of Markdown lead, as far as that is inside of the repository.
fn link_targets(line: &str) -> impl Iterator<Item = &str> {
    let targets = line
        .split("](")
        .skip(1)
        .chain(line.split("src=\"").skip(1))
        .filter_map(|rest| rest.split([')', '"', '#']).next());
    targets.filter(|target| !target.is_empty() && !target.contains("://"))
}
