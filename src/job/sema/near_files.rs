//! The file that was most likely meant by a path that leads nowhere: one of nearly that name, or one of that name in a folder
//! beside.

use super::session::Session;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::{Entry, Loader, Span, path_from};
use vcutc_diagnostics::suggest::nearest;

/// Most folders that are looked into for a file of the name.
const MOST_FOLDERS: usize = 32;

/// Adds what to do about a file that is not there. `named` is where it is named.
pub(super) fn meant(
    diagnostic: Diagnostic,
    named: Span,
    resolved: &str,
    session: &Session<'_>,
) -> Diagnostic {
    let Some(found) = near(resolved, session.loader) else {
        return diagnostic.help(format!("check the name, or put the file at `{resolved}`"));
    };
    let written = path_from(session.sources.name(named.file), &found);
    let is_quoted = session.sources.slice(named).starts_with('"');
    match written {
        Some(written) if is_quoted && !written.contains(['"', '\\']) => {
            let quoted = format!("\"{written}\"");
            diagnostic.fix(format!("did you mean `{quoted}`?"), named, quoted)
        }
        Some(_) | None => diagnostic.help(format!("did you mean `{found}`?")),
    }
}

/// The path of a file that is there.
fn near(path: &str, files: &dyn Loader) -> Option<String> {
    by_spelling(path, files).or_else(|| by_folder(path, files))
}

/// Walks along the path, and takes the nearest name wherever one of its parts is not there.
fn by_spelling(path: &str, files: &dyn Loader) -> Option<String> {
    let (root, relative) = match path.strip_prefix('/') {
        Some(relative) => ("/", relative),
        None => ("", path),
    };
    let mut reached = root.to_owned();
    let mut parts = relative.split('/').peekable();
    while let Some(part) = parts.next() {
        let next = match (part, parts.peek()) {
            // Listings leave hidden folders out.
            (hidden, Some(_)) if hidden.starts_with('.') => hidden.to_owned(),
            ("..", None) => part.to_owned(),
            (_, Some(_)) => like(part, folders(&reached, files))?,
            (_, None) => like(part, files_of(&reached, files))?,
        };
        reached = within(&reached, &next);
    }
    Some(reached)
}

/// The name itself, else the nearest.
fn like(wanted: &str, names: Vec<String>) -> Option<String> {
    if names.iter().any(|name| name == wanted) {
        return Some(wanted.to_owned());
    }
    let near = nearest(wanted, names.iter().map(String::as_str));
    near.first().map(|name| (*name).to_owned())
}

/// The one file of that name in the folder above, or in those beside where it was looked for.
fn by_folder(path: &str, files: &dyn Loader) -> Option<String> {
    let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
    let above = match folder.rsplit_once('/') {
        _ if folder.is_empty() => Some("..".to_owned()),
        // What is above `..` has no name that leads back.
        _ if folder.ends_with("..") => None,
        Some((above, _)) => Some(above.to_owned()),
        None => Some(String::new()),
    };
    let below = folders(folder, files).into_iter().take(MOST_FOLDERS);
    let places = below.map(|below| within(folder, &below)).chain(above);
    let has_it = |place: &String| files_of(place, files).iter().any(|file| file == name);
    let mut found = places.filter(has_it);
    match (found.next(), found.next()) {
        (Some(place), None) => Some(within(&place, name)),
        (None | Some(_), _) => None,
    }
}

fn within(folder: &str, name: &str) -> String {
    match folder {
        "" => name.to_owned(),
        _ if folder.ends_with('/') => format!("{folder}{name}"),
        _ => format!("{folder}/{name}"),
    }
}

fn folders(folder: &str, files: &dyn Loader) -> Vec<String> {
    let name = |entry| match entry {
        Entry::Folder(name) => Some(name),
        Entry::File(_) => None,
    };
    files.list(folder).into_iter().filter_map(name).collect()
}

fn files_of(folder: &str, files: &dyn Loader) -> Vec<String> {
    let name = |entry| match entry {
        Entry::File(name) => Some(name),
        Entry::Folder(_) => None,
    };
    files.list(folder).into_iter().filter_map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_diagnostics::source::{LoadError, entries_among};

    struct Paths(&'static [&'static str]);

    impl Loader for Paths {
        fn load(&self, _: &str) -> Result<Vec<u8>, LoadError> {
            Err(LoadError::NotFound)
        }

        fn list(&self, folder: &str) -> Vec<Entry> {
            entries_among(self.0.iter().copied(), folder)
        }
    }

    #[test]
    fn misspelt_names_and_folders_are_found() {
        let files = Paths(&["heights.csv", "shop/blades.vcut", "shop/cells.vcut", "rib.vcut"]);
        let found = |path| near(path, &files);
        assert_eq!(found("heigts.csv").as_deref(), Some("heights.csv"));
        assert_eq!(found("Heights.CSV").as_deref(), Some("heights.csv"));
        assert_eq!(found("shp/blade.vcut").as_deref(), Some("shop/blades.vcut"));
        assert_eq!(found("wing.dxf"), None);
        assert_eq!(found("shop/wing.dxf"), None);
    }

    #[test]
    fn absolute_paths_are_walked_from_the_root() {
        let files = Paths(&["/a/jobs/rib.vcut", "/a/data/heights.csv"]);
        let found = |path| near(path, &files);
        assert_eq!(
            found("/a/data/heigths.csv").as_deref(),
            Some("/a/data/heights.csv")
        );
        assert_eq!(found("/a/heights.csv").as_deref(), Some("/a/data/heights.csv"));
    }

    #[test]
    fn a_file_in_a_folder_beside_is_found_when_there_is_one() {
        let one = Paths(&["jobs/rib.vcut", "jobs/data/heights.csv"]);
        assert_eq!(
            near("jobs/heights.csv", &one).as_deref(),
            Some("jobs/data/heights.csv")
        );
        let above = Paths(&["jobs/rib.vcut", "heights.csv"]);
        assert_eq!(near("jobs/heights.csv", &above).as_deref(), Some("heights.csv"));
        let two = Paths(&["jobs/data/heights.csv", "jobs/old/heights.csv"]);
        assert_eq!(near("jobs/heights.csv", &two), None);
    }
}
