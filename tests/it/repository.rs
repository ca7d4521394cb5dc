//! The files of this repository, as the tidy tests see them.

use std::fs;
use std::path::{Path, PathBuf};

/// A text file of the repository.
pub(crate) struct TextFile {
    /// Its path from the root, with `/`.
    pub(crate) path: String,
    /// Its text.
    pub(crate) text: String,
}

impl TextFile {
    /// The text before the unit tests at its end; nothing for a file of tests.
    pub(crate) fn without_tests(&self) -> &str {
        let is_tests = self.path.ends_with("/tests.rs") || self.path.contains("/tests/");
        if is_tests {
            return "";
        }
        let end = self
            .text
            .find("#[cfg(test)]\nmod tests {")
            .unwrap_or(self.text.len());
        &self.text[..end]
    }

    /// The lines of [`Self::without_tests`] that are not comments, with their numbers.
    pub(crate) fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        let lines = (1..).zip(self.without_tests().lines());
        lines.filter(|(_, line)| !line.trim_start().starts_with("//"))
    }
}

/// The root of the repository.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The text of one file.
pub(crate) fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The paths of all files below a folder, in their order, without what is built.
pub(crate) fn paths(folder: &str) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    collect(&root().join(folder), &mut paths);
    paths.sort();
    paths
}

/// All files below a folder whose names end so, in order of their paths.
pub(crate) fn files(folder: &str, ending: &str) -> Vec<TextFile> {
    let paths = paths(folder);
    let files: Vec<_> = paths
        .iter()
        .filter_map(|path| {
            let relative = path.strip_prefix(root()).unwrap();
            let parts: Vec<_> = relative.iter().map(|part| part.to_str().unwrap()).collect();
            let path = parts.join("/");
            path.ends_with(ending).then(|| TextFile {
                text: read(&path),
                path,
            })
        })
        .collect();
    assert!(!files.is_empty(), "no {ending} below {folder}");
    files
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if ["target", "node_modules"].contains(&name) || name.starts_with('.') {
            continue;
        }
        if path.is_dir() {
            collect(&path, paths);
        } else {
            paths.push(path);
        }
    }
}

/// The codes that a job's first line says it gives: `// expect: VCnnnn ...`.
pub(crate) fn expected_codes(job: &str) -> Vec<&str> {
    let first = job.lines().next().unwrap_or_default();
    let list = first
        .strip_prefix("// expect: ")
        .expect("the first line reads `// expect: VCnnnn ...`");
    list.split_whitespace().collect()
}
