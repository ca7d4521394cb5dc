//! The commit that a checkout or a published package was made from, read from its files: no program is run and nothing is
//! asked of a network, so that the same sources give the same binary.

use std::fs;
use std::path::{Path, PathBuf};

/// How many digits of a commit are shown.
const DIGITS: usize = 9;

/// The short commit of the sources in a folder; none of an archive that does not say.
pub(crate) fn of(root: &Path) -> Option<String> {
    let whole = of_checkout(root).or_else(|| of_package(root))?;
    let is_hash = whole.len() >= DIGITS && whole.bytes().all(|byte| byte.is_ascii_hexdigit());
    is_hash.then(|| whole.chars().take(DIGITS).collect())
}

/// The files on which the answer depends.
pub(crate) fn files(root: &Path) -> Vec<PathBuf> {
    let mut files = vec![root.join(".cargo_vcs_info.json")];
    if let Some(git) = git_folder(root) {
        files.push(git.join("HEAD"));
        let shared = shared_folder(&git);
        files.push(shared.join("packed-refs"));
        files.extend(reference(&git).map(|name| shared.join(name)));
    }
    files.retain(|file| file.is_file());
    files
}

fn of_checkout(root: &Path) -> Option<String> {
    let git = git_folder(root)?;
    let Some(name) = reference(&git) else {
        return Some(read(&git.join("HEAD"))?.trim().to_owned());
    };
    let shared = shared_folder(&git);
    let loose = [&git, &shared]
        .into_iter()
        .find_map(|folder| read(&folder.join(&name)));
    loose.map(|hash| hash.trim().to_owned()).or_else(|| {
        let packed = read(&shared.join("packed-refs"))?;
        let line = packed.lines().find(|line| line.ends_with(&format!(" {name}")))?;
        Some(line.split(' ').next()?.to_owned())
    })
}

/// `.git` is a folder, or in a second working tree a file that names one.
fn git_folder(root: &Path) -> Option<PathBuf> {
    let git = root.join(".git");
    if git.is_dir() {
        return Some(git);
    }
    let named = read(&git)?;
    Some(root.join(named.strip_prefix("gitdir: ")?.trim()))
}

/// Where the branches of all working trees are.
fn shared_folder(git: &Path) -> PathBuf {
    match read(&git.join("commondir")) {
        Some(shared) => git.join(shared.trim()),
        None => git.to_owned(),
    }
}

/// The branch that is checked out.
fn reference(git: &Path) -> Option<String> {
    let head = read(&git.join("HEAD"))?;
    Some(head.strip_prefix("ref: ")?.trim().to_owned())
}

/// `cargo package` writes the commit into the archive.
fn of_package(root: &Path) -> Option<String> {
    let text = read(&root.join(".cargo_vcs_info.json"))?;
    let (_, rest) = text.split_once("\"sha1\"")?;
    rest.split('"').nth(1).map(ToOwned::to_owned)
}

fn read(path: &Path) -> Option<String> {
    fs::read_to_string(path).ok()
}
